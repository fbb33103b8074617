//! `bench`: the paper's experiments on this machine.
//!
//! An experiment is a table of runs: figures 7 and 8 by the size of the swarm, figure 6 by the number
//! of obstacles. Machines are busy with other things too, so each row is run several times, not one row
//! after the other but round by round, and the least of each figure is told: what was added by others
//! is never negative. Ratios between rows of one table then hold where seconds do not. Runs of a row
//! differ in nothing, so their trace hashes must not either; if they do, that is the result.
//!
//! `radio` is no experiment of the paper. It does not measure the machine but the air: what it lets
//! through, to be held against what others say.
//!
//! Reading order: `workload` (what flies, and one run of it), `process` (what the operating system
//! counts), `table`; then the experiments, each with its arguments.

mod fig6;
mod fig7;
mod fig8;
mod process;
mod radio;
mod table;
mod workload;

use super::{Failure, arguments, input, remark, say, show};
use clap::{Args, Subcommand};

/// Which experiment.
#[derive(Subcommand)]
pub(super) enum Experiment {
    /// Figure 6: 32 bees, and ever more obstacles
    Fig6(fig6::Options),
    /// Figure 7: ever more bees
    Fig7(fig7::Options),
    /// Figure 8: ever more bees that all talk and listen
    Fig8(fig8::Options),
    /// What gets through on one IEEE 802.15.4 channel: broadcasts on a topology from a file
    Radio(radio::Options),
}

pub(super) fn bench(experiment: &Experiment) -> Result<(), Failure> {
    match experiment {
        Experiment::Fig6(options) => fig6::fig6(options),
        Experiment::Fig7(options) => fig7::fig7(options),
        Experiment::Fig8(options) => fig8::fig8(options),
        Experiment::Radio(options) => radio::radio(options),
    }
}

/// What every experiment can be asked.
#[derive(Args)]
struct Common {
    /// Timers: all bees at once (aligned), or each at its own time (random)
    #[arg(long, default_value = "aligned", value_parser = ["aligned", "random"])]
    phase: String,
    /// Runs of each row, round by round; the least of each figure is told
    #[arg(long, default_value_t = 3, value_parser = repeats, allow_negative_numbers = true)]
    repeat: u32,
    /// Print the rows as JSON
    #[arg(long)]
    json: bool,
}

fn repeats(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(n) if (1..=1000).contains(&n) => Ok(n),
        _ => Err("a row is run between 1 and 1000 times".to_owned()),
    }
}
