//! What is in a battery, and how load and charger change it.
//!
//! Between two looks the load is a constant current `I`, the mean of what was drawn. With `q` the charge
//! held, `Q` the charge of a full battery, `n` cells of open-circuit voltage `V(s)` and the resistance
//! `R` of all:
//!
//! ```text
//! V = n V(q / Q) - R I                 terminal voltage                              (1)
//! dq/dt = -I                           discharge                                     (2)
//! E = n Q (W(q0/Q) - W(q1/Q)) - R I^2 dt     handed out; the rest warms the battery  (3)
//! ```
//! On a charger of current `C` the battery takes `N`, and stores the share `eta` of it:
//!
//! ```text
//! N = min(C - I, N_max, (n V(1) - n V(q/Q)) / R)     constant current, then voltage  (4)
//! dq/dt = eta N                                                                      (5)
//! ```
//! (A curve that is level at its top, as an ideal battery's, has no last case.) In the last case of (4) `V` stands at `n V(1)` and `q` closes in on full exponentially, piece by piece
//! of the curve; when `N` has fallen to `Q` / 20 h (C/20) the battery is full. All of it is in closed form: nothing
//! depends on how often one looks but the mean in (3), which misses what a load that changes between
//! two looks adds to the heat.

use super::battery::Battery;
use simbeeotic_units::math;

/// The state of one battery, in SI units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Cell {
    /// Charge held, C. Below zero by what the last load took too much before it was noticed.
    pub(crate) charge_c: f64,
    /// Energy turned into heat, J.
    pub(crate) heat_j: f64,
    /// Charge that came from chargers, C: what the load took of it, too.
    pub(crate) charger_c: f64,
    /// Energy that came from chargers, J.
    pub(crate) charger_j: f64,
    /// Charge that flowed in and was not stored, C.
    pub(crate) lost_c: f64,
}

impl Cell {
    /// State of charge, 0 to 1.
    pub(crate) fn soc(&self, battery: &Battery) -> f64 {
        (self.charge_c / battery.capacity_c).clamp(0.0, 1.0)
    }

    /// Volts without load.
    pub(crate) fn open_v(&self, battery: &Battery) -> f64 {
        battery.cells * battery.curve.volts(self.charge_c / battery.capacity_c)
    }

    /// Energy in the charge held, J.
    pub(crate) fn stored_j(&self, battery: &Battery) -> f64 {
        let soc = self.charge_c / battery.capacity_c;
        battery.cells * battery.capacity_c * battery.curve.work(soc)
    }

    /// Whether a charger has nothing more to do.
    pub(crate) fn is_full(&self, battery: &Battery) -> bool {
        self.charge_c >= battery.full_c() - 1e-9 * battery.capacity_c
    }

    /// What flows into the battery on a charger, A; below zero: out of it.
    pub(crate) fn inflow(&self, battery: &Battery, charger_a: f64, load_a: f64) -> f64 {
        let offered = charger_a - load_a;
        if offered <= 0.0 {
            offered
        } else if self.is_full(battery) {
            0.0
        } else {
            let most = offered.min(battery.inflow_a);
            let gap_v = battery.full_v() - self.open_v(battery);
            match battery.limiting_ohm() {
                Some(ohm) => most.min(gap_v / ohm),
                None => most,
            }
        }
    }

    /// Goes on by `seconds` under a mean load; the mean terminal voltage meanwhile.
    pub(crate) fn discharge(&mut self, battery: &Battery, seconds: f64, load_a: f64) -> f64 {
        let (charge_c, before_j) = (load_a * seconds, self.stored_j(battery));
        self.charge_c -= charge_c;
        let released_j = before_j - self.stored_j(battery);
        let heat_j = battery.resistance_ohm * load_a * charge_c;
        self.heat_j += heat_j;
        if charge_c > 0.0 {
            (released_j - heat_j) / charge_c
        } else {
            self.open_v(battery)
        }
    }

    /// Takes charge out at once; the mean voltage meanwhile, without sag: a current has no meaning here.
    pub(crate) fn take(&mut self, battery: &Battery, charge_c: f64) -> f64 {
        let before_j = self.stored_j(battery);
        self.charge_c -= charge_c;
        if charge_c > 0.0 {
            (before_j - self.stored_j(battery)) / charge_c
        } else {
            self.open_v(battery)
        }
    }

    /// Goes on by `seconds` on a charger; the mean terminal voltage meanwhile.
    pub(crate) fn charge(
        &mut self,
        battery: &Battery,
        seconds: f64,
        charger_a: f64,
        load_a: f64,
    ) -> f64 {
        let (mut left, mut volt_seconds) = (seconds, 0.0);
        while left > 0.0 {
            let inflow_a = self.inflow(battery, charger_a, load_a);
            let (dt, mean_v) = if inflow_a < 0.0 {
                (left, self.discharge(battery, left, -inflow_a))
            } else {
                self.fill(battery, left, inflow_a)
            };
            // What flows: into the battery by the charge taken, to the load beside it.
            let supplied_c = if inflow_a < 0.0 {
                charger_a * dt
            } else {
                load_a * dt
            };
            self.charger_c += supplied_c;
            self.charger_j += supplied_c * mean_v;
            volt_seconds += mean_v * dt;
            left -= dt;
        }
        if seconds > 0.0 {
            volt_seconds / seconds
        } else {
            self.open_v(battery)
        }
    }

    /// One phase of charging, at most `left` seconds: how long it took, and the mean voltage.
    fn fill(&mut self, battery: &Battery, left: f64, inflow_a: f64) -> (f64, f64) {
        if inflow_a <= 0.0 {
            return (left, self.open_v(battery));
        }
        let before = *self;
        let (eta, ohm) = (battery.efficiency, battery.resistance_ohm);
        let limited = battery.limiting_ohm().is_some();
        let (full_c, full_v) = (battery.full_c(), battery.full_v());
        let held = limited && self.open_v(battery) + ohm * inflow_a >= full_v * (1.0 - 1e-12);
        let (dt, taken_c, mean_v);
        if held {
            // Constant voltage within one piece of the curve.
            let [[s0, ..], [s1, ..]] = battery.curve.piece(self.charge_c / battery.capacity_c);
            let rise_v = battery.cells * (battery.curve.volts(s1) - battery.curve.volts(s0));
            let slope = rise_v / ((s1 - s0) * battery.capacity_c);
            let target_c = full_c.min(s1 * battery.capacity_c);
            if target_c - self.charge_c <= 1e-12 * battery.capacity_c {
                // On a point of the curve, by rounding.
                self.charge_c = target_c + 1e-12 * battery.capacity_c;
                return (0.0, full_v);
            }
            if slope > 0.0 {
                let rate = eta * slope / ohm;
                let limit_c = self.charge_c + inflow_a * ohm / slope;
                let time = if limit_c > target_c {
                    math::ln((limit_c - self.charge_c) / (limit_c - target_c)) / rate
                } else {
                    f64::INFINITY
                };
                dt = time.min(left);
                self.charge_c = if time <= left {
                    target_c
                } else {
                    limit_c - (limit_c - self.charge_c) * math::exp(-rate * dt)
                };
            } else {
                let time = (target_c - self.charge_c) / (eta * inflow_a);
                dt = time.min(left);
                self.charge_c = (self.charge_c + eta * inflow_a * dt).min(target_c);
            }
            taken_c = (self.charge_c - before.charge_c) / eta;
            mean_v = full_v;
        } else {
            // Constant current, up to where its voltage comes to that of a full battery.
            let until_v = (full_v - ohm * inflow_a) / battery.cells;
            let target_c = if limited {
                full_c.min(battery.curve.soc_at(until_v) * battery.capacity_c)
            } else {
                full_c
            };
            let time = (target_c - self.charge_c) / (eta * inflow_a);
            if time <= 0.0 {
                // On the edge between the two, by rounding.
                self.charge_c = self.charge_c.max(target_c + 1e-12 * battery.capacity_c);
                return (0.0, full_v);
            }
            dt = time.min(left);
            self.charge_c = if time <= left {
                target_c
            } else {
                self.charge_c + eta * inflow_a * dt
            };
            taken_c = inflow_a * dt;
            let stored_j = self.stored_j(battery) - before.stored_j(battery);
            let gained_c = self.charge_c - before.charge_c;
            // A gain below the last digit of the charge is none.
            let open_v = if gained_c > 0.0 {
                stored_j / gained_c
            } else {
                self.open_v(battery)
            };
            mean_v = open_v + ohm * inflow_a;
        }
        let stored_j = self.stored_j(battery) - before.stored_j(battery);
        self.heat_j += mean_v * taken_c - stored_j;
        self.lost_c += taken_c - (self.charge_c - before.charge_c);
        self.charger_c += taken_c;
        self.charger_j += mean_v * taken_c;
        (dt, mean_v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::energy::{BatteryParams, BatteryPreset, Supply};
    use simbeeotic_units::{Current, Resistance};

    fn battery(params: BatteryParams) -> Battery {
        let supply = Supply::new(&params).expect("good numbers");
        supply.battery.expect("a battery")
    }

    fn held(battery: &Battery, soc: f64) -> Cell {
        Cell {
            charge_c: soc * battery.capacity_c,
            ..Cell::default()
        }
    }

    /// What chargers gave, less what the load took and what got hot, is what is stored more.
    fn assert_balanced(before: &Cell, after: &Cell, battery: &Battery, load_j: f64) {
        let stored_j = after.stored_j(battery) - before.stored_j(battery);
        let charger_j = after.charger_j - before.charger_j;
        let heat_j = after.heat_j - before.heat_j;
        let gap_j = charger_j - load_j - heat_j - stored_j;
        assert!(
            gap_j.abs() < 1e-9 * before.stored_j(battery).max(1.0),
            "{gap_j} J"
        );
        assert!(heat_j >= -1e-12, "{heat_j} J");
    }

    #[test]
    fn voltage_sags_by_the_resistance_times_the_current() {
        let battery = battery(BatteryParams {
            internal_resistance: Some(Resistance::from_milliohms(100.0)),
            ..BatteryParams::default()
        });
        let mut cell = held(&battery, 0.5);
        assert!((cell.open_v(&battery) - 3.92).abs() < 1e-12);
        // So short that the open-circuit voltage stays.
        let mean_v = cell.discharge(&battery, 1e-6, 2.0);
        assert!((mean_v - (3.92 - 0.1 * 2.0)).abs() < 1e-6, "{mean_v}");
    }

    #[test]
    fn a_discharge_is_the_same_in_one_step_or_in_many() {
        let battery = battery(BatteryParams::default());
        let (mut one, mut many) = (held(&battery, 1.0), held(&battery, 1.0));
        let before = one;
        let whole_j = one.discharge(&battery, 800.0, 1.0) * 800.0;
        let mut parts_j = 0.0;
        for _ in 0..10_000 {
            parts_j += many.discharge(&battery, 0.08, 1.0) * 0.08;
        }
        assert!((one.charge_c - many.charge_c).abs() < 1e-9);
        assert!((whole_j - parts_j).abs() < 1e-8, "{whole_j} {parts_j}");
        assert_balanced(&before, &one, &battery, whole_j);
        // R I^2 t.
        assert!((one.heat_j - 0.06 * 800.0).abs() < 1e-9);
    }

    #[test]
    fn without_resistance_it_charges_at_constant_current_to_the_brim() {
        let battery = battery(BatteryParams {
            preset: BatteryPreset::Ideal,
            capacity: Some(simbeeotic_units::Charge::from_milliampere_hours(100.0)),
            charge_efficiency: Some(0.8),
            ..BatteryParams::default()
        });
        let mut cell = held(&battery, 0.0);
        // 100 mAh at 1C and 80 % take 1.25 h.
        cell.charge(&battery, 4499.0, 5.0, 0.0);
        assert!(!cell.is_full(&battery));
        cell.charge(&battery, 1.0 + 1e-6, 5.0, 0.0);
        assert!(cell.is_full(&battery), "{}", cell.charge_c);
        cell.charge(&battery, 1000.0, 5.0, 0.0);
        assert_eq!(cell.soc(&battery), 1.0);
        assert!((cell.charger_c - 1.25 * 360.0).abs() < 1e-6);
        assert_balanced(&held(&battery, 0.0), &cell, &battery, 0.0);
        assert!((cell.heat_j - 0.25 * 360.0 * 3.7).abs() < 1e-6);
    }

    #[test]
    fn at_constant_voltage_the_current_falls_exponentially() {
        let battery = battery(BatteryParams {
            internal_resistance: Some(Resistance::from_milliohms(500.0)),
            curve: Some(
                [(0.0, 3.0), (1.0, 4.2)]
                    .map(|(s, v)| (s, simbeeotic_units::Voltage::si(v)))
                    .into(),
            ),
            max_charge_current: Some(Current::si(1.0)),
            ..BatteryParams::default()
        });
        // 4.2 - 0.5 x 1 = 3.7 V: constant voltage from a soc of 0.7 / 1.2 on.
        let turn_s = 0.7 / 1.2 * 900.0;
        let mut cell = held(&battery, 0.0);
        cell.charge(&battery, turn_s, 3.0, 0.0);
        assert!((cell.charge_c - turn_s).abs() < 1e-6, "{}", cell.charge_c);
        assert!((cell.inflow(&battery, 3.0, 0.0) - 1.0).abs() < 1e-6);
        // R C with C = Q / dV: the slope of the curve as a capacity.
        let time_constant_s = 0.5 * 900.0 / 1.2;
        let start = cell;
        for (after_s, step_s) in [(100.0, 100.0), (250.0, 150.0), (600.0, 350.0)] {
            cell.charge(&battery, step_s, 3.0, 0.0);
            let inflow_a = cell.inflow(&battery, 3.0, 0.0);
            let want_a = math::exp(-after_s / time_constant_s);
            assert!(
                (inflow_a - want_a).abs() < 1e-6,
                "{after_s}: {inflow_a} for {want_a}"
            );
        }
        assert_balanced(&start, &cell, &battery, 0.0);
        // It ends at C/20, 12.5 mA: after ln(80) time constants.
        cell.charge(
            &battery,
            time_constant_s * math::ln(80.0) - 600.0 - 1e-3,
            3.0,
            0.0,
        );
        assert!(!cell.is_full(&battery));
        cell.charge(&battery, 2e-3, 3.0, 0.0);
        assert!(cell.is_full(&battery), "{}", cell.soc(&battery));
        assert_eq!(cell.inflow(&battery, 3.0, 0.0), 0.0);
    }

    #[test]
    fn a_charge_is_the_same_in_one_step_or_in_many_and_nothing_gets_lost() {
        for (load_a, charger_a) in [(0.0, 0.5), (0.12, 0.5), (0.3, 0.2)] {
            let battery = battery(BatteryParams {
                charge_efficiency: Some(0.95),
                ..BatteryParams::default()
            });
            let start = held(&battery, 0.23);
            let (mut one, mut many) = (start, start);
            let mean_v = one.charge(&battery, 2400.0, charger_a, load_a);
            assert_balanced(&start, &one, &battery, mean_v * load_a * 2400.0);
            let mut volt_seconds = 0.0;
            for _ in 0..2400 {
                volt_seconds += many.charge(&battery, 1.0, charger_a, load_a);
            }
            assert!(
                (one.charge_c - many.charge_c).abs() < 1e-6,
                "{one:?} {many:?}"
            );
            assert!(
                (mean_v * 2400.0 - volt_seconds).abs() < 1e-5,
                "{charger_a} A"
            );
            // The charge that flowed is what is stored, what the load took, and the twentieth lost.
            let stored_c = one.charge_c - start.charge_c;
            let flowed_c = if stored_c > 0.0 {
                stored_c / 0.95
            } else {
                stored_c
            };
            assert!((one.charger_c - flowed_c - load_a * 2400.0).abs() < 1e-6);
        }
    }
}
