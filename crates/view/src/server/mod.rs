//! The server: the embedded page over HTTP, and a WebSocket for what it shows.
//!
//! Plain threads, one to accept, one for each request, two for each page. It trusts nobody:
//!
//! - it binds to loopback, unless told otherwise, and then every request must carry a token;
//! - a request whose `Host` is not its own (where no token is wanted), or a WebSocket whose `Origin` is not its `Host`, is refused:
//!   a foreign page in the same browser can neither read nor steer;
//! - heads, messages, connections, pages and what waits for each are limited; a page that does not read
//!   is not waited for.
//!
//! Reading order: [`Source`] and [`Page`] (what is served), [`Server`]; then `connection` (one request), `door` (how many),
//! `head` and `guard` (what is let in), `stream` (one page), `assets`.

mod assets;
mod bell;
mod connection;
mod door;
mod guard;
mod head;
mod stream;

pub use bell::Bell;

use crate::wire::{Asked, Message};
use door::Door;
use guard::Guard;
use simbeeotic_record::Attachment;
use simbeeotic_record::stage::TEXTURES;
use std::collections::BTreeMap;
use std::io;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};
use std::thread::JoinHandle;
use std::time::Duration;

/// What a server shows. Called from many threads.
pub trait Source: Send + Sync + 'static {
    /// A page has come. `bell` is to be rung when there is something new for it.
    fn open(&self, bell: Arc<Bell>) -> Box<dyn Page>;

    /// Does at once what concerns all pages: pause, say. `false`: it concerns the page alone.
    ///
    /// # Errors
    /// What is wrong with it, for people.
    fn command(&self, asked: &Asked) -> Result<bool, String>;

    /// A texture file of the world by its name, and its media type.
    fn texture(&self, _name: &str) -> Option<Picture> {
        None
    }
}

/// A media type, and the bytes of a file.
pub type Picture = (&'static str, Arc<[u8]>);

/// The pictures among attached files, by their names as textures.
pub(crate) fn pictures(files: Vec<Attachment>) -> BTreeMap<String, Picture> {
    let known = |said: &str| {
        let mut types = ["image/png", "image/jpeg"].into_iter();
        types.find(|known| *known == said)
    };
    let picture = |file: Attachment| {
        let name = file.name.strip_prefix(TEXTURES)?.to_owned();
        Some((name, (known(&file.media_type)?, file.bytes.into())))
    };
    files.into_iter().filter_map(picture).collect()
}

/// One page that looks at a [`Source`]. Lives on the thread that writes to it.
pub trait Page: Send {
    /// The page has said something; answers go to `out`.
    fn hear(&mut self, asked: Asked, out: &mut Vec<Message>);

    /// Appends what is to be sent now, a few messages at a time. Returns how long to wait if nothing
    /// happens; zero: there is more.
    fn speak(&mut self, out: &mut Vec<Message>) -> Duration;
}

/// The port that is taken if it is free and no other was asked for.
pub const PORT: u16 = 8470;

/// Pages at a time.
pub const PAGES_MAX: usize = 16;

/// Where to serve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The address to bind to. Any but a loopback one needs a token, which the server makes.
    pub address: IpAddr,
    /// The port; 0: any that is free; `None`: [`PORT`] if it is free, else any.
    pub port: Option<u16>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            address: Ipv4Addr::LOCALHOST.into(),
            port: None,
        }
    }
}

/// Why there is no server.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ServerError {
    /// Somebody else has the port.
    #[error("port {port} of {address} is in use; choose another, 0 for any that is free")]
    PortInUse {
        /// The address.
        address: IpAddr,
        /// The port.
        port: u16,
    },
    /// The machine has no such address.
    #[error(
        "{address} is no address of this machine; 127.0.0.1 is, and 0.0.0.0 stands for all of them"
    )]
    NoSuchAddress {
        /// The address.
        address: IpAddr,
    },
    /// Anything else that the operating system says.
    #[error("cannot serve at {address}: {source}")]
    Io {
        /// The address.
        address: SocketAddr,
        /// What it says.
        source: io::Error,
    },
    /// The operating system has no random numbers.
    #[error("no random numbers for a token: {0}")]
    Token(String),
}

/// A server that runs. Dropping it ends it, and closes all pages.
pub struct Server {
    shared: Arc<Shared>,
    accepting: Option<JoinHandle<()>>,
}

/// What all threads of a server share.
struct Shared {
    guard: Guard,
    local: SocketAddr,
    /// Set once; requests that come before are answered by "not yet".
    source: OnceLock<Arc<dyn Source>>,
    /// Pages that are connected.
    pages: AtomicUsize,
    /// Whether there ever was a page.
    visited: AtomicBool,
    closing: AtomicBool,
    door: Door,
}

impl Server {
    /// Binds, and serves from now on. What is shown may be told later: pages wait for it.
    ///
    /// # Errors
    /// See [`ServerError`].
    pub fn start(options: Options) -> Result<Self, ServerError> {
        let listener = bind(options)?;
        let address = SocketAddr::new(options.address, options.port.unwrap_or(PORT));
        let failed = |source| ServerError::Io { address, source };
        let local = listener.local_addr().map_err(failed)?;
        let token = match local.ip().is_loopback() {
            true => None,
            false => Some(guard::token().map_err(ServerError::Token)?),
        };
        let shared = Arc::new(Shared {
            guard: Guard::new(local, token),
            local,
            source: OnceLock::new(),
            pages: AtomicUsize::new(0),
            visited: AtomicBool::new(false),
            closing: AtomicBool::new(false),
            door: Door::default(),
        });
        let thread = {
            let shared = Arc::clone(&shared);
            let builder = std::thread::Builder::new().name("view-accept".to_owned());
            builder.spawn(move || connection::accept(&listener, &shared))
        };
        Ok(Self {
            accepting: Some(thread.map_err(failed)?),
            shared,
        })
    }

    /// Says what is shown. Once: a second time changes nothing.
    pub fn show(&self, source: Arc<dyn Source>) {
        self.screen().show(source);
    }

    /// By which another thread says what is shown.
    pub fn screen(&self) -> Screen {
        Screen(Arc::clone(&self.shared))
    }

    /// The address of the page, with its token if it needs one.
    pub fn url(&self) -> String {
        let shown = match self.shared.local.ip() {
            IpAddr::V4(ip) if ip.is_unspecified() => Ipv4Addr::LOCALHOST.into(),
            IpAddr::V6(ip) if ip.is_unspecified() => std::net::Ipv6Addr::LOCALHOST.into(),
            ip => ip,
        };
        let place = SocketAddr::new(shown, self.shared.local.port());
        match self.shared.guard.token() {
            None => format!("http://{place}/"),
            Some(token) => format!("http://{place}/?token={token}"),
        }
    }

    /// Where it listens.
    pub fn address(&self) -> SocketAddr {
        self.shared.local
    }

    /// How it is watched, from any thread.
    pub fn visitors(&self) -> Visitors {
        Visitors(Arc::clone(&self.shared))
    }
}

/// Where a server's source is shown.
#[derive(Clone)]
pub struct Screen(Arc<Shared>);

impl Screen {
    /// Says what is shown. Once: a second time changes nothing.
    pub fn show(&self, source: Arc<dyn Source>) {
        let _ = self.0.source.set(source);
    }
}

/// Who looks at a server's page.
#[derive(Clone)]
pub struct Visitors(Arc<Shared>);

impl Visitors {
    /// How the page is reached from other machines, if the server listens at all addresses of this one.
    pub fn elsewhere(&self) -> Option<String> {
        let (local, token) = (self.0.local, self.0.guard.token()?);
        local.ip().is_unspecified().then(|| {
            let port = local.port();
            format!("http://<this machine's address>:{port}/?token={token}")
        })
    }

    /// Pages that are connected.
    pub fn now(&self) -> usize {
        self.0.pages.load(Ordering::Relaxed)
    }

    /// Whether there ever was one.
    pub fn ever(&self) -> bool {
        self.0.visited.load(Ordering::Relaxed)
    }

    /// Waits until there was a page and none is left, or until `enough` says so; a page that is loaded
    /// anew is waited for. `enough` is asked ten times a second.
    pub fn wait_for_the_last(&self, mut enough: impl FnMut() -> bool) {
        const LOOK: Duration = Duration::from_millis(100);
        const RELOAD: u32 = 20;
        let mut alone = 0;
        while !enough() && alone < RELOAD {
            std::thread::sleep(LOOK);
            alone = match self.ever() && self.now() == 0 {
                true => alone + 1,
                false => 0,
            };
        }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.shared.closing.store(true, Ordering::Relaxed);
        self.shared.door.close_all();
        // Wakes the thread that accepts; if that fails, it ends with the program.
        let ip = match self.shared.local.ip() {
            IpAddr::V4(ip) if ip.is_unspecified() => Ipv4Addr::LOCALHOST.into(),
            IpAddr::V6(ip) if ip.is_unspecified() => std::net::Ipv6Addr::LOCALHOST.into(),
            ip => ip,
        };
        let place = SocketAddr::new(ip, self.shared.local.port());
        let woken = TcpStream::connect_timeout(&place, Duration::from_secs(1)).is_ok();
        if let Some(thread) = self.accepting.take().filter(|_| woken) {
            let _ = thread.join();
        }
    }
}

/// An address as users write it: `127.0.0.1`, `::1`, `0.0.0.0`, `localhost`.
///
/// # Errors
/// What it must be.
pub fn address_of(text: &str) -> Result<IpAddr, String> {
    match text {
        "localhost" => Ok(Ipv4Addr::LOCALHOST.into()),
        text => text.parse().map_err(|_| {
            "must be an address of this machine, such as 127.0.0.1, ::1, or 0.0.0.0 for all"
                .to_owned()
        }),
    }
}

fn bind(options: Options) -> Result<TcpListener, ServerError> {
    let Options { address, port } = options;
    let first = TcpListener::bind((address, port.unwrap_or(PORT)));
    let result = match (first, port) {
        (Err(_), None) => TcpListener::bind((address, 0)),
        (first, _) => first,
    };
    result.map_err(|source| match source.kind() {
        io::ErrorKind::AddrInUse => ServerError::PortInUse {
            address,
            port: port.unwrap_or(PORT),
        },
        io::ErrorKind::AddrNotAvailable => ServerError::NoSuchAddress { address },
        _ => ServerError::Io {
            address: SocketAddr::new(address, port.unwrap_or(PORT)),
            source,
        },
    })
}
