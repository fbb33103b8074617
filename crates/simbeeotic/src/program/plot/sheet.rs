//! What a picture is made of, whatever file it becomes: lines, areas, discs, words, in pixels from the
//! upper left corner.

use super::column::Entry;
use simbeeotic_view::render::words;

/// A colour, and how much of it covers what is below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ink {
    pub(crate) rgb: [u8; 3],
    pub(crate) alpha: f64,
}

impl Ink {
    pub(crate) const fn new(rgb: [u8; 3]) -> Self {
        Self { rgb, alpha: 1.0 }
    }

    pub(crate) const fn thin(self, alpha: f64) -> Self {
        Self { alpha, ..self }
    }

    /// A share of another colour in this one; the alpha stays.
    pub(crate) fn mixed(self, other: Ink, share: f64) -> Self {
        let mix = |k: usize| {
            let [a, b] = [self.rgb[k], other.rgb[k]].map(f64::from);
            (a + share.clamp(0.0, 1.0) * (b - a)).round() as u8
        };
        Self {
            rgb: [mix(0), mix(1), mix(2)],
            ..self
        }
    }
}

/// Words.
pub(crate) const TEXT: Ink = Ink::new([0x26, 0x2b, 0x33]);
/// Words that matter less.
pub(crate) const FAINT: Ink = Ink::new([0x5c, 0x66, 0x73]);
/// Lines of a grid.
pub(crate) const GRID: Ink = Ink::new([0xe4, 0xe7, 0xeb]);
/// Axes.
pub(crate) const AXIS: Ink = Ink::new([0x8a, 0x93, 0x9e]);
pub(crate) const WHITE: Ink = Ink::new([0xff; 3]);

/// Where a word stands to its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// One thing of a picture.
#[derive(Clone, Debug)]
pub(crate) enum Shape {
    /// Straight lines from point to point, drawn with a pen.
    Line {
        points: Vec<[f64; 2]>,
        ink: Ink,
        width: f64,
        /// Lengths of a dash and of the gap behind it, pixels; none: it is drawn through.
        dash: Option<[f64; 2]>,
    },
    /// What closed outlines enclose, whichever way round they go; an outline inside another one is a hole.
    Area { rings: Vec<Vec<[f64; 2]>>, ink: Ink },
    /// Coloured cells in a rectangle, such as a relief or a map of heat.
    Cells {
        /// Left, top, right, bottom.
        edges: [f64; 4],
        /// How many there are in a row.
        columns: u32,
        /// Row by row from the upper left; nothing where the alpha is 0.
        inks: Vec<Ink>,
    },
    /// A disc with a rim of white.
    Disc {
        centre: [f64; 2],
        radius: f64,
        ink: Ink,
        rim: f64,
    },
    /// A line of words.
    Words(Words),
}

/// What things are drawn on.
pub(crate) trait Canvas {
    /// A [`Shape::Line`].
    fn line(&mut self, points: &[[f64; 2]], ink: Ink, width: f64, dash: Option<[f64; 2]>);
    /// A [`Shape::Area`].
    fn area(&mut self, rings: &[Vec<[f64; 2]>], ink: Ink);
    /// [`Shape::Cells`].
    fn cells(&mut self, edges: [f64; 4], columns: u32, inks: &[Ink]);
    /// A [`Shape::Disc`].
    fn disc(&mut self, centre: [f64; 2], radius: f64, ink: Ink, rim: f64);
    /// [`Shape::Words`].
    fn words(&mut self, words: &Words);
}

impl Sheet {
    /// Draws all of it, from the lowest to the highest.
    pub(crate) fn draw_on(&self, canvas: &mut impl Canvas) {
        for shape in &self.shapes {
            match shape {
                Shape::Line {
                    points,
                    ink,
                    width,
                    dash,
                } => canvas.line(points, *ink, *width, *dash),
                Shape::Area { rings, ink } => canvas.area(rings, *ink),
                Shape::Cells {
                    edges,
                    columns,
                    inks,
                } => canvas.cells(*edges, *columns, inks),
                Shape::Disc {
                    centre,
                    radius,
                    ink,
                    rim,
                } => canvas.disc(*centre, *radius, *ink, *rim),
                Shape::Words(words) => canvas.words(words),
            }
        }
    }
}

/// A line of words; its base line goes through `at`.
#[derive(Clone, Debug)]
pub(crate) struct Words {
    pub(crate) at: [f64; 2],
    pub(crate) text: String,
    pub(crate) size: f64,
    pub(crate) anchor: Anchor,
    pub(crate) ink: Ink,
    /// Whether it reads upwards.
    pub(crate) upwards: bool,
    /// Whether a rim of white keeps it apart from what is below.
    pub(crate) halo: bool,
}

/// A picture: its size, and its things from the lowest to the highest, on white.
#[derive(Clone, Debug)]
pub(crate) struct Sheet {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) shapes: Vec<Shape>,
    /// What stands beside it and says what is on it, and the places of notes among the shapes, with their texts.
    pub(crate) key: Vec<Entry>,
    pub(crate) notes: Vec<(usize, String)>,
    /// Of how many shapes the title and the line below it are.
    pub(crate) head: usize,
}

/// Size of words, pixels.
pub(crate) const SMALL: f64 = 14.0;
pub(crate) const NORMAL: f64 = 16.0;
const TITLE: f64 = 21.0;
/// Of a caption that has two lines.
const CLOSE: f64 = 12.5;
/// Room for the title and the line below it.
pub(crate) const HEAD: f64 = 74.0;

/// The two lines of a caption that has no room on one.
fn halves(caption: &str, room: f64) -> Option<(&str, &str)> {
    if words::width(caption, CLOSE) <= room {
        return None;
    }
    let spaces = caption.match_indices(' ').map(|(at, _)| at);
    let longer = |at: &usize| {
        let [a, b] = [&caption[..*at], &caption[*at..]].map(|part| words::width(part, CLOSE));
        a.max(b)
    };
    // Behind a part of the sentence, if both lines have room then.
    let parts = spaces
        .clone()
        .filter(|at| caption[..*at].ends_with([';', ':']));
    let part = parts
        .filter(|at| longer(at) <= room)
        .min_by(|a, b| longer(a).total_cmp(&longer(b)));
    let at = part.or_else(|| spaces.min_by(|a, b| longer(a).total_cmp(&longer(b))))?;
    Some((&caption[..at], &caption[at + 1..]))
}

impl Sheet {
    /// A picture with a title, and a line that says what is seen.
    pub(crate) fn titled(width: u32, height: u32, title: &str, caption: &str) -> Self {
        let mut sheet = Self {
            width,
            height,
            shapes: Vec::new(),
            key: Vec::new(),
            notes: Vec::new(),
            head: 0,
        };
        let room = f64::from(width) - 48.0;
        let fit = |text: &str, size: f64| size.min(size * room / words::width(text, size).max(1.0));
        let said = |sheet: &mut Self, y: f64, text: &str, most: f64, ink: Ink| {
            sheet.words([24.0, y], text, fit(text, most), Anchor::Start, ink);
        };
        match halves(caption, room) {
            None => {
                said(&mut sheet, 36.0, title, TITLE, TEXT);
                said(&mut sheet, 60.0, caption, SMALL, FAINT);
            }
            Some((first, second)) => {
                said(&mut sheet, 30.0, title, TITLE, TEXT);
                said(&mut sheet, 51.0, first, CLOSE, FAINT);
                said(&mut sheet, 68.0, second, CLOSE, FAINT);
            }
        }
        sheet.head = sheet.shapes.len();
        sheet
    }

    /// A line that says what bands and bars are, and ends at a place.
    pub(crate) fn note(&mut self, at: [f64; 2], text: &str) {
        self.notes.push((self.shapes.len(), text.to_owned()));
        self.words(at, text, SMALL, Anchor::End, FAINT);
    }

    pub(crate) fn line(&mut self, points: Vec<[f64; 2]>, ink: Ink, width: f64) {
        self.shapes.push(Shape::Line {
            points,
            ink,
            width,
            dash: None,
        });
    }

    /// A line that is drawn through or dashed.
    pub(crate) fn line_with(
        &mut self,
        points: Vec<[f64; 2]>,
        ink: Ink,
        width: f64,
        dash: Option<[f64; 2]>,
    ) {
        self.shapes.push(Shape::Line {
            points,
            ink,
            width,
            dash,
        });
    }

    pub(crate) fn dashed(&mut self, points: Vec<[f64; 2]>, ink: Ink, width: f64, dash: [f64; 2]) {
        self.shapes.push(Shape::Line {
            points,
            ink,
            width,
            dash: Some(dash),
        });
    }

    pub(crate) fn area(&mut self, points: Vec<[f64; 2]>, ink: Ink) {
        self.areas(vec![points], ink);
    }

    /// What several outlines enclose; one inside another is a hole.
    pub(crate) fn areas(&mut self, rings: Vec<Vec<[f64; 2]>>, ink: Ink) {
        self.shapes.push(Shape::Area { rings, ink });
    }

    pub(crate) fn rectangle(&mut self, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2], ink: Ink) {
        self.area(vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]], ink);
    }

    /// Coloured cells, row by row from the upper left.
    pub(crate) fn cells(&mut self, edges: [f64; 4], columns: u32, inks: Vec<Ink>) {
        self.shapes.push(Shape::Cells {
            edges,
            columns,
            inks,
        });
    }

    pub(crate) fn disc(&mut self, centre: [f64; 2], radius: f64, ink: Ink, rim: f64) {
        self.shapes.push(Shape::Disc {
            centre,
            radius,
            ink,
            rim,
        });
    }

    pub(crate) fn words(
        &mut self,
        at: [f64; 2],
        text: impl Into<String>,
        size: f64,
        anchor: Anchor,
        ink: Ink,
    ) {
        self.shapes.push(Shape::Words(Words {
            at,
            text: text.into(),
            size,
            anchor,
            ink,
            upwards: false,
            halo: false,
        }));
    }

    pub(crate) fn words_apart(&mut self, at: [f64; 2], text: &str, size: f64, anchor: Anchor) {
        self.shapes.push(Shape::Words(Words {
            at,
            text: text.to_owned(),
            size,
            anchor,
            ink: TEXT,
            upwards: false,
            halo: true,
        }));
    }

    /// Words that read upwards and end at a place, below an axis.
    pub(crate) fn words_turned(&mut self, at: [f64; 2], text: &str, size: f64) {
        self.shapes.push(Shape::Words(Words {
            at,
            text: text.to_owned(),
            size,
            anchor: Anchor::End,
            ink: TEXT,
            upwards: true,
            halo: false,
        }));
    }

    pub(crate) fn words_upwards(&mut self, at: [f64; 2], text: &str, size: f64) {
        self.shapes.push(Shape::Words(Words {
            at,
            text: text.to_owned(),
            size,
            anchor: Anchor::Middle,
            ink: TEXT,
            upwards: true,
            halo: false,
        }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_caption_without_room_has_two_lines_and_loses_no_word() {
        assert_eq!(halves("meadow, seed 1", 500.0), None);
        let caption = "talk, 15 runs, seeds 1 to 5, 1 s to 20 s: mean over runs, without hive, band: 95 % confidence of \
                       the mean, cut at 0 and 1";
        let (first, second) = halves(caption, 552.0).expect("too long for one");
        assert_eq!(format!("{first} {second}"), caption);
        assert!(first.ends_with(':'), "{first}");
        assert_eq!(
            halves(&"a".repeat(500), 500.0),
            None,
            "there is nowhere to break it"
        );
    }
}
