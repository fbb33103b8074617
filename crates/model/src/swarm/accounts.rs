//! What models draw, and what is left in their batteries.

use super::{Core, Swarm};
use crate::energy::{Accounts, BatteryState, Books, Consumer};
use simbeeotic_kernel::SimTime;
use simbeeotic_radio::RadioState;

impl Swarm {
    /// What a model has drawn up to `now`, its radios' states settled.
    pub(crate) fn accounts(&self, core: &Core, now: SimTime) -> Accounts {
        let mut accounts = core.drawn.at(now);
        let onboard = core.onboard.as_deref();
        match onboard.and_then(|onboard| onboard.off.as_ref()) {
            Some((radios, _)) => accounts.add(radios),
            None => accounts.add(&self.radio_accounts(core, now)),
        }
        if let Some(onboard) = onboard {
            accounts.subtract(&onboard.lapsed);
        }
        accounts
    }

    /// What the books of a model's radios say.
    pub(crate) fn radio_accounts(&self, core: &Core, now: SimTime) -> Accounts {
        let mut accounts = Accounts::default();
        let Some(medium) = &self.medium else {
            return accounts;
        };
        let original = core.onboard.as_deref().and_then(|o| o.original.as_ref());
        let states = [
            (RadioState::Transmit, Consumer::RadioTx),
            (RadioState::Receive, Consumer::RadioRx),
            (RadioState::Listen, Consumer::RadioRx),
            (RadioState::Idle, Consumer::RadioIdle),
            (RadioState::Sleep, Consumer::RadioSleep),
        ];
        for (at, radio) in core.radios.iter().enumerate() {
            if let Some(original) = original {
                original.add(at, medium.spec(*radio), now, &mut accounts);
                continue;
            }
            let usage = medium.usage(*radio, now);
            for (state, consumer) in states {
                accounts.draw(consumer, usage.charge(state));
            }
        }
        accounts
    }

    /// What a model draws now, A.
    pub(crate) fn load_a(&self, core: &Core, now: SimTime) -> f64 {
        let off = core.onboard.as_deref().is_some_and(|o| o.off.is_some());
        let radios = core.radios.iter().filter(|_| !off);
        let radios_a = radios.filter_map(|radio| {
            let medium = self.medium.as_ref()?;
            let currents = &medium.spec(*radio).currents;
            let current = match medium.state(*radio, now) {
                RadioState::Sleep => currents.sleep,
                RadioState::Idle => currents.idle,
                RadioState::Listen | RadioState::Receive => currents.rx,
                RadioState::Transmit => currents.tx,
            };
            Some(current.get())
        });
        core.drawn.current_a() + radios_a.sum::<f64>()
    }

    /// A model's battery as it is at `now`, whenever it was settled last.
    pub(crate) fn battery(&self, core: &Core, now: SimTime) -> Option<(BatteryState, Books)> {
        let mut power = core.onboard.as_deref()?.power.clone()?;
        power.settle(now, &self.accounts(core, now));
        Some((power.state(self.load_a(core, now)), power.books()))
    }
}
