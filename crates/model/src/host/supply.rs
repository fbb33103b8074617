//! What a host does about its battery.

use super::{Cx, Host};
use crate::energy::{BatteryEvent, Condition, Consumer, Plug, Plugged, Power};
use crate::message::Message;
use crate::swarm::Effect;
use crate::timer::Call;
use simbeeotic_radio::{Command, RadioState};
use simbeeotic_units::Time;

/// Under 90 % of the way to a threshold the timer is not moved: a load that changes a little does not
/// leave an event behind each time.
const SHARE: f64 = 0.9;
/// From here on the timer aims at the threshold itself, s.
const NEAR_S: f64 = 1.0;
/// The timer does not fire twice within this, s.
const LEAST_S: f64 = 1e-6;
/// A landing vehicle that has not sunk for so long stands on something, s.
const STILL_S: f64 = 1.0;

impl Cx<'_> {
    /// Whether everything is off for want of power.
    #[inline]
    pub(crate) fn is_off(&self) -> bool {
        let onboard = self.core.onboard.as_deref();
        onboard.is_some_and(|onboard| onboard.off.is_some())
    }

    pub(crate) fn power(&mut self) -> Option<&mut Power> {
        self.core.onboard.as_deref_mut()?.power.as_mut()
    }

    /// Creates the battery's timer, if there is one. `step`: period of the control law.
    pub(crate) fn start_supply(&mut self, step: Option<Time>) {
        let onboard = self.core.onboard.as_deref_mut();
        if let Some(original) = onboard.and_then(|onboard| onboard.original.as_mut()) {
            original.step = step;
        }
        if self.power().is_some() {
            let timer = self.create_timer(Call::BATTERY, Some(Time::ZERO), None);
            if let Some(power) = self.power() {
                power.timer = Some(timer);
            }
        }
    }

    /// Brings the battery up to now; the present load, A.
    fn settle_battery(&mut self) -> Option<f64> {
        self.core.onboard.as_deref()?.power.as_ref()?;
        let accounts = self.swarm.accounts(self.core, self.now);
        let load_a = self.swarm.load_a(self.core, self.now);
        let now = self.now;
        self.power()?.settle(now, &accounts);
        Some(load_a)
    }

    /// Brings the battery up to now; what has happened to it by that.
    pub(crate) fn battery_event(&mut self) -> Option<BatteryEvent> {
        let load_a = self.settle_battery()?;
        self.power()?.due(load_a)
    }

    /// A charger says that it is connected. Whether the message was that.
    pub(crate) fn plugged(&mut self, message: &Message) -> bool {
        let Some(plug) = message.get::<Plug>() else {
            return false;
        };
        if self.settle_battery().is_some()
            && let Some(power) = self.power()
        {
            power.plug(plug.current, plug.until);
            let full = power.is_full();
            let soc = power.state(0.0).soc;
            self.tell(message.sender, Plugged { soc, full });
        }
        true
    }

    /// Lets the timer fire when the present load has brought the battery to its next threshold, or
    /// somewhat before.
    pub(crate) fn arm_battery(&mut self) {
        let load_a = self.swarm.load_a(self.core, self.now);
        let now = self.now;
        let Some((timer, next_s)) = self.power().and_then(|power| {
            let next_s = power.next_s(load_a, now)?;
            Some((power.timer?, next_s))
        }) else {
            return;
        };
        let armed_s = self.next_firing(timer).map(|at| (at - now).secs());
        if armed_s.is_some_and(|armed_s| armed_s <= next_s) {
            return;
        }
        let wait_s = if next_s > NEAR_S {
            SHARE * next_s
        } else {
            next_s.max(LEAST_S)
        };
        // Rounded up: a nanosecond too early would be once more.
        let wait = Time::from_nanos((wait_s * 1e9).ceil());
        // A load of picoamperes lasts longer than time.
        if wait.secs() < 1e9 {
            self.arm(timer, wait);
        }
    }

    /// Switches everything off.
    fn switch_off(&mut self) {
        let (now, swarm) = (self.now, self.swarm);
        let radios = swarm.radio_accounts(self.core, now);
        self.core.drawn.cut(now);
        let mut silenced = Vec::new();
        if let Some(medium) = &swarm.medium {
            for (at, radio) in self.core.radios.iter().enumerate() {
                if medium.state(*radio, now) != RadioState::Sleep {
                    silenced.push(at as u8);
                    let sleep = Effect::Command(*radio, Command::Sleep);
                    self.out.effect(sleep);
                }
            }
        }
        if let Some(onboard) = self.core.onboard.as_deref_mut() {
            onboard.off = Some((radios, silenced));
        }
    }

    /// Switches everything on again.
    fn switch_on(&mut self) {
        let now = self.now;
        let mut gap = self.swarm.radio_accounts(self.core, now);
        let Some(onboard) = self.core.onboard.as_deref_mut() else {
            return;
        };
        let Some((radios, silenced)) = onboard.off.take() else {
            return;
        };
        gap.subtract(&radios);
        onboard.lapsed.add(&gap);
        let consumers = [Consumer::Sensors, Consumer::Avionics];
        for (consumer, current) in consumers.into_iter().zip(onboard.constant) {
            self.core.drawn.load(consumer, current, now);
        }
        for at in silenced {
            let radio = self.core.radios[usize::from(at)];
            self.out.effect(Effect::Command(radio, Command::Wake));
        }
    }
}

/// Lets what follows from an event happen to a platform.
pub(crate) fn apply<H: Host>(host: &mut H, event: BatteryEvent, cx: &mut Cx<'_>) {
    let now = cx.now;
    let Some(power) = cx.power() else { return };
    let after = power.consequence(event);
    enter(host, after, cx);
    if after == Condition::Landing
        && let Some(power) = cx.power()
    {
        power.sinking = now;
    }
}

fn enter<H: Host>(host: &mut H, after: Condition, cx: &mut Cx<'_>) {
    let Some(power) = cx.power() else { return };
    let before = std::mem::replace(&mut power.condition, after);
    if before == after {
        return;
    }
    if before == Condition::Off {
        cx.switch_on();
    }
    // The control law sees the new condition at once, not at its next step.
    host.control(cx.reborrow());
    if after == Condition::Off {
        cx.switch_off();
    }
}

/// Ends a landing: at a touch from below, or where it does not sink any more. `down_m_s` is how fast it
/// sinks.
pub(crate) fn landed<H: Host>(host: &mut H, touched: bool, down_m_s: f64, cx: &mut Cx<'_>) {
    let now = cx.now;
    let Some(power) = cx.power() else { return };
    if power.condition != Condition::Landing {
        return;
    }
    if down_m_s > 0.25 * power.battery().landing_m_s {
        power.sinking = now;
    }
    if touched || (now - power.sinking).secs() >= STILL_S {
        enter(host, Condition::Grounded, cx);
    }
}
