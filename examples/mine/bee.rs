//! The vehicle that searches a mine.

use super::chart::{Chart, HOME, Place, WAYS, step};
use super::finds::Finds;
use super::odometry::{Odometry, Plan};
use simbeeotic::prelude::*;
use simbeeotic::units::glam::{DVec2, DVec3};
use simbeeotic::units::math;
use std::f64::consts::FRAC_PI_2;

/// A vehicle that explores a mine and finds people, from the foot of the shaft and back.
///
/// It has `wall` sensors called `front`, `left`, `back`, `right` and `up`, a `range` sensor `down`, a
/// `person` sensor `eyes`, a `compass`, and a `body-velocity` sensor `odometer`. It publishes `moves` from
/// cell to cell, `cells` that it was in itself, `bumps` into rock, and `back` when it has landed at home.
#[behavior("mine-bee")]
pub struct MineBee {
    params: MineBeeParams,
    gear: Gear,
    plan: Plan,
    chance: Stream,
    odometry: Odometry,
    /// What the compass says: counter-clockwise from east, rad.
    yaw: f64,
    chart: Chart,
    finds: Finds,
    own: Chart,
    errand: Errand,
    /// The cell that it was in last, and the way that it goes from there.
    place: Place,
    leg: Option<usize>,
    /// The way that it looks, one of the four level ones.
    facing: usize,
    /// How long it has been on this leg.
    under_way: Time,
    /// Where it comes down, from the foot of the shaft, m.
    spot: DVec2,
    moves: u32,
    bumps: u32,
}

/// Parameters of [`MineBee`].
#[params]
pub struct MineBeeParams {
    /// How fast it flies.
    pub speed: Speed,
    /// From the middle of one cell of the mine to the next.
    pub pitch: Length,
    /// How wide a tunnel is.
    pub width: Length,
    /// From the floor of a storey to the floor of the next.
    pub storey: Length,
    /// How many storeys the mine has, 1 to 100.
    pub storeys: i8,
    /// How high above the floor it flies.
    pub height: Length,
    /// How far to the right of the middle of a tunnel it keeps.
    pub keep_right: Length,
    /// It sets out at a random time up to this.
    pub launch: Time,
    /// Time between two broadcasts.
    pub talk_period: Time,
    /// Part of what a wall contradicts its dead reckoning by that it believes at once, 0 to 1. 0: it
    /// flies by dead reckoning alone.
    pub wall_trust: f64,
    /// Whether it makes use of what other vehicles and the base tell it.
    pub share: bool,
}

impl Default for MineBeeParams {
    fn default() -> Self {
        Self {
            speed: Speed::si(1.2),
            pitch: Length::si(3.0),
            width: Length::si(2.5),
            storey: Length::si(5.0),
            storeys: 2,
            height: Length::si(1.4),
            keep_right: Length::si(0.3),
            launch: Time::si(12.0),
            talk_period: Time::si(0.5),
            wall_trust: 0.3,
            share: true,
        }
    }
}

/// What it carries.
struct Gear {
    /// To the front, left, back, right.
    walls: [Handle<Option<Length>>; 4],
    up: Handle<Option<Length>>,
    down: Handle<Option<Length>>,
    eyes: Handle<Vec<Sighting>>,
    compass: Handle<Heading>,
    odometer: Handle<Velocity<Flu>>,
    radio: RadioHandle,
}

/// What it is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Errand {
    Wait,
    Explore,
    Return,
    Land,
    Rest,
}

/// Between two steps.
const PERIOD: Time = Time::si(0.1);
/// So near is there, level and in height, m.
const THERE_M: f64 = 0.25;
/// It brakes over this time, s.
const BRAKE_S: f64 = 0.6;
/// Walls as near as this ahead stop it, m.
const STOP_M: f64 = 0.4;
/// What is open is open for so much more than half a tunnel, m.
const OPEN_M: f64 = 0.9;
/// It looks along the grid if it is off by less than this part of a quarter turn.
const ALIGNED: f64 = 0.1;
/// A leg that takes longer is given up, s.
const PATIENCE_S: f64 = 12.0;
/// It comes down this fast, m/s, and from this height lets itself down, m.
const SINK_M_S: f64 = 0.4;
const LANDED_M: f64 = 0.12;

impl Behavior for MineBee {
    type Params = MineBeeParams;

    fn build(params: MineBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        positive("speed", params.speed)?;
        positive("pitch", params.pitch)?;
        positive("width", params.width)?;
        in_range("width", params.width, Length::ZERO..=params.pitch)?;
        positive("storey", params.storey)?;
        in_range("storeys", params.storeys, 1..=100)?;
        positive("height", params.height)?;
        at_least_zero("keep_right", params.keep_right)?;
        at_least_zero("launch", params.launch)?;
        in_range("wall_trust", params.wall_trust, 0.0..=1.0)?;
        let mut chance = kit.stream("mine");
        kit.once(params.launch * chance.uniform(), |me, _| {
            me.errand = Errand::Explore
        });
        kit.every(PERIOD, Self::step);
        let phase = params.talk_period * chance.uniform();
        kit.every_from(phase, params.talk_period, Self::talk);
        let walls = ["front", "left", "back", "right"].map(|name| kit.sensor(name));
        let [front, left, back, right] = walls;
        let spot = DVec2::new(chance.uniform_in(-0.8..0.8), chance.uniform_in(-0.8..0.8));
        Ok(Self {
            gear: Gear {
                walls: [front?, left?, back?, right?],
                up: kit.sensor("up")?,
                down: kit.sensor("down")?,
                eyes: kit.sensor("eyes")?,
                compass: kit.sensor("compass")?,
                odometer: kit.sensor("odometer")?,
                radio: kit.radio()?,
            },
            plan: Plan {
                pitch_m: params.pitch.get(),
                half_m: 0.5 * params.width.get(),
                storey_m: params.storey.get(),
                height_m: params.height.get(),
                trust: params.wall_trust,
            },
            params,
            chance,
            odometry: Odometry::default(),
            yaw: 0.0,
            chart: Chart::default(),
            finds: Finds::default(),
            own: Chart::default(),
            errand: Errand::Wait,
            place: HOME,
            leg: None,
            facing: 0,
            under_way: Time::ZERO,
            spot,
            moves: 0,
            bumps: 0,
        })
    }

    fn on_packet(&mut self, packet: &Packet<'_>, _: &mut Bee<'_>) {
        if self.params.share {
            self.chart.hear(packet.payload());
            self.finds.hear(packet.payload());
        }
    }

    fn on_battery(&mut self, event: BatteryEvent, bee: &mut Bee<'_>) {
        if event == BatteryEvent::Low && self.errand == Errand::Explore {
            bee.log("battery low, goes home");
            self.errand = Errand::Return;
        }
    }

    fn on_contact(&mut self, touch: &Touch, bee: &mut Bee<'_>) {
        if touch.other.object().is_some() {
            self.bumps += 1;
            bee.metric("bumps", f64::from(self.bumps), "1");
        }
    }
}

impl MineBee {
    fn step(&mut self, bee: &mut Bee<'_>) {
        let walls = self.feel(bee);
        if matches!(self.errand, Errand::Wait | Errand::Rest) {
            return;
        }
        self.watch(bee);
        match (self.errand, self.leg, walls) {
            (Errand::Land, ..) => self.land(bee),
            (_, Some(way), _) => self.go(way, walls.unwrap_or_default(), bee),
            (_, None, Some(walls)) => self.decide(walls, bee),
            (_, None, None) => self.fly(DVec3::ZERO, bee),
        }
        self.face(bee);
    }

    /// Looks along the grid. A turn ends what a bump to its side has made of its attitude, too.
    fn face(&mut self, bee: &mut Bee<'_>) {
        let wanted = FRAC_PI_2 * self.facing as f64;
        bee.turn(Angle::si(math::wrap_signed(wanted - self.yaw)));
    }

    /// Where it is: dead reckoning, walls, floor. The distances of the walls by way, where it sees some;
    /// `None` while it does not look along the grid.
    fn feel(&mut self, bee: &mut Bee<'_>) -> Option<[Option<f64>; 4]> {
        self.yaw = Yaw::from(bee.read(self.gear.compass)).get();
        let velocity = bee.read(self.gear.odometer).si();
        let level = turned(velocity.truncate(), self.yaw);
        // Where it stands it does not move, whatever the odometer says.
        if !matches!(self.errand, Errand::Wait | Errand::Rest) {
            self.odometry.moved(level.extend(velocity.z), PERIOD.get());
        }
        if let Some(floor) = bee.read(self.gear.down) {
            self.odometry.floor(floor.get(), &self.plan);
        }
        let quarters = self.yaw / FRAC_PI_2;
        if (quarters - quarters.round()).abs() > ALIGNED {
            return None;
        }
        let ahead = quarters.round().rem_euclid(4.0) as usize;
        let mut walls = [None; 4];
        for (side, sensor) in self.gear.walls.into_iter().enumerate() {
            let seen = bee.read(sensor).map(Length::get);
            walls[(ahead + side) % 4] = seen;
            if let Some(distance_m) = seen {
                self.odometry.wall(ahead + side, distance_m, &self.plan);
            }
        }
        Some(walls)
    }

    /// Who is there.
    fn watch(&mut self, bee: &mut Bee<'_>) {
        for sighting in bee.read(self.gear.eyes) {
            let seen = sighting.position.si();
            let off = turned(seen.truncate(), self.yaw).extend(seen.z);
            self.finds.see(self.odometry.at + off);
        }
    }

    /// In the middle of a cell: where is it open, and where to?
    fn decide(&mut self, walls: [Option<f64>; 4], bee: &mut Bee<'_>) {
        let middle = self.plan.middle(self.place);
        let off = middle - self.odometry.at;
        if off.length() > 2.0 * THERE_M {
            return self.fly_to(middle, bee);
        }
        self.chart.visit(self.place);
        self.own.visit(self.place);
        bee.metric("cells", self.own.visited() as f64, "1");
        for (way, wall) in walls.into_iter().enumerate() {
            let [_, x, y] = WAYS[way].map(f64::from);
            let shut_m = self.plan.half_m + off.truncate().dot(DVec2::new(x, y)) + OPEN_M;
            self.chart
                .note(self.place, way, wall.is_none_or(|d| d > shut_m));
        }
        let storey = self.place[0];
        let above = storey + 1 < self.params.storeys && bee.read(self.gear.up).is_none();
        self.chart.note(self.place, 4, above);
        let below = storey > 0 && bee.read(self.gear.down).is_none();
        self.chart.note(self.place, 5, below);

        let mut way = None;
        if self.errand == Errand::Explore {
            way = self.chart.explore(self.place, &mut self.chance);
            if way.is_none() {
                bee.log("knows no place where nobody was, goes home");
                self.errand = Errand::Return;
            }
        }
        if self.errand == Errand::Return {
            way = self.chart.way_to(self.place, HOME, &mut self.chance);
        }
        match way {
            Some(way) => {
                self.leg = Some(way);
                self.under_way = Time::ZERO;
                self.go(way, walls, bee);
            }
            None if self.place == HOME => self.errand = Errand::Land,
            None => self.errand = Errand::Explore, // its chart is wrong somewhere: another look
        }
    }

    /// On the way to the next cell.
    fn go(&mut self, way: usize, walls: [Option<f64>; 4], bee: &mut Bee<'_>) {
        let next = step(self.place, way);
        let mut target = self.plan.middle(next);
        if let Some([_, x, y]) = WAYS.get(way).filter(|_| way < 4) {
            let ahead = DVec2::new(f64::from(*x), f64::from(*y));
            target += (ahead.perp() * -self.params.keep_right.get()).extend(0.0);
            self.facing = way;
        }
        let left = target - self.odometry.at;
        self.under_way += PERIOD;
        let blocked = way < 4 && walls[way].is_some_and(|d| d < STOP_M) && left.length() > 1.0;
        if left.length() < THERE_M {
            self.chart.pass(self.place, way);
            self.place = next;
            self.leg = None;
            self.moves += 1;
            bee.metric("moves", f64::from(self.moves), "1");
        } else if blocked {
            self.chart.note(self.place, way, false);
            self.leg = None;
        } else if self.under_way.get() > PATIENCE_S {
            self.place = self.plan.cell(self.odometry.at);
            self.leg = None;
        }
        self.fly_to(target, bee);
    }

    fn land(&mut self, bee: &mut Bee<'_>) {
        let aside = self.spot.extend(self.odometry.at.z) - self.odometry.at;
        if bee.read(self.gear.down).is_some_and(|d| d.get() < LANDED_M) {
            self.errand = Errand::Rest;
            bee.fly(Velocity::ZERO);
            bee.hover(false);
            bee.metric("back", 1.0, "1");
            return bee.log("is back");
        }
        let sink = if aside.length() < THERE_M {
            -SINK_M_S
        } else {
            0.0
        };
        self.fly((aside / BRAKE_S).with_z(sink), bee);
    }

    fn fly_to(&mut self, target: DVec3, bee: &mut Bee<'_>) {
        self.fly((target - self.odometry.at) / BRAKE_S, bee);
    }

    /// Flies at a velocity in the world's axes, as far as the compass knows these, or as fast that way as
    /// it can.
    fn fly(&mut self, velocity_m_s: DVec3, bee: &mut Bee<'_>) {
        let held = velocity_m_s.clamp_length_max(self.params.speed.get());
        let level = turned(held.truncate(), -self.yaw);
        bee.fly(Velocity::from_si(level.extend(held.z)));
    }

    fn talk(&mut self, bee: &mut Bee<'_>) {
        if self.errand == Errand::Wait {
            return;
        }
        let chart = self.chart.packet();
        bee.send(self.gear.radio, &chart);
        if let Some(finds) = self.finds.packet() {
            bee.send(self.gear.radio, &finds);
        }
    }
}

/// A level vector turned counter-clockwise.
fn turned(vector: DVec2, angle: f64) -> DVec2 {
    let (sin, cos) = math::sin_cos(angle);
    DVec2::new(cos, sin).rotate(vector)
}
