//! What a camera reads.

use super::paint::Channel;
use simbeeotic_model::units::Length;
use simbeeotic_model::{Column, Image, Pixels, Reading};

/// The pictures that a camera took at one instant: one for each of its channels. Copies share the pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    pub(super) images: Vec<(Channel, Image)>,
}

impl Frame {
    /// The picture of a channel, if the camera has this channel.
    pub fn image(&self, channel: Channel) -> Option<&Image> {
        let mut images = self.images.iter();
        images.find(|(c, _)| *c == channel).map(|(_, image)| image)
    }

    /// Distances along the forward axis, m, row by row; infinite where nothing is seen. Empty if the camera
    /// has no such channel.
    pub fn depth_m(&self) -> &[f32] {
        match self.image(Channel::Depth).map(|image| &image.pixels) {
            Some(Pixels::Depth(metres)) => metres,
            _ => &[],
        }
    }

    /// Distances along the rays, as [`depth_m`](Self::depth_m).
    pub fn range_m(&self) -> &[f32] {
        match self.image(Channel::Range).map(|image| &image.pixels) {
            Some(Pixels::Depth(metres)) => metres,
            _ => &[],
        }
    }

    /// Who is seen, row by row: [`Scene::label_of`](simbeeotic_model::Scene::label_of), 0 for nothing. Empty
    /// if the camera has no such channel.
    pub fn labels(&self) -> &[u32] {
        match self.image(Channel::Labels).map(|image| &image.pixels) {
            Some(Pixels::Labels(labels)) => labels,
            _ => &[],
        }
    }

    /// How near the nearest is that is seen, by the channel `depth` or else `range`; `None` if nothing is, or
    /// if it has neither.
    pub fn nearest(&self) -> Option<Length> {
        let metres = match self.depth_m() {
            [] => self.range_m(),
            depths => depths,
        };
        let least = metres.iter().copied().fold(f32::INFINITY, f32::min);
        least.is_finite().then(|| Length::si(f64::from(least)))
    }
}

/// The pictures, and [`Frame::nearest`].
impl Reading for Frame {
    const COLUMNS: &'static [Column] = &[Column::new("nearest", "m")];

    fn numbers(&self, to: &mut Vec<f64>) {
        to.push(self.nearest().map_or(f64::NAN, Length::get));
    }

    fn images(&self) -> Vec<(&'static str, &Image)> {
        let images = self.images.iter();
        images.map(|(c, image)| (c.name(), image)).collect()
    }
}
