//! The server against friends, strangers and garbage.
#![allow(
    clippy::disallowed_methods,
    reason = "how long a server takes is wall time"
)]

mod client;
mod garbage;
mod guard;

use simbeeotic_view::server::{Bell, Options, Page, Server, Source};
use simbeeotic_view::wire::{Asked, Message, Said};
use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// A source that counts what is commanded, answers what is asked, and sends as much as it can.
#[derive(Default)]
pub(crate) struct Echo {
    pauses: AtomicU64,
    /// Bytes of frames made for all pages.
    made: AtomicU64,
    /// The length of a frame; 0: none are sent.
    frame: usize,
}

struct EchoPage(Arc<Echo>);

struct Shared(Arc<Echo>);

impl Source for Shared {
    fn open(&self, _bell: Arc<Bell>) -> Box<dyn Page> {
        Box::new(EchoPage(Arc::clone(&self.0)))
    }

    fn command(&self, asked: &Asked) -> Result<bool, String> {
        match asked {
            Asked::Pause {} => {
                self.0.pauses.fetch_add(1, Ordering::Relaxed);
                Ok(true)
            }
            Asked::Resume {} => Err("it never stood".to_owned()),
            _ => Ok(false),
        }
    }
}

impl Page for EchoPage {
    fn hear(&mut self, asked: Asked, out: &mut Vec<Message>) {
        if let Asked::Fetch { id, .. } = asked {
            out.push(Said::Fetched { id }.message());
        }
    }

    fn speak(&mut self, out: &mut Vec<Message>) -> Duration {
        if self.0.frame == 0 {
            return Duration::from_secs(10);
        }
        self.0
            .made
            .fetch_add(self.0.frame as u64, Ordering::Relaxed);
        out.push(Message::Binary(vec![7; self.0.frame]));
        Duration::ZERO
    }
}

/// A server that sends frames of so many bytes.
pub(crate) fn serve(frame: usize) -> (Server, Arc<Echo>, SocketAddr) {
    let options = Options {
        port: Some(0),
        ..Options::default()
    };
    let server = Server::start(options).expect("a free port");
    let echo = Arc::new(Echo {
        frame,
        ..Echo::default()
    });
    server.show(Arc::new(Shared(Arc::clone(&echo))));
    let at = server.address();
    (server, echo, at)
}
