//! Words on pictures: DejaVu Sans, which this program carries with it, so that a picture looks the same
//! everywhere.

use std::sync::OnceLock;
use tiny_skia::{Path, PathBuilder};
use ttf_parser::{Face, OutlineBuilder};

/// The typeface; its file is part of the program.
fn face() -> Option<&'static Face<'static>> {
    static FACE: OnceLock<Option<Face<'static>>> = OnceLock::new();
    FACE.get_or_init(|| Face::parse(dejavu::sans::regular(), 0).ok())
        .as_ref()
}

/// How wide a line of words is at a size, in the size's unit.
pub fn width(text: &str, size: f64) -> f64 {
    let Some(face) = face() else { return 0.0 };
    let advance = |letter| {
        let glyph = face.glyph_index(letter).unwrap_or_default();
        f64::from(face.glyph_hor_advance(glyph).unwrap_or(0))
    };
    let units: f64 = text.chars().map(advance).sum();
    units * size / f64::from(face.units_per_em())
}

/// The outline of a line of words that begins at the origin; `y` is downwards. `None` if nothing is seen.
pub fn outline(text: &str, size: f64) -> Option<Path> {
    let face = face()?;
    let scale = size / f64::from(face.units_per_em());
    let mut pen = Pen {
        path: PathBuilder::new(),
        scale: scale as f32,
        x: 0.0,
    };
    for letter in text.chars() {
        let glyph = face.glyph_index(letter).unwrap_or_default();
        face.outline_glyph(glyph, &mut pen);
        pen.x += f64::from(face.glyph_hor_advance(glyph).unwrap_or(0)) as f32 * pen.scale;
    }
    pen.path.finish()
}

/// Puts letters one behind the other.
struct Pen {
    path: PathBuilder,
    scale: f32,
    x: f32,
}

impl Pen {
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        (self.x + x * self.scale, -y * self.scale)
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.at(x1, y1), self.at(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) = (self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_as_wide_as_their_letters_and_grow_with_their_size() {
        let [a, b, both] = ["a", "b", "ab"].map(|text| width(text, 16.0));
        assert!((a + b - both).abs() < 1e-9 && a > 5.0);
        assert!((width("ab", 32.0) - 2.0 * both).abs() < 1e-9);
        let drawn = outline("ab", 16.0).expect("letters").bounds();
        assert!(f64::from(drawn.right()) <= both && drawn.top() < 0.0);
        assert!(outline(" ", 16.0).is_none());
    }
}
