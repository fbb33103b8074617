//! The gallery of the book: pictures of worlds and objects, and the page that shows them, from one list.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use toml::{Table, Value};

use crate::page;
use crate::plots::Plots;
use crate::program::{Profile, Program};
use crate::repo::Repo;
use crate::report::Report;

/// What is drawn.
const LIST: &str = "docs/book/gallery.toml";
/// The page.
const PAGE: &str = "docs/book/src/gallery.md";
/// The pictures' folder.
const IMAGES: &str = "docs/images/gallery";
/// The folder of the paper's figures.
const FIGURES: &str = "docs/images/figures";
/// A picture that is larger than this does not belong in a repository.
const BYTES_MAX: u64 = 80 * 1024;
/// The size of a picture.
const SIZE: &str = "450x300";

/// Draws all pictures, or those that are named, and writes the page.
pub(crate) fn draw(repo: &Repo, names: &[String]) -> Result<Report> {
    let text = std::fs::read_to_string(repo.path(LIST)).with_context(|| LIST.to_owned())?;
    let list: Table = text.parse().with_context(|| LIST.to_owned())?;
    let sections = sections(&list)?;
    let plots_of_runs = Plots::read(repo)?;
    for name in names {
        if plots_of_runs.has(name) {
            continue;
        }
        if !sections
            .iter()
            .flat_map(|s| &s.pictures)
            .any(|p| p.name == *name)
        {
            bail!("{LIST} has no picture `{name}`");
        }
    }
    let program = Program::build(repo, Profile::Dev)?;
    let room = repo.target_dir()?.join("gallery");
    std::fs::create_dir_all(&room)?;
    std::fs::create_dir_all(repo.path(IMAGES))?;
    let mut report = Report::of(String::new());
    let (mut drawn, mut plots) = (0, false);
    for picture in sections.iter().flat_map(|section| &section.pictures) {
        if !names.is_empty() && !names.contains(&picture.name) {
            continue;
        }
        if matches!(picture.source, Source::Plot) {
            plots = true;
            drawn += 1;
            continue;
        }
        if matches!(picture.source, Source::Page(_) | Source::Bench(_)) {
            continue;
        }
        let file = format!("{IMAGES}/{}.png", picture.name);
        let world = picture.world_file(&program, &room)?;
        let world = world.to_string_lossy().into_owned();
        let mut arguments = vec!["picture", &world, "-o", &file, "--size", SIZE];
        arguments.extend(picture.arguments.iter().map(String::as_str));
        program.stdout(&arguments)?;
        let bytes = std::fs::metadata(repo.path(&file))?.len();
        if bytes > BYTES_MAX {
            let fault = format!("{file}: {} KiB; 80 KiB are the most", bytes.div_ceil(1024));
            report.faults.push(fault);
        }
        drawn += 1;
    }
    let wanted: Vec<&Picture> = (sections.iter())
        .flat_map(|section| &section.pictures)
        .filter(|picture| names.is_empty() || names.contains(&picture.name))
        .collect();
    drawn += pages(repo, &program, &wanted, &mut report)?;
    drawn += benches(repo, &room, &wanted)?;
    if plots {
        let status = repo
            .cargo()
            .args(PLOTS)
            .status()
            .context("cannot run cargo")?;
        anyhow::ensure!(status.success(), "what sensors read cannot be drawn");
    }
    std::fs::write(repo.path(PAGE), page(&sections))?;
    let of_runs = plots_of_runs.draw(repo, &program, &room, names, &mut report)?;
    report.summary =
        format!("{drawn} pictures in {IMAGES}, {of_runs} plots of runs, and their pages");
    Ok(report)
}

/// Takes pictures of the page in a browser, if there is one.
fn pages(
    repo: &Repo,
    program: &Program<'_>,
    pictures: &[&Picture],
    report: &mut Report,
) -> Result<usize> {
    let names: Vec<&str> = (pictures.iter())
        .filter_map(|picture| match &picture.source {
            Source::Page(name) => Some(name.as_str()),
            _ => None,
        })
        .collect();
    if names.is_empty() {
        return Ok(0);
    }
    let Some(browser) = page::browser() else {
        let note =
            "pictures of the page are as they were: no Chromium found (CHROMIUM=PATH names one)";
        report.notes.push(note.to_owned());
        return Ok(0);
    };
    page::install(repo)?;
    let mut node = Command::new("node");
    node.arg("test/gallery.mjs")
        .arg(repo.path(IMAGES))
        .args(&names);
    node.env("SIMBEEOTIC", program.binary())
        .env("CHROMIUM", browser);
    page::run(&mut node, repo)?;
    Ok(names.len())
}

/// Runs the paper's experiments, with the program as released.
fn benches(repo: &Repo, room: &Path, pictures: &[&Picture]) -> Result<usize> {
    let mut program = None;
    let mut drawn = 0;
    for picture in pictures {
        let Source::Bench(figure) = &picture.source else {
            continue;
        };
        let program = match &mut program {
            Some(program) => program,
            None => program.insert(Program::build(repo, Profile::Release)?),
        };
        let folder = room.join(figure).to_string_lossy().into_owned();
        let mut arguments = vec!["bench", figure, "-o", &folder];
        arguments.extend(picture.arguments.iter().map(String::as_str));
        program.stdout(&arguments)?;
        let drawing = Path::new(&folder).join(format!("{figure}.svg"));
        let target = repo.path(FIGURES).join(format!("{figure}.svg"));
        std::fs::copy(&drawing, target).with_context(|| drawing.display().to_string())?;
        drawn += 1;
    }
    Ok(drawn)
}

struct Section {
    title: String,
    text: String,
    pictures: Vec<Picture>,
}

struct Picture {
    name: String,
    caption: String,
    source: Source,
    arguments: Vec<String>,
}

/// Draws what sensors read: all of [`Source::Plot`].
const PLOTS: [&str; 6] = [
    "run",
    "--quiet",
    "--package",
    "simbeeotic",
    "--example",
    "sensor_pictures",
];

/// Which world a picture is of.
enum Source {
    /// None: it is a plot of what a sensor read.
    Plot,
    /// A view of the page: its name in `test/gallery.mjs` of the page.
    Page(String),
    /// An experiment of `simbeeotic bench`.
    Bench(String),
    Generated(String),
    File(String),
    Written(String),
}

impl Picture {
    /// The file of its world, made if need be.
    fn world_file(&self, program: &Program<'_>, room: &Path) -> Result<PathBuf> {
        let made = room.join(format!("{}.toml", self.name));
        match &self.source {
            Source::Plot | Source::Page(_) | Source::Bench(_) => {}
            Source::File(file) => return Ok(PathBuf::from(file)),
            Source::Written(text) => std::fs::write(&made, text)?,
            Source::Generated(kind) => {
                let path = made.to_string_lossy().into_owned();
                program.stdout(&["world", kind, "--seed", "1", "--force", "-o", &path])?;
            }
        }
        Ok(made)
    }

    /// The commands that make it.
    fn commands(&self) -> String {
        let (mut commands, world) = match &self.source {
            Source::Plot => return format!("cargo {}", PLOTS.join(" ")),
            // The section says how.
            Source::Page(_) => return String::new(),
            Source::Bench(figure) => {
                let words = std::iter::once(format!("simbeeotic bench {figure}"));
                let words = words.chain(self.arguments.iter().cloned());
                return words.collect::<Vec<_>>().join(" ");
            }
            Source::File(file) => (String::new(), file.clone()),
            Source::Written(_) => (String::new(), format!("{}.toml", self.name)),
            Source::Generated(kind) => (
                format!("simbeeotic world {kind} --seed 1 -o {kind}.toml\n"),
                format!("{kind}.toml"),
            ),
        };
        let mut picture = format!("simbeeotic picture {world} -o {}.png", self.name);
        for argument in &self.arguments {
            let _ = write!(picture, " {argument}");
        }
        commands.push_str(&picture);
        commands
    }
}

fn sections(list: &Table) -> Result<Vec<Section>> {
    tables(list, "section")?
        .map(|section| {
            Ok(Section {
                title: text(section, "title")?,
                text: text(section, "text")?,
                pictures: tables(section, "picture")?
                    .map(picture)
                    .collect::<Result<_>>()?,
            })
        })
        .collect()
}

fn picture(table: &Table) -> Result<Picture> {
    let source = match (table.get("generate"), table.get("file"), table.get("world")) {
        (None, None, None) if table.contains_key("page") => Source::Page(text(table, "page")?),
        (None, None, None) if table.contains_key("bench") => Source::Bench(text(table, "bench")?),
        (None, None, None) if text(table, "name")?.starts_with("sensor-") => Source::Plot,
        (Some(_), None, None) => Source::Generated(text(table, "generate")?),
        (None, Some(_), None) => Source::File(text(table, "file")?),
        (None, None, Some(_)) => Source::Written(text(table, "world")?),
        _ => bail!("{LIST}: a picture has one of `generate`, `file` and `world`"),
    };
    let arguments = match table.get("arguments") {
        None => Vec::new(),
        Some(Value::Array(words)) => {
            let words = words.iter().filter_map(Value::as_str);
            words.map(str::to_owned).collect()
        }
        Some(_) => bail!("{LIST}: `arguments` is a list of words"),
    };
    Ok(Picture {
        name: text(table, "name")?,
        caption: text(table, "caption")?,
        source,
        arguments,
    })
}

fn tables<'a>(table: &'a Table, key: &str) -> Result<impl Iterator<Item = &'a Table>> {
    let list = table.get(key).and_then(Value::as_array);
    let list = list.with_context(|| format!("{LIST}: no [[{key}]]"))?;
    Ok(list.iter().filter_map(Value::as_table))
}

fn text(table: &Table, key: &str) -> Result<String> {
    let text = table.get(key).and_then(Value::as_str);
    Ok(text
        .with_context(|| format!("{LIST}: no `{key}`"))?
        .to_owned())
}

/// The page, as Markdown.
fn page(sections: &[Section]) -> String {
    let mut page = String::from(
        "# Gallery\n\nPictures of worlds are drawn by `simbeeotic picture`, with the camera that bees can carry. \
         `cargo xtask gallery`\ndraws all pictures and writes this page, from `docs/book/gallery.toml`.\n",
    );
    for section in sections {
        let _ = write!(page, "\n## {}\n", section.title);
        if !section.text.trim().is_empty() {
            let _ = write!(page, "\n{}\n", section.text.trim());
        }
        for picture in &section.pictures {
            let Picture { name, caption, .. } = picture;
            let file = match &picture.source {
                Source::Bench(figure) => format!("figures/{figure}.svg"),
                Source::Plot => format!("gallery/{name}.svg"),
                Source::Page(_) => format!("gallery/{name}.jpg"),
                _ => format!("gallery/{name}.png"),
            };
            let _ = write!(page, "\n{caption}\n\n![{name}](../../images/{file})\n");
            if matches!(picture.source, Source::Plot | Source::Page(_)) {
                // One command draws them all: the section says which.
            } else if let Source::Written(world) = &picture.source {
                let _ = write!(page, "\n```toml\n{}\n```\n", world.trim());
            } else {
                let _ = write!(page, "\n```sh\n{}\n```\n", picture.commands());
            }
        }
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXAMPLE: &str = r#"
        [[section]]
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
    "#;

    #[test]
    fn the_page_has_each_picture_with_what_makes_it() {
        let list: Table = EXAMPLE.parse().expect("a table");
        let page = page(&sections(&list).expect("sections"));
        for part in [
            "## Things",
            "![maze](../../images/gallery/maze.png)",
            "simbeeotic world maze --seed 1 -o maze.toml\nsimbeeotic picture maze.toml -o maze.png --kind depth",
            "```toml\n[[obstacle]]\n```",
        ] {
            assert!(page.contains(part), "{part} in {page}");
        }
    }

    #[test]
    fn a_picture_of_nothing_is_refused() {
        let list: Table = EXAMPLE
            .replace("generate = \"maze\"", "")
            .parse()
            .expect("a table");
        assert!(sections(&list).is_err());
    }
}
