//! Plots of the book: the runs they are of, the pictures, and the page that shows them, from one list.

use std::fmt::Write as _;
use std::path::Path;

use anyhow::{Context, Result, bail, ensure};
use toml::{Table, Value};

use crate::program::Program;
use crate::repo::Repo;

/// What is drawn.
const LIST: &str = "docs/book/plots.toml";
/// The page.
const PAGE: &str = "docs/book/src/plots.md";
/// The pictures' folder.
const IMAGES: &str = "docs/images/plots";
/// A picture that is larger than this does not belong in a repository.
const BYTES_MAX: u64 = 150 * 1024;

/// The list.
pub(crate) struct Plots {
    intro: String,
    plots: Vec<Plot>,
}

struct Plot {
    title: String,
    name: String,
    ending: String,
    text: String,
    runs: Runs,
    arguments: Vec<String>,
}

/// What a picture is of.
enum Runs {
    /// Arguments of `simbeeotic run`, and the name of the recording, of each run.
    Single(Vec<(Vec<String>, String)>),
    /// Arguments of `simbeeotic sweep`. It fills a folder and a table that are called as the picture is.
    Sweep(Vec<String>),
}

impl Plots {
    /// Reads the list.
    pub(crate) fn read(repo: &Repo) -> Result<Self> {
        let text = std::fs::read_to_string(repo.path(LIST)).with_context(|| LIST.to_owned())?;
        Self::parse(&text)
    }

    pub(crate) fn parse(text: &str) -> Result<Self> {
        let list: Table = text.parse().with_context(|| LIST.to_owned())?;
        let plots = list.get("plot").and_then(Value::as_array);
        let plots = plots.with_context(|| format!("{LIST}: no [[plot]]"))?;
        Ok(Self {
            intro: word(&list, "intro")?,
            plots: (plots.iter().filter_map(Value::as_table))
                .map(Plot::parse)
                .collect::<Result<_>>()?,
        })
    }

    /// Draws a picture.
    ///
    /// # Errors
    /// It has no such picture; a run fails; the picture is too large for a repository.
    pub(crate) fn draw(
        &self,
        repo: &Repo,
        program: &Program<'_>,
        room: &Path,
        name: &str,
    ) -> Result<()> {
        let plot = self.plots.iter().find(|plot| plot.name == name);
        let plot = plot.with_context(|| format!("{LIST} has no picture `{name}`"))?;
        std::fs::create_dir_all(repo.path(IMAGES))?;
        let inputs = plot.run(program, room)?;
        let file = format!("{IMAGES}/{}.{}", plot.name, plot.ending);
        let mut arguments = vec!["plot", plot.arguments[0].as_str()];
        arguments.extend(inputs.iter().map(String::as_str));
        arguments.extend(["-o", &file]);
        arguments.extend(plot.arguments[1..].iter().map(String::as_str));
        program.stdout(&arguments)?;
        small(repo, &file, BYTES_MAX)
    }

    /// Writes the page.
    pub(crate) fn write(&self, repo: &Repo) -> Result<()> {
        std::fs::write(repo.path(PAGE), self.page()).with_context(|| PAGE.to_owned())
    }

    /// The page, as Markdown.
    fn page(&self) -> String {
        let mut page = format!("# Plots\n\n{}\n", self.intro.trim());
        for plot in &self.plots {
            let _ = write!(page, "\n## {}\n\n{}\n", plot.title, plot.text.trim());
            page.push_str(&plot.shown());
        }
        page.push_str(
            "\n`cargo xtask gallery plots` draws all of them and writes this page, from `docs/book/plots.toml`.\n",
        );
        page
    }

    /// All pictures for another page, with their titles and commands.
    pub(crate) fn shown(&self) -> String {
        let plots = self.plots.iter();
        let shown = plots.map(|plot| format!("\n{}.\n{}", plot.title, plot.shown()));
        shown.collect()
    }

    /// The names of all pictures.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.plots.iter().map(|plot| plot.name.as_str())
    }
}

impl Plot {
    fn parse(table: &Table) -> Result<Self> {
        let name = word(table, "name")?;
        let runs = match (table.get("runs"), table.get("sweep")) {
            (Some(Value::Array(runs)), None) if !runs.is_empty() => {
                let runs = runs.iter().enumerate().map(|(at, run)| {
                    let recording = match runs.len() {
                        1 => format!("{name}.mcap"),
                        _ => format!("{name}-{at}.mcap"),
                    };
                    Ok((words(run, &name)?, recording))
                });
                Runs::Single(runs.collect::<Result<Vec<_>>>()?)
            }
            (None, Some(sweep)) => Runs::Sweep(words(sweep, &name)?),
            _ => bail!("{LIST}: {name} has either `runs` or a `sweep`"),
        };
        let arguments = table.get("arguments");
        let arguments = arguments.with_context(|| format!("{LIST}: {name} has no `arguments`"))?;
        let arguments = words(arguments, &name)?;
        if arguments.is_empty() {
            bail!("{LIST}: {name} draws nothing");
        }
        Ok(Self {
            title: word(table, "title")?,
            ending: word(table, "ending")?,
            text: word(table, "text")?,
            name,
            runs,
            arguments,
        })
    }

    /// Runs what it is of. Tells the files, or the folder, that it is drawn from.
    fn run(&self, program: &Program<'_>, room: &Path) -> Result<Vec<String>> {
        let path = |name: &str| room.join(name).to_string_lossy().into_owned();
        match &self.runs {
            Runs::Single(runs) => {
                let runs = runs.iter().map(|(run, name)| {
                    let file = path(name);
                    let mut arguments = vec!["run", "--quiet", "--record", &file];
                    arguments.extend(run.iter().map(String::as_str));
                    program.stdout(&arguments)?;
                    Ok(file)
                });
                runs.collect()
            }
            Runs::Sweep(sweep) => {
                let (folder, table) = (path(&self.name), path(&format!("{}.csv", self.name)));
                // What an earlier sweep left would be drawn, too.
                if Path::new(&folder).exists() {
                    std::fs::remove_dir_all(&folder).with_context(|| folder.clone())?;
                }
                let mut arguments = vec!["sweep"];
                arguments.extend(sweep.iter().map(String::as_str));
                arguments.extend(["--quiet", "-o", &table]);
                if !self.is_of_table() {
                    arguments.extend(["--record", &folder]);
                }
                program.stdout(&arguments)?;
                Ok(vec![if self.is_of_table() { table } else { folder }])
            }
        }
    }

    /// Whether it is drawn from a table of runs.
    fn is_of_table(&self) -> bool {
        self.arguments[0] == "sweep"
    }

    /// The picture and its commands, as Markdown.
    fn shown(&self) -> String {
        let Self {
            title,
            name,
            ending,
            ..
        } = self;
        let commands = self.commands();
        format!("\n![{title}](../../images/plots/{name}.{ending})\n\n```sh\n{commands}\n```\n")
    }

    /// The commands that make it.
    fn commands(&self) -> String {
        let mut commands = String::new();
        let name = &self.name;
        let inputs = match &self.runs {
            Runs::Single(runs) => {
                for (run, file) in runs {
                    let _ = writeln!(commands, "simbeeotic run {} --record {file}", line(run));
                }
                let files: Vec<&str> = runs.iter().map(|(_, file)| file.as_str()).collect();
                files.join(" ")
            }
            Runs::Sweep(sweep) if self.is_of_table() => {
                let _ = writeln!(commands, "simbeeotic sweep {} -o {name}.csv", line(sweep));
                format!("{name}.csv")
            }
            Runs::Sweep(sweep) => {
                let _ = writeln!(commands, "simbeeotic sweep {} --record {name}", line(sweep));
                name.clone()
            }
        };
        let _ = write!(
            commands,
            "simbeeotic plot {} {inputs} -o {name}.{}",
            self.arguments[0], self.ending
        );
        if self.arguments.len() > 1 {
            let _ = write!(commands, " {}", line(&self.arguments[1..]));
        }
        commands
    }
}

/// Checks that a picture is not larger than belongs in a repository.
pub(crate) fn small(repo: &Repo, file: &str, bytes_max: u64) -> Result<()> {
    let path = repo.path(file);
    let bytes = std::fs::metadata(&path)
        .with_context(|| file.to_owned())?
        .len();
    ensure!(
        bytes <= bytes_max,
        "{file}: {} KiB; {} KiB are the most",
        bytes.div_ceil(1024),
        bytes_max / 1024
    );
    Ok(())
}

fn line(words: &[String]) -> String {
    let words = words.iter().map(|word| quoted(word));
    words.collect::<Vec<_>>().join(" ")
}

/// A word as a shell takes it.
pub(crate) fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=./:,".contains(c);
    match word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{word}'"),
    }
}

fn word(table: &Table, key: &str) -> Result<String> {
    let text = table.get(key).and_then(Value::as_str);
    Ok(text
        .with_context(|| format!("{LIST}: no `{key}`"))?
        .to_owned())
}

fn words(value: &Value, name: &str) -> Result<Vec<String>> {
    let list = value.as_array();
    let list = list.with_context(|| format!("{LIST}: {name}: a list of words is wanted"))?;
    let words = list.iter().map(|word| word.as_str().map(str::to_owned));
    words
        .collect::<Option<Vec<_>>>()
        .with_context(|| format!("{LIST}: {name}: a list of words is wanted"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXAMPLE: &str = r#"
        intro = "Plots."
        [[plot]]
        title = "One"
        name = "one"
        ending = "svg"
        text = "A run."
        runs = [["scenarios/talk.toml", "--end-time", "5 s"]]
        arguments = ["traces", "--title", "It is"]
        [[plot]]
        title = "Many"
        name = "many"
        ending = "png"
        text = "Runs."
        sweep = ["a.toml", "--seeds", "2", "--vary", "model.bee.count=1,2"]
        arguments = ["series"]
        [[plot]]
        title = "Table"
        name = "table"
        ending = "svg"
        text = "What it came to."
        sweep = ["a.toml", "--seeds", "2"]
        arguments = ["sweep", "--x", "seed"]
    "#;

    #[test]
    fn the_page_has_each_plot_with_what_makes_it() {
        let plots = Plots::parse(EXAMPLE).expect("a list");
        assert!(plots.names().eq(["one", "many", "table"]));
        let page = plots.page();
        for part in [
            "## One\n\nA run.\n\n![One](../../images/plots/one.svg)",
            "simbeeotic run scenarios/talk.toml --end-time '5 s' --record one.mcap\n\
             simbeeotic plot traces one.mcap -o one.svg --title 'It is'",
            "simbeeotic sweep a.toml --seeds 2 --vary model.bee.count=1,2 --record many\n\
             simbeeotic plot series many -o many.png",
            "simbeeotic sweep a.toml --seeds 2 -o table.csv\n\
             simbeeotic plot sweep table.csv -o table.svg --x seed",
        ] {
            assert!(page.contains(part), "{part} is not in {page}");
        }
        let shown = plots.shown();
        assert!(
            shown.contains("\nMany.\n\n![Many](../../images/plots/many.png)"),
            "{shown}"
        );
    }

    #[test]
    fn a_plot_of_nothing_is_refused() {
        let none = EXAMPLE.replace("runs = ", "walks = ");
        assert!(Plots::parse(&none).is_err());
    }
}
