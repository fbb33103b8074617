//! What a camera sees: pictures from rays.
//!
//! The radiance of a surface of albedo `A` (the linear value of its sRGB colour) with the normal `n` is
//!
//! ```text
//! L = E A (a (3 + n.up) / 4 + s V max(0, n.l))                                   (1)
//! ```
//! with the exposure `E`, the ambient light `a` (a sky that is brighter than the ground: level surfaces
//! get all of it, those that look down half), and the sun `s` in the direction `l` (Lambert); `V` is 0 in
//! the shadow, if shadows are cast. It is cut at 1, encoded as sRGB (IEC 61966-2-1) and rounded to 8
//! bits. The sky fades from its colour at the horizon to that above. There is no second reflection, no
//! gloss, no blur by motion, and clear colours are drawn as solid ones.

use super::lens::Lens;
use glam::DVec3;
use simbeeotic_model::physics::{BodyError, Fan, Hit, Kind, Ray};
use simbeeotic_model::units::{Angle, Length, Pose, math};
use simbeeotic_model::world::Color;
use simbeeotic_model::{Image, Pixels, Scene, SeesWhat, choice, params};
use std::sync::LazyLock;

/// What a camera can take.
#[choice]
#[derive(PartialOrd, Ord)]
pub enum Channel {
    /// Distance along the forward axis, m.
    Depth,
    /// Distance along each pixel's ray, m.
    Range,
    /// Who is seen: [`Scene::label_of`].
    Labels,
    /// Brightness.
    Grey,
    /// Red, green and blue.
    Colour,
    /// Outward normals in the camera's frame: red is forward, green left, blue up; -1 is 0, 1 is 255.
    Normals,
}

impl Channel {
    /// Its name, as in scenarios.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Depth => "depth",
            Self::Range => "range",
            Self::Labels => "labels",
            Self::Grey => "grey",
            Self::Colour => "colour",
            Self::Normals => "normals",
        }
    }
}

/// How a scene is lit.
#[params]
#[derive(Copy)]
pub struct Light {
    /// Where the sun stands, clockwise from north.
    pub heading: Angle,
    /// How high the sun stands, 0 to 90 degrees.
    pub elevation: Angle,
    /// The sun's light on a surface that faces it, where 1 is white. 0 or more.
    pub sun: f64,
    /// The sky's light on a level surface, where 1 is white. 0 or more.
    pub ambient: f64,
    /// Whether things cast shadows: one more ray for each pixel that the sun may shine on.
    pub shadows: bool,
    /// The colour of the sky above.
    pub sky: Color,
    /// Its colour at the horizon.
    pub horizon: Color,
}

impl Default for Light {
    fn default() -> Self {
        Self {
            heading: Angle::from_degrees(150.0),
            elevation: Angle::from_degrees(50.0),
            sun: 0.75,
            ambient: 0.45,
            shadows: false,
            sky: Color::rgb(92, 148, 214),
            horizon: Color::rgb(206, 222, 236),
        }
    }
}

impl Light {
    /// Towards the sun, ENU, of unit length.
    fn sun_direction(&self) -> DVec3 {
        let (sin, cos) = math::sin_cos(self.heading.get());
        let (up, level) = math::sin_cos(self.elevation.get());
        DVec3::new(sin * level, cos * level, up)
    }
}

/// The linear value of each byte of an sRGB colour.
static LINEAR: LazyLock<[f64; 256]> = LazyLock::new(|| {
    let mut table = [0.0; 256];
    for (byte, value) in table.iter_mut().enumerate() {
        let s = byte as f64 / 255.0;
        *value = if s <= 0.040_45 {
            s / 12.92
        } else {
            math::pow((s + 0.055) / 1.055, 2.4)
        };
    }
    table
});

/// The byte of each linear value, in steps of 1/4096: rounded as if by the formula, to within one.
static ENCODED: LazyLock<[u8; 4097]> = LazyLock::new(|| {
    let mut table = [0; 4097];
    for (step, byte) in table.iter_mut().enumerate() {
        let linear = step as f64 / 4096.0;
        let s = if linear <= 0.003_130_8 {
            12.92 * linear
        } else {
            1.055 * math::pow(linear, 1.0 / 2.4) - 0.055
        };
        *byte = (255.0 * s).round() as u8;
    }
    table
});

fn linear(color: Color) -> DVec3 {
    let [red, green, blue] = [color.red, color.green, color.blue].map(|b| LINEAR[usize::from(b)]);
    DVec3::new(red, green, blue)
}

/// The byte of a linear value; below 0 it is black, above 1 white.
fn encoded(value: f64) -> u8 {
    ENCODED[(value.clamp(0.0, 1.0) * 4096.0).round() as usize]
}

/// The weights of brightness (ITU-R BT.709).
const LUMINANCE: DVec3 = DVec3::new(0.2126, 0.7152, 0.0722);

/// Everything about a picture but who takes it and where.
#[derive(Clone, Debug)]
pub struct Painter {
    /// Which way the pixels look.
    pub lens: std::sync::Arc<Lens>,
    /// What is nearer along the forward axis is not seen, m.
    pub near_m: f64,
    /// What is farther along the forward axis is not seen, m.
    pub far_m: f64,
    /// What is seen at all; the rays pass through the rest.
    pub sees: SeesWhat,
    /// How the scene is lit.
    pub light: Light,
    /// Factor on all light.
    pub exposure: f64,
    /// Edge of the squares that the ground is drawn with; 0 for none.
    pub chequer: Length,
}

/// What one ray has met within the range of depths.
struct Pixel {
    hit: Hit,
    depth_m: f64,
}

impl Painter {
    /// Takes pictures of a scene: one for each channel, in their order.
    ///
    /// # Errors
    /// A pose that is not finite, or farther than 1e9 m from the origin.
    pub fn take(
        &self,
        scene: &Scene<'_>,
        pose: Pose,
        channels: &[Channel],
    ) -> Result<Vec<Image>, BodyError> {
        let turn = pose.attitude.quat();
        let directions: Vec<_> = self.lens.directions().iter().map(|d| turn * *d).collect();
        let pixels = self.look(scene, pose, &directions)?;
        let needs = |wanted: &[Channel]| channels.iter().any(|c| wanted.contains(c));
        let light = if needs(&[Channel::Grey, Channel::Colour]) {
            self.shade(scene, &directions, &pixels)?
        } else {
            Vec::new()
        };
        let optics = self.lens.optics();
        let images = channels.iter().map(|channel| Image {
            width: optics.width,
            height: optics.height,
            pixels: match channel {
                Channel::Depth => self.distances(&pixels, |pixel| pixel.depth_m),
                Channel::Range => self.distances(&pixels, |pixel| pixel.hit.distance_m),
                Channel::Labels => {
                    let label = |pixel: &Pixel| scene.label_of(&pixel.hit);
                    let nearest = self.nearest(&pixels);
                    Pixels::Labels(nearest.map(|p| p.map_or(0, label)).collect())
                }
                Channel::Grey => {
                    let grey = |light: DVec3| encoded(LUMINANCE.dot(light.min(DVec3::ONE)));
                    Pixels::Grey(self.mean(&light).map(grey).collect())
                }
                Channel::Colour => {
                    let colour = |light: DVec3| light.to_array().map(encoded);
                    Pixels::Colour(self.mean(&light).flat_map(colour).collect())
                }
                Channel::Normals => {
                    let byte = |part: f64| (127.5 + 127.5 * part).round() as u8;
                    let normal = |pixel: &Pixel| {
                        let normal = turn.conjugate() * pixel.hit.normal_enu;
                        normal.to_array().map(byte)
                    };
                    let nearest = self.nearest(&pixels);
                    Pixels::Colour(nearest.flat_map(|p| p.map_or([0; 3], normal)).collect())
                }
            },
        });
        Ok(images.collect())
    }

    /// What each ray meets.
    fn look(
        &self,
        scene: &Scene<'_>,
        pose: Pose,
        directions: &[DVec3],
    ) -> Result<Vec<Option<Pixel>>, BodyError> {
        let forward = self.lens.directions().iter().map(|d| d.x);
        let slantest = forward.fold(1.0, f64::min);
        let fan = Fan {
            origin_enu: pose.position.si(),
            directions_enu: directions,
            columns: self.lens.columns(),
            range_m: (self.far_m / slantest).min(1e9),
        };
        let mut hits = Vec::new();
        scene.cast_fan(&fan, self.sees, &mut hits)?;
        let pixels = hits.into_iter().zip(self.lens.directions());
        Ok(pixels
            .map(|(hit, direction)| {
                let hit = hit?;
                let depth_m = hit.distance_m * direction.x;
                (depth_m >= self.near_m && depth_m <= self.far_m).then_some(Pixel { hit, depth_m })
            })
            .collect())
    }

    /// The light that comes along each ray, linear.
    fn shade(
        &self,
        scene: &Scene<'_>,
        directions: &[DVec3],
        pixels: &[Option<Pixel>],
    ) -> Result<Vec<DVec3>, BodyError> {
        let sun = self.light.sun_direction();
        let lit = self.lit(scene, sun, pixels)?;
        let (sky, horizon) = (linear(self.light.sky), linear(self.light.horizon));
        // How wide a ray is at 1 m.
        let optics = self.lens.optics();
        let width = 1.0 / (optics.focal_px * f64::from(optics.samples));
        let rays = directions.iter().zip(pixels).zip(lit);
        let light = rays.map(|((direction, pixel), lit)| {
            let Some(Pixel { hit, .. }) = pixel else {
                let height = direction.z.max(0.0).sqrt();
                return horizon + (sky - horizon) * height;
            };
            let mut albedo = linear(scene.color_of(hit));
            let normal = hit.normal_enu;
            if matches!(scene.kind_of(hit), Kind::Ground | Kind::Terrain) {
                let slant = normal.dot(*direction).abs().max(1e-3);
                albedo *= self.chequered(hit.point_enu, width * hit.distance_m / slant);
            }
            let ambient = self.light.ambient * 0.25 * (3.0 + normal.z);
            let direct = if lit {
                self.light.sun * normal.dot(sun).max(0.0)
            } else {
                0.0
            };
            albedo * (ambient + direct)
        });
        Ok(light.map(|light| light * self.exposure).collect())
    }

    /// How bright the ground is where it is chequered; squares that a pixel cannot show fade away.
    fn chequered(&self, at: DVec3, width_m: f64) -> f64 {
        let edge = self.chequer.get();
        if edge <= 0.0 {
            return 1.0;
        }
        let square = (at.x / edge).floor() + (at.y / edge).floor();
        let sign = if square.rem_euclid(2.0) < 1.0 {
            1.0
        } else {
            -1.0
        };
        1.0 + 0.12 * sign * (1.0 - width_m / edge).max(0.0)
    }

    /// Whether nothing stands between each point and the sun.
    fn lit(
        &self,
        scene: &Scene<'_>,
        sun: DVec3,
        pixels: &[Option<Pixel>],
    ) -> Result<Vec<bool>, BodyError> {
        let mut lit = vec![true; pixels.len()];
        if !self.light.shadows || self.light.sun == 0.0 {
            return Ok(lit);
        }
        let (mut rays, mut places) = (Vec::new(), Vec::new());
        for (place, pixel) in pixels.iter().enumerate() {
            let Some(Pixel { hit, .. }) = pixel else {
                continue;
            };
            if hit.normal_enu.dot(sun) > 0.0 {
                // Clear of the surface that it stands on.
                let clear = 1e-6 * (1.0 + hit.point_enu.abs().max_element());
                rays.push(Ray {
                    origin_enu: hit.point_enu + hit.normal_enu * clear,
                    direction_enu: sun,
                    range_m: SHADOW_M,
                });
                places.push(place);
            }
        }
        let mut hits = Vec::new();
        scene.cast_rays(&rays, self.sees, &mut hits)?;
        for (place, hit) in places.into_iter().zip(hits) {
            lit[place] = hit.is_none();
        }
        Ok(lit)
    }

    /// For each pixel the places of its rays.
    fn rays_of(&self) -> impl Iterator<Item = impl Iterator<Item = usize>> {
        let optics = *self.lens.optics();
        let (samples, columns) = (optics.samples as usize, self.lens.columns());
        let (width, height) = (optics.width as usize, optics.height as usize);
        (0..width * height).map(move |pixel| {
            let first = pixel / width * samples * columns + pixel % width * samples;
            (0..samples * samples).map(move |ray| first + ray / samples * columns + ray % samples)
        })
    }

    /// For each pixel the nearest of what its rays meet.
    fn nearest<'a>(&self, pixels: &'a [Option<Pixel>]) -> impl Iterator<Item = Option<&'a Pixel>> {
        self.rays_of().map(|rays| {
            rays.filter_map(|ray| pixels[ray].as_ref())
                .min_by(|a, b| a.depth_m.total_cmp(&b.depth_m))
        })
    }

    fn distances(&self, pixels: &[Option<Pixel>], of: impl Fn(&Pixel) -> f64) -> Pixels {
        let nearest = self.nearest(pixels);
        Pixels::Depth(
            nearest
                .map(|pixel| pixel.map_or(f32::INFINITY, |pixel| of(pixel) as f32))
                .collect(),
        )
    }

    /// For each pixel the mean of the light along its rays.
    fn mean(&self, light: &[DVec3]) -> impl Iterator<Item = DVec3> {
        let share = 1.0 / f64::from(self.lens.optics().samples.pow(2));
        self.rays_of()
            .map(move |rays| rays.map(|ray| light[ray]).sum::<DVec3>() * share)
    }
}

/// How far away something may be that casts a shadow, m.
const SHADOW_M: f64 = 1_000.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_survives_decoding_and_encoding_but_for_one_in_the_dark() {
        for byte in 0..=255_u8 {
            let back = encoded(LINEAR[usize::from(byte)]);
            assert!(back.abs_diff(byte) <= 1, "{byte} {back}");
        }
        assert_eq!(
            (encoded(-1.0), encoded(0.0), encoded(1.0), encoded(7.0)),
            (0, 0, 255, 255)
        );
        // IEC 61966-2-1: the linear value of middle grey.
        assert!((LINEAR[128] - 0.215_86).abs() < 1e-5);
    }

    #[test]
    fn the_sun_stands_where_it_is_said() {
        let light = Light {
            heading: Angle::from_degrees(90.0),
            elevation: Angle::from_degrees(30.0),
            ..Light::default()
        };
        let wanted = DVec3::new(0.75_f64.sqrt(), 0.0, 0.5);
        assert!((light.sun_direction() - wanted).length() < 1e-12);
    }
}
