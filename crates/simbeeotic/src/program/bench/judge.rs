//! Judgements of what was measured: which sizes are worth a run, and when runs of one size are enough.

use super::alone::Run;
use super::arguments::Clock;
use super::measure::Row;
use simbeeotic_units::math;

/// Rows of which more than so many times real time is to be expected are left to the search of the limit.
const BEYOND: f64 = 1.25;

/// Without anything known of the disturbances, a single run decides if it is so many times faster or slower than
/// real time; if something is known, this or a lesser number.
const CLEAR: [f64; 2] = [1.1, 4.0];

/// Whether a size is far beyond real time, judged by the smaller ones that are known, each with its ratio: one of them
/// is beyond it, or the power law through the two largest gets there.
pub(super) fn is_beyond(size: u32, known: &[(u32, f64)]) -> bool {
    let smaller = known
        .iter()
        .filter(|(n, ratio)| *n < size && *n > 0 && *ratio > 0.0);
    let smaller: Vec<_> = smaller.copied().collect();
    let ln = |(n, ratio): (u32, f64)| [math::ln(f64::from(n)), math::ln(ratio)];
    match smaller[..] {
        [.., (_, ratio)] if ratio > 1.0 => true,
        [.., a, b] => {
            let ([x0, y0], [x1, y1]) = (ln(a), ln(b));
            let slope = ((y1 - y0) / (x1 - x0)).clamp(0.0, 3.0);
            y1 + slope * (math::ln(f64::from(size)) - x1) > math::ln(BEYOND)
        }
        _ => false,
    }
}

/// How many times faster or slower than real time a single run must be to decide: more than the runs of the two
/// largest rows that were run several times differ.
pub(super) fn clear(rows: &[Row], clock: Clock) -> f64 {
    let apart = |row: &Row| {
        let ratios = row.runs.iter().map(|run| run.ratio(clock));
        let [low, high] = ratios.fold([f64::INFINITY, 0.0_f64], |[low, high], ratio| {
            [low.min(ratio), high.max(ratio)]
        });
        (row.runs.len() > 1).then_some(high / low)
    };
    let apart = rows.iter().rev().filter_map(apart).take(2);
    let most = apart.reduce(f64::max).unwrap_or(CLEAR[1]);
    most.clamp(CLEAR[0], CLEAR[1])
}

/// The largest size for which half of the free memory is enough, by what the largest rows took.
pub(super) fn room(rows: &[Row], free_bytes: Option<f64>) -> u32 {
    let each = |row: &Row| {
        let bytes = row.runs.iter().filter_map(|run| run.memory_bytes);
        let bytes = bytes.fold(0.0, f64::max);
        (row.case.size >= ROOM_LEAST).then(|| bytes / f64::from(row.case.size))
    };
    let each = rows.iter().filter_map(each).fold(0.0, f64::max);
    match free_bytes {
        Some(free) if each > 0.0 => (0.5 * free / each).min(f64::from(u32::MAX)) as u32,
        _ => u32::MAX,
    }
}

/// Smaller runs say more of the program than of what they hold.
const ROOM_LEAST: u32 = 10_000;

/// Whether the runs that are still to come cannot change on which side of 1 the median is.
/// One that is `clear` times faster or slower than real time is enough: so far no disturbance leads.
pub(super) fn decided(runs: &[Run], repeat: u32, clear: f64, clock: Clock) -> bool {
    let is_clear = |run: &Run| !(1.0 / clear..=clear).contains(&run.ratio(clock));
    let real_time = runs.iter().filter(|run| run.ratio(clock) <= 1.0).count();
    let most = repeat as usize / 2;
    runs.iter().any(is_clear) || real_time > most || runs.len() - real_time > most
}

/// The middle one; of an even number the larger of the two in the middle.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::super::alone::Case;
    use super::super::workload::tests::cost;
    use super::*;

    #[test]
    fn there_is_room_for_what_half_of_the_free_memory_holds() {
        let row = |size, bytes| {
            let mut run = Run::of(cost(1.0, "a"));
            run.memory_bytes = Some(bytes);
            Row::new(Case { line: 0, size }, vec![run]).expect("a run")
        };
        let rows = [row(10, 1e9), row(20_000, 2e7), row(100_000, 9e7)];
        assert_eq!(room(&rows, Some(8e9)), 4_000_000);
        assert_eq!(room(&rows[..1], Some(8e9)), u32::MAX, "too small to tell");
        assert_eq!(room(&rows, None), u32::MAX);
    }

    #[test]
    fn a_probe_is_decided_by_most_of_its_runs() {
        let [fast, slow] = [5.0, 20.0].map(|wall_s| Run::of(cost(wall_s, "a")));
        let decided = |runs: &[Run], repeat| decided(runs, repeat, 4.0, Clock::Wall);
        assert!(!decided(&[], 3) && !decided(std::slice::from_ref(&fast), 3));
        assert!(decided(&[fast.clone(), fast.clone()], 3));
        assert!(decided(&[slow.clone(), slow.clone()], 3));
        assert!(!decided(&[fast.clone(), slow.clone()], 3));
        assert!(decided(std::slice::from_ref(&slow), 1));
        // A run that is far from real time needs no others.
        let [hurried, stuck] = [1.0, 90.0].map(|wall_s| Run::of(cost(wall_s, "a")));
        assert!(decided(std::slice::from_ref(&hurried), 7));
        assert!(decided(std::slice::from_ref(&stuck), 7));
        // Of an even number the median is the larger one: slow if half of them are.
        assert!(!decided(&[fast.clone(), fast], 4));
        assert_eq!(median(vec![0.5, 2.0]), 2.0);
    }

    #[test]
    fn what_is_far_beyond_real_time_is_left_to_the_search() {
        assert!(!is_beyond(1_000, &[]));
        assert!(!is_beyond(1_000, &[(10, 0.9)]));
        assert!(is_beyond(1_000, &[(10, 1.1)]));
        // Twice as many take four times as long: 0.9 at 2,000 is 1.4 at 2,500.
        let curve = [(0, 0.0), (1_000, 0.225), (2_000, 0.9)];
        assert!(!is_beyond(2_200, &curve) && is_beyond(2_500, &curve));
        assert!(!is_beyond(1_500, &curve));
    }

    #[test]
    fn one_run_decides_beyond_what_the_runs_of_a_row_differ() {
        let row = |size, walls: &[f64]| {
            let runs = walls.iter().map(|wall_s| Run::of(cost(*wall_s, "a")));
            Row::new(Case { line: 0, size }, runs.collect()).expect("runs")
        };
        let clear = |rows: &[Row]| clear(rows, Clock::Wall);
        assert_eq!(clear(&[row(9, &[5.0])]), 4.0);
        assert_eq!(clear(&[row(9, &[5.0, 5.1])]), 1.1);
        let rows = [
            row(1, &[1.0, 9.0]),
            row(2, &[4.0, 8.0]),
            row(3, &[8.0, 8.0]),
        ];
        assert_eq!(clear(&rows), 2.0);
        assert_eq!(clear(&rows[..2]), 4.0);
    }
}
