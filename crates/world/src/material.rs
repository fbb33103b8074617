//! Materials: how a thing looks, feels, and what it takes from a radio wave that goes through it.
//!
//! Walls of building materials are flat slabs of a lossy dielectric. With the frequency `f` in GHz,
//! ITU-R P.2040-3 (2023, section 2.1.4, table 3) gives relative permittivity and conductivity as
//!
//! ```text
//! epsilon' = a f^b,     sigma = c f^d in S/m                               (1)
//! eta = epsilon' - j 17.98 sigma / f                                       (2)
//! ```
//! and (section 2.2.2.2, at normal incidence) what goes through a slab of thickness `d`, all its inner
//! reflections included:
//!
//! ```text
//! r = (1 - sqrt(eta)) / (1 + sqrt(eta)),     q = 2 pi d sqrt(eta) / lambda      (3)
//! T = (1 - r^2) exp(-j q) / (1 - r^2 exp(-2 j q)),    loss = -20 log10 |T|      (4)
//! ```
//! Foliage has Weissberger's modified exponential decay (1982, ESD-TR-81-101), for 0.23 to 95 GHz and
//! up to 400 m of trees in leaf, with `d` in metres:
//!
//! ```text
//! loss = 0.45 f^0.284 d dB  up to 14 m,     1.33 f^0.284 d^0.588 dB  beyond     (5)
//! ```
//! The rows of table 3 were taken from two programs that print them and agree, the equations from
//! memory of the recommendation; neither document was at hand.

use crate::look::Color;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_units::{Decibels, Frequency, Length, constants::SPEED_OF_LIGHT, math};
use std::f64::consts::TAU;
use std::sync::LazyLock;

/// What a thing is made of. The losses of `loss`, `loss_per_metre` (or `table`), `slab` and `foliage`
/// add up; without any of them it takes nothing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Material {
    /// How objects call it. One that is built in may be defined anew.
    pub name: String,
    /// The colour of what is made of it and has none of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
    /// Coulomb friction, 0 to 1000, of what is made of it and has none of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// Restitution, 0 to 1, of what is made of it and has none of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// What it takes from a radio wave that goes through it once, however thick it is. Not negative.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loss: Option<Decibels>,
    /// What each metre of it takes from a radio wave, besides. Not negative.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loss_per_metre: Option<Decibels>,
    /// Both losses by frequency, in rising order, instead of `loss` and `loss_per_metre`. Between two
    /// rows they change evenly with the frequency, outside they stay.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub table: Vec<LossRow>,
    /// It is a flat slab of a dielectric.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slab: Option<Dielectric>,
    /// It is trees in leaf.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub foliage: bool,
}

/// What a material takes from a wave of one frequency.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LossRow {
    /// The frequency. Above 0.
    pub frequency: Frequency,
    /// Once, however thick it is. Not negative.
    #[serde(default)]
    pub loss: Decibels,
    /// For each metre. Not negative.
    #[serde(default)]
    pub loss_per_metre: Decibels,
}

/// The constants of a dielectric after ITU-R P.2040, equation 1 of [the module](self).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Dielectric {
    /// Relative permittivity at 1 GHz. 1 or more.
    pub a: f64,
    /// Exponent of the permittivity.
    #[serde(default)]
    pub b: f64,
    /// Conductivity at 1 GHz, S/m. Not negative.
    #[serde(default)]
    pub c: f64,
    /// Exponent of the conductivity.
    #[serde(default)]
    pub d: f64,
}

/// No more than this is ever lost, in decibels: metal lets nothing through.
pub const LOSS_DB_MAX: f64 = 300.0;
/// Foliage deeper than this follows the second part of equation 5, in metres.
const FOLIAGE_M: f64 = 14.0;
/// `1 / (2 pi epsilon_0 1 GHz)`, the constant of equation 2, as the recommendation rounds it.
const CONDUCTIVITY_TO_PERMITTIVITY: f64 = 17.98;

impl Material {
    /// What a wave of this frequency loses on its way through this thickness, at normal incidence: 0 dB
    /// to [`LOSS_DB_MAX`]. A thickness below 0 counts as 0; a frequency that is not above 0 loses
    /// nothing.
    pub fn loss(&self, frequency: Frequency, thickness: Length) -> Decibels {
        let thick_m = thickness.get().max(0.0);
        let ghz = frequency.get() * 1e-9;
        // False for what is no number, too.
        if !(ghz > 0.0 && thick_m.is_finite()) {
            return Decibels::ZERO;
        }
        let (once, per_metre) = self.measured(ghz);
        let mut loss_db = once + per_metre * thick_m;
        if let Some(slab) = self.slab {
            loss_db += slab.loss_db(ghz, thick_m);
        }
        if self.foliage {
            loss_db += foliage_db(ghz, thick_m);
        }
        Decibels::si(loss_db.min(LOSS_DB_MAX))
    }

    /// The losses that were given as numbers: once and for each metre, in decibels.
    fn measured(&self, ghz: f64) -> (f64, f64) {
        let db = |loss: Option<Decibels>| loss.unwrap_or_default().get();
        let row = |row: &LossRow| (row.loss.get(), row.loss_per_metre.get());
        let above = self
            .table
            .iter()
            .position(|row| row.frequency.get() * 1e-9 >= ghz);
        match (above, self.table.last()) {
            (_, None) => (db(self.loss), db(self.loss_per_metre)),
            (Some(0), _) => row(&self.table[0]),
            (None, Some(last)) => row(last),
            (Some(at), _) => {
                let (low, high) = (&self.table[at - 1], &self.table[at]);
                let span = high.frequency.get() - low.frequency.get();
                let share = (ghz * 1e9 - low.frequency.get()) / span;
                let between = |a: f64, b: f64| a + share * (b - a);
                let ((a0, a1), (b0, b1)) = (row(low), row(high));
                (between(a0, b0), between(a1, b1))
            }
        }
    }
}

impl Dielectric {
    /// Relative permittivity, equation 1: the square of how many times slower than light a wave goes in it.
    pub fn permittivity(self, frequency: Frequency) -> f64 {
        self.a * math::pow(frequency.get() * 1e-9, self.b)
    }

    /// Equations 1 to 4.
    fn loss_db(self, ghz: f64, thick_m: f64) -> f64 {
        let permittivity = self.a * math::pow(ghz, self.b);
        let conductivity = self.c * math::pow(ghz, self.d);
        let eta = Complex(
            permittivity,
            -CONDUCTIVITY_TO_PERMITTIVITY * conductivity / ghz,
        );
        let index = eta.sqrt();
        let r = Complex(1.0 - index.0, -index.1).over(Complex(1.0 + index.0, index.1));
        let r2 = r.times(r);
        let turns = TAU * thick_m * ghz * 1e9 / SPEED_OF_LIGHT.get();
        // exp(-j q), with q = turns * index: its size falls by the imaginary part of the index.
        let wave = Complex::polar(math::exp(turns * index.1), -turns * index.0);
        let through = Complex(1.0 - r2.0, -r2.1).times(wave);
        let echoes = r2.times(wave.times(wave));
        let size = through.over(Complex(1.0 - echoes.0, -echoes.1)).size();
        let loss_db = -20.0 * math::log10(size);
        // Below 0 by rounding only: a slab gives nothing.
        loss_db.max(0.0)
    }
}

/// Equation 5.
fn foliage_db(ghz: f64, deep_m: f64) -> f64 {
    let by_frequency = math::pow(ghz, 0.284);
    if deep_m <= FOLIAGE_M {
        0.45 * by_frequency * deep_m
    } else {
        1.33 * by_frequency * math::pow(deep_m, 0.588)
    }
}

/// A complex number: real and imaginary part.
#[derive(Clone, Copy)]
struct Complex(f64, f64);

impl Complex {
    fn polar(size: f64, angle: f64) -> Self {
        let (sin, cos) = math::sin_cos(angle);
        Self(size * cos, size * sin)
    }

    fn size(self) -> f64 {
        math::hypot(self.0, self.1)
    }

    fn times(self, other: Self) -> Self {
        Self(
            self.0 * other.0 - self.1 * other.1,
            self.0 * other.1 + self.1 * other.0,
        )
    }

    fn over(self, other: Self) -> Self {
        let square = other.0 * other.0 + other.1 * other.1;
        let product = self.times(Self(other.0, -other.1));
        Self(product.0 / square, product.1 / square)
    }

    /// The square root whose real part is not negative.
    fn sqrt(self) -> Self {
        let size = self.size();
        let imaginary = (0.5 * (size - self.0)).max(0.0).sqrt();
        Self(
            (0.5 * (size + self.0)).max(0.0).sqrt(),
            if self.1 < 0.0 { -imaginary } else { imaginary },
        )
    }
}

/// The materials that every world knows, in the order of their names.
///
/// | name | from |
/// |---|---|
/// | `brick`, `ceiling-board`, `chipboard`, `concrete`, `glass`, `marble`, `metal`, `plasterboard`, `plywood`, `wood` | ITU-R P.2040-3, table 3, the rows up to 100 GHz |
/// | `foliage` | Weissberger 1982 |
/// | `human-body` | 7 dB, the middle of the 6 to 8 dB that ITU-R P.1238 (effect of movement of objects in the room, measured at 1.7 GHz) has for a person who steps into the line of sight; quoted from memory, the document was not at hand |
///
/// Frictions and restitutions are rounded figures for a hard rubber or plastic body on the material,
/// from no source; a study of bounces sets its own.
pub static BUILT_IN: LazyLock<Vec<Material>> = LazyLock::new(|| {
    let slab = |name: &str, color: Color, [a, c, d]: [f64; 3], friction, restitution| Material {
        name: name.to_owned(),
        color: Some(color),
        friction: Some(friction),
        restitution: Some(restitution),
        slab: Some(Dielectric { a, b: 0.0, c, d }),
        ..Material::default()
    };
    let rgb = Color::rgb;
    vec![
        slab("brick", rgb(156, 83, 62), [3.91, 0.0238, 0.16], 0.6, 0.3),
        slab(
            "ceiling-board",
            rgb(225, 223, 214),
            [1.48, 0.0011, 1.075],
            0.5,
            0.1,
        ),
        slab(
            "chipboard",
            rgb(190, 154, 104),
            [2.58, 0.0217, 0.78],
            0.5,
            0.3,
        ),
        slab(
            "concrete",
            rgb(150, 150, 146),
            [5.24, 0.0462, 0.7822],
            0.6,
            0.3,
        ),
        Material {
            name: "foliage".to_owned(),
            color: Some(rgb(60, 110, 50)),
            friction: Some(0.8),
            restitution: Some(0.0),
            foliage: true,
            ..Material::default()
        },
        slab(
            "glass",
            Color::rgba(190, 215, 220, 96),
            [6.31, 0.0036, 1.3394],
            0.4,
            0.4,
        ),
        Material {
            name: "human-body".to_owned(),
            friction: Some(0.5),
            restitution: Some(0.0),
            loss: Some(Decibels::from_db(7.0)),
            ..Material::default()
        },
        slab(
            "marble",
            rgb(226, 221, 214),
            [7.074, 0.0055, 0.9262],
            0.4,
            0.4,
        ),
        slab("metal", rgb(166, 170, 175), [1.0, 1e7, 0.0], 0.4, 0.4),
        slab(
            "plasterboard",
            rgb(232, 229, 220),
            [2.73, 0.0085, 0.9395],
            0.5,
            0.2,
        ),
        slab("plywood", rgb(202, 168, 118), [2.71, 0.33, 0.0], 0.5, 0.3),
        slab("wood", rgb(158, 118, 72), [1.99, 0.0047, 1.0718], 0.5, 0.3),
    ]
});

#[cfg(test)]
mod tests {
    use super::*;

    fn built_in(name: &str) -> &'static Material {
        let found = BUILT_IN.iter().find(|m| m.name == name);
        found.expect("it is built in")
    }

    fn loss_db(material: &Material, ghz: f64, thick_m: f64) -> f64 {
        let frequency = Frequency::from_gigahertz(ghz);
        material.loss(frequency, Length::si(thick_m)).get()
    }

    fn lossless(permittivity: f64) -> Material {
        Material {
            slab: Some(Dielectric {
                a: permittivity,
                b: 0.0,
                c: 0.0,
                d: 0.0,
            }),
            ..Material::default()
        }
    }

    /// A slab of half a wavelength lets all through, one of a quarter takes
    /// `10 log10(1 + ((n^2 - 1) / (2 n))^2)`: textbook optics.
    #[test]
    fn a_lossless_slab_takes_what_the_closed_form_says() {
        let (ghz, n) = (2.0, 2.0);
        let wave_m = SPEED_OF_LIGHT.get() / (ghz * 1e9) / n;
        let glass = lossless(n * n);
        assert!(loss_db(&glass, ghz, 0.5 * wave_m).abs() < 1e-9);
        let f = (n * n - 1.0) / (2.0 * n);
        let want = 10.0 * math::log10(1.0 + f * f);
        assert!((loss_db(&glass, ghz, 0.25 * wave_m) - want).abs() < 1e-9);
        assert!(loss_db(&glass, ghz, 0.0).abs() < 1e-12);
    }

    /// In a thick lossy slab each metre takes `8.686 * 2 pi / lambda * Im(n)`, and the two faces the
    /// rest, once.
    #[test]
    fn a_thick_lossy_slab_takes_the_same_from_each_metre() {
        let concrete = built_in("concrete");
        let per_metre = loss_db(concrete, 2.4, 3.0) - loss_db(concrete, 2.4, 2.0);
        let sigma = 0.0462 * math::pow(2.4, 0.7822);
        let (real, imaginary) = (5.24_f64, 17.98 * sigma / 2.4);
        let size = (real * real + imaginary * imaginary).sqrt();
        let index = (0.5 * (size - real)).sqrt();
        let want = 20.0 / math::ln(10.0) * TAU * 2.4e9 / SPEED_OF_LIGHT.get() * index;
        assert!(
            (per_metre - want).abs() < 1e-6,
            "{per_metre} dB, not {want}"
        );
    }

    #[test]
    fn walls_take_what_walls_take() {
        let range = |name, thick_m, from: f64, to: f64| {
            let loss = loss_db(built_in(name), 2.45, thick_m);
            assert!((from..to).contains(&loss), "{name}: {loss} dB");
        };
        range("plasterboard", 0.025, 0.0, 2.0);
        range("wood", 0.04, 0.0, 2.0);
        range("brick", 0.1, 1.0, 8.0);
        range("concrete", 0.2, 8.0, 25.0);
        range("metal", 0.001, LOSS_DB_MAX, LOSS_DB_MAX + 1.0);
        range("human-body", 0.3, 7.0, 7.1);
    }

    #[test]
    fn foliage_follows_weissberger() {
        let foliage = built_in("foliage");
        assert!((loss_db(foliage, 1.0, 10.0) - 4.5).abs() < 1e-12);
        let want = 1.33 * math::pow(100.0, 0.588);
        assert!((loss_db(foliage, 1.0, 100.0) - want).abs() < 1e-12);
    }

    #[test]
    fn a_table_is_even_between_its_rows_and_held_outside() {
        let row = |mhz: f64, once: f64, per_metre: f64| LossRow {
            frequency: Frequency::from_megahertz(mhz),
            loss: Decibels::from_db(once),
            loss_per_metre: Decibels::from_db(per_metre),
        };
        let material = Material {
            table: vec![row(900.0, 2.0, 10.0), row(2400.0, 5.0, 40.0)],
            ..Material::default()
        };
        assert_eq!(loss_db(&material, 0.4, 0.5), 2.0 + 5.0);
        assert_eq!(loss_db(&material, 5.8, 0.5), 5.0 + 20.0);
        assert!((loss_db(&material, 1.65, 0.5) - (3.5 + 12.5)).abs() < 1e-9);
    }

    #[test]
    fn losses_add_up_and_nonsense_loses_nothing() {
        let material = Material {
            loss: Some(Decibels::from_db(3.0)),
            loss_per_metre: Some(Decibels::from_db(20.0)),
            ..Material::default()
        };
        assert_eq!(loss_db(&material, 2.4, 0.25), 8.0);
        assert_eq!(loss_db(&material, 2.4, -1.0), 3.0);
        assert_eq!(loss_db(&material, 0.0, 1.0), 0.0);
        assert_eq!(loss_db(&material, f64::NAN, 1.0), 0.0);
    }

    #[test]
    fn names_are_in_order_and_only_once() {
        assert!(BUILT_IN.windows(2).all(|pair| pair[0].name < pair[1].name));
    }
}
