//! Pictures for a column of a paper: what their colours say stands below them, and the title may be left out.

use super::map::LEGEND;
use super::sheet::{Anchor, FAINT, HEAD, Ink, SMALL, Shape, Sheet, TEXT};
use simbeeotic_view::render::words;
use std::ops::Range;

/// Narrower pictures have no room for a key at their side, pixels.
pub(super) const NARROW: u32 = 700;
/// Between the edge and what is drawn, pixels.
const MARGIN: f64 = 24.0;
/// Between two lines, pixels.
const LINE: f64 = 20.0;
/// Width and height of a bar of colours, and its height with all its words, pixels.
const BAR: [f64; 2] = [150.0, 12.0];
const BAR_WHOLE: f64 = 62.0;

/// One thing of a key: a line and what it says, a bar of colours, a note.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    /// Its shapes among those of the picture.
    pub(crate) shapes: Range<usize>,
    /// Its upper left corner, and its height, pixels.
    pub(crate) corner: [f64; 2],
    pub(crate) height: f64,
    pub(crate) bar: Option<Bar>,
    /// Whether it is of what follows it, and stands above that.
    pub(crate) leads: bool,
}

/// A bar of colours, from the least to the greatest.
#[derive(Clone, Debug)]
pub(crate) struct Bar {
    pub(crate) label: String,
    pub(crate) inks: Vec<Ink>,
    /// Where on it numbers are, 0 to 1.
    pub(crate) ticks: Vec<(f64, String)>,
}

impl Sheet {
    /// How much of the width a key takes.
    pub(super) fn key_room(&self) -> f64 {
        match self.width < NARROW {
            true => 0.0,
            false => LEGEND,
        }
    }

    /// As it is shown: a narrow picture has its key below, and is higher by that; a plain one has no title.
    pub(super) fn laid_out(self, plain: bool) -> Self {
        let mut sheet = match self.width < NARROW {
            true => self.with_key_below(),
            false => self,
        };
        if plain {
            sheet.shapes.drain(..sheet.head);
            let up = HEAD - 26.0;
            for shape in &mut sheet.shapes {
                shape.shift([0.0, -up]);
            }
            sheet.height -= up as u32;
        }
        sheet
    }

    fn with_key_below(mut self) -> Self {
        let shapes = std::mem::take(&mut self.shapes);
        let entries = std::mem::take(&mut self.key);
        let notes = std::mem::take(&mut self.notes);
        let apart = |place: usize| {
            entries.iter().any(|entry| entry.shapes.contains(&place))
                || notes.iter().any(|(at, _)| *at == place)
        };
        let kept = shapes.iter().enumerate();
        self.shapes = kept
            .filter(|(place, _)| !apart(*place))
            .map(|(_, shape)| shape.clone())
            .collect();
        let room = f64::from(self.width) - 2.0 * MARGIN;
        let mut y = f64::from(self.height);
        for (_, note) in &notes {
            for line in wrapped(note, room) {
                self.words([MARGIN, y + 8.0], line, SMALL, Anchor::Start, FAINT);
                y += LINE;
            }
        }
        let columns = ((room + 10.0) / LEGEND).floor().max(1.0) as usize;
        let pitch = (room + 10.0) / columns as f64;
        let places = in_columns(&entries, columns);
        let mut foot = y;
        for (entry, (column, down)) in entries.iter().zip(places) {
            let corner = [MARGIN + pitch * column as f64, y + down];
            foot = foot.max(corner[1] + entry.whole());
            if let Some(bar) = &entry.bar {
                self.lying(bar, corner);
                continue;
            }
            let by = [corner[0] - entry.corner[0], corner[1] - entry.corner[1]];
            for shape in &shapes[entry.shapes.clone()] {
                let mut shape = shape.clone();
                shape.shift(by);
                self.shapes.push(shape);
            }
        }
        if foot > f64::from(self.height) {
            self.height = (foot + 12.0).ceil() as u32;
        }
        self
    }

    /// A bar of colours that lies.
    fn lying(&mut self, bar: &Bar, [left, top]: [f64; 2]) {
        let [wide, tall] = BAR;
        self.words(
            [left, top + 14.0],
            bar.label.as_str(),
            SMALL,
            Anchor::Start,
            TEXT,
        );
        let y = top + 22.0;
        let columns = u32::try_from(bar.inks.len()).unwrap_or(1);
        self.cells([left, y, left + wide, y + tall], columns, bar.inks.clone());
        for (share, text) in &bar.ticks {
            let x = left + share * wide;
            self.line(vec![[x, y + tall], [x, y + tall + 4.0]], TEXT, 1.0);
            let at = [x, y + tall + 18.0];
            self.words(at, text.as_str(), SMALL, Anchor::Middle, TEXT);
        }
    }
}

impl Entry {
    /// Its height below a picture.
    fn whole(&self) -> f64 {
        match self.bar {
            Some(_) => BAR_WHOLE,
            None => self.height,
        }
    }
}

/// Column and height of each entry, in columns that are as low as they can be without another order.
fn in_columns(entries: &[Entry], columns: usize) -> Vec<(usize, f64)> {
    let place = |most: f64| {
        let (mut column, mut down, mut led) = (0, 0.0, false);
        let places = entries.iter().enumerate().map(|(at, entry)| {
            let below = entries.get(at + 1).filter(|_| entry.leads);
            let needed = entry.whole() + below.map_or(0.0, Entry::whole);
            if down > 0.0 && !led && down + needed > most {
                (column, down) = (column + 1, 0.0);
            }
            led = entry.leads;
            let at = (column, down);
            down += entry.whole();
            at
        });
        places.collect::<Vec<_>>()
    };
    let sum: f64 = entries.iter().map(Entry::whole).sum();
    let tallest = entries.iter().map(Entry::whole).fold(0.0, f64::max);
    let mut most = tallest.max(sum / columns as f64);
    loop {
        let places = place(most);
        let last = places.last().map_or(0, |(column, _)| *column);
        if last < columns || most > sum {
            return places;
        }
        most += 0.5 * LINE;
    }
}

/// A text in lines that are no longer than the room, as far as its words allow.
fn wrapped(text: &str, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        let longer = lines.last().map(|line| format!("{line} {word}"));
        match longer.filter(|line| words::width(line, SMALL) <= room) {
            Some(line) => {
                lines.pop();
                lines.push(line);
            }
            None => lines.push(word.to_owned()),
        }
    }
    lines
}

impl Shape {
    /// Puts it elsewhere.
    fn shift(&mut self, [dx, dy]: [f64; 2]) {
        let by = |point: &mut [f64; 2]| *point = [point[0] + dx, point[1] + dy];
        match self {
            Self::Line { points, .. } => points.iter_mut().for_each(by),
            Self::Area { rings, .. } => rings.iter_mut().flatten().for_each(by),
            Self::Cells { edges, .. } => {
                let [a, b, c, d] = *edges;
                *edges = [a + dx, b + dy, c + dx, d + dy];
            }
            Self::Disc { centre, .. } => by(centre),
            Self::Words(words) => by(&mut words.at),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::map::Column;
    use super::*;

    fn entry(height: f64) -> Entry {
        Entry {
            shapes: 0..0,
            corner: [0.0; 2],
            height,
            bar: None,
            leads: false,
        }
    }

    #[test]
    fn columns_are_as_low_as_they_can_be_in_their_order() {
        let entries: Vec<Entry> = [20.0, 20.0, 40.0, 20.0].map(entry).into();
        let places = in_columns(&entries, 2);
        assert_eq!(places, [(0, 0.0), (0, 20.0), (1, 0.0), (1, 40.0)]);
        let one = in_columns(&entries, 1);
        assert_eq!(one, [(0, 0.0), (0, 20.0), (0, 40.0), (0, 80.0)]);
        assert!(in_columns(&[], 2).is_empty());
        let mut headed: Vec<Entry> = [20.0; 4].map(entry).into();
        headed[1].leads = true;
        let places = in_columns(&headed, 2);
        assert_eq!(places[1..3], [(0, 20.0), (0, 40.0)], "not parted");
    }

    /// The words of a picture with their places.
    fn said(sheet: &Sheet) -> Vec<(String, [f64; 2])> {
        let words = sheet.shapes.iter().filter_map(|shape| match shape {
            Shape::Words(words) => Some((words.text.clone(), words.at)),
            _ => None,
        });
        words.collect()
    }

    fn drawn(width: u32) -> Sheet {
        let mut sheet = Sheet::titled(width, 400, "Title", "a caption");
        sheet.line(vec![[100.0, 100.0], [200.0, 200.0]], TEXT, 1.0);
        let mut column = Column::at(f64::from(width), 90.0, 400.0);
        column.line(&mut sheet, TEXT, 2.0, "a line");
        column.colours(&mut sheet, "time, s", [0.0, 10.0], |_| TEXT);
        sheet.note([300.0, 80.0], "a note that says what bars are");
        sheet
    }

    #[test]
    fn a_narrow_picture_has_its_key_below_and_a_wide_one_beside() {
        let wide = drawn(1000).laid_out(false);
        assert_eq!(wide.height, 400);
        let key = said(&wide).into_iter().find(|(text, _)| text == "a line");
        assert!(key.is_some_and(|(_, [x, y])| x > 800.0 && y < 100.0));

        let narrow = drawn(480).laid_out(false);
        assert!(narrow.height > 440, "{}", narrow.height);
        let words = said(&narrow);
        assert_eq!(words.len(), said(&wide).len(), "{words:?}");
        for (text, [x, y]) in &words {
            let below = !["Title", "a caption"].contains(&text.as_str());
            assert_eq!(below, *y > 400.0, "{text} at {x}, {y}");
            assert!((20.0..=456.0).contains(x) && *y < f64::from(narrow.height));
        }
    }

    #[test]
    fn a_plain_picture_has_no_title_and_is_lower() {
        let plain = drawn(1000).laid_out(true);
        assert_eq!(plain.height, 352);
        let words = said(&plain);
        assert!(
            !words
                .iter()
                .any(|(text, _)| text == "Title" || text == "a caption")
        );
        let Some(Shape::Line { points, .. }) = plain.shapes.first() else {
            panic!("{:?}", plain.shapes.first());
        };
        assert_eq!(points[0], [100.0, 52.0]);
    }
}
