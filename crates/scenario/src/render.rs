//! Faults as text for people: message, file, line, column, the line itself, a hint.
//!
//! ```text
//! error: unknown key `heading_sgima`
//!  --> bee.toml:17:1
//!    |
//! 17 | heading_sgima = "12 deg"
//!    | ^^^^^^^^^^^^^
//!    |
//!    = help: did you mean `heading_sigma`?
//! ```

use crate::limit::FAULTS_SHOWN;
use annotate_snippets::{AnnotationKind, Group, Level as Severity, Origin, Renderer, Snippet};
use simbeeotic_model::config::{Fault, Level, Source, Sources, Span};
use std::ops::Range;

/// All faults as text, in the order given, with ANSI colours if `color`; if there are errors, the
/// last line counts them. Of very many only the first are shown, errors before warnings and notes.
pub fn faults(faults: &[Fault], sources: &Sources, color: bool) -> String {
    let renderer = if color {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let mut text = String::new();
    for fault in shown(faults) {
        text.push_str(&renderer.render(&[report(fault, sources)]));
        text.push_str("\n\n");
    }
    if faults.len() > FAULTS_SHOWN {
        text.push_str(&format!("... and {} more\n\n", faults.len() - FAULTS_SHOWN));
    }
    if faults.iter().any(Fault::is_error) {
        text.push_str(&summary(faults, &names(faults, sources)));
        text.push('\n');
    }
    text
}

/// The names of the files that errors are in.
fn names(faults: &[Fault], sources: &Sources) -> String {
    let mut names: Vec<&str> = Vec::new();
    for span in faults
        .iter()
        .filter(|f| f.is_error())
        .filter_map(|f| f.span)
    {
        if let Some(source) = sources.get(span.source)
            && !names.contains(&source.name.as_str())
        {
            names.push(&source.name);
        }
    }
    names.join(", ")
}

fn shown(faults: &[Fault]) -> impl Iterator<Item = &Fault> {
    let errors = faults.iter().filter(|f| f.is_error()).count();
    let room = FAULTS_SHOWN.saturating_sub(errors.min(FAULTS_SHOWN));
    let all = faults.len() <= FAULTS_SHOWN;
    let (mut errors_left, mut others_left) = (FAULTS_SHOWN, room);
    faults.iter().filter(move |fault| {
        let left = if fault.is_error() {
            &mut errors_left
        } else {
            &mut others_left
        };
        let show = all || *left > 0;
        *left = left.saturating_sub(1);
        show
    })
}

fn report<'a>(fault: &'a Fault, sources: &'a Sources) -> Group<'a> {
    let severity = match fault.level {
        Level::Error => Severity::ERROR,
        Level::Warning => Severity::WARNING,
        Level::Note => Severity::NOTE,
    };
    let place = fault
        .span
        .and_then(|span| Some((span, sources.get(span.source)?)));
    let mut group = Group::with_title(severity.clone().primary_title(fault.message.as_str()));
    if let Some((span, source)) = place {
        let (line, range, number) = line_at(source, span);
        if line.is_empty() {
            group = group.element(
                Origin::path(source.name.as_str())
                    .line(number)
                    .char_column(1),
            );
        } else {
            let mark = AnnotationKind::Primary.span(range);
            let snippet = Snippet::source(line)
                .line_start(number)
                .path(source.name.as_str());
            group = group.element(snippet.annotation(mark));
        }
    }
    if let Some(help) = &fault.help {
        group = group.element(Severity::HELP.message(help.as_str()));
    }
    group
}

/// The line that a span starts on, what of the line it covers, and the line's number from 1.
///
/// Spans of many lines (a whole section) are cut to their first. Where text is missing, at the end
/// of the input say, the last line that has any is shown instead of nothing.
fn line_at(source: &Source, span: Span) -> (&str, Range<usize>, usize) {
    let text: &str = &source.text;
    let mut start = floor(text, span.start);
    if start == text.len() {
        start = text.trim_end().len();
    }
    let from = text[..start].rfind('\n').map_or(0, |at| at + 1);
    let to = text[start..].find('\n').map_or(text.len(), |at| start + at);
    let line = text[from..to].trim_end_matches('\r');
    let end = floor(text, span.end).min(from + line.len());
    let number = text[..from].matches('\n').count() + 1;
    let start = (start - from).min(line.len());
    let mut range = start..(end.max(from) - from).max(start);
    if range.is_empty() {
        range.end = ceil(line, range.end + 1);
    }
    (line, range, number)
}

fn floor(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

fn ceil(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at += 1;
    }
    at
}

/// How many faults of which kind: `3 errors, 1 warning in x.toml`.
pub fn summary(faults: &[Fault], name: &str) -> String {
    let count = |level| faults.iter().filter(|f| f.level == level).count();
    let mut parts = Vec::new();
    for (level, word) in [
        (Level::Error, "error"),
        (Level::Warning, "warning"),
        (Level::Note, "note"),
    ] {
        match count(level) {
            0 => {}
            1 => parts.push(format!("1 {word}")),
            n => parts.push(format!("{n} {word}s")),
        }
    }
    if parts.is_empty() {
        parts.push("no errors".to_owned());
    }
    let counted = parts.join(", ");
    if name.is_empty() {
        counted
    } else {
        format!("{counted} in {name}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_model::config::SourceId;

    fn one(text: &str, start: usize, end: usize) -> String {
        let mut sources = Sources::new();
        let id = sources.add("x.toml", text);
        let fault = Fault::error(Span::new(id, start, end), "it is wrong").help("make it right");
        faults(&[fault], &sources, false)
    }

    #[test]
    fn a_fault_shows_message_place_line_and_help() {
        insta::assert_snapshot!(one("a = 1\nspeed = 12\n", 14, 16), @r"
        error: it is wrong
         --> x.toml:2:9
          |
        2 | speed = 12
          |         ^^
          |
          = help: make it right

        1 error in x.toml
        ");
    }

    #[test]
    fn a_fault_past_the_end_shows_the_last_line() {
        insta::assert_snapshot!(one("a = [\n\n", 7, 7), @r"
        error: it is wrong
         --> x.toml:1:6
          |
        1 | a = [
          |      ^
          |
          = help: make it right

        1 error in x.toml
        ");
    }

    #[test]
    fn a_fault_over_many_lines_shows_the_first() {
        insta::assert_snapshot!(one("[run]\nseed = 1\n", 0, 14), @r"
        error: it is wrong
         --> x.toml:1:1
          |
        1 | [run]
          | ^^^^^
          |
          = help: make it right

        1 error in x.toml
        ");
    }

    #[test]
    fn any_span_of_any_text_can_be_shown() {
        for text in [
            "",
            "\n",
            "\r\n\r\n",
            "ü\u{1F41D}\n\t\u{0}é",
            "\u{202e}abc",
            "a",
        ] {
            for start in 0..text.len() + 3 {
                for end in 0..text.len() + 3 {
                    assert!(one(text, start, end).contains("it is wrong"));
                }
            }
        }
    }

    #[test]
    fn a_fault_without_a_place_shows_its_message() {
        let text = faults(&[Fault::warning(None, "hm")], &Sources::new(), false);
        assert_eq!(text, "warning: hm\n\n");
        let nowhere = Fault::warning(Span::new(SourceId(9), 0, 1), "hm");
        assert_eq!(faults(&[nowhere], &Sources::new(), false), text);
    }

    #[test]
    fn errors_are_shown_before_warnings_when_there_are_too_many() {
        let mut all = vec![Fault::warning(None, "hm"); 100];
        all.push(Fault::error(None, "wrong"));
        let text = faults(&all, &Sources::new(), false);
        assert!(
            text.contains("error: wrong") && text.contains("... and 41 more"),
            "{text}"
        );
    }

    #[test]
    fn the_summary_counts() {
        let all = [
            Fault::error(None, "a"),
            Fault::error(None, "b"),
            Fault::warning(None, "c"),
            Fault::note(None, "d"),
        ];
        assert_eq!(
            summary(&all, "x.toml"),
            "2 errors, 1 warning, 1 note in x.toml"
        );
        assert_eq!(summary(&[], "x.toml"), "no errors in x.toml");
    }
}
