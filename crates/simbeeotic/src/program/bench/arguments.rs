//! What the experiments can be asked.

use super::super::{Failure, arguments, input};
use super::workload::{self, Cost};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// What time is held against virtual time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Clock {
    /// Wall time.
    Wall,
    /// Processor time of the busiest thread; where that is not known, wall time.
    Processor,
}

impl Clock {
    /// What a run took by this clock, s.
    pub(super) fn of(self, cost: &Cost) -> f64 {
        match self {
            Self::Wall => cost.wall_s,
            Self::Processor => cost.busiest_thread_s.unwrap_or(cost.wall_s),
        }
    }

    /// What 100 virtual seconds take by this clock, s: the start of the run once, and the rest as often as it fits.
    pub(super) fn stretched(self, cost: &Cost) -> f64 {
        workload::stretched(self.start_of(cost), self.of(cost), cost.virtual_s)
    }

    /// What the start of a run took by this clock, s.
    pub(super) fn start_of(self, cost: &Cost) -> f64 {
        match (self, cost.busiest_thread_s) {
            (Self::Processor, Some(_)) => cost.start_busiest_s.unwrap_or(0.0),
            _ => cost.start_s,
        }
    }

    /// In words.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Wall => "wall time",
            Self::Processor => "processor time",
        }
    }
}

/// What every experiment can be asked.
#[derive(Args)]
pub(super) struct Common {
    /// The paper's ranges, and its 100 s of virtual time
    #[arg(long)]
    pub(super) full: bool,
    /// Virtual time of each run; the paper's is "100 s"
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(super) duration: Option<String>,
    /// Timers: all bees at once (aligned), or each at its own time (random)
    #[arg(long, default_value = "aligned", value_parser = ["aligned", "random"])]
    pub(super) phase: String,
    /// Runs of each row, round by round; the table tells the least of each figure [default: 3, of
    /// figure 6 7; fewer if --within is not enough]
    #[arg(long, value_parser = repeats, allow_negative_numbers = true)]
    pub(super) repeat: Option<u32>,
    /// What the limit and the plot are of: wall time; or, on a machine that is busy with other things,
    /// processor time of the busiest thread, which is the wall time on processors that are free
    #[arg(long, value_enum, default_value_t = Clock::Wall)]
    pub(super) clock: Clock,
    /// Do not search the soft real-time limit
    #[arg(long)]
    pub(super) no_limit: bool,
    /// Wall time after which no further round is begun, and the search of the limit ends [default: 45 s;
    /// with --full 15 min]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    within: Option<String>,
    /// Folder for the table (CSV and Parquet) and the plot (SVG and PNG) [default: out/ and the figure's
    /// name]
    #[arg(long, short, value_name = "FOLDER")]
    pub(super) output: Option<PathBuf>,
    /// Go on with a bench that was broken off: what it measured is beside the table, and not run again. The
    /// program, the machine and what is run must be the same
    #[arg(long, conflicts_with_all = ["restart", "no_files"])]
    pub(super) resume: bool,
    /// Measure all of it, although there is a bench that was broken off
    #[arg(long)]
    pub(super) restart: bool,
    /// Write no files
    #[arg(long, conflicts_with = "output")]
    pub(super) no_files: bool,
    /// Print the rows and the limits as JSON
    #[arg(long)]
    pub(super) json: bool,
    /// How the program calls itself: one run, LINE:SIZE or LINE:SIZE:WALL_S, told as JSON
    #[arg(long, hide = true)]
    pub(super) alone: Option<String>,
}

impl Common {
    /// Virtual time of each run, s.
    pub(super) fn duration_s(&self, or: &str) -> Result<f64, Failure> {
        let text = self.duration.as_deref().unwrap_or(or);
        input::time("--duration", text).map(|time| time.secs())
    }

    /// Where the files of a figure go.
    pub(super) fn folder(&self, figure: &str) -> PathBuf {
        let chosen = self.output.clone();
        chosen.unwrap_or_else(|| PathBuf::from("out").join(figure))
    }

    /// Wall time for repeats and the limit, s.
    pub(super) fn within_s(&self) -> Result<f64, Failure> {
        let or = if self.full { "15 min" } else { "45 s" };
        let text = self.within.as_deref().unwrap_or(or);
        input::time("--within", text).map(|time| time.secs())
    }
}

pub(super) fn repeats(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(n) if (1..=1000).contains(&n) => Ok(n),
        _ => Err("a row is run between 1 and 1000 times".to_owned()),
    }
}

/// What experiments with ever larger swarms can be asked.
#[derive(Args)]
pub(super) struct Swarms {
    /// Swarm sizes [default: see below]
    #[arg(
        long,
        value_delimiter = ',',
        value_parser = arguments::swarm_size,
        allow_negative_numbers = true
    )]
    n: Vec<u32>,
    /// Threads that run models; of several, as 1,2, each swarm is run with each, and compared
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "1",
        value_parser = arguments::threads,
        allow_negative_numbers = true
    )]
    threads: Vec<usize>,
    /// Start: paper (random in a 20 m cube) or density (as much room for each bee in any swarm: 8 cubic
    /// metres in figure 7, 100 square metres of a plane in figure 8)
    #[arg(long, default_value = "paper", value_parser = ["paper", "density"])]
    pub(super) start: String,
    #[command(flatten)]
    pub(super) common: Common,
}

impl Swarms {
    /// The numbers of threads asked for, each once.
    pub(super) fn threads(&self) -> Vec<usize> {
        once(&self.threads)
    }

    /// Whether the sizes are the experiment's own.
    pub(super) fn is_ladder(&self) -> bool {
        self.n.is_empty()
    }

    /// The sizes asked for, or else these: from small to large, each once.
    pub(super) fn sizes(&self, quick: &[u32], full: &[u32]) -> Vec<u32> {
        sizes(&self.n, self.common.full, quick, full)
    }
}

/// What was asked for, in its order, each once.
pub(super) fn once<T: PartialEq + Clone>(asked: &[T]) -> Vec<T> {
    let mut each: Vec<T> = Vec::new();
    for value in asked {
        if !each.contains(value) {
            each.push(value.clone());
        }
    }
    each
}

/// The numbers asked for, or else those of the quick or the full experiment: from small to large, each
/// once.
pub(super) fn sizes(asked: &[u32], whole: bool, quick: &[u32], full: &[u32]) -> Vec<u32> {
    let numbers = match (asked, whole) {
        ([], false) => quick,
        ([], true) => full,
        (asked, _) => asked,
    };
    let mut numbers = numbers.to_vec();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

#[cfg(test)]
mod tests {
    use super::super::workload::tests::cost;
    use super::*;

    #[test]
    fn the_processors_clock_is_the_busiest_threads_or_else_the_walls() {
        let mut run = cost(4.0, "a");
        assert_eq!(Clock::Wall.of(&run), 4.0);
        assert_eq!(Clock::Processor.of(&run), 4.0);
        run.busiest_thread_s = Some(3.0);
        assert_eq!(
            (Clock::Processor.of(&run), Clock::Wall.of(&run)),
            (3.0, 4.0)
        );
    }

    #[test]
    fn by_each_clock_the_start_is_its_own() {
        let mut run = cost(4.0, "a");
        run.start_s = 2.0;
        assert_eq!(Clock::Wall.stretched(&run), 22.0);
        assert_eq!(Clock::Processor.stretched(&run), 22.0);
        run.busiest_thread_s = Some(3.0);
        run.start_busiest_s = Some(1.0);
        assert_eq!(Clock::Processor.stretched(&run), 21.0);
        assert_eq!(Clock::Wall.stretched(&run), 22.0);
    }

    #[test]
    fn what_is_asked_for_twice_is_done_once_and_in_its_place() {
        assert_eq!(once(&[2, 1, 2, 1]), [2, 1]);
    }

    #[test]
    fn sizes_are_those_asked_for_or_the_experiments_own() {
        assert_eq!(sizes(&[30, 10, 30], true, &[1], &[2]), [10, 30]);
        assert_eq!(sizes(&[], false, &[1], &[2]), [1]);
        assert_eq!(sizes(&[], true, &[1], &[3, 2]), [2, 3]);
    }
}
