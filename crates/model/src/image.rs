//! Pictures that cameras take.

use std::sync::Arc;

/// A picture: rows from top to bottom, pixels of a row from left to right. Copies share the pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// What each pixel holds.
    pub pixels: Pixels,
}

/// What the pixels of an [`Image`] hold.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Pixels {
    /// Brightness: 0 is black, 255 white.
    Grey(Arc<[u8]>),
    /// Red, green, blue: three bytes a pixel.
    Colour(Arc<[u8]>),
    /// Distances in metres; infinite where nothing is in range.
    Depth(Arc<[f32]>),
    /// Who is seen: a number for each thing, 0 for nothing.
    Labels(Arc<[u32]>),
}

/// A picture that is none.
#[derive(Debug, thiserror::Error)]
#[error("no picture of {width} x {height} pixels: {source}")]
pub struct ImageError {
    width: u32,
    height: u32,
    source: png::EncodingError,
}

impl Image {
    /// The picture as a PNG file.
    ///
    /// | pixels | PNG |
    /// |---|---|
    /// | grey | 8 bits |
    /// | colour | 8 bits each of red, green, blue |
    /// | depth | 16 bits, in millimetres; 0 where nothing is in range, or beyond 65.535 m |
    /// | labels | 8 bits each of red, green, blue: a colour for each label, black for nothing |
    ///
    /// # Errors
    /// No pixels, or not as many as width times height.
    pub fn to_png(&self) -> Result<Vec<u8>, ImageError> {
        use png::{BitDepth, ColorType};
        let (color, depth, bytes): (_, _, Vec<u8>) = match &self.pixels {
            Pixels::Grey(bytes) => (ColorType::Grayscale, BitDepth::Eight, bytes.to_vec()),
            Pixels::Colour(bytes) => (ColorType::Rgb, BitDepth::Eight, bytes.to_vec()),
            Pixels::Depth(metres) => {
                let millimetres = metres.iter().flat_map(|m| millimetres(*m).to_be_bytes());
                let bytes = millimetres.collect();
                (ColorType::Grayscale, BitDepth::Sixteen, bytes)
            }
            Pixels::Labels(labels) => {
                let bytes = labels.iter().flat_map(|label| label_colour(*label));
                (ColorType::Rgb, BitDepth::Eight, bytes.collect())
            }
        };
        let mut file = Vec::new();
        let mut encode = || {
            let mut encoder = png::Encoder::new(&mut file, self.width, self.height);
            encoder.set_color(color);
            encoder.set_depth(depth);
            encoder.set_compression(png::Compression::High);
            let mut writer = encoder.write_header()?;
            writer.write_image_data(&bytes)?;
            writer.finish()
        };
        match encode() {
            Ok(()) => Ok(file),
            Err(source) => Err(ImageError {
                width: self.width,
                height: self.height,
                source,
            }),
        }
    }
}

/// A depth in whole millimetres, 0 if it is none that 16 bits can hold.
fn millimetres(metres: f32) -> u16 {
    let rounded = (f64::from(metres) * 1e3).round();
    if rounded >= 0.0 && rounded <= f64::from(u16::MAX) {
        rounded as u16
    } else {
        0
    }
}

/// A colour for each label, bright enough to be told from black, which is for none.
fn label_colour(label: u32) -> [u8; 3] {
    if label == 0 {
        return [0; 3];
    }
    // Fibonacci hashing: neighbours in number are far apart in colour.
    let mixed = u64::from(label)
        .wrapping_mul(0x9e37_79b9_7f4a_7c15)
        .to_be_bytes();
    [mixed[0], mixed[1], mixed[2]].map(|byte| 64 + byte / 4 * 3)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a PNG file holds.
    fn decoded(image: &Image) -> (png::ColorType, Vec<u8>) {
        let file = image.to_png().expect("a picture");
        let mut reader = png::Decoder::new(std::io::Cursor::new(&file))
            .read_info()
            .expect("a file");
        let mut bytes = vec![0; reader.output_buffer_size().expect("its size")];
        let info = reader.next_frame(&mut bytes).expect("pixels");
        assert_eq!((info.width, info.height), (image.width, image.height));
        bytes.truncate(info.buffer_size());
        (info.color_type, bytes)
    }

    fn image(pixels: Pixels) -> Image {
        Image {
            width: 2,
            height: 2,
            pixels,
        }
    }

    #[test]
    fn a_png_holds_the_pixels() {
        let grey = image(Pixels::Grey([0, 1, 200, 255].into()));
        assert_eq!(
            decoded(&grey),
            (png::ColorType::Grayscale, vec![0, 1, 200, 255])
        );
        let bytes: Vec<u8> = (0..12).collect();
        let colour = image(Pixels::Colour(bytes.clone().into()));
        assert_eq!(decoded(&colour), (png::ColorType::Rgb, bytes));
    }

    #[test]
    fn depth_is_in_millimetres_and_nothing_is_0() {
        let metres = [1.2345, f32::INFINITY, 65.535, 70.0];
        let depth = image(Pixels::Depth(metres.into()));
        let words = [1235_u16, 0, 65_535, 0].map(u16::to_be_bytes).concat();
        assert_eq!(decoded(&depth), (png::ColorType::Grayscale, words));
    }

    #[test]
    fn each_label_has_its_colour() {
        let labels = image(Pixels::Labels([0, 1, 2, 1].into()));
        let (_, bytes) = decoded(&labels);
        assert_eq!(bytes[..3], [0; 3]);
        assert_ne!(bytes[3..6], bytes[6..9]);
        assert_eq!(bytes[3..6], bytes[9..12]);
    }

    #[test]
    fn a_picture_without_pixels_is_none() {
        for (width, count) in [(0, 0), (2, 3), (2, 5)] {
            let image = Image {
                width,
                height: 2,
                pixels: Pixels::Grey(vec![0; count].into()),
            };
            assert!(image.to_png().is_err(), "{width} {count}");
        }
    }
}
