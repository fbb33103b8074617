//! A browser, as far as the server can see.

use serde_json::Value;
use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::time::{Duration, Instant};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

/// How long a test waits for what must come.
pub(crate) const PATIENCE: Duration = Duration::from_secs(30);

/// A page that is connected.
pub(crate) struct Client(pub(crate) WebSocket<TcpStream>);

/// Asks for the WebSocket, and returns the status if it is refused.
pub(crate) fn connect(
    at: SocketAddr,
    host: &str,
    origin: &str,
    query: &str,
) -> Result<Client, u16> {
    let mut request = format!("ws://{host}/stream{query}")
        .into_client_request()
        .expect("a request");
    request
        .headers_mut()
        .insert("Origin", origin.parse().expect("a header"));
    let stream = TcpStream::connect(at).expect("the server accepts");
    stream.set_read_timeout(Some(PATIENCE)).expect("a timeout");
    match tungstenite::client(request, stream) {
        Ok((socket, _)) => Ok(Client(socket)),
        Err(tungstenite::HandshakeError::Failure(tungstenite::Error::Http(answer))) => {
            Err(answer.status().as_u16())
        }
        Err(other) => panic!("{other}"),
    }
}

impl Client {
    /// Our own page.
    pub(crate) fn new(at: SocketAddr) -> Self {
        let host = at.to_string();
        connect(at, &host, &format!("http://{host}"), "").expect("our own page is let in")
    }

    pub(crate) fn say(&mut self, text: &str) {
        self.0.send(Message::text(text)).expect("it is open");
    }

    /// The next text message; binary ones are skipped.
    pub(crate) fn hear(&mut self) -> Option<Value> {
        let begun = Instant::now();
        while begun.elapsed() < PATIENCE {
            match self.0.read() {
                Ok(Message::Text(text)) => {
                    return Some(serde_json::from_str(&text).expect("the server speaks JSON"));
                }
                Ok(Message::Close(_)) | Err(_) => return None,
                Ok(_) => {}
            }
        }
        None
    }

    /// The next text message of a type.
    pub(crate) fn hear_a(&mut self, kind: &str) -> Value {
        let begun = Instant::now();
        while begun.elapsed() < PATIENCE {
            match self.hear() {
                Some(value) if value["type"] == kind => return value,
                Some(_) => {}
                None => break,
            }
        }
        panic!("no {kind} came");
    }
}

/// Sends bytes, and reads all that comes back.
pub(crate) fn raw(at: SocketAddr, bytes: &[u8]) -> String {
    let mut stream = TcpStream::connect(at).expect("the server accepts");
    stream.set_read_timeout(Some(PATIENCE)).expect("a timeout");
    let _ = stream.write_all(bytes);
    let mut answer = Vec::new();
    let _ = stream.read_to_end(&mut answer);
    String::from_utf8_lossy(&answer).into_owned()
}

/// Waits for something that happens on another thread.
pub(crate) fn until(what: &str, mut is: impl FnMut() -> bool) {
    let begun = Instant::now();
    while !is() {
        assert!(begun.elapsed() < PATIENCE, "it takes too long: {what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}
