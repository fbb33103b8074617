//! Garbage, floods, and pages that do not read: the next page is served all the same.

use crate::client::{Client, raw, until};
use crate::serve;
use proptest::prelude::*;
use simbeeotic_view::server::PAGES_MAX;
use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::atomic::Ordering;
use std::time::Duration;
use tungstenite::Message;

/// A WebSocket that is open, and its bytes.
fn open(at: SocketAddr) -> TcpStream {
    let mut stream = TcpStream::connect(at).expect("the server accepts");
    let head = format!(
        "GET /stream HTTP/1.1\r\nHost: {at}\r\nOrigin: http://{at}\r\nUpgrade: websocket\r\n\
         Connection: keep-alive, Upgrade\r\nSec-WebSocket-Version: 13\r\n\
         Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
    );
    stream.write_all(head.as_bytes()).expect("it is open");
    let mut answer = [0; 129];
    stream.read_exact(&mut answer).expect("an answer");
    let answer = String::from_utf8_lossy(&answer);
    assert!(answer.contains("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), "{answer}");
    stream
}

/// The server answers a page as if nothing had been.
fn is_well(at: SocketAddr) {
    let mut page = Client::new(at);
    page.say(r#"{"type":"fetch","id":42,"from_s":0,"to_s":1,"step_s":0}"#);
    assert_eq!(page.hear_a("fetched")["id"], 42);
}

#[test]
fn what_is_said_wrongly_is_answered_and_the_connection_goes_on() {
    let (_server, echo, at) = serve(0);
    let mut page = Client::new(at);
    for text in [
        r#"{"type":"stop"}"#,
        r#"{"type":"resume"}"#,
        r#"{"type":"select"}"#,
        "1",
        "[]",
    ] {
        page.say(text);
        let error = page.hear_a("error");
        assert!(
            error["text"].as_str().is_some_and(|t| !t.is_empty()),
            "{text}"
        );
    }
    page.say(r#"{"type":"pause"}"#);
    until("it is heard", || echo.pauses.load(Ordering::Relaxed) == 1);
    page.say(r#"{"type":"fetch","id":1,"from_s":0,"to_s":1,"step_s":0}"#);
    page.hear_a("fetched");
}

#[test]
fn no_json_binary_and_long_messages_close_the_connection() {
    let (_server, _, at) = serve(0);
    for message in [
        Message::text("hello"),
        Message::text(""),
        Message::binary(vec![1, 2, 3]),
        Message::text(format!("\"{}\"", "x".repeat(64 * 1024))),
    ] {
        let mut page = Client::new(at);
        page.0.send(message).expect("it is open");
        assert_eq!(page.hear_a("error")["type"], "error");
        assert!(page.hear().is_none(), "it is closed");
    }
    is_well(at);
}

#[test]
fn a_message_in_a_thousand_pieces_is_limited_too() {
    let (_server, _, at) = serve(0);
    let mut stream = open(at);
    // Masked frames of 1 KiB that never end: text first, then more of it.
    let frame = |opcode: u8| {
        let mut bytes = vec![opcode, 0x80 | 126, 4, 0, 0, 0, 0, 0];
        bytes.extend([b' '; 1024]);
        bytes
    };
    let mut sent = 0;
    stream.write_all(&frame(1)).expect("it is open");
    while sent < 1_000_000 && stream.write_all(&frame(0)).is_ok() {
        sent += 1;
        std::thread::sleep(Duration::from_micros(200));
    }
    assert!(sent < 100_000, "it was never closed");
    is_well(at);
}

#[test]
fn a_head_without_end_is_cut_off() {
    let (_server, _, at) = serve(0);
    let long = format!("GET / HTTP/1.1\r\nHost: {at}\r\nA: {}", "b".repeat(9000));
    assert!(raw(at, long.as_bytes()).starts_with("HTTP/1.1 431"));
    is_well(at);
}

#[test]
fn connections_that_say_nothing_keep_nobody_out() {
    let (_server, _, at) = serve(0);
    let silent: Vec<TcpStream> = (0..100)
        .map(|_| TcpStream::connect(at).expect("the server accepts"))
        .collect();
    is_well(at);
    drop(silent);
}

#[test]
fn heads_that_come_letter_by_letter_keep_nobody_out() {
    let (_server, _, at) = serve(0);
    let mut slow: Vec<TcpStream> = (0..100)
        .map(|_| TcpStream::connect(at).expect("the server accepts"))
        .collect();
    for letter in b"GET / HTTP/1.1\r\nHost:" {
        for stream in &mut slow {
            // Some have been closed to make room.
            let _ = stream.write_all(&[*letter]);
        }
    }
    is_well(at);
    drop(slow);
}

#[test]
fn pages_that_say_no_more_or_vanish_give_their_places_back() {
    let (server, _, at) = serve(0);
    let half: Vec<TcpStream> = (0..PAGES_MAX).map(|_| open(at)).collect();
    until("they are pages", || server.visitors().now() == PAGES_MAX);
    for stream in &half {
        stream
            .shutdown(std::net::Shutdown::Write)
            .expect("it is open");
    }
    until("the half open have gone", || server.visitors().now() == 0);
    is_well(at);
    drop(half);
    // With bytes that nobody read: the operating system says that they are gone, and not politely.
    let (server, _, at) = serve(1 << 16);
    let reset: Vec<TcpStream> = (0..PAGES_MAX).map(|_| open(at)).collect();
    until("they are pages", || server.visitors().now() == PAGES_MAX);
    drop(reset);
    until("they have gone", || server.visitors().now() == 0);
}

#[test]
fn a_flood_of_connections_is_turned_away_and_passes() {
    let (_server, _, at) = serve(0);
    let mut flood: Vec<TcpStream> = Vec::new();
    for _ in 0..300 {
        if let Ok(stream) = TcpStream::connect(at) {
            flood.push(stream);
        }
    }
    drop(flood);
    until("places are free again", || {
        raw(
            at,
            format!("GET / HTTP/1.1\r\nHost: {at}\r\n\r\n").as_bytes(),
        )
        .contains("200 OK")
    });
    is_well(at);
}

#[test]
fn nothing_piles_up_for_a_page_that_does_not_read() {
    const FRAME: usize = 1 << 20;
    let (_server, echo, at) = serve(FRAME);
    let stream = open(at);
    until("it is sent something", || {
        echo.made.load(Ordering::Relaxed) > 0
    });
    // What the operating system takes, and no more.
    let mut before = 0;
    until("it is not written to any more", || {
        std::thread::sleep(Duration::from_millis(300));
        let made = echo.made.load(Ordering::Relaxed);
        std::mem::replace(&mut before, made) == made
    });
    let made = echo.made.load(Ordering::Relaxed);
    assert!(
        made < 40 << 20,
        "{made} bytes were made for a page that reads nothing"
    );
    // Others are served meanwhile.
    let mut other = Client::new(at);
    assert!(matches!(other.0.read(), Ok(Message::Binary(bytes)) if bytes.len() == FRAME));
    drop(stream);
}

#[test]
fn pings_without_end_do_not_pile_up() {
    let (_server, _, at) = serve(0);
    let mut stream = open(at);
    let ping: Vec<u8> = [0x89, 0x80 | 4, 1, 2, 3, 4, 1, 2, 3, 4].repeat(1000);
    stream
        .set_write_timeout(Some(Duration::from_secs(2)))
        .expect("a timeout");
    for _ in 0..1000 {
        if stream.write_all(&ping).is_err() {
            break;
        }
    }
    is_well(at);
}

#[test]
fn an_unmasked_frame_and_a_huge_length_end_the_connection() {
    let (_server, _, at) = serve(0);
    let huge = [&[0x81, 0xff][..], &u64::MAX.to_be_bytes(), &[0; 4]].concat();
    let large = [&[0x82, 0xff][..], &(1_u64 << 40).to_be_bytes(), &[0; 4]].concat();
    let unmasked = b"\x81\x05hello".to_vec();
    let reserved = vec![0xf3, 0x80, 0, 0, 0, 0];
    for bytes in [huge, large, unmasked, reserved] {
        let mut stream = open(at);
        stream.write_all(&bytes).expect("it is open");
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        assert!(answer.len() < 1000);
    }
    is_well(at);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn any_bytes_are_survived(bytes in prop::collection::vec(any::<u8>(), 0..2000), close in any::<bool>()) {
        let (_server, _, at) = serve(0);
        let mut stream = TcpStream::connect(at).expect("the server accepts");
        let _ = stream.write_all(&bytes);
        if close {
            let _ = stream.shutdown(std::net::Shutdown::Write);
        }
        is_well(at);
    }

    #[test]
    fn any_frames_are_survived(
        frames in prop::collection::vec((any::<u8>(), any::<u8>(), prop::collection::vec(any::<u8>(), 0..200)), 1..20)
    ) {
        let (_server, _, at) = serve(0);
        let mut stream = open(at);
        for (first, length, rest) in frames {
            let _ = stream.write_all(&[first, length]);
            let _ = stream.write_all(&rest);
        }
        is_well(at);
    }
}
