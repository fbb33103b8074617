//! The gallery of the book: the page, plots, the paper's figures, worlds, sensors; all pictures and the page that
//! shows them, from one list.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use toml::{Table, Value};

use crate::plots::Plots;
use crate::program::{Profile, Program};
use crate::repo::Repo;
use crate::report::Report;
use crate::{figure, page};

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
    let names = &pictures_of(names, &sections, &plots_of_runs)?;
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
        if !matches!(
            picture.source,
            Source::Generated(_) | Source::File(_) | Source::Written(_)
        ) {
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
    drawn += figures(repo, &wanted)?;
    if plots {
        let status = repo
            .cargo()
            .args(PLOTS)
            .status()
            .context("cannot run cargo")?;
        anyhow::ensure!(status.success(), "what sensors read cannot be drawn");
    }
    std::fs::write(repo.path(PAGE), page(&sections, &plots_of_runs))?;
    let of_runs = plots_of_runs.draw(repo, &program, &room, names, &mut report)?;
    report.summary =
        format!("{drawn} pictures in {IMAGES}, {of_runs} plots of runs, and their pages");
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
                "{LIST} has no picture and no section `{word}`; sections are {}",
                all.join(", ")
            );
        }
        names.push(word.clone());
    }
    Ok(names)
}

/// Makes the paper's Figures 9 and 10, each once.
fn figures(repo: &Repo, pictures: &[&Picture]) -> Result<usize> {
    let mut numbers: Vec<String> = Vec::new();
    let mut drawn = 0;
    for picture in pictures {
        if let Source::Figure { number, .. } = &picture.source {
            drawn += 1;
            if !numbers.contains(number) {
                numbers.push(number.clone());
            }
        }
    }
    if !numbers.is_empty() {
        figure::draw(repo, &numbers)?;
    }
    Ok(drawn)
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
        // With even axes, and with logarithmic ones.
        for name in [format!("{figure}.svg"), format!("{figure}-log.svg")] {
            let drawing = Path::new(&folder).join(&name);
            let target = repo.path(FIGURES).join(&name);
            std::fs::copy(&drawing, target).with_context(|| drawing.display().to_string())?;
        }
        drawn += 1;
    }
    Ok(drawn)
}

struct Section {
    /// What it is called by on the command line.
    name: String,
    title: String,
    text: String,
    pictures: Vec<Picture>,
    /// Whether all plots of runs follow.
    plots: bool,
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
    /// A picture of what `cargo xtask figure` makes: the number, and the file.
    Figure {
        number: String,
        file: String,
    },
    Generated(String),
    File(String),
    Written(String),
}

impl Picture {
    /// The file of its world, made if need be.
    fn world_file(&self, program: &Program<'_>, room: &Path) -> Result<PathBuf> {
        let made = room.join(format!("{}.toml", self.name));
        match &self.source {
            Source::Plot | Source::Page(_) | Source::Bench(_) | Source::Figure { .. } => {}
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
            Source::Figure { number, .. } => return format!("cargo xtask figure {number}"),
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
            let plots = section.get("plots").and_then(Value::as_bool) == Some(true);
            let pictures = match section.contains_key("picture") || !plots {
                true => tables(section, "picture")?
                    .map(picture)
                    .collect::<Result<_>>()?,
                false => Vec::new(),
            };
            Ok(Section {
                name: text(section, "name")?,
                title: text(section, "title")?,
                text: text(section, "text")?,
                pictures,
                plots,
            })
        })
        .collect()
}

fn picture(table: &Table) -> Result<Picture> {
    let source = match (table.get("generate"), table.get("file"), table.get("world")) {
        (None, None, None) if table.contains_key("page") => Source::Page(text(table, "page")?),
        (None, None, None) if table.contains_key("bench") => Source::Bench(text(table, "bench")?),
        (None, None, None) if table.contains_key("figure") => Source::Figure {
            number: text(table, "figure")?,
            file: text(table, "drawing")?,
        },
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
fn page(sections: &[Section], plots: &Plots) -> String {
    let names: Vec<String> = (sections.iter())
        .map(|section| format!("`{}`", section.name))
        .collect();
    let mut page = format!(
        "# Gallery\n\n`cargo xtask gallery` makes all pictures anew and writes this page, from \
         `docs/book/gallery.toml` and\n`docs/book/plots.toml`. With names it makes those alone: of a picture, or \
         of a section:\n{}.\n",
        names.join(", ")
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
                Source::Figure { file, .. } => format!("figures/{file}"),
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
        if section.plots {
            page.push_str(&plots.shown());
        }
    }
    page
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
        let page = page(&listed(EXAMPLE).expect("sections"), &plots());
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
            ["maze", "box", "map"]
        );
        assert_eq!(named(&["box", "plots"]).expect("both"), ["box", "traces"]);
        assert_eq!(named(&["traces"]).expect("a plot"), ["traces"]);
        let said = named(&["tings"]).expect_err("a slip").to_string();
        assert!(said.contains("sections are things, plots"), "{said}");
    }

    #[test]
    fn a_picture_of_nothing_is_refused() {
        assert!(listed(&EXAMPLE.replace("generate = \"maze\"", "")).is_err());
        assert!(listed(&EXAMPLE.replace("drawing = \"map.svg\"", "")).is_err());
    }
}
