//! What `render` can be asked.

use clap::Args;
use std::path::PathBuf;

pub(super) const RENDER_EXAMPLES: &str = "\
Examples:
  simbeeotic render run.mcap --at \"12.5 s\" --view top -o frame.png
  simbeeotic render run.mcap --view orbit --trails \"5 s\" --colour-by speed -o frame.png
  simbeeotic render run.mcap --video film.mp4 --view orbit --turn \"10 deg/s\" --speed 4
  simbeeotic render run.mcap --video film.gif --from \"10 s\" --to \"20 s\" --size 480x270
  simbeeotic render run.mcap --video film.mp4 --follow bee-3 --view orbit --zoom 2
  simbeeotic render run.mcap --beams 'scout-*' --follow scout-1 --view orbit -o rays.png
  simbeeotic render run.mcap --eye -10,-10,8 --look-at 0,0,2 -o frame.png

--view top, north, south, east and west have no perspective and a scale; north is as seen from the north.
What moves during the whole film fits into the picture, unless --fit, --follow or --eye says otherwise.
.gif and .png need nothing; .mp4 needs the program `ffmpeg` on the PATH. The same recording gives the same
pictures, to the byte, on any number of threads.";

#[derive(Args)]
pub(super) struct RenderOptions {
    /// The recording
    pub(super) recording: PathBuf,
    /// The picture to write, .png; or else a film, by --video
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// The film to write: .mp4, .gif, or pictures with a number each, film-%05d.png
    #[arg(long, value_name = "FILE", conflicts_with = "output")]
    pub(super) video: Option<PathBuf>,
    /// When the picture is taken: "12.5 s" [default: at the end]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, conflicts_with_all = ["video", "from", "to"])]
    pub(super) at: Option<String>,
    #[command(flatten)]
    pub(super) film: FilmOptions,
    #[command(flatten)]
    pub(super) camera: CameraOptions,
    #[command(flatten)]
    pub(super) picture: PictureOptions,
    /// Threads that draw; the pictures are the same for any number [default: one for each core]
    #[arg(long, value_parser = super::arguments::threads, allow_negative_numbers = true)]
    pub(super) threads: Option<usize>,
    /// No progress bar, no report
    #[arg(long, short)]
    pub(super) quiet: bool,
}

/// What only a film has.
#[derive(Args)]
#[group(requires = "video", conflicts_with = "output", multiple = true)]
pub(super) struct FilmOptions {
    /// When the film, --video, begins: "10 s" [default: at the start]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(super) from: Option<String>,
    /// When the film, --video, ends: "20 s" [default: at the end]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(super) to: Option<String>,
    /// Virtual seconds for each second of the film
    #[arg(
        long,
        value_name = "FACTOR",
        default_value_t = 1.0,
        allow_negative_numbers = true
    )]
    pub(super) speed: f64,
    /// Pictures for each second of the film
    #[arg(
        long,
        value_name = "RATE",
        default_value_t = 25.0,
        allow_negative_numbers = true
    )]
    pub(super) frames_per_second: f64,
}

/// From where it is seen.
#[derive(Args)]
#[command(next_help_heading = "Camera")]
pub(super) struct CameraOptions {
    /// Where it is seen from: top, north, south, east, west, orbit
    #[arg(long, value_name = "VIEW", default_value = "top")]
    pub(super) view: String,
    /// Seen from a place: east, north, up in metres
    #[arg(
        long,
        value_name = "X,Y,Z",
        allow_hyphen_values = true,
        conflicts_with = "view"
    )]
    pub(super) eye: Option<String>,
    /// What is looked at from there [default: the middle of what moves]
    #[arg(
        long,
        value_name = "X,Y,Z",
        allow_hyphen_values = true,
        requires = "eye"
    )]
    pub(super) look_at: Option<String>,
    /// Keep a vehicle in the middle: bee-3
    #[arg(long, value_name = "PATH", conflicts_with = "look_at")]
    pub(super) follow: Option<String>,
    /// What has to be seen: swarm, all that moves during the film; or world, all there is
    #[arg(long, value_name = "WHAT", default_value = "swarm")]
    pub(super) fit: String,
    /// So many times as large
    #[arg(
        long,
        value_name = "FACTOR",
        default_value_t = 1.0,
        allow_negative_numbers = true
    )]
    pub(super) zoom: f64,
    /// Where an orbit begins, clockwise from north [default: 220 deg, from the south-west]
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    pub(super) bearing: Option<String>,
    /// How high an orbit is above the horizon [default: 30 deg, or higher where the world hides the swarm]
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    pub(super) elevation: Option<String>,
    /// How fast the camera goes around, for each second of the film: "20 deg/s"
    #[arg(long, value_name = "RATE", allow_hyphen_values = true)]
    pub(super) turn: Option<String>,
    /// What the width of the picture shows, where there is perspective
    #[arg(
        long,
        value_name = "ANGLE",
        default_value = "50 deg",
        allow_hyphen_values = true
    )]
    pub(super) field_of_view: String,
}

/// What is seen.
#[derive(Args)]
#[command(next_help_heading = "Picture")]
pub(super) struct PictureOptions {
    /// Size in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1280x720")]
    pub(super) size: String,
    /// Dark on light [default]
    #[arg(long, conflicts_with = "dark")]
    pub(super) light: bool,
    /// Light on dark
    #[arg(long)]
    pub(super) dark: bool,
    /// What colours say: kind, body, speed, height, battery, or the name of a metric
    #[arg(
        long,
        value_name = "WHAT",
        default_value = "kind",
        visible_alias = "color-by"
    )]
    pub(super) colour_by: String,
    /// Only vehicles whose path matches: 'bee-*', or several, 'bee-1*,hive'
    #[arg(long, value_name = "PATTERN", value_delimiter = ',')]
    pub(super) models: Vec<String>,
    /// Draw where each has been in this time: "5 s"
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(super) trails: Option<String>,
    /// Write names beside vehicles
    #[arg(long)]
    pub(super) labels: bool,
    /// Draw radio links, if they were recorded
    #[arg(long)]
    pub(super) links: bool,
    /// Draw packets on their way, if they were recorded
    #[arg(long)]
    pub(super) packets: bool,
    /// Draw what the sensors of vehicles look along, as far as they were recorded to measure: 'scout-*'
    #[arg(long, value_name = "PATTERN", value_delimiter = ',')]
    pub(super) beams: Vec<String>,
    /// No arrows of the wind, if it was recorded
    #[arg(long)]
    pub(super) no_wind: bool,
    /// The world without what begins above the swarm, such as roofs: auto, where it hides the swarm; always; never
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub(super) cut_open: String,
    /// Leave out the things of the world whose label or kind is this; may be given many times: roof
    #[arg(long, value_name = "LABEL", value_delimiter = ',')]
    pub(super) hide: Vec<String>,
    /// No lines on the ground
    #[arg(long)]
    pub(super) no_grid: bool,
    /// Leave out time, scale and what colours mean
    #[arg(long)]
    pub(super) plain: bool,
    /// Each pixel is drawn as so many across and down, 1 to 4 [default: 2 for a picture, 1 for a film]
    #[arg(long, value_name = "N")]
    pub(super) fineness: Option<u32>,
}
