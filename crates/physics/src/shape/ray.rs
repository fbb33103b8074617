//! Where a ray first meets a convex solid: closed forms.

use super::convex::Convex;
use super::hull::Polytope;
use glam::{DVec2, DVec3};

/// Distance along a ray of unit direction, and the outward normal there.
type Hit = (f64, DVec3);

/// The stretch of a ray that lies inside of something, as it is cut down by one surface after another.
struct Stretch {
    enter: f64,
    leave: f64,
    normal: DVec3,
}

impl Stretch {
    fn new(direction: DVec3) -> Self {
        Self {
            enter: 0.0,
            leave: f64::INFINITY,
            normal: -direction,
        }
    }

    /// Keeps what lies below a plane. `height`: of the origin above it, `rate`: its change along the ray.
    fn below(&mut self, height: f64, rate: f64, normal: DVec3) {
        if rate < 0.0 {
            let at = height / -rate;
            if at > self.enter {
                (self.enter, self.normal) = (at, normal);
            }
        } else if rate > 0.0 {
            self.leave = self.leave.min(-height / rate);
        } else if height > 0.0 {
            self.leave = f64::NEG_INFINITY;
        }
    }

    fn hit(self) -> Option<Hit> {
        (self.enter <= self.leave).then_some((self.enter, self.normal))
    }
}

/// The roots of `a x^2 + 2 b x + c` with `a > 0`, in order.
fn roots(a: f64, b: f64, c: f64) -> Option<(f64, f64)> {
    let discriminant = b * b - a * c;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    // Without cancellation.
    let q = if b > 0.0 { -b - root } else { -b + root };
    let (one, two) = (q / a, if q == 0.0 { 0.0 } else { c / q });
    Some((one.min(two), one.max(two)))
}

fn ball(radius: f64, from: DVec3, direction: DVec3) -> Option<Hit> {
    let c = from.length_squared() - radius * radius;
    if c <= 0.0 {
        return Some((0.0, -direction));
    }
    let (first, _) = roots(1.0, from.dot(direction), c)?;
    (first >= 0.0).then(|| (first, (from + direction * first).normalize_or_zero()))
}

fn block(half: DVec3, from: DVec3, direction: DVec3) -> Option<Hit> {
    let mut stretch = Stretch::new(direction);
    for side in [DVec3::X, DVec3::Y, DVec3::Z] {
        let (at, rate, half) = (from.dot(side), direction.dot(side), half.dot(side));
        stretch.below(at - half, rate, side);
        stretch.below(-at - half, -rate, -side);
    }
    stretch.hit()
}

fn hull(hull: &Polytope, from: DVec3, direction: DVec3) -> Option<Hit> {
    let mut stretch = Stretch::new(direction);
    for (normal, offset) in &hull.planes {
        stretch.below(normal.dot(from) - offset, normal.dot(direction), *normal);
    }
    stretch.hit()
}

/// Cuts a stretch down to the inside of an upright cylinder without ends.
fn within_pipe(stretch: &mut Stretch, radius: f64, from: DVec3, direction: DVec3) -> Option<()> {
    let (p, d) = (from.truncate(), direction.truncate());
    let (a, c) = (d.length_squared(), p.length_squared() - radius * radius);
    if a == 0.0 {
        return (c <= 0.0).then_some(());
    }
    let (first, last) = roots(a, p.dot(d), c)?;
    if first > stretch.enter {
        stretch.enter = first;
        stretch.normal = ((p + d * first) / radius).extend(0.0);
    }
    stretch.leave = stretch.leave.min(last);
    Some(())
}

fn cylinder(radius: f64, half: f64, from: DVec3, direction: DVec3) -> Option<Hit> {
    let mut stretch = Stretch::new(direction);
    stretch.below(from.z - half, direction.z, DVec3::Z);
    stretch.below(-from.z - half, -direction.z, DVec3::NEG_Z);
    within_pipe(&mut stretch, radius, from, direction)?;
    stretch.hit()
}

fn capsule(radius: f64, half: f64, from: DVec3, direction: DVec3) -> Option<Hit> {
    let up = DVec3::new(0.0, 0.0, half);
    let mut best = cylinder(radius, half, from, direction);
    for end in [up, -up] {
        let hit = ball(radius, from - end, direction);
        best = match (best, hit) {
            (Some(best), Some(hit)) if hit.0 < best.0 => Some(hit),
            (None, hit) => hit,
            (best, _) => best,
        };
    }
    best
}

fn cone(radius: f64, half: f64, from: DVec3, direction: DVec3) -> Option<Hit> {
    let slope = radius / (2.0 * half);
    let below_tip = half - from.z;
    let inside = from.z >= -half && below_tip >= 0.0;
    if inside && from.truncate().length() <= slope * below_tip {
        return Some((0.0, -direction));
    }
    let mut best: Option<Hit> = None;
    let mut keep = |at: f64, normal: DVec3| {
        if at >= 0.0 && best.is_none_or(|(first, _)| at < first) {
            best = Some((at, normal));
        }
    };
    if direction.z > 0.0 {
        let at = (-half - from.z) / direction.z;
        if (from + direction * at).truncate().length() <= radius {
            keep(at, DVec3::NEG_Z);
        }
    }
    let (p, d) = (from.truncate(), direction.truncate());
    let a = d.length_squared() - slope * slope * direction.z * direction.z;
    let b = p.dot(d) + slope * slope * below_tip * direction.z;
    let c = p.length_squared() - slope * slope * below_tip * below_tip;
    let candidates = if a > 0.0 {
        roots(a, b, c)
    } else if a < 0.0 {
        roots(-a, -b, -c)
    } else {
        (b != 0.0).then(|| (-0.5 * c / b, f64::NAN))
    };
    if let Some((one, two)) = candidates {
        for at in [one, two] {
            let point = from + direction * at;
            if point.z.abs() <= half {
                let outward = point.truncate().normalize_or(DVec2::X);
                let normal = outward.extend(slope).normalize();
                if normal.dot(direction) < 0.0 {
                    keep(at, normal);
                }
            }
        }
    }
    best
}

/// Moeller and Trumbore 1997; both sides.
fn triangle(corners: &[DVec3; 3], from: DVec3, direction: DVec3) -> Option<Hit> {
    let [a, b, c] = *corners;
    let (ab, ac) = (b - a, c - a);
    let across = direction.cross(ac);
    let volume = ab.dot(across);
    if volume == 0.0 {
        return None;
    }
    let back = from - a;
    let u = back.dot(across) / volume;
    let turned = back.cross(ab);
    let v = direction.dot(turned) / volume;
    let at = ac.dot(turned) / volume;
    if u < 0.0 || v < 0.0 || u + v > 1.0 || at < 0.0 {
        return None;
    }
    let normal = ab.cross(ac).try_normalize()?;
    let facing = if normal.dot(direction) > 0.0 {
        -normal
    } else {
        normal
    };
    Some((at, facing))
}

impl Convex {
    /// Where a ray of unit direction first meets this solid, grown by `margin`: its distance, and the
    /// outward normal. A ray that begins inside meets it at once, head on.
    pub(crate) fn cast_ray(&self, margin: f64, from: DVec3, direction: DVec3) -> Option<Hit> {
        match self {
            Self::Point => ball(margin, from, direction),
            Self::Segment { half } => capsule(margin, *half, from, direction),
            Self::Block { half } => block(*half, from, direction),
            Self::Cylinder { radius, half } => cylinder(*radius, *half, from, direction),
            Self::Cone { radius, half } => cone(*radius, *half, from, direction),
            Self::Hull(points) => hull(points, from, direction),
            Self::Triangle(corners) => triangle(corners, from, direction),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Convex;
    use crate::shape::hull::hull;
    use glam::DVec3;
    use simbeeotic_kernel::Stream;
    use std::sync::Arc;

    /// Where a ray that takes small steps is first inside.
    fn marched(solid: &Convex, margin: f64, from: DVec3, direction: DVec3) -> Option<f64> {
        let mut at = 0.0;
        while at < 10.0 {
            let gap = solid.nearest(from + direction * at).distance - margin;
            if gap < 1e-9 {
                return Some(at);
            }
            at += gap;
        }
        None
    }

    #[test]
    fn rays_meet_solids_where_the_distance_to_them_is_nothing() {
        let corners: Vec<_> = (0..8)
            .map(|k| DVec3::new(f64::from(k & 1), f64::from(k & 2), 0.3 * f64::from(k & 4)))
            .collect();
        let (radius, half) = (0.5, 0.8);
        let solids = [
            (Convex::Point, 0.7),
            (Convex::Segment { half }, 0.4),
            (
                Convex::Block {
                    half: DVec3::new(0.3, 0.6, 0.9),
                },
                0.0,
            ),
            (Convex::Cylinder { radius, half }, 0.0),
            (Convex::Cone { radius, half }, 0.0),
            (Convex::Hull(Arc::new(hull(&corners).unwrap())), 0.0),
            (
                Convex::Triangle([DVec3::X, DVec3::Y, DVec3::new(-1.0, -1.0, 0.5)]),
                0.0,
            ),
        ];
        let mut stream = Stream::new(1, "rays", "test");
        let (mut hits, mut misses) = (0, 0);
        for k in 0..7000 {
            let (solid, margin) = &solids[k % solids.len()];
            let from = stream.in_ball(2.0);
            let aim = stream.in_ball(0.8);
            let direction = (aim - from).normalize();
            let exact = solid.cast_ray(*margin, from, direction).map(|hit| hit.0);
            match (exact, marched(solid, *margin, from, direction)) {
                (Some(exact), Some(marched)) => {
                    hits += 1;
                    // A ray that grazes ends its march early.
                    assert!(
                        exact >= marched - 1e-9 && exact < marched + 1e-3,
                        "{solid:?} {exact} {marched}"
                    );
                }
                (Some(exact), None) => panic!("{solid:?} {exact}"),
                (None, Some(at)) => {
                    let least = solid.nearest(from + direction * at).distance - margin;
                    assert!(least < 1e-8, "{solid:?} {at}");
                    misses += 1;
                }
                (None, None) => misses += 1,
            }
        }
        assert!(hits > 2000 && misses > 500, "{hits} {misses}");
    }
}
