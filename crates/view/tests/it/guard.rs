//! Who is let in, and what a page is.

use crate::client::{Client, connect, raw, until};
use crate::serve;
use simbeeotic_view::server::{Options, PAGES_MAX, Server, ServerError};
use std::net::{IpAddr, SocketAddr};

fn get(at: SocketAddr, path: &str, host: &str) -> String {
    raw(
        at,
        format!("GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n").as_bytes(),
    )
}

fn status(answer: &str) -> &str {
    answer.split(' ').nth(1).unwrap_or("none")
}

#[test]
fn the_page_and_its_files_are_served_and_nothing_else() {
    let (_server, _, at) = serve(0);
    let host = at.to_string();
    for (path, media_type) in [
        ("/", "text/html"),
        ("/index.html", "text/html"),
        ("/page.js", "text/javascript"),
        ("/page.css", "text/css"),
    ] {
        let answer = get(at, path, &host);
        assert_eq!(status(&answer), "200", "{path}");
        assert!(
            answer.contains(&format!("Content-Type: {media_type}")),
            "{path}"
        );
        for line in [
            "X-Content-Type-Options: nosniff",
            "Referrer-Policy: no-referrer",
            "Content-Security-Policy: default-src 'none'",
            "Cache-Control: no-store",
        ] {
            assert!(answer.contains(line), "{path} has no {line}");
        }
        assert!(!answer.contains("Access-Control"), "{path}");
    }
    for path in [
        "/Cargo.toml",
        "/../Cargo.toml",
        "/%2e%2e/",
        "/page.js/",
        "/textures/brick",
    ] {
        assert_eq!(status(&get(at, path, &host)), "404", "{path}");
    }
    let post = raw(
        at,
        format!("POST / HTTP/1.1\r\nHost: {host}\r\n\r\n").as_bytes(),
    );
    assert_eq!(status(&post), "405");
}

#[test]
fn foreign_hosts_are_refused() {
    let (_server, _, at) = serve(0);
    let port = at.port();
    for host in ["evil.example", &format!("evil.example:{port}"), "8.8.8.8"] {
        assert_eq!(status(&get(at, "/", host)), "403", "{host}");
        let origin = format!("http://{host}");
        assert_eq!(connect(at, host, &origin, "").err(), Some(403), "{host}");
    }
    let local = format!("localhost:{port}");
    assert_eq!(status(&get(at, "/", &local)), "200");
    assert!(connect(at, &local, &format!("http://{local}"), "").is_ok());
}

#[test]
fn foreign_origins_are_refused() {
    let (_server, echo, at) = serve(0);
    let host = at.to_string();
    for origin in [
        "http://evil.example",
        "null",
        "http://localhost:1",
        "https://localhost",
    ] {
        assert_eq!(connect(at, &host, origin, "").err(), Some(403), "{origin}");
    }
    let bare = format!(
        "GET /stream HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\
         Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n"
    );
    assert_eq!(status(&raw(at, bare.as_bytes())), "403", "no origin");
    assert_eq!(echo.pauses.load(std::sync::atomic::Ordering::Relaxed), 0);
}

/// A foreign page whose name was made to point here (DNS rebinding) sends that name as host and as origin.
#[test]
fn a_name_that_was_made_to_point_here_is_refused() {
    let (_server, echo, at) = serve(0);
    let rebound = format!("attacker.example:{}", at.port());
    let origin = format!("http://{rebound}");
    assert_eq!(status(&get(at, "/", &rebound)), "403");
    assert_eq!(connect(at, &rebound, &origin, "").err(), Some(403));
    // Nor does the name help as an address in the first line.
    let absolute = format!("GET http://{rebound}/ HTTP/1.1\r\nHost: {rebound}\r\n\r\n");
    assert_eq!(status(&raw(at, absolute.as_bytes())), "403");
    assert_eq!(echo.pauses.load(std::sync::atomic::Ordering::Relaxed), 0);
}

#[test]
fn the_other_loopback_is_served_by_its_own_name() {
    let options = Options {
        address: "::1".parse().expect("an address"),
        port: Some(0),
    };
    let server = match Server::start(options) {
        Ok(server) => server,
        // A machine without IPv6.
        Err(ServerError::NoSuchAddress { .. } | ServerError::Io { .. }) => return,
        Err(error) => panic!("{error}"),
    };
    let at = server.address();
    let host = format!("[::1]:{}", at.port());
    assert_eq!(server.url(), format!("http://{host}/"), "and no token");
    assert_eq!(status(&get(at, "/", &host)), "200");
    assert_eq!(status(&get(at, "/", "[::2]")), "403");
    assert!(connect(at, &host, &format!("http://{host}"), "").is_ok());
    let other = format!("http://127.0.0.1:{}", at.port());
    assert_eq!(connect(at, &host, &other, "").err(), Some(403));
}

#[test]
fn elsewhere_a_token_is_wanted_in_every_request() {
    let all = Options {
        address: IpAddr::from([0, 0, 0, 0]),
        port: Some(0),
    };
    let server = Server::start(all).expect("a free port");
    let at = SocketAddr::from(([127, 0, 0, 1], server.address().port()));
    let url = server.url();
    let token = url.split("token=").nth(1).expect("the address has a token");
    assert_eq!(token.len(), 32);
    let (host, origin) = (at.to_string(), format!("http://{at}"));
    for path in [
        "/",
        "/page.js",
        "/?token=",
        "/?token=00000000000000000000000000000000",
    ] {
        assert_eq!(status(&get(at, path, &host)), "401", "{path}");
    }
    let page = get(at, &format!("/?token={token}"), &host);
    assert_eq!(status(&page), "200");
    assert!(page.contains(&format!("page.js?token={token}")), "{page}");
    for query in ["", "?token=1", &format!("?token={token}0")] {
        assert_eq!(
            connect(at, &host, &origin, query).err(),
            Some(401),
            "{query}"
        );
    }
    assert!(connect(at, &host, &origin, &format!("?token={token}")).is_ok());
}

#[test]
fn the_seventeenth_page_is_refused_until_one_has_gone() {
    let (server, _, at) = serve(0);
    let mut pages: Vec<Client> = (0..PAGES_MAX).map(|_| Client::new(at)).collect();
    let (host, origin) = (at.to_string(), format!("http://{at}"));
    assert_eq!(connect(at, &host, &origin, "").err(), Some(503));
    assert_eq!(server.visitors().now(), PAGES_MAX);
    drop(pages.pop());
    until("its place is free", || server.visitors().now() < PAGES_MAX);
    assert!(connect(at, &host, &origin, "").is_ok());
}

#[test]
fn a_port_that_is_taken_is_named() {
    let (_server, _, at) = serve(0);
    let same = Options {
        port: Some(at.port()),
        ..Options::default()
    };
    let error = Server::start(same).err().expect("it is taken");
    assert!(matches!(error, ServerError::PortInUse { .. }), "{error}");
    assert!(
        error.to_string().contains(&at.port().to_string()),
        "{error}"
    );
    // Without a wish there is always one.
    let [a, b] = [Options::default(), Options::default()].map(Server::start);
    assert!(a.is_ok() && b.is_ok());
}

#[test]
fn a_server_that_is_dropped_closes_its_pages_and_its_port() {
    let (server, _, at) = serve(0);
    let mut page = Client::new(at);
    drop(server);
    assert!(page.hear().is_none());
    until("the port is free", || {
        std::net::TcpListener::bind(at).is_ok()
    });
}
