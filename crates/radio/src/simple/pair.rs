//! One pair of sender and receiver, a million times over.
//!
//! Rows of pairs are worked column by column in plain loops over slices that the compiler turns into
//! vector code. There are two kinds of rows, one receiver with many frames and one frame with many
//! receivers, and one set of rules for a pair: [`square`], [`received_mw`], [`slot`], [`draw_u32`].
//! Both kinds give the same bits for the same pair.

use super::band::{Air, Members};
use super::success::{LEAST, SLOTS, slot};
use crate::aim::{self, End};
use crate::inbox::Hit;
use crate::medium::Poses;
use crate::propagation::{FrameKeys, Links, Propagation, Role};
use crate::scratch::{ROW, Row, Scratch};
use simbeeotic_kernel::rng::draw_u32;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_units::Frequency;
use std::ops::Range;

/// The numbers of many receivers, a column each.
#[derive(Debug, Default)]
pub(super) struct Listeners {
    /// East, north, up, metres; NaN for who does not listen.
    pub(super) enu_m: [Vec<f32>; 3],
    pub(super) radios: Vec<u32>,
    pub(super) radio_keys: Vec<u64>,
    /// Gain of an antenna without direction, linear; 1 for those with one.
    pub(super) gains: Vec<f32>,
    pub(super) sensitivities_mw: Vec<f32>,
    /// What the luck of the receiver hangs on.
    pub(super) salts: Vec<u32>,
}

impl Listeners {
    pub(super) fn clear(&mut self) {
        self.enu_m.iter_mut().for_each(Vec::clear);
        self.radios.clear();
        self.radio_keys.clear();
        self.gains.clear();
        self.sensitivities_mw.clear();
        self.salts.clear();
    }

    /// Adds what `other` has at `at`, at another place.
    #[inline]
    pub(super) fn push_copy(&mut self, other: &Self, at: usize, place: [f32; 3]) {
        for (axis, x) in self.enu_m.iter_mut().zip(place) {
            axis.push(x);
        }
        self.radios.push(other.radios[at]);
        self.radio_keys.push(other.radio_keys[at]);
        self.gains.push(other.gains[at]);
        self.sensitivities_mw.push(other.sensitivities_mw[at]);
        self.salts.push(other.salts[at]);
    }
}

/// What is the same for all pairs of a band and round.
pub(super) struct Between<'a> {
    /// Whom to ask for what stands between two antennas, if that counts.
    pub(super) walls: Option<&'a dyn Poses>,
    /// If chance goes by distance: what makes a place in a table of the square of the distance, 1/m².
    pub(super) per_m2: Option<f32>,
    pub(super) propagation: &'a dyn Propagation,
    pub(super) frequency: Frequency,
    pub(super) time: SimTime,
    pub(super) range_squared_m2: f32,
    /// Whether any antenna on the band has a direction.
    pub(super) directed: bool,
}

/// How many frames of a row came within range, and how many of these above the sensitivity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Reach {
    pub(super) in_range: u64,
    pub(super) audible: u64,
}

#[inline(always)]
fn square(a: [f32; 3], b: [f32; 3]) -> f32 {
    let (x, y, z) = (a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    x * x + y * y + z * z
}

#[inline(always)]
fn received_mw(eirp_mw: f32, gain: f32, antenna_gain: f32) -> f32 {
    eirp_mw * gain * antenna_gain
}

/// Makes the draw of a pair that is too weak the highest there is, which is not below any chance.
#[inline(always)]
fn no_luck(audible: bool) -> u32 {
    u32::from(audible).wrapping_sub(1)
}

/// A key from its halves. They lie in columns of their own since vectors of 64-bit words are half as
/// long.
#[inline(always)]
fn whole(low: u32, high: u32) -> u64 {
    u64::from(high) << 32 | u64::from(low)
}

/// The `n` entries of a column in `range`. Says the length twice, so that the compiler sees that all
/// columns of a row have the same.
#[inline(always)]
fn cut<'a, T>(column: &'a [T], range: &Range<usize>, n: usize) -> &'a [T] {
    &column[range.start..range.end][..n]
}

/// One receiver and some frames: fills `row` with one entry for each frame of `range`, which holds
/// at most [`ROW`].
pub(super) fn listen(
    row: &mut Row,
    members: &Members,
    me: usize,
    air: &Air,
    range: Range<usize>,
    between: &Between<'_>,
) -> Reach {
    let c = &members.columns;
    let n = range.len();
    let here = [c.enu_m[0][me], c.enu_m[1][me], c.enu_m[2][me]];
    let x = cut(&air.enu_m[0], &range, n);
    let y = cut(&air.enu_m[1], &range, n);
    let z = cut(&air.enu_m[2], &range, n);

    let radio = c.radios[me];
    let radios = cut(&air.radios, &range, n);
    let squares = &mut row.squares_m2[..n];
    for j in 0..n {
        let square = square([x[j], y[j], z[j]], here);
        squares[j] = if radios[j] == radio { f32::NAN } else { square };
    }

    let squares = &row.squares_m2[..n];
    let gains = &mut row.gains[..n];
    let keys = cut(&air.keys, &range, n);
    let links = Links {
        frequency: between.frequency,
        time: between.time,
        near_is: Role::Receiver,
        near_enu_m: here,
        near_key: c.radio_keys[me],
        far_enu_m: [x, y, z],
        far_keys: cut(&air.radio_keys, &range, n),
        distances_squared_m2: squares,
        frames: FrameKeys::Each(keys),
    };
    between.propagation.gains(&links, gains);

    let eirp_mw = cut(&air.eirp_mw, &range, n);
    let powers = &mut row.powers_mw[..n];
    for j in 0..n {
        let power = received_mw(eirp_mw[j], gains[j], c.gains[me]);
        powers[j] = if squares[j] <= between.range_squared_m2 {
            power
        } else {
            0.0
        };
    }
    if between.directed {
        for (j, power) in powers
            .iter_mut()
            .enumerate()
            .filter(|(_, power)| **power > 0.0)
        {
            *power *= directed_gain(members, air.rows[range.start + j] as usize, me);
        }
    }
    let sensitivity_mw = between.least_mw(c.sensitivities_mw[me]);
    if between.walls.is_some() {
        let audible = powers.iter_mut().enumerate();
        for (j, power) in audible.filter(|(_, power)| **power >= sensitivity_mw) {
            let tx = (
                members.owners[air.rows[range.start + j] as usize],
                [x[j], y[j], z[j]],
            );
            *power *= between.walls_gain(tx, (members.owners[me], here));
        }
    }

    let salt = c.salts[me];
    let (low, high) = (
        cut(&air.keys_low, &range, n),
        cut(&air.keys_high, &range, n),
    );
    let (slots, draws) = (&mut row.slots[..n], &mut row.draws[..n]);
    let (mut in_range, mut audibles) = (0u32, 0u32);
    for j in 0..n {
        let audible = powers[j] >= sensitivity_mw;
        in_range += u32::from(squares[j] <= between.range_squared_m2);
        audibles += u32::from(audible);
        slots[j] = slot(powers[j]);
        draws[j] = draw_u32(whole(low[j], high[j]), salt) | no_luck(audible);
    }
    between.slots_by_distance(squares, slots);
    Reach {
        in_range: in_range.into(),
        audible: audibles.into(),
    }
}

/// One frame and some receivers: fills `row` with one entry for each of `range` of the columns `c`, which
/// holds at most [`ROW`]. `who` tells the rows of these receivers among all members.
pub(super) fn tell(
    row: &mut Row,
    members: &Members,
    c: &Listeners,
    range: Range<usize>,
    who: impl Fn(usize) -> usize,
    (air, frame): (&Air, usize),
    between: &Between<'_>,
) {
    let n = range.len();
    let there = [
        air.enu_m[0][frame],
        air.enu_m[1][frame],
        air.enu_m[2][frame],
    ];
    let x = cut(&c.enu_m[0], &range, n);
    let y = cut(&c.enu_m[1], &range, n);
    let z = cut(&c.enu_m[2], &range, n);

    let radio = air.radios[frame];
    let radios = cut(&c.radios, &range, n);
    let squares = &mut row.squares_m2[..n];
    for j in 0..n {
        let square = square(there, [x[j], y[j], z[j]]);
        squares[j] = if radios[j] == radio { f32::NAN } else { square };
    }

    let squares = &row.squares_m2[..n];
    let gains = &mut row.gains[..n];
    let key = air.keys[frame];
    let links = Links {
        frequency: between.frequency,
        time: between.time,
        near_is: Role::Transmitter,
        near_enu_m: there,
        near_key: air.radio_keys[frame],
        far_enu_m: [x, y, z],
        far_keys: cut(&c.radio_keys, &range, n),
        distances_squared_m2: squares,
        frames: FrameKeys::One(key),
    };
    between.propagation.gains(&links, gains);

    let eirp_mw = air.eirp_mw[frame];
    let antenna_gains = cut(&c.gains, &range, n);
    let powers = &mut row.powers_mw[..n];
    for j in 0..n {
        let power = received_mw(eirp_mw, gains[j], antenna_gains[j]);
        powers[j] = if squares[j] <= between.range_squared_m2 {
            power
        } else {
            0.0
        };
    }
    if between.directed {
        for (j, power) in powers
            .iter_mut()
            .enumerate()
            .filter(|(_, power)| **power > 0.0)
        {
            *power *= directed_gain(members, air.rows[frame] as usize, who(range.start + j));
        }
    }

    let sensitivities_mw = cut(&c.sensitivities_mw, &range, n);
    if between.walls.is_some() {
        let tx = (members.owners[air.rows[frame] as usize], there);
        for (j, power) in powers.iter_mut().enumerate() {
            if *power >= between.least_mw(sensitivities_mw[j]) {
                let owner = members.owners[who(range.start + j)];
                *power *= between.walls_gain(tx, (owner, [x[j], y[j], z[j]]));
            }
        }
    }

    let salts = cut(&c.salts, &range, n);
    let (slots, draws) = (&mut row.slots[..n], &mut row.draws[..n]);
    for j in 0..n {
        let audible = powers[j] >= between.least_mw(sensitivities_mw[j]);
        slots[j] = slot(powers[j]);
        draws[j] = draw_u32(key, salts[j]) | no_luck(audible);
    }
    between.slots_by_distance(squares, slots);
}

/// Counts the first `n` entries of a row, all told the same frame, into the columns of the members in
/// `range`.
pub(super) fn count(row: &Row, members: &mut Members, range: Range<usize>, between: &Between<'_>) {
    let n = range.len();
    let (squares, powers) = (&row.squares_m2[..n], &row.powers_mw[..n]);
    let sensitivities_mw = cut(&members.columns.sensitivities_mw, &range, n);
    let in_range = &mut members.in_range[range.clone()][..n];
    let audibles = &mut members.audible[range][..n];
    for j in 0..n {
        in_range[j] += u64::from(squares[j] <= between.range_squared_m2);
        audibles[j] += u64::from(powers[j] >= between.least_mw(sensitivities_mw[j]));
    }
}

/// The same for members here and there: `who` tells which.
pub(super) fn count_scattered(
    row: &Row,
    members: &mut Members,
    n: usize,
    who: impl Fn(usize) -> usize,
    between: &Between<'_>,
) {
    let (squares, powers) = (&row.squares_m2[..n], &row.powers_mw[..n]);
    for j in 0..n {
        if squares[j] <= between.range_squared_m2 {
            let member = who(j);
            members.in_range[member] += 1;
            let least_mw = between.least_mw(members.columns.sensitivities_mw[member]);
            members.audible[member] += u64::from(powers[j] >= least_mw);
        }
    }
}

impl Between<'_> {
    /// The weakest power that counts for a receiver of this sensitivity.
    #[inline(always)]
    fn least_mw(&self, sensitivity_mw: f32) -> f32 {
        if self.per_m2.is_some() {
            // Any at all.
            f32::from_bits(1)
        } else {
            sensitivity_mw
        }
    }

    /// Where chance goes by distance: the places in its table.
    fn slots_by_distance(&self, squares_m2: &[f32], slots: &mut [u32]) {
        if let Some(per_m2) = self.per_m2 {
            for (place, square_m2) in slots.iter_mut().zip(squares_m2) {
                *place = slot((square_m2 * per_m2).max(LEAST));
            }
        }
    }

    /// What walls and bodies leave of the power between two antennas.
    fn walls_gain(&self, tx: (ModelId, [f32; 3]), rx: (ModelId, [f32; 3])) -> f32 {
        self.walls.map_or(1.0, |poses| {
            aim::walls_gain(poses, [tx, rx], self.frequency)
        })
    }
}

/// Picks the lucky ones of the first `n` entries of the row: those whose draw is below the chance that
/// `chance` gives for (entry, slot). Appends them to the hits, numbered by entry from `first` on.
#[inline(always)]
pub(super) fn pick(
    scratch: &mut Scratch,
    n: usize,
    first: usize,
    chance: impl Fn(usize, usize) -> u32,
) {
    let row = &mut *scratch.row;
    let (slots, draws, powers) = (&row.slots[..n], &row.draws[..n], &row.powers_mw[..n]);
    let mut count = 0;
    for j in 0..n {
        let lucky = draws[j] < chance(j, slots[j] as usize % SLOTS);
        // Written every time, kept only if lucky: no branch to be mispredicted.
        row.picked[count % ROW] = Hit {
            frame: (first + j) as u32,
            power_mw: powers[j],
        };
        count += usize::from(lucky);
    }
    scratch.hits.extend_from_slice(&row.picked[..count]);
}

/// Gains of the antennas with a direction at both ends of a link.
fn directed_gain(members: &Members, tx: usize, rx: usize) -> f32 {
    let end = |row: usize| End {
        enu_m: [0, 1, 2].map(|axis| members.places[axis][row]),
        antenna: members.directed[row].as_deref(),
        antenna_from_world: members.antenna_from_world[row],
    };
    aim::directed_gain(&end(tx), &end(rx))
}
