//! A bee that knows its neighbours by radio.

use super::walk::Walk;
use crate::net::{Beacons, BeaconsParams, Heard};
use simbeeotic_model::check::at_least_zero;
use simbeeotic_model::radio::Packet;
use simbeeotic_model::units::Speed;
use simbeeotic_model::{
    Bee, Behavior, BuildError, Kit, RadioHandle, TimerHandle, behavior, params,
};

/// A bee that wanders, and finds its neighbours by beacons: who is around, and how good the link is
/// there and back. See [`Beacons`].
///
/// With each beacon it publishes the metrics `neighbors` and `bidirectional`: how many it knows, and
/// with how many of them both hear each other.
#[behavior("beacon-bee")]
pub struct BeaconBee {
    walk: Walk,
    radio: RadioHandle,
    beacons: Beacons,
    timer: TimerHandle,
}

/// Parameters of [`BeaconBee`].
#[params]
pub struct BeaconBeeParams {
    /// Top speed of its walk. Zero: it stays where it is.
    pub max_speed: Speed,
    /// How it finds its neighbours.
    pub beacons: BeaconsParams,
}

impl Default for BeaconBeeParams {
    fn default() -> Self {
        Self {
            max_speed: Speed::si(1.0),
            beacons: BeaconsParams::default(),
        }
    }
}

impl Behavior for BeaconBee {
    type Params = BeaconBeeParams;

    fn build(params: BeaconBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        at_least_zero("max_speed", params.max_speed)?;
        let mut beacons = Beacons::new(params.beacons, kit.stream("beacons"))?;
        let timer = kit.once(beacons.first(), Self::beat);
        Ok(Self {
            walk: Walk::up_to(params.max_speed),
            radio: kit.radio()?,
            beacons,
            timer,
        })
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        self.walk.step(bee);
    }

    fn on_packet(&mut self, packet: &Packet<'_>, bee: &mut Bee<'_>) {
        self.beacons.hear(bee.id(), Heard::from(packet));
    }

    fn on_finish(&mut self, bee: &mut Bee<'_>) {
        self.beacons.forget(bee.now());
        let (known, both) = self.count();
        bee.log(format!("knows {known} neighbours, {both} of them know it"));
        let links = self.beacons.neighbors();
        let Some(best) = links.max_by(|a, b| a.inbound().total_cmp(&b.inbound())) else {
            return;
        };
        let (path, rssi) = (bee.path_of(best.address()).to_owned(), best.rssi());
        let (inbound, outbound) = (best.inbound(), best.outbound());
        let back = outbound.map_or("nothing of it".to_owned(), |share| {
            format!("{share:.2} back")
        });
        bee.log(format!(
            "hears {path} best: {inbound:.2}, {back}, {rssi:.1}"
        ));
    }
}

impl BeaconBee {
    fn beat(&mut self, bee: &mut Bee<'_>) {
        let beacon = self.beacons.beacon(bee.now());
        bee.send(self.radio, &beacon);
        bee.arm(self.timer, self.beacons.pause());
        let (known, both) = self.count();
        bee.metric("neighbors", known as f64, "1");
        bee.metric("bidirectional", both as f64, "1");
    }

    /// How many neighbours are known, and how many of them know this bee.
    fn count(&self) -> (usize, usize) {
        let both = self.beacons.neighbors().filter(|n| n.is_bidirectional());
        (self.beacons.neighbors().len(), both.count())
    }
}
