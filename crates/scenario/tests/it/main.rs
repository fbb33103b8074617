//! Scenario and world files as a user writes them, right and wrong.

mod broken;
mod channel;
mod faults;
mod figure12;
mod files;
mod like;
mod objects;
mod originals;
mod placeholders;
mod plans;
mod radios;
mod shelf;
mod shipped;
mod sweeps;
mod worlds;

// The files name parts, and those must be linked.
use simbeeotic_models as _;

use simbeeotic_scenario::{Loaded, Rejected, Request, load_text, render};

pub(crate) const TOML: &str = include_str!("../fixtures/everything.toml");
pub(crate) const XML: &str = include_str!("../fixtures/everything.xml");
pub(crate) const WORLD: &str = include_str!("../fixtures/world.xml");
pub(crate) const FIGURE12: &str = include_str!("../../../../scenarios/figure12.xml");

/// The scenario in a text; panics with its faults if it is wrong.
#[track_caller]
pub(crate) fn good(name: &str, text: &str) -> Loaded {
    match load_text(name, text, &Request::default()) {
        Ok(loaded) => loaded,
        Err(rejected) => panic!("{}", shown(&rejected)),
    }
}

/// The faults of a text as text; panics if there is no error.
#[track_caller]
pub(crate) fn bad(name: &str, text: &str) -> String {
    match load_text(name, text, &Request::default()) {
        Ok(_) => panic!("this should be wrong:\n{text}"),
        Err(rejected) => shown(&rejected),
    }
}

pub(crate) fn shown(rejected: &Rejected) -> String {
    render::faults(&rejected.faults, &rejected.sources, false)
}
