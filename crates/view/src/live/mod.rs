//! A run as it happens: the component that watches it, and what its pages share.
//!
//! The run's thread does as little as it can: it copies columns (`look`), counts (`series`, `traffic`),
//! and hangs the result into [`Shared`]. All else is done by the pages' own threads (`page`): the newest
//! frame wins, and a page that does not read is sent nothing.
//!
//! When to look is a question of wall time, asked in virtual time: `pace`.

mod browser;
mod details;
mod look;
mod pace;
mod page;
mod series;
mod shared;
mod traffic;
mod viewer;
mod wind;

pub use browser::open_browser;
pub use viewer::{Viewer, ViewerParams};
