//! The vehicle: along its own direction, along walls, out of the way of others, and home.

use super::gradient::Gradient;
use super::wall::{Side, clear_m, follow};
use super::words::Word;
use simbeeotic::prelude::*;
use simbeeotic::units::glam::{DVec2, DVec3};
use simbeeotic::units::math;
use std::f64::consts::{FRAC_PI_2, PI};

/// Explores a building by the swarm gradient bug algorithm, as the module says. It needs sensors called
/// `ring` (with a rate, which is that of its decisions), `compass`, `flow`, `height`, `position` and
/// `person` (which must look straight down), and a radio. It publishes `contacts`, and `landed` when it believes
/// itself home.
#[behavior("office-explorer")]
pub struct Explorer {
    params: ExplorerParams,
    gear: Gear,
    launch: SimTime,
    /// Where it believes to be, from odometry.
    place: Option<DVec2>,
    /// When it reckoned that.
    reckoned: SimTime,
    /// The direction that it prefers, a yaw, rad.
    goal: f64,
    task: Task,
    side: Side,
    /// Where it met the wall that it follows.
    met: DVec2,
    /// It came back behind where it met the wall: next time the wall is on the other side.
    looped: bool,
    home: bool,
    gradient: Gradient,
    /// Where and how loud the beacon was, a metre ago or less.
    sample: Option<(DVec2, f64)>,
    /// How loud the beacon was, and when.
    beacon: Option<(f64, SimTime)>,
    people: Vec<DVec2>,
    contacts: u32,
}

/// Parameters of [`Explorer`].
#[params]
pub struct ExplorerParams {
    /// How fast it flies.
    pub speed: Speed,
    /// How high: above furniture, below the lintels of doors.
    pub level: Length,
    /// How far from walls.
    pub gap: Length,
    /// The way in: outside and inside of the entrance, east and north each.
    pub entrance: [[Length; 2]; 2],
    /// The directions that are preferred are spread over this angle, by the vehicle's address. Zero: all
    /// prefer the same.
    pub fan: Angle,
    /// The middle of that fan.
    pub into: Heading,
    /// How many directions there are, 1 to 1,000.
    pub directions: u32,
    /// Time from one vehicle's start to the next's.
    pub stagger: Time,
    /// When all turn home.
    pub turn_home: Time,
    /// Another is near that is as loud as this: the one with the lower address has priority.
    pub near: PowerLevel,
    /// And very near as this.
    pub very_near: PowerLevel,
    /// The beacon is reached that is as loud as this.
    pub at_home: PowerLevel,
    /// Whether it heeds what others say.
    pub avoid: bool,
    /// How it finds home.
    pub homing: Homing,
}

/// How a vehicle finds home.
#[choice]
pub enum Homing {
    /// By how the beacon's strength changes along the way.
    Gradient,
    /// By odometry: it knows where the entrance is.
    Odometry,
}

impl Default for ExplorerParams {
    fn default() -> Self {
        let at = |east, north| [Length::si(east), Length::si(north)];
        Self {
            speed: Speed::si(0.5),
            level: Length::si(2.15),
            gap: Length::si(0.4),
            entrance: [at(-1.0, 0.0), at(1.0, 0.0)],
            fan: Angle::from_degrees(150.0),
            into: Heading::new(Angle::from_degrees(90.0)),
            directions: 12,
            stagger: Time::from_secs(4.0),
            turn_home: Time::from_secs(300.0),
            near: PowerLevel::from_dbm(-47.0),
            very_near: PowerLevel::from_dbm(-41.0),
            at_home: PowerLevel::from_dbm(-53.0),
            avoid: true,
            homing: Homing::Gradient,
        }
    }
}

/// What is on board.
struct Gear {
    ring: Handle<Scan>,
    compass: Handle<Heading>,
    flow: Handle<Velocity<Flu>>,
    height: Handle<Option<Length>>,
    position: Handle<Position>,
    person: Handle<Vec<Sighting>>,
    radio: RadioHandle,
}

/// What it is about.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Task {
    /// Through the entrance: to which of its two places.
    Enter(usize),
    /// Turns to its direction.
    Rotate,
    /// Flies along its direction.
    Forward,
    /// Follows a wall.
    Wall,
    /// Waits until another is past.
    Wait(SimTime),
    /// Comes down at home.
    Land,
}

/// Time between two words about itself.
const SAY: Time = Time::si(0.5);
/// A beacon that was not heard for this long is not heard.
const DEAF: Time = Time::si(1.0);
/// So near to the line of the entrance it turns round, m.
const DOOR_M: f64 = 0.15;
/// If it is no farther than this beside its middle, m.
const BESIDE_M: f64 = 2.0;
/// How long it waits for one that is very near.
const WAIT: Time = Time::si(1.0);
/// Nothing must be nearer ahead than this beyond its gap, m.
const AHEAD_M: f64 = 0.3;
/// It leaves a wall if so much is free along its direction, m.
const FREE_M: f64 = 1.5;
/// Half the width of what counts as ahead, rad.
const AHEAD: f64 = 0.4;
/// Turning to the wall's side by more than this in a step it goes round an edge, rad.
const ROUND: f64 = 0.1;
/// The most that it turns in one step, rad.
const TURN_MAX: f64 = 0.4;
/// So far behind it has come back, m.
const LOOP_M: f64 = 1.0;
/// And that near to the line behind, rad.
const LOOP: f64 = 1.0;
/// The strength of the beacon is compared after so much, m.
const SAMPLE_M: f64 = 1.0;
/// Points that a direction of the gradient has at most.
const POINTS: u32 = 5;
/// As near as this is there, m.
const THERE_M: f64 = 0.3;
/// Reports of people that are nearer to each other are of one, m.
const SAME_M: f64 = 1.5;
/// It comes down this fast, m/s, and switches its motors off this high, m.
const LANDING: [f64; 2] = [0.4, 0.15];

impl Behavior for Explorer {
    type Params = ExplorerParams;

    fn build(params: ExplorerParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        let [outside, inside] = params.entrance;
        if outside == inside {
            let message = "its two places must differ: outside, inside";
            return Err(BuildError::parameter("entrance", message));
        }
        positive("speed", params.speed)?;
        positive("level", params.level)?;
        positive("gap", params.gap)?;
        in_range("directions", params.directions, 1..=1000)?;
        at_least_zero("stagger", params.stagger)?;
        at_least_zero("turn_home", params.turn_home)?;
        let own = kit.id().0 % params.directions;
        // Neighbours in line prefer directions far apart: left, right, left, right.
        let (rank, left) = (f64::from(own / 2), own.is_multiple_of(2));
        let share = (rank + 0.5) / f64::from(params.directions.div_ceil(2)) * 0.5;
        let off = params.fan.get() * if left { share } else { -share };
        let into = Attitude::from_heading(params.into).yaw().get();
        let launch = SimTime::ZERO + params.stagger * f64::from(own);
        let mut chance = kit.stream("phase");
        kit.every_from(SAY * chance.uniform(), SAY, Self::say);
        Ok(Self {
            gear: Gear {
                ring: kit.on_sample("ring", Self::step)?,
                compass: kit.sensor("compass")?,
                flow: kit.sensor("flow")?,
                height: kit.sensor("height")?,
                position: kit.sensor("position")?,
                person: kit.sensor("person")?,
                radio: kit.radio()?,
            },
            launch,
            place: None,
            reckoned: SimTime::ZERO,
            goal: math::wrap_signed(into + off),
            task: Task::Enter(0),
            side: if left { Side::Left } else { Side::Right },
            met: DVec2::ZERO,
            looped: false,
            home: false,
            gradient: Gradient::new(POINTS),
            sample: None,
            beacon: None,
            people: Vec::new(),
            contacts: 0,
            params,
        })
    }

    fn on_packet(&mut self, packet: &Packet<'_>, bee: &mut Bee<'_>) {
        let rssi = packet.rssi();
        match Word::decode(packet.payload()) {
            Some(Word::Beacon) => self.beacon = Some((rssi.dbm(), bee.now())),
            Some(Word::Bee(theirs)) if self.params.avoid && packet.sender() < bee.id() => {
                self.give_way(theirs, rssi, bee);
            }
            _ => {}
        }
    }

    fn on_contact(&mut self, _touch: &Touch, bee: &mut Bee<'_>) {
        if self.task != Task::Land {
            self.contacts += 1;
            bee.metric("contacts", f64::from(self.contacts), "1");
        }
    }
}

impl Explorer {
    /// Somebody with priority is there, who flies along `theirs`.
    fn give_way(&mut self, theirs: f64, rssi: PowerLevel, bee: &mut Bee<'_>) {
        if rssi < self.params.near || !matches!(self.task, Task::Forward | Task::Wall) {
            return;
        }
        let into = Attitude::from_heading(self.params.into).yaw().get();
        let off = |yaw: f64| math::wrap_signed(yaw - into);
        if !self.home && off(theirs) * off(self.goal) > 0.0 {
            self.goal = math::wrap_signed(into - off(self.goal));
        }
        if rssi >= self.params.very_near {
            self.task = Task::Wait(bee.now() + WAIT);
        }
    }

    /// One decision, at each scan.
    fn step(&mut self, bee: &mut Bee<'_>) {
        let scan = bee.read(self.gear.ring);
        let yaw = Attitude::from_heading(bee.read(self.gear.compass))
            .yaw()
            .get();
        let place = self.reckon(yaw, bee);
        self.look_for_people(yaw, place, bee);
        if bee.now() < self.launch {
            return bee.fly(Velocity::ZERO);
        }
        if !self.home && bee.now() - SimTime::ZERO >= self.params.turn_home {
            self.home = true;
            self.task = Task::Rotate;
        }
        self.measure_beacon(place, bee);
        self.stay_in(place);
        if self.home && self.params.homing == Homing::Odometry {
            let way = self.entrance(1) - place;
            self.goal = math::atan2(way.y, way.x);
        }
        let (turn, speed) = self.decide(&scan, yaw, place, bee);
        bee.turn(Angle::si(turn));
        let climb = self.climb(bee);
        bee.fly(Velocity::from_xyz(
            speed * self.params.speed.get(),
            0.0,
            climb,
        ));
    }

    /// Where it is: the place that it started at, outdoors, and the way since.
    fn reckon(&mut self, yaw: f64, bee: &mut Bee<'_>) -> DVec2 {
        let passed = bee.now() - self.reckoned;
        self.reckoned = bee.now();
        let Some(place) = self.place else {
            let start = bee.read(self.gear.position).si().truncate();
            self.place = Some(start);
            return start;
        };
        let flow = bee.read(self.gear.flow).si().truncate();
        let (sin, cos) = math::sin_cos(yaw);
        let place = place + DVec2::new(cos, sin).rotate(flow) * passed.secs();
        self.place = Some(place);
        place
    }

    fn look_for_people(&mut self, yaw: f64, place: DVec2, bee: &mut Bee<'_>) {
        let (sin, cos) = math::sin_cos(yaw);
        for seen in bee.read(self.gear.person) {
            // The detector looks down: its forward axis is the body's down, its up the body's forward.
            let at = seen.position.si();
            let body = DVec3::new(at.z, at.y, -at.x);
            let at = place + DVec2::new(cos, sin).rotate(body.truncate());
            if self.people.iter().all(|p| p.distance(at) > SAME_M) {
                self.people.push(at);
            }
        }
    }

    /// How loud the beacon is, if it is heard at all, dBm.
    fn hears_home(&self, now: SimTime) -> Option<f64> {
        let (dbm, at) = self.beacon?;
        (now - at <= DEAF).then_some(dbm)
    }

    /// After each metre: is the beacon louder now?
    fn measure_beacon(&mut self, place: DVec2, bee: &mut Bee<'_>) {
        let Some(now_dbm) = self.hears_home(bee.now()) else {
            return;
        };
        if self.home && self.task != Task::Land && now_dbm >= self.params.at_home.dbm() {
            self.task = Task::Land;
            bee.metric("landed", 1.0, "1");
        }
        match self.sample {
            Some((from, was_dbm)) if place.distance(from) >= SAMPLE_M => {
                let way = place - from;
                let along = math::atan2(way.y, way.x);
                self.gradient.flown(along, now_dbm - was_dbm);
                self.sample = Some((place, now_dbm));
                let by_gradient = self.home && self.params.homing == Homing::Gradient;
                if let Some(yaw) = self.gradient.yaw().filter(|_| by_gradient) {
                    self.goal = yaw;
                }
            }
            Some(_) => {}
            None => self.sample = Some((place, now_dbm)),
        }
    }

    /// The entrance: outside, inside.
    fn entrance(&self, which: usize) -> DVec2 {
        let [east, north] = self.params.entrance[which].map(Length::metres);
        DVec2::new(east, north)
    }

    /// Who comes out at the entrance turns round, and keeps to the other side.
    fn stay_in(&mut self, place: DVec2) {
        let (outside, inside) = (self.entrance(0), self.entrance(1));
        let into = (inside - outside).normalize_or(DVec2::X);
        let out = 0.5 * outside.distance(inside) - DOOR_M;
        let explores = matches!(self.task, Task::Rotate | Task::Forward | Task::Wall);
        let way = place - inside;
        if explores && way.dot(into) < -out && way.dot(into.perp()).abs() < BESIDE_M {
            self.task = Task::Enter(1);
            self.side = self.side.other();
        }
    }

    /// The turn of this step, rad, and the share of its speed.
    fn decide(&mut self, scan: &Scan, yaw: f64, place: DVec2, bee: &mut Bee<'_>) -> (f64, f64) {
        let bearing = math::wrap_signed(self.goal - yaw);
        match self.task {
            Task::Enter(which) => self.enter(which, yaw, place),
            Task::Rotate if bearing.abs() > 0.1 => (bearing.clamp(-TURN_MAX, TURN_MAX), 0.0),
            Task::Rotate => {
                self.task = Task::Forward;
                (bearing, 0.0)
            }
            Task::Forward => self.forward(scan, bearing, place),
            Task::Wall => self.along_wall(scan, bearing, place),
            Task::Wait(until) => {
                if bee.now() >= until {
                    self.task = Task::Rotate;
                }
                (0.0, 0.0)
            }
            Task::Land => (0.0, 0.0),
        }
    }

    fn enter(&mut self, which: usize, yaw: f64, place: DVec2) -> (f64, f64) {
        let way = self.entrance(which) - place;
        if way.length() < THERE_M {
            self.task = if which == 0 {
                Task::Enter(1)
            } else {
                Task::Rotate
            };
        }
        let turn = math::wrap_signed(math::atan2(way.y, way.x) - yaw);
        let speed = math::cos(turn).max(0.0).min(way.length() + 0.2);
        (turn.clamp(-TURN_MAX, TURN_MAX), speed)
    }

    fn forward(&mut self, scan: &Scan, bearing: f64, place: DVec2) -> (f64, f64) {
        if clear_m(scan, 0.0, AHEAD) > self.params.gap.metres() + AHEAD_M {
            return (bearing.clamp(-TURN_MAX, TURN_MAX), 1.0);
        }
        if self.looped {
            self.side = self.side.other();
            self.looped = false;
        } else {
            let [left, right] = [FRAC_PI_2, -FRAC_PI_2].map(|to| clear_m(scan, to, AHEAD));
            if left.min(right) < 2.0 {
                self.side = if left < right {
                    Side::Left
                } else {
                    Side::Right
                };
            }
        }
        self.met = place;
        self.task = Task::Wall;
        (0.0, 0.0)
    }

    fn along_wall(&mut self, scan: &Scan, bearing: f64, place: DVec2) -> (f64, f64) {
        let back = place - self.met;
        let behind = math::wrap_signed(self.goal + PI - math::atan2(back.y, back.x));
        if back.length() > LOOP_M && behind.abs() < LOOP {
            self.looped = true;
        }
        // It goes round an edge, and its direction lies on that side, and is free.
        let toward = self.side.sign() * bearing;
        let turn = follow(scan, self.side, self.params.gap.metres());
        let round = self.side.sign() * turn > ROUND;
        let free = clear_m(scan, bearing, AHEAD) > FREE_M;
        if round && free && (0.0..FRAC_PI_2).contains(&toward) {
            self.task = Task::Rotate;
        }
        (turn, math::cos(2.0 * turn).max(0.15))
    }

    /// Vertical speed: to its level, or down.
    fn climb(&mut self, bee: &mut Bee<'_>) -> f64 {
        let height = bee.read(self.gear.height).map_or(0.0, Length::metres);
        if self.task != Task::Land {
            return (2.0 * (self.params.level.metres() - height)).clamp(-0.5, 0.5);
        }
        let [sink, low] = LANDING;
        if height < low {
            bee.hover(false);
            return 0.0;
        }
        -sink
    }

    /// Says who it is and where it flies; and, where home is heard, whom it found.
    fn say(&mut self, bee: &mut Bee<'_>) {
        if self.task == Task::Land || bee.now() < self.launch {
            return;
        }
        bee.send(self.gear.radio, &Word::Bee(self.goal).encode());
        if self.hears_home(bee.now()).is_some() {
            for at in &self.people {
                bee.send(self.gear.radio, &Word::Person(*at).encode());
            }
        }
    }
}
