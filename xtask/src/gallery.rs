//! The gallery of the book: the page, plots, the paper's figures, worlds, sensors; all pictures and the page that
//! shows them, from one list.
//!
//! Each picture is a piece of work by itself: one that fails is told with its reason, and all others are made. What is
//! left of a gallery that was broken off, or had failures, is made by `cargo xtask gallery rest`.

mod list;
mod page;
mod work;

use std::cell::OnceCell;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};
use toml::Table;

use crate::plots::{Plots, small};
use crate::program::{Profile, Program};
use crate::repo::Repo;
use crate::report::Report;
use crate::{figure, page as browser};
use list::{Picture, Section, Source, sections};
use work::Work;

/// What is drawn.
const LIST: &str = "docs/book/gallery.toml";
/// The page.
const PAGE: &str = "docs/book/src/gallery.md";
/// The pictures' folder.
const IMAGES: &str = "docs/images/gallery";
/// The folder of the paper's figures.
const FIGURES: &str = "docs/images/figures";
/// A picture of a world, and one made by commands, that is larger than this does not belong in a repository.
const BYTES_MAX: u64 = 80 * 1024;
const BYTES_MADE: u64 = 500 * 1024;
/// The size of a picture.
const SIZE: &str = "450x300";
/// What stands for all that is left of an earlier gallery.
const REST: &str = "rest";

/// Draws what sensors read: all of [`Source::Plot`].
const PLOTS: [&str; 6] = [
    "run",
    "--quiet",
    "--package",
    "simbeeotic",
    "--example",
    "sensor_pictures",
];

/// Draws all pictures, or those that are named, and writes the page.
pub(crate) fn draw(repo: &Repo, words: &[String]) -> Result<Report> {
    let text = std::fs::read_to_string(repo.path(LIST)).with_context(|| LIST.to_owned())?;
    let list: Table = text.parse().with_context(|| LIST.to_owned())?;
    let sections = sections(&list)?;
    let plots = Plots::read(repo)?;
    let room = repo.target_dir()?.join("gallery");
    std::fs::create_dir_all(&room)?;
    std::fs::create_dir_all(repo.path(IMAGES))?;
    let work = Work::at(&room);
    let (named, pieces) = match words {
        [word] if word == REST => {
            let rest = work.rest()?;
            let pieces = pieces(&sections, &plots, &rest);
            (rest, pieces)
        }
        _ => {
            let names = pictures_of(words, &sections, &plots)?;
            let pieces = pieces(&sections, &plots, &names);
            (names, pieces)
        }
    };
    if pieces.is_empty() {
        return Ok(Report::of("nothing is left to be drawn"));
    }
    // The page shows what there is, and does not depend on what is drawn now.
    std::fs::write(repo.path(PAGE), page::page(&sections, &plots))?;
    plots.write(repo)?;

    let studio = Studio::new(repo, &room, &pieces);
    let mut report = work.through(&pieces, |piece| studio.make(piece, &plots))?;
    if let Some(note) = studio.without_browser(&pieces) {
        match named.is_empty() {
            true => report.notes.push(note),
            // Somebody asked for them.
            false => report.faults.push(note),
        }
    }
    Ok(report)
}

/// The pictures that words name: each names one, or a section, which is all of its pictures.
fn pictures_of(words: &[String], sections: &[Section], plots: &Plots) -> Result<Vec<String>> {
    let mut names = Vec::new();
    for word in words {
        let section = sections.iter().find(|section| section.name == *word);
        if let Some(section) = section {
            names.extend(section.pictures.iter().map(|picture| picture.name.clone()));
            if section.plots {
                names.extend(plots.names().map(str::to_owned));
            }
            continue;
        }
        let pictures = sections.iter().flat_map(|section| &section.pictures);
        let known = pictures.map(|picture| picture.name.as_str());
        if !known.chain(plots.names()).any(|name| name == word) {
            let all: Vec<&str> = sections
                .iter()
                .map(|section| section.name.as_str())
                .collect();
            bail!(
                "{LIST} has no picture and no section `{word}`; sections are {}, and `{REST}` is what is left of the \
                 last gallery",
                all.join(", ")
            );
        }
        names.push(word.clone());
    }
    Ok(names)
}

/// What is made at once: a picture, or several that one command makes.
struct Piece<'a> {
    what: What<'a>,
    /// The pictures that come of it.
    names: Vec<String>,
}

#[derive(Clone, Copy)]
enum What<'a> {
    /// A picture by itself.
    Picture(&'a Picture),
    /// All that the paper's Figure 9, or 10, shows.
    Figure(&'a str),
    /// All that sensors read.
    Sensors,
    /// A plot of runs.
    Plot,
}

/// What is to be made for these pictures, or for all; each once, the quick before the slow.
fn pieces<'a>(sections: &'a [Section], plots: &Plots, names: &[String]) -> Vec<Piece<'a>> {
    let wanted = |name: &str| names.is_empty() || names.iter().any(|other| other == name);
    let mut pieces: Vec<Piece<'a>> = Vec::new();
    let pictures = sections.iter().flat_map(|section| &section.pictures);
    for picture in pictures.filter(|picture| wanted(&picture.name)) {
        let what = match &picture.source {
            Source::Figure { number, .. } => What::Figure(number),
            Source::Plot => What::Sensors,
            _ => What::Picture(picture),
        };
        let same = |piece: &&mut Piece<'_>| match (piece.what, what) {
            (What::Figure(a), What::Figure(b)) => a == b,
            (What::Sensors, What::Sensors) => true,
            _ => false,
        };
        match pieces.iter_mut().find(same) {
            Some(piece) => piece.names.push(picture.name.clone()),
            None => pieces.push(Piece {
                what,
                names: vec![picture.name.clone()],
            }),
        }
    }
    if sections.iter().any(|section| section.plots) {
        for name in plots.names().filter(|name| wanted(name)) {
            pieces.push(Piece {
                what: What::Plot,
                names: vec![name.to_owned()],
            });
        }
    }
    pieces.sort_by_key(Piece::is_slow);
    pieces
}

impl Piece<'_> {
    /// Whether it takes minutes.
    fn is_slow(&self) -> bool {
        match self.what {
            What::Figure(_) => true,
            What::Picture(picture) => matches!(picture.source, Source::Bench(_)),
            What::Sensors | What::Plot => false,
        }
    }

    /// Whether it is a picture of the page.
    fn is_of_page(&self) -> bool {
        matches!(self.what, What::Picture(picture) if matches!(picture.source, Source::Page(_)))
    }
}

/// What pictures are made with: programs, which are built when the first picture needs them.
struct Studio<'a> {
    repo: &'a Repo,
    room: &'a Path,
    profile: Profile,
    program: OnceCell<Program<'a>>,
    release: OnceCell<Program<'a>>,
    examples: OnceCell<Program<'a>>,
    browser: Option<PathBuf>,
    installed: OnceCell<()>,
}

impl<'a> Studio<'a> {
    fn new(repo: &'a Repo, room: &'a Path, pieces: &[Piece<'_>]) -> Self {
        // Who has to wait for the fast program anyhow draws all with it.
        let profile = match pieces.iter().any(Piece::is_slow) {
            true => Profile::Release,
            false => Profile::Dev,
        };
        Self {
            repo,
            room,
            profile,
            program: OnceCell::new(),
            release: OnceCell::new(),
            examples: OnceCell::new(),
            browser: browser::browser(),
            installed: OnceCell::new(),
        }
    }

    /// What is said if pictures of the page are wanted and there is no browser.
    fn without_browser(&self, pieces: &[Piece<'_>]) -> Option<String> {
        let of_page = pieces.iter().filter(|piece| piece.is_of_page());
        let names: Vec<&str> = of_page
            .flat_map(|piece| &piece.names)
            .map(String::as_str)
            .collect();
        (self.browser.is_none() && !names.is_empty()).then(|| {
            format!(
                "{} are as they were: no Chromium found; install one (Debian: apt-get install chromium), or name it \
                 by CHROMIUM=PATH",
                names.join(", ")
            )
        })
    }

    /// Makes a piece; tells whether it could be made here.
    fn make(&self, piece: &Piece<'_>, plots: &Plots) -> Result<bool> {
        match piece.what {
            What::Picture(picture) => match &picture.source {
                Source::Page(name) => return self.of_page(name),
                Source::Bench(figure) => self.bench(figure, &picture.arguments)?,
                Source::Commands {
                    file,
                    commands,
                    examples,
                } => {
                    let program = match examples {
                        true => self.with_examples()?,
                        false => self.program()?,
                    };
                    self.commands(program, picture, file, commands)?;
                }
                _ => self.world(picture)?,
            },
            What::Figure(number) => {
                figure::draw(self.repo, &[number.to_owned()])?;
            }
            What::Sensors => {
                let mut cargo = self.repo.cargo();
                let status = cargo.args(PLOTS).status().context("cannot run cargo")?;
                ensure!(status.success(), "what sensors read cannot be drawn");
            }
            What::Plot => {
                let program = self.program()?;
                for name in &piece.names {
                    plots.draw(self.repo, program, self.room, name)?;
                }
            }
        }
        Ok(true)
    }

    fn program(&self) -> Result<&Program<'a>> {
        match self.profile {
            Profile::Dev => once(&self.program, || Program::build(self.repo, Profile::Dev)),
            Profile::Release => self.release(),
        }
    }

    fn release(&self) -> Result<&Program<'a>> {
        once(&self.release, || {
            Program::build(self.repo, Profile::Release)
        })
    }

    fn with_examples(&self) -> Result<&Program<'a>> {
        once(&self.examples, || {
            Program::with_examples(self.repo, self.profile)
        })
    }

    /// Takes a picture of the page in a browser, if there is one.
    fn of_page(&self, name: &str) -> Result<bool> {
        let Some(chromium) = &self.browser else {
            return Ok(false);
        };
        once(&self.installed, || browser::install(self.repo))?;
        let program = self.program()?;
        let mut node = Command::new("node");
        node.arg("test/gallery.mjs")
            .arg(self.repo.path(IMAGES))
            .arg(name);
        node.env("SIMBEEOTIC", program.binary())
            .env("CHROMIUM", chromium);
        browser::run(&mut node, self.repo)?;
        Ok(true)
    }

    /// Runs one of the paper's experiments, with the program as released.
    fn bench(&self, figure: &str, options: &[String]) -> Result<()> {
        let folder = self.room.join(figure).to_string_lossy().into_owned();
        let mut arguments = vec!["bench", figure, "-o", &folder];
        arguments.extend(options.iter().map(String::as_str));
        self.release()?.stdout(&arguments)?;
        // With even axes, and with logarithmic ones.
        for name in [format!("{figure}.svg"), format!("{figure}-log.svg")] {
            let drawing = Path::new(&folder).join(&name);
            let target = self.repo.path(FIGURES).join(&name);
            std::fs::copy(&drawing, target).with_context(|| drawing.display().to_string())?;
        }
        Ok(())
    }

    /// Runs commands, the last of which makes the picture.
    fn commands(
        &self,
        program: &Program<'_>,
        picture: &Picture,
        file: &str,
        commands: &[Vec<String>],
    ) -> Result<()> {
        let out = self.room.join(&picture.name);
        if out.exists() {
            std::fs::remove_dir_all(&out).with_context(|| out.display().to_string())?;
        }
        std::fs::create_dir_all(&out).with_context(|| out.display().to_string())?;
        let out = out.to_string_lossy();
        let file = format!("docs/images/{file}");
        for words in commands {
            let words = words.iter();
            let words: Vec<String> = words
                .map(|word| word.replace("{out}", &out).replace("{picture}", &file))
                .collect();
            program.stdout(&words.iter().map(String::as_str).collect::<Vec<_>>())?;
        }
        small(self.repo, &file, BYTES_MADE)
    }

    /// Draws a world.
    fn world(&self, picture: &Picture) -> Result<()> {
        let program = self.program()?;
        let file = format!("{IMAGES}/{}.png", picture.name);
        let made = self.room.join(format!("{}.toml", picture.name));
        let path = made.to_string_lossy().into_owned();
        let world = match &picture.source {
            Source::File(file) => file.clone(),
            Source::Generated(kind) => {
                program.stdout(&["world", kind, "--seed", "1", "--force", "-o", &path])?;
                path
            }
            Source::Written(text) => {
                std::fs::write(&made, text)?;
                path
            }
            _ => bail!("`{}` is no picture of a world", picture.name),
        };
        let mut arguments = vec!["picture", &world, "-o", &file, "--size", SIZE];
        arguments.extend(picture.arguments.iter().map(String::as_str));
        program.stdout(&arguments)?;
        small(self.repo, &file, BYTES_MAX)
    }
}

/// What is there, or is made now; a failure is made again by the next who needs it.
fn once<T>(cell: &OnceCell<T>, make: impl FnOnce() -> Result<T>) -> Result<&T> {
    match cell.get() {
        Some(there) => Ok(there),
        None => {
            let made = make()?;
            Ok(cell.get_or_init(|| made))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXAMPLE: &str = r#"
        [[section]]
        name = "things"
        title = "Things"
        text = "Some."
        [[section.picture]]
        name = "maze"
        caption = "A maze."
        generate = "maze"
        arguments = ["--kind", "depth"]
        [[section.picture]]
        name = "box"
        caption = "A box."
        world = "[[obstacle]]"
        [[section.picture]]
        name = "map"
        caption = "A map."
        figure = "10"
        drawing = "map.svg"
        [[section.picture]]
        name = "trips"
        caption = "Trips."
        figure = "10"
        drawing = "trips.svg"
        [[section]]
        name = "others"
        title = "Others"
        text = ""
        elsewhere = true
        [[section.picture]]
        name = "film"
        caption = "A film."
        drawing = "film.gif"
        commands = [["run", "a.toml", "--record", "{out}/a.mcap"], ["render", "{out}/a.mcap", "--video", "{picture}", "--to", "2 s"]]
        [[section]]
        name = "plots"
        title = "Plots"
        text = ""
        plots = true
    "#;

    fn plots() -> Plots {
        let list = r#"
            intro = "Plots."
            [[plot]]
            title = "Flights"
            name = "traces"
            ending = "svg"
            text = "A run."
            runs = [["a.toml"]]
            arguments = ["traces"]
        "#;
        Plots::parse(list).expect("a list")
    }

    fn listed(text: &str) -> Result<Vec<Section>> {
        sections(&text.parse().expect("a table"))
    }

    #[test]
    fn the_page_has_each_picture_with_what_makes_it() {
        let page = page::page(&listed(EXAMPLE).expect("sections"), &plots());
        for part in [
            "## Things",
            "![maze](../../images/gallery/maze.png)",
            "simbeeotic world maze --seed 1 -o maze.toml\nsimbeeotic picture maze.toml -o maze.png --kind depth",
            "```toml\n[[obstacle]]\n```",
            "![map](../../images/figures/map.svg)\n\n```sh\ncargo xtask figure 10\n```",
            "## Plots\n\nFlights.\n\n![Flights](../../images/plots/traces.svg)",
            "simbeeotic plot traces traces.mcap -o traces.svg",
        ] {
            assert!(page.contains(part), "{part} in {page}");
        }
        assert!(!page.contains("film"), "another page shows it: {page}");
        let here = EXAMPLE.replace("elsewhere = true", "");
        let page = page::page(&listed(&here).expect("sections"), &plots());
        let film = "![film](../../images/film.gif)\n\n```sh\nsimbeeotic run a.toml --record a.mcap\n\
                    simbeeotic render a.mcap --video film.gif --to '2 s'\n```";
        assert!(page.contains(film), "{page}");
    }

    #[test]
    fn a_name_is_of_a_picture_or_of_all_of_a_section() {
        let sections = listed(EXAMPLE).expect("sections");
        let named = |words: &[&str]| {
            let words: Vec<String> = words.iter().map(|word| (*word).to_owned()).collect();
            pictures_of(&words, &sections, &plots())
        };
        assert_eq!(
            named(&["things"]).expect("a section"),
            ["maze", "box", "map", "trips"]
        );
        assert_eq!(named(&["box", "plots"]).expect("both"), ["box", "traces"]);
        assert_eq!(named(&["traces"]).expect("a plot"), ["traces"]);
        let said = named(&["tings"]).expect_err("a slip").to_string();
        assert!(
            said.contains("sections are things, others, plots"),
            "{said}"
        );
    }

    #[test]
    fn what_one_command_makes_is_made_once_and_slow_pictures_are_last() {
        let sections = listed(EXAMPLE).expect("sections");
        let made = |names: &[&str]| -> Vec<Vec<String>> {
            let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
            let pieces = pieces(&sections, &plots(), &names).into_iter();
            pieces.map(|piece| piece.names).collect()
        };
        let all: [&[&str]; 5] = [
            &["maze"],
            &["box"],
            &["film"],
            &["traces"],
            &["map", "trips"],
        ];
        assert_eq!(made(&[]), all);
        assert_eq!(made(&["trips", "box"]), [["box"], ["trips"]]);
    }

    #[test]
    fn a_picture_of_nothing_is_refused() {
        assert!(listed(&EXAMPLE.replace("generate = \"maze\"", "")).is_err());
        assert!(listed(&EXAMPLE.replace("drawing = \"map.svg\"", "")).is_err());
        assert!(listed(&EXAMPLE.replace("commands = [[", "commands = [[1], [")).is_err());
    }
}
