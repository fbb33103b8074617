//! The beacon at home, which gathers what was found; and the referee, who knows who was where.

use super::words::Word;
use simbeeotic::prelude::*;
use simbeeotic::units::glam::{DVec2, DVec3};
use std::collections::BTreeSet;

/// A beacon: it says that it is there, and listens for people who were found. It publishes `found`: how
/// many there are, those within `same` of each other being one.
#[behavior("office-beacon", host = Station)]
pub struct Beacon {
    radio: RadioHandle,
    same_m: f64,
    people: Vec<DVec2>,
}

/// Parameters of [`Beacon`].
#[params]
pub struct BeaconParams {
    /// Time between two beacons.
    pub period: Time,
    /// Reports of people that are nearer to each other are of one.
    pub same: Length,
}

impl Default for BeaconParams {
    fn default() -> Self {
        Self {
            period: Time::from_millis(200.0),
            same: Length::si(2.0),
        }
    }
}

impl Behavior<Station> for Beacon {
    type Params = BeaconParams;

    fn build(params: BeaconParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        positive("same", params.same)?;
        kit.every(params.period, Self::say);
        Ok(Self {
            radio: kit.radio()?,
            same_m: params.same.metres(),
            people: Vec::new(),
        })
    }

    fn body(_params: &BeaconParams) -> Option<BodySpec> {
        let half_m = DVec3::new(0.1, 0.1, 0.05);
        Some(BodySpec {
            p_enu: DVec3::new(0.0, 0.0, half_m.z),
            mobility: Mobility::Fixed,
            group: group::HIVE,
            kind: Some(Kind::Station),
            ..BodySpec::new(Shape::Box { half_m }, 0.1)
        })
    }

    fn on_packet(&mut self, packet: &Packet<'_>, beacon: &mut Platform<'_>) {
        let Some(Word::Person(at)) = Word::decode(packet.payload()) else {
            return;
        };
        if self.people.iter().all(|p| p.distance(at) > self.same_m) {
            self.people.push(at);
            beacon.metric("found", self.people.len() as f64, "1");
            beacon.log(format!("somebody is at {:.1} m, {:.1} m", at.x, at.y));
        }
    }
}

impl Beacon {
    fn say(&mut self, beacon: &mut Platform<'_>) {
        beacon.send(self.radio, &Word::Beacon.encode());
    }
}

/// Who is lower than this lies, m.
const LYING_M: f64 = 0.3;

/// Notes which rooms an [`Explorer`](super::Explorer) has been in: those places of the world whose names
/// begin with `room`. It publishes `rooms`, and `returned`: how many lie within `home` of the beacon, having been
/// farther away. It takes no part.
#[behavior("office-referee", host = Bodiless)]
pub struct Referee {
    visited: BTreeSet<usize>,
    home_m: f64,
    /// Who has been away.
    gone: BTreeSet<ModelId>,
}

/// Parameters of [`Referee`].
#[params]
pub struct RefereeParams {
    /// Time between two looks.
    pub period: Time,
    /// Who lies as near to the beacon as this is back. Above 0.
    pub home: Length,
}

impl Default for RefereeParams {
    fn default() -> Self {
        Self {
            period: Time::from_millis(500.0),
            home: Length::si(6.0),
        }
    }
}

impl Behavior<Bodiless> for Referee {
    type Params = RefereeParams;

    fn build(params: RefereeParams, kit: &mut Kit<Self, Bodiless>) -> Result<Self, BuildError> {
        positive("home", params.home)?;
        kit.every(params.period, Self::look);
        Ok(Self {
            visited: BTreeSet::new(),
            home_m: params.home.metres(),
            gone: BTreeSet::new(),
        })
    }
}

impl Referee {
    fn look(&mut self, cx: &mut Cx<'_>) {
        let bees = cx.population().of_kind("office-explorer").iter();
        let bees: Vec<Position> = bees
            .filter_map(|id| Some(cx.pose_of(*id)?.position))
            .collect();
        let places = cx.world().places.iter().enumerate();
        let rooms = places.filter(|(_, place)| place.name.starts_with("room"));
        let now = rooms.filter(|(_, room)| bees.iter().any(|at| room.holds(*at)));
        let now: Vec<usize> = now.map(|(at, _)| at).collect();
        self.visited.extend(now);
        cx.metric("rooms", self.visited.len() as f64, "1");
        self.count_home(cx);
    }

    fn count_home(&mut self, cx: &mut Cx<'_>) {
        let beacon = cx.population().of_kind("office-beacon").first().copied();
        let Some(home) = beacon.and_then(|id| cx.pose_of(id)) else {
            return;
        };
        let mut back = 0.0;
        for id in cx.population().of_kind("office-explorer") {
            let Some(pose) = cx.pose_of(*id) else {
                continue;
            };
            if pose.position.distance(home.position).metres() > self.home_m {
                self.gone.insert(*id);
            } else if self.gone.contains(id) && pose.position.si().z < LYING_M {
                back += 1.0;
            }
        }
        cx.metric("returned", back, "1");
    }
}
