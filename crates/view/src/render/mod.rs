//! Pictures and films of recordings, without a browser and without a graphics card.
//!
//! A [`Film`] takes [`Picture`]s of a recording at any time: between two ticks everybody is where the cubic
//! through their places and velocities leads. [`write_png`], [`Gif`], [`Mp4`] and [`Frames`] make files of
//! them.
//!
//! # How a picture comes about
//!
//! The [`Stage`](simbeeotic_record::Stage) becomes triangles, once (`solid`, `flower`), with pictures on them
//! (`skins`, `paintings`), and a picture from the sun says what is in the shadow (`shadow`). A camera
//! (`camera`) puts all corners onto the picture, and tiles of 64 by 64 pixels are filled in parallel
//! (`triangle`, `cover`, `tile`), four samples a pixel: first which triangle is seen where (`visible`), then
//! its colour there (`shade`, `light`), as those of sky, ground and grid (`backdrop`, `ground`). Over it come
//! the vehicles (`glyph`), their trails, links (`swarm`) and sensors (`beams`), and the wind (`wind`): the
//! nearest triangle wins, what lets through comes last, from back to front. Words are outlines (`words`, `overlay`). As long as the camera stands still, what
//! does not move is drawn once (`painter`).
//!
//! A tile is drawn by one thread, its triangles in a fixed order, and edges are decided in whole numbers:
//! the same recording gives the same picture, to the byte, on any number of threads.

mod air;
mod backdrop;
mod beams;
mod camera;
mod choices;
mod colours;
mod cover;
mod cut;
mod film;
mod flower;
mod frames;
mod framing;
mod gif;
mod glyph;
mod ground;
mod light;
mod motion;
mod mp4;
mod overlay;
mod painter;
mod paintings;
mod palette;
mod scales;
mod shade;
mod shadow;
mod skins;
mod solid;
mod swarm;
#[cfg(test)]
mod tests;
mod tile;
mod triangle;
mod visible;
mod who;
mod wind;
pub mod words;

pub use camera::{Camera, Lens, Side};
pub use choices::{Choices, CutOpen, DRAWN_MAX, Fit, View};
pub use colours::ColourBy;
pub use film::Film;
pub use frames::{Frames, png_bytes, write_png};
pub use gif::Gif;
pub use mp4::Mp4;
pub use painter::Picture;

use simbeeotic_record::ReadError;
use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// Why there is no picture, or no film.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The recording cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The recording has no positions.
    #[error("{path} has no positions: nothing can be drawn", path = .0.display())]
    NoTicks(PathBuf),
    /// A time is not in the recording.
    #[error("{asked_s} s is outside the recording, which goes from {first_s} s to {last_s} s")]
    Outside {
        /// The time asked for, s.
        asked_s: f64,
        /// The first tick, s.
        first_s: f64,
        /// The end, s.
        last_s: f64,
    },
    /// Nobody is called so.
    #[error("no vehicle is called `{path}`: {help}")]
    UnknownVehicle {
        /// The path asked for.
        path: String,
        /// What is there.
        help: String,
    },
    /// Nothing of this name was recorded of vehicles.
    #[error("the recording has no numbers `{name}` of vehicles: {help}")]
    UnknownMetric {
        /// The name asked for.
        name: String,
        /// What is there.
        help: String,
    },
    /// What was to be drawn was not recorded.
    #[error(
        "the recording has no {0}: give the recorder `packets = [\"*\"]`, or the paths of some radios"
    )]
    Nothing(&'static str),
    /// A picture of this size is not drawn.
    #[error("a picture of {width} x {height}: each side has 16 to 8192 pixels", width = .0[0], height = .0[1])]
    Size([u32; 2]),
    /// A film cannot have this form.
    #[error("{0}")]
    Form(String),
    /// The file cannot be written.
    #[error("cannot write {path}: {source}", path = .path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// There is no `ffmpeg`, which makes films of this kind.
    #[error(
        "{path} needs the program `ffmpeg`, which is not on the PATH: install it (`apt install ffmpeg`, \
         `brew install ffmpeg`), or write a .gif, or pictures by --video film-%05d.png, which need nothing",
        path = .0.display()
    )]
    NoFfmpeg(PathBuf),
    /// `ffmpeg` failed.
    #[error("ffmpeg could not write {path}: {said}", path = .path.display())]
    Ffmpeg {
        /// The file.
        path: PathBuf,
        /// Its last words.
        said: String,
    },
}

impl RenderError {
    fn io(path: &std::path::Path, source: io::Error) -> Self {
        Self::Io {
            path: path.to_path_buf(),
            source,
        }
    }
}
