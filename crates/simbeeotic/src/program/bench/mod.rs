//! `bench`: the paper's experiments on this machine.
//!
//! An experiment is a table of runs: figures 7 and 8 by the size of the swarm, figure 6 by the number
//! of obstacles. Machines are busy with other things too, so each row is run several times, not one row
//! after the other but round by round, and the least of each figure is told: what was added by others
//! is never negative. Ratios between rows of one table then hold where seconds do not. Runs of a row
//! differ in nothing, so their trace hashes must not either; if they do, that is the result. Each run has
//! a process of its own, so that the memory it took is its own, too.
//!
//! Then the soft real-time limit is searched: the largest size whose run takes no longer than what it
//! simulates. Table, limit and what the paper says go to CSV, Parquet and a plot.
//!
//! `radio` is no experiment of the paper. It does not measure the machine but the air: what it lets
//! through, to be held against what others say.
//!
//! Reading order: `workload` (what flies, and one run of it), `alone` (that run in its process), `measure`
//! (the rows, and the probes of a limit), `judge` (when runs are enough), `limit` (the search); `process` and `machine` (what the operating
//! system tells), `paper` (its numbers); `unfinished` (what is kept of a bench that is broken off); `table`, `files`, `figure` and `report` (what comes of it); then
//! the experiments, each with its arguments.

mod alone;
mod arguments;
mod fig6;
mod fig7;
mod fig8;
mod figure;
mod files;
mod judge;
mod limit;
mod machine;
mod measure;
mod paper;
mod process;
mod radio;
mod report;
mod table;
mod unfinished;
mod view;
mod workload;

use super::{Failure, input, remark, say, show};
use clap::Subcommand;

/// Which experiment.
#[derive(Subcommand)]
pub(super) enum Experiment {
    /// Figure 6: 32 bees, and ever more obstacles
    #[command(after_help = fig6::HELP)]
    Fig6(fig6::Options),
    /// Figure 7: ever more bees
    #[command(after_help = fig7::HELP)]
    Fig7(fig7::Options),
    /// Figure 8: ever more bees that all talk and listen
    #[command(after_help = fig8::HELP)]
    Fig8(fig8::Options),
    /// What gets through on one IEEE 802.15.4 channel: broadcasts on a topology from a file
    Radio(radio::Options),
    /// What it costs to be looked at: no viewer, one without a page, one with
    View(view::Options),
}

pub(super) fn bench(experiment: &Experiment) -> Result<(), Failure> {
    match experiment {
        Experiment::Fig6(options) => fig6::fig6(options),
        Experiment::Fig7(options) => fig7::fig7(options),
        Experiment::Fig8(options) => fig8::fig8(options),
        Experiment::Radio(options) => radio::radio(options),
        Experiment::View(options) => view::view(options),
    }
}
