//! A picture as SVG.

use super::sheet::{Anchor, Ink, Shape, Sheet};
use std::fmt::Write as _;

/// The file's text.
pub(super) fn svg(sheet: &Sheet) -> String {
    let (width, height) = (sheet.width, sheet.height);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"'DejaVu Sans', Verdana, Arial, sans-serif\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    for shape in &sheet.shapes {
        draw(&mut text, shape);
    }
    text.push_str("</svg>\n");
    text
}

/// Appends one thing. Writing to a text cannot fail.
fn draw(out: &mut String, shape: &Shape) {
    let _ = match shape {
        Shape::Line { points, ink, width } => writeln!(
            out,
            "<path d=\"{}\" fill=\"none\" stroke=\"{}\"{} stroke-width=\"{}\" stroke-linejoin=\"round\"/>",
            path(points),
            colour(*ink),
            opacity("stroke", *ink),
            short(*width)
        ),
        Shape::Area { points, ink } => writeln!(
            out,
            "<path d=\"{}z\" fill=\"{}\"{}/>",
            path(points),
            colour(*ink),
            opacity("fill", *ink)
        ),
        Shape::Disc {
            centre: [x, y],
            radius,
            ink,
            rim,
        } => {
            let rim = match *rim > 0.0 {
                true => format!(" stroke=\"#ffffff\" stroke-width=\"{}\"", short(*rim)),
                false => String::new(),
            };
            writeln!(
                out,
                "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"{}{rim}/>",
                short(*x),
                short(*y),
                short(*radius),
                colour(*ink),
                opacity("fill", *ink)
            )
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
            let anchor = match anchor {
                Anchor::Start => "",
                Anchor::Middle => " text-anchor=\"middle\"",
                Anchor::End => " text-anchor=\"end\"",
            };
            let (x, y) = (short(*x), short(*y));
            let turn = match upwards {
                true => format!(" transform=\"rotate(-90 {x} {y})\""),
                false => String::new(),
            };
            let rim = match halo {
                true => {
                    " stroke=\"#ffffff\" stroke-width=\"3.5\" stroke-linejoin=\"round\" paint-order=\"stroke\""
                }
                false => "",
            };
            writeln!(
                out,
                "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\" fill=\"{}\"{anchor}{turn}{rim}>{}</text>",
                short(*size),
                colour(*ink),
                escaped(text)
            )
        }
    };
}

fn path(points: &[[f64; 2]]) -> String {
    let mut path = String::new();
    for (at, [x, y]) in points.iter().enumerate() {
        let letter = if at == 0 { 'M' } else { 'L' };
        let _ = write!(path, "{letter}{} {}", short(*x), short(*y));
    }
    path
}

/// Hundredths of a pixel are enough.
fn short(number: f64) -> f64 {
    (number * 100.0).round() / 100.0 + 0.0
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
        assert!(text.contains("d=\"M1 2L0.33 0\""), "{text}");
        assert!(text.contains("stroke-opacity=\"0.5\""), "{text}");
    }
}
