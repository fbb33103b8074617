//! A relay: it stands where its links are even, and sends on what it gets.

use super::guide::Guide;
use super::node::{Node, Side, beacons};
use super::wire::Message;
use simbeeotic::prelude::*;

/// A relay of a chain: it keeps its place on the explorer's trail by the strength of its links to the next one
/// on either side, and sends reports and words on. It needs a radio, and a sensor called `gnss`.
///
/// It publishes twice a second `place` (how far along the trail it is) and `worse` (the strength of the worse of
/// its two links, where it has two).
#[behavior("relay-bee")]
pub struct RelayBee {
    params: RelayBeeParams,
    node: Node,
    guide: Guide,
    beat: TimerHandle,
    behind: Edge,
    ahead: Edge,
}

/// Parameters of [`RelayBee`].
#[params]
pub struct RelayBeeParams {
    /// How high it flies.
    pub height: Length,
    /// How fast it changes its place at most. 0: it stays where it began.
    pub speed: Speed,
    /// How fast it changes its place for each decibel between its links. 0 or more.
    pub gain: Speed,
    /// Where the chain is torn ahead, it goes on until the link behind is as weak as this.
    pub floor: PowerLevel,
    /// It keeps this far from the next one on the trail. 0 or more.
    pub gap: Length,
    /// From then on it stays where it is, however its links are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stays_from: Option<Time>,
}

impl Default for RelayBeeParams {
    fn default() -> Self {
        Self {
            height: Length::si(6.0),
            speed: Speed::si(3.0),
            gain: Speed::si(0.3),
            floor: PowerLevel::from_dbm(-88.0),
            gap: Length::si(4.0),
            stays_from: None,
        }
    }
}

/// Time between two steps along the trail, s.
const STEP_S: f64 = 0.2;
/// A link that was lost is kept shorter than it was by this, m ...
const EDGE_M: f64 = 6.0;
/// ... until it is somewhere else: its other end as far from there as this, m.
const ELSEWHERE_M: f64 = 20.0;
/// Who was not heard for so long may be lost, s.
const DOUBT_S: f64 = 0.6;
/// How much faster than its place moves it may fly, to keep up with it.
const CATCH_UP: f64 = 1.5;

impl Behavior for RelayBee {
    type Params = RelayBeeParams;

    fn build(params: RelayBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        positive("height", params.height)?;
        at_least_zero("speed", params.speed)?;
        at_least_zero("gain", params.gain)?;
        at_least_zero("gap", params.gap)?;
        let mut node = Node::new(kit.radio()?, beacons(), kit.stream("beacons"))?;
        let beat = kit.once(node.first(), Self::beat);
        kit.every(Time::from_secs(STEP_S), Self::step);
        kit.every(Time::from_millis(500.0), Self::publish);
        kit.on_sent(|me, outcome, bee| me.node.sent(outcome, bee));
        let guide = Guide::new(kit.sensor("gnss")?);
        Ok(Self {
            params,
            node,
            guide,
            beat,
            behind: Edge::default(),
            ahead: Edge::default(),
        })
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        let place = self.node.s_m.and_then(|s_m| self.node.trail.at(s_m));
        let limit = self.params.speed.max(Speed::si(1.0)) * CATCH_UP;
        self.guide.fly(place, self.params.height, limit, bee);
    }

    fn on_packet(&mut self, packet: &Packet<'_>, bee: &mut Bee<'_>) {
        if let Some(Message::Word(number)) = self.node.hear(packet, bee) {
            self.node.answer(number, bee);
        }
    }
}

impl RelayBee {
    fn beat(&mut self, bee: &mut Bee<'_>) {
        let pause = self.node.beat(bee);
        bee.arm(self.beat, pause);
    }

    /// Moves its place on the trail.
    fn step(&mut self, bee: &mut Bee<'_>) {
        let Some(s_m) = self.node.s_m else {
            // It joins the trail where it is, once there is one.
            if let Some(here) = self.guide.here(bee) {
                self.node.s_m = self.node.trail.nearest_m(here.truncate());
            }
            return;
        };
        let now = bee.now();
        let stays = self.params.stays_from;
        if stays.is_some_and(|from| now.time() >= from) {
            return;
        }
        let RelayBeeParams {
            gain, floor, gap, ..
        } = &self.params;
        let most_m_s = self.params.speed.get();
        let (behind, ahead) = (self.node.behind(), self.node.ahead());
        let reaches_m = self.node.trail.end_m() - gap.get();
        self.node.torn = ahead.map_or(s_m < reaches_m, |side| side.torn);
        let rate_m_s = match (behind, ahead) {
            (None, _) => -most_m_s,
            (Some(behind), Some(ahead)) if !self.node.torn => {
                gain.get() * (behind.rssi_dbm - ahead.rssi_dbm)
            }
            (Some(behind), _) => gain.get() * (behind.rssi_dbm - floor.dbm()),
        };
        let least_m = behind.map_or(0.0, |side| side.s_m + gap.get());
        let farthest_m = ahead.map_or(self.node.trail.end_m(), |side| side.s_m - gap.get());
        // It does not go again as far from one as where it has just lost it.
        let most_m = self.behind.reach_m(s_m, behind, now);
        let farthest_m = match (behind, most_m) {
            (Some(side), Some(most_m)) => farthest_m.min(s_m.max(side.s_m + most_m)),
            _ => farthest_m,
        };
        let most_m = self.ahead.reach_m(s_m, ahead, now);
        let least_m = match (ahead, most_m) {
            (Some(side), Some(most_m)) => least_m.max(s_m.min(side.s_m - most_m)),
            _ => least_m,
        };
        let next_m = s_m + rate_m_s.clamp(-most_m_s, most_m_s) * STEP_S;
        // Where there is no room between the two, it stays.
        if least_m <= farthest_m {
            self.node.s_m = Some(next_m.clamp(least_m, farthest_m).max(0.0));
        }
    }

    fn publish(&mut self, bee: &mut Bee<'_>) {
        if let Some(s_m) = self.node.s_m {
            bee.metric("place", s_m, "m");
        }
        if let (Some(behind), Some(ahead)) = (self.node.behind(), self.node.ahead()) {
            bee.metric("worse", behind.rssi_dbm.min(ahead.rssi_dbm), "dBm");
        }
    }
}

/// A link to one side, and how long it was when it broke: around a corner, a step too far.
#[derive(Clone, Copy, Debug, Default)]
struct Edge {
    /// Where both ends were, own and other, as the other was heard last.
    last_m: Option<(f64, f64)>,
    lost_m: Option<(f64, f64)>,
}

impl Edge {
    /// Notes who is on this side, seen from `s_m`. How long the link may be, if one has broken hereabouts.
    fn reach_m(&mut self, s_m: f64, side: Option<Side>, now: SimTime) -> Option<f64> {
        let Some(side) = side else {
            self.lost_m = self.last_m.take().or(self.lost_m);
            return None;
        };
        if (now - side.heard).secs() < DOUBT_S {
            self.last_m = Some((s_m, side.s_m));
        }
        let here = |(_, theirs_m): &(f64, f64)| (side.s_m - theirs_m).abs() < ELSEWHERE_M;
        self.lost_m = self.lost_m.filter(here);
        let (mine_m, theirs_m) = self.lost_m?;
        Some((mine_m - theirs_m).abs() - EDGE_M)
    }
}
