//! What can be drawn, and the options of each kind.

use super::column::NARROW;
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;

pub(in crate::program) const PLOT_EXAMPLES: &str = "\
Examples:
  simbeeotic run scenarios/talk.toml
  simbeeotic plot traces talk.mcap -o flown.svg
  simbeeotic plot traces talk.mcap -o flown-3d.png --3d
  simbeeotic plot series talk.mcap -o speed.svg --metric speed --metric packets/delivery
  simbeeotic plot histogram talk.mcap -o height.svg --metric altitude
  simbeeotic plot coverage talk.mcap -o seen.png --cell \"2 m\" --reach \"3 m\"
  simbeeotic plot links talk.mcap -o links.svg
  simbeeotic plot series run-*.mcap -o soc.svg --metric 'bee-*/battery/soc' --by model.bee.count
  simbeeotic plot series runs/ -o soc.svg --metric soc --by seed
  simbeeotic plot sweep runs.csv -o contacts.svg --x model.bee.count --metric contacts

The file's ending says what it becomes: .svg or .png. Several recordings, or a folder of them, are runs of one
experiment: traces draws all of them on one map, rssi pools them, and all others draw the mean over them with its
95 % confidence; for each value of `--by` apart.
Links, delivery and RSSI are drawn from the links that the recorder writes, for at most 256 radios: the
scenario's, or those that its `packets` names.";

const TRACES_EXAMPLES: &str = "\
Examples:
  simbeeotic plot traces run.mcap -o flown.svg
  simbeeotic plot traces run.mcap -o flown.svg --models 'bee-*' --color time --to \"20 s\"
  simbeeotic plot traces run-*.mcap -o seeds.svg --by model.bee.count
  simbeeotic plot traces run.mcap -o flown.png --3d --azimuth \"200 deg\" --elevation \"25 deg\"

Several recordings lie one over the other, a colour each; `--by` draws a map for each of its values, all of one scale.
What stands at the height of the flights is filled, what hangs above them is an outline only. Vehicles that do not
move (hives, beacons) are squares with their names. A ring is where a flight starts, a dot where it ends.";

const SERIES_EXAMPLES: &str = "\
Numbers that can be drawn:
  speed, climb, altitude, x, y, z    of each vehicle (z and altitude: above the origin of the world)
  distance:hive, distance:0,0,5      of each vehicle from a model, or a place (east, north, up, m)
  packets/sent, received, overheard, lost, lost/REASON, delivery
                                     of all radios, or of those that --models takes, in each period
  bee-*/battery/soc, neighbors       metrics, by their names or by the last part of them
  bee-*/imu:fx                       what sensors read, by sensor and column; --truth: and the truth

Examples:
  simbeeotic plot series run.mcap -o soc.svg --metric 'bee-*/battery/soc' --each
  simbeeotic plot series run.mcap -o far.svg --metric distance:hive --models 'bee-*' --band quantile
  simbeeotic plot series run-*.mcap -o sweep.svg --metric speed --by model.bee.count
  simbeeotic plot series run-*.mcap -o seeds.svg --metric 'bee-*/battery/soc' --by seed";

const HISTOGRAM_EXAMPLES: &str = "\
It takes the same numbers as `plot series`. Bins are as wide as Freedman and Diaconis propose, unless --bin says
it, in the unit of the number.

Examples:
  simbeeotic plot histogram run.mcap -o speed.svg --metric speed
  simbeeotic plot histogram run.mcap -o height.svg --metric altitude --at \"12 s\" --bin 0.5
  simbeeotic plot histogram run-*.mcap -o soc.svg --metric 'bee-*/battery/soc' --last";

const COVERAGE_EXAMPLES: &str = "\
A cell counts as seen while a vehicle is within --reach of its middle, seen from above. Between two ticks a vehicle
is taken to fly straight on.

Examples:
  simbeeotic plot coverage run.mcap -o seen.svg --cell \"1 m\" --reach \"2 m\"
  simbeeotic plot coverage run.mcap -o stay.svg --show dwell --area=-20,-20,20,20
  simbeeotic plot coverage run-*.mcap -o mean.svg --confidence
  simbeeotic plot coverage run-*.mcap -o sure.svg --show runs --by model.bee.count
  simbeeotic plot coverage run-*.mcap -o share.svg --over-time --area=-20,-20,20,20";

const LINK_EXAMPLES: &str = "\
Of several recordings of the same radios each half of a line is the mean over runs; it is dashed where the 95 % interval
of the delivery ratio reaches farther than 0.1 from it. Radios are drawn in the mean of their places.

Examples:
  simbeeotic plot links run.mcap -o links.svg --least 0.5
  simbeeotic plot links run-*.mcap -o mean.svg --per-radio 3
  simbeeotic plot links runs/ -o sizes.svg --by model.bee.count";

const SWEEP_EXAMPLES: &str = "\
A key whose values are numbers of one unit is an axis of numbers: a line through the means, with a band where they
are with 95 % confidence. All others are words beside each other, with bars. Runs that differ in a key that is
neither --x nor --by are taken together; the band is of the means of seeds.

Examples:
  simbeeotic sweep scenarios/first-swarm.toml --seeds 10 --vary \"model.bee.count=50..200 step 50\"
  simbeeotic plot sweep first-swarm-runs.csv -o contacts.svg --x count --metric contacts
  simbeeotic plot sweep runs.csv -o range.svg --x range_limit --metric packets/received --by count";

/// What is drawn.
#[derive(Subcommand)]
pub(in crate::program) enum Plot {
    /// A map from above: who flew where, over the world; or the same in 3-D
    #[command(after_help = TRACES_EXAMPLES)]
    Traces(TraceOptions),
    /// Numbers over time: flights, metrics, packets, what sensors read
    #[command(after_help = SERIES_EXAMPLES)]
    Series(SeriesOptions),
    /// How often which values occur of the same numbers
    #[command(after_help = HISTOGRAM_EXAMPLES)]
    Histogram(HistogramOptions),
    /// A map of what was seen of an area, or how much of it over time
    #[command(after_help = COVERAGE_EXAMPLES)]
    Coverage(CoverageOptions),
    /// A map from above: who hears whom, how often and how loud
    #[command(after_help = LINK_EXAMPLES)]
    Links(LinkOptions),
    /// How much of what is sent is received, over distance
    Delivery(DistanceOptions),
    /// How loud it is received, over distance; frames of several recordings are pooled
    Rssi(DistanceOptions),
    /// Why frames were lost, over time; of several recordings in the mean
    Losses(LossOptions),
    /// What runs come to over what was varied, from the table that `simbeeotic sweep` writes
    #[command(after_help = SWEEP_EXAMPLES)]
    Sweep(SweepPlotOptions),
}

#[derive(Args)]
pub(crate) struct SweepPlotOptions {
    /// The table of runs, .csv, .json or .parquet
    #[arg(value_name = "TABLE")]
    pub(crate) table: PathBuf,
    /// File to write, .svg or .png
    #[arg(long, short, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// What is on the x axis: a key that was varied, or the end of its name: model.bee.count, count, seed
    #[arg(long, value_name = "KEY")]
    pub(crate) x: String,
    /// What is on the y axis: a number of the table, with or without its unit; may be given many times: those
    /// of one unit are drawn together
    #[arg(long, value_name = "NAME", required = true)]
    pub(crate) metric: Vec<String>,
    /// A colour for each value of this key [default: its runs are taken together]
    #[arg(long, value_name = "KEY")]
    pub(crate) by: Option<String>,
    /// What stands above it
    #[arg(long)]
    pub(crate) title: Option<String>,
    /// No title, and no line below it: for a paper, whose caption says it
    #[arg(long)]
    pub(crate) plain: bool,
    /// Its width in pixels; of less than 700 the key stands below, and the picture is higher by it
    #[arg(long, value_name = "PIXELS", default_value_t = 1000, value_parser = pixels)]
    pub(crate) width: u32,
    /// Its height in pixels [default: 700, less if it is narrow]
    #[arg(long, value_name = "PIXELS", value_parser = height)]
    pub(crate) height: Option<u32>,
}

/// What all pictures have.
#[derive(Args)]
pub(crate) struct PlotOptions {
    /// The recording, or the recordings of several runs, or the folder that `sweep --record` wrote
    #[arg(required = true, value_name = "RECORDING")]
    pub(crate) recordings: Vec<PathBuf>,
    /// File to write, .svg or .png
    #[arg(long, short, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// What stands above it
    #[arg(long)]
    pub(crate) title: Option<String>,
    /// No title, and no line below it: for a paper, whose caption says it
    #[arg(long)]
    pub(crate) plain: bool,
    /// Its width in pixels; of less than 700 the key stands below, and the picture is higher by it
    #[arg(long, value_name = "PIXELS", default_value_t = 1000, value_parser = pixels)]
    pub(crate) width: u32,
    /// Its height in pixels [default: 700, less if it is narrow, or in 3-D and needs less]
    #[arg(long, value_name = "PIXELS", value_parser = height)]
    pub(crate) height: Option<u32>,
    /// Only what is recorded from this time on: "10 s"
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) from: Option<String>,
    /// Only what is recorded up to this time: "20 s"
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) to: Option<String>,
}

/// What the colour of a trace says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ColorBy {
    /// Which vehicle it is
    Vehicle,
    /// Of which kind it is: models whose names differ in a number only
    Kind,
    /// Of which run it is
    Run,
    /// When it was there
    Time,
    /// How high it was
    Altitude,
}

#[derive(Args)]
pub(crate) struct TraceOptions {
    #[command(flatten)]
    pub(crate) plot: PlotOptions,
    /// Only models whose path matches: 'bee-*', or several, 'bee-1*,hive'
    #[arg(long, value_name = "PATTERNS", value_delimiter = ',')]
    pub(crate) models: Vec<String>,
    /// What the colours say [default: of several recordings run; else vehicle, if there are at most seven; else
    /// kind]
    #[arg(long = "color", alias = "colour", value_name = "WHAT")]
    pub(crate) color: Option<ColorBy>,
    /// Of several recordings: a map for each value of this: a value of the scenario (model.bee.count), seed, file
    /// [default: all on one map]
    #[arg(long, value_name = "KEY")]
    pub(crate) by: Option<String>,
    /// What is above this height is an outline only, with a unit [default: where the flights are]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub(crate) level: Option<String>,
    /// Leave out the objects whose label or kind is this; may be given many times: roof
    #[arg(long, value_name = "LABEL")]
    pub(crate) hide: Vec<String>,
    /// Draw the whole world, not only what is near the flights
    #[arg(long)]
    pub(crate) whole: bool,
    /// Seen from the side and above, in 3-D
    #[arg(long = "3d")]
    pub(crate) solid: bool,
    /// In 3-D: the direction from which it is seen, clockwise from north
    #[arg(
        long,
        value_name = "ANGLE",
        default_value = "205 deg",
        allow_hyphen_values = true
    )]
    pub(crate) azimuth: String,
    /// In 3-D: how far above the horizon it is seen from
    #[arg(long, value_name = "ANGLE", default_value = "28 deg")]
    pub(crate) elevation: String,
}

/// The band around a mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum BandKind {
    /// From the least to the greatest
    MinMax,
    /// From 5 % to 95 % of them
    Quantile,
    /// Where the mean is with 95 % confidence, after Student
    Confidence,
    /// None: the mean alone
    None,
}

/// Which numbers, of whom.
#[derive(Args)]
pub(crate) struct NumberOptions {
    /// What is drawn: speed, bee-*/battery/soc, packets/sent ...; may be given many times
    #[arg(long, value_name = "NAME", required = true)]
    pub(crate) metric: Vec<String>,
    /// Only of models whose path matches: 'bee-*', or several, 'bee-1*,hive'
    #[arg(long, value_name = "PATTERNS", value_delimiter = ',')]
    pub(crate) models: Vec<String>,
    /// Of several recordings: what sets them apart: a value of the scenario (model.bee.count), seed, file
    /// [default: they are runs of one and the same]
    #[arg(long, value_name = "KEY")]
    pub(crate) by: Option<String>,
}

#[derive(Args)]
pub(crate) struct SeriesOptions {
    #[command(flatten)]
    pub(crate) plot: PlotOptions,
    #[command(flatten)]
    pub(crate) numbers: NumberOptions,
    /// A line for each vehicle, however many there are [default: up to seven]
    #[arg(long, conflicts_with = "band")]
    pub(crate) each: bool,
    /// The mean, and around it: [default: quantile of one run's vehicles, confidence of several runs]
    #[arg(long, value_name = "BAND")]
    pub(crate) band: Option<BandKind>,
    /// Draw what was true beside what sensors read, dashed
    #[arg(long)]
    pub(crate) truth: bool,
}

#[derive(Args)]
pub(crate) struct HistogramOptions {
    #[command(flatten)]
    pub(crate) plot: PlotOptions,
    #[command(flatten)]
    pub(crate) numbers: NumberOptions,
    /// The values at this time only: "12 s"
    #[arg(long, value_name = "TIME", conflicts_with = "last")]
    pub(crate) at: Option<String>,
    /// The last value of each only
    #[arg(long)]
    pub(crate) last: bool,
    /// Width of the bins, in the unit of the number
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true)]
    pub(crate) bin: Option<f64>,
}

/// What a cell of a coverage map shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum CoverageKind {
    /// How often a vehicle came
    Visits,
    /// For how long vehicles were there, added up
    Dwell,
    /// When the last one was there; of several recordings, in the mean over those that had one there
    Last,
    /// Of several recordings the share in which a vehicle came
    Runs,
}

#[derive(Args)]
pub(crate) struct CoverageOptions {
    #[command(flatten)]
    pub(crate) plot: PlotOptions,
    /// Only models whose path matches: 'bee-*', or several, 'bee-1*,hive'
    #[arg(long, value_name = "PATTERNS", value_delimiter = ',')]
    pub(crate) models: Vec<String>,
    /// The side of a cell, with a unit [default: about a hundred cells in a row]
    #[arg(long, value_name = "LENGTH")]
    pub(crate) cell: Option<String>,
    /// How far a vehicle sees, with a unit [default: half a cell]
    #[arg(long, value_name = "LENGTH")]
    pub(crate) reach: Option<String>,
    /// The area, m [default: what the flights reach]
    #[arg(long, value_name = "WEST,SOUTH,EAST,NORTH", allow_hyphen_values = true)]
    pub(crate) area: Option<String>,
    /// What a cell shows
    #[arg(long, value_name = "WHAT", default_value = "visits")]
    pub(crate) show: CoverageKind,
    /// The share of the area that was seen, over time
    #[arg(long)]
    pub(crate) over_time: bool,
    /// Beside each map of several recordings another one: half of the 95 % interval of each cell's mean
    #[arg(long, conflicts_with = "over_time")]
    pub(crate) confidence: bool,
    /// Of several recordings: what sets them apart, each value a map or a line: model.bee.count, seed, file
    /// [default: they are runs of one and the same]
    #[arg(long, value_name = "KEY")]
    pub(crate) by: Option<String>,
}

#[derive(Args)]
pub(crate) struct LinkOptions {
    #[command(flatten)]
    pub(crate) plot: PlotOptions,
    /// Where the radios are drawn: their places at this time [default: in the mean]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) time: Option<String>,
    /// Of several recordings: a map for each value of this: a value of the scenario (model.bee.count), seed, file
    /// [default: one map of the mean over all]
    #[arg(long, value_name = "KEY")]
    pub(crate) by: Option<String>,
    /// Only links that deliver at least this share of the frames, one way or the other
    #[arg(
        long,
        value_name = "RATIO",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub(crate) least: f64,
    /// Only the best links of each radio, so many [default: all, if they are not more
    /// than 6 for each radio, and 600; else as many as these allow]
    #[arg(long, value_name = "N")]
    pub(crate) per_radio: Option<u32>,
}

#[derive(Args)]
pub(crate) struct DistanceOptions {
    #[command(flatten)]
    pub(crate) plot: PlotOptions,
    /// Width of the bins, with a unit: "2 m" [default: about 30 of them]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub(crate) bin: Option<String>,
    /// Of several recordings: what sets them apart: a value of the scenario (model.bee.count), seed, file
    /// [default: they are runs of one and the same]
    #[arg(long, value_name = "KEY")]
    pub(crate) by: Option<String>,
}

#[derive(Args)]
pub(crate) struct LossOptions {
    #[command(flatten)]
    pub(crate) plot: PlotOptions,
    /// Of one radio that is counted by itself: bee-0/radio [default: of all together]
    #[arg(long, value_name = "PATH")]
    pub(crate) radio: Option<String>,
    /// Draw frames that were out of range, too
    #[arg(long)]
    pub(crate) all: bool,
    /// Of several recordings: what sets them apart: a value of the scenario (model.bee.count), seed, file
    /// [default: they are runs of one and the same]
    #[arg(long, value_name = "KEY")]
    pub(crate) by: Option<String>,
}

/// Smaller pictures have no room for their words; larger ones are slips of the keyboard.
fn pixels(text: &str) -> Result<u32, String> {
    side(text, 400)
}

fn height(text: &str) -> Result<u32, String> {
    side(text, 300)
}

fn side(text: &str, least: u32) -> Result<u32, String> {
    match text.parse() {
        Ok(pixels) if (least..=8000).contains(&pixels) => Ok(pixels),
        _ => Err(format!("it has {least} to 8000 pixels")),
    }
}

impl Plot {
    /// What all pictures of recordings have; `None` of a picture of a table.
    pub(super) fn options(&self) -> Option<&PlotOptions> {
        Some(match self {
            Self::Traces(options) => &options.plot,
            Self::Series(options) => &options.plot,
            Self::Histogram(options) => &options.plot,
            Self::Coverage(options) => &options.plot,
            Self::Links(options) => &options.plot,
            Self::Delivery(options) | Self::Rssi(options) => &options.plot,
            Self::Losses(options) => &options.plot,
            Self::Sweep(_) => return None,
        })
    }
}

/// The height of a picture, unless it is said; of a narrow one so much of its width.
const HEIGHT: u32 = 700;
const ASPECT: f64 = 0.9;

fn size(width: u32, height: Option<u32>) -> [u32; 2] {
    let usual = match width < NARROW {
        true => (ASPECT * f64::from(width)).round() as u32,
        false => HEIGHT,
    };
    [width, height.unwrap_or(usual)]
}

impl SweepPlotOptions {
    /// Width and height, pixels.
    pub(super) fn size(&self) -> [u32; 2] {
        size(self.width, self.height)
    }
}

impl PlotOptions {
    /// Width and height, pixels.
    pub(super) fn size(&self) -> [u32; 2] {
        size(self.width, self.height)
    }

    pub(super) fn title<'a>(&'a self, or: &'a str) -> &'a str {
        self.title.as_deref().unwrap_or(or)
    }
}
