//! A picture as PNG.

use super::sheet::{Anchor, Canvas, Ink, Sheet, WHITE, Words};
use simbeeotic_view::render::words;
use tiny_skia::{
    Color, FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, PremultipliedColorU8, Rect,
    Stroke, StrokeDash, Transform,
};

/// The file's bytes; `None` if the picture is too large.
pub(crate) fn png(sheet: &Sheet) -> Option<Vec<u8>> {
    let mut pixels = Pixmap::new(sheet.width, sheet.height)?;
    pixels.fill(Color::WHITE);
    sheet.draw_on(&mut pixels);
    pixels.encode_png().ok()
}

/// Cells as a PNG of so many pixels by so many each; `None` of no cells.
pub(super) fn cells(columns: u32, inks: &[Ink], each: u32) -> Option<Vec<u8>> {
    let rows = u32::try_from(inks.len()).ok()?.checked_div(columns)?;
    let mut pixels = Pixmap::new(columns.checked_mul(each)?, rows.checked_mul(each)?)?;
    let wide = columns * each;
    for (at, pixel) in (0..).zip(pixels.pixels_mut()) {
        let (row, column) = (at / wide / each, at % wide / each);
        *pixel = premultiplied(inks[(row * columns + column) as usize]);
    }
    pixels.encode_png().ok()
}

/// A thing of which nothing is to be seen is not drawn.
impl Canvas for Pixmap {
    fn line(&mut self, points: &[[f64; 2]], ink: Ink, width: f64, dash: Option<[f64; 2]>) {
        if let Some(path) = path(&[points], false) {
            let dash = dash.and_then(|[on, off]| StrokeDash::new(vec![on as f32, off as f32], 0.0));
            stroke(self, &path, ink, width, dash, still());
        }
    }

    fn area(&mut self, rings: &[Vec<[f64; 2]>], ink: Ink) {
        if let Some(path) = path(rings, true) {
            self.fill_path(&path, &paint(ink), FillRule::EvenOdd, still(), None);
        }
    }

    fn cells(&mut self, edges: [f64; 4], columns: u32, inks: &[Ink]) {
        let _ = blocks(self, edges, columns, inks);
    }

    fn disc(&mut self, [x, y]: [f64; 2], radius: f64, ink: Ink, rim: f64) {
        if let Some(disc) = PathBuilder::from_circle(x as f32, y as f32, radius as f32) {
            fill(self, &disc, ink, still());
            if rim > 0.0 {
                stroke(self, &disc, WHITE, rim, None, still());
            }
        }
    }

    fn words(&mut self, words: &Words) {
        let _ = letters(self, words);
    }
}

fn letters(pixels: &mut Pixmap, words: &Words) -> Option<()> {
    let Words { text, size, .. } = words;
    let outline = words::outline(text, *size)?;
    let share = match words.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5,
        Anchor::End => 1.0,
    };
    let back = -(words::width(text, *size) * share) as f32;
    let [x, y] = words.at;
    let mut place = Transform::from_translate(x as f32, y as f32);
    if words.upwards {
        place = place.pre_rotate(-90.0);
    }
    let place = place.pre_translate(back, 0.0);
    if words.halo {
        stroke(pixels, &outline, WHITE, 3.5, None, place);
    }
    fill(pixels, &outline, words.ink, place);
    Some(())
}

/// Cells as rectangles whose edges are whole pixels, so that no seams are seen between them.
fn blocks(pixels: &mut Pixmap, edges: [f64; 4], columns: u32, inks: &[Ink]) -> Option<()> {
    let rows = u32::try_from(inks.len()).ok()?.checked_div(columns)?;
    let [left, top, right, bottom] = edges;
    let along = |from: f64, to: f64, at: u32, of: u32| {
        (from + (to - from) * f64::from(at) / f64::from(of)).round() as f32
    };
    for (at, ink) in (0..).zip(inks).filter(|(_, ink)| ink.alpha > 0.0) {
        let (row, column) = (at / columns, at % columns);
        let rect = Rect::from_ltrb(
            along(left, right, column, columns),
            along(top, bottom, row, rows),
            along(left, right, column + 1, columns),
            along(top, bottom, row + 1, rows),
        );
        if let Some(rect) = rect {
            pixels.fill_rect(rect, &paint(*ink), still(), None);
        }
    }
    Some(())
}

fn still() -> Transform {
    Transform::identity()
}

/// The outlines as one path, if there is anything to be seen of it. Points that are no numbers are left out.
fn path(rings: &[impl AsRef<[[f64; 2]]>], closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for ring in rings.iter().map(AsRef::as_ref) {
        for (at, [x, y]) in ring.iter().enumerate() {
            let (x, y) = (*x as f32, *y as f32);
            match at {
                0 => path.move_to(x, y),
                _ => path.line_to(x, y),
            }
        }
        if closed && !ring.is_empty() {
            path.close();
        }
    }
    path.finish()
}

fn paint(ink: Ink) -> Paint<'static> {
    let [red, green, blue] = ink.rgb;
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, alpha(ink));
    paint
}

fn alpha(ink: Ink) -> u8 {
    (ink.alpha.clamp(0.0, 1.0) * 255.0).round() as u8
}

fn premultiplied(ink: Ink) -> PremultipliedColorU8 {
    let [red, green, blue] = ink.rgb;
    tiny_skia::ColorU8::from_rgba(red, green, blue, alpha(ink)).premultiply()
}

fn fill(pixels: &mut Pixmap, path: &Path, ink: Ink, place: Transform) {
    pixels.fill_path(path, &paint(ink), FillRule::Winding, place, None);
}

fn stroke(
    pixels: &mut Pixmap,
    path: &Path,
    ink: Ink,
    width: f64,
    dash: Option<StrokeDash>,
    place: Transform,
) {
    let stroke = Stroke {
        width: width as f32,
        line_join: LineJoin::Round,
        dash,
        ..Stroke::default()
    };
    pixels.stroke_path(path, &paint(ink), &stroke, place, None);
}
