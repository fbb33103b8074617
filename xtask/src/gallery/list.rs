//! What the gallery has: its sections and pictures, from `docs/book/gallery.toml`.

use anyhow::{Context, Result, bail};
use toml::{Table, Value};

use super::LIST;

pub(super) struct Section {
    /// What it is called by on the command line.
    pub(super) name: String,
    pub(super) title: String,
    pub(super) text: String,
    pub(super) pictures: Vec<Picture>,
    /// Whether they are shown by other pages of the book, and not by this one.
    pub(super) elsewhere: bool,
    /// Whether all plots of runs follow.
    pub(super) plots: bool,
}

pub(super) struct Picture {
    pub(super) name: String,
    pub(super) caption: String,
    pub(super) source: Source,
    pub(super) arguments: Vec<String>,
}

/// What a picture is of.
pub(super) enum Source {
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
    /// What commands of the program make, one after the other: the file below `docs/images`, and their arguments.
    /// `{out}` in them stands for a folder of their own, `{picture}` for the picture.
    Commands {
        file: String,
        commands: Vec<Vec<String>>,
        /// Whether they need the parts of the examples.
        examples: bool,
    },
    /// A world made by a generator, that of a file, one that stands in the list.
    Generated(String),
    File(String),
    Written(String),
}

pub(super) fn sections(list: &Table) -> Result<Vec<Section>> {
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
                elsewhere: section.get("elsewhere").and_then(Value::as_bool) == Some(true),
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
        (None, None, None) if table.contains_key("commands") => Source::Commands {
            file: text(table, "drawing")?,
            commands: commands(table)?,
            examples: table.get("examples").and_then(Value::as_bool) == Some(true),
        },
        (None, None, None) if text(table, "name")?.starts_with("sensor-") => Source::Plot,
        (Some(_), None, None) => Source::Generated(text(table, "generate")?),
        (None, Some(_), None) => Source::File(text(table, "file")?),
        (None, None, Some(_)) => Source::Written(text(table, "world")?),
        _ => bail!(
            "{LIST}: a picture has one of `generate`, `file`, `world`, `page`, `bench`, `figure` and `commands`"
        ),
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

fn commands(table: &Table) -> Result<Vec<Vec<String>>> {
    let refused = || format!("{LIST}: `commands` is a list of lists of words");
    let list = table.get("commands").and_then(Value::as_array);
    let list = list.with_context(refused)?;
    let words = |value: &Value| -> Option<Vec<String>> {
        let words = value.as_array()?.iter();
        words.map(|word| Some(word.as_str()?.to_owned())).collect()
    };
    (list.iter().map(words))
        .collect::<Option<Vec<_>>>()
        .filter(|commands| !commands.is_empty())
        .with_context(refused)
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
