//! XML text to elements that know their place.
//!
//! Namespaces are not looked at: of `x:model` only `model` counts, and `xmlns` and `xsi:` attributes
//! are left out. There are no entities but the five of XML and character references; a document type
//! is skipped.

use crate::limit::ELEMENT_DEPTH_MAX;
use quick_xml::Reader;
use quick_xml::errors::{Error, IllFormedError, SyntaxError};
use quick_xml::escape::{EscapeError, resolve_xml_entity, unescape};
use quick_xml::events::attributes::AttrError;
use quick_xml::events::{BytesRef, BytesStart, Event};
use simbeeotic_model::config::{Fault, SourceId, Span};

/// A piece of text: an attribute's value, or what stands in an element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Text {
    /// The text, entities resolved. That of an element without the white space around it.
    pub(crate) text: String,
    /// Where it was written.
    pub(crate) span: Span,
}

/// An attribute.
#[derive(Clone, Debug)]
pub(crate) struct Attribute {
    /// Its name.
    pub(crate) name: Text,
    /// Its value.
    pub(crate) value: Text,
}

/// An element with all that stands in it.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    /// Its name.
    pub(crate) name: Text,
    /// From the start of its start tag to the end of its end tag.
    pub(crate) span: Span,
    /// Its attributes.
    pub(crate) attributes: Vec<Attribute>,
    /// The elements in it.
    pub(crate) children: Vec<Element>,
    /// The text in it; its place is that of the first to the last letter, or of the element.
    pub(crate) text: Text,
}

impl Element {
    /// The value of an attribute.
    pub(crate) fn attribute(&self, name: &str) -> Option<&Text> {
        self.attributes
            .iter()
            .find(|a| a.name.text == name)
            .map(|a| &a.value)
    }

    /// The first element of this name in it.
    pub(crate) fn child(&self, name: &str) -> Option<&Element> {
        self.children.iter().find(|c| c.name.text == name)
    }

    /// The elements of this name in it.
    pub(crate) fn children<'e>(&'e self, name: &'e str) -> impl Iterator<Item = &'e Element> {
        self.children.iter().filter(move |c| c.name.text == name)
    }
}

/// Reads a document and returns its one outermost element.
///
/// # Errors
/// The first place where it is not well-formed, or every attribute that is wrong.
pub(crate) fn parse(text: &str, source: SourceId) -> Result<Element, Vec<Fault>> {
    let mut builder = Builder {
        whole: text,
        source,
        open: Vec::new(),
        root: None,
        faults: Vec::new(),
    };
    let mut reader = Reader::from_str(text);
    loop {
        let from = position(reader.buffer_position(), text);
        match reader.read_event() {
            Ok(Event::Eof) => break,
            Ok(event) => {
                let to = position(reader.buffer_position(), text);
                if !builder.event(&event, from, to) {
                    break;
                }
            }
            Err(error) => {
                let at = position(reader.error_position(), text);
                builder.syntax(&error, at);
                break;
            }
        }
    }
    builder.finish()
}

fn position(byte: u64, text: &str) -> usize {
    usize::try_from(byte).unwrap_or(text.len()).min(text.len())
}

struct Builder<'t> {
    whole: &'t str,
    source: SourceId,
    open: Vec<Element>,
    root: Option<Element>,
    faults: Vec<Fault>,
}

impl Builder<'_> {
    fn span(&self, start: usize, end: usize) -> Span {
        Span::new(self.source, start, end.max(start))
    }

    /// The span of a slice of the whole text, or `otherwise` if it is a copy.
    fn span_of(&self, part: &str, otherwise: Span) -> Span {
        let start = (part.as_ptr() as usize).checked_sub(self.whole.as_ptr() as usize);
        match start {
            Some(start) if start + part.len() <= self.whole.len() => {
                self.span(start, start + part.len())
            }
            _ => otherwise,
        }
    }

    fn fault(&mut self, span: Span, message: impl Into<String>) {
        self.faults.push(Fault::error(span, message));
    }

    /// Takes one event in; false if the rest of the text makes no sense any more.
    fn event(&mut self, event: &Event<'_>, from: usize, to: usize) -> bool {
        let span = self.span(from, to);
        match event {
            Event::Start(start) => return self.open(start, span),
            Event::Empty(start) => {
                if !self.open(start, span) {
                    return false;
                }
                self.close(to);
            }
            Event::End(_) => self.close(to),
            Event::Text(text) => self.text(text, span),
            Event::CData(text) => self.text(text, span),
            Event::GeneralRef(reference) => self.reference(reference, span),
            _ => {}
        }
        true
    }

    fn open(&mut self, start: &BytesStart<'_>, span: Span) -> bool {
        if self.open.is_empty() && self.root.is_some() {
            self.fault(span, "a second outermost element: a document has one");
            return false;
        }
        if self.open.len() >= ELEMENT_DEPTH_MAX {
            self.fault(
                span,
                format!("nested deeper than {ELEMENT_DEPTH_MAX} levels"),
            );
            return false;
        }
        let whole_name = start.name().0;
        let name_span = self.span_of(whole_name, span);
        if !is_name(whole_name) {
            self.fault(
                name_span,
                format!("`{whole_name}` is no name for an element"),
            );
            return false;
        }
        let name = Text {
            text: local(whole_name).to_owned(),
            span: name_span,
        };
        let attributes = self.attributes(start, span);
        let text = Text {
            text: String::new(),
            span: name_span,
        };
        self.open.push(Element {
            name,
            span,
            attributes,
            children: Vec::new(),
            text,
        });
        true
    }

    fn attributes(&mut self, start: &BytesStart<'_>, tag: Span) -> Vec<Attribute> {
        let mut all = Vec::new();
        for attribute in start.attributes() {
            let attribute = match attribute {
                Ok(attribute) => attribute,
                Err(error) => {
                    self.attribute_fault(&error, start, tag);
                    continue;
                }
            };
            let key = attribute.key.0;
            let raw: &str = &attribute.value;
            let span = self.span_of(raw, tag);
            if !is_name(key) {
                let key_span = self.span_of(key, tag);
                self.fault(key_span, format!("`{key}` is no name for an attribute"));
                continue;
            }
            if raw.contains('<') {
                self.fault(span, "a value has no `<` in it: is a quote missing?");
                continue;
            }
            match unescape(raw) {
                Ok(_) if key == "xmlns" || key.starts_with("xmlns:") || key.starts_with("xsi:") => {
                }
                Ok(value) => {
                    let name = Text {
                        text: local(key).to_owned(),
                        span: self.span_of(key, tag),
                    };
                    let value = Text {
                        text: value.into_owned(),
                        span,
                    };
                    all.push(Attribute { name, value });
                }
                Err(error) => self.fault(span, escape_message(&error)),
            }
        }
        all
    }

    fn attribute_fault(&mut self, error: &AttrError, start: &BytesStart<'_>, tag: Span) {
        let (at, message) = match error {
            AttrError::ExpectedEq(at) => (*at, "an attribute needs a value: name=\"value\""),
            AttrError::ExpectedValue(at) => (*at, "a value is missing behind this `=`"),
            AttrError::UnquotedValue(at) => (*at, "a value stands between quotes"),
            AttrError::ExpectedQuote(at, _) => (*at, "the quote that ends this value is missing"),
            AttrError::Duplicated(at, _) => (*at, "this attribute stands here twice"),
        };
        let content = self.span_of(start, tag);
        let at = (content.start + at).min(tag.end);
        self.fault(self.span(at, at), message);
    }

    fn close(&mut self, end: usize) {
        let Some(mut element) = self.open.pop() else {
            return;
        };
        element.span.end = end;
        match self.open.last_mut() {
            Some(parent) => parent.children.push(element),
            None => self.root = Some(element),
        }
    }

    fn text(&mut self, text: &str, span: Span) {
        let span = self.span_of(text, span);
        let bare = text.trim();
        let Some(element) = self.open.last_mut() else {
            if !bare.trim_start_matches('\u{feff}').is_empty() {
                let lead = text.len() - text.trim_start().len();
                let start = span.start + lead;
                self.fault(
                    self.span(start, start + bare.len()),
                    "text outside of any element",
                );
            }
            return;
        };
        if bare.is_empty() {
            if !element.text.text.is_empty() {
                element.text.text.push_str(text);
            }
            return;
        }
        let lead = text.len() - text.trim_start().len();
        if element.text.text.is_empty() {
            element.text.span = Span {
                start: span.start + lead,
                ..span
            };
            element.text.text.push_str(text.trim_start());
        } else {
            element.text.text.push_str(text);
        }
        element.text.span.end = span.start + lead + bare.len();
    }

    fn reference(&mut self, reference: &BytesRef<'_>, span: Span) {
        let resolved = match reference.resolve_char_ref() {
            Ok(Some(letter)) => Some(letter.to_string()),
            Ok(None) => resolve_xml_entity(reference).map(str::to_owned),
            Err(_) => None,
        };
        match (resolved, self.open.last_mut()) {
            (Some(text), Some(element)) => {
                if element.text.text.is_empty() {
                    element.text.span = span;
                }
                element.text.text.push_str(&text);
                element.text.span.end = span.end;
            }
            (Some(_), None) => self.fault(span, "text outside of any element"),
            (None, _) => {
                let message = format!("unknown entity `&{};`", &**reference);
                self.fault(span, message);
            }
        }
    }

    fn syntax(&mut self, error: &Error, at: usize) {
        let span = self.span(at, at);
        let fault = match error {
            Error::Syntax(error) => Fault::error(span, syntax_message(error)),
            Error::IllFormed(IllFormedError::MismatchedEndTag { expected, found }) => {
                let fault = Fault::error(span, format!("`</{found}>` closes nothing that is open"));
                fault.help(format!("`<{expected}>` is open here"))
            }
            Error::IllFormed(IllFormedError::UnmatchedEndTag(found)) => {
                Fault::error(span, format!("`</{found}>` closes nothing that is open"))
            }
            Error::IllFormed(IllFormedError::UnclosedReference) => {
                Fault::error(span, "`&` begins an entity and this one does not end")
                    .help("a plain `&` is written `&amp;`")
            }
            other => Fault::error(span, other.to_string()),
        };
        self.faults.push(fault);
    }

    fn finish(mut self) -> Result<Element, Vec<Fault>> {
        if self.faults.is_empty() {
            if let Some(element) = self.open.last() {
                let message = format!("`<{}>` is never closed", element.name.text);
                self.fault(element.name.span, message);
            } else if self.root.is_none() {
                let end = self.span(self.whole.len(), self.whole.len());
                self.fault(end, "this file is empty: there is no element in it");
            }
        }
        match self.root {
            Some(root) if self.faults.is_empty() => Ok(root),
            _ => Err(self.faults),
        }
    }
}

/// Whether a word can be the name of an element or an attribute.
fn is_name(word: &str) -> bool {
    let letter = |c: char| c.is_alphabetic() || matches!(c, '_' | ':');
    let rest = |c: char| letter(c) || c.is_numeric() || matches!(c, '-' | '.' | '\u{b7}');
    word.starts_with(letter) && word.chars().all(rest)
}

/// A name without its namespace prefix.
fn local(name: &str) -> &str {
    name.rsplit(':').next().unwrap_or(name)
}

fn escape_message(error: &EscapeError) -> String {
    match error {
        EscapeError::UnrecognizedEntity(_, name) => format!("unknown entity `&{name};`"),
        EscapeError::UnterminatedEntity(_) => {
            "`&` begins an entity and this one does not end; a plain `&` is written `&amp;`".into()
        }
        other => other.to_string(),
    }
}

const fn syntax_message(error: &SyntaxError) -> &'static str {
    match error {
        SyntaxError::UnclosedTag => "this tag is never closed: `>` is missing",
        SyntaxError::UnclosedComment => "this comment is never closed: `-->` is missing",
        SyntaxError::UnclosedPI | SyntaxError::UnclosedXmlDecl => {
            "this instruction is never closed: `?>` is missing"
        }
        SyntaxError::UnclosedDoctype => "this document type is never closed: `>` is missing",
        SyntaxError::UnclosedCData => "this CDATA is never closed: `]]>` is missing",
        SyntaxError::UnclosedSingleQuotedAttributeValue
        | SyntaxError::UnclosedDoubleQuotedAttributeValue => {
            "in this tag a value is never closed: a quote is missing"
        }
        SyntaxError::InvalidBangMarkup => "`<!` begins nothing that XML knows",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Element {
        parse(text, SourceId(0)).expect("well-formed")
    }

    fn faults(text: &str) -> Vec<(String, usize)> {
        let faults = parse(text, SourceId(0)).expect_err("broken");
        faults
            .into_iter()
            .map(|f| (f.message, f.span.map_or(0, |s| s.start)))
            .collect()
    }

    fn at(text: &str, span: Span) -> &str {
        &text[span.start..span.end]
    }

    #[test]
    fn every_name_and_value_knows_its_place() {
        let text =
            "<?xml version=\"1.0\"?>\n<a xmlns='u' x:b = \"1 &amp; 2\">\n  <c/> t &lt; u\n</a>";
        let root = read(text);
        assert_eq!(at(text, root.name.span), "a");
        let b = root.attribute("b").expect("an attribute");
        assert_eq!((b.text.as_str(), at(text, b.span)), ("1 & 2", "1 &amp; 2"));
        assert_eq!(root.attributes.len(), 1);
        assert_eq!(
            (root.text.text.trim_end(), at(text, root.text.span)),
            ("t < u", "t &lt; u")
        );
        assert_eq!(at(text, root.children[0].span), "<c/>");
        assert!(text.ends_with(at(text, root.span)));
    }

    #[test]
    fn cdata_is_text() {
        assert_eq!(read("<a><![CDATA[1 < 2]]></a>").text.text, "1 < 2");
    }

    #[test]
    fn malformed_text_is_refused_with_its_place() {
        let cases = [
            ("<a><b></a>", 6),
            ("<a>", 1),
            ("", 0),
            ("<a b></a>", 4),
            ("<a b=></a>", 5),
            ("<a b=1></a>", 5),
            ("<a b='1' b='2'/>", 9),
            ("<a/><b/>", 4),
            ("<a/>x", 4),
            ("<a>&nope;</a>", 3),
            ("<a b='&nope;'/>", 6),
            ("<a", 0),
            ("</a>", 0),
            ("<!-- x", 0),
            ("<a>a & b</a>", 5),
            ("<a><<b/></a>", 4),
            ("<a><1/></a>", 4),
            ("<a b='<'/>", 6),
            ("<a 1='2'/>", 3),
        ];
        for (text, place) in cases {
            let found = faults(text);
            assert_eq!(found.first().map(|f| f.1), Some(place), "{text}: {found:?}");
        }
    }

    #[test]
    fn all_wrong_attributes_are_found_at_once() {
        assert_eq!(faults("<a b c='1' c='2'><d e/></a>").len(), 3);
    }

    #[test]
    fn depth_is_bounded() {
        let many = 100_000;
        assert!(parse(&"<a>".repeat(many), SourceId(0)).is_err());
        assert!(parse(&"<a><b/>".repeat(many), SourceId(0)).is_err());
    }
}
