//! Which way each pixel looks.
//!
//! A pinhole at the sensor's place looks along its forward axis; columns count to the right, rows down,
//! the upper left corner of the picture being (0, 0) and the middle of the first pixel (0.5, 0.5). A
//! direction with the slopes `x` to the right and `y` downwards (the tangents of its angles) falls on
//!
//! ```text
//! u = cx + f xd        v = cy + f yd                                            (1)
//! ```
//! with the focal length `f` in pixels and the principal point `(cx, cy)`. An ideal lens has `xd = x`,
//! `yd = y`; one with distortion (Brown 1966, Conrady 1919, in the form of OpenCV), with
//! `r^2 = x^2 + y^2`,
//!
//! ```text
//! xd = x (1 + k1 r^2 + k2 r^4 + k3 r^6) + 2 p1 x y + p2 (r^2 + 2 x^2)           (2)
//! yd = y (1 + k1 r^2 + k2 r^4 + k3 r^6) + p1 (r^2 + 2 y^2) + 2 p2 x y
//! ```
//! Equation 2 is solved for `x` and `y` by Newton's method, once for each pixel. A distortion that folds
//! the picture over itself within its corners has no solution there, and is refused.

use glam::{DMat2, DVec2, DVec3};
use simbeeotic_model::params;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// How a lens bends straight lines: the coefficients of equation 2. All 0 for none.
#[params]
#[derive(Copy, Default)]
pub struct Distortion {
    /// Radial, second order.
    pub k1: f64,
    /// Radial, fourth order.
    pub k2: f64,
    /// Radial, sixth order.
    pub k3: f64,
    /// Tangential.
    pub p1: f64,
    /// Tangential.
    pub p2: f64,
}

impl Distortion {
    /// Equation 2, and how it changes with `x` and `y`.
    fn bend(&self, at: DVec2) -> (DVec2, DMat2) {
        let Self { k1, k2, k3, p1, p2 } = *self;
        let (x, y, r2) = (at.x, at.y, at.length_squared());
        let radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
        let change = k1 + r2 * (2.0 * k2 + 3.0 * r2 * k3); // of `radial` with r^2
        let bent = DVec2::new(
            x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
            y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y,
        );
        let across = 2.0 * x * y * change + 2.0 * p1 * x + 2.0 * p2 * y;
        let along_x = radial + 2.0 * x * x * change + 2.0 * p1 * y + 6.0 * p2 * x;
        let along_y = radial + 2.0 * y * y * change + 6.0 * p1 * y + 2.0 * p2 * x;
        (
            bent,
            DMat2::from_cols(DVec2::new(along_x, across), DVec2::new(across, along_y)),
        )
    }

    /// The slopes that fall on `bent`; `None` where the lens folds.
    fn straighten(&self, bent: DVec2) -> Option<DVec2> {
        if *self == Self::default() {
            return Some(bent);
        }
        let mut at = bent;
        for _ in 0..50 {
            let (found, slope) = self.bend(at);
            let miss = found - bent;
            if miss.length() < 1e-12 * (1.0 + bent.length()) {
                return (slope.determinant() > 0.0).then_some(at);
            }
            if slope.determinant() <= 0.0 {
                return None;
            }
            at -= slope.inverse() * miss;
        }
        None
    }
}

/// What decides where the pixels look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Optics {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Rays along each side of a pixel, 1 or more.
    pub samples: u32,
    /// Focal length, pixels.
    pub focal_px: f64,
    /// Where the forward axis falls, pixels from the left and from the top.
    pub principal_px: [f64; 2],
    /// How the lens bends straight lines.
    pub distortion: Distortion,
}

impl Optics {
    /// An ideal lens in the middle of the picture. `half` is half the horizontal field of view.
    pub fn pinhole(width: u32, height: u32, samples: u32, tan_half: f64) -> Self {
        Self {
            width,
            height,
            samples,
            focal_px: 0.5 * f64::from(width) / tan_half,
            principal_px: [0.5 * f64::from(width), 0.5 * f64::from(height)],
            distortion: Distortion::default(),
        }
    }

    /// The slopes to the right and downwards that fall on a place of the picture.
    pub fn slopes(&self, place_px: DVec2) -> Option<DVec2> {
        let bent = (place_px - DVec2::from_array(self.principal_px)) / self.focal_px;
        self.distortion.straighten(bent)
    }
}

/// The directions of all rays of a camera.
#[derive(Debug)]
pub struct Lens {
    optics: Optics,
    /// Of unit length: forward, left, up. Row by row, `samples` times as many in a row as there are pixels.
    directions: Vec<DVec3>,
}

/// A swarm's cameras are alike: those that are in use share their directions.
static IN_USE: Mutex<Vec<Weak<Lens>>> = Mutex::new(Vec::new());

impl Lens {
    /// The lens of these optics; `None` if it folds the picture.
    pub fn new(optics: Optics) -> Option<Arc<Self>> {
        let mut in_use = IN_USE.lock().unwrap_or_else(PoisonError::into_inner);
        in_use.retain(|lens| lens.strong_count() > 0);
        let known = in_use.iter().filter_map(Weak::upgrade);
        for lens in known {
            if lens.optics == optics {
                return Some(lens);
            }
        }
        let columns = optics.width * optics.samples;
        let rows = optics.height * optics.samples;
        let mut directions = Vec::with_capacity(columns as usize * rows as usize);
        for row in 0..rows {
            for column in 0..columns {
                let place = DVec2::new(f64::from(column), f64::from(row)) + 0.5;
                let slopes = optics.slopes(place / f64::from(optics.samples))?;
                directions.push(DVec3::new(1.0, -slopes.x, -slopes.y).normalize());
            }
        }
        let lens = Arc::new(Self { optics, directions });
        in_use.push(Arc::downgrade(&lens));
        Some(lens)
    }

    /// What it is.
    pub fn optics(&self) -> &Optics {
        &self.optics
    }

    /// Rays in a row.
    pub fn columns(&self) -> usize {
        (self.optics.width * self.optics.samples) as usize
    }

    /// The directions of all rays, of unit length: forward, left, up.
    pub fn directions(&self) -> &[DVec3] {
        &self.directions
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_pixel_looks_to_the_upper_left() {
        let lens = Lens::new(Optics::pinhole(4, 2, 1, 1.0)).expect("a pinhole");
        // Half the width of the picture is one focal length, so the outermost pixels are at 3/4.
        let first = lens.directions()[0];
        assert!((first / first.x - DVec3::new(1.0, 0.75, 0.25)).length() < 1e-15);
        let last = lens.directions()[7];
        assert!((last / last.x - DVec3::new(1.0, -0.75, -0.25)).length() < 1e-15);
    }

    #[test]
    fn what_a_lens_has_bent_it_straightens() {
        // Of the order of a wide lens of a small camera.
        let distortion = Distortion {
            k1: -0.28,
            k2: 0.07,
            k3: 0.001,
            p1: 0.001,
            p2: -0.002,
        };
        for k in -5..=5 {
            for j in -4..=4 {
                let slopes = DVec2::new(f64::from(k), f64::from(j)) * 0.1;
                let (bent, slope) = distortion.bend(slopes);
                let back = distortion.straighten(bent).expect("it does not fold here");
                assert!((back - slopes).length() < 1e-11, "{slopes} {back}");
                // The slope is that of equation 2.
                let step = 1e-6;
                let there = distortion.bend(slopes + DVec2::X * step).0;
                assert!(((there - bent) / step - slope.x_axis).length() < 1e-5);
                let there = distortion.bend(slopes + DVec2::Y * step).0;
                assert!(((there - bent) / step - slope.y_axis).length() < 1e-5);
            }
        }
    }

    #[test]
    fn a_barrel_shows_more_than_a_pinhole_at_its_edge() {
        let pinhole = Optics::pinhole(100, 100, 1, 0.5);
        let barrel = Optics {
            distortion: Distortion {
                k1: -0.2,
                ..Distortion::default()
            },
            ..pinhole
        };
        let edge = |optics: &Optics| optics.slopes(DVec2::new(100.0, 50.0)).map(|s| s.x);
        assert!(edge(&barrel).expect("inside") > edge(&pinhole).expect("inside") + 0.01);
    }

    #[test]
    fn a_lens_that_folds_the_picture_is_none() {
        let optics = Optics {
            distortion: Distortion {
                k1: -1.0,
                ..Distortion::default()
            },
            ..Optics::pinhole(10, 10, 1, 1.0)
        };
        assert!(Lens::new(optics).is_none());
    }

    #[test]
    fn cameras_that_are_alike_share_their_directions() {
        let optics = Optics::pinhole(11, 7, 1, 0.7);
        let (one, two) = (Lens::new(optics), Lens::new(optics));
        assert!(Arc::ptr_eq(&one.expect("a lens"), &two.expect("a lens")));
    }
}
