//! The fast air against the exact one, on random schedules.

use super::Quirks;
use super::air::{Air, Modulation, OnAir, Receiver, Reception, luck};
use super::exact::ExactAir;
use super::fast::FastAir;
use super::members::{Members, Source};
use crate::cc2420;
use crate::phy::OqpskDsss;
use proptest::prelude::*;
use simbeeotic_kernel::SimTime;
use simbeeotic_kernel::rng::draw_u64;
use simbeeotic_units::{PowerLevel, math};
use std::sync::Arc;

/// Time on the air, so short that many frames meet.
const STEP_NS: u64 = 64_000;

#[derive(Clone, Debug)]
enum Deed {
    /// A frame from a row: when, how long (steps and a rest in ns), how strong at each row, dBm.
    Frame(u64, u64, u64, usize, Vec<f64>),
    /// A row stops or starts listening.
    Listen(u64, usize, bool),
}

impl Deed {
    fn at_ns(&self) -> u64 {
        match self {
            Self::Frame(step, _, rest, ..) => step * STEP_NS + rest,
            Self::Listen(step, ..) => step * STEP_NS,
        }
    }
}

const ROWS: usize = 6;

fn deeds() -> impl Strategy<Value = Vec<Deed>> {
    // Half of the frames begin on a common step: equal starts, and ends on starts.
    let rest = prop_oneof![Just(0u64), 0..STEP_NS];
    // Weak ones near the noise, strong ones far above it.
    let power = prop_oneof![-112.0..-95.0f64, -104.0..-98.0f64, -90.0..-5.0f64];
    let powers = prop::collection::vec(power, ROWS);
    let frame = (0..120u64, 1..30u64, rest, 0..ROWS, powers)
        .prop_map(|(step, steps, rest, row, powers)| Deed::Frame(step, steps, rest, row, powers));
    let listen =
        (0..120u64, 0..ROWS, any::<bool>()).prop_map(|(step, row, on)| Deed::Listen(step, row, on));
    prop::collection::vec(prop_oneof![5 => frame, 1 => listen], 1..40)
}

fn source() -> Source {
    let mut members = Members::default();
    let row = members.join(0, &cc2420::spec(11, 31).expect("it exists"));
    members.source(row, 0, 1.0, SimTime::ZERO)
}

/// What an air made of a schedule.
struct Played {
    air: Box<dyn Air>,
    /// Key of the frame and the reception.
    receptions: Vec<(u64, Reception)>,
    /// Power, and what is being taken in, at each row after each change.
    sights: Vec<(f64, Option<u64>)>,
}

fn salt(row: usize) -> u32 {
    draw_u64(9, row as u64, 1) as u32
}

fn play(mut air: Box<dyn Air>, deeds: &[Deed]) -> Played {
    for ns_per_bit in [4000.0, 1000.0] {
        air.learn(&Modulation {
            errors: Arc::new(OqpskDsss),
            ns_per_bit,
        });
    }
    for row in 0..ROWS {
        let receiver = Receiver {
            noise_mw: PowerLevel::from_dbm(-101.0).milliwatts() as f32,
            sensitivity_mw: if row == 1 { 1e-10 } else { 0.0 },
            lock: 0.316_227_77,
            modulation: u32::from(row == 4),
            co_channel: if row == 3 { 4.0 } else { 1.0 },
            salt: salt(row),
        };
        air.join(row, receiver);
        air.listen(row, 0, true);
    }
    // (time, 0 for ends, number of the deed)
    let mut agenda: Vec<(u64, u8, usize)> = Vec::new();
    for (at, deed) in deeds.iter().enumerate() {
        agenda.push((deed.at_ns(), 1, at));
        if let Deed::Frame(_, steps, ..) = deed {
            agenda.push((deed.at_ns() + steps * STEP_NS, 0, at));
        }
    }
    agenda.sort_unstable();
    let (source, mut on) = (source(), [true; ROWS]);
    // Numbers grow in the order of starts.
    let (mut ids, mut next_id) = (vec![0; deeds.len()], u32::MAX - 3);
    let (mut receptions, mut sights) = (Vec::new(), Vec::new());
    for (now_ns, what, at) in agenda {
        let key = draw_u64(1, at as u64, 0);
        match &deeds[at] {
            Deed::Frame(.., row, powers) if what == 1 => {
                let mut powers_mw: Vec<f32> = powers
                    .iter()
                    .map(|&dbm| PowerLevel::from_dbm(dbm).milliwatts() as f32)
                    .collect();
                powers_mw[*row] = 0.0;
                next_id = next_id.wrapping_add(1).max(1);
                ids[at] = next_id;
                air.start(OnAir {
                    id: ids[at],
                    key,
                    modulation: u32::from(at % 7 == 6),
                    start_ns: now_ns,
                    counted: at % 5 != 4,
                    source: source.clone(),
                    powers_mw,
                });
            }
            Deed::Frame(..) => {
                let mut heard = Vec::new();
                air.end(ids[at], now_ns, &mut heard);
                receptions.extend(heard.into_iter().map(|r| (key, r)));
            }
            Deed::Listen(_, row, listening) => {
                if on[*row] != *listening {
                    on[*row] = *listening;
                    air.listen(*row, now_ns, *listening);
                }
            }
        }
        sights.extend((0..ROWS).map(|row| {
            let taking = air.taking(row).map(|taking| taking.since_ns);
            (air.total_mw(row), taking)
        }));
    }
    Played {
        air,
        receptions,
        sights,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn fast_and_exact_air_agree(deeds in deeds(), ns3 in any::<bool>()) {
        let quirks = if ns3 { Quirks::Ns3 } else { Quirks::None };
        let fast = play(Box::new(FastAir::new(quirks)), &deeds);
        let exact = play(Box::new(ExactAir::new(quirks)), &deeds);

        for (f, e) in fast.sights.iter().zip(&exact.sights) {
            // Rounded to 2^-50 mW, 40 frames at most.
            prop_assert!((f.0 - e.0).abs() < 40.0 * 4.5e-16, "{f:?} {e:?}");
            prop_assert_eq!(f.1, e.1);
        }

        let mut close_calls = [0u64; ROWS];
        let find = |list: &[(u64, Reception)], key, row| {
            list.iter().find(|(k, r)| (*k, r.row) == (key, row)).map(|(_, r)| *r)
        };
        for (one, other) in [(&fast, &exact), (&exact, &fast)] {
            for &(key, reception) in &one.receptions {
                let chance = math::exp(reception.ln_success.into());
                match find(&other.receptions, key, reception.row) {
                    Some(twin) => {
                        let twin_chance = math::exp(twin.ln_success.into());
                        prop_assert!((chance - twin_chance).abs() < 1e-4);
                        prop_assert_eq!(reception.power_mw, twin.power_mw);
                        prop_assert!((reception.sinr / twin.sinr - 1.0).abs() < 1e-3);
                    }
                    None => {
                        let luck = luck(key, salt(reception.row as usize));
                        prop_assert!((chance - luck).abs() < 1e-4, "{chance} {luck}");
                        close_calls[reception.row as usize] += 1;
                    }
                }
            }
        }
        for (row, close_calls) in close_calls.into_iter().enumerate() {
            let (f, e) = (fast.air.tally(row), exact.air.tally(row));
            prop_assert_eq!((f.heard, f.dropped, f.rx_ns), (e.heard, e.dropped, e.rx_ns));
            prop_assert!(f.got.abs_diff(e.got) <= close_calls);
            prop_assert!(f.noise.abs_diff(e.noise) <= 1 + close_calls);
        }
    }
    #[test]
    fn frames_that_reach_nobody_change_no_bit(deeds in deeds(), far in deeds()) {
        let far = far.into_iter().filter_map(|deed| match deed {
            Deed::Frame(step, steps, rest, row, powers) => {
                let nothing = vec![f64::NEG_INFINITY; powers.len()];
                Some(Deed::Frame(step, steps, rest, row, nothing))
            }
            Deed::Listen(..) => None,
        });
        let mut all = deeds.clone();
        all.extend(far);
        let near = |(key, reception): &(u64, Reception)| (*key, *reception);
        for exact in [false, true] {
            let air = || -> Box<dyn Air> {
                match exact {
                    true => Box::new(ExactAir::new(Quirks::None)),
                    false => Box::new(FastAir::new(Quirks::None)),
                }
            };
            let (alone, among) = (play(air(), &deeds), play(air(), &all));
            let by = |played: &Played| -> Vec<(u64, Reception)> {
                let mut list: Vec<_> = played.receptions.iter().map(near).collect();
                list.sort_by_key(|(key, reception)| (*key, reception.row));
                list
            };
            // Powers, chances and ratios are compared to the bit.
            prop_assert_eq!(by(&alone), by(&among));
            for row in 0..ROWS {
                prop_assert_eq!(alone.air.tally(row), among.air.tally(row));
            }
        }
    }
}
