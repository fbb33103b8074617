//! Axes: where numbers are on a picture, and the ticks that say so.

use super::sheet::{AXIS, Anchor, GRID, NORMAL, SMALL, Sheet, TEXT};
use simbeeotic_units::math;
use simbeeotic_view::render::words;

/// One axis: what it shows, from where to where, and a tick every `step`.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    pub(crate) label: String,
    pub(crate) low: f64,
    pub(crate) high: f64,
    pub(crate) step: f64,
    /// Whether equal lengths are equal ratios, not equal differences.
    pub(crate) scale: Scale,
    /// Words for the ticks 0, 1, ..., if they are no numbers.
    names: Vec<String>,
}

/// What equal lengths on an axis are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scale {
    /// Equal differences.
    Linear,
    /// Equal ratios.
    Log,
    /// Equal ratios, and zero by itself before them.
    LogAndZero,
}

/// The part of a logarithmic axis that belongs to zero.
const ZERO_SHARE: f64 = 0.1;

impl Axis {
    /// From `low` to `high`, with about so many ticks at whole multiples of 1, 2 or 5 times a power of
    /// ten.
    pub(crate) fn exact(label: impl Into<String>, low: f64, high: f64, ticks: f64) -> Self {
        let high = if high > low { high } else { low + 1.0 };
        Self {
            label: label.into(),
            low,
            high,
            step: nice((high - low) / ticks),
            scale: Scale::Linear,
            names: Vec::new(),
        }
    }

    /// Words, each in the middle of a room of its own of width one.
    pub(crate) fn named(label: impl Into<String>, names: Vec<String>) -> Self {
        Self {
            label: label.into(),
            low: -0.5,
            high: names.len().max(1) as f64 - 0.5,
            step: 1.0,
            scale: Scale::Linear,
            names,
        }
    }

    /// Logarithmic, from the lesser to the greater of two numbers above zero, stretched to the next of 1, 2
    /// and 5 times a power of ten; with a place for zero before it, if `zero`.
    pub(crate) fn log(label: impl Into<String>, [low, high]: [f64; 2], zero: bool) -> Self {
        let low = if low > 0.0 && low.is_finite() {
            low
        } else {
            1.0
        };
        let low = 1.0 / nice(1.0 / low);
        let high = if high > low { nice(high) } else { 10.0 * low };
        let scale = if zero { Scale::LogAndZero } else { Scale::Log };
        Self {
            label: label.into(),
            low,
            high,
            step: 0.0,
            scale,
            names: Vec::new(),
        }
    }

    /// The same, stretched to the next ticks outside.
    pub(crate) fn stretched(label: impl Into<String>, low: f64, high: f64, ticks: f64) -> Self {
        let mut axis = Self::exact(label, low, high, ticks);
        let (step, small) = (axis.step, 1e-9);
        axis.low = (axis.low / step + small).floor() * step;
        axis.high = (axis.high / step - small).ceil() * step;
        axis
    }

    /// The ticks with their numbers.
    pub(crate) fn ticks(&self) -> Vec<(f64, String)> {
        let small = 1e-9;
        if !self.names.is_empty() {
            let names = self.names.iter().enumerate();
            return names.map(|(at, name)| (at as f64, name.clone())).collect();
        }
        if self.scale != Scale::Linear {
            return self.log_ticks();
        }
        let first = (self.low / self.step - small).ceil() as i64;
        let last = (self.high / self.step + small).floor() as i64;
        let ticks = first..=last;
        ticks
            .map(|at| {
                let value = at as f64 * self.step;
                (value, number(value, self.step))
            })
            .collect()
    }

    /// Ticks at powers of ten; of a short axis also at twice and five times each.
    fn log_ticks(&self) -> Vec<(f64, String)> {
        let small = 1e-9;
        let [first, last] = [self.low, self.high].map(math::log10);
        let digits: &[f64] = match last - first < 2.5 {
            true => &[1.0, 2.0, 5.0],
            false => &[1.0],
        };
        let mut ticks = Vec::new();
        if self.scale == Scale::LogAndZero {
            ticks.push((0.0, "0".to_owned()));
        }
        for power in first.floor() as i32..=last.ceil() as i32 {
            let ten = math::pow(10.0, f64::from(power));
            let values = digits.iter().map(|digit| digit * ten);
            let inside =
                |v: &f64| (self.low * (1.0 - small)..=self.high * (1.0 + small)).contains(v);
            ticks.extend(
                values
                    .filter(inside)
                    .map(|value| (value, number(value, ten))),
            );
        }
        ticks
    }

    fn share(&self, value: f64) -> f64 {
        let before = match self.scale {
            Scale::Linear => return (value - self.low) / (self.high - self.low),
            Scale::Log => 0.0,
            Scale::LogAndZero if value <= 0.0 => return 0.3 * ZERO_SHARE,
            Scale::LogAndZero => ZERO_SHARE,
        };
        // What is not above zero has no place: it goes to the lower end.
        let ratio = (value / self.low).max(1e-300);
        let share = math::ln(ratio) / math::ln(self.high / self.low);
        before + (1.0 - before) * share.max(0.0)
    }
}

/// Where numbers would be wider than this beside an axis, they are in powers of ten, pixels.
const TICK_ROOM: f64 = 54.0;
/// Words below an axis that would be smaller are turned, pixels.
const TURNED_BELOW: f64 = 10.5;
/// Turned words that are longer than this are cut, pixels.
const TURNED_MAX: f64 = 150.0;

impl Axis {
    /// Ticks and the label; in powers of a thousand where the numbers do not fit into a room otherwise.
    fn lettered(&self, ticks: Vec<(f64, String)>, room: f64) -> (Vec<(f64, String)>, String) {
        if !self.names.is_empty() {
            let cut = |(value, text): (f64, String)| (value, shortened(text, TURNED_MAX));
            return (ticks.into_iter().map(cut).collect(), self.label.clone());
        }
        let widest = ticks.iter().map(|(_, text)| words::width(text, SMALL));
        let greatest = self.low.abs().max(self.high.abs());
        let power = 3 * (math::log10(greatest) / 3.0).floor() as i32;
        let plain = self.scale != Scale::Linear || widest.fold(0.0, f64::max) <= room;
        if plain || power == 0 || !greatest.is_finite() {
            return (ticks, self.label.clone());
        }
        // In two parts: ten to the power of 300 is no number's inverse.
        let half = math::pow(10.0, 0.5 * f64::from(power));
        let scaled = |x: f64| x / half / half;
        let step = scaled(self.step);
        let short = ticks
            .iter()
            .map(|(value, _)| (*value, number(scaled(*value), step)));
        let short: Vec<(f64, String)> = short.collect();
        let (name, unit) = match self.label.rsplit_once(", ") {
            Some((name, unit)) => (name, format!(" {unit}")),
            None => (self.label.as_str(), String::new()),
        };
        let widest = short.iter().map(|(_, text)| words::width(text, SMALL));
        if widest.fold(0.0, f64::max) <= room {
            return (short, format!("{name}, 10{}{unit}", raised(power)));
        }
        // Far from zero, and close together: from a round number on.
        let hundred = 100.0 * self.step;
        let base = (self.low / hundred).floor() * hundred;
        let near = ticks
            .into_iter()
            .map(|(value, _)| (value, number(value - base, self.step)));
        let from = number(base, hundred);
        (near.collect(), format!("{}, from {from}", self.label))
    }

    /// How much room words below the axis need more if they are turned, pixels; `None` if they need not be.
    pub(crate) fn turned(&self, wide: f64) -> Option<f64> {
        let small = |text: &String| self.tick_size(text, wide) < TURNED_BELOW;
        if !self.names.iter().any(small) {
            return None;
        }
        let widths = self.names.iter().map(|text| words::width(text, SMALL));
        Some(widths.fold(0.0, f64::max).min(TURNED_MAX))
    }

    /// The size of a word below the x axis: words of a named axis keep to their room.
    fn tick_size(&self, text: &str, wide: f64) -> f64 {
        if self.names.is_empty() {
            return SMALL;
        }
        let room = 0.94 * wide / self.names.len() as f64;
        SMALL.min(SMALL * room / words::width(text, SMALL).max(1.0))
    }
}

/// A text that is cut to a width, with dots where its middle was.
fn shortened(text: String, most: f64) -> String {
    if words::width(&text, SMALL) <= most {
        return text;
    }
    let letters: Vec<char> = text.chars().collect();
    let both = |kept: usize| {
        let (front, back) = (kept.div_ceil(2), letters.len() - kept / 2);
        letters[..front]
            .iter()
            .chain(&['\u{2026}'])
            .chain(&letters[back..])
            .collect::<String>()
    };
    let fits = (1..letters.len())
        .rev()
        .map(both)
        .find(|text| words::width(text, SMALL) <= most);
    fits.unwrap_or_default()
}

/// An exponent.
fn raised(power: i32) -> String {
    let raise = |letter| match letter {
        '-' => '\u{207b}',
        '1' => '\u{b9}',
        '2' => '\u{b2}',
        '3' => '\u{b3}',
        digit => char::from_u32(0x2070 + (u32::from(digit) - u32::from('0'))).unwrap_or(digit),
    };
    power.to_string().chars().map(raise).collect()
}

/// The least of 1, 2 and 5 times a power of ten that is not below a number above zero.
pub(crate) fn nice(least: f64) -> f64 {
    let power = math::log10(least).floor().clamp(-300.0, 300.0) as i32;
    let tens = (0..power.abs()).fold(1.0, |tens, _| tens * 10.0);
    let scaled = |digit: f64| {
        if power < 0 {
            digit / tens
        } else {
            digit * tens
        }
    };
    let digits = [1.0, 2.0, 5.0, 10.0].map(scaled);
    let fits = digits.into_iter().find(|d| *d >= least * (1.0 - 1e-9));
    fits.unwrap_or(least)
}

/// A number with the digits that a step needs.
pub(crate) fn number(value: f64, step: f64) -> String {
    let decimals = (-math::log10(step).floor()).clamp(0.0, 9.0) as usize;
    let digits = format!("{:.decimals$}", value.abs());
    let (whole, rest) = digits.split_at(digits.find('.').unwrap_or(digits.len()));
    let sign = if value < 0.0 && digits.contains(|c| ('1'..='9').contains(&c)) {
        "\u{2212}"
    } else {
        ""
    };
    format!("{sign}{}{rest}", grouped(whole))
}

/// Digits in groups of three.
pub(crate) fn grouped(digits: &str) -> String {
    let mut grouped = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}

/// A rectangle of the picture with two axes.
#[derive(Clone, Debug)]
pub(crate) struct Panel {
    /// Left, top, right, bottom, pixels.
    pub(crate) edges: [f64; 4],
    pub(crate) x: Axis,
    pub(crate) y: Axis,
}

impl Panel {
    /// Where a pair of numbers is on the picture.
    pub(crate) fn place(&self, x: f64, y: f64) -> [f64; 2] {
        let [left, top, right, bottom] = self.edges;
        [
            left + (right - left) * self.x.share(x),
            bottom - (bottom - top) * self.y.share(y),
        ]
    }

    /// Draws grid, axes and numbers; those below only if `below`.
    pub(crate) fn draw(&self, sheet: &mut Sheet, below: bool) {
        self.draw_with(sheet, [true, below]);
    }

    /// The same; numbers and names of the y axis only if `beside`, of the x axis only if `below`.
    pub(crate) fn draw_with(&self, sheet: &mut Sheet, [beside, below]: [bool; 2]) {
        let [left, top, right, bottom] = self.edges;
        let ticks = self.x.ticks();
        let between = 0.92 * (right - left) / ticks.len().max(1) as f64;
        let (ticks, label) = self.x.lettered(ticks, between);
        let turned = self.x.turned(right - left);
        for (value, text) in ticks {
            let [x, _] = self.place(value, self.y.low);
            sheet.line(vec![[x, top], [x, bottom]], GRID, 1.0);
            if below {
                sheet.line(vec![[x, bottom], [x, bottom + 5.0]], AXIS, 1.0);
                match turned {
                    Some(_) => sheet.words_turned([x + 5.0, bottom + 10.0], &text, SMALL),
                    None => {
                        let size = self.x.tick_size(&text, right - left);
                        sheet.words([x, bottom + 22.0], text, size, Anchor::Middle, TEXT);
                    }
                }
            }
        }
        let (ticks, upright) = self.y.lettered(self.y.ticks(), TICK_ROOM);
        for (value, text) in ticks {
            let [_, y] = self.place(self.x.low, value);
            sheet.line(vec![[left, y], [right, y]], GRID, 1.0);
            if beside {
                sheet.words([left - 9.0, y + 5.0], text, SMALL, Anchor::End, TEXT);
            }
        }
        sheet.line(
            vec![[left, top], [left, bottom], [right, bottom]],
            AXIS,
            1.2,
        );
        if below {
            let foot = bottom + 47.0 + turned.unwrap_or(0.0);
            let middle = [0.5 * (left + right), foot];
            sheet.words(middle, label, NORMAL, Anchor::Middle, TEXT);
        }
        if beside {
            let room = bottom - top;
            let size = NORMAL * (room / words::width(&upright, NORMAL).max(1.0)).clamp(0.6, 1.0);
            sheet.words_upwards([left - 66.0, 0.5 * (top + bottom)], &upright, size);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_one_two_or_five_times_a_power_of_ten() {
        for (least, step) in [
            (0.7, 1.0),
            (1.0, 1.0),
            (1.1, 2.0),
            (2.4, 5.0),
            (6.0, 10.0),
            (0.03, 0.05),
            (0.2, 0.2),
            (1200.0, 2000.0),
        ] {
            assert_eq!(nice(least), step, "{least}");
        }
    }

    #[test]
    fn ticks_are_whole_multiples_with_the_digits_they_need() {
        let texts =
            |axis: &Axis| -> Vec<String> { axis.ticks().into_iter().map(|t| t.1).collect() };
        assert_eq!(
            texts(&Axis::exact("", -0.1, 0.35, 5.0)),
            ["\u{2212}0.1", "0.0", "0.1", "0.2", "0.3"]
        );
        assert_eq!(texts(&Axis::exact("", 0.0, 1.0, 5.0)).len(), 6);
        let wide = Axis::stretched("", 3.0, 2900.0, 3.0);
        assert_eq!((wide.low, wide.high), (0.0, 3000.0));
        assert_eq!(texts(&wide), ["0", "1,000", "2,000", "3,000"]);
    }

    #[test]
    fn numbers_without_room_are_in_powers_of_a_thousand() {
        let lettered = |axis: &Axis, room| {
            let (ticks, label) = axis.lettered(axis.ticks(), room);
            (ticks.into_iter().map(|t| t.1).collect::<Vec<_>>(), label)
        };
        let (ticks, label) = lettered(&Axis::exact("energy, J", 0.0, 4e8, 4.0), TICK_ROOM);
        assert_eq!(ticks, ["0", "100", "200", "300", "400"]);
        assert_eq!(label, "energy, 10\u{2076} J");
        let (ticks, label) = lettered(&Axis::exact("n", 0.0, 2e-9, 2.0), TICK_ROOM);
        assert_eq!(
            (ticks[1].as_str(), label.as_str()),
            ("1", "n, 10\u{207b}\u{2079}")
        );
        let (ticks, label) = lettered(&Axis::exact("n", 0.0, 2e300, 2.0), TICK_ROOM);
        assert_eq!(
            (ticks[1].as_str(), label.as_str()),
            ("1", "n, 10\u{b3}\u{2070}\u{2070}")
        );
        let far = Axis::exact("north, m", -8_999_997.0, -8_999_990.0, 4.0);
        let (ticks, label) = lettered(&far, TICK_ROOM);
        assert_eq!(label, "north, m, from \u{2212}9,000,000");
        assert_eq!(ticks, ["4", "6", "8", "10"]);
        let (ticks, label) = lettered(&Axis::exact("n", 0.0, 2000.0, 2.0), TICK_ROOM);
        assert_eq!((ticks[1].as_str(), label.as_str()), ("1,000", "n"));
    }

    #[test]
    fn words_that_would_be_too_small_are_turned_and_long_ones_cut() {
        let names = |count: usize| {
            (0..count)
                .map(|at| format!("file-number-{at}.toml"))
                .collect()
        };
        assert_eq!(Axis::named("", names(3)).turned(600.0), None);
        assert!(
            Axis::named("", names(20))
                .turned(600.0)
                .is_some_and(|room| room > 80.0)
        );
        let cut = shortened(
            "a/very/long/path/to/some/folder/scenario.toml".to_owned(),
            150.0,
        );
        assert!(
            words::width(&cut, SMALL) <= 150.0 && cut.contains('\u{2026}'),
            "{cut}"
        );
        assert!(cut.starts_with("a/") && cut.ends_with(".toml"), "{cut}");
    }

    #[test]
    fn on_a_logarithmic_axis_equal_ratios_are_equally_far() {
        let axis = Axis::log("", [0.03, 700.0], false);
        assert!(
            (axis.low - 0.02).abs() < 1e-12 && axis.high == 1000.0,
            "{axis:?}"
        );
        let gap = axis.share(1.0) - axis.share(0.1);
        assert!((axis.share(100.0) - axis.share(10.0) - gap).abs() < 1e-12);
        assert!(axis.share(axis.low).abs() < 1e-12 && (axis.share(1000.0) - 1.0).abs() < 1e-12);
        assert_eq!((axis.share(0.0), axis.share(f64::NAN)), (0.0, 0.0));
        let texts: Vec<String> = axis.ticks().into_iter().map(|t| t.1).collect();
        assert_eq!(texts, ["0.1", "1", "10", "100", "1,000"]);
        let short = Axis::log("", [3.0, 90.0], false);
        let texts: Vec<String> = short.ticks().into_iter().map(|t| t.1).collect();
        assert_eq!(texts, ["2", "5", "10", "20", "50", "100"]);
    }

    #[test]
    fn zero_has_a_place_of_its_own_before_a_logarithmic_axis() {
        let axis = Axis::log("", [10.0, 1000.0], true);
        assert!(0.0 < axis.share(0.0) && axis.share(0.0) < axis.share(10.0));
        assert_eq!(axis.ticks()[0], (0.0, "0".to_owned()));
        assert!((axis.share(1000.0) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_corners_of_a_panel_are_the_ends_of_its_axes() {
        let panel = Panel {
            edges: [10.0, 20.0, 110.0, 220.0],
            x: Axis::exact("", -1.0, 1.0, 4.0),
            y: Axis::exact("", 0.0, 50.0, 4.0),
        };
        assert_eq!(panel.place(-1.0, 0.0), [10.0, 220.0]);
        assert_eq!(panel.place(1.0, 50.0), [110.0, 20.0]);
        assert_eq!(panel.place(0.0, 25.0), [60.0, 120.0]);
    }
}
