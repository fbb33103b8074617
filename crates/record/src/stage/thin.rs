//! Surfaces with fewer triangles, where there are more than a view can take.

use super::Form;
use simbeeotic_model::physics::{HeightField, Mesh};
use simbeeotic_model::units::glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Cells along a side of a height field that are drawn at most.
const CELLS_MAX: usize = 256;

/// Triangles of one mesh that are drawn at most.
pub(super) const TRIANGLES_MAX: usize = 200_000;

/// Heights as triangles; of a large field every second sample, or every third, and so on, and the last of
/// each row and column.
pub(super) fn of_field(field: &HeightField) -> Form {
    let (columns, rows) = (field.columns, field.rows());
    let (across, along) = (kept(columns), kept(rows));
    if across.len() < 2 || along.len() < 2 {
        return empty();
    }
    let place = |k: usize, of: usize| k as f64 / (of - 1) as f64 - 0.5;
    let mut points = Vec::new();
    for row in &along {
        for column in &across {
            let at = DVec2::new(place(*column, columns), place(*row, rows)) * field.size_m;
            let height = field.heights_m.get(row * columns + column);
            points.push(at.extend(height.copied().unwrap_or(0.0)));
        }
    }
    let mut triangles = Vec::new();
    let number = |row: usize, column: usize| (row * across.len() + column) as u32;
    for row in 0..along.len() - 1 {
        for column in 0..across.len() - 1 {
            let [south_west, south_east] = [number(row, column), number(row, column + 1)];
            let [north_west, north_east] = [number(row + 1, column), number(row + 1, column + 1)];
            // The diagonal is that of physics.
            triangles.push([south_west, north_east, north_west]);
            triangles.push([south_west, south_east, north_east]);
        }
    }
    form(&points, &triangles)
}

/// Which of some samples are kept.
fn kept(samples: usize) -> Vec<usize> {
    let Some(last) = samples.checked_sub(1) else {
        return Vec::new();
    };
    let step = last.div_ceil(CELLS_MAX).max(1);
    let mut kept: Vec<usize> = (0..last).step_by(step).collect();
    kept.push(last);
    kept
}

/// A mesh; a large one with its corners moved together, cell by cell of a grid that is made coarser until
/// at most so many triangles are left.
pub(super) fn of_mesh(mesh: &Mesh, triangles_max: usize) -> Form {
    let real = |t: &&[u32; 3]| t.iter().all(|k| (*k as usize) < mesh.points_m.len());
    let triangles: Vec<[u32; 3]> = mesh.triangles.iter().filter(real).copied().collect();
    if triangles.len() <= triangles_max {
        return form(&mesh.points_m, &triangles);
    }
    let least = mesh
        .points_m
        .iter()
        .copied()
        .fold(DVec3::INFINITY, DVec3::min);
    let most = (mesh.points_m.iter().copied()).fold(DVec3::NEG_INFINITY, DVec3::max);
    let extent = (most - least).max_element();
    let mut cells = 1024.0;
    loop {
        let (points, left) = clustered(&mesh.points_m, &triangles, least, extent / cells);
        if left.len() <= triangles_max || cells < 4.0 {
            return form(&points, &left);
        }
        cells *= 0.7;
    }
}

/// One corner for each cell of a grid: the first that lies in it. Triangles that lose their area so are
/// left out, and of equal ones all but the first.
fn clustered(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    least: DVec3,
    cell_m: f64,
) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut places: BTreeMap<[u32; 3], u32> = BTreeMap::new();
    let mut kept = Vec::new();
    let number = |point: &DVec3| {
        let key = ((*point - least) / cell_m).to_array().map(|x| x as u32);
        *places.entry(key).or_insert_with(|| {
            kept.push(*point);
            kept.len() as u32 - 1
        })
    };
    let numbers: Vec<u32> = points.iter().map(number).collect();
    let mut seen = std::collections::BTreeSet::new();
    let moved = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|k| numbers[k as usize]);
        let least = a.min(b).min(c);
        // Turned so that the least comes first: the same triangle has one key.
        let turned = match least {
            _ if least == a => [a, b, c],
            _ if least == b => [b, c, a],
            _ => [c, a, b],
        };
        (a != b && b != c && c != a && seen.insert(turned)).then_some(turned)
    };
    let triangles = triangles.iter().filter_map(moved).collect();
    (kept, triangles)
}

fn empty() -> Form {
    form(&[], &[])
}

fn form(points: &[DVec3], triangles: &[[u32; 3]]) -> Form {
    Form::Mesh {
        points_m: points.iter().map(|p| p.as_vec3().to_array()).collect(),
        triangles: triangles.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::triangles::tests::volume;
    use super::*;

    fn field(columns: usize, rows: usize, height: impl Fn(f64, f64) -> f64) -> HeightField {
        let heights_m = (0..rows * columns).map(|k| {
            let across = (k % columns) as f64 / (columns - 1) as f64 - 0.5;
            let along = (k / columns) as f64 / (rows - 1) as f64 - 0.5;
            height(20.0 * across, 10.0 * along)
        });
        HeightField {
            size_m: DVec2::new(20.0, 10.0),
            columns,
            heights_m: heights_m.collect(),
        }
    }

    #[test]
    fn a_slope_is_the_same_slope_however_many_samples_it_has() {
        for (columns, rows) in [(2, 2), (5, 3), (257, 258), (1000, 300)] {
            let slope = field(columns, rows, |x, y| 3.0 + 0.5 * x - 0.25 * y);
            let surface = of_field(&slope).triangles(8);
            assert!(surface.triangles.len() <= 2 * CELLS_MAX * CELLS_MAX);
            let (mut area, mut volume) = (0.0, 0.0);
            for corners in surface.corners() {
                let [a, b, c] = corners.map(|p| DVec3::from_array(p.map(f64::from)));
                let normal = (b - a).cross(c - a) * 0.5;
                assert!(normal.z > 0.0, "seen from above");
                area += normal.z;
                volume += normal.z * (a.z + b.z + c.z) / 3.0;
            }
            assert!((area - 200.0).abs() < 1e-3, "{columns} x {rows}: {area}");
            assert!(
                (volume - 600.0).abs() < 1e-2,
                "{columns} x {rows}: {volume}"
            );
        }
    }

    #[test]
    fn a_mesh_of_too_many_triangles_keeps_its_outline() {
        let fine = Form::Sphere { radius_m: 2.0 }.triangles(256);
        let mesh = Mesh {
            points_m: (fine.points_m.iter())
                .map(|p| DVec3::from_array(p.map(f64::from)))
                .collect(),
            triangles: fine.triangles.to_vec(),
        };
        assert!(of_mesh(&mesh, 100_000).triangles(8) == fine, "few enough");
        let thinned = of_mesh(&mesh, 5_000).triangles(8);
        assert!((1_000..=5_000).contains(&thinned.triangles.len()));
        let share = volume(&thinned) / volume(&fine);
        assert!((share - 1.0).abs() < 0.02, "{share}");
    }

    #[test]
    fn corners_that_do_not_exist_are_left_out() {
        let mesh = Mesh {
            points_m: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
            triangles: vec![[0, 1, 2], [0, 1, 3]],
        };
        assert_eq!(of_mesh(&mesh, 10).triangles(8).triangles.len(), 1);
        assert_eq!(of_field(&HeightField::default()), empty());
    }
}
