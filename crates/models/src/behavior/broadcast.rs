//! A bee that drifts and tells its name.

use simbeeotic_model::check::{at_least_zero, positive};
use simbeeotic_model::radio::Packet;
use simbeeotic_model::units::{Flu, Speed, Time, Velocity};
use simbeeotic_model::{Bee, Behavior, BuildError, Kit, RadioHandle, behavior, params};

/// A bee that drifts slowly and broadcasts its name once a second: the smallest example of
/// talking and listening.
#[behavior(
    "broadcast-bee",
    java = "harvard.robobees.simbeeotic.example.BroadcastBee"
)]
pub struct BroadcastBee {
    radio: RadioHandle,
    drift: Velocity<Flu>,
    heard: u64,
}

/// Parameters of [`BroadcastBee`].
#[params]
pub struct BroadcastBeeParams {
    /// Time between packets.
    pub period: Time,
    /// Standard deviation of the drift's velocity, in each direction.
    pub drift_sigma: Speed,
}

impl Default for BroadcastBeeParams {
    fn default() -> Self {
        Self {
            period: Time::si(1.0),
            drift_sigma: Speed::si(0.1),
        }
    }
}

impl Behavior for BroadcastBee {
    type Params = BroadcastBeeParams;

    fn build(params: BroadcastBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        positive("period", params.period)?;
        at_least_zero("drift_sigma", params.drift_sigma)?;
        kit.once(Time::ZERO, Self::set_off);
        kit.every(params.period, Self::talk);
        let mut chance = kit.stream("drift");
        let mut speed = || params.drift_sigma * chance.normal();
        let drift = Velocity::new(speed(), speed(), speed());
        Ok(Self {
            radio: kit.radio()?,
            drift,
            heard: 0,
        })
    }

    fn on_packet(&mut self, packet: &Packet<'_>, bee: &mut Bee<'_>) {
        self.heard += 1;
        if self.heard == 1 {
            let from = bee.path_of(packet.sender()).to_owned();
            bee.log(format!("first heard {from} at {:.1}", packet.rssi()));
        }
    }

    fn on_finish(&mut self, bee: &mut Bee<'_>) {
        bee.log(format!("heard {} packets", self.heard));
    }
}

impl BroadcastBee {
    fn set_off(&mut self, bee: &mut Bee<'_>) {
        bee.fly(self.drift);
    }

    fn talk(&mut self, bee: &mut Bee<'_>) {
        let name = bee.path().to_owned();
        bee.send(self.radio, name.as_bytes());
    }
}
