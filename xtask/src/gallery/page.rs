//! The gallery's page: each picture with what makes it.

use std::fmt::Write as _;
use std::path::Path;

use super::PLOTS;
use super::list::{Picture, Section, Source};
use crate::plots::{Plots, quoted};

/// The page, as Markdown.
pub(super) fn page(sections: &[Section], plots: &Plots) -> String {
    let names: Vec<String> = (sections.iter())
        .map(|section| format!("`{}`", section.name))
        .collect();
    let shown = sections.iter().filter(|section| !section.elsewhere);
    let mut page = format!(
        "# Gallery\n\n`cargo xtask gallery` makes all pictures anew and writes this page, from \
         `docs/book/gallery.toml` and\n`docs/book/plots.toml`. With names it makes those alone: of a picture, or \
         of a section:\n{}.\n",
        names.join(", ")
    );
    for section in shown {
        let _ = write!(page, "\n## {}\n", section.title);
        if !section.text.trim().is_empty() {
            let _ = write!(page, "\n{}\n", section.text.trim());
        }
        for picture in &section.pictures {
            let Picture { name, caption, .. } = picture;
            let file = match &picture.source {
                Source::Bench(figure) => format!("figures/{figure}.svg"),
                Source::Figure { file, .. } => format!("figures/{file}"),
                Source::Commands { file, .. } => file.clone(),
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

impl Picture {
    /// The commands that make it.
    fn commands(&self) -> String {
        let (mut commands, world) = match &self.source {
            Source::Plot => return format!("cargo {}", PLOTS.join(" ")),
            // The section says how.
            Source::Page(_) => return String::new(),
            Source::Commands { file, commands, .. } => {
                let file = Path::new(file)
                    .file_name()
                    .unwrap_or_default()
                    .to_string_lossy();
                let lines = commands.iter().map(|words| {
                    let words = words.iter().map(|word| {
                        quoted(&word.replace("{out}/", "").replace("{picture}", &file))
                    });
                    format!("simbeeotic {}", words.collect::<Vec<_>>().join(" "))
                });
                return lines.collect::<Vec<_>>().join("\n");
            }
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
