//! The program as its users meet it: commands, files, errors, repeatability.

mod about;
mod air;
mod book;
mod bounds;
mod chance;
mod commands;
mod determinism;
mod figures;
mod golden;
mod held;
mod layers;
mod metrics;
mod operator;
mod plot;
mod plot_runs;
mod plot_sweeps;
mod plot_table;
mod program;
mod radio;
mod recorded;
mod shelf;
mod sweep;
mod sweep_resume;
mod view;
mod walls;
mod world;
