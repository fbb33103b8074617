//! Plots of the book: the runs they are of, the pictures, and the page that shows them, from one list.

use std::fmt::Write as _;
use std::path::Path;

use anyhow::{Context, Result, bail};
use toml::{Table, Value};

use crate::program::Program;
use crate::repo::Repo;
use crate::report::Report;

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
    /// Arguments of `simbeeotic run`, and the name of the recording.
    runs: Vec<(Vec<String>, String)>,
    arguments: Vec<String>,
}

impl Plots {
    /// Reads the list.
    pub(crate) fn read(repo: &Repo) -> Result<Self> {
        let text = std::fs::read_to_string(repo.path(LIST)).with_context(|| LIST.to_owned())?;
        Self::parse(&text)
    }

    fn parse(text: &str) -> Result<Self> {
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

    /// Whether it has a picture of this name.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.plots.iter().any(|plot| plot.name == name)
    }

    /// Draws all pictures, or those that are named, and writes the page.
    pub(crate) fn draw(
        &self,
        repo: &Repo,
        program: &Program<'_>,
        room: &Path,
        names: &[String],
        report: &mut Report,
    ) -> Result<usize> {
        std::fs::create_dir_all(repo.path(IMAGES))?;
        let mut drawn = 0;
        for plot in &self.plots {
            if !names.is_empty() && !names.contains(&plot.name) {
                continue;
            }
            let mut recordings = Vec::new();
            for (run, name) in &plot.runs {
                let file = room.join(name).to_string_lossy().into_owned();
                let mut arguments = vec!["run", "--quiet", "--record", &file];
                arguments.extend(run.iter().map(String::as_str));
                program.stdout(&arguments)?;
                recordings.push(file);
            }
            let file = format!("{IMAGES}/{}.{}", plot.name, plot.ending);
            let mut arguments = vec!["plot", plot.arguments[0].as_str()];
            arguments.extend(recordings.iter().map(String::as_str));
            arguments.extend(["-o", &file]);
            arguments.extend(plot.arguments[1..].iter().map(String::as_str));
            program.stdout(&arguments)?;
            let bytes = std::fs::metadata(repo.path(&file))?.len();
            if bytes > BYTES_MAX {
                let fault = format!("{file}: {} KiB; 150 KiB are the most", bytes.div_ceil(1024));
                report.faults.push(fault);
            }
            drawn += 1;
        }
        std::fs::write(repo.path(PAGE), self.page())?;
        Ok(drawn)
    }

    /// The page, as Markdown.
    fn page(&self) -> String {
        let mut page = format!("# Plots\n\n{}\n", self.intro.trim());
        for plot in &self.plots {
            let Plot {
                title,
                name,
                ending,
                text,
                ..
            } = plot;
            let _ = write!(
                page,
                "\n## {title}\n\n{}\n\n![{title}](../../images/plots/{name}.{ending})\n\n```sh\n{}\n```\n",
                text.trim(),
                plot.commands()
            );
        }
        page.push_str(
            "\n`cargo xtask gallery` draws all of them and writes this page, from `docs/book/plots.toml`.\n",
        );
        page
    }
}

impl Plot {
    fn parse(table: &Table) -> Result<Self> {
        let name = word(table, "name")?;
        let runs = match (table.get("runs"), table.get("sweep")) {
            (Some(Value::Array(runs)), None) => {
                let runs = runs.iter().enumerate().map(|(at, run)| {
                    let recording = match runs.len() {
                        1 => format!("{name}.mcap"),
                        _ => format!("{name}-{at}.mcap"),
                    };
                    Ok((words(run, &name)?, recording))
                });
                runs.collect::<Result<Vec<_>>>()?
            }
            (None, Some(Value::Table(sweep))) => sweep_runs(sweep, &name)?,
            _ => bail!("{LIST}: {name} has either `runs` or a `sweep`"),
        };
        let arguments = table.get("arguments");
        let arguments = arguments.with_context(|| format!("{LIST}: {name} has no `arguments`"))?;
        let arguments = words(arguments, &name)?;
        if arguments.is_empty() || runs.is_empty() {
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

    /// The commands that make it.
    fn commands(&self) -> String {
        let mut commands = String::new();
        const SHOWN: usize = 2;
        for (run, file) in self.runs.iter().take(SHOWN) {
            let _ = writeln!(commands, "simbeeotic run {} --record {file}", quoted(run));
        }
        if self.runs.len() > SHOWN {
            let _ = writeln!(commands, "# ... {} runs in all", self.runs.len());
        }
        let recordings = match self.runs.as_slice() {
            [(_, one)] => one.clone(),
            _ => format!("{}-*.mcap", self.name),
        };
        let _ = write!(
            commands,
            "simbeeotic plot {} {recordings} -o {}.{}",
            self.arguments[0], self.name, self.ending
        );
        if self.arguments.len() > 1 {
            let _ = write!(commands, " {}", quoted(&self.arguments[1..]));
        }
        commands
    }
}

/// One run for each value and seed.
fn sweep_runs(sweep: &Table, name: &str) -> Result<Vec<(Vec<String>, String)>> {
    let seeds = sweep.get("seeds").and_then(Value::as_integer);
    let seeds = seeds.with_context(|| format!("{LIST}: {name}: no `seeds`"))?;
    let more = match sweep.get("more") {
        Some(more) => words(more, name)?,
        None => Vec::new(),
    };
    let values = sweep.get("values");
    let values = words(
        values.with_context(|| format!("{LIST}: {name}: no `values`"))?,
        name,
    )?;
    let mut runs = Vec::new();
    for value in values {
        for seed in 1..=seeds {
            let mut run = vec![word(sweep, "scenario")?];
            run.extend(["--seed".to_owned(), seed.to_string()]);
            run.extend([
                "--set".to_owned(),
                format!("{}={value}", word(sweep, "key")?),
            ]);
            run.extend(more.iter().cloned());
            runs.push((run, format!("{name}-{value}-{seed}.mcap")));
        }
    }
    Ok(runs)
}

fn quoted(words: &[String]) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=./:,".contains(c);
    let words = words.iter().map(|word| match word.chars().all(plain) {
        true => word.clone(),
        false => format!("'{word}'"),
    });
    words.collect::<Vec<_>>().join(" ")
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
        sweep = { scenario = "a.toml", key = "model.bee.count", values = ["1", "2"], seeds = 2 }
        arguments = ["series"]
    "#;

    #[test]
    fn the_page_has_each_plot_with_what_makes_it() {
        let plots = Plots::parse(EXAMPLE).expect("a list");
        assert!(plots.has("many") && !plots.has("none"));
        let page = plots.page();
        for part in [
            "## One\n\nA run.\n\n![One](../../images/plots/one.svg)",
            "simbeeotic run scenarios/talk.toml --end-time '5 s' --record one.mcap\n\
             simbeeotic plot traces one.mcap -o one.svg --title 'It is'",
            "--seed 2 --set model.bee.count=1 --record many-1-2.mcap\n# ... 4 runs in all\n\
             simbeeotic plot series many-*.mcap -o many.png",
        ] {
            assert!(page.contains(part), "{part} is not in {page}");
        }
    }

    #[test]
    fn a_plot_of_nothing_is_refused() {
        let none = EXAMPLE.replace("runs = ", "walks = ");
        assert!(Plots::parse(&none).is_err());
    }
}
