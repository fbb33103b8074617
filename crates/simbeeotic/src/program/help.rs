//! Help texts: what stands behind the options flows as wide as the terminal is.
//!
//! A text in the source is broken where the source's lines end. Left so, each of its lines would be broken again where
//! the terminal ends. Lines of one paragraph are put together here, for all commands, and clap breaks them once.
//! Lines with spaces before them (examples, lists) stay as they are.

use super::arguments::Arguments;
use clap::{Command, CommandFactory};

/// All that the program can be asked.
pub(super) fn command() -> Command {
    flowing(Arguments::command())
}

/// A command and all below it, with texts that flow.
fn flowing(command: Command) -> Command {
    let after = command.get_after_help().map(|text| flow(&text.to_string()));
    let command = match after {
        Some(text) => command.after_help(text),
        None => command,
    };
    command.mut_subcommands(flowing)
}

/// A text with its paragraphs on one line each.
fn flow(text: &str) -> String {
    let mut flown = String::new();
    let mut before = "";
    for line in text.lines() {
        let plain = |line: &str| !line.is_empty() && !line.starts_with(' ');
        if plain(line) && plain(before) {
            flown.push(' ');
        } else if !flown.is_empty() || !before.is_empty() {
            flown.push('\n');
        }
        flown.push_str(line);
        before = line;
    }
    flown
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns, where the program does not write to a terminal.
    const WIDTH: usize = 100;

    #[test]
    fn paragraphs_become_lines_and_lists_stay() {
        let text = "What\nit is.\n\nExamples:\n  a\n  b\nmore\nof it";
        assert_eq!(flow(text), "What it is.\n\nExamples:\n  a\n  b\nmore of it");
    }

    /// Each command with its name, and all below it.
    fn all(command: Command, path: &str) -> Vec<(String, Command)> {
        let path = format!("{path} {}", command.get_name());
        let below = command.get_subcommands().cloned().collect::<Vec<_>>();
        let below = below.into_iter().flat_map(|c| all(c, &path));
        let below = below.collect::<Vec<_>>();
        std::iter::once((path, command)).chain(below).collect()
    }

    #[test]
    fn no_help_has_a_line_that_ends_where_the_next_word_had_room() {
        let mut seen = 0;
        for (name, command) in all(command(), "") {
            let help = command.term_width(WIDTH).render_long_help().to_string();
            let lines: Vec<&str> = help.lines().collect();
            for two in lines.windows(2) {
                let [line, next] = [two[0], two[1]];
                let plain = |line: &str| !line.is_empty() && !line.starts_with(' ');
                if !plain(line) || !plain(next) {
                    continue;
                }
                let word = next.split(' ').next().unwrap_or_default();
                let wide = line.chars().count() + 1 + word.chars().count();
                assert!(wide > WIDTH, "help of{name}: {line:?}, {next:?}");
                seen += 1;
            }
        }
        assert!(seen > 20, "{seen} lines of paragraphs");
    }

    #[test]
    fn no_example_is_too_wide_for_its_line() {
        for (name, command) in all(command(), "") {
            let after = command.get_after_help().map(ToString::to_string);
            for line in after.unwrap_or_default().lines() {
                if line.starts_with(' ') {
                    assert!(line.chars().count() <= WIDTH, "help of{name}: {line}");
                }
            }
        }
    }
}
