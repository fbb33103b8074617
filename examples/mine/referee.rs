//! The referee: it knows where people are, and holds what the base was told against it.

use simbeeotic::prelude::*;
use simbeeotic::units::glam::DVec3;
use std::collections::BTreeSet;

/// Where the base believes people to be, from the foot of the shaft, m.
#[derive(Clone, Debug)]
pub struct Report(pub Vec<DVec3>);

/// Knows the world, and tells nobody.
///
/// It publishes `people`, all that there are; `people-found`, of how many of them the base has been told
/// within 1.5 m of where they are; `people-wrong`, reports with nobody there; `time-first` and
/// `time-last`, when the base knew of the first and of the last one found.
#[behavior("mine-referee", host = Bodiless)]
pub struct MineReferee {
    found: BTreeSet<usize>,
}

/// It has none.
#[params]
#[derive(Default)]
pub struct MineRefereeParams {}

/// A report as near as this is right, level, m.
const RIGHT_M: f64 = 1.5;
/// And as near as this in height: people are seen by their middles, m.
const HEIGHT_M: f64 = 2.0;

impl Behavior<Bodiless> for MineReferee {
    type Params = MineRefereeParams;

    fn build(_: MineRefereeParams, kit: &mut Kit<Self, Bodiless>) -> Result<Self, BuildError> {
        kit.once(Time::ZERO, |_, referee| {
            let people = referee.world().people.len() as f64;
            referee.metric("people", people, "1");
            referee.metric("people-found", 0.0, "1");
            referee.metric("people-wrong", 0.0, "1");
        });
        Ok(Self {
            found: BTreeSet::new(),
        })
    }

    fn on_message(&mut self, message: &Message, referee: &mut Cx<'_>) {
        let Some(Report(places)) = message.get() else {
            return;
        };
        let shaft = referee.world().place("shaft");
        let foot = shaft.map_or(DVec3::ZERO, |place| place.position.si());
        let people = &referee.world().people;
        let people: Vec<DVec3> = people.iter().map(|person| person.position.si()).collect();
        let right = |place: &DVec3, person: &DVec3| {
            let off = *place + foot.with_z(0.0) - *person;
            off.truncate().length() < RIGHT_M && (0.0..HEIGHT_M).contains(&off.z)
        };
        let before = self.found.len();
        for (index, person) in people.iter().enumerate() {
            if places.iter().any(|place| right(place, person)) {
                self.found.insert(index);
            }
        }
        let wrong = |place: &&DVec3| !people.iter().any(|person| right(place, person));
        let wrong = places.iter().filter(wrong).count();
        referee.metric("people-wrong", wrong as f64, "1");
        if self.found.len() > before {
            let now_s = referee.now().as_secs_f64();
            if before == 0 {
                referee.metric("time-first", now_s, "s");
            }
            referee.metric("time-last", now_s, "s");
            referee.metric("people-found", self.found.len() as f64, "1");
        }
    }
}
