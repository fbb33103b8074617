//! A camera: depth, labels, grey and colour, by casting rays.
//!
//! [`lens`]: which way each pixel looks; [`paint`]: what it sees; [`frame`]: what a behaviour reads; here:
//! parameters and noise. The reading of depth `z` is
//!
//! ```text
//! z' = z + (a + b z^2) n            n in N(0, 1), new for each pixel            (1)
//! z' = step round(z' / step)                                                    (2)
//! ```
//! A stereo camera of baseline `B` and focal length `f` (pixels) that matches to `m` of a pixel has
//! `b = m / (f B)`. Ranges along rays are treated the same way, with the range for `z`.

pub mod frame;
pub mod lens;
pub mod paint;
#[cfg(test)]
mod tests;

pub use frame::Frame;
pub use lens::{Distortion, Lens, Optics};
pub use paint::{Channel, Light, Painter};

use simbeeotic_model::check::{at_least_zero, in_range, positive};
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Angle, Current, Length, math};
use simbeeotic_model::{
    Beams, BuildError, Image, Pixels, SeesWhat, Sensor, Truth, choice, params, sensor,
};

/// A device whose figures hold for what a scenario does not say.
///
/// | device | pixels | field of view | depths | noise of depth | current |
/// |---|---|---|---|---|---|
/// | `plain` | 160 x 120 | 90 deg | 1 cm to 100 m | none | |
/// | `realsense-d435` | 424 x 240 | 87 deg | 0.105 m to 10 m | 0.00716/m z², steps of 1 mm | 700 mA |
/// | `vl53l5cx` | 8 x 8, 16 rays in each | 45 deg | 2 cm to 4 m | 5 mm + 0.007/m z², steps of 1 mm | 95 mA |
///
/// D435: Intel RealSense D400 series data sheet, 337029 (field of view, least depth at this resolution);
/// the noise is that of A. Grunnet-Jepsen et al., *Tuning depth cameras for best performance*: a match to
/// 0.08 pixels, a baseline of 50 mm. VL53L5CX: STMicroelectronics DS13754 (63 deg across the diagonal, an
/// accuracy of 15 mm near and of some 5 % far, both taken as three sigma; the zone reads the nearest of
/// what is in it). Neither data sheet was at hand: the figures are as drivers and papers quote them.
#[choice]
pub enum CameraDevice {
    /// No device: round numbers, no noise.
    Plain,
    /// Intel RealSense D435, its depth.
    RealsenseD435,
    /// STMicroelectronics VL53L5CX, a time-of-flight sensor of 64 zones.
    Vl53l5cx,
}

/// The figures of a device.
struct Sheet {
    width: u32,
    height: u32,
    samples: u32,
    field_of_view: Angle,
    near: Length,
    far: Length,
    depth_sigma: Length,
    depth_growth: f64,
    depth_step: Length,
    current: Current,
}

impl CameraDevice {
    fn sheet(self) -> Sheet {
        let plain = Sheet {
            width: 160,
            height: 120,
            samples: 1,
            field_of_view: Angle::from_degrees(90.0),
            near: Length::si(0.01),
            far: Length::si(100.0),
            depth_sigma: Length::ZERO,
            depth_growth: 0.0,
            depth_step: Length::ZERO,
            current: Current::ZERO,
        };
        match self {
            Self::Plain => plain,
            Self::RealsenseD435 => {
                let (_, focal_px) = focal(424, Angle::from_degrees(87.0));
                Sheet {
                    width: 424,
                    height: 240,
                    field_of_view: Angle::from_degrees(87.0),
                    near: Length::si(0.105),
                    far: Length::si(10.0),
                    depth_growth: 0.08 / (focal_px * 0.05),
                    depth_step: Length::si(1e-3),
                    current: Current::si(0.7),
                    ..plain
                }
            }
            Self::Vl53l5cx => Sheet {
                width: 8,
                height: 8,
                samples: 4,
                field_of_view: Angle::from_degrees(45.0),
                near: Length::si(0.02),
                far: Length::si(4.0),
                depth_sigma: Length::si(5e-3),
                depth_growth: 7e-3,
                depth_step: Length::si(1e-3),
                current: Current::si(0.095),
            },
        }
    }
}

/// The tangent of half a field of view, and the focal length that shows it.
fn focal(width: u32, field_of_view: Angle) -> (f64, f64) {
    let (sin, cos) = math::sin_cos(0.5 * field_of_view.get());
    (sin / cos, 0.5 * f64::from(width) * cos / sin)
}

/// Takes pictures along its own forward axis: depth, range, labels, grey, colour, normals.
///
/// A pixel sees what a ray through its middle meets first, or several rays, of which distances and labels
/// take the nearest and colours the mean. Frames and formulas are in the modules `lens`, `paint` and
/// `camera`: rows count down, columns to the right; a depth is along the forward axis, a range along the
/// pixel's ray. What is nearer than `near` or farther than `far` is not seen: its distance is infinite,
/// its label 0, its colour that of the sky. The host itself is not seen.
#[sensor("camera")]
pub struct Camera {
    painter: Painter,
    channels: Vec<Channel>,
    depth_sigma_m: f64,
    depth_growth: f64,
    depth_step_m: f64,
    depth_dropout: f64,
    noise: f64,
    current: Current,
}

/// Parameters of [`Camera`].
#[params]
pub struct CameraParams {
    /// The device whose figures hold for what is not said here: `plain`, `realsense-d435`, `vl53l5cx`.
    pub preset: CameraDevice,
    /// Pixels in a row, 1 to 4096.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<u32>,
    /// Rows, 1 to 4096.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height: Option<u32>,
    /// Rays along each side of a pixel, 1 to 8.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples: Option<u32>,
    /// What the width of the picture shows, more than 0 and up to 170 degrees; pixels are square.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub field_of_view: Option<Angle>,
    /// The focal length in pixels, instead of the field of view. Above 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub focal_length_px: Option<f64>,
    /// Where the forward axis falls, in pixels from the left and from the top; the middle if left out. OpenCV
    /// counts from the first pixel's middle: 0.5 less.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub principal_point_px: Option<[f64; 2]>,
    /// How the lens bends straight lines (Brown and Conrady).
    pub distortion: Distortion,
    /// What is nearer, along the forward axis, is not seen. 0 or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub near: Option<Length>,
    /// What is farther, along the forward axis, is not seen. More than `near`, up to 100 km.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub far: Option<Length>,
    /// The pictures that it takes, each once: `depth`, `range`, `labels`, `grey`, `colour`, `normals`.
    pub channels: Vec<Channel>,
    /// What it sees; it looks through the rest.
    pub sees: SeesWhat,
    /// Standard deviation of a distance, however near. 0 or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depth_sigma: Option<Length>,
    /// What is added to the standard deviation with the square of the distance, 1/m. 0 or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depth_growth: Option<f64>,
    /// Distances are multiples of this; 0: they are not. 0 or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depth_step: Option<Length>,
    /// The share of pixels, drawn anew each time, that have no distance. 0 to 1.
    pub depth_dropout: f64,
    /// Standard deviation of grey and colour, where 1 is from black to white; each colour by itself. 0 or
    /// more.
    pub noise: f64,
    /// Factor on all light. Above 0.
    pub exposure: f64,
    /// How the scene is lit. It does not depend on the weather's light.
    pub light: Light,
    /// The edge of the squares that the ground is drawn with; 0: it is plain.
    pub chequer: Length,
}

impl Default for CameraParams {
    fn default() -> Self {
        Self {
            preset: CameraDevice::Plain,
            width: None,
            height: None,
            samples: None,
            field_of_view: None,
            focal_length_px: None,
            principal_point_px: None,
            distortion: Distortion::default(),
            near: None,
            far: None,
            channels: vec![Channel::Depth],
            sees: SeesWhat::EVERYTHING,
            depth_sigma: None,
            depth_growth: None,
            depth_step: None,
            depth_dropout: 0.0,
            noise: 0.0,
            exposure: 1.0,
            light: Light::default(),
            chequer: Length::si(1.0),
        }
    }
}

/// The greatest number of pixels along one side.
const SIDE_MAX: u32 = 4096;
/// The greatest number of rays of one picture.
const RAYS_MAX: u64 = 1 << 24;

impl CameraParams {
    fn lens(&self, sheet: &Sheet) -> Result<std::sync::Arc<Lens>, BuildError> {
        let width = self.width.unwrap_or(sheet.width);
        let height = self.height.unwrap_or(sheet.height);
        let samples = self.samples.unwrap_or(sheet.samples);
        in_range("width", width, 1..=SIDE_MAX)?;
        in_range("height", height, 1..=SIDE_MAX)?;
        in_range("samples", samples, 1..=8)?;
        let rays = u64::from(width) * u64::from(height) * u64::from(samples * samples);
        if rays > RAYS_MAX {
            let message = format!("makes {rays} rays of one picture; {RAYS_MAX} are the most");
            return Err(BuildError::parameter("width", message));
        }
        let focal_px = match (self.focal_length_px, self.field_of_view) {
            (Some(_), Some(_)) => {
                let message = "cannot be said together with field_of_view";
                return Err(BuildError::parameter("focal_length_px", message));
            }
            (Some(focal), None) => {
                in_range("focal_length_px", focal, 1e-3..=1e9)?;
                focal
            }
            (None, view) => {
                let view = view.unwrap_or(sheet.field_of_view);
                let widest = Angle::from_degrees(170.0);
                in_range("field_of_view", view, Angle::from_degrees(1e-3)..=widest)?;
                focal(width, view).1
            }
        };
        let middle = [0.5 * f64::from(width), 0.5 * f64::from(height)];
        let principal_px = self.principal_point_px.unwrap_or(middle);
        for at in principal_px {
            in_range("principal_point_px", at, -1e6..=1e6)?;
        }
        let Distortion { k1, k2, k3, p1, p2 } = self.distortion;
        for coefficient in [k1, k2, k3, p1, p2] {
            in_range("distortion", coefficient, -1e6..=1e6)?;
        }
        let optics = Optics {
            width,
            height,
            samples,
            focal_px,
            principal_px,
            distortion: self.distortion,
        };
        Lens::new(optics).ok_or_else(|| {
            let message = "folds the picture over itself within its corners: a smaller k1, or a \
                           longer focal length, does not";
            BuildError::parameter("distortion", message)
        })
    }
}

impl Light {
    fn check(&self) -> Result<(), BuildError> {
        let within = |error| BuildError::parameter("light", format!("is wrong: {error}"));
        let turn = Angle::from_degrees(360.0);
        in_range("heading", self.heading, -turn..=turn).map_err(within)?;
        let right = Angle::from_degrees(90.0);
        in_range("elevation", self.elevation, Angle::ZERO..=right).map_err(within)?;
        in_range("sun", self.sun, 0.0..=1e6).map_err(within)?;
        in_range("ambient", self.ambient, 0.0..=1e6).map_err(within)
    }
}

impl Sensor for Camera {
    type Params = CameraParams;
    type Reading = Frame;

    fn build(params: CameraParams) -> Result<Self, BuildError> {
        let sheet = params.preset.sheet();
        let lens = params.lens(&sheet)?;
        let near = params.near.unwrap_or(sheet.near);
        let far = params.far.unwrap_or(sheet.far);
        at_least_zero("near", near)?;
        in_range("far", far, Length::ZERO..=Length::si(1e5))?;
        if far <= near {
            let message = format!("must be more than near, {near}, and is {far}");
            return Err(BuildError::parameter("far", message));
        }
        if params.channels.is_empty() {
            let message = "is empty: a camera takes at least one picture";
            return Err(BuildError::parameter("channels", message));
        }
        for (at, channel) in params.channels.iter().enumerate() {
            if params.channels[..at].contains(channel) {
                let message = format!("has `{}` twice", channel.name());
                return Err(BuildError::parameter("channels", message));
            }
        }
        let depth_sigma = params.depth_sigma.unwrap_or(sheet.depth_sigma);
        let depth_growth = params.depth_growth.unwrap_or(sheet.depth_growth);
        let depth_step = params.depth_step.unwrap_or(sheet.depth_step);
        in_range("depth_sigma", depth_sigma, Length::ZERO..=Length::si(1e5))?;
        in_range("depth_growth", depth_growth, 0.0..=1e5)?;
        in_range("depth_step", depth_step, Length::ZERO..=Length::si(1e5))?;
        in_range("depth_dropout", params.depth_dropout, 0.0..=1.0)?;
        in_range("noise", params.noise, 0.0..=1e3)?;
        positive("exposure", params.exposure)?;
        in_range("exposure", params.exposure, 0.0..=1e9)?;
        in_range("chequer", params.chequer, Length::ZERO..=Length::si(1e6))?;
        params.light.check()?;
        Ok(Self {
            painter: Painter {
                lens,
                near_m: near.get(),
                far_m: far.get(),
                sees: params.sees,
                light: params.light,
                exposure: params.exposure,
                chequer: params.chequer,
            },
            channels: params.channels,
            depth_sigma_m: depth_sigma.get(),
            depth_growth,
            depth_step_m: depth_step.get(),
            depth_dropout: params.depth_dropout,
            noise: params.noise,
            current: sheet.current,
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Frame {
        let images = self
            .painter
            .take(&truth.scene(), truth.sensor_pose(), &self.channels)
            // A camera that is farther than 1e9 m from everything.
            .unwrap_or_default();
        Frame {
            images: self.channels.iter().copied().zip(images).collect(),
        }
    }

    fn measure(&mut self, ideal: Frame, _truth: &Truth<'_>, rng: &mut Stream) -> Frame {
        let metres_of = |images: &[(Channel, Image)], wanted: Channel| {
            images
                .iter()
                .find_map(|(channel, image)| match &image.pixels {
                    Pixels::Depth(metres) if *channel == wanted => Some(metres.clone()),
                    _ => None,
                })
        };
        let clean_z = metres_of(&ideal.images, Channel::Depth);
        let clean_r = metres_of(&ideal.images, Channel::Range);
        let images = ideal.images.into_iter();
        let mut images: Vec<(Channel, Image)> = images
            .map(|(channel, image)| match channel {
                // It errs as the depth beside it does.
                Channel::Range if clean_z.is_some() => (channel, image),
                _ => (channel, self.noisy(channel, image, rng)),
            })
            .collect();
        if self.errs()
            && let (Some(z), Some(r)) = (clean_z, clean_r)
            && let Some(read) = metres_of(&images, Channel::Depth)
        {
            let ranges = read.iter().zip(z.iter().zip(r.iter()));
            let ranges = ranges.map(|(read, (z, r))| match read.is_finite() && *z > 0.0 {
                true => r * (read / z),
                false => *read,
            });
            let ranges = Pixels::Depth(ranges.collect());
            for (_, image) in images.iter_mut().filter(|(c, _)| *c == Channel::Range) {
                image.pixels = ranges.clone();
            }
        }
        Frame { images }
    }

    fn current(&self) -> Current {
        self.current
    }

    fn beams(&self) -> Option<Beams> {
        let optics = self.painter.lens.optics();
        let view = |pixels: u32| {
            let half = 0.5 * f64::from(pixels) / optics.focal_px;
            Angle::si(2.0 * math::atan2(half, 1.0))
        };
        Some(Beams::window(
            view(optics.width),
            view(optics.height),
            Length::si(self.painter.far_m),
        ))
    }
}

impl Camera {
    fn noisy(&self, channel: Channel, image: Image, rng: &mut Stream) -> Image {
        let pixels = match image.pixels {
            Pixels::Depth(metres) if self.errs() => {
                let metres = metres.iter().map(|z| self.measured(f64::from(*z), rng));
                Pixels::Depth(metres.collect())
            }
            Pixels::Grey(bytes) if self.noise > 0.0 => {
                Pixels::Grey(bytes.iter().map(|b| self.grained(*b, rng)).collect())
            }
            Pixels::Colour(bytes) if self.noise > 0.0 && channel == Channel::Colour => {
                Pixels::Colour(bytes.iter().map(|b| self.grained(*b, rng)).collect())
            }
            clean => clean,
        };
        Image { pixels, ..image }
    }

    fn errs(&self) -> bool {
        let sums = self.depth_sigma_m + self.depth_growth + self.depth_step_m + self.depth_dropout;
        sums > 0.0
    }

    /// Equations 1 and 2. What is not seen stays so.
    fn measured(&self, z: f64, rng: &mut Stream) -> f32 {
        if !z.is_finite() || (self.depth_dropout > 0.0 && rng.bernoulli(self.depth_dropout)) {
            return f32::INFINITY;
        }
        let sigma = self.depth_sigma_m + self.depth_growth * z * z;
        let noise = if sigma > 0.0 {
            sigma * rng.normal()
        } else {
            0.0
        };
        let read = (z + noise).clamp(0.0, self.painter.far_m.max(z));
        let step = self.depth_step_m;
        if step > 0.0 {
            (step * (read / step).round()) as f32
        } else {
            read as f32
        }
    }

    fn grained(&self, byte: u8, rng: &mut Stream) -> u8 {
        let read = f64::from(byte) + 255.0 * self.noise * rng.normal();
        read.round().clamp(0.0, 255.0) as u8
    }
}
