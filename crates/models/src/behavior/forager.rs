//! A bee that minds its battery.

use glam::DVec3;
use simbeeotic_model::check::positive;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Enu, Length, Position, Speed, Velocity};
use simbeeotic_model::{
    BatteryEvent, Bee, Behavior, BuildError, Handle, Kit, Thing, Touch, behavior, params,
};

/// A bee that flies from place to place around its home, goes home when its battery is low, and sets out
/// again when it is charged.
///
/// Its home is a model, a [`charging-hive`](super::charging_hive) as a rule: it comes down on it, switches
/// its motors off at the touch, and waits. It knows its place by a sensor called `position` if it has
/// one, else by the truth.
#[behavior("forager-bee")]
pub struct ForagerBee {
    params: ForagerBeeParams,
    gps: Option<Handle<Position>>,
    chance: Stream,
    errand: Errand,
    /// Where on its home it lands, from the middle.
    spot: DVec3,
}

/// Parameters of [`ForagerBee`].
#[params]
pub struct ForagerBeeParams {
    /// The path of the model that it goes home to.
    pub home: String,
    /// How far from home it forages.
    pub range: Length,
    /// How high above home it flies.
    pub height: Length,
    /// How fast it flies.
    pub speed: Speed,
    /// How far from the middle of its home it lands, at most.
    pub landing_radius: Length,
}

impl Default for ForagerBeeParams {
    fn default() -> Self {
        Self {
            home: "hive".to_owned(),
            range: Length::si(20.0),
            height: Length::si(5.0),
            speed: Speed::si(2.0),
            landing_radius: Length::si(0.35),
        }
    }
}

/// What it is about.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Errand {
    /// On its way to a place, from home's middle.
    Out(DVec3),
    /// On its way home, or coming down on it.
    Home,
    /// Lying on it.
    Rest,
}

/// So near is there, m.
const NEAR_M: f64 = 0.5;
/// Above its spot as precisely as this it comes down, m.
const ABOVE_M: f64 = 0.1;
/// It comes down this fast, m/s.
const SINK_M_S: f64 = 0.4;
/// It brakes over this time, s.
const BRAKE_S: f64 = 2.0;

impl Behavior for ForagerBee {
    type Params = ForagerBeeParams;

    fn build(params: ForagerBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        positive("range", params.range)?;
        positive("height", params.height)?;
        positive("speed", params.speed)?;
        positive("landing_radius", params.landing_radius)?;
        let mut chance = kit.stream("forage");
        let spot = in_disc(&mut chance, params.landing_radius);
        let up = DVec3::Z * params.height.metres();
        Ok(Self {
            gps: kit.optional_sensor("position")?,
            errand: Errand::Out(up),
            params,
            chance,
            spot,
        })
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        let Some(home) = bee.find(&self.params.home).and_then(|id| bee.pose_of(id)) else {
            let path = &self.params.home;
            return bee.fault(format!(
                "has no home: nothing with a body is called `{path}`"
            ));
        };
        let place = match self.gps {
            Some(gps) => bee.read(gps),
            None => bee.position(),
        };
        let here = (place - home.position).si();
        let wanted = match self.errand {
            Errand::Out(place) => {
                if (place - here).length() < NEAR_M {
                    self.errand = Errand::Out(self.next_place());
                }
                self.toward(place - here)
            }
            Errand::Home => self.homeward(here),
            Errand::Rest => DVec3::ZERO,
        };
        let wanted = Velocity::<Enu>::from_si(wanted);
        let wanted = bee.attitude().unrotate(wanted);
        bee.fly(wanted);
    }

    fn on_battery(&mut self, event: BatteryEvent, bee: &mut Bee<'_>) {
        match event {
            BatteryEvent::Low => {
                bee.log("low, goes home");
                self.errand = Errand::Home;
            }
            BatteryEvent::Charged => {
                bee.log("charged, sets out");
                bee.hover(true);
                self.errand = Errand::Out(DVec3::Z * self.params.height.metres());
            }
            _ => bee.log("out of power"),
        }
    }

    fn on_contact(&mut self, touch: &Touch, bee: &mut Bee<'_>) {
        let home = bee.find(&self.params.home).map(Thing::Model);
        if self.errand == Errand::Home && Some(touch.other) == home {
            self.errand = Errand::Rest;
            bee.hover(false);
            bee.fly(Velocity::ZERO);
        }
    }
}

impl ForagerBee {
    fn next_place(&mut self) -> DVec3 {
        let level = in_disc(&mut self.chance, self.params.range);
        let height = self.chance.uniform_in(0.5..1.5) * self.params.height.metres();
        level + DVec3::Z * height
    }

    /// The velocity that brings it along `way` and stops there.
    fn toward(&self, way: DVec3) -> DVec3 {
        (way / BRAKE_S).clamp_length_max(self.params.speed.get())
    }

    /// First over its spot, then down.
    fn homeward(&self, here: DVec3) -> DVec3 {
        let over = self.spot + DVec3::Z * (0.5 * self.params.height.metres());
        let aside = (self.spot - here).truncate();
        if aside.length() > ABOVE_M {
            self.toward(over - here)
        } else {
            (aside / BRAKE_S).extend(-SINK_M_S)
        }
    }
}

/// A place in a level disc, each as likely.
fn in_disc(chance: &mut Stream, radius: Length) -> DVec3 {
    let radius_m = radius.metres();
    loop {
        let (x, y) = (chance.uniform_in(-1.0..1.0), chance.uniform_in(-1.0..1.0));
        if x * x + y * y <= 1.0 {
            return DVec3::new(x, y, 0.0) * radius_m;
        }
    }
}
