//! A hive on which bees recharge.

use glam::DVec3;
use simbeeotic_model::check::{in_range, positive};
use simbeeotic_model::host::Station;
use simbeeotic_model::kernel::ModelId;
use simbeeotic_model::physics::{BodySpec, Kind, Mobility, Shape, group};
use simbeeotic_model::units::{Current, Length, Speed, Time};
use simbeeotic_model::{
    Behavior, BuildError, Kit, Message, Platform, Plug, Plugged, behavior, params,
};
use std::collections::BTreeMap;

/// A solid box with a charger: what rests on top of it is charged.
///
/// Once a period it looks who rests within the pad's radius of its middle, on top of the box or inside,
/// and connects as many as it has pads, those first who came first (of those who came within one period,
/// by number). Whoever is full makes room for the next, and is connected again only after it has left.
/// Charging is at constant current, then at constant voltage: see `simbeeotic_model::energy`.
#[behavior("charging-hive", host = Station)]
pub struct ChargingHive {
    params: ChargingHiveParams,
    guests: BTreeMap<ModelId, Guest>,
    arrivals: u64,
}

/// Parameters of [`ChargingHive`].
#[params]
pub struct ChargingHiveParams {
    /// Edge of the box, seen from above.
    pub width: Length,
    /// Height of the box, which stands on its start position.
    pub height: Length,
    /// How many are charged at a time, 1 to 1,000.
    pub pads: u32,
    /// How far from its middle it charges, level.
    pub pad_radius: Length,
    /// The most that one pad gives.
    pub current: Current,
    /// Time between two looks.
    pub period: Time,
}

impl Default for ChargingHiveParams {
    fn default() -> Self {
        Self {
            width: Length::si(1.0),
            height: Length::si(0.2),
            pads: 4,
            pad_radius: Length::si(0.5),
            current: Current::si(0.5),
            period: Time::si(1.0),
        }
    }
}

/// Slower than this is at rest.
const REST: Speed = Speed::si(0.05);
/// What rests on the box may hover by this little.
const GAP_M: f64 = 0.02;
/// Looks that a guest may leave unanswered: it has no battery.
const PATIENCE: u32 = 2;

/// Somebody on the pad.
#[derive(Clone, Copy, Debug)]
struct Guest {
    arrival: u64,
    full: bool,
    unanswered: u32,
}

impl Behavior<Station> for ChargingHive {
    type Params = ChargingHiveParams;

    fn build(params: ChargingHiveParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        positive("width", params.width)?;
        positive("height", params.height)?;
        in_range("pads", params.pads, 1..=1000)?;
        positive("pad_radius", params.pad_radius)?;
        positive("current", params.current)?;
        positive("period", params.period)?;
        kit.every(params.period, Self::look);
        Ok(Self {
            params,
            guests: BTreeMap::new(),
            arrivals: 0,
        })
    }

    fn body(params: &ChargingHiveParams) -> Option<BodySpec> {
        let (width, height) = (params.width.metres(), params.height.metres());
        let half_m = 0.5 * DVec3::new(width, width, height);
        Some(BodySpec {
            p_enu: DVec3::new(0.0, 0.0, half_m.z),
            mobility: Mobility::Fixed,
            group: group::HIVE,
            kind: Some(Kind::Station),
            ..BodySpec::new(Shape::Box { half_m }, 1.0)
        })
    }

    fn on_message(&mut self, message: &Message, _: &mut Platform<'_>) {
        if let Some(answer) = message.get::<Plugged>()
            && let Some(guest) = self.guests.get_mut(&message.sender)
        {
            (guest.full, guest.unanswered) = (answer.full, 0);
        }
    }
}

impl ChargingHive {
    fn look(&mut self, platform: &mut Platform<'_>) {
        let present = self.resting(platform);
        self.guests.retain(|id, _| present.contains(id));
        for id in present {
            let arrival = self.arrivals;
            self.guests.entry(id).or_insert_with(|| {
                self.arrivals += 1;
                Guest {
                    arrival,
                    full: false,
                    unanswered: 0,
                }
            });
        }
        let takes = |guest: &Guest| !guest.full && guest.unanswered < PATIENCE;
        let mut queue: Vec<_> = self.guests.iter_mut().filter(|(_, g)| takes(g)).collect();
        queue.sort_by_key(|(_, guest)| guest.arrival);
        let until = platform.now() + self.params.period * 1.5;
        let plug = Plug {
            current: self.params.current,
            until,
        };
        for (id, guest) in queue.into_iter().take(self.params.pads as usize) {
            guest.unanswered += 1;
            platform.tell(*id, plug);
        }
    }

    /// Who lies on the pad, by number.
    fn resting(&self, platform: &Platform<'_>) -> Vec<ModelId> {
        let hive = platform.position();
        let half_m = 0.5 * self.params.height.metres();
        let pad_m = self.params.pad_radius.metres();
        // Nothing that rests here is bigger than the pad.
        let reach = Length::si(half_m + 2.0 * pad_m + GAP_M);
        let rests = |id: &ModelId| {
            let (Some(pose), Some(twist)) = (platform.pose_of(*id), platform.twist_of(*id)) else {
                return false;
            };
            let radius_m = platform
                .radius_of(*id)
                .map_or(0.0, |radius| radius.metres());
            let way = (pose.position - hive).si();
            let on_top = way.z.abs() <= half_m + radius_m + GAP_M;
            on_top && way.truncate().length() <= pad_m && twist.linear.length() < REST
        };
        let mut all = platform.neighbors_of(hive, reach);
        all.retain(rests);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_stands_on_its_start_and_is_solid() {
        let body = ChargingHive::body(&ChargingHiveParams::default()).expect("a body");
        assert_eq!(body.p_enu, DVec3::new(0.0, 0.0, 0.1));
        assert_eq!(body.mobility, Mobility::Fixed);
        assert!(body.check().is_ok());
    }
}
