//! The page: a run live, a recording again, pictures and films of both.
//!
//! The page itself is written in TypeScript (`page/`, built into `page/dist`, which is part of the program)
//! and talks to a small server on loopback over one WebSocket. What goes over it: `PROTOCOL.md`.

pub mod live;
pub mod render;
pub mod replay;
mod series;
pub mod server;
pub mod wire;
