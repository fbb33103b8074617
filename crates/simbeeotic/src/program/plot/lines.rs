//! Lines in pixels: what of them is inside a frame, and how few points say the same.

/// What of a line of points is inside a frame (left, top, right, bottom): pieces in their order.
pub(super) fn clipped(points: &[[f64; 2]], frame: [f64; 4]) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut open = false;
    for two in points.windows(2) {
        let Some([from, to]) = inside(two[0], two[1], frame) else {
            open = false;
            continue;
        };
        match pieces.last_mut() {
            Some(piece) if open && piece.last() == Some(&from) => piece.push(to),
            _ => pieces.push(vec![from, to]),
        }
        open = to == two[1];
    }
    pieces
}

/// The part of a straight line that is inside a frame, after Liang and Barsky (1984).
fn inside(a: [f64; 2], b: [f64; 2], frame: [f64; 4]) -> Option<[[f64; 2]; 2]> {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for (step, room) in [
        (-dx, a[0] - frame[0]),
        (dx, frame[2] - a[0]),
        (-dy, a[1] - frame[1]),
        (dy, frame[3] - a[1]),
    ] {
        if !(step.is_finite() && room.is_finite()) || (step == 0.0 && room < 0.0) {
            return None;
        }
        if step < 0.0 {
            low = low.max(room / step);
        } else if step > 0.0 {
            high = high.min(room / step);
        }
    }
    let at = |share: f64| match share {
        0.0 => a,
        1.0 => b,
        share => [a[0] + share * dx, a[1] + share * dy],
    };
    (low <= high).then(|| [at(low), at(high)])
}

/// What of an area is inside a frame, after Sutherland and Hodgman (1974); empty if nothing is.
pub(super) fn clipped_area(ring: &[[f64; 2]], frame: [f64; 4]) -> Vec<[f64; 2]> {
    let mut ring = ring.to_vec();
    for (axis, bound, sign) in [
        (0, frame[0], 1.0),
        (0, frame[2], -1.0),
        (1, frame[1], 1.0),
        (1, frame[3], -1.0),
    ] {
        let room = |p: &[f64; 2]| sign * (p[axis] - bound);
        let mut next = Vec::with_capacity(ring.len() + 4);
        for (at, to) in ring.iter().enumerate() {
            let from = &ring[(at + ring.len() - 1) % ring.len()];
            let (a, b) = (room(from), room(to));
            if (a < 0.0) != (b < 0.0) {
                let share = a / (a - b);
                next.push([0, 1].map(|k| from[k] + share * (to[k] - from[k])));
            }
            if b >= 0.0 {
                next.push(*to);
            }
        }
        ring = next;
    }
    ring
}

/// Fewer points, of which the line is nowhere farther than `tolerance`, after Douglas and Peucker (1973).
pub(super) fn simplified(points: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    if points.len() < 3 {
        return points.to_vec();
    }
    let mut kept = vec![false; points.len()];
    let last = points.len() - 1;
    (kept[0], kept[last]) = (true, true);
    let mut parts = vec![(0, last)];
    while let Some((from, to)) = parts.pop() {
        let mut farthest = (tolerance, None);
        for at in from + 1..to {
            let distance = distance(points[at], points[from], points[to]);
            if distance > farthest.0 {
                farthest = (distance, Some(at));
            }
        }
        if let Some(at) = farthest.1 {
            kept[at] = true;
            parts.extend([(from, at), (at, to)]);
        }
    }
    let points = points.iter().zip(kept);
    points
        .filter(|(_, kept)| *kept)
        .map(|(point, _)| *point)
        .collect()
}

/// From a point to the straight line between two others.
fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let [ex, ey] = [p[0] - a[0], p[1] - a[1]];
    let square = dx * dx + dy * dy;
    let share = if square > 0.0 {
        ((ex * dx + ey * dy) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let [x, y] = [ex - share * dx, ey - share * dy];
    (x * x + y * y).sqrt()
}

/// The least convex area around points, counter-clockwise where `y` is upwards, after Andrew (1979).
pub(super) fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.retain(|point| point.iter().all(|x| x.is_finite()));
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let half = |points: &mut dyn Iterator<Item = &[f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for point in points {
            while let [.., a, b] = chain.as_slice()
                && (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]) <= 0.0
            {
                chain.pop();
            }
            chain.push(*point);
        }
        chain.pop();
        chain
    };
    let mut ring = half(&mut points.iter());
    ring.extend(half(&mut points.iter().rev()));
    ring
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: [f64; 4] = [0.0, 0.0, 10.0, 10.0];

    #[test]
    fn a_line_that_leaves_and_comes_back_is_two_pieces() {
        let pieces = clipped(
            &[[5.0, 5.0], [15.0, 5.0], [15.0, 8.0], [5.0, 8.0], [5.0, 9.0]],
            FRAME,
        );
        assert_eq!(
            pieces,
            [
                vec![[5.0, 5.0], [10.0, 5.0]],
                vec![[10.0, 8.0], [5.0, 8.0], [5.0, 9.0]]
            ]
        );
        assert!(clipped(&[[-1.0, -1.0], [-1.0, 20.0]], FRAME).is_empty());
        assert!(clipped(&[[f64::NAN, 1.0], [2.0, 1.0]], FRAME).is_empty());
    }

    #[test]
    fn an_area_is_cut_at_its_frame() {
        let ring = [[5.0, 5.0], [15.0, 5.0], [15.0, 15.0], [5.0, 15.0]];
        let cut = clipped_area(&ring, FRAME);
        for corner in [[5.0, 5.0], [10.0, 5.0], [10.0, 10.0], [5.0, 10.0]] {
            assert!(cut.contains(&corner), "{cut:?}");
        }
        assert!(clipped_area(&[[20.0, 1.0], [30.0, 1.0], [25.0, 4.0]], FRAME).is_empty());
    }

    #[test]
    fn simplified_lines_keep_their_corners_and_stay_near() {
        let mut points: Vec<[f64; 2]> = (0..=100).map(|x| [f64::from(x), 0.0]).collect();
        points.extend((1..=100).map(|y| [100.0, f64::from(y)]));
        assert_eq!(
            simplified(&points, 0.3),
            [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0]]
        );
        let wave: Vec<[f64; 2]> = (0..400)
            .map(|k| {
                let x = f64::from(k) * 0.5;
                [x, 20.0 * simbeeotic_units::math::sin(x * 0.1)]
            })
            .collect();
        let few = simplified(&wave, 0.3);
        assert!(few.len() < 60, "{}", few.len());
        for point in &wave {
            let near = few.windows(2).map(|two| distance(*point, two[0], two[1]));
            assert!(near.fold(f64::INFINITY, f64::min) <= 0.3 + 1e-9);
        }
    }

    #[test]
    fn the_hull_of_a_square_with_points_in_it_is_the_square() {
        let ring = hull(vec![
            [0.0, 0.0],
            [2.0, 0.0],
            [1.0, 1.0],
            [2.0, 2.0],
            [0.0, 2.0],
            [1.0, 0.0],
        ]);
        assert_eq!(ring, [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
    }
}
