//! A tree of boxes: which of many lie along a ray, or within a box.
//!
//! Each node holds the boxes of its four children side by side, so that one pass of plain arithmetic
//! tests all four. Splitting at the median keeps it balanced whatever the sizes and places, and filling
//! the lowest nodes first keeps it small. Boxes are in f64, because a world may hold a swarm a thousand
//! kilometres from another; each is padded by more than all rounding of a search, so a search never
//! misses what it should find, and whoever searches decides exactly.

use glam::DVec3;

/// A child that is an item, not a node.
const ITEM: u32 = 1 << 31;
/// No item, or no node.
const NOTHING: u32 = u32::MAX;
/// Nodes that may wait: three on each of the 17 levels of a tree of 2^31 items, and some to spare.
const WAITING: usize = 64;

/// A box along the axes: its lowest and its highest corner, m.
pub(crate) type Bounds = [DVec3; 2];

/// Four boxes side by side: `[axis][lowest, highest][child]`.
type Boxes = [[[f64; 4]; 2]; 3];

#[derive(Clone, Copy, Debug)]
struct Node {
    boxes: Boxes,
    children: [u32; 4],
    /// Along which axis the last two children come after the first two.
    axis: usize,
}

const EMPTY: Node = Node {
    boxes: [[[f64::INFINITY; 4], [f64::NEG_INFINITY; 4]]; 3],
    children: [NOTHING; 4],
    axis: 0,
};

/// What an item is sorted by.
#[derive(Clone, Copy, Debug)]
struct Key {
    centre: [f32; 3],
    item: u32,
}

/// The tree over items that are numbered from 0.
#[derive(Debug, Default)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    /// Where each node hangs: four times its parent, and which child it is.
    parents: Vec<u32>,
    /// The same of each item.
    places: Vec<u32>,
}

/// A way through the tree: a ray, or a box that moves along one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way {
    /// Where the box's rear and front must be for the near and the far side of what it passes.
    near: [f64; 3],
    far: [f64; 3],
    inverse: [f64; 3],
    /// Which of the two sides is the near one.
    side: [usize; 3],
}

impl Way {
    /// From `from` along the unit vector `direction`, with a box of half the size `half` about it.
    pub(crate) fn new(from: DVec3, direction: DVec3, half: DVec3) -> Self {
        let (from, half) = (from.to_array(), half.to_array());
        let direction = direction.to_array();
        let backwards = direction.map(f64::is_sign_negative);
        // Finite, so that zero times it is a number.
        let inverse = direction.map(|d| (1.0 / d).clamp(-1e200, 1e200));
        let ahead = [0, 1, 2].map(|k| if backwards[k] { -half[k] } else { half[k] });
        Self {
            near: [0, 1, 2].map(|k| from[k] + ahead[k]),
            far: [0, 1, 2].map(|k| from[k] - ahead[k]),
            inverse,
            side: backwards.map(usize::from),
        }
    }

    /// How far along it the four boxes begin and end.
    #[inline]
    fn passes(&self, boxes: &Boxes, range: f64) -> ([f64; 4], [f64; 4]) {
        let (mut begin, mut end) = ([0.0; 4], [range; 4]);
        for k in 0..3 {
            let near = &boxes[k][self.side[k]];
            let far = &boxes[k][1 - self.side[k]];
            for i in 0..4 {
                let enters = (near[i] - self.near[k]) * self.inverse[k];
                let leaves = (far[i] - self.far[k]) * self.inverse[k];
                begin[i] = if enters > begin[i] { enters } else { begin[i] };
                end[i] = if leaves < end[i] { leaves } else { end[i] };
            }
        }
        (begin, end)
    }
}

/// A bundle of rays from one point: all directions between two corners.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beam {
    from: [f64; 3],
    axes: [Spread; 3],
}

/// How the rays of a bundle go along one axis, as inverses of what they go at least and at most, and
/// which sides of a box they meet first and last.
#[derive(Clone, Copy, Debug)]
struct Spread {
    inverse: [f64; 2],
    /// Which side each of the two inverses counts for when a ray enters.
    enters: [usize; 2],
    /// Which side they leave by; `None` if some ray does not go along this axis.
    leaves: Option<usize>,
}

impl Spread {
    fn new(least: f64, most: f64) -> Self {
        // Finite, so that zero times it is a number.
        let inverse = |d: f64| (1.0 / d).clamp(-1e200, 1e200);
        if least > 0.0 {
            Self {
                inverse: [inverse(least), inverse(most)],
                enters: [0, 0],
                leaves: Some(1),
            }
        } else if most < 0.0 {
            Self {
                inverse: [inverse(least), inverse(most)],
                enters: [1, 1],
                leaves: Some(0),
            }
        } else {
            // A box on either side begins where the fastest ray on that side comes to it.
            Self {
                inverse: [
                    inverse(if least < 0.0 { least } else { -0.0 }),
                    inverse(if most > 0.0 { most } else { 0.0 }),
                ],
                enters: [1, 0],
                leaves: None,
            }
        }
    }
}

impl Beam {
    /// The bundle from `from` along all of `directions`, and all between.
    pub(crate) fn new(from: DVec3, directions: &[DVec3]) -> Self {
        let start = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let [least, most] = directions
            .iter()
            .fold(start, |[low, high], d| [low.min(*d), high.max(*d)]);
        let (least, most) = (least.to_array(), most.to_array());
        Self {
            from: from.to_array(),
            axes: [0, 1, 2].map(|k| Spread::new(least[k], most[k])),
        }
    }

    /// How far along it the four boxes begin at least and end at most.
    #[inline]
    fn passes(&self, boxes: &Boxes, range: f64) -> ([f64; 4], [f64; 4]) {
        let (mut begin, mut end) = ([0.0; 4], [range; 4]);
        for (sides, (axis, from)) in boxes.iter().zip(self.axes.iter().zip(self.from)) {
            let Spread {
                inverse: [one, two],
                enters,
                leaves,
            } = *axis;
            let (first, second) = (&sides[enters[0]], &sides[enters[1]]);
            let straddles = leaves.is_none();
            for i in 0..4 {
                let (a, b) = ((first[i] - from) * one, (second[i] - from) * two);
                // Where all go one way, the earliest of them counts; where they part, only one comes.
                let enters = if (a < b) == straddles { b } else { a };
                begin[i] = if enters > begin[i] { enters } else { begin[i] };
            }
            if let Some(side) = leaves {
                let last = &sides[side];
                for i in 0..4 {
                    let (a, b) = ((last[i] - from) * one, (last[i] - from) * two);
                    let leaves = if a > b { a } else { b };
                    end[i] = if leaves < end[i] { leaves } else { end[i] };
                }
            }
        }
        (begin, end)
    }
}

/// More than what rounding does to any of a search's terms.
fn padded([low, high]: Bounds) -> Bounds {
    let pad = 1e-6 + 1e-14 * low.abs().max(high.abs()).max_element();
    [low - pad, high + pad]
}

/// How many items go into each child of a node with `count`: whole nodes, if they are not single.
fn share(count: usize) -> usize {
    if count <= 4 {
        1
    } else {
        count.div_ceil(16) * 4
    }
}

impl Tree {
    /// The tree over `items`, of which each has its `bounds`, finite.
    pub(crate) fn new(items: impl Iterator<Item = (u32, Bounds)>) -> Self {
        let mut tree = Self::default();
        let (mut keys, mut bounds) = (Vec::new(), Vec::new());
        let mut origin = None;
        for (item, outline) in items {
            let outline = padded(outline);
            let centre = 0.5 * (outline[0] + outline[1]);
            let centre = centre - *origin.get_or_insert(centre);
            if tree.places.len() <= item as usize {
                tree.places.resize(item as usize + 1, NOTHING);
            }
            // For the time being, where its bounds are.
            tree.places[item as usize] = bounds.len() as u32;
            bounds.push(outline);
            keys.push(Key {
                centre: centre.to_array().map(|c| c as f32),
                item,
            });
        }
        if !keys.is_empty() {
            tree.nodes.reserve(keys.len() / 2);
            tree.grow(&mut keys, &bounds, NOTHING);
        }
        tree
    }

    /// Adds the node over `keys` and all below it; tells which it is and what it spans.
    fn grow(&mut self, keys: &mut [Key], bounds: &[Bounds], parent: u32) -> (u32, Bounds) {
        let node = self.nodes.len() as u32;
        self.nodes.push(EMPTY);
        self.parents.push(parent);
        let mut span = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let share = share(keys.len());
        let (first, second, axis) = halve(keys, 2 * share);
        self.nodes[node as usize].axis = axis;
        let (a, b, _) = halve(first, share);
        let (c, d, _) = halve(second, share);
        for (child, keys) in [a, b, c, d].into_iter().enumerate() {
            let place = 4 * node + child as u32;
            let (index, outline) = match keys {
                [] => continue,
                [key] => {
                    let item = &mut self.places[key.item as usize];
                    let outline = bounds[*item as usize];
                    *item = place;
                    (key.item | ITEM, outline)
                }
                keys => self.grow(keys, bounds, place),
            };
            self.nodes[node as usize].children[child] = index;
            self.set(place, outline);
            span = [span[0].min(outline[0]), span[1].max(outline[1])];
        }
        (node, span)
    }

    fn set(&mut self, place: u32, outline: Bounds) {
        let (node, child) = (&mut self.nodes[place as usize / 4], place as usize % 4);
        for (side, corner) in outline.into_iter().enumerate() {
            for (boxes, coordinate) in node.boxes.iter_mut().zip(corner.to_array()) {
                boxes[side][child] = coordinate;
            }
        }
    }

    /// What the four children of a node span.
    fn span(&self, node: u32) -> Bounds {
        let boxes = &self.nodes[node as usize].boxes;
        let low = boxes.map(|[low, _]| low.into_iter().fold(f64::INFINITY, f64::min));
        let high = boxes.map(|[_, high]| high.into_iter().fold(f64::NEG_INFINITY, f64::max));
        [DVec3::from_array(low), DVec3::from_array(high)]
    }

    /// Gives an item that is in the tree other bounds.
    pub(crate) fn update(&mut self, item: u32, bounds: Bounds) {
        let mut place = self.places[item as usize];
        let mut outline = padded(bounds);
        while place != NOTHING {
            self.set(place, outline);
            let node = place / 4;
            outline = self.span(node);
            place = self.parents[node as usize];
        }
    }

    /// Calls `visit` for each item whose box overlaps `bounds`.
    #[inline]
    pub(crate) fn overlapping(&self, bounds: Bounds, mut visit: impl FnMut(u32)) {
        let [low, high] = bounds.map(|corner| corner.to_array());
        let mut waiting = [0; WAITING];
        let mut count = usize::from(!self.nodes.is_empty());
        while count > 0 {
            count -= 1;
            let node = &self.nodes[waiting[count] as usize];
            let mut overlaps = [true; 4];
            for k in 0..3 {
                let [least, most] = &node.boxes[k];
                for (overlaps, (least, most)) in overlaps.iter_mut().zip(least.iter().zip(most)) {
                    *overlaps &= (*least <= high[k]) & (*most >= low[k]);
                }
            }
            for (child, overlaps) in node.children.into_iter().zip(overlaps) {
                if !overlaps {
                    continue;
                }
                if child & ITEM == 0 {
                    waiting[count] = child;
                    count += 1;
                } else if child != NOTHING {
                    visit(child & !ITEM);
                }
            }
        }
    }

    /// Calls `visit` for each item whose box the way meets within `range`, roughly the nearest first.
    /// `visit` gets the item and the range that still counts, and tells which counts from then on; so
    /// does the result.
    #[inline]
    pub(crate) fn along(
        &self,
        way: &Way,
        mut range: f64,
        mut visit: impl FnMut(u32, f64) -> f64,
    ) -> f64 {
        let mut waiting = [(0.0, 0); WAITING];
        let mut count = usize::from(!self.nodes.is_empty());
        while count > 0 {
            count -= 1;
            let (begins, child) = waiting[count];
            if begins > range {
                continue;
            }
            if child & ITEM != 0 {
                range = visit(child & !ITEM, range);
                continue;
            }
            let node = &self.nodes[child as usize];
            let (begin, end) = way.passes(&node.boxes, range);
            // What comes last is looked at first. There is no branch here that could be guessed wrong.
            let backwards = 3 * (1 - way.side[node.axis]);
            for i in 0..4 {
                let i = i ^ backwards;
                waiting[count] = (begin[i], node.children[i]);
                count += usize::from(begin[i] <= end[i]);
            }
        }
        range
    }
}

impl Tree {
    /// Calls `visit` for each item whose box some ray of the beam may meet within `range`, with the
    /// distance at which the box begins at least.
    pub(crate) fn across(&self, beam: &Beam, range: f64, mut visit: impl FnMut(u32, f64)) {
        let mut waiting = [0; WAITING];
        let mut count = usize::from(!self.nodes.is_empty());
        while count > 0 {
            count -= 1;
            let node = &self.nodes[waiting[count] as usize];
            let (begin, end) = beam.passes(&node.boxes, range);
            for i in 0..4 {
                let child = node.children[i];
                if begin[i] > end[i] || child == NOTHING {
                    continue;
                }
                if child & ITEM == 0 {
                    waiting[count] = child;
                    count += 1;
                } else {
                    visit(child & !ITEM, begin[i]);
                }
            }
        }
    }
}

/// Sorts `keys` into the lower `count` along their longest axis, and the rest; tells which axis that is.
fn halve(keys: &mut [Key], count: usize) -> (&mut [Key], &mut [Key], usize) {
    if keys.len() <= count {
        return (keys, &mut [], 0);
    }
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for key in keys.iter() {
        for axis in 0..3 {
            low[axis] = low[axis].min(key.centre[axis]);
            high[axis] = high[axis].max(key.centre[axis]);
        }
    }
    let length = |axis: usize| high[axis] - low[axis];
    let axis = [1, 2].into_iter().fold(0, |best, axis| {
        if length(axis) > length(best) {
            axis
        } else {
            best
        }
    });
    keys.select_nth_unstable_by(count, |a, b| a.centre[axis].total_cmp(&b.centre[axis]));
    let (lower, upper) = keys.split_at_mut(count);
    (lower, upper, axis)
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_kernel::rng::Stream;

    fn scattered(stream: &mut Stream, count: u32, centre: DVec3) -> Vec<Bounds> {
        (0..count)
            .map(|_| {
                let low = centre + stream.in_ball(30.0);
                [low, low + stream.in_ball(1.0).abs()]
            })
            .collect()
    }

    fn tree(bounds: &[Bounds]) -> Tree {
        Tree::new(bounds.iter().enumerate().map(|(i, b)| (i as u32, *b)))
    }

    /// Where a ray meets a box, by the textbook.
    fn slab(from: DVec3, direction: DVec3, [low, high]: Bounds) -> Option<f64> {
        let (a, b) = ((low - from) / direction, (high - from) / direction);
        let (begin, end) = (a.min(b).max_element().max(0.0), a.max(b).min_element());
        (begin <= end).then_some(begin)
    }

    fn check(tree: &Tree, bounds: &[Bounds], stream: &mut Stream, centre: DVec3) {
        for _ in 0..50 {
            let from = centre + stream.in_ball(40.0);
            let direction = stream.in_ball(1.0).normalize();
            let half = stream.in_ball(1.0).abs();
            let range = stream.uniform_in(0.0..60.0);
            let mut found = Vec::new();
            tree.along(&Way::new(from, direction, half), range, |item, range| {
                found.push(item);
                range
            });
            found.sort_unstable();
            for (item, [low, high]) in bounds.iter().enumerate() {
                if slab(from, direction, [*low - half, *high + half]).is_some_and(|s| s <= range) {
                    assert!(
                        found.binary_search(&(item as u32)).is_ok(),
                        "{item} is missed"
                    );
                }
            }
            assert!(found.windows(2).all(|pair| pair[0] < pair[1]));

            let query = [from - half, from + half];
            let mut found = Vec::new();
            tree.overlapping(query, |item| found.push(item));
            found.sort_unstable();
            let expected: Vec<u32> = (0..bounds.len() as u32)
                .filter(|i| {
                    let [low, high] = bounds[*i as usize];
                    low.cmple(query[1]).all() && high.cmpge(query[0]).all()
                })
                .collect();
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn nothing_along_a_way_or_in_a_box_is_missed() {
        let mut stream = Stream::new(1, "tree", "test");
        for count in [0, 1, 2, 4, 5, 16, 17, 63, 64, 65, 300, 1000] {
            for centre in [DVec3::ZERO, DVec3::new(1e6, -1e6, 1e3)] {
                let mut bounds = scattered(&mut stream, count, centre);
                let mut tree = tree(&bounds);
                check(&tree, &bounds, &mut stream, centre);
                let other = scattered(&mut stream, count, centre);
                for item in (0..count as usize).step_by(3) {
                    bounds[item] = other[item];
                    tree.update(item as u32, bounds[item]);
                }
                check(&tree, &bounds, &mut stream, centre);
            }
        }
    }

    #[test]
    fn a_ray_that_narrows_its_range_finds_the_nearest() {
        let mut stream = Stream::new(2, "tree", "test");
        let bounds = scattered(&mut stream, 500, DVec3::ZERO);
        let tree = tree(&bounds);
        let mut visits = 0;
        for _ in 0..200 {
            let (from, direction) = (stream.in_ball(40.0), stream.in_ball(1.0).normalize());
            let mut best = None;
            tree.along(
                &Way::new(from, direction, DVec3::ZERO),
                80.0,
                |item, range| {
                    visits += 1;
                    match slab(from, direction, bounds[item as usize]) {
                        Some(s) if s <= range => {
                            best = Some(s);
                            s
                        }
                        _ => range,
                    }
                },
            );
            let nearest = bounds.iter().filter_map(|b| slab(from, direction, *b));
            let nearest = nearest.filter(|s| *s <= 80.0).fold(f64::INFINITY, f64::min);
            assert_eq!(best.unwrap_or(f64::INFINITY), nearest);
        }
        assert!(visits < 1000, "{visits} visits");
    }

    #[test]
    fn a_ray_along_an_axis_and_in_the_plane_of_a_side_is_no_exception() {
        let bounds = [[DVec3::ZERO, DVec3::ONE]];
        let tree = tree(&bounds);
        for (from, direction) in [
            (DVec3::new(0.5, 0.5, -3.0), DVec3::Z),
            (DVec3::new(0.0, 0.5, -3.0), DVec3::Z),
            (DVec3::new(1.0, 1.0, 4.0), -DVec3::Z),
            (DVec3::new(4.0, 0.0, 0.0), -DVec3::X),
            (DVec3::new(4.0, -0.0, 1.0), DVec3::new(-1.0, -0.0, 1e-320)),
        ] {
            let mut found = 0;
            tree.along(&Way::new(from, direction, DVec3::ZERO), 10.0, |_, range| {
                found += 1;
                range
            });
            assert_eq!(found, 1, "{from} {direction}");
        }
    }
}
