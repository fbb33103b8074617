//! Heights in a grey PNG picture: black is `min_height`, white is `max_height`.

use super::Grid;
use super::grid::HEIGHTS_MAX;
use png::{BitDepth, ColorType, Decoder, Limits, Transformations};
use std::io::Cursor;

/// A decoder may not ask for more memory than this.
const BYTES_MAX: usize = 1 << 28;

pub(super) fn parse(bytes: &[u8], (low, high): (Option<f64>, Option<f64>)) -> Result<Grid, String> {
    let high = high.ok_or("a picture needs `max_height`: how high is white?")?;
    let low = low.unwrap_or(0.0);
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: BYTES_MAX });
    // One byte, or two, for each pixel.
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(|e| e.to_string())?;
    let (columns, count) = (reader.info().width as usize, reader.info().height as usize);
    if columns.checked_mul(count).is_none_or(|n| n > HEIGHTS_MAX) {
        return Err(format!("it has more than {HEIGHTS_MAX} pixels"));
    }
    if columns < 2 || count < 2 {
        return Err("a grid has two rows of two heights or more".into());
    }
    let (color, depth) = reader.output_color_type();
    let samples = match color {
        ColorType::Grayscale => 1,
        ColorType::GrayscaleAlpha => 2,
        _ => return Err("this picture has colours; heights are shades of grey".into()),
    };
    let size = reader
        .output_buffer_size()
        .ok_or("this picture is too large")?;
    let mut pixels = vec![0; size];
    let info = reader.next_frame(&mut pixels).map_err(|e| e.to_string())?;
    let value = |pixel: &[u8]| match (depth, pixel) {
        (BitDepth::Sixteen, [first, second, ..]) => {
            f64::from(u16::from_be_bytes([*first, *second])) / 65_535.0
        }
        (_, [first, ..]) => f64::from(*first) / 255.0,
        _ => 0.0,
    };
    let width = samples * if depth == BitDepth::Sixteen { 2 } else { 1 };
    let row = |line: &[u8]| {
        let pixels = line.chunks_exact(width).take(columns);
        pixels.map(|p| low + (high - low) * value(p)).collect()
    };
    let rows: Vec<Vec<f64>> = pixels
        .chunks_exact(info.line_size)
        .take(count)
        .map(row)
        .collect();
    Ok(Grid {
        rows,
        length_m: None,
        width_m: None,
    })
}
