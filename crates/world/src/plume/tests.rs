//! The steady plume against its closed forms.

use super::*;
use crate::field::tests::assert_gradient;
use crate::weather::Calm;
use simbeeotic_units::{Concentration, Enu, Velocity};

/// The same wind everywhere.
#[derive(Debug)]
pub(crate) struct Breeze(pub(crate) DVec3);

impl Weather for Breeze {
    fn wind(&self, _: Position, _: SimTime) -> Velocity<Enu> {
        Velocity::from_si(self.0)
    }
}

pub(crate) fn source(height_m: f64, stability: Stability) -> Source {
    Source {
        position: Position::from_xyz(0.0, 0.0, height_m),
        rate: MassRate::si(2.0),
        stability,
        ..Source::default()
    }
}

const CLASSES: [Stability; 6] = [
    Stability::A,
    Stability::B,
    Stability::C,
    Stability::D,
    Stability::E,
    Stability::F,
];

fn late() -> SimTime {
    SimTime::from_secs(100_000)
}

/// Briggs' own formulas at 1 km, in metres, to three digits.
#[test]
fn the_spread_is_that_of_the_table() {
    let wanted = [
        (209.8, 200.0),
        (152.6, 120.0),
        (104.9, 73.03),
        (76.28, 37.95),
        (57.21, 23.08),
        (38.14, 12.31),
    ];
    for (class, (across, up)) in CLASSES.into_iter().zip(wanted) {
        let s = class.spread(1_000.0, 0.0);
        assert!(
            (s.across.sqrt() / across - 1.0).abs() < 1e-3,
            "{class:?}: {}",
            s.across.sqrt()
        );
        assert!(
            (s.up.sqrt() / up - 1.0).abs() < 1e-3,
            "{class:?}: {}",
            s.up.sqrt()
        );
        let next = class.spread(1_000.001, 0.0);
        let slopes = ((next.across - s.across) / 0.001, (next.up - s.up) / 0.001);
        assert!((slopes.0 / s.across_slope - 1.0).abs() < 1e-4, "{class:?}");
        assert!((slopes.1 / s.up_slope - 1.0).abs() < 1e-4, "{class:?}");
        assert_eq!(class.spread(-5.0, 0.3).across, 0.09);
    }
}

#[test]
fn on_the_ground_downwind_it_is_the_textbook_formula() {
    let source = source(0.0, Stability::D);
    let wind = Breeze(DVec3::new(3.0, 4.0, 0.0));
    let at = DVec3::new(300.0, 400.0, 0.0);
    let (found, _) = source.sample(at, late(), &wind, None);
    let (sy, sz) = (
        0.08 * 500.0 / 1.05_f64.sqrt(),
        0.06 * 500.0 / 1.75_f64.sqrt(),
    );
    let wanted = 2.0 / (PI * 5.0 * sy * sz);
    assert!((found / wanted - 1.0).abs() < 1e-4, "{found}, {wanted}");
}

#[test]
fn the_flux_through_each_plane_is_what_the_source_gives() {
    for (class, height) in [
        (Stability::A, 0.0),
        (Stability::D, 1.0),
        (Stability::F, 20.0),
    ] {
        let source = source(height, class);
        let wind = Breeze(DVec3::new(0.0, 2.0, 0.0));
        for x in [1.0, 10.0, 200.0] {
            let s = class.spread(x, 0.1);
            let (wide, high) = (8.0 * s.across.sqrt(), height + 8.0 * s.up.sqrt());
            let steps = 400;
            let mut flux = 0.0;
            for i in 0..steps {
                for j in 0..steps {
                    let y = wide * (2.0 * (f64::from(i) + 0.5) / f64::from(steps) - 1.0);
                    let z = high * (f64::from(j) + 0.5) / f64::from(steps);
                    flux += source.sample(DVec3::new(-y, x, z), late(), &wind, None).0;
                }
            }
            flux *= 2.0 * (2.0 * wide / f64::from(steps)) * (high / f64::from(steps));
            assert!(
                (flux / 2.0 - 1.0).abs() < 1e-3,
                "{class:?} at {x} m: {flux} kg/s"
            );
        }
    }
}

#[test]
fn the_gradient_is_that_of_the_value() {
    for class in [Stability::A, Stability::D, Stability::F] {
        let source = source(1.5, class);
        for wind in [
            DVec3::new(2.0, -1.0, 0.0),
            DVec3::new(0.2, 0.1, 0.0),
            DVec3::ZERO,
        ] {
            let wind = Breeze(wind);
            for at in [
                DVec3::new(30.0, -14.0, 1.0),
                DVec3::new(4.0, -2.2, 1.8),
                DVec3::new(0.05, 0.02, 1.45),
                DVec3::new(-0.1, 0.0, 1.6),
            ] {
                assert_gradient(|p| source.sample(p, late(), &wind, None), at, 1e-5);
            }
        }
    }
}

#[test]
fn a_calm_leaves_it_finite_everywhere_and_a_breath_changes_little() {
    let source = source(1.0, Stability::B);
    let calm = |at| source.sample(at, late(), &Calm, None).0;
    let at_source = calm(DVec3::Z);
    // Q / ((2 pi)^1.5 w s0^2), and a bit from the mirror image 2 m below.
    let alone = 2.0 / (TAU * TAU.sqrt() * 0.16 * 0.5 * 0.01);
    assert!(
        at_source > alone && at_source < 1.01 * alone,
        "{at_source}, {alone}"
    );
    // Far away: 2 Q / ((2 pi)^1.5 w r^2) on the ground.
    let far = calm(DVec3::new(500.0, 0.0, 0.0));
    let wanted = 2.0 * 2.0 / (TAU * TAU.sqrt() * 0.08 * 250_000.0);
    assert!((far / wanted - 1.0).abs() < 1e-3, "{far}, {wanted}");
    let place = DVec3::new(3.0, 1.0, 1.0);
    let breath = Breeze(DVec3::new(1e-6, 0.0, 0.0));
    let (still, moved) = (calm(place), source.sample(place, late(), &breath, None).0);
    assert!((moved / still - 1.0).abs() < 1e-4, "{still}, {moved}");
    // Continuous where the mixture ends.
    let at = |speed: f64| {
        source
            .sample(place, late(), &Breeze(DVec3::X * speed), None)
            .0
    };
    assert!((at(0.499_999) / at(0.500_001) - 1.0).abs() < 1e-4);
}

#[test]
fn dawsons_integral_has_the_values_of_the_tables() {
    // Abramowitz and Stegun, table 7.5.
    for (b, dawson) in [
        (0.5, 0.424_436_383_5),
        (1.0, 0.538_079_506_9),
        (2.0, 0.301_340_388_9),
    ] {
        assert!((dawson_over_b(b).0 * b - dawson).abs() < 1e-9, "{b}");
    }
    assert_eq!(dawson_over_b(0.0), (1.0, 0.0));
    let (below, above) = (dawson_over_b(0.999_999e-3), dawson_over_b(1.000_001e-3));
    assert!((below.0 - above.0).abs() < 1e-8 && (below.1 - above.1).abs() < 1e-7);
    // 1 / (2 b^2) far out.
    assert!((dawson_over_b(100.0).0 * 20_000.0 - 1.0).abs() < 1e-4);
}

#[test]
fn a_plume_begins_and_ends_with_its_source_as_far_as_the_wind_has_come() {
    let short = Source {
        start: Time::si(10.0),
        end: Some(Time::si(20.0)),
        ..source(0.0, Stability::D)
    };
    let wind = Breeze(DVec3::new(2.0, 0.0, 0.0));
    let at = |x: f64, t: u64| {
        short
            .sample(DVec3::new(x, 0.0, 0.0), SimTime::from_secs(t), &wind, None)
            .0
    };
    assert_eq!(at(10.0, 9), 0.0);
    assert_eq!(at(10.0, 14), 0.0);
    assert!(at(10.0, 16) > 0.0 && at(10.0, 24) > 0.0);
    assert_eq!(at(10.0, 26), 0.0);
}

#[test]
fn sources_of_one_gas_add_up_and_other_gases_are_others() {
    let one = source(1.0, Stability::C);
    let two = Source {
        position: Position::from_xyz(0.0, 3.0, 0.5),
        ..one.clone()
    };
    let other = Source {
        gas: "smoke".into(),
        ..one.clone()
    };
    let world = crate::World {
        sources: vec![one.clone(), two.clone(), other],
        ..crate::World::default()
    };
    let (wind, at) = (Breeze(DVec3::X), Position::from_xyz(9.0, 1.0, 1.0));
    let sum =
        one.sample(at.si(), late(), &wind, None).0 + two.sample(at.si(), late(), &wind, None).0;
    assert_eq!(
        world.gas_at("gas", at, late(), &wind),
        Concentration::si(sum)
    );
    assert!(world.gas_at("smoke", at, late(), &wind).get() > 0.0);
    assert_eq!(world.gas_at("perfume", at, late(), &wind).get(), 0.0);
}

#[test]
fn nonsense_is_named() {
    let keys = |source: Source| {
        source
            .faults()
            .into_iter()
            .map(|(key, _)| key)
            .collect::<Vec<_>>()
    };
    let good = Source::default;
    assert!(keys(good()).is_empty());
    assert_eq!(
        keys(Source {
            gas: " ".into(),
            ..good()
        }),
        ["gas"]
    );
    assert_eq!(
        keys(Source {
            rate: MassRate::si(-1.0),
            ..good()
        }),
        ["rate"]
    );
    assert_eq!(
        keys(Source {
            position: Position::from_xyz(0.0, 0.0, -1.0),
            ..good()
        }),
        ["position"]
    );
    assert_eq!(
        keys(Source {
            end: Some(Time::si(-1.0)),
            ..good()
        }),
        ["end"]
    );
    assert_eq!(
        keys(Source {
            start: Time::si(f64::NAN),
            ..good()
        }),
        ["start"]
    );
}
