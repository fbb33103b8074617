//! What the program can be asked, and the help that teaches it.

use super::bench::Experiment;
use super::plot::{PLOT_EXAMPLES, Plot};
use super::render_arguments::{RENDER_EXAMPLES, RenderOptions};
use super::sweep::{SWEEP_EXAMPLES, SweepOptions};
use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;

/// A simulator and testbed for swarms of micro-aerial vehicles.
///
/// One scenario file puts thousands of flying vehicles, with bodies, sensors and radios, into a
/// 3-D world. The same scenario and the same seed give the same run, to the last bit: the trace
/// hash at the end says so.
#[derive(Parser)]
#[command(name = "simbeeotic", version, after_help = FIRST_STEPS)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Command,
}

const FIRST_STEPS: &str = "\
First steps:
  simbeeotic run scenarios/first-swarm.toml      fly a hundred bees
  simbeeotic run scenarios/first-swarm.toml --view --open
                                                 watch them
  simbeeotic sweep scenarios/first-swarm.toml --seeds 5 --vary \"model.bee.count=50,100,200\"
                                                 fifteen runs, one table
  simbeeotic list                                what a scenario can name
  simbeeotic describe instrument-bee             a part's parameters, with units and defaults
  simbeeotic plot traces run.mcap -o flown.svg   who flew where
  simbeeotic new my-swarm                        a crate for a behaviour of your own

Exit codes: 0 all went well; 1 a run failed, or output could not be written; 2 the input is wrong;
130 the run was interrupted (Ctrl-C, SIGTERM): its recording is closed, its summary shown.";

#[derive(Subcommand)]
pub(super) enum Command {
    /// Run a scenario (TOML, or the original's XML)
    #[command(after_help = RUN_EXAMPLES)]
    Run(RunOptions),
    /// Find every error of a scenario, or of a world alone, without running it
    Check(ScenarioOptions),
    /// Run a scenario many times, with other values and seeds, and write a table of what came out
    #[command(after_help = SWEEP_EXAMPLES)]
    Sweep(Box<SweepOptions>),
    /// List the parts that a scenario can name
    List {
        /// Only parts of this kind: model, vehicle, sensor, radio, antenna, propagation, weather,
        /// generator, component
        kind: Option<String>,
        /// As JSON
        #[arg(long)]
        json: bool,
    },
    /// Describe a part: what it is, its parameters with units and defaults
    Describe {
        /// The part's name, such as instrument-bee
        name: String,
        /// As JSON schema
        #[arg(long)]
        json: bool,
    },
    /// Print the JSON schema of scenario files, for editors
    Schema,
    /// Make a crate with a behaviour of your own, a scenario and a test
    New {
        /// Name of the crate, such as my-swarm
        name: String,
        /// Folder to make [default: the name, in this folder]
        #[arg(long)]
        path: Option<PathBuf>,
        /// Folder of the simbeeotic crate that it depends on [default: the one this program was
        /// built from]
        #[arg(long)]
        library: Option<PathBuf>,
    },
    /// Turn one of the original's XML scenarios into TOML
    Convert(ConvertOptions),
    /// Show a recording on a page, with a time line
    #[command(after_help = VIEW_EXAMPLES)]
    View(ViewOptions),
    /// Write a recording's positions, velocities and attitudes as a table
    #[command(after_help = EXPORT_COLUMNS)]
    Export(ExportOptions),
    /// Draw a scenario or a world file, as seen by the program's own camera
    #[command(after_help = PICTURE_EXAMPLES)]
    Picture(PictureOptions),
    /// Draw what is in a recording: flights, numbers over time, histograms, coverage, links, losses
    #[command(subcommand, after_help = PLOT_EXAMPLES)]
    Plot(Plot),
    /// Draw a recording as a picture, or as a film
    #[command(after_help = RENDER_EXAMPLES)]
    Render(Box<RenderOptions>),
    /// Write a world made by rule: maze, office, mine, forest, city, warehouse
    #[command(after_help = WORLD_EXAMPLES, disable_help_flag = true)]
    World(WorldOptions),
    /// Measure this machine with the paper's experiments
    #[command(subcommand)]
    Bench(Experiment),
}

const RUN_EXAMPLES: &str = "\
Examples:
  simbeeotic run scenarios/figure12.toml
  simbeeotic run scenarios/figure12.xml --end-time \"10 s\"
  simbeeotic run scenarios/figure12.toml --seed 7 --threads 2 --json > summary.json
  simbeeotic run scenarios/first-swarm.toml --set model.bee.count=1000
  simbeeotic run scenarios/first-swarm.toml --set model.bee.params.max_speed=\"3 m/s\"
  simbeeotic run scenarios/figure12.toml --record run.mcap
  simbeeotic run scenarios/flood.toml --summary flood.parquet
  simbeeotic run scenarios/first-swarm.toml --view --open --paused

Ctrl-C or SIGTERM ends a run early: its recording is closed, its summary shown, the exit code 130.";

const VIEW_EXAMPLES: &str = "\
Examples:
  simbeeotic run scenarios/first-swarm.toml --record run.mcap
  simbeeotic view run.mcap --open

It serves until the page is closed, or Ctrl-C. A run is shown live by `simbeeotic run --view`.";

const EXPORT_COLUMNS: &str = "\
Columns: time_s, time_ns, model (its path), x_m, y_m, z_m (position, ENU), vx_m_s, vy_m_s, vz_m_s
(velocity, ENU), qw, qx, qy, qz (attitude, world_from_body), wx_rad_s, wy_rad_s, wz_rad_s (body
rates, FLU). One row for each model and tick.";

const PICTURE_EXAMPLES: &str = "\
Examples:
  simbeeotic picture worlds/garden.toml -o garden.png
  simbeeotic picture scenarios/first-swarm.toml -o swarm.png --time \"10 s\"
  simbeeotic picture maze.toml -o maze.png --from 0,0,40 --at 10,10,0 --kind depth

Without --from it looks from the south-west and from above at all there is. Positions are east, north,
up, in metres. Kinds: colour, grey, depth (near is bright), labels (a colour for each thing), normals.";

const WORLD_EXAMPLES: &str = "\
Examples:
  simbeeotic world list
  simbeeotic world maze --help                   its parameters, with units and defaults
  simbeeotic world maze --seed 3 --set columns=20 --set cell=\"2 m\" -o maze.toml
  simbeeotic world maze -o - | less

A scenario uses the file by `world = \"maze.toml\"`, or makes the same world itself:
  [world]
  generate = { use = \"maze\", seed = 3, columns = 20, cell = \"2 m\" }";

/// Stands for the recording's own name, ending in `.parquet`.
pub(super) const BESIDE: &str = "<beside the recording>";

/// Which scenario, and what is changed in it.
#[derive(Args, Clone)]
pub(super) struct ScenarioOptions {
    /// The scenario file: TOML, or the original's XML
    pub(super) scenario: PathBuf,
    /// World file that replaces the scenario's: TOML, or the original's XML
    #[arg(long, value_name = "FILE")]
    pub(super) world: Option<PathBuf>,
    /// Override any value of the scenario; may be given many times
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub(super) sets: Vec<String>,
    /// Master seed, a whole number [default: the scenario's]
    #[arg(long, allow_negative_numbers = true)]
    pub(super) seed: Option<i64>,
    /// When the run ends, with a unit: "10 s" [default: the scenario's]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(super) end_time: Option<String>,
}

#[derive(Args)]
pub(super) struct RunOptions {
    #[command(flatten)]
    pub(super) scenario: ScenarioOptions,
    /// Threads that run models; the trace is the same for any number [default: one for each core]
    #[arg(long, value_parser = threads, allow_negative_numbers = true)]
    pub(super) threads: Option<usize>,
    /// Run at most this many times faster than the wall clock, or `max`: as fast as it can [default: what
    /// the scenario says, else max; 1 with --view]
    #[arg(long, value_name = "FACTOR", value_parser = factor, allow_hyphen_values = true)]
    pub(super) real_time: Option<Factor>,
    /// End the run after this much wall time, with a unit: "10 min"
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(super) wall_time: Option<String>,
    /// Record to this file, with the settings of the scenario's recorder if it has one
    #[arg(long, value_name = "FILE", conflicts_with = "no_record")]
    pub(super) record: Option<PathBuf>,
    /// Do not record, whatever the scenario says
    #[arg(long)]
    pub(super) no_record: bool,
    /// Write the numbers of the run to this file as a table: .parquet, .csv or .json
    #[arg(long, value_name = "FILE")]
    pub(super) summary: Option<PathBuf>,
    /// Print what models write to the log, as it happens
    #[arg(long)]
    pub(super) log: bool,
    /// Show the run on a page, live; its address is printed
    #[arg(long)]
    pub(super) view: bool,
    /// Do not start before the page says so
    #[arg(long)]
    pub(super) paused: bool,
    #[command(flatten)]
    pub(super) page: PageOptions,
    /// No progress bar, no summary: errors only
    #[arg(long, short)]
    pub(super) quiet: bool,
    /// Print the summary as JSON on standard output
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Args)]
pub(super) struct ViewOptions {
    /// The recording
    pub(super) recording: PathBuf,
    #[command(flatten)]
    pub(super) page: PageOptions,
}

/// Where a page is served.
#[derive(Args, Clone, Debug, Default)]
pub(super) struct PageOptions {
    /// Start the browser
    #[arg(long)]
    pub(super) open: bool,
    /// Port of the page, 0 for any that is free [default: 8470 if it is free, else any]
    #[arg(long, value_name = "PORT", allow_negative_numbers = true)]
    pub(super) port: Option<u16>,
    /// Address to serve the page at; from any but 127.0.0.1 other machines reach it, with the token that
    /// is printed [default: 127.0.0.1]
    #[arg(long, value_name = "ADDRESS")]
    pub(super) address: Option<String>,
}

#[derive(Args)]
pub(super) struct ConvertOptions {
    /// The scenario in XML
    pub(super) scenario: PathBuf,
    /// World file in XML, converted too
    #[arg(long, value_name = "FILE")]
    pub(super) world: Option<PathBuf>,
    /// File to write [default: standard output; the world goes beside it]
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
}

#[derive(Args)]
pub(super) struct WorldOptions {
    /// The kind of world; or `list`, which lists them; or `describe` and a kind
    pub(super) kind: Option<String>,
    /// The kind to describe
    #[arg(hide = true)]
    pub(super) name: Option<String>,
    /// The seed: another seed, another world of this kind [default: 1]
    #[arg(long, allow_negative_numbers = true)]
    pub(super) seed: Option<i64>,
    /// Set a parameter of the kind; may be given many times
    #[arg(long = "set", value_name = "PARAMETER=VALUE")]
    pub(super) sets: Vec<String>,
    /// File to write, or - for standard output [default: standard output]
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Replace the file if it is there
    #[arg(long)]
    pub(super) force: bool,
    /// Print help; with a kind, its parameters
    #[arg(long, short)]
    pub(super) help: bool,
}

#[derive(Args)]
pub(super) struct ExportOptions {
    /// The recording
    pub(super) recording: PathBuf,
    /// Write CSV to this file, or to standard output
    #[arg(
        long,
        value_name = "FILE",
        num_args = 0..=1,
        default_missing_value = "-",
        required_unless_present_any = ["parquet", "readings", "images", "packets", "links", "radio"]
    )]
    pub(super) csv: Option<PathBuf>,
    /// Write what sensors read, and the truth beside it, as CSV to this file or to standard output
    #[arg(
        long,
        value_name = "FILE",
        num_args = 0..=1,
        default_missing_value = "-",
        conflicts_with_all = ["csv", "parquet"]
    )]
    pub(super) readings: Option<PathBuf>,
    /// Write Parquet to this file, or beside the recording
    #[arg(
        long,
        value_name = "FILE",
        num_args = 0..=1,
        default_missing_value = BESIDE,
        conflicts_with = "csv"
    )]
    pub(super) parquet: Option<PathBuf>,
    /// Write each packet and who received it to this file: CSV, or Parquet if it ends in .parquet
    #[arg(
        long,
        value_name = "FILE",
        num_args = 0..=1,
        default_missing_value = "-",
        conflicts_with_all = ["csv", "parquet", "readings", "images"]
    )]
    pub(super) packets: Option<PathBuf>,
    /// Write how well each radio heard each other, period by period, in the same ways
    #[arg(
        long,
        value_name = "FILE",
        num_args = 0..=1,
        default_missing_value = "-",
        conflicts_with_all = ["csv", "parquet", "readings", "images", "packets"]
    )]
    pub(super) links: Option<PathBuf>,
    /// Write how many frames were sent, received and lost, period by period, in the same ways
    #[arg(
        long,
        value_name = "FILE",
        num_args = 0..=1,
        default_missing_value = "-",
        conflicts_with_all = ["csv", "parquet", "readings", "images", "packets", "links"]
    )]
    pub(super) radio: Option<PathBuf>,
    /// Write the pictures that cameras took to this folder, as PNG: bee-1/eye/depth-000000250000us.png
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["csv", "parquet", "readings"])]
    pub(super) images: Option<PathBuf>,
    /// Only models (of readings: sensors; of packets and links: sending radios) whose path matches:
    /// bee-*, hive/bee-1, */imu
    #[arg(long, value_name = "PATTERN")]
    pub(super) model: Option<String>,
    /// Only every n-th tick (of readings: of each sensor's; of packets: every n-th; of links and radio:
    /// every n-th period)
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(super) every: u64,
    /// Only ticks from this time on: "10 s"
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(super) from: Option<String>,
    /// Only ticks up to this time: "20 s"
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(super) to: Option<String>,
}

#[derive(Args)]
pub(super) struct PictureOptions {
    #[command(flatten)]
    pub(super) scenario: ScenarioOptions,
    /// File to write, PNG
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: PathBuf,
    /// Where the camera is [default: south-west and above, as far as it takes to see everything]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(super) from: Option<String>,
    /// What it looks at [default: the middle of everything]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(super) at: Option<String>,
    /// Its size in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "800x600")]
    pub(super) size: String,
    /// What the pixels show
    #[arg(long, value_name = "KIND", default_value = "colour")]
    pub(super) kind: String,
    /// What the width of the picture shows, with a unit
    #[arg(long, value_name = "ANGLE", default_value = "50 deg")]
    pub(super) field_of_view: String,
    /// Rays along each side of a pixel, 1 to 8: more are smoother
    #[arg(long, value_name = "N", default_value_t = 2)]
    pub(super) samples: u32,
    /// Nothing casts a shadow
    #[arg(long)]
    pub(super) no_shadows: bool,
    /// Leave out the objects whose label is this; may be given many times: a ceiling, to see the rooms
    #[arg(long, value_name = "LABEL")]
    pub(super) hide: Vec<String>,
    /// Run the scenario up to this time first: "10 s"
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(super) time: Option<String>,
}

/// More threads than this are a slip of the keyboard.
const THREADS_MAX: usize = 4096;

pub(super) fn threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(threads) if (1..=THREADS_MAX).contains(&threads) => Ok(threads),
        _ => Err(format!("threads lie between 1 and {THREADS_MAX}")),
    }
}

/// How fast a run may go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Factor {
    /// As fast as it can.
    Max,
    /// So many virtual seconds a second.
    Times(f64),
}

fn factor(text: &str) -> Result<Factor, String> {
    match text.parse::<f64>() {
        _ if text == "max" => Ok(Factor::Max),
        Ok(factor) if factor.is_finite() && factor > 0.0 => Ok(Factor::Times(factor)),
        _ => Err("a real-time factor is a number above zero, such as 1 or 2.5, or max".to_owned()),
    }
}

pub(super) fn swarm_size(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(n) if n > 0 => Ok(n),
        _ => Err("a swarm has one bee or more".to_owned()),
    }
}
