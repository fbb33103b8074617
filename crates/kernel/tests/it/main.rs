//! The kernel as a domain sees it. One binary, files by subject.

mod determinism;
mod failures;
mod instants;
mod pacing;
mod queues;
mod script;
mod toy;
