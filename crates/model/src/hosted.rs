//! A behaviour on its host: the model behind every vehicle, station and planner.

use crate::behavior::{Behavior, BuildError, Declared, Handler, SentHandler};
use crate::energy::{BatteryEvent, Plug};
use crate::host::{Cx, Host, Platform, Unsent, supply};
use crate::instance::Instance;
use crate::kit::Kit;
use crate::model::{Model, Wake};
use crate::timer::{Call, TimerHandle};
use simbeeotic_units::Time;
use std::sync::{Arc, OnceLock};

/// Timer 0 belongs to the host's control law, whether it has one or not.
const CONTROL: TimerHandle = TimerHandle::new(0);

/// In this order, so that reading `handlers` and `declared` fetches the memory on both ends, and most
/// of what is between.
#[repr(C)]
pub(crate) struct Hosted<B, H: Host> {
    handlers: Handlers<B, H>,
    behavior: B,
    host: H,
    sent: Option<SentHandler<B, H>>,
    declared: Box<[Declared]>,
}

/// The methods that timers call, by [`Call`]: the same for all models of a section, as a rule, and
/// then kept once.
pub(crate) type Handlers<B, H> = Arc<[Handler<B, H>]>;

impl<B: Behavior<H>, H: Host> Hosted<B, H> {
    /// Builds the model. `known` are the handlers of another of its kind, to be shared.
    pub(crate) fn build(
        params: B::Params,
        instance: &mut Instance<'_>,
        known: &OnceLock<Handlers<B, H>>,
    ) -> Result<Self, BuildError> {
        let mut host = H::assemble(instance, B::body(&params))?;
        let mut kit = Kit::new(instance);
        let behavior = B::build(params, &mut kit)?;
        for (name, sensor, call) in std::mem::take(&mut kit.listeners) {
            let rated = host.gear().is_some_and(|gear| gear.on_sample(sensor, call));
            if !rated {
                let message = format!(
                    "it waits for samples of `{name}`, which measures on demand; give it a `rate`"
                );
                kit.fault.get_or_insert(BuildError::other(message));
            }
        }
        if let Some(gear) = host.gear() {
            gear.receipts = kit.sent.is_some();
        }
        match kit.fault {
            Some(fault) => Err(fault),
            None => Ok(Self {
                behavior,
                host,
                sent: kit.sent,
                handlers: share(kit.handlers, known),
                declared: kit.declared.into(),
            }),
        }
    }
}

/// The known handlers if these are the same, else these. Two of one address do the same; that one
/// may have two addresses costs some bytes.
fn share<B, H: Host>(
    handlers: Vec<Handler<B, H>>,
    known: &OnceLock<Handlers<B, H>>,
) -> Handlers<B, H> {
    let address = |handler: &Handler<B, H>| *handler as *const ();
    let shared = known.get_or_init(|| handlers.clone().into());
    if shared.iter().map(address).eq(handlers.iter().map(address)) {
        Arc::clone(shared)
    } else {
        handlers.into()
    }
}

impl<B: Behavior<H>, H: Host> Model for Hosted<B, H> {
    fn start(&mut self, cx: &mut Cx<'_>) {
        let control = self.host.control_timing();
        cx.create_timer(Call::CONTROL, control.map(|c| c.0), control.map(|c| c.1));
        for timer in std::mem::take(&mut self.declared) {
            cx.create_timer(timer.call, timer.first, timer.period);
        }
        cx.start_supply(control.map(|c| c.1));
        let timings = self.host.gear().map(|gear| gear.timings());
        for (sensor, [first, period, delay]) in timings.unwrap_or_default() {
            let Some(call) = Call::sensor(sensor) else {
                continue;
            };
            cx.create_timer(call, Some(first), Some(period));
            if delay > Time::ZERO {
                cx.create_timer(call, Some(first + delay), Some(period));
            }
        }
    }

    fn wake(&mut self, wake: Wake<'_>, cx: &mut Cx<'_>) {
        // Most models have nothing of that kind on board.
        if cx.core.onboard.is_none() {
            return self.act(&wake, cx);
        }
        self.supplied(&wake, cx);
    }

    fn touch(&self) -> u64 {
        self.handlers.len() as u64 ^ self.declared.len() as u64 ^ self.host.touch()
    }

    fn finish(&mut self, cx: &mut Cx<'_>) {
        self.behavior.on_finish(&mut self.host.view(cx.reborrow()));
        self.host.finish(cx.reborrow());
    }
}

impl<B: Behavior<H>, H: Host> Hosted<B, H> {
    /// What a wake-up is for.
    #[inline]
    fn act(&mut self, wake: &Wake<'_>, cx: &mut Cx<'_>) {
        let Self {
            behavior,
            host,
            handlers,
            sent,
            ..
        } = self;
        match *wake {
            Wake::Timer(CONTROL) => {
                behavior.on_control(&mut host.view(cx.reborrow()));
                host.control(cx.reborrow());
            }
            Wake::Timer(timer) => {
                let mut call = cx.call_of(timer);
                if let Some(sensor) = call.as_sensor() {
                    let Some(gear) = host.gear() else { return };
                    let platform = &mut Platform::new(cx.reborrow(), gear);
                    let Some(heard) = platform.take_sample(sensor) else {
                        return;
                    };
                    call = heard;
                }
                if let Some(handler) = handlers.get(usize::from(call.0)) {
                    handler(behavior, &mut host.view(cx.reborrow()));
                }
            }
            // A charger's, on something without a battery.
            Wake::Message(message) if message.get::<Plug>().is_some() => {}
            Wake::Message(message) if message.get::<Unsent>().is_some() => {
                if let (Some(Unsent(outcome)), Some(sent)) = (message.get(), sent) {
                    sent(behavior, outcome, &mut host.view(cx.reborrow()));
                }
            }
            Wake::Message(message) => {
                behavior.on_message(message, &mut host.view(cx.reborrow()));
            }
            Wake::Packets(inbox) => {
                let view = &mut host.view(cx.reborrow());
                if let Some(sent) = sent {
                    for outcome in inbox.outcomes() {
                        sent(behavior, outcome, view);
                    }
                }
                behavior.on_packets(inbox, view);
            }
            Wake::Touch(touch) => {
                if let Some(gear) = host.gear() {
                    Platform::new(cx.reborrow(), gear).touched(touch);
                }
                behavior.on_contact(touch, &mut host.view(cx.reborrow()));
            }
        }
    }

    /// The same on a platform with a battery, or with sensors that listen along.
    fn supplied(&mut self, wake: &Wake<'_>, cx: &mut Cx<'_>) {
        let mut touched = false;
        match wake {
            Wake::Message(message) if cx.plugged(message) => {}
            // Nobody is there to hear of it.
            _ if cx.is_off() => {}
            Wake::Packets(inbox) => {
                if let Some(gear) = self.host.gear() {
                    Platform::new(cx.reborrow(), gear).heard(*inbox);
                }
                self.act(wake, cx);
            }
            Wake::Touch(touch) => {
                touched = touch.normal[2] < -0.5;
                self.act(wake, cx);
            }
            _ => self.act(wake, cx),
        }
        if cx.power().is_none() {
            return;
        }
        if let Some(gear) = self.host.gear() {
            let down_m_s = -Platform::new(cx.reborrow(), gear).velocity().si().z;
            supply::landed(&mut self.host, touched, down_m_s, cx);
        }
        while let Some(event) = cx.battery_event() {
            // What is charged is told when it is on again, the rest while it still is.
            if event == BatteryEvent::Charged {
                supply::apply(&mut self.host, event, cx);
            }
            let view = self.host.view(cx.reborrow());
            self.behavior.on_battery(event, &mut { view });
            if event != BatteryEvent::Charged {
                supply::apply(&mut self.host, event, cx);
            }
        }
        cx.arm_battery();
    }
}
