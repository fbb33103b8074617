//! `render`: pictures and films of a recording. What the words of its arguments mean stands in `render_words`.

use super::render_arguments::RenderOptions;
use super::render_words as words;
use super::{Failure, input, plot, remark, run, same_file, show};
use simbeeotic_kernel::SimTime;
use simbeeotic_record::stage::Prop;
use simbeeotic_record::{Recording, Stage, publish};
use simbeeotic_view::render::{
    Choices, CutOpen, Film, Frames, Gif, Mp4, Picture, RenderError, write_png,
};
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Pictures of a film from which a GIF's colours are chosen.
const SAMPLES: u64 = 12;
/// A film with more pictures is a slip of the keyboard.
const FRAMES_MAX: f64 = 1e6;

/// Draws the picture or the film.
pub(super) fn render(options: &RenderOptions) -> Result<(), Failure> {
    let job = Job::read(options)?;
    let recording = Recording::open(&options.recording).map_err(Failure::input)?;
    if recording.truncated() {
        remark(format!(
            "note: {} was cut off; it reads up to {}",
            options.recording.display(),
            SimTime::from_nanos(recording.end_ns())
        ));
    }
    if same_file(&options.recording, job.target) {
        return Err(Failure::input(format!(
            "{} is the recording itself; choose another name for the picture",
            job.target.display()
        )));
    }
    let stage = stage(&recording, &options.picture.hide)?;
    match options.threads {
        None => job.draw(options, &recording, &stage),
        Some(threads) => {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let pool = pool.map_err(|e| Failure::run(format!("--threads {threads}: {e}")))?;
            pool.install(|| job.draw(options, &recording, &stage))
        }
    }
}

/// What stands in the recorded world, without what is hidden by its label or kind; in older recordings, an empty plane.
fn stage(recording: &Recording, hide: &[String]) -> Result<Stage, Failure> {
    let stage = recording.stage().map_err(Failure::run)?;
    let mut stage = stage.unwrap_or_else(|| Stage {
        plane: true,
        ..Stage::default()
    });
    plot::names::hidden(&[&stage], hide)?;
    let hidden = |prop: &Prop| hide.iter().any(|h| *h == prop.label || *h == prop.kind);
    stage.props.retain(|prop| !hidden(prop));
    Ok(stage)
}

/// What a film becomes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Still,
    Gif,
    Mp4,
    Frames,
}

/// What is to be drawn: the arguments, read.
struct Job<'a> {
    form: Form,
    target: &'a Path,
    choices: Choices,
    /// The picture's time, or the film's first one, and its last, ns; none: as recorded.
    from_ns: Option<u64>,
    to_ns: Option<u64>,
    rate_hz: f64,
}

impl<'a> Job<'a> {
    fn read(options: &'a RenderOptions) -> Result<Self, Failure> {
        let (form, target) = target(options)?;
        let rate_max = if form == Form::Gif { 50.0 } else { 240.0 };
        let rate = options.film.frames_per_second;
        let rate_hz = words::positive("--frames-per-second", rate, rate_max)?;
        let choices = words::choices(options, form == Form::Still)?;
        if form == Form::Mp4 && choices.size.iter().any(|side| !side.is_multiple_of(2)) {
            return Err(Failure::input(format!(
                "--size {}: an .mp4 has an even number of pixels, both ways",
                options.picture.size
            )));
        }
        let (from_ns, to_ns) = match form {
            Form::Still => {
                let at = input::nanos("--at", options.at.as_deref())?;
                (at, at)
            }
            _ => (
                input::nanos("--from", options.film.from.as_deref())?,
                input::nanos("--to", options.film.to.as_deref())?,
            ),
        };
        Ok(Self {
            form,
            target,
            choices,
            from_ns,
            to_ns,
            rate_hz,
        })
    }

    fn draw(
        &self,
        options: &RenderOptions,
        recording: &Recording,
        stage: &Stage,
    ) -> Result<(), Failure> {
        let to_ns = match self.to_ns {
            Some(to_ns) => to_ns,
            None => recording.end_ns(),
        };
        let from_ns = match (self.from_ns, self.form) {
            (Some(from_ns), _) => from_ns,
            (None, Form::Still) => to_ns,
            (None, _) => {
                let first = recording.ticks().next().transpose().map_err(Failure::run)?;
                first.map_or(0, |tick| tick.time_ns)
            }
        };
        input::in_order(from_ns, to_ns, self.to_ns.is_some())?;
        let film = Film::new(recording, stage, self.choices.clone(), from_ns..=to_ns);
        let mut film = film.map_err(failed)?;
        if film.is_cut_open() && self.choices.cut_open == CutOpen::Auto && !options.quiet {
            remark(
                "note: the swarm is under a roof, so the world is shown cut open; --cut-open never shows it whole",
            );
        }
        let times = self.times(from_ns, to_ns)?;
        let pictures = match self.form {
            Form::Still => {
                let picture = film.picture(from_ns).map_err(failed)?;
                write_png(self.target, &picture).map_err(failed)?;
                1
            }
            _ => self.film(options, &mut film, &times)?,
        };
        if !options.quiet {
            let bytes = std::fs::metadata(self.target).map(|m| m.len()).unwrap_or(0);
            let [width, height] = self.choices.size;
            remark(match self.form {
                Form::Still => format!("wrote {}", self.target.display()),
                Form::Frames => format!("wrote {pictures} pictures as {}", self.target.display()),
                _ => format!(
                    "wrote {}: {pictures} pictures of {width} x {height}, {:.1} s, {}",
                    self.target.display(),
                    pictures as f64 / self.rate_hz,
                    show::bytes(bytes)
                ),
            });
        }
        Ok(())
    }

    /// When the pictures of a film are taken, ns.
    fn times(&self, from_ns: u64, to_ns: u64) -> Result<Vec<u64>, Failure> {
        let step_ns = self.choices.speed * 1e9 / self.rate_hz;
        // Each picture lasts until the next one, the last until the end: two seconds are fifty of them.
        let count = ((to_ns - from_ns) as f64 / step_ns * (1.0 - 1e-12)).ceil();
        let count = count.max(1.0);
        if count > FRAMES_MAX {
            return Err(Failure::input(format!(
                "a film of {count} pictures: {FRAMES_MAX} are the most; raise --speed, or choose a part by \
                 --from and --to"
            )));
        }
        let at = |number: u64| from_ns + (number as f64 * step_ns).round() as u64;
        Ok((0..count as u64)
            .map(|number| at(number).min(to_ns))
            .collect())
    }

    fn film(
        &self,
        options: &RenderOptions,
        film: &mut Film<'_>,
        times: &[u64],
    ) -> Result<usize, Failure> {
        let samples = match self.form {
            Form::Gif => self.samples(film, times)?,
            _ => Vec::new(),
        };
        let interrupted = interrupts();
        let bar = (!options.quiet).then(|| show::Steps::start(times.len() as u64, "pictures"));
        // While one picture is written the next one is drawn; no more than two are there at a time.
        let mut each = |add: &mut Add<'_>| {
            let mut next = Some(film.picture(times[0]).map_err(failed)?);
            let mut number = 0;
            while let Some(picture) = next {
                number += 1;
                let after = times.get(number);
                let draw = || after.map(|time_ns| film.picture(*time_ns)).transpose();
                let (added, drawn) = rayon::join(|| add(&picture), draw);
                // Ctrl-C reaches ffmpeg too.
                if interrupted.load(Ordering::Relaxed) {
                    return Err(Failure::interrupted());
                }
                added.map_err(failed)?;
                next = drawn.map_err(failed)?;
                if let Some(bar) = &bar {
                    bar.at(number as u64);
                }
            }
            Ok(())
        };
        match self.form {
            Form::Still => {}
            Form::Frames => {
                let mut frames = Frames::new(self.target).map_err(failed)?;
                each(&mut |picture| frames.add(picture))?;
            }
            Form::Mp4 => {
                let mp4 = Mp4::new(self.target, self.choices.size, self.rate_hz);
                let mut mp4 = mp4.map_err(failed)?;
                each(&mut |picture| mp4.add(picture))?;
                mp4.finish().map_err(failed)?;
            }
            Form::Gif => {
                publish(self.target, |file| -> Result<(), Unwritten> {
                    let out = BufWriter::new(file);
                    let mut gif = Gif::<BufWriter<&File>>::new(out, &samples, self.rate_hz)
                        .map_err(failed)?;
                    each(&mut |picture| gif.add(picture))?;
                    let out = gif.finish().map_err(failed)?;
                    let flushed = out
                        .into_inner()
                        .map_err(std::io::IntoInnerError::into_error);
                    flushed.map(|_| ()).map_err(Unwritten::from)
                })
                .map_err(|unwritten| match unwritten {
                    Unwritten::Failure(failure) => failure,
                    Unwritten::Io(error) => {
                        Failure::run(format!("cannot write {}: {error}", self.target.display()))
                    }
                })?;
            }
        }
        Ok(times.len())
    }

    /// Some pictures of the whole film.
    fn samples(&self, film: &mut Film<'_>, times: &[u64]) -> Result<Vec<Picture>, Failure> {
        let last = times.len() as u64 - 1;
        let count = SAMPLES.min(times.len() as u64);
        let places = (0..count).map(|k| last * k / (count - 1).max(1));
        places
            .map(|place| film.picture(times[place as usize]).map_err(failed))
            .collect()
    }
}

/// Puts the next picture into a film.
type Add<'a> = dyn FnMut(&Picture) -> Result<(), RenderError> + Send + 'a;

/// Why a file was not published.
enum Unwritten {
    Failure(Failure),
    Io(std::io::Error),
}

impl From<std::io::Error> for Unwritten {
    fn from(error: std::io::Error) -> Self {
        Self::Io(error)
    }
}

impl From<Failure> for Unwritten {
    fn from(failure: Failure) -> Self {
        Self::Failure(failure)
    }
}

/// Ctrl-C ends the film after the present picture, without a file; a second one ends the program at once.
fn interrupts() -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    run::on_interrupt(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
    interrupted
}

/// What was asked for and is not there is the user's to mend; what fails is not.
fn failed(error: RenderError) -> Failure {
    match error {
        RenderError::Read(_) | RenderError::Io { .. } | RenderError::Ffmpeg { .. } => {
            Failure::run(error)
        }
        _ => Failure::input(error),
    }
}

fn target(options: &RenderOptions) -> Result<(Form, &Path), Failure> {
    let ending = |path: &Path| {
        let ending = path.extension().and_then(|ending| ending.to_str());
        ending.map(str::to_ascii_lowercase).unwrap_or_default()
    };
    let (option, path) = match (&options.output, &options.video) {
        (Some(path), _) => ("--output", path.as_path()),
        (None, Some(path)) => ("--video", path.as_path()),
        (None, None) => {
            return Err(Failure::input(
                "no file to write is given: --output FILE.png for a picture, --video FILE for a film",
            ));
        }
    };
    let shown = path.display();
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
        return Err(Failure::input(format!(
            "{option} {shown}: there is no folder {}; make it first",
            folder.display()
        )));
    }
    match (option, ending(path).as_str()) {
        ("--output", "png") if is_numbered(path) => Err(Failure::input(format!(
            "--output {shown}: one picture has no number; for a film as pictures, write --video {shown}"
        ))),
        ("--output", "png") => Ok((Form::Still, path)),
        ("--output", "mp4" | "gif") => Err(Failure::input(format!(
            "--output {shown}: a picture is written as .png; for a film, write --video {shown}"
        ))),
        ("--output", _) => Err(Failure::input(format!(
            "--output {shown}: a picture is written as .png"
        ))),
        (_, "gif") => Ok((Form::Gif, path)),
        (_, "mp4") => Ok((Form::Mp4, path)),
        (_, "png") => Ok((Form::Frames, path)),
        _ => Err(Failure::input(format!(
            "--video {shown}: a film is written as .mp4, as .gif, or as pictures, film-%05d.png"
        ))),
    }
}

/// Whether a file name has the place for a number that pictures of a film have, `%d` or `%05d`.
fn is_numbered(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let mut parts = name.split('%').skip(1);
    parts.any(|part| {
        part.trim_start_matches(|digit: char| digit.is_ascii_digit())
            .starts_with('d')
    })
}
