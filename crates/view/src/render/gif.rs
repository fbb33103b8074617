//! Films as GIF: one set of colours for the whole film, and of each picture only what has changed.

use super::palette::{Counts, Palette};
use super::{Picture, RenderError};
use ::gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};
use std::borrow::Cow;
use std::io::{self, Write};

/// Pictures a second that a GIF has at most: its times are whole hundredths, and viewers take one
/// hundredth for a tenth.
const RATE_MAX: f64 = 50.0;

/// Writes a GIF, picture by picture.
pub struct Gif<W: Write> {
    encoder: Encoder<W>,
    palette: Palette,
    size: [u16; 2],
    rate_hz: f64,
    /// The picture before, as places in the palette.
    shown: Vec<u8>,
    /// The next picture, held back until it is known how long it is seen.
    waiting: Option<(Frame<'static>, u64)>,
    count: u64,
}

impl<W: Write> Gif<W> {
    /// Begins a film that is repeated for ever. `samples`: pictures of it, from which its colours are chosen.
    ///
    /// # Errors
    /// If there are no samples; if there are more than 50 pictures a second; if it cannot be
    /// written.
    pub fn new(out: W, samples: &[Picture], rate_hz: f64) -> Result<Self, RenderError> {
        let Some(first) = samples.first() else {
            return Err(RenderError::Form(
                "a film has one picture or more".to_owned(),
            ));
        };
        if !(rate_hz > 0.0 && rate_hz <= RATE_MAX) {
            return Err(RenderError::Form(format!(
                "{rate_hz} pictures a second: a GIF shows above 0 and at most {RATE_MAX}"
            )));
        }
        let side = |pixels: u32| {
            u16::try_from(pixels).map_err(|_| RenderError::Size([first.width, first.height]))
        };
        let size = [side(first.width)?, side(first.height)?];
        let mut counts = Counts::new();
        samples.iter().for_each(|picture| counts.add(picture));
        // One place is left for what does not change.
        let palette = Palette::new(&counts, 255);
        let colours: Vec<u8> = palette.colours.iter().flatten().copied().collect();
        let mut encoder = Encoder::new(out, size[0], size[1], &colours).map_err(failed)?;
        encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
        Ok(Self {
            encoder,
            palette,
            size,
            rate_hz,
            shown: Vec::new(),
            waiting: None,
            count: 0,
        })
    }

    /// Adds a picture.
    ///
    /// # Errors
    /// If it has another size than the first, or cannot be written.
    pub fn add(&mut self, picture: &Picture) -> Result<(), RenderError> {
        let [width, height] = self.size;
        if [picture.width, picture.height] != [width, height].map(u32::from) {
            return Err(RenderError::Size([picture.width, picture.height]));
        }
        let pixels = picture.rgb.as_chunks::<3>().0;
        let places: Vec<u8> = pixels.iter().map(|rgb| self.palette.place(*rgb)).collect();
        let frame = self.changed(&places);
        self.shown = places;
        let number = self.count;
        self.count += 1;
        // If nothing has changed, the picture before is seen longer.
        if let Some(frame) = frame {
            self.write_waiting(number)?;
            self.waiting = Some((frame, number));
        }
        Ok(())
    }

    /// Ends the film.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn finish(mut self) -> Result<W, RenderError> {
        self.write_waiting(self.count)?;
        self.encoder.into_inner().map_err(failed)
    }

    /// The smallest rectangle that holds all that has changed.
    fn changed(&self, places: &[u8]) -> Option<Frame<'static>> {
        let [width, height] = self.size.map(usize::from);
        let clear = u8::MAX;
        if self.shown.is_empty() {
            return Some(Frame {
                width: self.size[0],
                height: self.size[1],
                buffer: Cow::Owned(places.to_vec()),
                dispose: DisposalMethod::Keep,
                ..Frame::default()
            });
        }
        let differs = |at: usize| places[at] != self.shown[at];
        let row_differs = |y: &usize| (y * width..(y + 1) * width).any(differs);
        let top = (0..height).find(row_differs)?;
        let bottom = (0..height).rev().find(row_differs)?;
        let column_differs = |x: &usize| (top..=bottom).any(|y| differs(y * width + x));
        let left = (0..width).find(column_differs)?;
        let right = (0..width).rev().find(column_differs)?;
        let mut buffer = Vec::with_capacity((right - left + 1) * (bottom - top + 1));
        for y in top..=bottom {
            buffer.extend((left..=right).map(|x| {
                let at = y * width + x;
                if differs(at) { places[at] } else { clear }
            }));
        }
        Some(Frame {
            left: left as u16,
            top: top as u16,
            width: (right - left + 1) as u16,
            height: (bottom - top + 1) as u16,
            transparent: Some(clear),
            dispose: DisposalMethod::Keep,
            buffer: Cow::Owned(buffer),
            ..Frame::default()
        })
    }

    /// Writes the picture that is held back; it is seen until the picture with this number.
    fn write_waiting(&mut self, until: u64) -> Result<(), RenderError> {
        let Some((mut frame, from)) = self.waiting.take() else {
            return Ok(());
        };
        // Hundredths from the start of the film, so that errors do not add up.
        let at = |number: u64| (number as f64 * 100.0 / self.rate_hz).round() as u64;
        frame.delay = u16::try_from(at(until) - at(from)).unwrap_or(u16::MAX);
        self.encoder.write_frame(&frame).map_err(failed)
    }
}

fn failed(error: EncodingError) -> RenderError {
    let source = match error {
        EncodingError::Io(source) => source,
        other => io::Error::other(other),
    };
    RenderError::io(std::path::Path::new("the film"), source)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::gif::{ColorOutput, DecodeOptions};

    fn picture(at: usize) -> Picture {
        let mut rgb = [200, 220, 240].repeat(40 * 30);
        for k in 0..5 {
            let place = 3 * ((10 + k) * 40 + at);
            rgb[place..place + 3].copy_from_slice(&[240, 165, 10]);
        }
        Picture {
            width: 40,
            height: 30,
            rgb,
        }
    }

    #[test]
    fn a_film_reads_back_with_its_pictures_and_times() {
        let pictures: Vec<Picture> = [3, 4, 4, 5, 9].map(picture).to_vec();
        // 30 pictures a second: 3, 4, 3, 3, 4 hundredths; the third picture is the second.
        let mut film = Gif::new(Vec::new(), &pictures, 30.0).expect("begun");
        for picture in &pictures {
            film.add(picture).expect("added");
        }
        let bytes = film.finish().expect("written");

        let mut options = DecodeOptions::new();
        options.set_color_output(ColorOutput::RGBA);
        let mut decoder = options.read_info(bytes.as_slice()).expect("a GIF");
        assert_eq!((decoder.width(), decoder.height()), (40, 30));
        let mut screen = vec![0_u8; 40 * 30 * 4];
        let mut delays = Vec::new();
        let mut shown = Vec::new();
        while let Some(frame) = decoder.read_next_frame().expect("a picture") {
            delays.push(frame.delay);
            let width = usize::from(frame.width);
            for (row, line) in frame.buffer.chunks(4 * width).enumerate() {
                for (column, rgba) in line.chunks(4).enumerate() {
                    if rgba[3] > 0 {
                        let x = usize::from(frame.left) + column;
                        let y = usize::from(frame.top) + row;
                        screen[4 * (40 * y + x)..][..4].copy_from_slice(rgba);
                    }
                }
            }
            shown.push(screen.clone());
        }
        assert_eq!(delays, [3, 7, 3, 4]);
        for (screen, at) in shown.iter().zip([3, 4, 5, 9]) {
            let wanted = picture(at);
            for (seen, own) in screen.chunks(4).zip(wanted.rgb.chunks(3)) {
                let off = (0..3).map(|k| seen[k].abs_diff(own[k])).max();
                assert!(off <= Some(4), "{seen:?} {own:?}");
            }
        }
        // Only what changes is stored.
        assert!(bytes.len() < 2200, "{}", bytes.len());
    }

    #[test]
    fn what_a_gif_cannot_be_says_why() {
        assert!(Gif::new(Vec::new(), &[], 25.0).is_err());
        assert!(Gif::new(Vec::new(), &[picture(0)], 60.0).is_err());
        assert!(Gif::new(Vec::new(), &[picture(0)], f64::NAN).is_err());
    }
}
