//! The built-in pictures, painted as the page paints them: the same strokes, from the same chance.

use std::f64::consts::{PI, TAU};
use tiny_skia::{
    Color, FillRule, GradientStop, Paint, Path, PathBuilder, Pixmap, Point, RadialGradient, Rect,
    SpreadMode, Stroke, Transform,
};

/// Width and height of a painting, pixels.
pub(super) const SIZE: u32 = 256;
const WIDE: f64 = SIZE as f64;

/// A built-in picture: `brick`, or `grass_3`, which is grass from another chance. With it, the width that it has on
/// a surface, m. `None` if nothing is called so.
pub(super) fn painting(name: &str) -> Option<(f32, Pixmap)> {
    let (kind, seed) = match name.rsplit_once('_') {
        Some((kind, number)) => (kind, number.parse::<u32>().ok()?),
        None => (name, 0),
    };
    let (tile_m, paint): (f32, fn(&mut Easel)) = match kind {
        "brick" => (1.0, brick),
        "grass" => (3.0, grass),
        "metal" => (2.0, metal),
        "sky" => (40.0, sky),
        "stone" => (2.0, stone),
        "tree" => (1.5, tree),
        "wood" => (1.0, wood),
        _ => return None,
    };
    let mut easel = Easel {
        pixels: Pixmap::new(SIZE, SIZE)?,
        state: seed.wrapping_add(7),
    };
    paint(&mut easel);
    Some((tile_m, easel.pixels))
}

/// A picture in the making, and its chance.
struct Easel {
    pixels: Pixmap,
    state: u32,
}

type Rgb = [f64; 3];

impl Easel {
    /// A number from 0 to 1: *mulberry32* of T. Ettinger, public domain.
    fn chance(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x6d2b_79f5);
        let s = self.state;
        let mut t = (s ^ (s >> 15)).wrapping_mul(1 | s);
        t = t.wrapping_add((t ^ (t >> 7)).wrapping_mul(61 | t)) ^ t;
        f64::from(t ^ (t >> 14)) / 4_294_967_296.0
    }

    fn fill(&mut self, [r, g, b]: [u8; 3]) {
        self.pixels.fill(Color::from_rgba8(r, g, b, 255));
    }

    fn block(&mut self, [x, y, width, height]: [f64; 4], rgb: Rgb, alpha: f64) {
        let rect = Rect::from_xywh(x as f32, y as f32, width as f32, height as f32);
        if let Some(rect) = rect {
            let path = PathBuilder::from_rect(rect);
            self.area(&path, rgb, alpha);
        }
    }

    fn area(&mut self, path: &Path, rgb: Rgb, alpha: f64) {
        let still = Transform::identity();
        self.pixels
            .fill_path(path, &ink(rgb, alpha), FillRule::Winding, still, None);
    }

    fn stroke(&mut self, path: &Path, rgb: Rgb, alpha: f64) {
        let line = Stroke::default();
        let still = Transform::identity();
        self.pixels
            .stroke_path(path, &ink(rgb, alpha), &line, still, None);
    }

    /// Many marks; those at an edge are made at the opposite one too, so that the picture repeats without a seam.
    fn speckle(&mut self, count: usize, mut mark: impl FnMut(&mut Self, f64, f64)) {
        for _ in 0..count {
            let (x, y) = (self.chance() * WIDE, self.chance() * WIDE);
            for dx in [0.0, -WIDE, WIDE] {
                for dy in [0.0, -WIDE, WIDE] {
                    let near = |at: f64| (at - 0.5 * WIDE).abs() < 0.75 * WIDE;
                    if near(x + dx) && near(y + dy) {
                        mark(self, x + dx, y + dy);
                    }
                }
            }
        }
    }
}

fn ink(rgb: Rgb, alpha: f64) -> Paint<'static> {
    let [r, g, b] = rgb.map(|part| part.round().clamp(0.0, 255.0) as u8);
    let mut paint = Paint::default();
    let alpha = (alpha * 255.0).round().clamp(0.0, 255.0) as u8;
    paint.set_color(Color::from_rgba8(r, g, b, alpha));
    paint
}

fn shade(rgb: Rgb, by: f64) -> Rgb {
    rgb.map(|part| part * by)
}

/// What is left of a number after whole steps.
fn rest(value: f64, step: f64) -> f64 {
    value % step
}

fn brick(on: &mut Easel) {
    on.fill([0xb9, 0xb0, 0xa3]);
    let (rows, columns) = (8, 4);
    let (h, w) = (WIDE / f64::from(rows), WIDE / f64::from(columns));
    for row in 0..rows {
        for column in 0..columns {
            let off = if row % 2 == 1 { 0.5 * w } else { 0.0 };
            let x = f64::from(column) * w + off;
            let colour = shade([168.0, 84.0, 62.0], 0.82 + 0.32 * on.chance());
            for at in [x, x - WIDE] {
                let y = f64::from(row) * h;
                on.block([at + 2.0, y + 2.0, w - 4.0, h - 4.0], colour, 1.0);
            }
        }
    }
}

fn grass(on: &mut Easel) {
    on.fill([0x5d, 0x8c, 0x3f]);
    for layer in 0..3 {
        let own = [
            104.0 - 14.0 * f64::from(layer),
            152.0 - 10.0 * f64::from(layer),
            66.0,
        ];
        on.speckle(1600, |on, x, y| {
            let light = 0.65 + 0.5 * rest(x * 7.0 + y * 13.0, 1.0);
            let mut blade = PathBuilder::new();
            blade.move_to(x as f32, y as f32);
            blade.line_to((x + 3.0 - rest(x * 3.1, 6.0)) as f32, (y - 7.0) as f32);
            if let Some(blade) = blade.finish() {
                on.stroke(&blade, shade(own, light), 1.0);
            }
        });
    }
}

fn metal(on: &mut Easel) {
    on.fill([0xa9, 0xb0, 0xb6]);
    for y in 0..SIZE {
        let alpha = 0.12 * on.chance();
        on.block([0.0, f64::from(y), WIDE, 1.0], [255.0; 3], alpha);
    }
    let seam = [127.0, 134.0, 140.0];
    for x in [0.0, 0.5 * WIDE] {
        on.block([x, 0.0, 3.0, WIDE], seam, 1.0);
    }
    on.block([0.0, 0.0, WIDE, 3.0], seam, 1.0);
}

fn sky(on: &mut Easel) {
    on.fill([0x8f, 0xc0, 0xea]);
    on.speckle(60, |on, x, y| {
        let white = |alpha: f32| Color::from_rgba(1.0, 1.0, 1.0, alpha);
        let (Some(thick), Some(thin)) = (white(0.35), white(0.0)) else {
            return;
        };
        let stops = vec![GradientStop::new(0.0, thick), GradientStop::new(1.0, thin)];
        let middle = Point::from_xy(x as f32, y as f32);
        let spread = SpreadMode::Pad;
        let still = Transform::identity();
        let cloud = RadialGradient::new(middle, 0.0, middle, 34.0, stops, spread, still);
        let around = Rect::from_xywh((x - 34.0) as f32, (y - 34.0) as f32, 68.0, 68.0);
        if let (Some(shader), Some(around)) = (cloud, around) {
            let paint = Paint {
                shader,
                ..Paint::default()
            };
            on.pixels.fill_rect(around, &paint, still, None);
        }
    });
}

fn stone(on: &mut Easel) {
    on.fill([0x6e, 0x6a, 0x64]);
    let count = 6;
    let w = WIDE / f64::from(count);
    for row in 0..count {
        for column in 0..count {
            let colour = shade([158.0, 153.0, 144.0], 0.78 + 0.36 * on.chance());
            let off = if row % 2 == 1 { 0.5 * w } else { 0.0 };
            let x = f64::from(column) * w + off + 2.0 * on.chance();
            for at in [x, x - WIDE] {
                let wide = w - 4.0 - 4.0 * on.chance();
                let place = [at + 2.0, f64::from(row) * w + 2.0, wide, w - 4.0];
                if let Some(path) = round(place, 9.0) {
                    on.area(&path, colour, 1.0);
                }
            }
        }
    }
    on.speckle(900, |on, x, y| {
        on.block([x, y, 2.0, 2.0], [0.0; 3], 0.08);
    });
}

/// A rectangle with round corners.
fn round([x, y, width, height]: [f64; 4], radius: f64) -> Option<Path> {
    let [left, top, right, foot] = [x, y, x + width, y + height].map(|v| v as f32);
    let r = radius.min(0.5 * width).min(0.5 * height) as f32;
    // Where the cubic that is nearest to a quarter of a circle has its handles.
    let k = r * (1.0 - 0.552_285);
    let mut path = PathBuilder::new();
    path.move_to(left + r, top);
    path.line_to(right - r, top);
    path.cubic_to(right - k, top, right, top + k, right, top + r);
    path.line_to(right, foot - r);
    path.cubic_to(right, foot - k, right - k, foot, right - r, foot);
    path.line_to(left + r, foot);
    path.cubic_to(left + k, foot, left, foot - k, left, foot - r);
    path.line_to(left, top + r);
    path.cubic_to(left, top + k, left + k, top, left + r, top);
    path.close();
    path.finish()
}

fn tree(on: &mut Easel) {
    on.fill([0x2f, 0x5a, 0x2a]);
    for layer in 0..4 {
        let layer = f64::from(layer);
        let colour = shade(
            [70.0 + 14.0 * layer, 118.0 + 16.0 * layer, 52.0],
            0.6 + 0.14 * layer,
        );
        on.speckle(420, |on, x, y| {
            let oval = Rect::from_xywh(-6.0, -3.4, 12.0, 6.8).and_then(PathBuilder::from_oval);
            let turn = (rest(x * y, PI) / TAU * 360.0) as f32;
            let place = Transform::from_rotate(turn).post_translate(x as f32, y as f32);
            if let Some(leaf) = oval.and_then(|oval| oval.transform(place)) {
                on.area(&leaf, colour, 1.0);
            }
        });
    }
}

fn wood(on: &mut Easel) {
    on.fill([0xa8, 0x77, 0x4a]);
    let planks = 4;
    let h = WIDE / f64::from(planks);
    for plank in 0..planks {
        let top = f64::from(plank) * h;
        let colour = shade([174.0, 126.0, 80.0], 0.84 + 0.26 * on.chance());
        on.block([0.0, top, WIDE, h - 2.0], colour, 1.0);
        for _ in 0..9 {
            let alpha = 0.12 + 0.16 * on.chance();
            let y = (top + h * on.chance()) as f32;
            let bend = (4.0 * on.chance()) as f32;
            let wide = WIDE as f32;
            let mut grain = PathBuilder::new();
            grain.move_to(0.0, y);
            grain.cubic_to(wide / 3.0, y + bend, 2.0 * wide / 3.0, y - bend, wide, y);
            if let Some(grain) = grain.finish() {
                on.stroke(&grain, [70.0, 40.0, 15.0], alpha);
            }
        }
        on.block([0.0, top + h - 2.0, WIDE, 2.0], [95.0, 63.0, 34.0], 1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mean(pixels: &Pixmap) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for pixel in pixels.pixels() {
            let rgb = [pixel.red(), pixel.green(), pixel.blue()];
            for (sum, part) in sum.iter_mut().zip(rgb) {
                *sum += f64::from(part) / (WIDE * WIDE);
            }
        }
        sum
    }

    #[test]
    fn each_has_the_colour_of_what_it_shows_and_is_no_plain_area() {
        for (name, is) in [
            ("brick", (|[r, _, b]: Rgb| r > 1.5 * b) as fn(Rgb) -> bool),
            ("grass", |[r, g, b]| g > r && g > b),
            ("metal", |[r, _, b]| (r - b).abs() < 20.0 && r > 150.0),
            ("sky", |[r, _, b]| b > r + 30.0),
            ("stone", |[r, _, b]| (r - b).abs() < 20.0 && r < 160.0),
            ("tree", |[r, g, b]| g > r && g > b),
            ("wood", |[r, _, b]| r > 1.5 * b),
        ] {
            let (tile_m, pixels) = painting(name).expect(name);
            assert!(
                tile_m > 0.0 && is(mean(&pixels)),
                "{name} {:?}",
                mean(&pixels)
            );
            let first = pixels.pixels()[0];
            let others = pixels.pixels().iter().filter(|pixel| **pixel != first);
            assert!(others.count() > 500, "{name}");
        }
    }

    #[test]
    fn a_number_is_another_one_of_the_kind_and_other_names_are_none() {
        let data = |name: &str| painting(name).expect(name).1.data().to_vec();
        assert_eq!(data("brick"), data("brick_0"));
        assert_ne!(data("brick"), data("brick_3"));
        for other in ["", "bricks", "brick_", "brick_x", "_1", "pictures/a_1.png"] {
            assert!(painting(other).is_none(), "{other}");
        }
    }
}
