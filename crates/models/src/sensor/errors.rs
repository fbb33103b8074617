//! The parameters of [`noise`](super::noise): the same keys on each sensor with three axes.
//!
//! A sensor takes its errors from a [`Sheet`] (a data sheet, or what the sensor has by default), and
//! what the scenario says goes over it. `error_params!` writes the struct of parameters, so that each
//! such sensor has the same keys with the same meaning:
//!
//! | key | symbol | what |
//! |---|---|---|
//! | `sigma` | σ | white noise of each reading |
//! | `density`, `bandwidth` | N, B | the same as a data sheet says it: `σ = N sqrt(B)` |
//! | `bias` | B | a bias that is known, along the three axes |
//! | `bias_sigma` | b | a bias that each sensor draws once |
//! | `walk` | K | how far the bias walks in a second |
//! | `drift`, `drift_time` | D, T | a drift that is forgotten in the time T |
//! | `scale_sigma` | s | error of the scale factor |
//! | `range` | limit | readings end there |
//! | `resolution` | step | readings are multiples of it |

use super::bounds::{self, LEAST_STEP, MOST};
use super::noise::{Axes, Drift, Errors};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use simbeeotic_model::BuildError;
use simbeeotic_model::check::in_range;
use simbeeotic_model::schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use simbeeotic_model::serde;
use simbeeotic_model::units::{Frequency, Quantity, Time};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

/// The density of a white noise: a quantity per square root of hertz, `"160 ug/sqrt(Hz)"`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseDensity<Q>(Q);

impl<Q: Quantity> NoiseDensity<Q> {
    const PER: &'static str = "/sqrt(Hz)";

    /// The standard deviation in a bandwidth of 1 Hz.
    pub fn new(in_one_hertz: Q) -> Self {
        Self(in_one_hertz)
    }

    /// As an SI number per sqrt(Hz).
    pub fn get(self) -> f64 {
        self.0.to_si()
    }
}

impl<Q: Quantity> Serialize for NoiseDensity<Q> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&format_args!("{}{}", self.0, Self::PER))
    }
}

impl<'de, Q: Quantity> Deserialize<'de> for NoiseDensity<Q> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader<Q>(PhantomData<Q>);
        impl<Q: Quantity> de::Visitor<'_> for Reader<Q> {
            type Value = NoiseDensity<Q>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let (unit, per) = (Q::UNITS[0].name, Self::Value::PER);
                write!(f, "a noise density, for example \"0.01 {unit}{per}\"")
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Self::Value, E> {
                let Some(quantity) = text.trim_end().strip_suffix(Self::Value::PER) else {
                    let found = de::Unexpected::Str(text);
                    return Err(E::invalid_value(found, &self));
                };
                quantity.parse().map(NoiseDensity).map_err(E::custom)
            }
        }
        deserializer.deserialize_any(Reader(PhantomData))
    }
}

impl<Q: Quantity> JsonSchema for NoiseDensity<Q> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "NoiseDensity".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let units: Vec<String> = Q::UNITS
            .iter()
            .map(|unit| format!("{}{}", unit.name, Self::PER))
            .collect();
        json_schema!({
            "type": "string",
            "description": format!("a noise density with a unit: {}", units.join(", ")),
            "x-si-unit": units[0],
            "x-units": units,
        })
    }
}

/// What a data sheet says of three axes, in SI units.
#[derive(Clone, Copy, Debug)]
pub struct Sheet {
    /// White noise of each axis.
    pub white: White,
    /// Zero offset: standard deviation from one device to another.
    pub bias_sigma: f64,
    /// Sensitivity tolerance: standard deviation, as a fraction.
    pub scale_sigma: f64,
    /// Full scale of each axis.
    pub range: [f64; 3],
    /// What a reading is a multiple of.
    pub step: Step,
}

/// White noise, as data sheets give it.
#[derive(Clone, Copy, Debug)]
pub enum White {
    /// Standard deviation of each axis.
    Sigma([f64; 3]),
    /// Density of each axis per sqrt(Hz), and the noise bandwidth, Hz.
    Density([f64; 3], f64),
}

/// Resolution, as data sheets give it.
#[derive(Clone, Copy, Debug)]
pub enum Step {
    /// Readings are multiples of this; 0: they are not.
    Of(f64),
    /// The full scale, both sides together, has so many bits.
    Bits(u32),
}

impl Sheet {
    /// A sensor without errors.
    pub const IDEAL: Self = Self::white(0.0);

    /// A sensor with white noise alone.
    pub const fn white(sigma: f64) -> Self {
        Self {
            white: White::Sigma([sigma; 3]),
            bias_sigma: 0.0,
            scale_sigma: 0.0,
            range: [f64::INFINITY; 3],
            step: Step::Of(0.0),
        }
    }
}

/// What a scenario says of the errors of three axes; what it leaves out is the sheet's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Given<Q> {
    pub(super) sigma: Option<Q>,
    pub(super) density: Option<NoiseDensity<Q>>,
    pub(super) bandwidth: Option<Frequency>,
    pub(super) bias: Option<[Q; 3]>,
    pub(super) bias_sigma: Option<Q>,
    pub(super) walk: Option<Q>,
    pub(super) drift: Option<Q>,
    pub(super) drift_time: Option<Time>,
    pub(super) scale_sigma: Option<f64>,
    pub(super) range: Option<Q>,
    pub(super) resolution: Option<Q>,
}

impl<Q: Quantity> Given<Q> {
    /// Three axes with the errors of `sheet`, but for what is said here.
    ///
    /// # Errors
    /// The parameter that makes no sense.
    pub(super) fn over(&self, sheet: Sheet) -> Result<Axes, BuildError> {
        let white = self.white(sheet.white)?;
        let bias = match self.bias {
            Some(bias) => bias.map(Quantity::to_si),
            None => [0.0; 3],
        };
        if !bias.iter().all(|b| b.abs() <= MOST) {
            let message = "must be three numbers of -1e9 to 1e9 in SI units";
            return Err(BuildError::parameter("bias", message));
        }
        let bias_sigma = at_least_zero("bias_sigma", self.bias_sigma)?.unwrap_or(sheet.bias_sigma);
        let drift = self.drifting()?;
        let scale_sigma = self.scale_sigma.unwrap_or(sheet.scale_sigma);
        in_range("scale_sigma", scale_sigma, 0.0..=1.0)?;
        let range = match self.range {
            Some(range) => [above_zero("range", range)?; 3],
            None => sheet.range,
        };
        let resolution = at_least_zero("resolution", self.resolution)?;
        if let Some(si) = resolution {
            let message = |_| format!("must be zero, or at least {LEAST_STEP} in SI units");
            bounds::step("resolution", si)
                .map_err(|error| BuildError::parameter("resolution", message(error)))?;
        }
        let step = match (resolution, sheet.step) {
            (Some(step), _) | (None, Step::Of(step)) => [step; 3],
            // Half the bits are below zero.
            (None, Step::Bits(bits)) => range.map(|range| range / f64::from(1_u32 << (bits - 1))),
        };
        Ok(Axes::each(std::array::from_fn(|axis| Errors {
            sigma: white[axis],
            bias: bias[axis],
            bias_sigma,
            scale_sigma,
            drift,
            limit: range[axis],
            step: step[axis],
        })))
    }

    fn white(&self, sheet: White) -> Result<[f64; 3], BuildError> {
        let sigma = at_least_zero("sigma", self.sigma)?;
        let bandwidth = self.bandwidth.map(|b| above_zero("bandwidth", b));
        let bandwidth = bandwidth.transpose()?;
        let density = at_least_zero("density", self.density.map(|density| density.0))?;
        let lone =
            || BuildError::parameter("bandwidth", "goes with a `density`, and there is none");
        match (sigma, density, sheet) {
            (Some(_), Some(_), _) => {
                let message = "says the same as `sigma`: give one of them";
                Err(BuildError::parameter("density", message))
            }
            (Some(sigma), None, _) if bandwidth.is_none() => Ok([sigma; 3]),
            (None, None, White::Sigma(sigma)) if bandwidth.is_none() => Ok(sigma),
            (Some(_), None, _) | (None, None, White::Sigma(_)) => Err(lone()),
            (None, None, White::Density(density, usual)) => {
                Ok(density.map(|density| density * bandwidth.unwrap_or(usual).sqrt()))
            }
            (None, Some(density), sheet) => {
                let usual = match sheet {
                    White::Density(_, usual) => Some(usual),
                    White::Sigma(_) => None,
                };
                match bandwidth.or(usual) {
                    Some(bandwidth) => Ok([density * bandwidth.sqrt(); 3]),
                    None => Err(BuildError::parameter("density", "needs a `bandwidth`")),
                }
            }
        }
    }

    fn drifting(&self) -> Result<Drift, BuildError> {
        let walk = at_least_zero("walk", self.walk)?.unwrap_or(0.0);
        let sigma = at_least_zero("drift", self.drift)?.unwrap_or(0.0);
        let time = self.drift_time.map(|time| above_zero("drift_time", time));
        match (walk > 0.0, sigma > 0.0, time.transpose()?) {
            (true, true, _) => {
                let message = "is a drift that is forgotten, and `walk` one that is not: give one";
                Err(BuildError::parameter("drift", message))
            }
            (false, true, None) => Err(BuildError::parameter("drift", "needs a `drift_time`")),
            (_, false, Some(_)) => {
                let message = "goes with a `drift`, and there is none";
                Err(BuildError::parameter("drift_time", message))
            }
            (true, false, None) => Ok(Drift::Walk(walk)),
            (false, true, Some(time_s)) => Ok(Drift::Markov { sigma, time_s }),
            (false, false, None) => Ok(Drift::None),
        }
    }
}

fn at_least_zero<Q: Quantity>(key: &'static str, q: Option<Q>) -> Result<Option<f64>, BuildError> {
    match q {
        Some(q) if !(0.0..=MOST).contains(&q.to_si()) => {
            let most = Q::from_si(MOST);
            let message = format!("must be zero or more, up to {most}, and is {q}");
            Err(BuildError::parameter(key, message))
        }
        q => Ok(q.map(Quantity::to_si)),
    }
}

fn above_zero<Q: Quantity>(key: &'static str, q: Q) -> Result<f64, BuildError> {
    if q.to_si() > 0.0 && q.to_si() <= MOST {
        Ok(q.to_si())
    } else {
        let most = Q::from_si(MOST);
        let message = format!("must be more than zero, up to {most}, and is {q}");
        Err(BuildError::parameter(key, message))
    }
}

/// Writes the parameters of a sensor with three axes: fields of its own, then the common ones. In
/// Rust all of them are `None` by default: the device's.
macro_rules! error_params {
    (
        $(#[$doc:meta])*
        $Params:ident of $Q:ty {
            $($(#[$field_doc:meta])* $field:ident : $Type:ty = $default:expr,)*
        }
    ) => {
        $(#[$doc])*
        #[simbeeotic_model::params]
        pub struct $Params {
            $($(#[$field_doc])* pub $field: $Type,)*
            /// Standard deviation of the white noise of each reading. 0 or more.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub sigma: Option<$Q>,
            /// The white noise as a density, `"0.01 .../sqrt(Hz)"`: its standard deviation is the
            /// density times the root of the bandwidth. 0 or more. Instead of `sigma`.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub density: Option<$crate::sensor::errors::NoiseDensity<$Q>>,
            /// Noise bandwidth, with a density. Above 0. Readings at a rate f without other filter
            /// have f / 2.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub bandwidth: Option<simbeeotic_model::units::Frequency>,
            /// A constant bias that is known, along the sensor's axes; none unless said.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub bias: Option<[$Q; 3]>,
            /// Standard deviation of the constant bias that each sensor draws once, on each axis. 0 or
            /// more.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub bias_sigma: Option<$Q>,
            /// How far the bias walks in a second, as a standard deviation; in t seconds sqrt(t) times
            /// as far. 0 or more; none unless said.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub walk: Option<$Q>,
            /// Standard deviation of a drift of the bias that is forgotten in `drift_time`
            /// (Gauss-Markov). 0 or more; none unless said. Instead of `walk`.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub drift: Option<$Q>,
            /// Correlation time of the drift. Above 0.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub drift_time: Option<simbeeotic_model::units::Time>,
            /// Standard deviation of the scale factor's error, a fraction; drawn once for each axis. 0
            /// or more.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub scale_sigma: Option<f64>,
            /// Full scale: readings end there, on both sides of 0. Above 0.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub range: Option<$Q>,
            /// Readings are multiples of this; 0: of nothing.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub resolution: Option<$Q>,
        }

        impl Default for $Params {
            fn default() -> Self {
                Self {
                    $($field: $default,)*
                    sigma: None,
                    density: None,
                    bandwidth: None,
                    bias: None,
                    bias_sigma: None,
                    walk: None,
                    drift: None,
                    drift_time: None,
                    scale_sigma: None,
                    range: None,
                    resolution: None,
                }
            }
        }

        impl $Params {
            /// What is said of the errors.
            fn given(&self) -> $crate::sensor::errors::Given<$Q> {
                $crate::sensor::errors::Given {
                    sigma: self.sigma,
                    density: self.density,
                    bandwidth: self.bandwidth,
                    bias: self.bias,
                    bias_sigma: self.bias_sigma,
                    walk: self.walk,
                    drift: self.drift,
                    drift_time: self.drift_time,
                    scale_sigma: self.scale_sigma,
                    range: self.range,
                    resolution: self.resolution,
                }
            }
        }
    };
}

pub(super) use error_params;

#[cfg(test)]
mod tests {
    use crate::trial::refusal;

    #[test]
    fn each_nonsense_is_refused_by_name_whatever_the_sensor() {
        let bad: [(&[(&str, &str)], &str); 21] = [
            (&[("sigma", "-1")], "sigma"),
            (
                &[("density", "-1/sqrt(Hz)"), ("bandwidth", "1 Hz")],
                "density",
            ),
            (&[("density", "1/sqrt(Hz)"), ("sigma", "1")], "density"),
            (&[("density", "1/sqrt(Hz)")], "bandwidth"),
            (&[("bandwidth", "10 Hz"), ("sigma", "1")], "bandwidth"),
            (
                &[("density", "1/sqrt(Hz)"), ("bandwidth", "0 Hz")],
                "bandwidth",
            ),
            (&[("bias_sigma", "-1")], "bias_sigma"),
            (&[("walk", "-1")], "walk"),
            (&[("drift", "-1"), ("drift_time", "1 s")], "drift"),
            (&[("drift", "1")], "drift_time"),
            (&[("drift_time", "1 s")], "drift_time"),
            (
                &[("drift", "1"), ("drift_time", "1 s"), ("walk", "1")],
                "walk",
            ),
            (&[("scale_sigma", "-0.1")], "scale_sigma"),
            (&[("range", "0")], "range"),
            (&[("resolution", "-1")], "resolution"),
            (&[("sigma", "1e300")], "sigma"),
            (&[("bias_sigma", "1e300")], "bias_sigma"),
            (&[("walk", "1e300")], "walk"),
            (&[("scale_sigma", "1.5")], "scale_sigma"),
            (&[("range", "1e300")], "range"),
            (&[("resolution", "1e-310")], "resolution"),
        ];
        for (kind, unit) in [
            ("accelerometer", "m/s^2"),
            ("gyroscope", "rad/s"),
            ("velocity", "m/s"),
            ("body-velocity", "m/s"),
            ("magnetometer", "T"),
        ] {
            for (params, key) in bad {
                let with_units: Vec<(&str, String)> = params
                    .iter()
                    .map(|(key, text)| match text.split_once('/') {
                        Some((number, per)) => (*key, format!("{number} {unit}/{per}")),
                        None if text.ends_with(['s', 'z']) || *key == "scale_sigma" => {
                            (*key, (*text).to_owned())
                        }
                        None => (*key, format!("{text} {unit}")),
                    })
                    .collect();
                let with_units: Vec<_> = with_units.iter().map(|(k, v)| (*k, &v[..])).collect();
                let refusal = refusal(kind, &with_units);
                let refusal = refusal.unwrap_or_else(|| panic!("{kind} takes {with_units:?}"));
                assert!(refusal.contains(key), "{kind}, {with_units:?}: {refusal}");
            }
        }
    }

    #[test]
    fn a_bias_is_three_numbers_that_are_not_huge() {
        for (kind, bias) in [
            ("accelerometer", "[1e300 m/s^2, 0 m/s^2, 0 m/s^2]"),
            ("gyroscope", "[0 rad/s, -1e300 rad/s, 0 rad/s]"),
            ("magnetometer", "[0 T, 0 T, 1e300 T]"),
            ("velocity", "[0 m/s, 2e9 m/s, 0 m/s]"),
        ] {
            let refusal = refusal(kind, &[("bias", bias)]).expect("it is refused");
            assert!(refusal.contains("bias"), "{kind}: {refusal}");
        }
    }

    #[test]
    fn an_inertial_unit_names_the_part_and_the_key() {
        for (path, text) in [
            ("accelerometer.sigma", "-1 m/s^2"),
            ("accelerometer.walk", "1e300 m/s^2"),
            ("gyroscope.scale_sigma", "2"),
        ] {
            let refusal = refusal("imu", &[(path, text)]).expect("it is refused");
            let (part, key) = path.split_once('.').expect("a part and a key");
            assert!(refusal.contains(part) && refusal.contains(key), "{refusal}");
        }
    }

    #[test]
    fn a_density_without_its_unit_is_refused() {
        for text in ["160 ug", "160 ug/Hz", "160 uT/sqrt(Hz)"] {
            let params = [("density", text), ("bandwidth", "1 Hz")];
            assert!(refusal("accelerometer", &params).is_some(), "{text}");
        }
        let good = [("density", "160 ug/sqrt(Hz)"), ("bandwidth", "40 Hz")];
        assert_eq!(refusal("accelerometer", &good), None);
    }
}
