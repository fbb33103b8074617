//! Physics against closed forms, against itself, and against what the original got wrong.

mod bounce;
mod closed_forms;
mod determinism;
mod differential;
mod fans;
mod flight;
mod impact;
mod invariance;
mod islands;
mod odometer;
mod original;
mod pairs;
mod piles;
mod properties;
mod queries;
mod refusal;
mod rest;
mod rotation;
mod searches;
mod shapes;
mod slide;
mod time_of_impact;
mod worlds;
