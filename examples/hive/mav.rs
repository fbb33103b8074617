//! The MAV: what it is made of, what it hears, and what it minds once a second. Its flights are in `errand`
//! (out and work), `eyes` (what it sees there) and `homing` (back to its pad).

mod errand;
mod eyes;
mod homing;

use super::finds::Finds;
use super::flight::{Act, Leg, Pilot, Step, toward};
use super::landing::{Briefing, Order, Ready, Received, Report};
use super::planner::Finding;
use super::referee::{Books, Noticed};
use super::scheme::{Mind, Next, Scheme};
use super::wire::{Job, Task, Word, count_byte, share_byte};
use simbeeotic::models::sensor::battery::BatteryReading;
use simbeeotic::prelude::*;
use simbeeotic::radio::cc2420;
use simbeeotic::units::glam::{DVec2, DVec3};
use simbeeotic::units::math;
use simbeeotic::world::{ObjectId, ObjectKind};
use std::collections::BTreeSet;

/// A MAV that searches cells, samples and pollinates flowers, and comes home to be charged.
///
/// It has sensors `position`, `height` (an altimeter), `battery` and `flowers` (a flower detector that
/// looks straight down), and a radio. Where its hive is, how the field is divided and who decides it is
/// told on its pad. It publishes `trips` (landings whose report was taken), `idle` (seconds charged that it
/// got nothing to do) and `unpowered` (seconds on a pad without power before it was charged), and tells a model called `referee`, if there is one, what its batteries gave and which
/// flowers its detector noticed: for the books, nothing comes back.
#[behavior("search-mav")]
pub struct SearchMav {
    pub(super) params: SearchMavParams,
    gear: Gear,
    pub(super) pilot: Pilot,
    pub(super) phase: Phase,
    brief: Option<(ModelId, Briefing)>,
    mind: Mind,
    chance: Stream,
    /// What it works on, and how far it is.
    work: Option<(Job, Task)>,
    finds: Finds,
    /// What it has to report.
    log: Vec<Finding>,
    /// What it has told the referee.
    noticed: BTreeSet<ObjectId>,
    looked: SimTime,
    chores: u32,
    trips: u32,
    /// It has asked for work since it was charged.
    asked: bool,
    idle_s: f64,
    waiting_s: f64,
}

struct Gear {
    position: Handle<Position>,
    height: Handle<Option<Length>>,
    flowers: Handle<Vec<Sighting>>,
    battery: Handle<BatteryReading>,
    radio: Option<RadioHandle>,
}

/// Parameters of [`SearchMav`].
#[params]
pub struct SearchMavParams {
    /// How fast it flies from place to place.
    pub speed: Speed,
    /// How fast it searches.
    pub search_speed: Speed,
    /// How high it searches.
    pub search_height: Length,
    /// How far apart its lanes are, at most.
    pub lane: Length,
    /// How high it flies from place to place; up to 6 m more, so that not all do at one height.
    pub height: Length,
    /// How high flowers are, as a rule.
    pub flower_height: Length,
    /// How long it hovers over a flower to sample it.
    pub sample: Time,
    /// How long it stays on a flower to pollinate it.
    pub pollinate: Time,
    /// How far a full battery brings it, in still air, as its maker says.
    pub range: Length,
    /// State of charge with which it wants to come home, as it reckons: 0 to 1.
    pub reserve: f64,
    /// State of charge with which it sets out, 0 to 1.
    pub charged: f64,
    /// How often it searches its share in the static scheme.
    pub passes: u32,
    /// Time between two words by radio about place and charge, in the central scheme; in whole seconds.
    pub telemetry: Time,
}

impl Default for SearchMavParams {
    fn default() -> Self {
        Self {
            speed: Speed::si(4.0),
            search_speed: Speed::si(2.5),
            search_height: Length::si(4.0),
            lane: Length::si(5.0),
            height: Length::si(7.0),
            flower_height: Length::si(0.5),
            sample: Time::si(2.0),
            pollinate: Time::si(4.0),
            range: Length::si(1200.0),
            reserve: 0.2,
            charged: 0.9,
            passes: 2,
            telemetry: Time::si(5.0),
        }
    }
}

/// What it is about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Phase {
    /// It lies on its pad since then. Whether its report was taken.
    Docked { since: SimTime, heard: bool },
    /// It flies to its work, or works.
    Out,
    /// It waits for the hive's answer by radio, asked last at this time, so often.
    Asks { at: SimTime, times: u32 },
    /// It flies home.
    Home,
    /// It comes down on its pad; so many steps it was as low as one on it.
    Sinks { low: u32 },
}

/// It decides this often about battery and radio.
const CHORES: Time = Time::si(1.0);
/// Looks at flowers are this far apart, s.
const LOOK_S: f64 = 0.5;
/// Cells nearer than this are flown to without a climb, m.
const NEAR_M: f64 = 25.0;
/// Sightings so near each other are of one flower: from high, and from near, m.
const GATE_M: f64 = 0.6;
const GATE_NEAR_M: f64 = 0.4;
/// It hovers so high above a flower to sample it, before it comes down, and when it is down, m.
const SAMPLE_M: f64 = 1.5;
const OVER_M: f64 = 1.0;
const DOWN_M: f64 = 0.25;
/// It waits so long for an answer by radio, and asks so often.
const ANSWER_S: f64 = 0.5;
const ASKED_MAX: u32 = 3;
/// The power at which it talks to beacons: `PA_LEVEL` of a CC2420, -25 dBm.
const WHISPER: u8 = 3;
/// Beacons have so long to answer, s.
const LISTEN_S: f64 = 0.4;
/// It waits so long for the hive to take its report: after that it does not lie on a pad, s.
const TAKEN_S: f64 = 8.0;
/// Work in a cell takes a search at least: as much as this of a battery.
const LEAST_WORK: f64 = 0.08;

impl Behavior for SearchMav {
    type Params = SearchMavParams;

    fn build(params: SearchMavParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        positive("speed", params.speed)?;
        positive("search_speed", params.search_speed)?;
        positive("search_height", params.search_height)?;
        positive("lane", params.lane)?;
        positive("height", params.height)?;
        at_least_zero("flower_height", params.flower_height)?;
        at_least_zero("sample", params.sample)?;
        at_least_zero("pollinate", params.pollinate)?;
        positive("range", params.range)?;
        in_range("reserve", params.reserve, 0.0..=1.0)?;
        in_range("charged", params.charged, 0.0..=1.0)?;
        in_range("passes", params.passes, 1..=1000)?;
        in_range("telemetry", params.telemetry, CHORES..=Time::si(1e6))?;
        let mut chance = kit.stream("mind");
        // Not all at one time.
        let first = CHORES * (0.05 + 0.9 * chance.uniform());
        kit.every_from(first, CHORES, Self::chores);
        Ok(Self {
            params,
            gear: Gear {
                position: kit.sensor("position")?,
                height: kit.sensor("height")?,
                flowers: kit.sensor("flowers")?,
                battery: kit.sensor("battery")?,
                radio: kit.optional_radio(),
            },
            pilot: Pilot::default(),
            phase: Phase::Docked {
                since: SimTime::ZERO,
                heard: true,
            },
            brief: None,
            mind: Mind::Central,
            chance,
            work: None,
            finds: Finds::default(),
            log: Vec::new(),
            noticed: BTreeSet::new(),
            looked: SimTime::ZERO,
            chores: 0,
            trips: 0,
            asked: false,
            idle_s: 0.0,
            waiting_s: 0.0,
        })
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        if let Phase::Docked { .. } = self.phase {
            if bee.is_hovering() {
                bee.hover(false);
                bee.fly(Velocity::ZERO);
            }
            return;
        }
        if bee.condition() != Condition::Fit {
            return;
        }
        let now = bee.now();
        let reading = bee.read(self.gear.position).si();
        self.pilot.sense(reading, now);
        let wanted = match self.phase {
            Phase::Sinks { low } => self.sink(low, bee),
            _ => self.steer(bee),
        };
        if let Phase::Docked { .. } = self.phase {
            return;
        }
        let told = self.pilot.tell(wanted);
        bee.fly(bee.attitude().unrotate(Velocity::<Enu>::from_si(told)));
    }

    fn on_contact(&mut self, touch: &Touch, bee: &mut Bee<'_>) {
        match (self.phase, touch.other) {
            (Phase::Docked { .. }, _) => {}
            (Phase::Sinks { .. }, Thing::Ground) => self.rest(bee),
            (_, Thing::Object(object)) if object.kind == ObjectKind::Flower => {}
            // A tree, a wall, the ground: up, and on.
            (Phase::Sinks { .. } | Phase::Home, _) => self.go_home(bee),
            _ => self.pilot.over(3.0, bee.now()),
        }
    }

    fn on_battery(&mut self, event: BatteryEvent, bee: &mut Bee<'_>) {
        match event {
            BatteryEvent::Charged if !matches!(self.phase, Phase::Docked { .. }) => self.rest(bee),
            BatteryEvent::Empty => bee.log("battery empty, comes down where it is"),
            _ => {}
        }
    }

    fn on_message(&mut self, message: &Message, bee: &mut Bee<'_>) {
        let Phase::Docked { since, .. } = self.phase else {
            return;
        };
        if let Some(briefing) = message.get::<Briefing>() {
            self.take(message.sender, briefing.clone(), bee);
        } else if message.get::<Received>().is_some() {
            self.log.clear();
            self.trips += 1;
            bee.metric("trips", f64::from(self.trips), "1");
            self.phase = Phase::Docked { since, heard: true };
        } else if let Some(Order(job)) = message.get()
            && self.is_charged(bee)
        {
            self.start(job.clone(), bee);
        }
    }

    fn on_packet(&mut self, packet: &Packet<'_>, bee: &mut Bee<'_>) {
        let Some((hive, brief)) = &self.brief else {
            return;
        };
        let word = Word::decode(packet.payload(), brief.home.truncate());
        match (word, self.phase) {
            (Some(Word::Next(job)), Phase::Asks { .. }) if packet.sender() == *hive => {
                self.start(job, bee);
            }
            (Some(Word::ComeHome), Phase::Asks { .. }) if packet.sender() == *hive => {
                self.go_home(bee);
            }
            (
                Some(Word::Trail {
                    cell,
                    visits,
                    left,
                    taken,
                }),
                _,
            ) => {
                let news = (f64::from(visits) / 16.0, left, taken);
                self.mind.hear(cell, news, bee.now());
            }
            (Some(Word::Claim { cell }), _) => self.mind.hear_claim(cell),
            _ => {}
        }
    }

    fn on_finish(&mut self, bee: &mut Bee<'_>) {
        bee.metric("idle", self.idle_s, "s");
        bee.metric("unpowered", self.waiting_s, "s");
    }
}

impl SearchMav {
    /// Hears where it is, on its first day. The crew has put it on its spot before the run begins.
    fn take(&mut self, hive: ModelId, brief: Briefing, bee: &mut Bee<'_>) {
        if self.brief.is_none() && bee.now() == SimTime::ZERO {
            let up = bee.position().si().z;
            let place = brief.spot.truncate().extend(up);
            bee.set_position(Position::from_si(place));
            self.pilot.at(place, bee.now());
        }
        if let (Scheme::Emergent, Some(radio)) = (brief.scheme, self.gear.radio)
            && let Some((level, current)) = cc2420::pa_level(WHISPER)
        {
            // Beacons nearby shall hear it, and not those of the whole field.
            bee.set_power(radio, level, current);
        }
        self.mind = Mind::new(brief.scheme, brief.share.clone(), self.params.passes);
        self.brief = Some((hive, brief));
    }

    fn charge(&self, bee: &mut Bee<'_>) -> f64 {
        bee.read(self.gear.battery).soc
    }

    fn is_charged(&self, bee: &mut Bee<'_>) -> bool {
        self.charge(bee) >= self.params.charged
    }

    /// The share of a battery that brings it from `from` to `to`, in still air.
    fn cost(&self, from: DVec2, to: DVec2) -> f64 {
        from.distance(to) / self.params.range.metres()
    }

    /// Once a second: battery, radio, books.
    fn chores(&mut self, bee: &mut Bee<'_>) {
        self.chores += 1;
        let Some((hive, home)) = self.brief.as_ref().map(|(id, brief)| (*id, brief.home)) else {
            return;
        };
        if bee.condition() == Condition::Fit {
            match self.phase {
                Phase::Docked { since, heard } => self.wait(hive, since, heard, bee),
                Phase::Out | Phase::Asks { .. } => self.mind_battery(home.truncate(), bee),
                Phase::Home | Phase::Sinks { .. } => {}
            }
            self.face(bee);
        }
        if self.chores.is_multiple_of(10)
            && let Some(referee) = bee.find("referee")
        {
            let used = |books: simbeeotic::model::energy::Books| {
                Consumer::ALL
                    .iter()
                    .map(|c| books.used(*c).joules())
                    .sum::<f64>()
            };
            let energy_j = bee.energy().map_or(0.0, used);
            bee.tell(
                referee,
                Books {
                    energy_j,
                    idle_s: self.idle_s,
                    waiting_s: self.waiting_s,
                },
            );
        }
    }

    /// On its pad: reports, charges, asks for work.
    fn wait(&mut self, hive: ModelId, since: SimTime, heard: bool, bee: &mut Bee<'_>) {
        if !heard {
            if (bee.now() - since).secs() > TAKEN_S {
                // Nobody there: this is no pad.
                return self.go_home(bee);
            }
            return bee.tell(hive, Report(self.log.clone()));
        }
        if !self.is_charged(bee) {
            // Below zero while it is charged.
            let without = bee.read(self.gear.battery).current.get() > -0.1;
            self.waiting_s += if without { CHORES.get() } else { 0.0 };
            return;
        }
        // It has asked a second ago, and nothing came.
        self.idle_s += if self.asked { CHORES.get() } else { 0.0 };
        self.asked = true;
        let Some((_, brief)) = &self.brief else {
            return;
        };
        match self.mind.set_out(&brief.cells, &mut self.chance) {
            Next::Ask => bee.tell(hive, Ready),
            next => self.act(next, bee),
        }
    }

    /// In the air: tells the hive how it is, and goes home in time.
    fn mind_battery(&mut self, home: DVec2, bee: &mut Bee<'_>) {
        let charge = self.charge(bee);
        let here = self.pilot.here.truncate();
        if charge < self.cost(here, home) + self.params.reserve {
            if self.work.is_some() {
                self.finish(false, bee);
            }
            return self.go_home(bee);
        }
        if let Phase::Asks { at, times } = self.phase
            && !self.mind.carries_on()
            && (bee.now() - at).secs() > ANSWER_S
        {
            return self.ask(times, bee);
        }
        if self
            .chores
            .is_multiple_of(self.params.telemetry.get().round() as u32)
            && !self.mind.carries_on()
        {
            let cell = self.work.as_ref().map_or(u16::MAX, |(job, _)| job.cell);
            self.radio_hive(
                &Word::Status {
                    cell,
                    charge: share_byte(charge),
                },
                bee,
            );
        }
    }

    /// Turns its nose to where it flies.
    fn face(&mut self, bee: &mut Bee<'_>) {
        let flown = bee.attitude().rotate(bee.velocity_setpoint()).si();
        if flown.truncate().length() > 1.0 {
            let yaw = Angle::si(math::atan2(flown.y, flown.x));
            let turn = yaw - bee.attitude().yaw().angle();
            bee.turn(turn);
            bee.fly(bee.attitude().unrotate(Velocity::<Enu>::from_si(flown)));
        }
    }

    fn radio_hive(&mut self, word: &Word, bee: &mut Bee<'_>) {
        if let (Some(radio), Some((hive, brief))) = (self.gear.radio, &self.brief) {
            bee.send_to(radio, *hive, &word.encode(brief.home.truncate()));
        }
    }

    fn radio_all(&mut self, word: &Word, bee: &mut Bee<'_>) {
        if let Some(radio) = self.gear.radio {
            bee.send(radio, &word.encode(DVec2::ZERO));
        }
    }

    /// Asks by radio what to do next, if it has not done so too often.
    fn ask(&mut self, times: u32, bee: &mut Bee<'_>) {
        let Some(done) = self.log.last().filter(|_| times < ASKED_MAX) else {
            return self.go_home(bee);
        };
        let word = Word::Done {
            ticket: done.ticket,
            cell: done.cell,
            count: count_byte(usize::from(done.count)),
            task: done.task,
        };
        self.radio_hive(&word, bee);
        self.phase = Phase::Asks {
            at: bee.now(),
            times: times + 1,
        };
    }

    /// Does what it or the hive has decided.
    fn act(&mut self, next: Next, bee: &mut Bee<'_>) {
        match next {
            Next::Ask => self.ask(0, bee),
            Next::Listen => {
                self.radio_all(&Word::Listen, bee);
                self.phase = Phase::Asks {
                    at: bee.now(),
                    times: 1,
                };
            }
            Next::Work(job) => self.start(job, bee),
            Next::Walk(place) => {
                self.take_off(bee);
                self.work = None;
                self.phase = Phase::Out;
                self.pilot.clear(bee.now());
                let up = self.layer();
                let here = self.pilot.here;
                let speed_m_s = self.params.speed.get();
                self.pilot
                    .add(Leg::pass(here.truncate().extend(up), speed_m_s));
                self.pilot.add(Leg::pass(place.extend(up), speed_m_s));
            }
            Next::Rest if matches!(self.phase, Phase::Docked { .. }) => {}
            Next::Rest => self.go_home(bee),
        }
    }
}
