//! The program as its users meet it: commands, files, errors, repeatability.

mod bounds;
mod commands;
mod determinism;
mod program;
mod shelf;
