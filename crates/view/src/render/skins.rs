//! Pictures on surfaces: the built-in ones and the files of a recording, in halves of halves for what is far away.

use super::paintings::painting;
use simbeeotic_record::Attachment;
use simbeeotic_record::stage::TEXTURES;
use simbeeotic_units::glam::Vec3;
use std::collections::BTreeMap;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// The width of a file's picture on a surface, m.
const FILE_TILE_M: f32 = 2.0;
/// Larger files are not shown; larger pictures are kept smaller, pixels a side.
const FILE_SIDE_MAX: usize = 8192;
const KEPT_SIDE: usize = 2048;

/// The surface of things: a picture that repeats.
pub(super) struct Skin {
    /// The width of one picture on the surface, m.
    tile_m: f32,
    /// The picture, then half of it, and so on down to a single pixel.
    levels: Vec<Level>,
}

struct Level {
    width: usize,
    height: usize,
    rgb: Vec<[u8; 3]>,
}

/// The skins of a stage, by their place.
#[derive(Default)]
pub(super) struct Skins {
    list: Vec<Skin>,
    places: BTreeMap<String, Option<u16>>,
}

impl Skins {
    /// The place of a texture of this name, of which `files` may have the picture; `None` if there is none.
    pub(super) fn place(&mut self, name: &str, files: &[Attachment]) -> Option<u16> {
        if name.is_empty() {
            return None;
        }
        if let Some(known) = self.places.get(name) {
            return *known;
        }
        let built_in = || {
            let (tile_m, pixels) = painting(name)?;
            let rgb = pixels.pixels().iter();
            let rgb = rgb.map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]);
            let (width, height) = (pixels.width() as usize, pixels.height() as usize);
            Skin::new(tile_m, width, height, rgb.collect())
        };
        let file = || {
            let mut files = files.iter();
            let file = files.find(|file| file.name.strip_prefix(TEXTURES) == Some(name))?;
            let (width, height, rgb) = decoded(&file.bytes)?;
            Skin::new(FILE_TILE_M, width, height, rgb)
        };
        let place = built_in().or_else(file).and_then(|skin| {
            let place = u16::try_from(self.list.len()).ok()?;
            self.list.push(skin);
            Some(place)
        });
        self.places.insert(name.to_owned(), place);
        place
    }

    pub(super) fn get(&self, place: Option<u16>) -> Option<&Skin> {
        self.list.get(usize::from(place?))
    }
}

impl Skin {
    fn new(tile_m: f32, width: usize, height: usize, rgb: Vec<[u8; 3]>) -> Option<Self> {
        if width == 0 || height == 0 || rgb.len() != width * height {
            return None;
        }
        let mut levels = vec![Level { width, height, rgb }];
        while let Some(last) = levels.last()
            && last.width.max(last.height) > 1
        {
            levels.push(last.half());
        }
        // What is larger than anybody looks at.
        while levels.len() > 1 && levels[0].width.max(levels[0].height) > KEPT_SIDE {
            levels.remove(0);
        }
        Some(Self { tile_m, levels })
    }

    /// Its colour, 0 to 1, at a place of the surface, m, for a pixel that is so wide there, m.
    pub(super) fn at(&self, [x_m, y_m]: [f32; 2], pixel_m: f32) -> Vec3 {
        let (u, v) = (x_m / self.tile_m, y_m / self.tile_m);
        let whole = &self.levels[0];
        let texels = pixel_m / self.tile_m * whole.width.max(whole.height) as f32;
        let level = halvings(texels).min((self.levels.len() - 1) as f32);
        let (low, share) = (level as usize, level.fract());
        let near = self.levels[low].at(u, v);
        match self.levels.get(low + 1) {
            Some(half) if share > 0.0 => near.lerp(half.at(u, v), share),
            _ => near,
        }
    }
}

/// How often a number has to be halved until it is 1, about: exact for powers of two, straight between them.
fn halvings(value: f32) -> f32 {
    value.max(1.0).to_bits() as f32 / (1 << 23) as f32 - 127.0
}

impl Level {
    /// A picture of half the width and height.
    fn half(&self) -> Self {
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let mut rgb = Vec::with_capacity(width * height);
        for y in 0..height {
            for x in 0..width {
                let column = |k: usize| (2 * x + k).min(self.width - 1);
                let row = |k: usize| (2 * y + k).min(self.height - 1);
                let four = [(0, 0), (0, 1), (1, 0), (1, 1)];
                rgb.push(std::array::from_fn(|part| {
                    let sum = four
                        .map(|(i, j)| u16::from(self.rgb[row(j) * self.width + column(i)][part]));
                    ((sum.iter().sum::<u16>() + 2) / 4) as u8
                }));
            }
        }
        Self { width, height, rgb }
    }

    /// Between its pixels; `u` to the right and `v` upwards, 1 is its width and height.
    fn at(&self, u: f32, v: f32) -> Vec3 {
        let along = |share: f32, side: usize| {
            let at = (share - share.floor()) * side as f32 - 0.5;
            let low = at.floor();
            let place = |k: f32| (k as i64).rem_euclid(side as i64) as usize;
            (place(low), place(low + 1.0), at - low)
        };
        let (left, right, x) = along(u, self.width);
        let (above, below, y) = along(1.0 - (v - v.floor()), self.height);
        let pixel = |column: usize, row: usize| {
            let [r, g, b] = self.rgb[row * self.width + column];
            Vec3::new(f32::from(r), f32::from(g), f32::from(b))
        };
        let upper = pixel(left, above).lerp(pixel(right, above), x);
        let lower = pixel(left, below).lerp(pixel(right, below), x);
        upper.lerp(lower, y) / 255.0
    }
}

/// Width, height and pixels of a PNG or JPEG; `None` if it is neither, damaged or too large.
fn decoded(bytes: &[u8]) -> Option<(usize, usize, Vec<[u8; 3]>)> {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => png(bytes),
        [0xff, 0xd8, ..] => jpeg(bytes),
        _ => None,
    }
}

fn png(bytes: &[u8]) -> Option<(usize, usize, Vec<[u8; 3]>)> {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().ok()?;
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    if width.max(height) > FILE_SIDE_MAX {
        return None;
    }
    let mut data = vec![0; reader.output_buffer_size()?];
    reader.next_frame(&mut data).ok()?;
    let (samples, _) = reader.output_color_type();
    let samples = samples.samples();
    let rgb = data.chunks_exact(samples).map(|pixel| match *pixel {
        [r, g, b, ..] => [r, g, b],
        [grey, ..] => [grey; 3],
        [] => [0; 3],
    });
    Some((width, height, rgb.take(width * height).collect()))
}

fn jpeg(bytes: &[u8]) -> Option<(usize, usize, Vec<[u8; 3]>)> {
    let options = DecoderOptions::default()
        .set_max_width(FILE_SIDE_MAX)
        .set_max_height(FILE_SIDE_MAX)
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    let data = decoder.decode().ok()?;
    let (width, height) = decoder.dimensions()?;
    let (pixels, _) = data.as_chunks::<3>();
    Some((width, height, pixels.to_vec()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two by two pixels: red and green above, blue and white below.
    const FOUR: [[u8; 3]; 4] = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255; 3]];

    fn as_png(rgb: &[[u8; 3]], width: u32) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, rgb.len() as u32 / width);
        encoder.set_color(png::ColorType::Rgb);
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(rgb.as_flattened()).expect("pixels");
        writer.finish().expect("an end");
        bytes
    }

    fn file(name: &str, bytes: Vec<u8>) -> Attachment {
        Attachment {
            name: format!("{TEXTURES}{name}"),
            media_type: String::new(),
            bytes,
        }
    }

    #[test]
    fn a_file_lies_upright_two_metres_wide_and_repeats() {
        let mut skins = Skins::default();
        let files = [file("a.png", as_png(&FOUR, 2))];
        let place = skins.place("a.png", &files);
        let skin = skins.get(place).expect("a skin");
        let seen = |x: f32, y: f32| (skin.at([x, y], 0.01) * 255.0).to_array().map(|c| c as u8);
        assert_eq!(seen(0.5, 1.5), FOUR[0]);
        assert_eq!(seen(1.5, 1.5), FOUR[1]);
        assert_eq!(seen(0.5, 0.5), FOUR[2]);
        assert_eq!(seen(-1.5, -0.5), FOUR[0]);
        // From far away all of it is one colour.
        assert_eq!(seen(0.5, 1.5), FOUR[0]);
        let far = (skin.at([0.5, 1.5], 50.0) * 255.0).to_array();
        assert!(far.iter().all(|c| (c - 127.5).abs() < 1.0), "{far:?}");
    }

    #[test]
    fn what_is_no_picture_is_no_skin() {
        let mut skins = Skins::default();
        let cut = as_png(&FOUR, 2)[..40].to_vec();
        let files = [
            file("cut.png", cut),
            file("text.png", b"no picture".to_vec()),
            file("cut.jpg", vec![0xff, 0xd8, 0xff, 0xe0, 0, 16]),
        ];
        for name in ["cut.png", "text.png", "cut.jpg", "missing.png", ""] {
            assert_eq!(skins.place(name, &files), None, "{name}");
        }
        assert_eq!(skins.place("brick", &files), skins.place("brick", &[]));
    }

    #[test]
    fn a_jpeg_is_read() {
        // 8 x 8 pixels of one colour, baseline.
        let mut skins = Skins::default();
        let files = [file("grey.jpg", JPEG.to_vec())];
        let place = skins.place("grey.jpg", &files);
        let seen = skins.get(place).expect("a skin").at([0.3, 0.7], 0.01) * 255.0;
        let off = seen - Vec3::new(200.0, 60.0, 30.0);
        assert!(off.abs().max_element() < 4.0, "{seen}");
    }

    const JPEG: &[u8] = include_bytes!("testdata/red.jpg");
}
