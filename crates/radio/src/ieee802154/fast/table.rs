//! The logarithm of a bit's chance from a table.

use crate::ieee802154::Quirks;
use crate::ieee802154::air::Modulation;
use simbeeotic_units::math;

/// The logarithm of the chance of one bit, over the linear SINR.
///
/// Steps are told by the top bits of `SINR + offset`, with an offset a few times smaller than the
/// ratios where bits begin to survive: so steps are even below, and 256 an octave above. The table ends
/// where no bit is lost any more. All that is looked up lies in some 10 KiB.
#[derive(Debug)]
pub(super) struct Table {
    ns_per_bit: f32,
    /// A power of two.
    offset: f32,
    /// The last ratio, offset included.
    most: f32,
    /// Value at the start of each step, and what it grows by over the step.
    steps: Vec<[f32; 2]>,
}

const STEP_BITS: u32 = 8;
const REST_BITS: u32 = f32::MANTISSA_DIGITS - 1 - STEP_BITS;

/// No table is longer than so many octaves.
const OCTAVES_MAX: usize = 24;

/// Fewer errors than this in a bit are none in any frame.
const NO_ERROR: f64 = 1e-19;

impl Table {
    pub(super) fn new(modulation: &Modulation) -> Self {
        let errors = modulation.errors.as_ref();
        // The octave in which one bit of a thousand is lost.
        let octave = (-40..40).find(|&octave| errors.bit_error(two_to(octave)) < 1e-3);
        let offset = two_to(octave.unwrap_or(0) - 3);
        let first = (offset as f32).to_bits() >> REST_BITS;
        let at = |step: u32| f64::from(f32::from_bits((first + step) << REST_BITS)) - offset;
        let ln_bit = |sinr: f64| {
            let error = errors.bit_error(sinr).min(1.0 - 1e-9);
            if error < NO_ERROR {
                0.0
            } else {
                math::ln_1p(-error)
            }
        };
        let mut steps = Vec::new();
        for step in 0..(OCTAVES_MAX << STEP_BITS) as u32 {
            let (from, to) = (ln_bit(at(step)), ln_bit(at(step + 1)));
            steps.push([from as f32, (to - from) as f32]);
            if from == 0.0 {
                break;
            }
        }
        let last = (first + steps.len() as u32) << REST_BITS;
        Self {
            ns_per_bit: modulation.ns_per_bit as f32,
            offset: offset as f32,
            most: f32::from_bits(last - 1),
            steps,
        }
    }

    #[inline(always)]
    pub(super) fn bits(&self, ns: f32, quirks: Quirks) -> f32 {
        let bits = ns / self.ns_per_bit;
        if quirks == Quirks::Ns3 {
            // `ceil` would be a call.
            let whole = bits as i32 as f32;
            whole + f32::from(u8::from(whole < bits))
        } else {
            bits
        }
    }

    /// The step of a ratio (0 or more), and how far into it, 0 to 1.
    #[inline(always)]
    pub(super) fn place(&self, sinr: f32) -> (u32, f32) {
        let shifted = sinr + self.offset;
        let held = if shifted < self.most {
            shifted
        } else {
            self.most
        };
        let bits = held.to_bits().wrapping_sub(self.offset.to_bits());
        let rest = (bits & ((1 << REST_BITS) - 1)) as i32 as f32;
        (bits >> REST_BITS, rest * (1.0 / (1 << REST_BITS) as f32))
    }

    #[inline(always)]
    pub(super) fn between(&self, step: u32, rest: f32) -> f32 {
        let [from, by] = self.steps[step as usize];
        from + rest * by
    }

    #[inline(always)]
    pub(super) fn ln_bit(&self, sinr: f32) -> f32 {
        let (step, rest) = self.place(sinr);
        self.between(step, rest)
    }
}

/// `2^exponent`, exactly.
fn two_to(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phy::{BitErrors, OqpskDsss};
    use std::sync::Arc;

    #[test]
    fn the_table_keeps_to_the_formula() {
        let modulation = Modulation {
            errors: Arc::new(OqpskDsss),
            ns_per_bit: 4000.0,
        };
        let table = Table::new(&modulation);
        for i in 0..6000 {
            let sinr = math::pow(10.0, (f64::from(i) * 0.01 - 30.0) / 10.0);
            for bits in [1.0, 64.0, 1064.0] {
                let exact = OqpskDsss.success(sinr, bits);
                let ln_success = bits * f64::from(table.ln_bit(sinr as f32));
                let error = (math::exp(ln_success) - exact).abs();
                assert!(error < 6e-5, "{sinr} {bits}: off by {error}");
            }
        }
    }
}
