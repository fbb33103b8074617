//! The base: where reports arrive.

use super::node::{Node, beacons};
use super::wire::{Message, Report};
use simbeeotic::physics::Mobility;
use simbeeotic::prelude::*;
use simbeeotic::units::glam::DVec2;
use std::collections::BTreeMap;

/// The base of a relay chain. It takes reports, and answers each.
///
/// It publishes with each new report `received` (how many so far), `latency`, `hops` and `reach` (the greatest
/// distance, in a straight line, from which one has come); and once a second `silence` (the longest time
/// between two of them so far) and `delivered`: of the reports that were made between 25 s and 5 s ago, the share
/// that is here.
#[behavior("relay-base", host = Station)]
pub struct RelayBase {
    node: Node,
    beat: TimerHandle,
    expected: Time,
    /// Reports by number: when they were made.
    reports: BTreeMap<u16, SimTime>,
    last: SimTime,
    silence: Time,
    reach_m: f64,
}

/// Parameters of [`RelayBase`].
#[params]
pub struct RelayBaseParams {
    /// Time between two reports of the explorer: its `report`. If they differ, `delivered` is wrong. Above 0.
    pub expected: Time,
}

impl Default for RelayBaseParams {
    fn default() -> Self {
        Self {
            expected: Time::from_millis(500.0),
        }
    }
}

/// `delivered` is of this long, s, ...
const WINDOW_S: f64 = 20.0;
/// ... and leaves reports so much time to arrive, s.
const GRACE_S: f64 = 5.0;

impl Behavior<Station> for RelayBase {
    type Params = RelayBaseParams;

    fn build(params: RelayBaseParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        positive("expected", params.expected)?;
        let mut node = Node::new(kit.radio()?, beacons(), kit.stream("beacons"))?.base();
        let beat = kit.once(node.first(), Self::beat);
        kit.every(Time::from_secs(1.0), Self::publish);
        Ok(Self {
            node,
            beat,
            expected: params.expected,
            reports: BTreeMap::new(),
            last: SimTime::ZERO,
            silence: Time::ZERO,
            reach_m: 0.0,
        })
    }

    fn body(_: &RelayBaseParams) -> Option<BodySpec> {
        let ball = BodySpec::new(Shape::Sphere { radius_m: 0.3 }, 5.0);
        Some(BodySpec {
            mobility: Mobility::Fixed,
            ..ball
        })
    }

    fn on_packet(&mut self, packet: &Packet<'_>, base: &mut Platform<'_>) {
        if let Some(Message::Report(report)) = self.node.hear(packet, base) {
            self.node.answer(report.number, base);
            self.take(&report, base);
        }
    }
}

impl RelayBase {
    fn beat(&mut self, base: &mut Platform<'_>) {
        let pause = self.node.beat(base);
        base.arm(self.beat, pause);
    }

    fn take(&mut self, report: &Report, base: &mut Platform<'_>) {
        if self.reports.insert(report.number, report.made).is_some() {
            return;
        }
        let now = base.now();
        self.silence = self.silence.max(now - self.last);
        self.last = now;
        // It knows where it stands.
        let here = base.position().si();
        let far_m = report.place.distance(DVec2::new(here.x, here.y));
        self.reach_m = self.reach_m.max(far_m);
        base.metric("received", self.reports.len() as f64, "1");
        base.metric("latency", (now - report.made).secs(), "s");
        base.metric("hops", f64::from(report.hops), "1");
        base.metric("reach", self.reach_m, "m");
    }

    fn publish(&mut self, base: &mut Platform<'_>) {
        let now = base.now();
        let silence = self.silence.max(now - self.last);
        base.metric("silence", silence.secs(), "s");
        let age_s = |made: &SimTime| (now - *made).secs();
        let window = GRACE_S..GRACE_S + WINDOW_S;
        if now.time().secs() > window.end {
            let here = self
                .reports
                .values()
                .filter(|made| window.contains(&age_s(made)));
            let share = here.count() as f64 * self.expected.secs() / WINDOW_S;
            base.metric("delivered", share.min(1.0), "1");
        }
    }
}
