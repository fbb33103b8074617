//! `plot`: pictures of what is in a recording.
//!
//! Each kind of picture is a function from a recording to a [`Sheet`](sheet::Sheet): a list of lines, areas, discs and
//! words in pixels. A sheet becomes SVG by printing it ([`svg`]), PNG by filling outlines ([`png`]); the
//! letters are part of the program (`simbeeotic_view::render::words`), so that a picture is the same everywhere. [`axes`] and
//! [`palette`] are for all kinds. Other commands draw with [`Sheet`], [`axes`] and [`save`], too.
//!
//! Why there is no plotting library below it: `docs/adr/0014-plots-without-a-library.md`.

mod arguments;
pub(super) mod axes;
pub(super) mod band;
mod cells;
pub(super) mod chart;
mod column;
mod coverage;
mod delivery;
mod faces;
mod flights;
mod grid;
mod ground;
mod histogram;
mod limits;
mod lines;
mod links;
mod losses;
mod map;
pub(super) mod names;
mod net;
mod over;
pub(super) mod palette;
mod png;
mod quantity;
mod runs;
mod series;
pub(super) mod sheet;
mod solid;
mod source;
mod stats;
mod svg;
mod sweep;
mod tables;
mod traces;

pub(super) use arguments::{BandKind, PLOT_EXAMPLES, Plot};

use super::{Failure, remark, same_file};
use sheet::Sheet;
use simbeeotic_record::publish;
use source::Sources;
use std::io::{self, Write};
use std::path::Path;

/// What a picture becomes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Svg,
    Png,
}

impl Format {
    /// By the ending of a file's name.
    pub(super) fn of(output: &Path) -> Result<Self, Failure> {
        let ending = output.extension().and_then(|ending| ending.to_str());
        match ending.map(str::to_ascii_lowercase).as_deref() {
            Some("svg") => Ok(Self::Svg),
            Some("png") => Ok(Self::Png),
            _ => Err(Failure::input(format!(
                "--output {}: a picture is written as .svg or .png",
                output.display()
            ))),
        }
    }
}

/// Writes a picture, whole or not at all, and says so.
pub(super) fn save(sheet: &Sheet, output: &Path, format: Format) -> Result<(), Failure> {
    let bytes = match format {
        Format::Svg => svg::svg(sheet).into_bytes(),
        Format::Png => png::png(sheet).ok_or_else(|| Failure::run("the picture is too large"))?,
    };
    let written = publish(output, |mut file| -> io::Result<()> {
        file.write_all(&bytes)
    });
    written.map_err(|error| Failure::run(format!("cannot write {}: {error}", output.display())))?;
    remark(format!("wrote {}", output.display()));
    Ok(())
}

/// Draws it.
pub(super) fn plot(what: &Plot) -> Result<(), Failure> {
    if let Plot::Sweep(options) = what {
        let format = Format::of(&options.output)?;
        if same_file(&options.table, &options.output) {
            return Err(Failure::input("--output: this is the table itself"));
        }
        let sheet = over::over(options)?.laid_out(options.plain);
        return save(&sheet, &options.output, format);
    }
    let Some(options) = what.options() else {
        return Ok(());
    };
    let format = Format::of(&options.output)?;
    let sources = Sources::open(options)?;
    let sheet = match what {
        Plot::Traces(options) => traces::traces(&sources, options),
        Plot::Series(options) => series::series_plot(&sources, options),
        Plot::Histogram(options) => histogram::histogram(&sources, options),
        Plot::Coverage(options) => coverage::coverage(&sources, options),
        Plot::Links(options) => links::links(&sources, options),
        Plot::Delivery(options) => delivery::delivery(&sources, options),
        Plot::Rssi(options) => delivery::rssi(&sources, options),
        Plot::Losses(options) => losses::losses(&sources, options),
        Plot::Sweep(options) => over::over(options),
    }?;
    save(&sheet.laid_out(options.plain), &options.output, format)
}
