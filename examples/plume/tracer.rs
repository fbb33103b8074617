//! The vehicle: seek, surge, cast, declare.

use super::trail::Trail;
use super::words::Word;
use simbeeotic::models::sensor::gnss::Fix;
use simbeeotic::prelude::*;
use simbeeotic::units::glam::DVec2;
use simbeeotic::units::{Concentration, math};
use std::f64::consts::PI;

/// Searches for a leak by its smell and the wind, as the module says. It needs sensors called `gnss`,
/// `compass`, `height`, `smell` and `anemometer`, and a radio.
#[behavior("plume-tracer")]
pub struct Tracer {
    params: TracerParams,
    gear: Gear,
    /// Level that it flies at, m above ground.
    level_m: f64,
    place: DVec2,
    /// Whether it has had a fix: before that it knows no place to tell of.
    placed: bool,
    /// The wind as it believes it is, the mean of late, m/s.
    wind: DVec2,
    /// The strongest smell of late, which fades.
    peak: f64,
    hits: u32,
    last_hit: SimTime,
    last_place: DVec2,
    last_call: Option<SimTime>,
    trail: Trail,
    task: Task,
    /// To the left of upwind, or the right: 1, -1.
    side: f64,
    declared: Option<DVec2>,
}

/// Parameters of [`Tracer`].
#[params]
pub struct TracerParams {
    /// How fast it flies over ground.
    pub speed: Speed,
    /// The lowest level that is flown.
    pub level: Length,
    /// From one vehicle's level to the next's: twelve levels, by its address.
    pub spacing: Length,
    /// Half the edges of the area to search, about the origin: east, north.
    pub area: [Length; 2],
    /// Where it flies when all is done: east, north.
    pub home: [Length; 2],
    /// A smell counts if it is this part of the strongest of late, 0 to 1: the nose adapts.
    pub adapt: f64,
    /// How long it remembers the strongest.
    pub adaptation: Time,
    /// How long it flies on upwind after the last smell.
    pub patience: Time,
    /// The first cast goes as far to each side; each next one twice as far.
    pub cast: Length,
    /// Casts before it gives up and seeks again, 1 to 8.
    pub casts: u32,
    /// Time over which it takes the mean of the wind.
    pub wind_memory: Time,
    /// Whether it measures the wind. If not it believes the forecast.
    pub measure_wind: bool,
    /// Where the wind comes from, as it is told before the start.
    pub forecast: Heading,
    /// Points of loss that make a declaration, 1 to 100.
    pub points: u32,
    /// How close together they have to be.
    pub zone: Length,
    /// Whether it says by radio where it smells something, and comes when others do.
    pub cooperate: bool,
    /// It comes when others do that are as near as this.
    pub earshot: Length,
}

impl Default for TracerParams {
    fn default() -> Self {
        Self {
            speed: Speed::si(2.0),
            level: Length::si(1.5),
            spacing: Length::si(0.1),
            area: [Length::si(50.0); 2],
            home: [Length::ZERO; 2],
            adapt: 0.2,
            adaptation: Time::from_secs(5.0),
            patience: Time::from_secs(1.5),
            cast: Length::si(3.0),
            casts: 4,
            wind_memory: Time::from_secs(4.0),
            measure_wind: true,
            forecast: Heading::new(Angle::from_degrees(270.0)),
            points: 4,
            zone: Length::si(4.0),
            cooperate: true,
            earshot: Length::si(80.0),
        }
    }
}

/// What is on board.
struct Gear {
    gnss: Handle<Option<Fix>>,
    compass: Handle<Heading>,
    height: Handle<Option<Length>>,
    smell: Handle<Concentration>,
    anemometer: Handle<Velocity<Flu>>,
    radio: RadioHandle,
}

/// What it is about.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Task {
    /// To and fro across the wind, until it smells something. The angle from upwind.
    Seek { angle: f64 },
    /// To where somebody else smelled something.
    Join(DVec2),
    /// Upwind, while it smells.
    Surge,
    /// Across the wind, to find again what it lost: which leg, and since when.
    Cast { leg: u32, since: SimTime },
    /// All is done.
    Home,
}

/// Time between two decisions.
const STEP: Time = Time::si(0.2);
/// While it smells it says so this often.
const CALL_PERIOD: Time = Time::si(2.0);
/// A declaration is said again this often, until the base has called home.
const SAY_AGAIN: Time = Time::si(5.0);
/// As near as this is there, m.
const THERE_M: f64 = 1.0;
/// A leg that takes longer than at this share of its speed is given up.
const SLOWEST: f64 = 0.5;
/// Each second pair of casts begins this much farther downwind, as a part of its width.
const BACK: f64 = 0.5;
/// Seeking it flies at this angle to upwind, rad: 75 degrees.
const SEEK: f64 = 1.309;
/// Levels that are shared out.
const LEVELS: u32 = 12;

impl Behavior for Tracer {
    type Params = TracerParams;

    fn build(params: TracerParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        positive("speed", params.speed)?;
        positive("level", params.level)?;
        at_least_zero("spacing", params.spacing)?;
        for half in params.area {
            positive("area", half)?;
        }
        in_range("adapt", params.adapt, 0.0..=1.0)?;
        positive("adaptation", params.adaptation)?;
        positive("patience", params.patience)?;
        positive("cast", params.cast)?;
        in_range("casts", params.casts, 1..=8)?;
        positive("wind_memory", params.wind_memory)?;
        in_range("points", params.points, 1..=100)?;
        positive("zone", params.zone)?;
        at_least_zero("earshot", params.earshot)?;
        kit.every(STEP, Self::step);
        kit.every(SAY_AGAIN, Self::declare);
        let gear = Gear {
            gnss: kit.sensor("gnss")?,
            compass: kit.sensor("compass")?,
            height: kit.sensor("height")?,
            smell: kit.sensor("smell")?,
            anemometer: kit.sensor("anemometer")?,
            radio: kit.radio()?,
        };
        let own = kit.id().0 % LEVELS;
        let mut chance = kit.stream("side");
        let side = if chance.bernoulli(0.5) { 1.0 } else { -1.0 };
        Ok(Self {
            level_m: (params.level + params.spacing * f64::from(own)).metres(),
            place: DVec2::ZERO,
            placed: false,
            wind: -params.forecast.along(Speed::si(1.0)).si().truncate(),
            peak: 0.0,
            hits: 0,
            last_hit: SimTime::ZERO,
            last_place: DVec2::ZERO,
            last_call: None,
            trail: Trail::new(params.points as usize, params.zone.metres()),
            task: Task::Seek { angle: side * SEEK },
            side,
            declared: None,
            params,
            gear,
        })
    }

    fn on_packet(&mut self, packet: &Packet<'_>, _bee: &mut Bee<'_>) {
        match Word::decode(packet.payload()) {
            Some(Word::Found) => {
                self.task = Task::Home;
                self.declared = None;
            }
            Some(Word::Smelled(place)) if self.params.cooperate => self.called(place),
            _ => {}
        }
    }
}

impl Tracer {
    /// Somebody smells something at `place`. Who seeks comes; who is on the way goes to the place that
    /// is farther upwind.
    fn called(&mut self, place: DVec2) {
        let near = place.distance(self.place) <= self.params.earshot.metres();
        let better = match self.task {
            Task::Seek { .. } => near,
            Task::Join(to) => near && (place - to).dot(self.upwind()) > 0.0,
            _ => false,
        };
        if better {
            self.task = Task::Join(place);
        }
    }

    fn upwind(&self) -> DVec2 {
        -self.wind.normalize_or(DVec2::X)
    }

    /// One decision: read, think, fly.
    fn step(&mut self, bee: &mut Bee<'_>) {
        let heading = bee.read(self.gear.compass);
        self.look(heading, bee);
        if self.task != Task::Home && self.smells(bee) && self.placed {
            self.hit(bee);
        }
        let wanted = self.decide(bee).extend(self.climb(bee));
        let wanted = Velocity::<Enu>::from_si(wanted);
        bee.fly(Attitude::from_heading(heading).unrotate(wanted));
    }

    /// Where it is, and what the wind is.
    fn look(&mut self, heading: Heading, bee: &mut Bee<'_>) {
        let Some(fix) = bee.read(self.gear.gnss) else {
            return;
        };
        self.place = fix.position.si().truncate();
        self.placed = true;
        if self.params.measure_wind {
            let past = bee.read(self.gear.anemometer);
            let past = Attitude::from_heading(heading).rotate(past);
            let wind = (past + fix.velocity).si().truncate();
            let share = STEP / self.params.wind_memory;
            self.wind += (wind - self.wind) * share.min(1.0);
        }
    }

    /// Whether it smells something, to a nose that adapts.
    fn smells(&mut self, bee: &mut Bee<'_>) -> bool {
        let smell = bee.read(self.gear.smell).get();
        let fade = math::exp(-(STEP / self.params.adaptation));
        self.peak = smell.max(self.peak * fade);
        smell > 0.0 && smell >= self.params.adapt * self.peak
    }

    fn hit(&mut self, bee: &mut Bee<'_>) {
        (self.last_hit, self.last_place) = (bee.now(), self.place);
        self.task = Task::Surge;
        self.hits += 1;
        bee.metric("hits", f64::from(self.hits), "1");
        let silent = self
            .last_call
            .is_none_or(|at| bee.now() - at >= CALL_PERIOD);
        if self.params.cooperate && silent {
            self.last_call = Some(bee.now());
            bee.send(self.gear.radio, &Word::Smelled(self.place).encode());
        }
    }

    /// The velocity over ground, east and north, m/s.
    fn decide(&mut self, bee: &mut Bee<'_>) -> DVec2 {
        let speed = self.params.speed.get();
        let upwind = self.upwind();
        let now = bee.now();
        match self.task {
            Task::Seek { angle } => self.seek(angle, bee),
            Task::Join(to) if self.place.distance(to) > THERE_M => self.toward(to),
            Task::Join(to) => {
                self.last_place = to;
                self.task = Task::Cast { leg: 0, since: now };
                DVec2::ZERO
            }
            Task::Surge if now - self.last_hit <= self.params.patience => upwind * speed,
            Task::Surge => {
                if let Some(leak) = self.trail.lost_at(self.last_place, upwind) {
                    self.task = Task::Home;
                    self.declared = Some(leak);
                    self.declare(bee);
                } else {
                    self.side = -self.side;
                    self.task = Task::Cast { leg: 0, since: now };
                }
                DVec2::ZERO
            }
            Task::Cast { leg, since } => self.cast(leg, now - since, bee),
            Task::Home => {
                let [east, north] = self.params.home.map(Length::metres);
                self.toward(DVec2::new(east, north))
            }
        }
    }

    /// To and fro between the edges of the area, mostly across the wind.
    fn seek(&mut self, angle: f64, bee: &mut Bee<'_>) -> DVec2 {
        let (upwind, speed) = (self.upwind(), self.params.speed.get());
        let ahead = |angle: f64| {
            let (sin, cos) = math::sin_cos(angle);
            DVec2::new(cos, sin).rotate(upwind)
        };
        let [east, north] = self.params.area.map(Length::metres);
        let out = self.place
            - self
                .place
                .clamp(-DVec2::new(east, north), DVec2::new(east, north));
        if out != DVec2::ZERO && out.dot(ahead(angle)) > 0.0 {
            // Of both sides, upwind and down, one that leads back in; or straight to somewhere in it.
            let ways = [-angle, PI - angle, angle - PI];
            let first = (bee.uniform() * 3.0) as usize;
            let inward = (0..3).map(|k| ways[(first + k) % 3]);
            let mut inward = inward.filter(|&way| out.dot(ahead(way)) < 0.0);
            let back = inward.next().unwrap_or(angle + PI);
            self.task = Task::Seek { angle: back };
            return ahead(back) * speed;
        }
        ahead(angle) * speed
    }

    /// Casts: to one side and the other of where it lost the smell, each pair wider and farther downwind.
    fn cast(&mut self, leg: u32, spent: Time, bee: &mut Bee<'_>) -> DVec2 {
        let pair = f64::from(1_u32 << (leg / 2));
        let width = self.params.cast.metres() * pair;
        let side = if leg.is_multiple_of(2) {
            self.side
        } else {
            -self.side
        };
        let back = (pair - 1.0) * BACK * self.params.cast.metres();
        let upwind = self.upwind();
        let to = self.last_place + upwind.perp() * (side * width) - upwind * back;
        let enough = (4.0 * width + back) / (SLOWEST * self.params.speed.get());
        if self.place.distance(to) > THERE_M && spent.secs() < enough {
            return self.toward(to);
        }
        self.task = if leg + 1 < 2 * self.params.casts {
            Task::Cast {
                leg: leg + 1,
                since: bee.now(),
            }
        } else {
            Task::Seek {
                angle: self.side * SEEK,
            }
        };
        DVec2::ZERO
    }

    fn toward(&self, to: DVec2) -> DVec2 {
        (to - self.place).clamp_length_max(self.params.speed.get())
    }

    /// Vertical speed that keeps its level, m/s.
    fn climb(&self, bee: &mut Bee<'_>) -> f64 {
        let height = bee.read(self.gear.height);
        let off = height.map_or(0.0, |height| self.level_m - height.metres());
        off.clamp(-1.0, 1.0)
    }

    /// Says where the leak is, again and again, until it is called home.
    fn declare(&mut self, bee: &mut Bee<'_>) {
        if let Some(leak) = self.declared {
            bee.send(self.gear.radio, &Word::Declared(leak).encode());
        }
    }
}
