//! A picture as SVG.

use super::png;
use super::sheet::{Anchor, Canvas, Ink, Sheet, Words};
use std::fmt::Write as _;

/// The file's text.
pub(crate) fn svg(sheet: &Sheet) -> String {
    let (width, height) = (sheet.width, sheet.height);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"'DejaVu Sans', Verdana, Arial, sans-serif\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    sheet.draw_on(&mut Svg(&mut text));
    text.push_str("</svg>\n");
    text
}

/// A text that grows by one element for each thing. Writing to a text cannot fail.
struct Svg<'t>(&'t mut String);

impl Canvas for Svg<'_> {
    fn line(&mut self, points: &[[f64; 2]], ink: Ink, width: f64, dash: Option<[f64; 2]>) {
        let dash = dash.map_or(String::new(), |[on, off]| {
            format!(" stroke-dasharray=\"{} {}\"", short(on), short(off))
        });
        let _ = writeln!(
            self.0,
            "<path d=\"{}\" fill=\"none\" stroke=\"{}\"{} stroke-width=\"{}\"{dash} stroke-linejoin=\"round\"/>",
            path(points),
            colour(ink),
            opacity("stroke", ink),
            short(width)
        );
    }

    fn area(&mut self, rings: &[Vec<[f64; 2]>], ink: Ink) {
        let rule = match rings.len() > 1 {
            true => " fill-rule=\"evenodd\"",
            false => "",
        };
        let paths: String = rings.iter().map(|ring| path(ring) + "z").collect();
        let _ = writeln!(
            self.0,
            "<path d=\"{paths}\" fill=\"{}\"{}{rule}/>",
            colour(ink),
            opacity("fill", ink)
        );
    }

    /// A picture in the picture.
    fn cells(&mut self, edges: [f64; 4], columns: u32, inks: &[Ink]) {
        let [left, top, right, bottom] = edges;
        // Viewers that smooth pixels must not smooth large cells.
        let wide = (right - left) / f64::from(columns.max(1));
        let each = if wide >= 4.0 {
            wide.min(64.0).round() as u32
        } else {
            1
        };
        let Some(png) = png::cells(columns, inks, each) else {
            return;
        };
        let _ = writeln!(
            self.0,
            "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" \
             style=\"image-rendering:pixelated\" href=\"data:image/png;base64,{}\"/>",
            short(left),
            short(top),
            short(right - left),
            short(bottom - top),
            base64(&png)
        );
    }

    fn disc(&mut self, [x, y]: [f64; 2], radius: f64, ink: Ink, rim: f64) {
        let rim = match rim > 0.0 {
            true => format!(" stroke=\"#ffffff\" stroke-width=\"{}\"", short(rim)),
            false => String::new(),
        };
        let _ = writeln!(
            self.0,
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"{}{rim}/>",
            short(x),
            short(y),
            short(radius),
            colour(ink),
            opacity("fill", ink)
        );
    }

    fn words(&mut self, words: &Words) {
        let anchor = match words.anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let [x, y] = words.at.map(short);
        let turn = match words.upwards {
            true => format!(" transform=\"rotate(-90 {x} {y})\""),
            false => String::new(),
        };
        let rim = match words.halo {
            true => {
                " stroke=\"#ffffff\" stroke-width=\"3.5\" stroke-linejoin=\"round\" paint-order=\"stroke\""
            }
            false => "",
        };
        let _ = writeln!(
            self.0,
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\" fill=\"{}\"{anchor}{turn}{rim}>{}</text>",
            short(words.size),
            colour(words.ink),
            escaped(&words.text)
        );
    }
}

/// Bytes as letters, RFC 4648.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let byte = |at: usize| u32::from(three.get(at).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for place in 0..4 {
            text.push(match place <= three.len() {
                true => char::from(LETTERS[(bits >> (18 - 6 * place)) as usize % 64]),
                false => '=',
            });
        }
    }
    text
}

/// A path: where it begins, then the steps from point to point, which take fewer letters.
fn path(points: &[[f64; 2]]) -> String {
    let mut path = String::new();
    let mut last = [0.0; 2];
    for (at, point) in points.iter().enumerate() {
        // Steps between rounded places: nothing adds up.
        let [x, y] = point.map(hundredths);
        let [dx, dy] = [x - last[0], y - last[1]].map(|step| step / 100.0 + 0.0);
        let (letter, gap) = (
            if at == 0 { "M" } else { "l" },
            if dy < 0.0 { "" } else { " " },
        );
        let _ = write!(path, "{letter}{dx}{gap}{dy}");
        last = [x, y];
    }
    path
}

fn hundredths(number: f64) -> f64 {
    (number * 100.0).round()
}

/// Hundredths of a pixel are enough.
fn short(number: f64) -> f64 {
    hundredths(number) / 100.0 + 0.0
}

fn colour(ink: Ink) -> String {
    let [red, green, blue] = ink.rgb;
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn opacity(of: &str, ink: Ink) -> String {
    match ink.alpha {
        alpha if alpha < 1.0 => format!(" {of}-opacity=\"{}\"", short(alpha)),
        _ => String::new(),
    }
}

fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            // XML has no control characters.
            letter if letter.is_control() => escaped.push(' '),
            letter => escaped.push(letter),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::plot::sheet::TEXT;

    #[test]
    fn words_are_escaped_and_numbers_short() {
        let mut sheet = Sheet::titled(300, 200, "a<b & \"c\"\u{7}", "");
        sheet.line(vec![[1.0, 2.0], [1.0 / 3.0, -0.001]], TEXT.thin(0.5), 1.5);
        let text = svg(&sheet);
        assert!(text.contains(">a&lt;b &amp; \"c\" </text>"), "{text}");
        assert!(text.contains("d=\"M1 2l-0.67-2\""), "{text}");
        assert!(text.contains("stroke-opacity=\"0.5\""), "{text}");
    }

    #[test]
    fn bytes_become_the_letters_of_rfc_4648() {
        for (bytes, letters) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(bytes.as_bytes()), letters);
        }
    }
}
