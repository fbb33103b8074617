//! Figure 11 of the paper: a load for measuring the simulator.

use super::walk::Walk;
use crate::phase::Phase;
use simbeeotic_model::check::{at_least_zero, positive};
use simbeeotic_model::radio::Packet;
use simbeeotic_model::units::{Angle, Heading, Speed, Time};
use simbeeotic_model::{Bee, Behavior, BuildError, Handle, Kit, RadioHandle, behavior, params};

/// A bee that wanders, reads its compass and broadcasts: a load for measuring the simulator.
///
/// It walks at random at each step of its vehicle's control law (10 Hz unless changed), reads the
/// compass once a second, and, if it carries a radio, broadcasts four bytes once a second and counts
/// the bytes that it hears. This is the workload of the paper's figures 6 to 8.
#[behavior(
    "instrument-bee",
    java = "harvard.robobees.simbeeotic.example.InstrumentBee"
)]
pub struct InstrumentBee {
    walk: Walk,
    compass: Option<Handle<Heading>>,
    radio: Option<RadioHandle>,
    heard_bytes: u64,
}

/// Parameters of [`InstrumentBee`].
#[params]
pub struct InstrumentBeeParams {
    /// Top speed of the walk.
    pub max_speed: Speed,
    /// Standard deviation of each change of the velocity, forward and up.
    pub velocity_sigma: Speed,
    /// Standard deviation of each turn.
    pub heading_sigma: Angle,
    /// Time between readings of the compass.
    pub sensor_period: Time,
    /// Time between packets.
    pub radio_period: Time,
    /// Whether it uses its radio, if it carries one.
    pub use_radio: bool,
    /// When sensor and radio are first used.
    pub phase: Phase,
}

impl Default for InstrumentBeeParams {
    fn default() -> Self {
        Self {
            max_speed: Speed::si(2.0),
            velocity_sigma: Speed::si(0.2),
            heading_sigma: Angle::si(0.2),
            sensor_period: Time::si(1.0),
            radio_period: Time::si(1.0),
            use_radio: true,
            phase: Phase::Aligned,
        }
    }
}

impl Behavior for InstrumentBee {
    type Params = InstrumentBeeParams;

    fn build(params: InstrumentBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        at_least_zero("max_speed", params.max_speed)?;
        at_least_zero("velocity_sigma", params.velocity_sigma)?;
        at_least_zero("heading_sigma", params.heading_sigma)?;
        positive("sensor_period", params.sensor_period)?;
        positive("radio_period", params.radio_period)?;

        let first = |period| params.phase.first(period, kit.stream(Phase::PURPOSE));
        let (look, talk) = (first(params.sensor_period), first(params.radio_period));
        let compass = kit.optional_sensor("compass")?;
        if compass.is_some() {
            kit.every_from(look, params.sensor_period, Self::look);
        }
        let radio = kit.optional_radio().filter(|_| params.use_radio);
        if radio.is_some() {
            kit.every_from(talk, params.radio_period, Self::talk);
        }
        let walk = Walk {
            heading_sigma: params.heading_sigma,
            velocity_sigma: params.velocity_sigma,
            max_speed: params.max_speed,
        };
        Ok(Self {
            walk,
            compass,
            radio,
            heard_bytes: 0,
        })
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        self.walk.step(bee);
    }

    fn on_packet(&mut self, packet: &Packet<'_>, _bee: &mut Bee<'_>) {
        self.heard_bytes += packet.payload().len() as u64;
    }
}

impl InstrumentBee {
    fn look(&mut self, bee: &mut Bee<'_>) {
        if let Some(compass) = self.compass {
            let _heading = bee.read(compass);
        }
    }

    fn talk(&mut self, bee: &mut Bee<'_>) {
        if let Some(radio) = self.radio {
            bee.send(radio, &[1, 2, 3, 4]);
        }
    }
}
