//! The electrics of one platform: its battery, what it has drawn in energy, and what became of it.

use super::battery::{Battery, OnEmpty, Supply};
use super::cell::Cell;
use super::drawn::seconds;
use super::{Accounting, Accounts, Consumer, Original};
use crate::timer::TimerHandle;
use simbeeotic_kernel::SimTime;
use simbeeotic_units::{Charge, Current, Energy, Force, Voltage};
use std::sync::Arc;

/// What happened to a battery: [`Behavior::on_battery`](crate::Behavior::on_battery).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BatteryEvent {
    /// Its state of charge has fallen to `low`: time to go home.
    Low,
    /// It is empty but for its reserve: what `on_empty` says happens right after this call.
    Empty,
    /// The reserve is used up too: everything stops right after this call.
    Flat,
    /// A charger has filled it: the platform flies again as its behaviour wants.
    Charged,
}

/// Whether a platform still does as its behaviour wants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Condition {
    /// It does.
    #[default]
    Fit,
    /// It sinks, and will switch its motors off.
    Landing,
    /// Its motors are off; computer, sensors and radio live on.
    Grounded,
    /// Everything is off.
    Off,
}

/// A battery at one instant: the truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BatteryState {
    /// Charge held.
    pub charge: Charge,
    /// The same as a fraction of a full battery's, 0 to 1.
    pub soc: f64,
    /// Voltage at its terminals.
    pub voltage: Voltage,
    /// Current that it gives; below zero while it is charged.
    pub current: Current,
    /// Whether a charger is connected.
    pub on_charger: bool,
    /// What became of its platform.
    pub condition: Condition,
}

/// What the motors were asked for last.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Effort {
    /// Thrust of all motors together.
    pub thrust: Force,
    /// The same as a fraction of the most that they give, 0 to 1.
    pub fraction: f64,
}

/// The energy of one battery, from the start of the run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Books {
    /// Energy handed to each consumer, in the order of [`Consumer::ALL`], J.
    pub(crate) energy_j: [f64; Consumer::ALL.len()],
    /// Energy that the charge at the start carried.
    pub start: Energy,
    /// Energy that the charge now carries.
    pub stored: Energy,
    /// Energy that chargers gave, to the battery and to the loads beside it.
    pub charged: Energy,
    /// Energy turned into heat in the battery.
    pub heat: Energy,
    /// Charge at the start.
    pub start_charge: Charge,
    /// Charge that chargers gave, to the battery and to the loads beside it.
    pub charged_charge: Charge,
    /// Charge that flowed into it and was not stored.
    pub lost_charge: Charge,
    /// How often it was empty.
    pub empties: u32,
    /// How often it was charged until full.
    pub fills: u32,
}

impl Books {
    /// Energy handed to a consumer.
    pub fn used(&self, consumer: Consumer) -> Energy {
        Energy::si(self.energy_j[consumer as usize])
    }
}

/// A charger that is connected.
#[derive(Clone, Copy, Debug)]
struct Charger {
    current_a: f64,
    until: SimTime,
}

/// One battery in use.
#[derive(Clone, Debug)]
pub(crate) struct Power {
    supply: Arc<Supply>,
    cell: Cell,
    /// Up to when it is settled, and what had been drawn by then.
    since: SimTime,
    drawn: Accounts,
    energy_j: [f64; Consumer::ALL.len()],
    start: Cell,
    charger: Option<Charger>,
    pub(crate) condition: Condition,
    low_told: bool,
    full_told: bool,
    empties: u32,
    fills: u32,
    /// When it was last seen sinking, while it lands.
    pub(crate) sinking: SimTime,
    pub(crate) timer: Option<TimerHandle>,
}

impl Power {
    /// `None` without a battery.
    pub(crate) fn new(supply: &Arc<Supply>) -> Option<Self> {
        let battery = supply.battery.as_ref()?;
        let cell = Cell {
            charge_c: battery.start * battery.capacity_c,
            ..Cell::default()
        };
        Some(Self {
            supply: Arc::clone(supply),
            cell,
            since: SimTime::ZERO,
            drawn: Accounts::default(),
            energy_j: Default::default(),
            start: cell,
            charger: None,
            condition: Condition::Fit,
            low_told: false,
            full_told: false,
            empties: 0,
            fills: 0,
            sinking: SimTime::ZERO,
            timer: None,
        })
    }

    pub(crate) fn battery(&self) -> &Battery {
        match &self.supply.battery {
            Some(battery) => battery,
            None => unreachable!("power is only made of a supply with a battery"),
        }
    }

    /// Goes on to `now`, by when `drawn` has been drawn.
    pub(crate) fn settle(&mut self, now: SimTime, drawn: &Accounts) {
        let battery = match &self.supply.battery {
            Some(battery) => battery,
            None => return,
        };
        let parts_c = drawn.since(&self.drawn);
        let load_c: f64 = parts_c.iter().sum();
        let span_s = seconds(self.since, now);
        let mean_v = if span_s > 0.0 {
            let load_a = load_c / span_s;
            let charged_s = match self.charger {
                Some(charger) => seconds(self.since, charger.until.min(now)),
                None => 0.0,
            };
            let charger_a = self.charger.map_or(0.0, |charger| charger.current_a);
            let mut volt_seconds = 0.0;
            if charged_s > 0.0 {
                let mean_v = self.cell.charge(battery, charged_s, charger_a, load_a);
                volt_seconds += mean_v * charged_s;
            }
            let left_s = span_s - charged_s;
            if left_s > 0.0 {
                volt_seconds += self.cell.discharge(battery, left_s, load_a) * left_s;
            }
            volt_seconds / span_s
        } else {
            self.cell.take(battery, load_c)
        };
        for (energy_j, part_c) in self.energy_j.iter_mut().zip(parts_c) {
            *energy_j += part_c * mean_v;
        }
        (self.since, self.drawn) = (now, *drawn);
        self.charger = self.charger.filter(|charger| charger.until > now);
    }

    /// What happens to it now, if anything; each event once. It was settled just before.
    pub(crate) fn due(&mut self, load_a: f64) -> Option<BatteryEvent> {
        let battery = self.battery();
        let close_c = 1e-9 * battery.capacity_c;
        let (held_c, full) = (self.cell.charge_c, self.cell.is_full(battery));
        let below = |threshold_c: f64| held_c <= threshold_c + close_c;
        let filling = self.inflow_a(load_a) > 0.0;
        let low = below(battery.low * battery.capacity_c);
        let recovered = held_c > (battery.low + 0.05).min(1.0) * battery.capacity_c;
        let empty = below(battery.empty_c(load_a)) && !filling;
        let flat = below(0.0) && !filling;
        if recovered {
            self.low_told = false;
        }
        if self.charger.is_none() {
            self.full_told = false;
        }
        if self.charger.is_some() && full && !self.full_told {
            (self.full_told, self.low_told) = (true, false);
            self.fills += 1;
            return Some(BatteryEvent::Charged);
        }
        if low && !self.low_told && !filling && self.condition == Condition::Fit {
            self.low_told = true;
            return Some(BatteryEvent::Low);
        }
        if empty && self.condition == Condition::Fit {
            self.empties += 1;
            return Some(BatteryEvent::Empty);
        }
        (flat && self.condition != Condition::Off).then_some(BatteryEvent::Flat)
    }

    /// What becomes of the platform after an event.
    pub(crate) fn consequence(&self, event: BatteryEvent) -> Condition {
        let battery = self.battery();
        match (event, battery.on_empty) {
            (BatteryEvent::Low, _) => self.condition,
            (BatteryEvent::Charged, _) => Condition::Fit,
            (BatteryEvent::Flat, _) | (BatteryEvent::Empty, OnEmpty::Stop) => Condition::Off,
            (BatteryEvent::Empty, OnEmpty::Land) => Condition::Landing,
            (BatteryEvent::Empty, OnEmpty::Fall) if battery.electronics => Condition::Grounded,
            (BatteryEvent::Empty, OnEmpty::Fall) => Condition::Off,
        }
    }

    /// How long until the next threshold under this load, s. `None`: it never comes there.
    pub(crate) fn next_s(&self, load_a: f64, now: SimTime) -> Option<f64> {
        let battery = self.battery();
        if let Some(charger) = self.charger {
            return Some(seconds(now, charger.until));
        }
        let low_c = battery.low * battery.capacity_c;
        let mut next_c: f64 = match self.condition {
            Condition::Off => return None,
            Condition::Fit => battery.empty_c(load_a),
            _ => 0.0,
        };
        if self.condition == Condition::Fit && !self.low_told {
            next_c = next_c.max(low_c);
        }
        (load_a > 0.0).then(|| (self.cell.charge_c - next_c).max(0.0) / load_a)
    }

    /// A charger is connected. It must be settled.
    pub(crate) fn plug(&mut self, current: Current, until: SimTime) {
        let current_a = current.get();
        // What comes full and fit has nothing to be told.
        if self.charger.is_none() && self.is_full() && self.condition == Condition::Fit {
            self.full_told = true;
        }
        if current_a > 0.0 && current_a.is_finite() {
            self.charger = Some(Charger { current_a, until });
        }
    }

    /// Whether it takes no more.
    pub(crate) fn is_full(&self) -> bool {
        self.cell.is_full(self.battery())
    }

    fn inflow_a(&self, load_a: f64) -> f64 {
        match self.charger {
            Some(charger) => self.cell.inflow(self.battery(), charger.current_a, load_a),
            None => -load_a,
        }
    }

    /// It as it is now. It must be settled.
    pub(crate) fn state(&self, load_a: f64) -> BatteryState {
        let battery = self.battery();
        let inflow_a = self.inflow_a(load_a);
        BatteryState {
            charge: Charge::si(self.cell.charge_c.max(0.0)),
            soc: self.cell.soc(battery),
            voltage: Voltage::si(self.cell.open_v(battery) + battery.resistance_ohm * inflow_a),
            current: Current::si(-inflow_a),
            on_charger: self.charger.is_some(),
            condition: self.condition,
        }
    }

    /// Its books. It must be settled.
    pub(crate) fn books(&self) -> Books {
        let battery = self.battery();
        Books {
            energy_j: self.energy_j,
            start: Energy::si(self.start.stored_j(battery)),
            stored: Energy::si(self.cell.stored_j(battery)),
            charged: Energy::si(self.cell.charger_j),
            heat: Energy::si(self.cell.heat_j),
            start_charge: Charge::si(self.start.charge_c),
            charged_charge: Charge::si(self.cell.charger_c),
            lost_charge: Charge::si(self.cell.lost_c),
            empties: self.empties,
            fills: self.fills,
        }
    }
}

/// What some platforms have besides their accounts; most have none of it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Onboard {
    pub(crate) power: Option<Power>,
    pub(crate) original: Option<Original>,
    /// Whether a sensor wants to know what the motors are asked for, and what they were.
    pub(crate) watched: bool,
    pub(crate) effort: Effort,
    /// Whether a sensor wants to know what is heard.
    pub(crate) ears: bool,
    /// What sensors and computer draw while they are on.
    pub(crate) constant: [Current; 2],
    /// While all is off: what the radios' books said then, and which were switched off for it.
    pub(crate) off: Option<(Accounts, Vec<u8>)>,
    /// What the radios' books say of times when all was off: they drew none of it.
    pub(crate) lapsed: Accounts,
}

impl Onboard {
    /// What this supply brings along.
    pub(crate) fn new(supply: Option<&Arc<Supply>>, radios: usize) -> Self {
        let Some(supply) = supply else {
            return Self::default();
        };
        Self {
            power: Power::new(supply),
            original: (supply.accounting == Accounting::Original).then(|| Original::new(radios)),
            constant: [Current::ZERO, supply.avionics],
            ..Self::default()
        }
    }

    /// Whether there is nothing to it.
    pub(crate) fn is_empty(&self) -> bool {
        self.power.is_none() && self.original.is_none() && !self.watched && !self.ears
    }

    pub(crate) fn condition(&self) -> Condition {
        self.power.as_ref().map_or(Condition::Fit, |p| p.condition)
    }
}
