//! Pictures of a recording, one after the other.

use super::RenderError;
use super::air::Air;
use super::backdrop::cell_m;
use super::beams::Beams;
use super::camera::{Camera, Lens, Side, focal, from_bearing};
use super::colours::{ColourBy, Colours, Extremes};
use super::light::Theme;
use super::motion::{Instant, Reel, seconds};
use super::overlay::Overlay;
use super::painter::{Painter, Picture, Scenery};
use super::skins::Skins;
use super::solid;
use super::swarm::{Figure, Swarm};
use simbeeotic_record::{Recording, Selection, Stage};
use simbeeotic_units::did_you_mean;
use simbeeotic_units::glam::DVec3;
use std::ops::RangeInclusive;

/// Where the camera is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// Without perspective, from a side.
    Side(Side),
    /// With perspective, at a distance from which all is seen.
    Orbit {
        /// Where the camera stands, clockwise from north, rad.
        bearing_rad: f64,
        /// How high above the horizon, rad; between ±π/2.
        elevation_rad: f64,
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

/// What the picture has to show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fit {
    /// All that moves, during the whole film.
    #[default]
    Swarm,
    /// All there is.
    World,
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
    /// Patterns of the paths of the vehicles that are drawn, as [`Selection`] has them; none: all of them.
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
    /// Patterns of the paths of the vehicles whose sensors' rays are drawn; none: of nobody.
    pub beams: Vec<String>,
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
            beams: Vec::new(),
            grid: true,
            captions: true,
            speed: 1.0,
        }
    }
}

/// Takes pictures of one recording.
pub struct Film<'a> {
    recording: &'a Recording,
    choices: Choices,
    reel: Reel<'a>,
    /// When the last picture was taken.
    last_ns: u64,
    start_ns: u64,
    painter: Painter,
    figures: Vec<Figure>,
    colours: Colours,
    air: Air,
    beams: Beams,
    followed: Option<usize>,
    bounds_m: [DVec3; 2],
    name: String,
}

/// Pixels that are drawn at most, before several become one: some gigabytes of memory.
pub const DRAWN_MAX: u64 = 1 << 26;

/// How much of the picture what there is may fill.
const FILL: f64 = 0.86;
/// Nothing is framed more closely than this, m.
const CLOSE_M: f64 = 1.0;

impl<'a> Film<'a> {
    /// Prepares pictures at times of a range, ns. Reads the ticks between them, to know what moves where.
    ///
    /// # Errors
    /// If the times lie outside the recording; a vehicle or metric is unknown; more than [`DRAWN_MAX`] pixels had to be
    /// drawn; the recording cannot be read.
    pub fn new(
        recording: &'a Recording,
        stage: &Stage,
        choices: Choices,
        times_ns: RangeInclusive<u64>,
    ) -> Result<Self, RenderError> {
        let (from_ns, to_ns) = (*times_ns.start(), *times_ns.end());
        let sides = 16..=8192;
        if !choices.size.iter().all(|side| sides.contains(side)) {
            return Err(RenderError::Size(choices.size));
        }
        let fineness = choices.fineness.clamp(1, 4);
        let [width, height] = choices.size;
        let drawn = u64::from(width) * u64::from(height) * u64::from(fineness.pow(2));
        if drawn > DRAWN_MAX {
            return Err(RenderError::Form(format!(
                "{width} x {height} pixels, each drawn as {fineness} x {fineness}: that are {} million, and {} \
                 million are the most; choose a smaller size, or a lower fineness",
                drawn >> 20,
                DRAWN_MAX >> 20
            )));
        }
        let Some(first) = recording.ticks().next().transpose()? else {
            return Err(RenderError::NoTicks(recording.path().to_path_buf()));
        };
        let outside = |asked_ns: u64| RenderError::Outside {
            asked_s: seconds(asked_ns),
            first_s: seconds(first.time_ns),
            last_s: seconds(recording.end_ns()),
        };
        if to_ns > recording.end_ns() {
            return Err(outside(to_ns));
        }
        let trail_s = choices.trail_s.max(0.0);
        let mut reel = Reel::open(recording, from_ns, trail_s)?.ok_or_else(|| outside(from_ns))?;
        reel.at(from_ns)?;
        let shown = matching(recording, &choices.models)?;
        let figures = Figure::all(recording.vehicles(), &shown);
        let followed = choices
            .follow
            .as_deref()
            .map(|path| vehicle(recording, path))
            .transpose()?;

        let back_ns = (trail_s.min(1e9) * 1e9) as u64;
        let seen_from = from_ns.saturating_sub(back_ns).min(reel.now_ns());
        let (moving, extremes) = survey(recording, &figures, seen_from..=to_ns)?;
        let all = solid::bounds(stage);
        let bounds_m = framed(
            &choices,
            stage,
            moving,
            all,
            followed.map(|at| f64::from(recording.vehicles()[at].radius_m as f32)),
        );
        let origin_m = 0.5 * (bounds_m[0] + bounds_m[1]);
        let origin_m = match stage.plane {
            true => origin_m.with_z(0.0),
            false => origin_m,
        };
        let extent_m = 0.5 * (bounds_m[1] - bounds_m[0]).length();
        let ground = match stage.ground {
            [0, 0, 0, 0] => [125, 163, 106, 255],
            own => own,
        };
        let mut skins = Skins::default();
        let mut textures = stage.props.iter().map(|prop| &prop.texture);
        let files = match !stage.texture.is_empty() || textures.any(|name| !name.is_empty()) {
            true => recording.attachments()?,
            false => Vec::new(),
        };
        let faces = solid::stage(stage, origin_m, |name| skins.place(name, &files));
        let scenery = Scenery {
            ground: skins.place(&stage.texture, &files),
            origin_m,
            extent_m: extent_m.max(CLOSE_M),
            reach_m: reach_m(origin_m, [Some(bounds_m), all]),
            faces,
            skins,
            plane: stage.plane,
            radius_m: stage.radius_m,
            grid: choices.grid,
        };
        let painter = Painter::new(
            Theme::new(choices.dark, ground),
            scenery,
            choices.size,
            fineness as usize,
        );
        let name = recording.metadata("run").and_then(|run| run.get("name"));
        Ok(Self {
            recording,
            reel,
            last_ns: from_ns,
            start_ns: from_ns,
            painter,
            figures,
            colours: Colours::new(&choices.colour_by, recording, &shown, &times_ns, extremes)?,
            beams: match choices.beams.is_empty() {
                true => Beams::default(),
                false => Beams::read(recording, &matching(recording, &choices.beams)?, &times_ns)?,
            },
            air: Air::read(recording, &choices, &times_ns)?,
            followed,
            bounds_m,
            name: name.map(|name| stem(name).to_owned()).unwrap_or_default(),
            choices,
        })
    }

    /// Takes a picture. Times that rise are quick; to go back, the recording is opened anew.
    ///
    /// # Errors
    /// If the recording cannot be read there.
    pub fn picture(&mut self, time_ns: u64) -> Result<Picture, RenderError> {
        if time_ns < self.last_ns {
            let trail_s = self.choices.trail_s.max(0.0);
            self.reel = Reel::open(self.recording, time_ns, trail_s)?
                .ok_or_else(|| RenderError::NoTicks(self.recording.path().to_path_buf()))?;
        }
        self.last_ns = time_ns;
        let instant = self.reel.at(time_ns)?;
        let present = match self.choices.trail_s > 0.0 {
            true => self.reel.present(time_ns),
            false => Vec::new(),
        };
        let film_s = (seconds(time_ns) - seconds(self.start_ns)) / self.choices.speed.max(1e-9);
        let camera = self.camera(&instant, film_s);
        let colours = self.colours.at(&instant, time_ns);
        let links = self.air.links(time_ns);
        let pulses = self.air.pulses(time_ns);
        let swarm = Swarm {
            instant: &instant,
            figures: &self.figures,
            colours: &colours,
            by_kind: self.choices.colour_by == ColourBy::Kind,
            least_px: self.least_px(),
            plane: self.painter.scenery.plane,
            past: &self.reel.past,
            present: &present,
            trail_s: self.choices.trail_s,
            links: &links,
            pulses: &pulses,
            beams: &self.beams.at(&instant, time_ns),
        };
        let picture = self.painter.draw(&camera, |stand| swarm.draw(stand));
        if !(self.choices.captions || self.choices.labels) {
            return Ok(picture);
        }
        Ok(self.captioned(picture, &camera, &instant))
    }

    /// Small swarms are drawn larger than large ones.
    fn least_px(&self) -> f32 {
        let [width, height] = self.choices.size;
        let side = width.min(height) as f32 / 720.0;
        let flyers = (self.figures.iter()).filter(|figure| figure.shown && figure.flies());
        let flyers = flyers.count();
        let own = match flyers {
            0..=300 => 6.0,
            301..=2000 => 4.6,
            2001..=20_000 => 3.2,
            _ => 2.4,
        };
        (own * side).max(2.2)
    }

    fn captioned(&self, picture: Picture, camera: &Camera, instant: &Instant) -> Picture {
        let Some(mut overlay) = Overlay::on(&picture, self.painter.theme) else {
            return picture;
        };
        if self.choices.labels {
            let vehicles = self.recording.vehicles().iter().zip(&instant.places_m);
            let shown = vehicles
                .zip(&self.figures)
                .filter(|(_, figure)| figure.shown);
            for ((vehicle, place), _) in shown {
                let radius = vehicle.radius_m * camera.scale_at(*place);
                if let Some([x, y]) = camera.project(self.choices.size, *place)
                    && (-200.0..9000.0).contains(&x)
                    && (-50.0..9000.0).contains(&y)
                {
                    let off = radius.max(f64::from(self.least_px())) * 1.2 + 3.0;
                    overlay.label([x + off, y], &vehicle.path);
                }
            }
        }
        if self.choices.captions {
            overlay.time(&format!("{:.2} s", instant.time_s), &self.name);
            match camera.lens {
                Lens::Flat { scale } => overlay.scale(scale),
                Lens::Perspective { .. } if self.painter.scenery.plane && self.choices.grid => {
                    overlay.grid(cell_m(camera.scale_around(self.painter.scenery.origin_m)));
                }
                Lens::Perspective { .. } => {}
            }
            overlay.key(&self.colours.key);
        }
        overlay.done()
    }

    fn camera(&self, instant: &Instant, film_s: f64) -> Camera {
        let Choices { size, .. } = self.choices;
        let place = self.followed.and_then(|at| instant.places_m.get(at));
        let place = place.copied().filter(|place| place.is_finite());
        let [low, high] = self.bounds_m;
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let middle = place.unwrap_or(middle);
        let half = half / self.choices.zoom.max(1e-6);
        let bounds = [middle - half, middle + half];
        let focal = focal(size[0], self.choices.field_of_view_rad);
        match self.choices.view {
            View::Side(side) => Camera::flat(side, bounds, size, FILL),
            View::Orbit {
                bearing_rad,
                elevation_rad,
                turn_rad_s,
            } => {
                let bearing = bearing_rad + turn_rad_s * film_s;
                let forward = from_bearing(bearing, elevation_rad);
                if turn_rad_s == 0.0 && place.is_none() {
                    return Camera::framing(forward, bounds, size, focal, FILL);
                }
                // As far as it takes from every side, so that it neither comes nor goes.
                let far = (0..8)
                    .map(|k| {
                        let bearing = f64::from(k) * std::f64::consts::FRAC_PI_4;
                        let forward = from_bearing(bearing, elevation_rad);
                        let camera = Camera::framing(forward, bounds, size, focal, FILL);
                        (camera.eye_m - middle).dot(-forward)
                    })
                    .fold(0.0, f64::max);
                Camera::along(middle - forward * far, forward, Lens::Perspective { focal })
            }
            View::From { eye_m, at_m } => {
                let at = place.or(at_m).unwrap_or(middle);
                let focal = focal * self.choices.zoom;
                Camera::along(eye_m, at - eye_m, Lens::Perspective { focal })
            }
        }
    }
}

/// The name of a file without folders and ending.
fn stem(path: &str) -> &str {
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    name.strip_suffix(".toml")
        .or_else(|| name.strip_suffix(".xml"))
        .unwrap_or(name)
}

/// The place of a vehicle by its path.
fn vehicle(recording: &Recording, path: &str) -> Result<usize, RenderError> {
    let vehicles = recording.vehicles();
    let found = vehicles.iter().position(|vehicle| vehicle.path == path);
    found.ok_or_else(|| {
        let all = vehicles.iter().map(|vehicle| vehicle.path.as_str());
        let help = match (did_you_mean(path, all.clone()), vehicles) {
            (Some(guess), _) => format!("did you mean `{guess}`?"),
            (None, []) => "there are none".to_owned(),
            (None, [one]) => format!("there is only `{}`", one.path),
            (None, [first, .., last]) => format!(
                "there are {}, from `{}` to `{}`",
                vehicles.len(),
                first.path,
                last.path
            ),
        };
        RenderError::UnknownVehicle {
            path: path.to_owned(),
            help,
        }
    })
}

/// Which vehicles' paths match one of the patterns; all, if there is none.
fn matching(recording: &Recording, patterns: &[String]) -> Result<Vec<bool>, RenderError> {
    let vehicles = recording.vehicles();
    let takes = |patterns: &[String]| {
        let selection = Selection {
            models: patterns.to_vec(),
            ..Selection::default()
        };
        let shown = vehicles
            .iter()
            .map(|vehicle| selection.takes(&vehicle.path));
        shown.collect::<Vec<bool>>()
    };
    for pattern in patterns {
        if !takes(std::slice::from_ref(pattern)).contains(&true) {
            // The same words as for a name that nobody has.
            return vehicle(recording, pattern).map(|_| Vec::new());
        }
    }
    Ok(takes(patterns))
}

/// From a point to the farthest corner of boxes, m.
fn reach_m(from: DVec3, boxes: [Option<Box3>; 2]) -> f64 {
    let far = |[low, high]: Box3| (from - low).abs().max((from - high).abs()).length();
    boxes.into_iter().flatten().map(far).fold(0.0, f64::max)
}

type Box3 = [DVec3; 2];

/// Where flyers (or, if there are none, all vehicles) are in a range of time, and how fast.
fn survey(
    recording: &Recording,
    figures: &[Figure],
    times_ns: RangeInclusive<u64>,
) -> Result<(Option<Box3>, Extremes), RenderError> {
    let mut bounds: Option<Box3> = None;
    let mut extremes = Extremes {
        speed_m_s: 0.0,
        height_m: [f64::INFINITY, f64::NEG_INFINITY],
    };
    let any_flies = (figures.iter()).any(|figure| figure.shown && figure.flies());
    for tick in recording.ticks_in(*times_ns.start()..=u64::MAX) {
        let tick = tick?;
        for (sample, figure) in tick.samples.iter().zip(figures) {
            let place = DVec3::from(sample.position_m);
            if !place.is_finite() || !figure.shown || (any_flies && !figure.flies()) {
                continue;
            }
            let [low, high] = bounds.get_or_insert([place; 2]);
            (*low, *high) = (low.min(place), high.max(place));
            let [lowest, highest] = extremes.height_m;
            extremes.height_m = [lowest.min(place.z), highest.max(place.z)];
            let speed = DVec3::from(sample.velocity_m_s).length();
            extremes.speed_m_s = extremes.speed_m_s.max(speed);
        }
        if tick.time_ns >= *times_ns.end() {
            break;
        }
    }
    if extremes.height_m[0] > extremes.height_m[1] {
        extremes.height_m = [0.0, 1.0];
    }
    Ok((bounds, extremes))
}

/// The box that the picture shows.
fn framed(
    choices: &Choices,
    stage: &Stage,
    moving: Option<Box3>,
    all: Option<Box3>,
    followed_radius_m: Option<f64>,
) -> Box3 {
    let wanted = match choices.fit {
        Fit::Swarm => moving.or(all),
        Fit::World => match (moving, all) {
            (Some(a), Some(b)) => Some([a[0].min(b[0]), a[1].max(b[1])]),
            (a, b) => a.or(b),
        },
    };
    let [mut low, mut high] = wanted.unwrap_or([DVec3::splat(-5.0), DVec3::splat(5.0)]);
    if let Some(radius) = followed_radius_m {
        let half = DVec3::splat((25.0 * radius).max(CLOSE_M));
        let middle = 0.5 * (low + high);
        return [middle - half, middle + half];
    }
    // The ground belongs to the picture where it is not far below.
    let across = (high - low).truncate().max_element();
    if stage.plane && low.z > 0.0 && low.z < across.max(2.0) {
        low.z = 0.0;
    }
    let middle = 0.5 * (low + high);
    let half = (0.5 * (high - low)).max(DVec3::new(CLOSE_M, CLOSE_M, 0.25 * CLOSE_M));
    (low, high) = (middle - half, middle + half);
    [low, high]
}
