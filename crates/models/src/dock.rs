//! A deck on which vehicles land and are charged: a value that a station's behaviour owns.
//!
//! As with the [layers on radio](crate::net), whoever wants a hive of his own owns a [`Dock`] and calls it:
//!
//! ```
//! use simbeeotic_model::prelude::*;
//! use simbeeotic_models::dock::{Dock, DockParams};
//!
//! /// A hive that counts who rests on it.
//! #[behavior("counting-hive", host = Station)]
//! pub struct CountingHive {
//!     dock: Dock,
//! }
//!
//! impl Behavior<Station> for CountingHive {
//!     type Params = DockParams;
//!
//!     fn build(params: DockParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
//!         kit.every(params.period, Self::look);
//!         Ok(Self { dock: Dock::new(params)? })
//!     }
//!
//!     fn body(params: &DockParams) -> Option<BodySpec> {
//!         Some(params.body())
//!     }
//!
//!     fn on_message(&mut self, message: &Message, hive: &mut Platform<'_>) {
//!         if self.dock.heard(message) {
//!             return; // an answer to its charger
//!         }
//!         // What is told by somebody who lies on the deck went through its contacts.
//!         if self.dock.holds(message.sender) {
//!             hive.log(format!("a word of {}", hive.path_of(message.sender)));
//!         }
//!     }
//! }
//!
//! impl CountingHive {
//!     fn look(&mut self, hive: &mut Platform<'_>) {
//!         self.dock.look(hive);
//!         hive.metric("guests", self.dock.guests().count() as f64, "1");
//!     }
//! }
//! ```

use glam::DVec3;
use simbeeotic_model::check::{in_range, positive};
use simbeeotic_model::kernel::ModelId;
use simbeeotic_model::physics::{BodySpec, Kind, Mobility, Shape, group};
use simbeeotic_model::units::{Current, Length, Speed, Time};
use simbeeotic_model::{BuildError, Message, Platform, Plug, Plugged, params};
use std::collections::BTreeMap;

/// Who rests on a deck, and whom it charges.
///
/// At each [`look`](Self::look) it sees who rests within the deck's radius of its middle, at the height of the
/// box or on top of it (so also, where the radius is larger than the box, on the ground beside it), and connects as many as it has pads, those first who came first (of those who came within one
/// period, by number). Whoever is full makes room for the next, and is connected again only after it has
/// left. Charging is at constant current, then at constant voltage: see `simbeeotic_model::energy`.
#[derive(Clone, Debug)]
pub struct Dock {
    params: DockParams,
    guests: BTreeMap<ModelId, Guest>,
    arrivals: u64,
}

/// Parameters of a [`Dock`].
#[params]
pub struct DockParams {
    /// Edge of the box, seen from above.
    pub width: Length,
    /// Height of the box, which stands on its start position.
    pub height: Length,
    /// How many are charged at a time, 1 to 100,000.
    pub pads: u32,
    /// How far from its middle it charges, level. Pads beyond the box lie on the ground around it.
    pub pad_radius: Length,
    /// The most that one pad gives.
    pub current: Current,
    /// Time between two looks.
    pub period: Time,
}

impl Default for DockParams {
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

impl DockParams {
    /// The body of the station: a solid box that stands on its start.
    #[must_use]
    pub fn body(&self) -> BodySpec {
        let (width, height) = (self.width.metres(), self.height.metres());
        let half_m = 0.5 * DVec3::new(width, width, height);
        BodySpec {
            p_enu: DVec3::new(0.0, 0.0, half_m.z),
            mobility: Mobility::Fixed,
            group: group::HIVE,
            kind: Some(Kind::Station),
            ..BodySpec::new(Shape::Box { half_m }, 1.0)
        }
    }
}

/// Slower than this is at rest.
const REST: Speed = Speed::si(0.05);
/// What rests on the box may hover by this little.
const GAP_M: f64 = 0.02;
/// Looks that a guest may leave unanswered: it has no battery.
const PATIENCE: u32 = 2;

/// Somebody on the deck.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guest {
    /// The number of its arrival: 0 for the first that ever came.
    pub arrival: u64,
    /// Whether its battery took no more when last asked.
    pub full: bool,
    unanswered: u32,
}

impl Dock {
    /// An empty deck.
    ///
    /// # Errors
    /// Parameters out of range.
    pub fn new(params: DockParams) -> Result<Self, BuildError> {
        positive("width", params.width)?;
        positive("height", params.height)?;
        in_range("pads", params.pads, 1..=100_000)?;
        positive("pad_radius", params.pad_radius)?;
        positive("current", params.current)?;
        positive("period", params.period)?;
        Ok(Self {
            params,
            guests: BTreeMap::new(),
            arrivals: 0,
        })
    }

    /// Looks who rests here, and charges them for the next period and a half: to be called once a
    /// [`period`](DockParams::period).
    pub fn look(&mut self, platform: &mut Platform<'_>) {
        let present = self.resting(platform);
        self.guests
            .retain(|id, _| present.binary_search(id).is_ok());
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

    /// Takes the answer of a battery on the deck. `false`: the message is something else.
    pub fn heard(&mut self, message: &Message) -> bool {
        let Some(answer) = message.get::<Plugged>() else {
            return false;
        };
        if let Some(guest) = self.guests.get_mut(&message.sender) {
            (guest.full, guest.unanswered) = (answer.full, 0);
        }
        true
    }

    /// Whether this model rested on the deck at the last look.
    #[must_use]
    pub fn holds(&self, id: ModelId) -> bool {
        self.guests.contains_key(&id)
    }

    /// Who rested on the deck at the last look, by number.
    pub fn guests(&self) -> impl Iterator<Item = (ModelId, Guest)> {
        self.guests.iter().map(|(id, guest)| (*id, *guest))
    }

    /// Who lies on the deck, by number.
    fn resting(&self, platform: &Platform<'_>) -> Vec<ModelId> {
        let hive = platform.position();
        let half_m = 0.5 * self.params.height.metres();
        let pad_m = self.params.pad_radius.metres();
        // Nothing that rests here is bigger than the deck.
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
        let body = DockParams::default().body();
        assert_eq!(body.p_enu, DVec3::new(0.0, 0.0, 0.1));
        assert_eq!(body.mobility, Mobility::Fixed);
        assert!(body.check().is_ok());
    }
}
