//! Physics against closed forms, against itself, and against what the original got wrong.

mod bounce;
mod flight;
mod impact;
mod invariance;
mod original;
mod pairs;
mod piles;
mod refusal;
mod rotation;
mod slide;
mod worlds;
