//! The convex hull of some points.
//!
//! Points are added one by one to a tetrahedron: the faces that see a point give way to a fan from the
//! edges around them. What lies outside by less than 1e-10 of the extent counts as inside, so the result
//! holds all points to that precision, and rounding never tears it.

use glam::DVec3;

/// Distance, over the extent of all points, below which a point counts as on a face.
const TOLERANCE: f64 = 1e-10;

/// A convex solid between flat faces.
#[derive(Clone, Debug)]
pub(crate) struct Polytope {
    /// The corners.
    pub(crate) points: Vec<DVec3>,
    /// Triangles between corners, counter-clockwise as seen from outside.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// The planes of the triangles: outward unit normal, and its product with a point of the plane.
    pub(crate) planes: Vec<(DVec3, f64)>,
    /// Distance from the origin to the farthest corner.
    pub(crate) reach: f64,
}

/// One face while the hull grows.
#[derive(Clone, Copy)]
struct Face {
    corners: [usize; 3],
    normal: DVec3,
    offset: f64,
}

impl Face {
    fn new(points: &[DVec3], corners: [usize; 3]) -> Self {
        let [a, b, c] = corners.map(|corner| points[corner]);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        Self {
            corners,
            normal,
            offset: normal.dot(a).max(normal.dot(b)).max(normal.dot(c)),
        }
    }

    fn edges(&self) -> [(usize, usize); 3] {
        let [a, b, c] = self.corners;
        [(a, b), (b, c), (c, a)]
    }

    fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

/// The index for which `value` is greatest; the first of several.
fn greatest(points: &[DVec3], value: impl Fn(DVec3) -> f64) -> usize {
    let mut best = (0, f64::NEG_INFINITY);
    for (k, point) in points.iter().enumerate() {
        let value = value(*point);
        if value > best.1 {
            best = (k, value);
        }
    }
    best.0
}

/// Four points far from one another, as the faces of a tetrahedron; none if all lie in one plane.
fn tetrahedron(points: &[DVec3], tolerance: f64) -> Option<Vec<Face>> {
    let a = greatest(points, |p| -p.x);
    let b = greatest(points, |p| p.distance_squared(points[a]));
    let along = (points[b] - points[a]).try_normalize()?;
    let across = |p: DVec3| (p - points[a]).reject_from_normalized(along);
    let c = greatest(points, |p| across(p).length_squared());
    let normal = along.cross(across(points[c]).try_normalize()?);
    let height = |p: DVec3| normal.dot(p - points[a]);
    let d = greatest(points, |p| height(p).abs());
    let flat = across(points[c]).length() <= tolerance || height(points[d]).abs() <= tolerance;
    if flat {
        return None;
    }
    let (b, c) = if height(points[d]) > 0.0 {
        (c, b)
    } else {
        (b, c)
    };
    let faces = [[a, b, c], [a, d, b], [b, d, c], [c, d, a]];
    Some(faces.map(|corners| Face::new(points, corners)).to_vec())
}

/// The convex hull of finite points; none if they all lie in one plane.
pub(crate) fn hull(points: &[DVec3]) -> Option<Polytope> {
    let least = points.iter().copied().reduce(DVec3::min)?;
    let most = points.iter().copied().reduce(DVec3::max)?;
    let tolerance = TOLERANCE * (most - least).length();
    let mut faces = tetrahedron(points, tolerance)?;
    let mut horizon: Vec<(usize, usize)> = Vec::new();
    for (k, point) in points.iter().enumerate() {
        horizon.clear();
        let sees = |face: &Face| face.height(*point) > tolerance;
        for face in faces.iter().filter(|face| sees(face)) {
            for (from, to) in face.edges() {
                // An edge between two faces that both give way cancels out.
                match horizon.iter().position(|edge| *edge == (to, from)) {
                    Some(place) => {
                        horizon.swap_remove(place);
                    }
                    None => horizon.push((from, to)),
                }
            }
        }
        if horizon.is_empty() {
            continue;
        }
        faces.retain(|face| !sees(face));
        let fan = horizon
            .iter()
            .map(|(from, to)| Face::new(points, [*from, *to, k]));
        faces.extend(fan);
    }
    Some(Polytope::new(points, &faces))
}

impl Polytope {
    fn new(points: &[DVec3], faces: &[Face]) -> Self {
        let mut used: Vec<usize> = faces.iter().flat_map(|face| face.corners).collect();
        used.sort_unstable();
        used.dedup();
        let place = |corner: usize| used.partition_point(|k| *k < corner) as u32;
        let points: Vec<DVec3> = used.iter().map(|k| points[*k]).collect();
        Self {
            reach: points.iter().map(|p| p.length()).fold(0.0, f64::max),
            points,
            triangles: faces.iter().map(|face| face.corners.map(place)).collect(),
            planes: faces
                .iter()
                .filter(|face| face.normal != DVec3::ZERO)
                .map(|face| (face.normal, face.offset))
                .collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::hull;
    use glam::DVec3;

    #[test]
    fn a_box_has_eight_corners_whatever_lies_inside() {
        let mut points = Vec::new();
        for k in 0..27 {
            let at = |n: i32| f64::from(n % 3 - 1);
            points.push(DVec3::new(at(k), 2.0 * at(k / 3), 1e-3 * at(k / 9)));
        }
        let hull = hull(&points).unwrap();
        let corners: Vec<_> = hull
            .points
            .iter()
            .filter(|p| p.abs() == DVec3::new(1.0, 2.0, 1e-3))
            .collect();
        assert_eq!(corners.len(), 8);
        for point in &points {
            for (normal, offset) in &hull.planes {
                assert!(normal.dot(*point) <= offset + 1e-9);
            }
        }
    }

    #[test]
    fn points_in_a_plane_have_no_hull() {
        let flat: Vec<_> = (0..10)
            .map(|k| DVec3::new(f64::from(k % 3), f64::from(k), 1.0))
            .collect();
        assert!(hull(&flat).is_none());
        assert!(hull(&flat[..2]).is_none());
        assert!(hull(&[]).is_none());
    }
}
