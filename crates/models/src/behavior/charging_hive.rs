//! A hive on which bees recharge.

use crate::dock::{Dock, DockParams};
use simbeeotic_model::host::Station;
use simbeeotic_model::physics::BodySpec;
use simbeeotic_model::{Behavior, BuildError, Kit, Message, Platform, behavior};

/// A solid box with a charger: what rests on top of it is charged.
///
/// Once a period it looks who rests within the pad's radius of its middle, on top of the box or inside,
/// and connects as many as it has pads, those first who came first (of those who came within one period,
/// by number). Whoever is full makes room for the next, and is connected again only after it has left.
/// Charging is at constant current, then at constant voltage: see `simbeeotic_model::energy`. The deck by
/// itself, for a hive of your own, is a [`Dock`].
#[behavior("charging-hive", host = Station)]
pub struct ChargingHive {
    dock: Dock,
}

impl Behavior<Station> for ChargingHive {
    type Params = DockParams;

    fn build(params: DockParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        kit.every(params.period, Self::look);
        Ok(Self {
            dock: Dock::new(params)?,
        })
    }

    fn body(params: &DockParams) -> Option<BodySpec> {
        Some(params.body())
    }

    fn on_message(&mut self, message: &Message, _: &mut Platform<'_>) {
        self.dock.heard(message);
    }
}

impl ChargingHive {
    fn look(&mut self, platform: &mut Platform<'_>) {
        self.dock.look(platform);
    }
}
