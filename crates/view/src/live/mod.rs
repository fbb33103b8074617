//! A run as it happens: the component that watches it, and what its pages share.
//!
//! The run's thread does as little as it can: it copies columns (`look`), counts (`traffic`, and `series` beside this module),
//! and hangs the result into `Shared`. All else is done by the pages' own threads (`page`): the newest
//! frame wins, and a page that does not read is sent nothing.
//!
//! When to look is a question of wall time, asked in virtual time: `pace`.

mod browser;
pub(crate) mod details;
mod look;
mod pace;
mod page;
mod shared;
mod traffic;
mod viewer;
mod wind;

pub use browser::open_browser;
pub use viewer::{Viewer, ViewerParams};
