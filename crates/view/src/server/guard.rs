//! Who is let in: hosts, origins, tokens.

use super::head::Head;
use std::net::{IpAddr, SocketAddr};

/// Why a request is refused: a status and a line for people.
pub(super) type Refusal = (u16, &'static str);

/// What a request must have.
pub(super) struct Guard {
    bound: IpAddr,
    token: Option<String>,
}

impl Guard {
    pub(super) fn new(bound: SocketAddr, token: Option<String>) -> Self {
        Self {
            bound: bound.ip(),
            token,
        }
    }

    pub(super) fn token(&self) -> Option<&str> {
        self.token.as_deref()
    }

    /// Looks at any request.
    pub(super) fn admit(&self, head: &Head) -> Result<(), Refusal> {
        if head.method != "GET" {
            return Err((405, "only GET is answered here"));
        }
        let host = head.only("host").ok_or((400, "one Host is wanted"))?;
        let name = name_in(host).ok_or((403, "this Host is none"))?;
        // Whoever has the token may use any name of this machine: a foreign page has none.
        if self.token.is_none() && !self.is_own(name) {
            return Err((
                403,
                "this server does not go by this name: use the address that it printed",
            ));
        }
        match &self.token {
            Some(token) if !head.query("token").is_some_and(|said| same(said, token)) => Err((
                401,
                "the token is missing or wrong: use the whole address that the program printed",
            )),
            _ => Ok(()),
        }
    }

    /// Looks at a request for a WebSocket, which [`admit`](Self::admit) let in: a browser sends it for any
    /// page, and says which.
    pub(super) fn admit_page(&self, head: &Head) -> Result<(), Refusal> {
        let own = head.only("host").map(|host| format!("http://{host}"));
        match (head.only("origin"), own) {
            (Some(origin), Some(own)) if origin.eq_ignore_ascii_case(&own) => Ok(()),
            _ => Err((403, "this server talks to its own page only")),
        }
    }

    /// A name of this machine that no foreign name server can give out: loopback, or the bound address.
    fn is_own(&self, name: &str) -> bool {
        name.eq_ignore_ascii_case("localhost")
            || name
                .parse::<IpAddr>()
                .is_ok_and(|ip| ip.is_loopback() || ip == self.bound)
    }
}

/// The name in a `Host`, if it is one: it comes back in the head of the answer. With any port: a tunnel may
/// have another.
fn name_in(host: &str) -> Option<&str> {
    let (name, port) = match host.strip_prefix('[') {
        Some(rest) => rest.split_once(']')?,
        None => host.split_at(host.find(':').unwrap_or(host.len())),
    };
    let port_is_one = match port.strip_prefix(':') {
        Some(digits) => digits.parse::<u16>().is_ok(),
        None => port.is_empty(),
    };
    let allowed = |c: char| c.is_ascii_alphanumeric() || "-._:".contains(c);
    (port_is_one && !name.is_empty() && name.chars().all(allowed)).then_some(name)
}

/// 128 random bits as text.
pub(super) fn token() -> Result<String, String> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|e| e.to_string())?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Compares all of it, whatever differs first.
fn same(said: &str, token: &str) -> bool {
    let pairs = said.bytes().zip(token.bytes());
    let differ = pairs.fold(0, |bits, (a, b)| bits | (a ^ b));
    said.len() == token.len() && std::hint::black_box(differ) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guard(bound: &str, token: Option<&str>) -> Guard {
        Guard::new(bound.parse().expect("an address"), token.map(str::to_owned))
    }

    fn head(target: &str, lines: &[&str]) -> Head {
        let text = format!("GET {target} HTTP/1.1\r\n{}\r\n\r\n", lines.join("\r\n"));
        Head::parse(text.as_bytes()).expect("a head")
    }

    fn code(guard: &Guard, target: &str, lines: &[&str]) -> u16 {
        guard
            .admit(&head(target, lines))
            .map_or_else(|(code, _)| code, |()| 200)
    }

    #[test]
    fn names_of_loopback_are_let_in_and_foreign_ones_are_not() {
        let guard = guard("127.0.0.1:8470", None);
        let code = |host: &str| code(&guard, "/", &[&format!("Host: {host}")]);
        for host in [
            "localhost:8470",
            "LOCALHOST",
            "127.0.0.1:8470",
            "127.0.0.1:9000",
            "[::1]:8470",
        ] {
            assert_eq!(code(host), 200, "{host}");
        }
        for host in [
            "evil.example:8470",
            "localhost.evil.example",
            "127.0.0.1.evil.example",
            "192.168.0.7:8470",
            "[::1",
            "localhost:x",
            "",
        ] {
            assert_eq!(code(host), 403, "{host}");
        }
        assert_eq!(super::tests::code(&guard, "/", &["A: b"]), 400);
        let twice = ["Host: localhost", "Host: evil.example"];
        assert_eq!(super::tests::code(&guard, "/", &twice), 400);
    }

    #[test]
    fn elsewhere_the_token_is_wanted() {
        let guard = guard("192.168.0.7:8470", Some("0123"));
        let own = ["Host: 192.168.0.7:8470"];
        assert_eq!(code(&guard, "/?token=0123", &own), 200);
        assert_eq!(code(&guard, "/page.js?x=1&token=0123", &own), 200);
        for target in [
            "/",
            "/?token=0124",
            "/?token=012",
            "/?token=01234",
            "/?token=",
        ] {
            assert_eq!(code(&guard, target, &own), 401, "{target}");
        }
        // With it, by any name: the machine's own name, say.
        let named = |host: &str| code(&guard, "/?token=0123", &[&format!("Host: {host}")]);
        assert_eq!(named("cluster.example:8470"), 200);
        for host in ["a; script-src *", "a b", "", "a:x", "[::1"] {
            assert_eq!(named(host), 403, "{host}");
        }
        assert_eq!(code(&guard, "/", &["Host: cluster.example"]), 401);
    }

    #[test]
    fn a_page_must_be_our_own() {
        let guard = guard("127.0.0.1:8470", None);
        let admitted = |lines: &[&str]| guard.admit_page(&head("/stream", lines)).is_ok();
        let host = "Host: localhost:8470";
        assert!(admitted(&[host, "Origin: http://localhost:8470"]));
        assert!(!admitted(&[host]));
        for origin in [
            "http://evil.example",
            "https://localhost:8470",
            "http://localhost:3000",
            "http://localhost:8470.evil.example",
            "null",
        ] {
            assert!(!admitted(&[host, &format!("Origin: {origin}")]), "{origin}");
        }
    }

    #[test]
    fn tokens_are_long_and_never_the_same() {
        let [a, b] = [token(), token()].map(|token| token.expect("random numbers"));
        assert_eq!((a.len(), b.len()), (32, 32));
        assert_ne!(a, b);
    }
}
