//! How pictures are taken: what a [`Film`](super::Film) can be asked for.

use super::RenderError;
use super::camera::Side;
use super::colours::ColourBy;
use simbeeotic_units::glam::DVec3;
use simbeeotic_units::math;

/// Where the camera is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// Without perspective, from a side.
    Side(Side),
    /// With perspective, at a distance from which all is seen.
    Orbit {
        /// Where the camera stands, clockwise from north, rad.
        bearing_rad: f64,
        /// How high above the horizon, rad; between ±π/2. None: π/6, or higher where the world would hide the swarm.
        elevation_rad: Option<f64>,
        /// How it goes around, clockwise as seen from above, rad a second of the film.
        turn_rad_s: f64,
    },
    /// With perspective, from a place.
    From {
        /// The place (ENU), m.
        eye_m: DVec3,
        /// What it looks at, m; the middle of what is to be seen if left out.
        at_m: Option<DVec3>,
    },
}

impl View {
    /// Where the camera stands at the beginning, clockwise from north, rad; from above it is the south. `at_m`: what it
    /// looks at.
    pub(super) fn bearing_rad(self, at_m: DVec3) -> f64 {
        let from = match self {
            Self::Orbit { bearing_rad, .. } => return bearing_rad,
            Self::Side(Side::Top) => DVec3::NEG_Y,
            Self::Side(side) => -side.forward(),
            Self::From { eye_m, at_m: own } => eye_m - own.unwrap_or(at_m),
        };
        math::atan2(from.x, from.y)
    }
}

/// What the picture has to show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fit {
    /// All that moves, during the whole film.
    #[default]
    Swarm,
    /// All there is.
    World,
}

/// Whether the world is drawn without what begins above the swarm: roofs, upper storeys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CutOpen {
    /// Where it would hide the swarm from wherever one looks.
    #[default]
    Auto,
    /// Wherever there is anything.
    Always,
    /// The world is whole.
    Never,
}

/// How pictures are taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Choices {
    /// Pixels across and down, 16 to 8192 each.
    pub size: [u32; 2],
    /// Each pixel is drawn as so many across and down, 1 to 4: more are smoother and slower.
    pub fineness: u32,
    /// Light on dark.
    pub dark: bool,
    /// Where the camera is.
    pub view: View,
    /// What has to be seen.
    pub fit: Fit,
    /// Patterns of the paths of the vehicles that are drawn, as [`Selection`](simbeeotic_record::Selection) has them; none: all of them.
    pub models: Vec<String>,
    /// Path of the vehicle that stays in the middle.
    pub follow: Option<String>,
    /// How many times as large as it would fit.
    pub zoom: f64,
    /// What the width of a picture with perspective shows, rad, 0 to π.
    pub field_of_view_rad: f64,
    /// What colours say.
    pub colour_by: ColourBy,
    /// How long the trails are, s; 0 for none.
    pub trail_s: f64,
    /// Whether names stand beside vehicles.
    pub labels: bool,
    /// Whether radio links are drawn.
    pub links: bool,
    /// Whether packets are drawn.
    pub packets: bool,
    /// Whether arrows show the wind, if it was recorded.
    pub wind: bool,
    /// Patterns of the paths of the vehicles whose sensors' rays are drawn; none: of nobody.
    pub beams: Vec<String>,
    /// Whether the world is cut open.
    pub cut_open: CutOpen,
    /// Whether there are lines on the ground.
    pub grid: bool,
    /// Whether there is time, scale and key.
    pub captions: bool,
    /// Virtual seconds for each second of the film.
    pub speed: f64,
}

impl Default for Choices {
    /// From above, 1280 by 720, light.
    fn default() -> Self {
        Self {
            size: [1280, 720],
            fineness: 1,
            dark: false,
            view: View::Side(Side::Top),
            fit: Fit::Swarm,
            models: Vec::new(),
            follow: None,
            zoom: 1.0,
            field_of_view_rad: 50_f64.to_radians(),
            colour_by: ColourBy::Kind,
            trail_s: 0.0,
            labels: false,
            links: false,
            packets: false,
            wind: true,
            beams: Vec::new(),
            cut_open: CutOpen::Auto,
            grid: true,
            captions: true,
            speed: 1.0,
        }
    }
}

/// Pixels that are drawn at most, before several become one: some gigabytes of memory.
pub const DRAWN_MAX: u64 = 1 << 26;

impl Choices {
    /// As how many pixels each one is drawn, across and down.
    ///
    /// # Errors
    /// If the picture is too small or too large, or more than [`DRAWN_MAX`] pixels had to be drawn.
    pub(super) fn checked_fineness(&self) -> Result<u32, RenderError> {
        let sides = 16..=8192;
        if !self.size.iter().all(|side| sides.contains(side)) {
            return Err(RenderError::Size(self.size));
        }
        let fineness = self.fineness.clamp(1, 4);
        let [width, height] = self.size;
        let drawn = u64::from(width) * u64::from(height) * u64::from(fineness.pow(2));
        if drawn > DRAWN_MAX {
            return Err(RenderError::Form(format!(
                "{width} x {height} pixels, each drawn as {fineness} x {fineness}: that are {} million, and {} \
                 million are the most; choose a smaller size, or a lower fineness",
                drawn >> 20,
                DRAWN_MAX >> 20
            )));
        }
        Ok(fineness)
    }
}
