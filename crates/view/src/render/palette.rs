//! The few colours that stand for all colours of a film.
//!
//! Colours are counted in cells of 6 bits a channel. The box with the largest spread of colours is cut in
//! two until there are enough boxes (P. Heckbert, *Color image quantization for frame buffer display*,
//! 1982), and the means of the boxes are then moved a few times to the mean of the colours nearest to them.

use super::Picture;
use rayon::prelude::*;

const BITS: u32 = 6;
const SIDE: usize = 1 << BITS;

/// How often each colour occurs.
pub(super) struct Counts(Vec<u32>);

impl Counts {
    pub(super) fn new() -> Self {
        Self(vec![0; SIDE * SIDE * SIDE])
    }

    pub(super) fn add(&mut self, picture: &Picture) {
        for rgb in picture.rgb.as_chunks::<3>().0 {
            let count = &mut self.0[cell(*rgb)];
            *count = count.saturating_add(1);
        }
    }
}

fn cell([r, g, b]: [u8; 3]) -> usize {
    let part = |value: u8| usize::from(value >> (8 - BITS));
    (part(r) * SIDE + part(g)) * SIDE + part(b)
}

/// The middle of a cell.
fn colour(cell: usize) -> [i32; 3] {
    [cell / (SIDE * SIDE), cell / SIDE % SIDE, cell % SIDE].map(|part| {
        // 0 to 63 becomes 0 to 255, so that black and white stay what they are.
        (part * 255 / (SIDE - 1)) as i32
    })
}

/// A colour with its weight. Rare colours count more than their share: a bee is small.
type Weighed = ([i32; 3], f64);

/// Colours, and for every colour the nearest of them.
pub(super) struct Palette {
    pub(super) colours: Vec<[u8; 3]>,
    nearest: Vec<u8>,
}

impl Palette {
    /// At most `size` colours, 1 to 256.
    pub(super) fn new(counts: &Counts, size: usize) -> Self {
        let seen = counts.0.iter().enumerate().filter(|(_, n)| **n > 0);
        let weighed: Vec<Weighed> = seen
            .map(|(cell, n)| (colour(cell), f64::from(*n).sqrt()))
            .collect();
        let mut boxes = vec![weighed.clone()];
        while boxes.len() < size {
            let spread = |list: &Vec<Weighed>| (list.len() > 1).then(|| spread(list));
            let widest = boxes
                .iter()
                .enumerate()
                .filter_map(|(at, list)| Some((at, spread(list)?)))
                .max_by(|a, b| a.1.1.total_cmp(&b.1.1).then(b.0.cmp(&a.0)));
            let Some((at, (part, _))) = widest else { break };
            let mut list = boxes.swap_remove(at);
            list.sort_by_key(|(rgb, _)| rgb[part]);
            let half = 0.5 * list.iter().map(|(_, w)| w).sum::<f64>();
            let mut sum = 0.0;
            let cut = list.iter().position(|(_, w)| {
                sum += w;
                sum >= half
            });
            let cut = cut.unwrap_or(0).clamp(1, list.len() - 1);
            boxes.push(list.split_off(cut));
            boxes.push(list);
        }
        let mut means: Vec<[f64; 3]> = boxes.iter().map(|list| mean(list)).collect();
        for _ in 0..4 {
            let own: Vec<usize> = weighed
                .par_iter()
                .map(|(rgb, _)| nearest(&means, rgb.map(f64::from)))
                .collect();
            let mut lists = vec![Vec::new(); means.len()];
            for (weighed, own) in weighed.iter().zip(own) {
                lists[own].push(*weighed);
            }
            for (mean, list) in means.iter_mut().zip(&lists) {
                if !list.is_empty() {
                    *mean = self::mean(list);
                }
            }
        }
        let nearest = (0..SIDE * SIDE * SIDE)
            .into_par_iter()
            .map(|cell| nearest(&means, colour(cell).map(f64::from)) as u8)
            .collect();
        let byte = |value: f64| (value + 0.5).clamp(0.0, 255.0) as u8;
        Self {
            colours: means.iter().map(|mean| mean.map(byte)).collect(),
            nearest,
        }
    }

    /// The place of the colour nearest to one.
    pub(super) fn place(&self, rgb: [u8; 3]) -> u8 {
        self.nearest[cell(rgb)]
    }
}

/// The channel in which colours differ most, and by how much, weighed.
fn spread(list: &[Weighed]) -> (usize, f64) {
    let mean = mean(list);
    let mut sums = [0.0; 3];
    for (rgb, weight) in list {
        for (part, sum) in sums.iter_mut().enumerate() {
            let off = f64::from(rgb[part]) - mean[part];
            *sum += weight * off * off * IMPORTANCE[part];
        }
    }
    let most = (0..3)
        .max_by(|a, b| sums[*a].total_cmp(&sums[*b]))
        .unwrap_or(0);
    (most, sums[most])
}

/// How well eyes tell channels apart, about.
const IMPORTANCE: [f64; 3] = [0.8, 1.2, 0.6];

fn mean(list: &[Weighed]) -> [f64; 3] {
    let total: f64 = list.iter().map(|(_, weight)| weight).sum();
    let mut mean = [0.0; 3];
    for (rgb, weight) in list {
        for (part, sum) in mean.iter_mut().enumerate() {
            *sum += weight * f64::from(rgb[part]) / total;
        }
    }
    mean
}

fn nearest(means: &[[f64; 3]], rgb: [f64; 3]) -> usize {
    let mut best = (f64::INFINITY, 0);
    for (at, mean) in means.iter().enumerate() {
        let mut off = 0.0;
        for part in 0..3 {
            let d = mean[part] - rgb[part];
            off += IMPORTANCE[part] * d * d;
        }
        if off < best.0 {
            best = (off, at);
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_stay_what_they_are() {
        let few = [[0, 0, 0], [255, 255, 255], [240, 165, 10], [20, 60, 200]];
        let rgb: Vec<u8> = few.iter().cycle().take(400).flatten().copied().collect();
        let mut counts = Counts::new();
        counts.add(&Picture {
            width: 20,
            height: 20,
            rgb,
        });
        let palette = Palette::new(&counts, 255);
        assert_eq!(palette.colours.len(), 4);
        for own in few {
            let found = palette.colours[usize::from(palette.place(own))];
            let off = (0..3).map(|k| own[k].abs_diff(found[k])).max();
            assert!(off <= Some(4), "{own:?} {found:?}");
        }
    }

    #[test]
    fn many_colours_are_near_to_one_of_the_few() {
        let ramp = (0..4096).flat_map(|k: usize| [(k % 256) as u8, (k / 16) as u8, 128]);
        let rgb: Vec<u8> = ramp.collect();
        let picture = Picture {
            width: 64,
            height: 64,
            rgb,
        };
        let mut counts = Counts::new();
        counts.add(&picture);
        let palette = Palette::new(&counts, 255);
        assert_eq!(palette.colours.len(), 255);
        for own in picture.rgb.as_chunks::<3>().0 {
            let found = palette.colours[usize::from(palette.place(*own))];
            let off = (0..3).map(|k| own[k].abs_diff(found[k])).max();
            assert!(off <= Some(20), "{own:?} {found:?}");
        }
    }
}
