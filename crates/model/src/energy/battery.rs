//! `[model.battery]`: what a platform runs on.

use super::curve::Curve;
use crate::behavior::BuildError;
use crate::check::{at_least_zero, in_range, positive};
use crate::config::{Fault, Node, read_params};
use simbeeotic_macros::{choice, params};
use simbeeotic_units::{Charge, Current, Resistance, Speed, Voltage};

/// What a platform runs on: the keys of `[model.battery]`. Those left out are the preset's.
#[params]
pub struct BatteryParams {
    /// Which battery it is.
    pub preset: BatteryPreset,
    /// What a full battery holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub capacity: Option<Charge>,
    /// Cells in a row, 1 to 24.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cells: Option<u32>,
    /// Resistance of all cells and what is between them and the loads.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub internal_resistance: Option<Resistance>,
    /// Open-circuit voltage of one cell over its state of charge: `[[0.0, "3.0 V"], [1.0, "4.2 V"]]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub curve: Option<Vec<(f64, Voltage)>>,
    /// State of charge at the start, 0 to 1.
    pub charge: f64,
    /// The battery counts as empty when its voltage under load falls to this.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cutoff: Option<Voltage>,
    /// State of charge at which the battery counts as empty, at least 0 and below 1. What is left is
    /// for landing, or for the electronics. Unless said: 0.05, but 0 if all stops at once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reserve: Option<f64>,
    /// State of charge at which the behaviour hears that the battery is low, 0 to 1.
    pub low: f64,
    /// Share of the charge taken in that is stored, above 0, at most 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub charge_efficiency: Option<f64>,
    /// The most that it takes from a charger.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_charge_current: Option<Current>,
    /// What happens when it is empty: `land`, `fall` or `stop`.
    pub on_empty: OnEmpty,
    /// After a fall: whether computer, sensors and radio live on from the reserve.
    pub electronics: bool,
    /// How fast it sinks when it lands.
    pub landing_speed: Speed,
    /// What computer and all else on board draw, all the time.
    pub avionics: Current,
    /// How charge is counted: `exact`, or as the `original` did it (with the preset `none`).
    pub accounting: Accounting,
}

impl Default for BatteryParams {
    fn default() -> Self {
        Self {
            preset: BatteryPreset::OneCell250,
            capacity: None,
            cells: None,
            internal_resistance: None,
            curve: None,
            charge: 1.0,
            cutoff: None,
            reserve: None,
            low: 0.2,
            charge_efficiency: None,
            max_charge_current: None,
            on_empty: OnEmpty::Land,
            electronics: true,
            landing_speed: Speed::si(0.5),
            avionics: Current::ZERO,
            accounting: Accounting::Exact,
        }
    }
}

/// Batteries that can be had.
#[choice]
pub enum BatteryPreset {
    /// No battery: nothing runs out; loads are counted all the same.
    None,
    /// The Crazyflie 1's, 170 mAh 25C (Fullriver 671723HS25C), charged at up to 5C; protection circuit below 60
    /// mohm (Bitcraze wiki, "Hardware explained").
    #[serde(rename = "1s-170mah")]
    OneCell170,
    /// The Crazyflie 2's, 250 mAh 15C; resistance as the Crazyflie 1's, charged at 2C at most.
    #[serde(rename = "1s-250mah")]
    OneCell250,
    /// The brushless Crazyflie's, 350 mAh.
    #[serde(rename = "1s-350mah")]
    OneCell350,
    /// A small racer's. Resistance is typical of its size; no datasheet.
    #[serde(rename = "2s-450mah")]
    TwoCells450,
    /// A light quadrotor's. Resistance is typical of its size; no datasheet.
    #[serde(rename = "3s-1300mah")]
    ThreeCells1300,
    /// A 5-inch quadrotor's. Resistance is typical of its size; no datasheet.
    #[serde(rename = "4s-1500mah")]
    FourCells1500,
    /// 3.7 V until it is empty, without resistance; `capacity` must be given.
    Ideal,
}

/// What happens when a battery is empty.
#[choice]
pub enum OnEmpty {
    /// It sinks straight down, whatever its behaviour wants, and switches its motors off at the touch.
    Land,
    /// Its motors stop at once.
    Fall,
    /// Everything stops: motors, computer, sensors, radio. The behaviour is not called any more.
    Stop,
}

/// How charge is counted.
#[choice]
pub enum Accounting {
    /// Current times time.
    Exact,
    /// As the original did: see [`energy`](crate::energy).
    Original,
}

/// Numbers of a preset: capacity in mAh, cells, milliohms, volts of an empty battery, charging rate
/// in C.
struct Numbers {
    capacity_mah: Option<f64>,
    cells: u32,
    resistance_mohm: f64,
    cutoff_v: f64,
    charge_c_rate: f64,
    curve: Curve,
}

impl BatteryPreset {
    fn numbers(self) -> Numbers {
        let lipo = |mah: f64, cells: u32, mohm: f64, rate: f64| Numbers {
            capacity_mah: Some(mah),
            cells,
            resistance_mohm: mohm,
            cutoff_v: 3.0 * f64::from(cells),
            charge_c_rate: rate,
            curve: Curve::lipo(),
        };
        match self {
            Self::None => lipo(250.0, 1, 60.0, 1.0),
            Self::OneCell170 => lipo(170.0, 1, 60.0, 5.0),
            Self::OneCell250 => lipo(250.0, 1, 60.0, 2.0),
            Self::OneCell350 => lipo(350.0, 1, 60.0, 2.0),
            Self::TwoCells450 => lipo(450.0, 2, 50.0, 2.0),
            Self::ThreeCells1300 => lipo(1300.0, 3, 30.0, 2.0),
            Self::FourCells1500 => lipo(1500.0, 4, 30.0, 2.0),
            Self::Ideal => Numbers {
                capacity_mah: None,
                cells: 1,
                resistance_mohm: 0.0,
                cutoff_v: 0.0,
                charge_c_rate: 1.0,
                curve: Curve::level(3.7),
            },
        }
    }
}

/// A battery, checked, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Battery {
    /// Charge of a full battery, C.
    pub(crate) capacity_c: f64,
    pub(crate) cells: f64,
    pub(crate) resistance_ohm: f64,
    pub(crate) curve: Curve,
    /// State of charge at the start.
    pub(crate) start: f64,
    pub(crate) cutoff_v: f64,
    pub(crate) reserve: f64,
    pub(crate) low: f64,
    pub(crate) efficiency: f64,
    pub(crate) inflow_a: f64,
    pub(crate) on_empty: OnEmpty,
    pub(crate) electronics: bool,
    pub(crate) landing_m_s: f64,
}

impl Battery {
    /// Terminal voltage of a full battery without load.
    pub(crate) fn full_v(&self) -> f64 {
        self.cells * self.curve.full_v()
    }

    /// The charge at which a charger stops, C: where at constant voltage C/20 is left.
    pub(crate) fn full_c(&self) -> f64 {
        let least_a = self.capacity_c / (20.0 * 3600.0);
        match self.limiting_ohm() {
            Some(ohm) => {
                let open_v = self.full_v() - ohm * least_a;
                self.capacity_c * self.curve.soc_at(open_v / self.cells)
            }
            None => self.capacity_c,
        }
    }

    /// The resistance that limits the current at constant voltage. `None`: nothing does, for want of
    /// a resistance or of a voltage that rises up to full.
    pub(crate) fn limiting_ohm(&self) -> Option<f64> {
        let rises = self.curve.volts(1.0 - 1e-6) < self.curve.full_v();
        (rises && self.resistance_ohm > 0.0).then_some(self.resistance_ohm)
    }

    /// The charge at which it is empty under a load, C.
    pub(crate) fn empty_c(&self, load_a: f64) -> f64 {
        let open_v = (self.cutoff_v + self.resistance_ohm * load_a) / self.cells;
        self.capacity_c * self.curve.soc_at(open_v).max(self.reserve)
    }

    /// Charge of a full battery.
    pub fn capacity(&self) -> Charge {
        Charge::si(self.capacity_c)
    }

    /// Resistance of all of it.
    pub fn resistance(&self) -> Resistance {
        Resistance::si(self.resistance_ohm)
    }

    /// State of charge of a battery whose terminals show `voltage` under `current`: equation 1 of the
    /// module turned round.
    pub fn soc_at(&self, voltage: Voltage, current: Current) -> f64 {
        let open_v = voltage.get() + self.resistance_ohm * current.get();
        self.curve.soc_at(open_v / self.cells)
    }
}

/// What a platform runs on and what draws from it besides motors, sensors and radio.
#[derive(Clone, Debug, PartialEq)]
pub struct Supply {
    /// The battery; `None`: nothing runs out.
    pub battery: Option<Battery>,
    /// What computer and all else on board draw.
    pub avionics: Current,
    /// How charge is counted.
    pub accounting: Accounting,
}

impl Supply {
    /// The table `[model.battery]`.
    ///
    /// # Errors
    /// All unknown keys and numbers that make no sense, with their places.
    pub fn read(node: &Node) -> Result<Self, Vec<Fault>> {
        let params: BatteryParams = read_params(node)?;
        Self::new(&params).map_err(|error| {
            let place = match &error {
                BuildError::Parameter { key, .. } => node
                    .as_table()
                    .and_then(|table| table.get(key))
                    .map_or(node.span, |value| value.span),
                _ => node.span,
            };
            vec![Fault::error(place, error.to_string())]
        })
    }

    /// What these parameters mean.
    ///
    /// # Errors
    /// A number out of its range; keys that do not go together.
    pub fn new(params: &BatteryParams) -> Result<Self, BuildError> {
        at_least_zero("avionics", params.avionics)?;
        let none = params.preset == BatteryPreset::None;
        if none && params.capacity.is_some() {
            let message = "is a battery's, and the preset `none` is none";
            return Err(BuildError::parameter("capacity", message));
        }
        if params.accounting == Accounting::Original && !none {
            let message = "`original` goes with the preset `none`: the original had no batteries";
            return Err(BuildError::parameter("accounting", message));
        }
        Ok(Self {
            battery: if none { None } else { Some(battery(params)?) },
            avionics: params.avionics,
            accounting: params.accounting,
        })
    }
}

fn battery(p: &BatteryParams) -> Result<Battery, BuildError> {
    let preset = p.preset.numbers();
    let capacity = p
        .capacity
        .or(preset.capacity_mah.map(Charge::from_milliampere_hours));
    let Some(capacity) = capacity else {
        return Err(BuildError::parameter(
            "capacity",
            "must be given for an ideal battery",
        ));
    };
    positive("capacity", capacity)?;
    in_range(
        "capacity",
        capacity,
        Charge::ZERO..=Charge::from_ampere_hours(1e3),
    )?;
    let cells = p.cells.unwrap_or(preset.cells);
    in_range("cells", cells, 1..=24)?;
    let share = f64::from(cells) / f64::from(preset.cells);
    let resistance_ohm = match p.internal_resistance {
        Some(given) => given.get(),
        None => preset.resistance_mohm * 1e-3 * share,
    };
    at_least_zero("internal_resistance", Resistance::si(resistance_ohm))?;
    in_range(
        "internal_resistance",
        Resistance::si(resistance_ohm),
        Resistance::ZERO..=Resistance::si(1e3),
    )?;
    let curve = match &p.curve {
        Some(points) => {
            let points: Vec<_> = points.iter().map(|(s, v)| [*s, v.get()]).collect();
            Curve::new(&points)?
        }
        None => preset.curve,
    };
    in_range("charge", p.charge, 0.0..=1.0)?;
    in_range("low", p.low, 0.0..=1.0)?;
    let full_v = f64::from(cells) * curve.full_v();
    // Five times the capacity an hour would leave no voltage.
    let most_ohm = full_v / (5.0 * capacity.get() / 3600.0);
    if resistance_ohm > most_ohm {
        let message = format!(
            "must be at most {:.3} for {capacity} and {:.1} V, or no load is left any voltage; it is {}",
            Resistance::si(most_ohm),
            full_v,
            Resistance::si(resistance_ohm)
        );
        return Err(BuildError::parameter("internal_resistance", message));
    }
    let cutoff = p.cutoff.unwrap_or(Voltage::si(preset.cutoff_v * share));
    at_least_zero("cutoff", cutoff)?;
    if cutoff.get() >= full_v {
        let message = format!(
            "must be below the {} of a full battery, and is {cutoff}",
            Voltage::si(full_v)
        );
        return Err(BuildError::parameter("cutoff", message));
    }
    let usual = match (p.on_empty, p.electronics) {
        (OnEmpty::Stop, _) | (OnEmpty::Fall, false) => 0.0,
        _ => 0.05,
    };
    let reserve = p.reserve.unwrap_or(usual);
    if !(0.0..1.0).contains(&reserve) {
        let message = format!("must be at least 0 and below 1, and is {reserve}");
        return Err(BuildError::parameter("reserve", message));
    }
    if p.low < reserve {
        let message = format!(
            "must be at least the reserve of {reserve}, or it is never told; it is {}",
            p.low
        );
        return Err(BuildError::parameter("low", message));
    }
    if reserve == 0.0 && p.on_empty == OnEmpty::Land {
        let message = "must be above 0: landing draws from it";
        return Err(BuildError::parameter("reserve", message));
    }
    let efficiency = p.charge_efficiency.unwrap_or(1.0);
    in_range("charge_efficiency", efficiency, 0.01..=1.0)?;
    let inflow = match p.max_charge_current {
        Some(current) => current,
        None => Current::si(preset.charge_c_rate * capacity.get() / 3600.0),
    };
    positive("max_charge_current", inflow)?;
    positive("landing_speed", p.landing_speed)?;
    in_range(
        "landing_speed",
        p.landing_speed,
        Speed::ZERO..=Speed::si(100.0),
    )?;
    Ok(Battery {
        capacity_c: capacity.get(),
        cells: f64::from(cells),
        resistance_ohm,
        curve,
        start: p.charge,
        cutoff_v: cutoff.get(),
        reserve,
        low: p.low,
        efficiency,
        inflow_a: inflow.get(),
        on_empty: p.on_empty,
        electronics: p.electronics,
        landing_m_s: p.landing_speed.get(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(change: impl FnOnce(&mut BatteryParams)) -> Result<Supply, BuildError> {
        let mut params = BatteryParams::default();
        change(&mut params);
        Supply::new(&params)
    }

    #[test]
    fn the_presets_are_the_batteries_they_name() {
        let want = [
            (BatteryPreset::OneCell170, 170.0, 1.0, 0.06, 0.85),
            (BatteryPreset::OneCell250, 250.0, 1.0, 0.06, 0.5),
            (BatteryPreset::OneCell350, 350.0, 1.0, 0.06, 0.7),
            (BatteryPreset::TwoCells450, 450.0, 2.0, 0.05, 0.9),
            (BatteryPreset::ThreeCells1300, 1300.0, 3.0, 0.03, 2.6),
            (BatteryPreset::FourCells1500, 1500.0, 4.0, 0.03, 3.0),
        ];
        for (preset, mah, cells, ohm, inflow_a) in want {
            let supply = with(|p| p.preset = preset).expect("a preset");
            let battery = supply.battery.expect("a battery");
            assert!((battery.capacity().milliampere_hours() - mah).abs() < 1e-9);
            assert_eq!((battery.cells, battery.resistance_ohm), (cells, ohm));
            assert!((battery.inflow_a - inflow_a).abs() < 1e-9);
            assert_eq!(battery.full_v(), cells * 4.2);
            assert_eq!(battery.cutoff_v, cells * 3.0);
        }
        assert_eq!(
            with(|p| p.preset = BatteryPreset::None)
                .expect("none")
                .battery,
            None
        );
    }

    #[test]
    fn given_numbers_go_before_those_of_the_preset() {
        let supply = with(|p| {
            p.cells = Some(3);
            p.capacity = Some("0.1 A h".parse().expect("a charge"));
        });
        let battery = supply.expect("good").battery.expect("a battery");
        assert_eq!(battery.capacity_c, 360.0);
        // Three cells in a row have three times the resistance of one, and three times its voltage.
        assert!((battery.resistance_ohm - 0.18).abs() < 1e-12);
        assert_eq!((battery.full_v(), battery.cutoff_v), (3.0 * 4.2, 9.0));
    }

    #[test]
    fn a_battery_is_read_from_its_terminals() {
        let battery = with(|_| {}).expect("good").battery.expect("a battery");
        let soc = battery.soc_at(Voltage::si(3.92 - 0.06 * 1.5), Current::si(1.5));
        assert!((soc - 0.5).abs() < 1e-9, "{soc}");
    }

    #[test]
    fn what_makes_no_sense_is_refused_by_name() {
        type Change = fn(&mut BatteryParams);
        let bad: [(&str, Change); 27] = [
            ("capacity", |p| p.capacity = Some(Charge::ZERO)),
            ("capacity", |p| p.capacity = Some(Charge::si(-1.0))),
            ("capacity", |p| p.preset = BatteryPreset::Ideal),
            ("capacity", |p| {
                p.preset = BatteryPreset::None;
                p.capacity = Some(Charge::si(1.0));
            }),
            ("cells", |p| p.cells = Some(0)),
            ("cells", |p| p.cells = Some(25)),
            ("internal_resistance", |p| {
                p.internal_resistance = Some(Resistance::si(-0.1));
            }),
            ("internal_resistance", |p| {
                p.internal_resistance = Some(Resistance::si(f64::NAN));
            }),
            ("internal_resistance", |p| {
                p.internal_resistance = Some(Resistance::si(1000.0));
            }),
            ("low", |p| (p.low, p.reserve) = (0.2, Some(0.5))),
            ("charge_efficiency", |p| p.charge_efficiency = Some(1e-18)),
            ("curve", |p| p.curve = Some(vec![(0.0, Voltage::si(3.0))])),
            ("charge", |p| p.charge = 1.5),
            ("charge", |p| p.charge = f64::NAN),
            ("low", |p| p.low = -0.1),
            ("cutoff", |p| p.cutoff = Some(Voltage::si(-1.0))),
            ("cutoff", |p| p.cutoff = Some(Voltage::si(4.2))),
            ("reserve", |p| p.reserve = Some(1.0)),
            ("reserve", |p| p.reserve = Some(-0.1)),
            ("reserve", |p| p.reserve = Some(0.0)),
            ("charge_efficiency", |p| p.charge_efficiency = Some(0.0)),
            ("charge_efficiency", |p| p.charge_efficiency = Some(1.1)),
            ("max_charge_current", |p| {
                p.max_charge_current = Some(Current::ZERO);
            }),
            ("landing_speed", |p| p.landing_speed = Speed::ZERO),
            ("landing_speed", |p| p.landing_speed = Speed::si(1e3)),
            ("avionics", |p| p.avionics = Current::si(-0.1)),
            ("accounting", |p| p.accounting = Accounting::Original),
        ];
        for (key, change) in bad {
            let fault = with(change).expect_err(key).to_string();
            assert!(fault.contains(&format!("`{key}`")), "{key}: {fault}");
        }
    }

    #[test]
    fn unknown_keys_and_presets_are_faults_with_places() {
        use crate::config::{Span, Table, Value};
        let node = |key: &str, value: &str| {
            let mut table = Table::default();
            let value = Value::String(value.to_owned());
            table.set(key, Node::new(Span::default(), value));
            Node::new(Span::default(), Value::Table(table))
        };
        assert!(Supply::read(&node("preset", "2s-450mah")).is_ok());
        assert!(Supply::read(&node("capacity", "250 mAh")).is_ok());
        for (key, value) in [("preset", "5s"), ("capacty", "1 mAh"), ("capacity", "1 V")] {
            assert!(Supply::read(&node(key, value)).is_err(), "{key} = {value}");
        }
    }
}
