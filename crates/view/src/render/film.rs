//! Pictures of a recording, one after the other.

use super::RenderError;
use super::air::Air;
use super::backdrop::cell_m;
use super::beams::Beams;
use super::camera::{Camera, Lens};
use super::choices::{Choices, View};
use super::colours::{ColourBy, Colours};
use super::cut::{self, Blocks};
use super::framing::{CLOSE_M, Frame, Moment, reach_m, survey};
use super::light::Theme;
use super::motion::{Instant, Reel, seconds};
use super::overlay::Overlay;
use super::painter::{Painter, Picture, Scenery};
use super::skins::Skins;
use super::solid;
use super::swarm::{BODY_LEAST_PX, Figure, Swarm};
use super::who::{matching, vehicle};
use super::wind::Winds;
use simbeeotic_record::{Recording, Stage};
use simbeeotic_units::glam::DVec3;
use std::ops::RangeInclusive;

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
    winds: Option<Winds<'a>>,
    beams: Beams,
    followed: Option<usize>,
    frame: Frame,
    cut_open: bool,
    name: String,
}

impl<'a> Film<'a> {
    /// Prepares pictures at times of a range, ns. Reads the ticks between them, to know what moves where.
    ///
    /// # Errors
    /// If the times lie outside the recording; a vehicle or metric is unknown; more than [`DRAWN_MAX`](super::DRAWN_MAX) pixels had to be
    /// drawn; the recording cannot be read.
    pub fn new(
        recording: &'a Recording,
        stage: &Stage,
        choices: Choices,
        times_ns: RangeInclusive<u64>,
    ) -> Result<Self, RenderError> {
        let (from_ns, to_ns) = (*times_ns.start(), *times_ns.end());
        let fineness = choices.checked_fineness()?;
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
        let survey = survey(recording, &figures, followed, seen_from..=to_ns)?;
        let moments = survey.moments.as_slice();
        let blocks = Blocks::of(stage);
        let middle_m = survey
            .moving
            .map_or(DVec3::ZERO, |[low, high]| 0.5 * (low + high));
        let bearing_rad = choices.view.bearing_rad(middle_m);
        let ceiling_m = blocks.ceiling_m(choices.cut_open, moments, bearing_rad);
        let below = ceiling_m.map(|ceiling_m| cut::below(stage, ceiling_m));
        let stage = below.as_ref().unwrap_or(stage);
        let all = solid::bounds(stage);
        let followed_radius_m = followed.map(|at| recording.vehicles()[at].radius_m);
        let frame = Frame::new(&choices, stage, survey.moving, all, followed_radius_m);
        let choices = raised(choices, &frame, &Blocks::of(stage), moments);
        let bounds_m = frame.box_m;
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
            colours: Colours::new(
                &choices.colour_by,
                recording,
                &shown,
                &times_ns,
                survey.extremes,
            )?,
            beams: match choices.beams.is_empty() {
                true => Beams::default(),
                false => Beams::read(recording, &matching(recording, &choices.beams)?, &times_ns)?,
            },
            air: Air::read(recording, &choices, &times_ns)?,
            winds: match choices.wind {
                true => Some(Winds::open(recording, from_ns)?),
                false => None,
            },
            followed,
            frame,
            cut_open: ceiling_m.is_some(),
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
        let place = self.followed.and_then(|at| instant.places_m.get(at));
        let place = place.copied().filter(|place| place.is_finite());
        let camera = self.frame.camera(&self.choices, place, film_s);
        let colours = self.colours.at(&instant, time_ns);
        let links = self.air.links(time_ns);
        let pulses = self.air.pulses(time_ns);
        if let Some(winds) = &mut self.winds {
            winds.advance(self.recording, time_ns)?;
        }
        let wind = self.winds.as_ref().and_then(Winds::now);
        let swarm = Swarm {
            instant: &instant,
            figures: &self.figures,
            colours: &colours,
            by_kind: self.choices.colour_by == ColourBy::Kind,
            least_px: self.least_px(),
            body_least_px: BODY_LEAST_PX * self.side(),
            plane: self.painter.scenery.plane,
            past: &self.reel.past,
            present: &present,
            trail_s: self.choices.trail_s,
            links,
            pulses: &pulses,
            beams: &self.beams.at(&instant, time_ns),
            wind: wind.map_or(&[], |wind| &wind.arrows),
        };
        let picture = self.painter.draw(&camera, |stand| swarm.draw(stand));
        if !(self.choices.captions || self.choices.labels) {
            return Ok(picture);
        }
        Ok(self.captioned(picture, &camera, &instant))
    }

    /// Whether the world is drawn without what begins above the swarm.
    pub fn is_cut_open(&self) -> bool {
        self.cut_open
    }

    /// How high or wide the picture is, in 720 pixels.
    fn side(&self) -> f32 {
        let [width, height] = self.choices.size;
        width.min(height) as f32 / 720.0
    }

    /// Small swarms are drawn larger than large ones.
    fn least_px(&self) -> f32 {
        let flyers = (self.figures.iter()).filter(|figure| figure.shown && figure.flies());
        let flyers = flyers.count();
        let own = match flyers {
            0..=300 => 6.0,
            301..=2000 => 4.6,
            2001..=20_000 => 3.2,
            _ => 2.4,
        };
        (own * self.side()).max(2.2)
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
            let mut names: Vec<(f64, [f64; 2], &str)> = Vec::new();
            for ((vehicle, place), _) in shown {
                let radius = vehicle.radius_m * camera.scale_at(*place);
                if let Some([x, y]) = camera.project(self.choices.size, *place)
                    && (-200.0..9000.0).contains(&x)
                    && (-50.0..9000.0).contains(&y)
                {
                    let off = radius.max(f64::from(self.least_px())) * 1.2 + 3.0;
                    names.push((camera.seen(*place).z, [x + off, y], &vehicle.path));
                }
            }
            // The nearest first; of equals those that come first in the run.
            names.sort_by(|a, b| a.0.total_cmp(&b.0));
            overlay.labels(names.into_iter().map(|(_, at, name)| (at, name)));
        }
        if self.choices.captions {
            let wind = self.winds.as_ref().and_then(Winds::said);
            let parts = [
                Some(self.name.clone()).filter(|name| !name.is_empty()),
                wind,
            ];
            let parts: Vec<String> = parts.into_iter().flatten().collect();
            overlay.time(&format!("{:.2} s", instant.time_s), &parts.join(", "));
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
}

/// An orbit of which nobody has said how high it is stands where the world hides little.
fn raised(choices: Choices, frame: &Frame, blocks: &Blocks, moments: &[Moment]) -> Choices {
    let View::Orbit {
        bearing_rad,
        elevation_rad: None,
        turn_rad_s,
    } = choices.view
    else {
        return choices;
    };
    let at = |elevation_rad: f64| Choices {
        view: View::Orbit {
            bearing_rad,
            elevation_rad: Some(elevation_rad),
            turn_rad_s,
        },
        ..choices.clone()
    };
    let eye_m = |moment: &Moment, elevation_rad: f64| {
        let camera = frame.camera(&at(elevation_rad), moment.followed_m, 0.0);
        camera.eye_m
    };
    at(blocks.elevation_rad(moments, eye_m))
}

/// The name of a file without folders and ending.
fn stem(path: &str) -> &str {
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    name.strip_suffix(".toml")
        .or_else(|| name.strip_suffix(".xml"))
        .unwrap_or(name)
}
