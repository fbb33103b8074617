//! What stands over a picture: the time, a scale, what colours mean, names.

use super::colours::Key;
use super::light::Theme;
use super::painter::Picture;
use super::words;
use tiny_skia::{
    Color, FillRule, LineJoin, Paint, PathBuilder, Pixmap, PremultipliedColorU8, Rect, Stroke,
    Transform,
};

/// A picture to write on.
pub(super) struct Overlay {
    pixels: Pixmap,
    theme: Theme,
    /// Size of words, pixels.
    unit: f64,
}

/// Where a word stands to its place.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Overlay {
    /// `None` if the picture has no pixels.
    pub(super) fn on(picture: &Picture, theme: Theme) -> Option<Self> {
        let mut pixels = Pixmap::new(picture.width, picture.height)?;
        for (pixel, rgb) in pixels
            .pixels_mut()
            .iter_mut()
            .zip(picture.rgb.as_chunks::<3>().0)
        {
            let [r, g, b] = *rgb;
            *pixel = PremultipliedColorU8::from_rgba(r, g, b, 255)?;
        }
        let side = f64::from(picture.height.min(picture.width));
        Some(Self {
            pixels,
            theme,
            unit: (side / 40.0).clamp(10.0, 40.0),
        })
    }

    /// The picture with all that was written.
    pub(super) fn done(&self) -> Picture {
        Picture {
            width: self.pixels.width(),
            height: self.pixels.height(),
            rgb: (self.pixels.pixels().iter())
                .flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()])
                .collect(),
        }
    }

    fn size(&self) -> [f64; 2] {
        [self.pixels.width(), self.pixels.height()].map(f64::from)
    }

    fn words(&mut self, at: [f64; 2], text: &str, size: f64, anchor: Anchor, alpha: u8) {
        let Some(outline) = words::outline(text, size) else {
            return;
        };
        let back = match anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5,
            Anchor::End => 1.0,
        } * words::width(text, size);
        let place = Transform::from_translate((at[0] - back) as f32, at[1] as f32);
        let halo = Stroke {
            width: (0.24 * size) as f32,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        let under = paint(self.theme.paper, (u16::from(alpha) * 200 / 255) as u8);
        self.pixels
            .stroke_path(&outline, &under, &halo, place, None);
        let ink = paint(self.theme.ink, alpha);
        self.pixels
            .fill_path(&outline, &ink, FillRule::Winding, place, None);
    }

    fn bar(&mut self, [x, y]: [f64; 2], [width, height]: [f64; 2], rgb: [u8; 3], alpha: u8) {
        let rect = Rect::from_xywh(x as f32, y as f32, width as f32, height as f32);
        if let Some(rect) = rect {
            let path = PathBuilder::from_rect(rect);
            let paint = paint(rgb, alpha);
            self.pixels.fill_path(
                &path,
                &paint,
                FillRule::Winding,
                Transform::identity(),
                None,
            );
        }
    }

    /// The time, at the lower left, with what the run is called beside it.
    pub(super) fn time(&mut self, time: &str, name: &str) {
        let [_, height] = self.size();
        let unit = self.unit;
        self.words([unit, height - unit], time, 1.25 * unit, Anchor::Start, 255);
        let past = words::width("0000.00 s", 1.25 * unit).max(words::width(time, 1.25 * unit));
        self.words(
            [1.7 * unit + past, height - unit],
            name,
            0.8 * unit,
            Anchor::Start,
            210,
        );
    }

    /// A bar that is a round number of metres long, at the lower right.
    pub(super) fn scale(&mut self, pixels_a_metre: f64) {
        let [width, height] = self.size();
        let unit = self.unit;
        let room_m = 0.2 * width / pixels_a_metre.max(1e-12);
        let mut length_m = 1e-3;
        for digit in [1.0, 2.0, 5.0] {
            for power in [1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5] {
                if digit * power <= room_m && digit * power > length_m {
                    length_m = digit * power;
                }
            }
        }
        let long = length_m * pixels_a_metre;
        let (x, y, thick) = (
            width - unit - long,
            height - unit,
            (0.14 * unit).round().max(2.0),
        );
        let (ink, paper) = (self.theme.ink, self.theme.paper);
        let rim = 1.5;
        self.bar(
            [x - rim, y - thick - rim],
            [long + 2.0 * rim, thick + 2.0 * rim],
            paper,
            190,
        );
        self.bar([x, y - thick], [long, thick], ink, 255);
        let text = metres(length_m);
        let at = [x + 0.5 * long, y - thick - 0.5 * unit];
        self.words(at, &text, 0.95 * unit, Anchor::Middle, 255);
    }

    /// How large the cells of the grid are, at the lower right.
    pub(super) fn grid(&mut self, cell_m: f64) {
        let [width, height] = self.size();
        let unit = self.unit;
        let text = format!("grid {}", metres(cell_m));
        self.words(
            [width - unit, height - unit],
            &text,
            0.95 * unit,
            Anchor::End,
            255,
        );
    }

    /// What colours mean, at the upper right.
    pub(super) fn key(&mut self, key: &Key) {
        let [width, _] = self.size();
        let unit = self.unit;
        let size = 0.95 * unit;
        match key {
            Key::None => {}
            Key::Names(names) => {
                let shown = names.len().min(8);
                let widest = names[..shown]
                    .iter()
                    .map(|(name, _)| words::width(name, size))
                    .fold(0.0, f64::max);
                for (row, (name, rgb)) in names[..shown].iter().enumerate() {
                    let y = unit * (1.9 + 1.5 * row as f64);
                    let x = width - unit - widest;
                    let (rim, side) = (self.theme.paper, 0.8 * unit);
                    let at = [x - 1.4 * unit, y - 0.75 * unit];
                    self.bar([at[0] - 1.5, at[1] - 1.5], [side + 3.0; 2], rim, 190);
                    self.bar(at, [side; 2], *rgb, 255);
                    self.words([x, y], name, size, Anchor::Start, 255);
                }
            }
            Key::Scale {
                title,
                low,
                high,
                scale,
            } => {
                let long = (0.2 * width).max(8.0 * unit).min(width - 2.0 * unit);
                let (x, y) = (width - unit - long, 2.2 * unit);
                let (rim, tall) = (self.theme.paper, 0.6 * unit);
                self.words([x, y - 0.5 * unit], title, size, Anchor::Start, 255);
                self.bar([x - 1.5, y - 1.5], [long + 3.0, tall + 3.0], rim, 190);
                let steps = 64;
                for step in 0..steps {
                    let share = f64::from(step) / f64::from(steps - 1);
                    let part = long / f64::from(steps);
                    // To whole pixels, so that no seams show.
                    let from = (x + part * f64::from(step)).round();
                    let to = (x + part * f64::from(step + 1)).round();
                    self.bar([from, y], [to - from, tall], scale.colour(share), 255);
                }
                let below = y + tall + 1.05 * unit;
                self.words([x, below], &number(*low), 0.85 * unit, Anchor::Start, 255);
                self.words(
                    [x + long, below],
                    &number(*high),
                    0.85 * unit,
                    Anchor::End,
                    255,
                );
            }
        }
    }

    /// Names beside places, as far as there is room: the first ones have theirs.
    pub(super) fn labels<'n>(&mut self, names: impl Iterator<Item = ([f64; 2], &'n str)>) {
        let size = 0.72 * self.unit;
        let mut taken: Vec<[f64; 4]> = Vec::new();
        for ([x, y], name) in names {
            let own = [
                x,
                y - 0.5 * size,
                x + words::width(name, size),
                y + 0.5 * size,
            ];
            let meets = |other: &[f64; 4]| {
                own[0] < other[2] && other[0] < own[2] && own[1] < other[3] && other[1] < own[3]
            };
            if !taken.iter().any(meets) {
                taken.push(own);
                self.words([x, y + 0.35 * size], name, size, Anchor::Start, 235);
            }
        }
    }
}

fn paint([r, g, b]: [u8; 3], alpha: u8) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color(Color::from_rgba8(r, g, b, alpha));
    paint
}

fn metres(length_m: f64) -> String {
    match length_m {
        m if m >= 1000.0 => format!("{} km", number(m / 1000.0)),
        m if m < 0.01 => format!("{} mm", number(m * 1000.0)),
        m if m < 1.0 => format!("{} cm", number(m * 100.0)),
        m => format!("{} m", number(m)),
    }
}

/// A number without digits that say nothing.
fn number(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    format!("{}", rounded + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_said_in_their_own_unit() {
        let said = [0.002, 0.5, 1.0, 20.0, 5000.0].map(metres);
        assert_eq!(said, ["2 mm", "50 cm", "1 m", "20 m", "5 km"]);
    }

    #[test]
    fn names_that_would_lie_on_others_are_left_out() {
        let picture = Picture {
            width: 200,
            height: 100,
            rgb: vec![0; 200 * 100 * 3],
        };
        let written = |names: &[([f64; 2], &str)]| {
            let theme = Theme::new(true, [0; 4]);
            let mut overlay = Overlay::on(&picture, theme).expect("a picture");
            overlay.labels(names.iter().copied());
            overlay.done()
        };
        let (first, over, apart) = (
            ([20.0, 50.0], "bee-1"),
            ([24.0, 53.0], "bee-2"),
            ([20.0, 80.0], "bee-3"),
        );
        assert_eq!(written(&[first, over, apart]), written(&[first, apart]));
        assert_ne!(written(&[first, apart]), written(&[first]));
    }

    #[test]
    fn a_scale_bar_is_as_long_as_it_says() {
        let picture = Picture {
            width: 800,
            height: 600,
            rgb: vec![0; 800 * 600 * 3],
        };
        let theme = Theme::new(true, [0; 4]);
        let mut overlay = Overlay::on(&picture, theme).expect("a picture");
        // 13 pixels a metre: room for 160 pixels, so 10 m are 130.
        overlay.scale(13.0);
        let done = overlay.done();
        let ink = |x: usize, y: usize| done.rgb[3 * (y * 800 + x)..][..3] == theme.ink;
        let row = (500..600).rev().find(|y| (0..800).any(|x| ink(x, *y)));
        let row = row.expect("a bar");
        assert_eq!((0..800).filter(|x| ink(*x, row)).count(), 130);
    }
}
