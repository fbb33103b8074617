//! What is said on the pads, by the plug that charges too: only who rests there hears it, and is heard.

use super::cells::Cells;
use super::planner::Finding;
use super::scheme::Scheme;
use super::wire::Job;
use simbeeotic::units::glam::DVec3;

/// Hive to guest, once, before the first flight.
#[derive(Clone, Debug)]
pub(crate) struct Briefing {
    /// The middle of the pads.
    pub(crate) home: DVec3,
    /// The guest's own spot on it.
    pub(crate) spot: DVec3,
    /// Which of the crew it is, from 0.
    pub(crate) number: u32,
    pub(crate) cells: Cells,
    pub(crate) scheme: Scheme,
    /// Its share of the cells, the nearest first; of no use but in the static scheme.
    pub(crate) share: Vec<u16>,
}

/// Guest to hive: what it found and did since it was here last.
#[derive(Clone, Debug)]
pub(crate) struct Report(pub(crate) Vec<Finding>);

/// Hive to guest: the report is taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Received;

/// Guest to hive: charged, what is there to do?
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ready;

/// Hive to guest: this.
#[derive(Clone, Debug)]
pub(crate) struct Order(pub(crate) Job);
