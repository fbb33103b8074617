//! A body with gear: sensors, radios, energy accounts.

use super::{Cx, Entity};
use crate::behavior::BuildError;
use crate::energy::{Accounts, BatteryState, Books, Condition, Consumer, Effort, Onboard};
use crate::instance::Instance;
use crate::message::Touch;
use crate::sampling::Sample;
use crate::sensor::{AnySensor, Handle};
use crate::swarm::Effect;
use crate::timer::Call;
use crate::view::Truth;
use simbeeotic_radio::{Inbox, Ticket};
use simbeeotic_units::{Charge, Current, Mount, Time};
use std::ops::{Deref, DerefMut};

/// The sensors of one platform, and how many requests its radios had. Radios and accounts live with
/// the model's core.
pub struct Gear {
    sensors: Box<[Box<dyn AnySensor>]>,
    /// The ticket of the next request.
    pub(super) ticket: Ticket,
    /// Whether the behaviour wants to hear what became of each request.
    pub(crate) receipts: bool,
}

impl Gear {
    /// The calls of sensors that measure by themselves: first sample, period and delay of each.
    pub(crate) fn timings(&self) -> Vec<(usize, [Time; 3])> {
        let sensors = self.sensors.iter().enumerate();
        let timings = sensors.filter_map(|(at, sensor)| {
            let (first, period, delay) = sensor.timing()?;
            Some((at, [first, period, delay]))
        });
        timings.collect()
    }

    /// Has `call` made for each sample of a sensor that arrives. Whether it has a rate.
    pub(crate) fn on_sample(&mut self, sensor: u16, call: Call) -> bool {
        self.sensors[usize::from(sensor)].on_sample(call)
    }

    pub(crate) fn assemble(instance: &mut Instance<'_>) -> Result<Self, BuildError> {
        instance.add_radios()?;
        let supply = instance.gear.supply.as_ref();
        instance.onboard = Onboard::new(supply, instance.radios.len());
        Ok(Self {
            sensors: instance.sensors()?,
            ticket: Ticket(0),
            receipts: false,
        })
    }
}

/// A body with gear, as its behaviour sees it during one call.
pub struct Platform<'a> {
    pub(super) entity: Entity<'a>,
    pub(super) gear: &'a mut Gear,
}

impl<'a> Platform<'a> {
    #[inline]
    pub(crate) fn new(cx: Cx<'a>, gear: &'a mut Gear) -> Self {
        Self {
            entity: Entity::new(cx),
            gear,
        }
    }

    /// Takes one reading; of a sensor with a rate of its own, the newest sample that has arrived.
    pub fn read<R: 'static>(&mut self, sensor: Handle<R>) -> R {
        self.sample(sensor).reading
    }

    /// The same, and when it was taken.
    pub fn sample<R: 'static>(&mut self, sensor: Handle<R>) -> Sample<R> {
        let mut sample: Option<Sample<R>> = None;
        self.with_sensor(sensor.index, |sensor, truth| {
            sensor.read_into(truth, &mut sample);
        });
        match sample {
            Some(sample) => sample,
            None => unreachable!(
                "a handle's type is checked when it is made, and it fits its own platform"
            ),
        }
    }

    /// Has a sensor with a rate measure, if a sample is due. The behaviour's method to be called if
    /// one arrives now.
    pub(crate) fn take_sample(&mut self, sensor: u16) -> Option<Call> {
        self.with_sensor(sensor, |sensor, truth| {
            sensor.sample(truth);
            sensor.arrived(truth.now)
        })
    }

    /// Tells the sensors that want to know what a radio heard.
    pub(crate) fn heard(&mut self, inbox: Inbox<'_>) {
        let cx = &*self.entity;
        let Some(at) = cx.core.radios.iter().position(|id| *id == inbox.radio()) else {
            return;
        };
        let gear = &cx.swarm.gear[cx.core.id.index()];
        let Some(radio) = gear.radios.get(at) else {
            return;
        };
        for sensor in &mut self.gear.sensors {
            sensor.heard(&radio.name, inbox);
        }
        let spec = cx.swarm.medium.as_ref().map(|m| m.spec(inbox.radio()));
        let (now, frames) = (cx.now(), inbox.iter().map(|p| p.payload().len()));
        let bytes = frames.sum();
        let onboard = self.entity.core.onboard.as_deref_mut();
        if let (Some(spec), Some(original)) = (spec, onboard.and_then(|o| o.original.as_mut())) {
            original.frames(at, spec, false, bytes, now);
        }
    }

    /// Tells the sensors of a touch.
    pub(crate) fn touched(&mut self, touch: &Touch) {
        let mut truth = truth(&self.entity, false);
        for sensor in &mut self.gear.sensors {
            sensor.touched(touch, &mut truth);
        }
    }

    /// Lets a sensor see the truth as it is now, and passes on what it has measured.
    fn with_sensor<T>(
        &mut self,
        index: u16,
        act: impl FnOnce(&mut dyn AnySensor, &mut Truth<'_>) -> T,
    ) -> T {
        let Self { entity, gear } = self;
        let mut truth = truth(entity, entity.swarm.watches(entity.id(), index));
        let answer = act(&mut *gear.sensors[usize::from(index)], &mut truth);
        if let Some(taken) = truth.taken {
            self.entity.out.effect(Effect::Sensed(index, taken));
        }
        answer
    }

    /// Books `charge` on `consumer`, at once.
    #[inline]
    pub fn draw(&mut self, consumer: Consumer, charge: Charge) {
        self.entity.core.drawn.draw(consumer, charge);
    }

    /// From now on `consumer` draws `current`, until it is told otherwise. What it draws is counted
    /// without any event.
    #[inline]
    pub fn set_load(&mut self, consumer: Consumer, current: Current) {
        let now = self.entity.now();
        let core = &mut *self.entity.core;
        if let Some(onboard) = &core.onboard {
            if onboard.off.is_some() {
                return;
            }
            if let Some(original) = &onboard.original {
                return core.drawn.draw(consumer, original.ahead(current));
            }
        }
        core.drawn.load(consumer, current, now);
    }

    /// Notes what the motors are asked for, if a sensor wants to know; `effort` is worked out only
    /// then.
    #[inline]
    pub fn set_effort(&mut self, effort: impl FnOnce() -> Effort) {
        if let Some(onboard) = &mut self.entity.core.onboard
            && onboard.watched
        {
            onboard.effort = effort();
        }
    }

    /// The battery as it truly is now; `None` if there is none on board.
    pub fn battery(&self) -> Option<BatteryState> {
        let cx = &*self.entity;
        Some(cx.swarm.battery(cx.core, cx.now())?.0)
    }

    /// The energy that the battery gave and took up to now; `None` if there is none on board.
    pub fn energy(&self) -> Option<Books> {
        let cx = &*self.entity;
        Some(cx.swarm.battery(cx.core, cx.now())?.1)
    }

    /// Whether it still does as its behaviour wants. Without a battery it always does.
    pub fn condition(&self) -> Condition {
        let onboard = self.entity.core.onboard.as_deref();
        onboard.map_or(Condition::Fit, Onboard::condition)
    }

    /// What this platform has drawn up to now, its radios included.
    pub fn accounts(&self) -> Accounts {
        self.entity
            .swarm
            .accounts(self.entity.core, self.entity.now())
    }
}

/// The truth about a body as its sensors see it now; `watched`: somebody looks at what they measure.
fn truth<'t>(entity: &'t Entity<'_>, watched: bool) -> Truth<'t> {
    Truth {
        now: entity.now(),
        pose: entity.pose(),
        twist: entity.twist(),
        motion: entity.motion(),
        host: entity.id(),
        mount: Mount::IDENTITY,
        swarm: entity.swarm,
        watched,
        core: &*entity.core,
        taken: None,
    }
}

super::says!(Platform, entity);

impl<'a> Deref for Platform<'a> {
    type Target = Entity<'a>;
    fn deref(&self) -> &Entity<'a> {
        &self.entity
    }
}

impl DerefMut for Platform<'_> {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.entity
    }
}
