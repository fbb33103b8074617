//! A request's head: read within limits of length and time, and taken apart.

use std::io::{self, Read};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// The longest head.
const HEAD_MAX: usize = 8 * 1024;

/// How long a head may take.
pub(super) const HEAD_TIME: Duration = Duration::from_secs(10);

/// Header lines in one head.
const LINES_MAX: usize = 64;

/// A request's head.
#[derive(Debug, Default)]
pub(super) struct Head {
    pub(super) method: String,
    /// Without the query.
    pub(super) path: String,
    query: String,
    /// Names in lower case.
    lines: Vec<(String, String)>,
    /// What came behind it.
    pub(super) rest: Vec<u8>,
}

/// Why there is no head.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum NoHead {
    /// The connection ended, or took too long.
    Gone,
    /// It is longer than it may be.
    TooLong,
    /// It is none.
    Garbage,
}

impl Head {
    /// Reads a head; gives up after [`HEAD_TIME`], however slowly bytes come.
    #[allow(
        clippy::disallowed_methods,
        reason = "how long a stranger may hold a thread is wall time"
    )]
    pub(super) fn read(stream: &mut TcpStream) -> Result<Self, NoHead> {
        let deadline = Instant::now() + HEAD_TIME;
        let mut bytes = Vec::new();
        let mut block = [0; 1024];
        loop {
            let left = deadline.saturating_duration_since(Instant::now());
            if left.is_zero() || stream.set_read_timeout(Some(left)).is_err() {
                return Err(NoHead::Gone);
            }
            match stream.read(&mut block) {
                Ok(0) => return Err(NoHead::Gone),
                Ok(count) => bytes.extend_from_slice(&block[..count]),
                Err(e) if e.kind() == io::ErrorKind::Interrupted => continue,
                Err(_) => return Err(NoHead::Gone),
            }
            match end_of(&bytes) {
                Some(end) if end <= HEAD_MAX => return Self::parse(&bytes),
                Some(_) => return Err(NoHead::TooLong),
                None if bytes.len() > HEAD_MAX => return Err(NoHead::TooLong),
                None => {}
            }
        }
    }

    /// Takes apart what was read, up to and behind the empty line.
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, NoHead> {
        let mut lines = [httparse::EMPTY_HEADER; LINES_MAX];
        let mut request = httparse::Request::new(&mut lines);
        let length = match request.parse(bytes) {
            Ok(httparse::Status::Complete(length)) => length,
            Ok(httparse::Status::Partial) | Err(_) => return Err(NoHead::Garbage),
        };
        let target = request.path.unwrap_or_default();
        let (path, query) = target.split_once('?').unwrap_or((target, ""));
        let lines = request.headers.iter().map(|line| {
            let value = std::str::from_utf8(line.value).map_err(|_| NoHead::Garbage)?;
            Ok((line.name.to_ascii_lowercase(), value.trim().to_owned()))
        });
        Ok(Self {
            method: request.method.unwrap_or_default().to_owned(),
            path: path.to_owned(),
            query: query.to_owned(),
            lines: lines.collect::<Result<_, _>>()?,
            rest: bytes.get(length..).unwrap_or_default().to_vec(),
        })
    }

    /// The value of a header that is there once. Its name is in lower case.
    pub(super) fn only(&self, name: &str) -> Option<&str> {
        let mut found = self.lines.iter().filter(|(key, _)| key == name);
        let (_, value) = found.next()?;
        found.next().is_none().then_some(value.as_str())
    }

    /// Whether a header is a list that has a word in it.
    pub(super) fn lists(&self, name: &str, word: &str) -> bool {
        let lines = self.lines.iter().filter(|(key, _)| key == name);
        let mut words = lines.flat_map(|(_, value)| value.split(','));
        words.any(|said| said.trim().eq_ignore_ascii_case(word))
    }

    /// The value of a key of the query, as it stands there.
    pub(super) fn query(&self, key: &str) -> Option<&str> {
        let mut pairs = self
            .query
            .split('&')
            .filter_map(|pair| pair.split_once('='));
        pairs.find(|(name, _)| *name == key).map(|(_, value)| value)
    }
}

fn end_of(bytes: &[u8]) -> Option<usize> {
    let end = b"\r\n\r\n";
    let found = bytes.windows(end.len()).position(|window| window == end);
    found.map(|at| at + end.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_is_taken_apart() {
        let text = b"GET /stream?a=1&token=xyz HTTP/1.1\r\nHost: localhost\r\nConnection: keep-alive, Upgrade\r\n\r\nmore";
        let head = Head::parse(text).expect("a head");
        assert_eq!(
            (head.method.as_str(), head.path.as_str()),
            ("GET", "/stream")
        );
        assert_eq!(head.query("token"), Some("xyz"));
        assert_eq!(head.query("b"), None);
        assert!(head.lists("connection", "upgrade"));
        assert!(!head.lists("connection", "close"));
        assert_eq!(head.rest, b"more");
    }

    #[test]
    fn garbage_is_no_head() {
        for bytes in [
            &b"\r\n\r\n"[..],
            b"\0\0\0\0\r\n\r\n",
            b"GET\r\n\r\n",
            b"GET / HTTP/9.9\r\n\r\n",
            b"GET / HTTP/1.1\r\nHost: \xff\xfe\r\n\r\n",
            &[
                b"GET / HTTP/1.1\r\n".to_vec(),
                b"A: b\r\n".repeat(100),
                b"\r\n".to_vec(),
            ]
            .concat(),
        ] {
            assert_eq!(Head::parse(bytes).err(), Some(NoHead::Garbage));
        }
    }
}
