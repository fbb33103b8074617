//! The MAV: from the deck to a cell, work there, and home again.

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
/// told on the deck.
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
    idle_s: f64,
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
        }
    }
}

/// What it is about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Phase {
    /// It lies on the deck since then. Whether its report was taken.
    Docked { since: SimTime, heard: bool },
    /// It flies to its work, or works.
    Out,
    /// It waits for the hive's answer by radio, asked last at this time, so often.
    Asks { at: SimTime, times: u32 },
    /// It flies home.
    Home,
    /// It comes down on the deck; so many steps it was as low as the deck.
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
/// It waits so long for the hive to take its report: after that it does not lie on the deck, s.
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
            idle_s: 0.0,
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
                },
            );
        }
    }

    /// On the deck: reports, charges, asks for work.
    fn wait(&mut self, hive: ModelId, since: SimTime, heard: bool, bee: &mut Bee<'_>) {
        if !heard {
            if (bee.now() - since).secs() > TAKEN_S {
                // Nobody there: this is not the deck.
                return self.go_home(bee);
            }
            return bee.tell(hive, Report(self.log.clone()));
        }
        if !self.is_charged(bee) {
            return;
        }
        self.idle_s += CHORES.get();
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
        if self.chores.is_multiple_of(5) && !self.mind.carries_on() {
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

    /// Sets out for a job, if it reckons that it can come home from there.
    fn start(&mut self, job: Job, bee: &mut Bee<'_>) {
        let Some((cells, home)) = self.brief.as_ref().map(|(_, b)| (b.cells, b.home)) else {
            return;
        };
        let there = cells.middle(job.cell.min(cells.len() - 1));
        let here = self.pilot.here.truncate();
        let need = self.cost(here, there) + self.cost(there, home.truncate());
        if self.charge(bee) < need + LEAST_WORK + self.params.reserve {
            if job.ticket != 0 {
                self.radio_hive(&Word::Homeward { ticket: job.ticket }, bee);
            }
            if !matches!(self.phase, Phase::Docked { .. }) {
                self.go_home(bee);
            }
            return;
        }
        self.take_off(bee);
        self.phase = Phase::Out;
        let same = self.log.last().is_some_and(|done| done.cell == job.cell);
        if job.task == Task::Search {
            self.finds = Finds::default();
        } else if !(same && job.places.is_empty()) {
            self.finds = Finds::told(&job.places, self.params.flower_height.metres());
        }
        if self.mind.carries_on() {
            self.radio_all(&Word::Claim { cell: job.cell }, bee);
        }
        let knows = job.task != Task::Search && !self.finds.left().is_empty();
        let stage = if knows { job.task } else { Task::Search };
        self.pilot.clear(bee.now());
        let lanes = cells.lanes(job.cell, self.params.lane.metres(), here);
        let entry = match self
            .finds
            .round(here)
            .first()
            .and_then(|at| self.finds.get(*at))
        {
            Some(find) if knows => find.at.truncate(),
            _ => lanes[0],
        };
        self.cross(entry);
        self.work = Some((job, stage));
        match stage {
            Task::Search => self.add_lanes(&lanes),
            _ => self.add_round(stage),
        }
    }

    fn take_off(&mut self, bee: &mut Bee<'_>) {
        if let Phase::Docked { .. } = self.phase {
            bee.hover(true);
            self.pilot.at(self.pilot.here, bee.now());
            if self.idle_s > 0.0 {
                bee.metric("idle", self.idle_s, "s");
            }
        }
    }

    /// The height at which it flies from place to place.
    fn layer(&self) -> f64 {
        let number = self.brief.as_ref().map_or(0, |(_, brief)| brief.number);
        self.params.height.metres() + 0.75 * f64::from(number % 8)
    }

    /// The way to the work: over all obstacles if it is far.
    fn cross(&mut self, entry: DVec2) {
        let (here, up_m) = (self.pilot.here, self.layer());
        let speed_m_s = self.params.speed.get();
        let docked = here.z < 0.5 * self.params.search_height.metres();
        if docked || here.truncate().distance(entry) > NEAR_M {
            self.pilot
                .add(Leg::pass(here.truncate().extend(up_m), speed_m_s));
            self.pilot.add(Leg::pass(entry.extend(up_m), speed_m_s));
        }
        let work = entry.extend(self.params.search_height.metres());
        self.pilot.add(Leg::pass(work, speed_m_s));
    }

    fn add_lanes(&mut self, lanes: &[DVec2]) {
        for place in lanes {
            let to = place.extend(self.params.search_height.metres());
            let leg = Leg::pass(to, self.params.search_speed.get());
            self.pilot.add(Leg {
                act: Act::Look,
                ..leg
            });
        }
    }

    /// From flower to flower.
    fn add_round(&mut self, task: Task) {
        for which in self.finds.round(self.pilot.here.truncate()) {
            let Some(find) = self.finds.get(which) else {
                continue;
            };
            if task == Task::Sample {
                let over = Leg::pass(find.at + DVec3::Z * SAMPLE_M, 2.0);
                let stay_s = self.params.sample.get();
                self.pilot.add(Leg {
                    act: Act::Sample(which),
                    near_m: 0.5,
                    stay_s,
                    ..over
                });
            } else {
                let over = Leg::pass(find.at + DVec3::Z * OVER_M, 2.0);
                self.pilot.add(Leg {
                    near_m: 0.4,
                    ..over
                });
                let down = Leg::pass(find.at + DVec3::Z * DOWN_M, 1.0);
                let stay_s = self.params.pollinate.get();
                self.pilot.add(Leg {
                    act: Act::Serve(which),
                    near_m: 0.3,
                    stay_s,
                    ..down
                });
            }
        }
    }

    /// One step along its legs.
    fn steer(&mut self, bee: &mut Bee<'_>) -> DVec3 {
        let now = bee.now();
        let (wanted, step) = self.pilot.steer(now);
        match step {
            Step::Flies => {
                let act = self.pilot.leg().map_or(Act::Pass, |leg| leg.act);
                if act != Act::Pass && (now - self.looked).secs() >= LOOK_S {
                    self.looked = now;
                    self.look(act, bee);
                }
            }
            Step::Over(Act::Serve(which), true) => self.finds.serve(which),
            Step::Over(..) => {}
            Step::Idle => self.go_on(bee),
        }
        wanted
    }

    /// Looks down, and puts the flowers in sight on its map.
    fn look(&mut self, act: Act, bee: &mut Bee<'_>) {
        let Some((cells, cell)) = self.brief.as_ref().map(|(_, b)| b.cells).zip(self.cell()) else {
            return;
        };
        let sightings = bee.read(self.gear.flowers);
        let mut new = Vec::new();
        for sighting in &sightings {
            if let Some(object) = sighting.thing.and_then(Thing::object)
                && self.noticed.insert(object)
            {
                new.push(object);
            }
            // The detector looks down: its forward axis is the body's down, its up the body's forward.
            let seen = sighting.position.si();
            let body = Velocity::<Flu>::from_xyz(seen.z, seen.y, -seen.x);
            let at = self.pilot.here + bee.attitude().rotate(body).si();
            match act {
                Act::Look if cells.holds(cell, at.truncate(), 0.0) => {
                    self.finds.sight(at, GATE_M);
                }
                Act::Sample(_) if cells.holds(cell, at.truncate(), 0.0) => {
                    self.finds.sight(at, GATE_NEAR_M);
                }
                Act::Serve(_) if self.finds.nearest(at.truncate(), GATE_NEAR_M).is_some() => {
                    self.finds.sight(at, GATE_NEAR_M);
                }
                _ => {}
            }
        }
        // It is nearer by now: the end of the leg is where the flower is seen.
        let (up_m, which) = match act {
            Act::Sample(which) => (SAMPLE_M, which),
            Act::Serve(which) => (DOWN_M, which),
            _ => (0.0, usize::MAX),
        };
        if let (Some(find), Some(leg)) = (self.finds.get(which), self.pilot.leg()) {
            leg.to = find.at + DVec3::Z * up_m;
        }
        if !new.is_empty()
            && let Some(referee) = bee.find("referee")
        {
            bee.tell(referee, Noticed(new));
        }
    }

    fn cell(&self) -> Option<u16> {
        self.work.as_ref().map(|(job, _)| job.cell)
    }

    /// All legs are flown.
    fn go_on(&mut self, bee: &mut Bee<'_>) {
        match self.phase {
            Phase::Home => self.phase = Phase::Sinks { low: 0 },
            Phase::Out => {
                let after = self
                    .work
                    .as_ref()
                    .and_then(|(job, stage)| self.stage_after(job, *stage));
                match (after, self.work.take()) {
                    (Some(stage), Some((job, _))) => {
                        self.work = Some((job, stage));
                        self.pilot.clear(bee.now());
                        self.add_round(stage);
                    }
                    (None, Some(work)) => {
                        self.work = Some(work);
                        self.finish(true, bee);
                        self.decide(bee);
                    }
                    (_, None) => self.decide(bee),
                }
            }
            Phase::Asks { at, .. }
                if self.mind.carries_on() && (bee.now() - at).secs() > LISTEN_S =>
            {
                self.choose(bee);
            }
            _ => {}
        }
    }

    /// What comes after a stage of a job; `None` if it is done.
    fn stage_after(&self, job: &Job, stage: Task) -> Option<Task> {
        let last = if self.mind.carries_on() {
            Task::Pollinate
        } else {
            job.task
        };
        match stage {
            _ if stage >= last || self.finds.left().is_empty() => None,
            // Who was sent to pollinate and had to look first does not sample as well.
            Task::Search if job.task == Task::Pollinate => Some(Task::Pollinate),
            Task::Search => Some(Task::Sample),
            _ => Some(Task::Pollinate),
        }
    }

    /// Notes what came of its work.
    fn finish(&mut self, complete: bool, bee: &mut Bee<'_>) {
        let Some((job, stage)) = self.work.take() else {
            return;
        };
        let left = self.finds.left();
        let finding = Finding {
            ticket: job.ticket,
            task: if self.mind.carries_on() {
                stage
            } else {
                job.task
            },
            cell: job.cell,
            complete,
            count: left.len() as u16,
            places: left,
        };
        if self.mind.carries_on() {
            let left = count_byte(usize::from(finding.count));
            self.radio_all(
                &Word::Mark {
                    cell: job.cell,
                    left,
                },
                bee,
            );
        } else if !complete {
            self.radio_hive(&Word::Homeward { ticket: job.ticket }, bee);
        }
        self.mind.done(&finding);
        self.log.push(finding);
    }

    fn decide(&mut self, bee: &mut Bee<'_>) {
        let next = self.mind.go_on();
        self.act(next, bee);
    }

    /// Decides by what the beacons around have answered.
    fn choose(&mut self, bee: &mut Bee<'_>) {
        let Some(cells) = self.brief.as_ref().map(|(_, brief)| brief.cells) else {
            return;
        };
        let here = self.pilot.here.truncate();
        let next = self.mind.choose(&cells, here, bee.now(), &mut self.chance);
        self.act(next, bee);
    }

    /// Up, and back over its spot.
    pub(super) fn go_home(&mut self, bee: &mut Bee<'_>) {
        let Some(spot) = self.brief.as_ref().map(|(_, brief)| brief.spot) else {
            return;
        };
        bee.hover(true);
        self.work = None;
        self.phase = Phase::Home;
        self.pilot.clear(bee.now());
        let (here, up_m) = (self.pilot.here, self.layer());
        let speed_m_s = self.params.speed.get();
        let up = Leg::pass(here.truncate().extend(up_m), speed_m_s);
        self.pilot.add(Leg { firm: true, ..up });
        let over = Leg::pass(spot.truncate().extend(up_m), speed_m_s);
        self.pilot.add(Leg {
            firm: true,
            near_m: 0.4,
            ..over
        });
    }

    /// Comes down over its spot: fast while it is high, slowly at the end.
    fn sink(&mut self, low: u32, bee: &mut Bee<'_>) -> DVec3 {
        let Some(spot) = self.brief.as_ref().map(|(_, brief)| brief.spot) else {
            return DVec3::ZERO;
        };
        let here = self.pilot.here;
        let height_m = bee
            .read(self.gear.height)
            .map_or(10.0, |height| height.metres());
        let low = if height_m < 0.12 { low + 1 } else { 0 };
        self.phase = Phase::Sinks { low };
        if low >= 5 {
            self.rest(bee);
            return DVec3::ZERO;
        }
        let aside = toward((spot - here).truncate().extend(0.0), 1.0);
        let down_m_s = match height_m {
            high if high > 2.0 => 1.5,
            low if low < 0.3 => 0.15,
            _ => 0.4,
        };
        let near = (spot - here).truncate().length() < 0.5;
        aside - DVec3::Z * if near { down_m_s } else { 0.0 }
    }

    /// It has landed: motors off, and the log to the hive.
    fn rest(&mut self, bee: &mut Bee<'_>) {
        bee.hover(false);
        bee.fly(Velocity::ZERO);
        self.work = None;
        self.phase = Phase::Docked {
            since: bee.now(),
            heard: false,
        };
    }
}
