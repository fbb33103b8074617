//! What the comparisons share: a clock that others on the machine do not push, chance, and scenes
//! that are the same to the last digit for whoever is measured.

use rustix::time::{ClockId, clock_gettime};
use simbeeotic_units::glam::DVec3;

/// Processor time of this process since it began, s.
pub fn cpu_s() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

/// Processor time of `work`, s.
pub fn time_of(work: impl FnOnce()) -> f64 {
    let begun = cpu_s();
    work();
    cpu_s() - begun
}

/// The least of some figures: what a machine's other work adds is never negative.
pub fn least(figures: &[f64]) -> f64 {
    figures.iter().copied().fold(f64::INFINITY, f64::min)
}

/// Numbers on the command line, or these.
pub fn numbers(default: &[usize]) -> Vec<usize> {
    let given: Vec<usize> = std::env::args()
        .filter_map(|word| word.parse().ok())
        .collect();
    if given.is_empty() {
        default.to_vec()
    } else {
        given
    }
}

/// One thread for all: Rapier's default features know no other.
pub fn on_one_thread() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1);
    pool.build_global()
        .expect("nothing has run in parallel yet");
}

/// Chance: SplitMix64.
#[derive(Clone, Debug)]
pub struct Dice(pub u64);

impl Dice {
    /// 64 random bits.
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// Between `-most` and `most`.
    pub fn within(&mut self, most: f64) -> f64 {
        ((self.word() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0) * most
    }

    /// In a cube of which `most` is half the edge.
    pub fn vector(&mut self, most: f64) -> DVec3 {
        DVec3::new(self.within(most), self.within(most), self.within(most))
    }
}

/// Places for `count` bodies of 0.1 m radius, one in each cube of 2 m: none touches another.
pub fn one_per_8_m3(count: usize, dice: &mut Dice) -> Vec<DVec3> {
    let side = (1..).find(|side| side * side * side >= count).unwrap_or(1);
    let cell = |id: usize| [id / side / side, id / side % side, id % side].map(|c| c as f64);
    (0..count)
        .map(|id| DVec3::from_array(cell(id)) * 2.0 + dice.vector(0.89))
        .collect()
}
