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
