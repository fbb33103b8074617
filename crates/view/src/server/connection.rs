//! One connection: a request, and its answer or a page.

use super::door::Door;
use super::guard::Refusal;
use super::head::{Head, NoHead};
use super::{PAGES_MAX, Shared, assets, stream};
use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// What a connection's thread needs on its stack at most.
pub(super) const STACK: usize = 512 * 1024;

/// How long an answer may take, and a page that reads nothing.
pub(super) const WRITE_TIME: Duration = Duration::from_secs(20);

/// A connection that is open; forgotten when it is dropped.
struct Entry<'a> {
    door: &'a Door,
    number: u64,
}

impl Drop for Entry<'_> {
    fn drop(&mut self) {
        self.door.forget(self.number);
    }
}

/// One of a limited number; given back when it is dropped.
struct Place<'a>(&'a AtomicUsize);

impl<'a> Place<'a> {
    fn take(count: &'a AtomicUsize, most: usize) -> Option<Self> {
        let taken = count.fetch_update(Ordering::AcqRel, Ordering::Acquire, |n| {
            (n < most).then(|| n + 1)
        });
        // Made only if it was taken: it is given back when it is dropped.
        taken.is_ok().then(|| Self(count))
    }
}

impl Drop for Place<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::AcqRel);
    }
}

/// Accepts connections until the server is dropped.
pub(super) fn accept(listener: &TcpListener, shared: &Arc<Shared>) {
    loop {
        let accepted = listener.accept();
        if shared.closing.load(Ordering::Relaxed) {
            return;
        }
        let Ok((stream, peer)) = accepted else {
            // Out of files, say: others may close theirs.
            std::thread::sleep(Duration::from_millis(20));
            continue;
        };
        let Some(number) = shared.door.open(&stream, peer.ip()) else {
            turn_away(&stream);
            continue;
        };
        let door = &shared.door;
        let shared = Arc::clone(shared);
        let builder = std::thread::Builder::new();
        let spawned = builder
            .name("view-page".to_owned())
            .stack_size(STACK)
            .spawn(move || {
                let entry = Entry {
                    door: &shared.door,
                    number,
                };
                serve(stream, &shared, &entry);
            });
        if spawned.is_err() {
            // No thread to be had: the connection is closed.
            door.forget(number);
        }
    }
}

/// Too many: an answer that waits for nothing.
fn turn_away(mut stream: &TcpStream) {
    let _ = stream.set_nonblocking(true);
    let text = "too many connections\n";
    let head = assets::answer(503, "text/plain", text.len(), None);
    let _ = stream.write(format!("{head}{text}").as_bytes());
}

/// Answers one request.
fn serve(mut stream: TcpStream, shared: &Arc<Shared>, entry: &Entry<'_>) {
    let _ = stream.set_nodelay(true);
    let _ = stream.set_write_timeout(Some(WRITE_TIME));
    let head = match Head::read(&mut stream) {
        Ok(head) => head,
        Err(NoHead::Gone) => return,
        Err(NoHead::TooLong) => return refuse(stream, (431, "this head is too long")),
        Err(NoHead::Garbage) => return refuse(stream, (400, "this is no request")),
    };
    if let Err(refusal) = shared.guard.admit(&head) {
        return refuse(stream, refusal);
    }
    entry.door.admitted(entry.number);
    if head.path == "/stream" {
        return match welcome(&head, shared) {
            Ok(place) => {
                stream::talk(stream, &head, shared);
                drop(place);
            }
            Err(refusal) => refuse(stream, refusal),
        };
    }
    let source = shared.source.get();
    let texture = || {
        let (media_type, bytes) = source?.texture(&assets::texture(&head)?)?;
        Some((media_type, bytes.to_vec()))
    };
    match assets::file(&head.path, shared.guard.token()).or_else(texture) {
        Some((media_type, bytes)) => {
            let answer = assets::answer(200, media_type, bytes.len(), head.only("host"));
            send(stream, answer.as_bytes(), &bytes);
        }
        None => refuse(stream, (404, "there is no such file; the page is at /")),
    }
}

/// Whether this becomes a page.
fn welcome<'a>(head: &Head, shared: &'a Shared) -> Result<Place<'a>, Refusal> {
    shared.guard.admit_page(head)?;
    let asks = head.lists("connection", "upgrade")
        && head.lists("upgrade", "websocket")
        && head.only("sec-websocket-version") == Some("13")
        && head
            .only("sec-websocket-key")
            .is_some_and(|key| key.len() == 24);
    if !asks {
        return Err((426, "this is a WebSocket, version 13"));
    }
    let place = Place::take(&shared.pages, PAGES_MAX)
        .ok_or((503, "too many pages look at this run: close one"))?;
    shared.visited.store(true, Ordering::Relaxed);
    Ok(place)
}

fn refuse(stream: TcpStream, (status, text): Refusal) {
    let text = format!("{text}\n");
    let answer = assets::answer(status, "text/plain; charset=utf-8", text.len(), None);
    send(stream, answer.as_bytes(), text.as_bytes());
}

/// Sends an answer, and lets the other side read it: a socket that is closed with unread bytes in it
/// takes back what was sent.
fn send(mut stream: TcpStream, head: &[u8], body: &[u8]) {
    if write_within(&stream, &[head, body].concat(), WRITE_TIME).is_err() {
        return;
    }
    let _ = stream.shutdown(Shutdown::Write);
    let _ = stream.set_read_timeout(Some(Duration::from_millis(500)));
    let mut block = [0; 1024];
    for _ in 0..64 {
        match stream.read(&mut block) {
            Ok(count) if count > 0 => {}
            _ => return,
        }
    }
}

/// Writes all of it, or gives up when the time is over, however slowly it is read.
#[allow(
    clippy::disallowed_methods,
    reason = "how long a stranger may hold a thread is wall time"
)]
fn write_within(mut stream: &TcpStream, bytes: &[u8], time: Duration) -> io::Result<()> {
    let begun = Instant::now();
    let mut left = bytes;
    while !left.is_empty() {
        let time = time.saturating_sub(begun.elapsed());
        if time.is_zero() {
            return Err(io::ErrorKind::TimedOut.into());
        }
        stream.set_write_timeout(Some(time))?;
        match stream.write(left) {
            Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
            Ok(count) => left = &left[count..],
            Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
            Err(e) => return Err(e),
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_reads_a_byte_now_and_then_holds_an_answer_no_longer_than_who_reads_none() {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
        let at = listener.local_addr().expect("it is bound");
        let mut reader = TcpStream::connect(at).expect("it listens");
        let (stream, _) = listener.accept().expect("somebody comes");
        let trickle = std::thread::spawn(move || {
            let mut byte = [0; 4096];
            for _ in 0..50 {
                let _ = reader.read(&mut byte);
                std::thread::sleep(Duration::from_millis(20));
            }
        });
        let much = vec![7; 64 << 20];
        let written = write_within(&stream, &much, Duration::from_millis(300));
        assert!(written.is_err());
        drop(stream);
        assert!(trickle.join().is_ok());
    }

    #[test]
    fn who_finds_no_place_gives_none_back() {
        let count = AtomicUsize::new(0);
        let first = Place::take(&count, 1);
        assert!(first.is_some());
        assert!(Place::take(&count, 1).is_none());
        assert!(Place::take(&count, 1).is_none());
        assert_eq!(count.load(Ordering::Relaxed), 1);
        drop(first);
        assert_eq!(count.load(Ordering::Relaxed), 0);
        assert!(Place::take(&count, 1).is_some());
    }
}
