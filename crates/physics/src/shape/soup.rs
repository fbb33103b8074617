//! The many pieces of a compound, a mesh or a height field, and how to find those that are near.

use super::convert::{from_parry, to_parry};
use super::form::{Gap, Place};
use super::piece::Piece;
use super::{HeightField, Mesh};
use glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhLeafCost, BvhNode};
use parry3d_f64::query::Ray;
use std::cell::Cell;
use std::sync::Arc;

/// Edge of a block of cells of a height field that is one leaf, in cells.
const BLOCK: usize = 8;

/// How much the box of a leaf is larger than the leaf, over the extent of all.
const PAD: f64 = 1e-9;

/// Least and greatest corner of a box along the axes, m.
pub(crate) type Bounds = [DVec3; 2];

/// Where the pieces come from.
#[derive(Debug)]
pub(crate) enum Source {
    /// The parts of a compound; a leaf each.
    Pieces(Vec<Piece>),
    /// The triangles of a mesh; a leaf each.
    Mesh(Arc<Mesh>),
    /// The cells of a height field; a leaf is a block of them.
    Field(Arc<HeightField>),
}

/// Many pieces, in a tree of boxes in the body's frame.
#[derive(Debug)]
pub(crate) struct Soup {
    source: Source,
    tree: Bvh,
}

fn bounds_of(points: &[DVec3]) -> Bounds {
    let start = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let grow = |[least, most]: Bounds, p: &DVec3| [least.min(*p), most.max(*p)];
    points.iter().fold(start, grow)
}

/// Distance between two boxes, m.
fn apart(a: Bounds, b: Bounds) -> f64 {
    (a[0] - b[1]).max(b[0] - a[1]).max(DVec3::ZERO).length()
}

fn of_node(node: &BvhNode) -> Bounds {
    [from_parry(node.mins()), from_parry(node.maxs())]
}

/// Least and greatest corner of the box about a turned box.
pub(crate) fn turned(at: Place, [least, most]: Bounds) -> Bounds {
    let (middle, half) = (0.5 * (least + most), 0.5 * (most - least));
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| (at.q * axis).abs());
    let reach = x * half.x + y * half.y + z * half.z;
    let middle = at.p + at.q * middle;
    [middle - reach, middle + reach]
}

impl HeightField {
    /// Number of blocks along x and y.
    fn blocks(&self) -> [usize; 2] {
        [self.columns, self.rows()].map(|samples| (samples - 1).div_ceil(BLOCK))
    }

    /// The samples of a block: rows and columns, the last included.
    fn block(&self, leaf: usize) -> [std::ops::RangeInclusive<usize>; 2] {
        let across = self.blocks()[0];
        let span = |block: usize, samples: usize| {
            let first = block * BLOCK;
            first..=(first + BLOCK).min(samples - 1)
        };
        [
            span(leaf / across, self.rows()),
            span(leaf % across, self.columns),
        ]
    }

    /// The two triangles of the cell whose south-west corner is the sample given. The diagonal is that
    /// of parry's height fields.
    pub(super) fn cell(&self, row: usize, column: usize) -> [[DVec3; 3]; 2] {
        let south_west = self.point(row, column);
        let south_east = self.point(row, column + 1);
        let north_west = self.point(row + 1, column);
        let north_east = self.point(row + 1, column + 1);
        [
            [south_west, north_east, north_west],
            [south_west, south_east, north_east],
        ]
    }
}

impl HeightField {
    /// The triangles of all cells.
    pub(super) fn cells(&self) -> impl Iterator<Item = [[DVec3; 3]; 2]> + '_ {
        let row = move |row| (0..self.columns - 1).map(move |column| self.cell(row, column));
        (0..self.rows() - 1).flat_map(row)
    }
}

impl Source {
    /// The boxes of all leaves.
    fn leaves(&self) -> Vec<Bounds> {
        match self {
            Self::Pieces(pieces) => {
                let bounds = |piece: &Piece| piece.bounds(Place::IDENTITY);
                pieces.iter().map(bounds).collect()
            }
            Self::Mesh(mesh) => {
                let bounds = |triangle: &[u32; 3]| bounds_of(&mesh.corners(*triangle));
                mesh.triangles.iter().map(bounds).collect()
            }
            Self::Field(field) => {
                let [across, along] = field.blocks();
                let bounds = |leaf| {
                    let [rows, columns] = field.block(leaf);
                    let sample = |row| columns.clone().map(move |column| (row, column));
                    let points: Vec<_> = rows
                        .flat_map(sample)
                        .map(|(row, column)| field.point(row, column))
                        .collect();
                    bounds_of(&points)
                };
                (0..across * along).map(bounds).collect()
            }
        }
    }

    /// Shows `see` those pieces of a leaf whose boxes are `wanted`.
    fn visit(&self, leaf: u32, wanted: impl Fn(Bounds) -> bool, see: &mut dyn FnMut(&Piece)) {
        match self {
            Self::Pieces(pieces) => see(&pieces[leaf as usize]),
            Self::Mesh(mesh) => {
                see(&Piece::triangle(
                    mesh.corners(mesh.triangles[leaf as usize]),
                ));
            }
            Self::Field(field) => {
                let [rows, columns] = field.block(leaf as usize);
                for row in *rows.start()..*rows.end() {
                    for column in *columns.start()..*columns.end() {
                        for corners in field.cell(row, column) {
                            if wanted(bounds_of(&corners)) {
                                see(&Piece::triangle(corners));
                            }
                        }
                    }
                }
            }
        }
    }
}

impl Mesh {
    /// The corners of a triangle.
    pub(super) fn corners(&self, triangle: [u32; 3]) -> [DVec3; 3] {
        triangle.map(|corner| self.points_m[corner as usize])
    }
}

/// What is best so far in a search for the least.
struct Least<T>(f64, T);

impl<T> BvhLeafCost for Least<T> {
    fn cost(&self) -> f64 {
        self.0
    }
}

impl Soup {
    pub(crate) fn new(source: Source) -> Self {
        let boxes = source.leaves();
        let all = boxes.iter().flatten().copied().collect::<Vec<_>>();
        let [least, most] = bounds_of(&all);
        // So that rounding never lets a ray slip past a flat box.
        let pad = DVec3::splat(PAD * (most - least).length());
        let leaves = boxes
            .iter()
            .map(|[least, most]| Aabb::new(to_parry(*least - pad), to_parry(*most + pad)));
        let tree = Bvh::from_iter(BvhBuildStrategy::Binned, leaves.enumerate());
        Self { source, tree }
    }

    /// The box about all pieces, in the body's frame.
    pub(crate) fn bounds(&self) -> Bounds {
        let bounds = self.tree.root_aabb();
        [from_parry(bounds.mins), from_parry(bounds.maxs)]
    }

    /// All pieces.
    pub(crate) fn each(&self, see: &mut dyn FnMut(&Piece)) {
        for leaf in 0..self.tree.leaf_count() {
            self.source.visit(leaf, |_| true, see);
        }
    }

    /// Those pieces whose boxes meet one, all in the body's frame.
    pub(crate) fn near(&self, bounds: Bounds, see: &mut dyn FnMut(&Piece)) {
        let wanted = |piece| apart(piece, bounds) == 0.0;
        let region = Aabb::new(to_parry(bounds[0]), to_parry(bounds[1]));
        for leaf in self.tree.intersect_aabb(&region) {
            self.source.visit(leaf, wanted, see);
        }
    }

    /// The least of the gaps to something within `bounds`, in the body's frame; `gap` says what it is for
    /// one piece.
    pub(crate) fn least(&self, bounds: Bounds, gap: impl Fn(&Piece) -> Gap) -> Option<Gap> {
        // Of several that overlap the deepest counts: none of them is left out.
        let cost = |distance: f64| if distance > 0.0 { distance } else { f64::MIN };
        let of_leaf = |leaf, best: f64| {
            let limit = Cell::new(best.max(0.0));
            let mut least: Option<Gap> = None;
            let wanted = |piece| apart(piece, bounds) <= limit.get();
            self.source.visit(leaf, wanted, &mut |piece| {
                let gap = gap(piece);
                if least.is_none_or(|least| gap.distance < least.distance) {
                    least = Some(gap);
                    limit.set(gap.distance.clamp(0.0, limit.get()));
                }
            });
            least.map(|gap| Least(gap.distance, gap))
        };
        self.tree
            .find_best(
                f64::MAX,
                |node, _| cost(apart(of_node(node), bounds)),
                of_leaf,
            )
            .map(|(_, Least(_, gap))| gap)
    }

    /// Where a ray in the body's frame first meets a piece: distance and outward normal.
    pub(crate) fn cast_ray(
        &self,
        from: DVec3,
        direction: DVec3,
        max_m: f64,
    ) -> Option<(f64, DVec3)> {
        let ray = Ray::new(to_parry(from), to_parry(direction));
        let of_leaf = |leaf, best| {
            let mut least: Option<(f64, DVec3)> = None;
            self.source.visit(leaf, |_| true, &mut |piece| {
                if let Some(hit) = piece.cast_ray(Place::IDENTITY, from, direction)
                    && hit.0 <= best
                    && least.is_none_or(|least| hit.0 < least.0)
                {
                    least = Some(hit);
                }
            });
            least.map(|(distance, normal)| Least(distance, normal))
        };
        // The least that is more than the range counts as none, so the range itself is in.
        self.tree
            .find_best(
                max_m.next_up(),
                |node, best| node.cast_ray(&ray, best),
                of_leaf,
            )
            .map(|(_, Least(distance, normal))| (distance, normal))
    }
}
