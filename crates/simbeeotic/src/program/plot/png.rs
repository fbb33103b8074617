//! A picture as PNG.

use super::font;
use super::sheet::{Anchor, Ink, Shape, Sheet};
use tiny_skia::{Color, FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, Transform};

/// The file's bytes; `None` if the picture is too large.
pub(super) fn png(sheet: &Sheet) -> Option<Vec<u8>> {
    let mut pixels = Pixmap::new(sheet.width, sheet.height)?;
    pixels.fill(Color::WHITE);
    for shape in &sheet.shapes {
        draw(&mut pixels, shape);
    }
    pixels.encode_png().ok()
}

/// Draws one thing, if anything of it is to be seen.
fn draw(pixels: &mut Pixmap, shape: &Shape) -> Option<()> {
    match shape {
        Shape::Line { points, ink, width } => {
            stroke(pixels, &path(points, false)?, *ink, *width, still());
        }
        Shape::Area { points, ink } => fill(pixels, &path(points, true)?, *ink, still()),
        Shape::Disc {
            centre: [x, y],
            radius,
            ink,
            rim,
        } => {
            let disc = PathBuilder::from_circle(*x as f32, *y as f32, *radius as f32)?;
            fill(pixels, &disc, *ink, still());
            if *rim > 0.0 {
                stroke(pixels, &disc, super::sheet::WHITE, *rim, still());
            }
        }
        Shape::Words {
            at: [x, y],
            text,
            size,
            anchor,
            ink,
            upwards,
            halo,
        } => {
            let outline = font::outline(text, *size)?;
            let share = match anchor {
                Anchor::Start => 0.0,
                Anchor::Middle => 0.5,
                Anchor::End => 1.0,
            };
            let back = -(font::width(text, *size) * share) as f32;
            let mut place = Transform::from_translate(*x as f32, *y as f32);
            if *upwards {
                place = place.pre_rotate(-90.0);
            }
            let place = place.pre_translate(back, 0.0);
            if *halo {
                stroke(pixels, &outline, super::sheet::WHITE, 3.5, place);
            }
            fill(pixels, &outline, *ink, place);
        }
    }
    Some(())
}

fn still() -> Transform {
    Transform::identity()
}

fn path(points: &[[f64; 2]], closed: bool) -> Option<Path> {
    let (first, rest) = points.split_first()?;
    let mut path = PathBuilder::new();
    path.move_to(first[0] as f32, first[1] as f32);
    for [x, y] in rest {
        path.line_to(*x as f32, *y as f32);
    }
    if closed {
        path.close();
    }
    path.finish()
}

fn paint(ink: Ink) -> Paint<'static> {
    let [red, green, blue] = ink.rgb;
    let mut paint = Paint::default();
    paint.set_color_rgba8(
        red,
        green,
        blue,
        (ink.alpha.clamp(0.0, 1.0) * 255.0).round() as u8,
    );
    paint
}

fn fill(pixels: &mut Pixmap, path: &Path, ink: Ink, place: Transform) {
    pixels.fill_path(path, &paint(ink), FillRule::Winding, place, None);
}

fn stroke(pixels: &mut Pixmap, path: &Path, ink: Ink, width: f64, place: Transform) {
    let stroke = Stroke {
        width: width as f32,
        line_join: LineJoin::Round,
        ..Stroke::default()
    };
    pixels.stroke_path(path, &paint(ink), &stroke, place, None);
}
