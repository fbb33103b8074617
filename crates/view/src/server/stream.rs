//! One page: a thread that reads what it says, and one that writes to it.
//!
//! They share an [`Inbox`] and a [`Bell`]. The reader never waits for the writer longer than it takes to
//! make room in the inbox, which is what slows a page down that says more than it is answered.

use super::connection::{STACK, WRITE_TIME};
use super::head::Head;
use super::{Bell, Page, Shared, Source};
use crate::wire::{Asked, BadMessage, Message, Said};
use std::collections::VecDeque;
use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tungstenite::error::CapacityError;
use tungstenite::handshake::derive_accept_key;
use tungstenite::protocol::frame::coding::{CloseCode, Data, OpCode};
use tungstenite::protocol::frame::{CloseFrame, Frame, FrameHeader};
use tungstenite::protocol::{Role, WebSocketConfig, WebSocketContext};
use tungstenite::{Error, Message as Heard};

/// The longest message of a page.
const MESSAGE_MAX: usize = 64 * 1024;

/// Messages of a page that wait to be heard.
const INBOX_MAX: usize = 64;

/// Bytes of answers to pings that wait to be sent.
const PONGS_MAX: usize = 16 * 1024;

/// A page that says nothing for so long, not even an answer to a ping, is gone.
const SILENCE: Duration = Duration::from_secs(60);

/// How often a page is asked whether it is there.
const PING: Duration = Duration::from_secs(20);

/// What the reader hands to the writer.
#[derive(Default)]
struct Inbox {
    heard: VecDeque<Result<Asked, String>>,
    /// Answers to pings, as bytes.
    pongs: Vec<u8>,
    /// The page is told this, and closed.
    last_words: Option<(CloseCode, String)>,
    /// The page has said farewell; what waits is the answer.
    farewell: bool,
    /// Nobody reads or writes any more.
    gone: bool,
}

#[derive(Default)]
struct Line {
    inbox: Mutex<Inbox>,
    room: Condvar,
    bell: Arc<Bell>,
}

impl Line {
    fn inbox(&self) -> MutexGuard<'_, Inbox> {
        self.inbox.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Hands a message to the writer; waits for room. Whether there is still a writer.
    fn hand_over(&self, heard: Result<Asked, String>) -> bool {
        let inbox = self.inbox();
        let full = |inbox: &mut Inbox| inbox.heard.len() >= INBOX_MAX && !inbox.gone;
        let waited = self.room.wait_while(inbox, full);
        let mut inbox = waited.unwrap_or_else(PoisonError::into_inner);
        inbox.heard.push_back(heard);
        let there = !inbox.gone;
        drop(inbox);
        self.bell.ring();
        there
    }

    fn leave(&self) {
        self.inbox().gone = true;
        self.room.notify_all();
        self.bell.ring();
    }

    fn close(&self, code: CloseCode, text: String) {
        self.inbox().last_words.get_or_insert((code, text));
        self.bell.ring();
    }
}

/// Makes a page of a connection, and stays with it until it ends.
pub(super) fn talk(mut stream: TcpStream, head: &Head, shared: &Arc<Shared>) {
    let key = head.only("sec-websocket-key").unwrap_or_default();
    let answer = format!(
        "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\
         Sec-WebSocket-Accept: {}\r\n\r\n",
        derive_accept_key(key.as_bytes())
    );
    if stream.write_all(answer.as_bytes()).is_err() {
        return;
    }
    let Some(source) = wait_for_source(shared) else {
        return;
    };
    let line = Arc::new(Line::default());
    let writer = {
        let Ok(stream) = stream.try_clone() else {
            return;
        };
        let line = Arc::clone(&line);
        let page = source.open(Arc::clone(&line.bell));
        let builder = std::thread::Builder::new().name("view-write".to_owned());
        let run = move || {
            let _ = write(&stream, &line, page);
            line.leave();
            let _ = stream.shutdown(Shutdown::Both);
        };
        match builder.stack_size(STACK).spawn(run) {
            Ok(writer) => writer,
            Err(_) => return,
        }
    };
    let polite = read(&stream, &head.rest, &line, &*source);
    if !polite {
        line.leave();
        let _ = stream.shutdown(Shutdown::Both);
    }
    let _ = writer.join();
}

/// What is shown may not be known yet.
fn wait_for_source(shared: &Shared) -> Option<Arc<dyn Source>> {
    loop {
        if let Some(source) = shared.source.get() {
            return Some(Arc::clone(source));
        }
        if shared.closing.load(Ordering::Relaxed) {
            return None;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// A stream whose answers to pings are kept for the writer.
struct Ear<'a> {
    stream: &'a TcpStream,
    answers: Vec<u8>,
}

impl Read for Ear<'_> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        self.stream.read(to)
    }
}

impl Write for Ear<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.answers.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Reads until the page is gone, or is to be closed; then the writer has the last word: `true`.
fn read(stream: &TcpStream, rest: &[u8], line: &Line, source: &dyn Source) -> bool {
    let config = WebSocketConfig::default()
        .read_buffer_size(4 * 1024)
        .write_buffer_size(0)
        .max_message_size(Some(MESSAGE_MAX))
        .max_frame_size(Some(MESSAGE_MAX));
    let mut context =
        WebSocketContext::from_partially_read(rest.to_vec(), Role::Server, Some(config));
    let _ = stream.set_read_timeout(Some(SILENCE));
    let mut ear = Ear {
        stream,
        answers: Vec::new(),
    };
    loop {
        let heard = context.read(&mut ear);
        // An answer that waits inside is written with the next read: have it now.
        let _ = context.flush(&mut ear);
        if !ear.answers.is_empty() {
            let mut inbox = line.inbox();
            if inbox.pongs.len() + ear.answers.len() > PONGS_MAX {
                return false;
            }
            inbox.pongs.append(&mut ear.answers);
            drop(inbox);
            line.bell.ring();
        }
        let text = match heard {
            Ok(Heard::Text(text)) => text,
            Ok(Heard::Close(_)) => {
                line.inbox().farewell = true;
                line.bell.ring();
                return true;
            }
            Ok(Heard::Ping(_) | Heard::Pong(_)) => continue,
            Ok(Heard::Binary(_)) => {
                line.close(
                    CloseCode::Unsupported,
                    "this is no JSON but binary".to_owned(),
                );
                return true;
            }
            Ok(_) => continue,
            Err(Error::Capacity(CapacityError::MessageTooLong { .. })) => {
                let text = format!("a message has at most {MESSAGE_MAX} bytes");
                line.close(CloseCode::Size, text);
                return true;
            }
            Err(Error::Utf8(_)) => {
                line.close(CloseCode::Invalid, "this is no text".to_owned());
                return true;
            }
            Err(_) => return false,
        };
        let heard = match Asked::read(&text) {
            Ok(asked) => match source.command(&asked) {
                Ok(true) => {
                    line.bell.ring();
                    continue;
                }
                Ok(false) => Ok(asked),
                Err(text) => Err(text),
            },
            Err(error @ BadMessage::NoJson(_)) => {
                line.close(CloseCode::Unsupported, error.to_string());
                return true;
            }
            Err(error) => Err(error.to_string()),
        };
        if !line.hand_over(heard) {
            return false;
        }
    }
}

/// Writes until the page is gone.
#[allow(
    clippy::disallowed_methods,
    reason = "how long a page has been silent is wall time"
)]
fn write(mut stream: &TcpStream, line: &Line, mut page: Box<dyn Page>) -> io::Result<()> {
    stream.set_write_timeout(Some(WRITE_TIME))?;
    let mut last = Instant::now();
    let (mut out, mut head) = (Vec::new(), Vec::new());
    loop {
        let (heard, pongs, last_words, over) = {
            let mut inbox = line.inbox();
            if inbox.gone {
                return Ok(());
            }
            let heard = std::mem::take(&mut inbox.heard);
            let pongs = std::mem::take(&mut inbox.pongs);
            (heard, pongs, inbox.last_words.take(), inbox.farewell)
        };
        line.room.notify_all();
        stream.write_all(&pongs)?;
        if over {
            return Ok(());
        }
        for asked in heard {
            match asked {
                Ok(asked) => page.hear(asked, &mut out),
                Err(text) => out.push(Said::Error { text }.message()),
            }
        }
        let wait = match last_words {
            Some((code, text)) => {
                out.push(Said::Error { text: text.clone() }.message());
                send_all(stream, &mut out, &mut head)?;
                return farewell(stream, code, text);
            }
            None => page.speak(&mut out),
        };
        if !out.is_empty() {
            send_all(stream, &mut out, &mut head)?;
            last = Instant::now();
        } else if last.elapsed() >= PING {
            let mut bytes = Vec::new();
            if Frame::ping(Vec::new()).format(&mut bytes).is_ok() {
                stream.write_all(&bytes)?;
            }
            last = Instant::now();
        }
        if !wait.is_zero() {
            line.bell.wait(wait.min(PING));
        }
    }
}

fn send_all(mut stream: &TcpStream, out: &mut Vec<Message>, head: &mut Vec<u8>) -> io::Result<()> {
    for message in out.drain(..) {
        head.clear();
        let kind = match message {
            Message::Text(_) => Data::Text,
            Message::Binary(_) => Data::Binary,
        };
        let header = FrameHeader {
            opcode: OpCode::Data(kind),
            ..FrameHeader::default()
        };
        let length = message.len() as u64;
        header.format(length, head).map_err(io::Error::other)?;
        stream.write_all(head)?;
        stream.write_all(message.bytes())?;
    }
    Ok(())
}

/// Closes a page, with the reason; gives it a moment to read it.
fn farewell(mut stream: &TcpStream, code: CloseCode, text: String) -> io::Result<()> {
    let mut bytes = Vec::new();
    let reason: String = text.chars().take(100).filter(char::is_ascii).collect();
    let close = CloseFrame {
        code,
        reason: reason.into(),
    };
    Frame::close(Some(close))
        .format(&mut bytes)
        .map_err(io::Error::other)?;
    stream.write_all(&bytes)?;
    stream.shutdown(Shutdown::Write)?;
    stream.set_read_timeout(Some(Duration::from_millis(500)))?;
    let mut block = [0; 4096];
    for _ in 0..64 {
        if !matches!(stream.read(&mut block), Ok(count) if count > 0) {
            break;
        }
    }
    Ok(())
}
