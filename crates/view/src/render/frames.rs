//! Pictures as files: one PNG, or many with a number each.

use super::{Picture, RenderError};
use simbeeotic_record::publish;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A picture as the bytes of a PNG file.
///
/// # Errors
/// Never for a picture whose bytes fit its size.
pub fn png_bytes(picture: &Picture) -> io::Result<Vec<u8>> {
    packed(picture, png::Compression::Balanced)
}

fn packed(picture: &Picture, compression: png::Compression) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.width, picture.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(compression);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&picture.rgb)?;
    writer.finish()?;
    Ok(bytes)
}

/// Writes a picture as PNG; the file appears whole or not at all.
///
/// # Errors
/// Those of the file system.
pub fn write_png(path: &Path, picture: &Picture) -> Result<(), RenderError> {
    write(path, png_bytes(picture))
}

fn write(path: &Path, bytes: io::Result<Vec<u8>>) -> Result<(), RenderError> {
    let written = bytes.and_then(|bytes| {
        publish(path, |mut file| -> io::Result<()> {
            file.write_all(&bytes)
        })
    });
    written.map_err(|source| RenderError::io(path, source))
}

/// A film as single pictures: `frames/%05d.png`.
#[derive(Debug)]
pub struct Frames {
    before: String,
    digits: usize,
    after: String,
    count: u64,
}

impl Frames {
    /// A pattern with one `%d` or `%05d` in its file name.
    ///
    /// # Errors
    /// If the pattern has no place for the number, or its folder is not there.
    pub fn new(pattern: &Path) -> Result<Self, RenderError> {
        let wrong = || {
            RenderError::Form(format!(
                "{}: pictures of a film are numbered, so their name has one %d, or %05d for five digits",
                pattern.display()
            ))
        };
        let text = pattern.to_str().ok_or_else(wrong)?;
        let name_at = text.rfind(['/', '\\']).map_or(0, |at| at + 1);
        let (folder, name) = text.split_at(name_at);
        let (before, rest) = name.split_once('%').ok_or_else(wrong)?;
        let (digits, after) = rest.split_once('d').ok_or_else(wrong)?;
        let digits: usize = match digits {
            "" => 1,
            digits => digits.parse().map_err(|_| wrong())?,
        };
        if digits > 12 || after.contains('%') || folder.contains('%') {
            return Err(wrong());
        }
        if !folder.is_empty() && !Path::new(folder).is_dir() {
            return Err(RenderError::Form(format!(
                "{}: there is no folder {folder}; make it first",
                pattern.display()
            )));
        }
        Ok(Self {
            before: format!("{folder}{before}"),
            digits,
            after: after.to_owned(),
            count: 0,
        })
    }

    /// Writes the next picture, packed quickly: to make it small would take several times as long as to draw it.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn add(&mut self, picture: &Picture) -> Result<(), RenderError> {
        let bytes = packed(picture, png::Compression::Fast);
        write(&self.path(self.count), bytes)?;
        self.count += 1;
        Ok(())
    }

    /// The file of a picture, counted from 0.
    pub fn path(&self, number: u64) -> PathBuf {
        let Self {
            before,
            digits,
            after,
            ..
        } = self;
        PathBuf::from(format!("{before}{number:0digits$}{after}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_png_reads_as_the_picture_it_was() {
        let picture = Picture {
            width: 3,
            height: 2,
            rgb: (0..18).map(|k| k * 14).collect(),
        };
        let bytes = png_bytes(&picture).expect("written");
        let mut reader = png::Decoder::new(io::Cursor::new(bytes))
            .read_info()
            .expect("a PNG");
        let mut rgb = vec![0; 18];
        let info = reader.next_frame(&mut rgb).expect("a picture");
        assert_eq!((info.width, info.height), (3, 2));
        assert_eq!(rgb, picture.rgb);
    }

    #[test]
    fn pictures_are_numbered_as_their_pattern_says() {
        let folder = tempfile::tempdir().expect("a folder");
        let frames = |name: &str| Frames::new(&folder.path().join(name));
        let error = frames("a/%05d.png").expect_err("there is no folder");
        assert!(error.to_string().contains("no folder"), "{error}");
        std::fs::create_dir(folder.path().join("a")).expect("a folder");
        let made = frames("a/%05d.png").expect("a pattern");
        assert_eq!(made.path(7), folder.path().join("a/00007.png"));
        let plain = frames("x%d.png").expect("a pattern");
        assert_eq!(plain.path(123), folder.path().join("x123.png"));
        for wrong in ["x.png", "%5.png", "%d%d.png", "%99d.png", "%-3d.png"] {
            assert!(frames(wrong).is_err(), "{wrong}");
        }
    }
}
