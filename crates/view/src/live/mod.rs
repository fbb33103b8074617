//! A run as it happens: the component that watches it, and what its pages share.
//!
//! The run's thread does as little as it can: it copies columns (`look`), counts (`marks`, `statistics`, `traffic`, and
//! `series` beside this module), and hangs the result into `Shared`, where it waits for nobody. All else is done on other
//! threads: the first message (`opening`), and all that a page is told (`page`): the newest frame wins, and a page that
//! does not read is sent nothing.
//!
//! When to look is a question of wall time, asked in virtual time: `pace`.

mod browser;
pub(crate) mod details;
mod look;
mod marks;
mod opening;
mod pace;
mod page;
mod shared;
mod statistics;
mod traffic;
mod viewer;

pub use browser::open_browser;
pub use viewer::{Viewer, ViewerParams};
