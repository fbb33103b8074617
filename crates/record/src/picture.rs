//! Pictures as Foxglove's `RawImage` has them.
//!
//! | pixels | encoding | a pixel |
//! |---|---|---|
//! | grey | `mono8` | a byte |
//! | colour | `rgb8` | three bytes |
//! | depth | `32FC1` | a float, m; infinite where nothing is in range |
//! | labels | `32SC1` | a whole number of four bytes |
//!
//! Numbers are little endian.

use crate::data::Picture;
use crate::message::{RawImage, Timestamp};
use simbeeotic_model::{Image, Pixels};

/// The message of a picture.
pub(crate) fn pack(picture: &Picture) -> RawImage {
    let Image {
        width,
        height,
        ref pixels,
    } = picture.image;
    let (encoding, size, data) = match pixels {
        Pixels::Grey(bytes) => ("mono8", 1, bytes.to_vec()),
        Pixels::Colour(bytes) => ("rgb8", 3, bytes.to_vec()),
        Pixels::Depth(metres) => (
            "32FC1",
            4,
            metres.iter().flat_map(|m| m.to_le_bytes()).collect(),
        ),
        Pixels::Labels(labels) => (
            "32SC1",
            4,
            labels.iter().flat_map(|l| l.to_le_bytes()).collect(),
        ),
        _ => ("", 0, Vec::new()),
    };
    RawImage {
        timestamp: Some(Timestamp::from_ns(picture.time_ns)),
        width,
        height,
        encoding: encoding.to_owned(),
        step: width.saturating_mul(size),
        data,
        frame_id: picture.path.clone(),
    }
}

/// The picture of a message; what is wrong with it if it is none.
pub(crate) fn unpack(time_ns: u64, raw: RawImage) -> Result<Picture, String> {
    let words = || raw.data.as_chunks::<4>();
    let (size, pixels) = match raw.encoding.as_str() {
        "mono8" => (1, Pixels::Grey(raw.data.as_slice().into())),
        "rgb8" => (3, Pixels::Colour(raw.data.as_slice().into())),
        "32FC1" => {
            let metres = words().0.iter().map(|word| f32::from_le_bytes(*word));
            (4, Pixels::Depth(metres.collect()))
        }
        "32SC1" => {
            let labels = words().0.iter().map(|word| u32::from_le_bytes(*word));
            (4, Pixels::Labels(labels.collect()))
        }
        other => return Err(format!("a picture with pixels of {other:?}")),
    };
    let wanted = u64::from(raw.width) * u64::from(raw.height) * size;
    if raw.data.len() as u64 != wanted {
        return Err(format!(
            "a picture of {} x {} with {} bytes, where {wanted} are wanted",
            raw.width,
            raw.height,
            raw.data.len()
        ));
    }
    let image = Image {
        width: raw.width,
        height: raw.height,
        pixels,
    };
    Ok(Picture {
        time_ns,
        path: raw.frame_id,
        image,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(pixels: Pixels) -> Picture {
        let image = Image {
            width: 3,
            height: 2,
            pixels,
        };
        Picture {
            time_ns: 5,
            path: "bee-0/camera".to_owned(),
            image,
        }
    }

    #[test]
    fn every_kind_of_picture_comes_back_as_it_was() {
        let depth = [1.0, 2.5, f32::INFINITY, 0.0, 1e-3, 9.0];
        for pixels in [
            Pixels::Grey((0..6).collect()),
            Pixels::Colour((0..18).collect()),
            Pixels::Depth(depth.into()),
            Pixels::Labels([0, 1, 70_000, u32::MAX, 4, 5].into()),
        ] {
            let picture = picture(pixels);
            assert_eq!(unpack(5, pack(&picture)), Ok(picture));
        }
    }

    #[test]
    fn a_picture_of_another_size_than_it_says_is_an_error() {
        let mut raw = pack(&picture(Pixels::Grey((0..6).collect())));
        raw.height = u32::MAX;
        assert!(
            unpack(5, raw.clone())
                .expect_err("too few bytes")
                .contains("6 bytes")
        );
        raw.encoding = "yuv".to_owned();
        assert!(unpack(5, raw).expect_err("unknown").contains("yuv"));
    }
}
