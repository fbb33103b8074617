//! The explorer: it flies its route, leaves a trail, and reports.

use super::guide::Guide;
use super::node::{Node, beacons};
use super::trail::{LONGEST_M, Trail};
use super::wire::{FARTHEST_M, Message, Report};
use simbeeotic::prelude::*;
use simbeeotic::units::glam::DVec2;
use std::collections::BTreeSet;

/// An explorer that flies along its route, tells its trail, and reports to the base over whoever is behind it.
/// It needs a radio, and a sensor called `gnss`.
///
/// It publishes `reports` (how many it has made), `words` (how many of them the base has answered, as far as it
/// has heard) and `place` (how far along its route it is).
#[behavior("relay-explorer")]
pub struct RelayExplorer {
    params: RelayExplorerParams,
    node: Node,
    guide: Guide,
    beat: TimerHandle,
    route: Trail,
    reports: u16,
    /// Numbers of the reports that the base has answered.
    words: BTreeSet<u16>,
    heard: Option<SimTime>,
}

/// Parameters of [`RelayExplorer`].
#[params]
pub struct RelayExplorerParams {
    /// Where it flies, in straight lines; the first is the base's place. Heights do not count. Two or
    /// more, each within 3,200 m of the origin; 1,270 m long together at most, since a packet numbers crumbs by a byte.
    pub route: Vec<Position>,
    /// How high it flies.
    pub height: Length,
    /// How fast it flies. Above 0.
    pub speed: Speed,
    /// Time between two reports; the base's `expected` has to say the same. Above 0.
    pub report: Time,
    /// It flies on only while the last word of the base is not older than this. Without it, it flies on
    /// whether it is heard or not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub leash: Option<Time>,
}

impl Default for RelayExplorerParams {
    fn default() -> Self {
        Self {
            route: vec![
                Position::from_xyz(0.0, 0.0, 0.0),
                Position::from_xyz(100.0, 0.0, 0.0),
            ],
            height: Length::si(6.0),
            speed: Speed::si(2.0),
            report: Time::from_millis(500.0),
            leash: None,
        }
    }
}

/// Time between two steps along the route, s.
const STEP_S: f64 = 0.2;
/// How much faster than its place moves it may fly, to keep up with it.
const CATCH_UP: f64 = 1.5;

impl Behavior for RelayExplorer {
    type Params = RelayExplorerParams;

    fn build(params: RelayExplorerParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        if params.route.len() < 2 {
            return Err(BuildError::parameter(
                "route",
                "must have two places or more",
            ));
        }
        positive("height", params.height)?;
        positive("speed", params.speed)?;
        positive("report", params.report)?;
        if let Some(leash) = params.leash {
            at_least_zero("leash", leash)?;
        }
        let places = params.route.iter().map(|place| place.si().truncate());
        let places: Vec<DVec2> = places.collect();
        check_route(&places)?;
        let mut node = Node::new(kit.radio()?, beacons(), kit.stream("beacons"))?;
        let beat = kit.once(node.first(), Self::beat);
        kit.every(Time::from_secs(STEP_S), Self::step);
        kit.every_from(params.report, params.report, Self::report);
        kit.on_sent(|me, outcome, bee| me.node.sent(outcome, bee));
        let guide = Guide::new(kit.sensor("gnss")?);
        Ok(Self {
            params,
            node,
            guide,
            beat,
            route: Trail::over(&places),
            reports: 0,
            words: BTreeSet::new(),
            heard: None,
        })
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        let place = self.node.s_m.and_then(|s_m| self.route.at(s_m));
        let limit = self.params.speed * CATCH_UP;
        self.guide.fly(place, self.params.height, limit, bee);
    }

    fn on_packet(&mut self, packet: &Packet<'_>, bee: &mut Bee<'_>) {
        if let Some(Message::Word(number)) = self.node.hear(packet, bee) {
            self.words.insert(number);
            self.heard = Some(bee.now());
            bee.metric("words", self.words.len() as f64, "1");
        }
    }
}

/// Refuses what a trail or a packet cannot hold.
fn check_route(places: &[DVec2]) -> Result<(), BuildError> {
    let refuse = |message| Err(BuildError::parameter("route", message));
    let length_m: f64 = places.windows(2).map(|leg| leg[0].distance(leg[1])).sum();
    if length_m > LONGEST_M {
        let message = format!("is {length_m:.0} m long; it may be {LONGEST_M:.0} m at most");
        return refuse(message);
    }
    let far_m = |place: &DVec2| place.abs().max_element();
    match places.iter().map(far_m).fold(0.0, f64::max) {
        far_m if far_m > FARTHEST_M => refuse(format!(
            "has a place {far_m:.0} m from the origin, east or north; {FARTHEST_M:.0} m is the most"
        )),
        _ => Ok(()),
    }
}

impl RelayExplorer {
    fn beat(&mut self, bee: &mut Bee<'_>) {
        let pause = self.node.beat(bee);
        bee.arm(self.beat, pause);
    }

    /// Flies on, and lets crumbs fall.
    fn step(&mut self, bee: &mut Bee<'_>) {
        let Some(s_m) = self.node.s_m else {
            if let Some(here) = self.guide.here(bee) {
                self.node.s_m = self.route.nearest_m(here.truncate());
            }
            return;
        };
        let (now, heard) = (bee.now(), self.heard);
        let held = self
            .params
            .leash
            .is_some_and(|leash| heard.is_none_or(|then| now - then > leash));
        if !held {
            let next_m = s_m + self.params.speed.get() * STEP_S;
            self.node.s_m = Some(next_m.min(self.route.end_m()));
        }
        while self.node.trail.known() < self.route.known() && self.node.trail.end_m() < s_m {
            let next = self.node.trail.known();
            self.node.trail.extend(next, self.route.some(next, 1));
        }
    }

    fn report(&mut self, bee: &mut Bee<'_>) {
        let (Some(here), Some(s_m)) = (self.guide.here(bee), self.node.s_m) else {
            return;
        };
        let report = Report {
            number: self.reports,
            made: bee.now(),
            place: here.truncate(),
            hops: 0,
        };
        self.reports = self.reports.wrapping_add(1);
        self.node.forward(report, bee);
        bee.metric("reports", f64::from(self.reports), "1");
        bee.metric("place", s_m, "m");
    }
}
