//! Triangles on the screen, and which tile of the picture they touch.
//!
//! Corners lie on a grid of 1/256 pixel. A tile is drawn by one thread, its triangles in the order of their list: the
//! picture does not depend on how many threads there are.

/// Edge of a tile, pixels.
pub(super) const TILE: usize = 64;
/// Steps of the grid of corners, a pixel.
pub(super) const GRID: i32 = 256;

/// A triangle on the screen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// Corners, right and down from the upper left corner of the picture, 1/256 pixel.
    pub(super) x: [i32; 3],
    pub(super) y: [i32; 3],
    /// How near each corner is; linear on the screen: the inverse of the distance, or its negative
    /// where there is no perspective.
    pub(super) near: [f32; 3],
    /// Red, green, blue, opacity of each corner.
    pub(super) rgba: [[u8; 4]; 3],
}

impl Triangle {
    /// From places on the picture, pixels, with how near they are and their colours.
    pub(super) fn on_screen(corners: [([f32; 2], f32, [u8; 4]); 3]) -> Self {
        let grid = |part: usize| corners.map(|(at, _, _)| (at[part] * GRID as f32).round() as i32);
        Self {
            x: grid(0),
            y: grid(1),
            near: corners.map(|(_, near, _)| near),
            rgba: corners.map(|(_, _, rgba)| rgba),
        }
    }
}

/// The triangles of a picture, by how they are drawn.
#[derive(Debug, Default)]
pub(super) struct Batch {
    /// What darkens the ground: once, however many lie on each other.
    pub(super) shadows: Vec<Triangle>,
    pub(super) solid: Vec<Triangle>,
    /// What lets through: drawn from back to front.
    pub(super) glass: Vec<Triangle>,
    /// What lets through, drawn last and in the order of the list.
    pub(super) lines: Vec<Triangle>,
}

impl Batch {
    /// Puts another batch behind this one.
    pub(super) fn append(&mut self, mut other: Self) {
        self.shadows.append(&mut other.shadows);
        self.solid.append(&mut other.solid);
        self.glass.append(&mut other.glass);
        self.lines.append(&mut other.lines);
    }

    /// Brings what lets through into its order.
    pub(super) fn sort(&mut self) {
        let depth = |t: &Triangle| t.near.iter().sum::<f32>();
        self.glass.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    }
}

/// Which triangles touch which tile.
pub(super) struct Bins {
    lists: Vec<Vec<u32>>,
}

impl Bins {
    /// `size`: of the picture, pixels.
    pub(super) fn new(triangles: &[Triangle], size: [usize; 2]) -> Self {
        let [across, down] = tiles(size);
        let mut lists = vec![Vec::new(); across * down];
        let span = |v: &[i32; 3], end: usize| {
            let (low, high) = (v[0].min(v[1]).min(v[2]), v[0].max(v[1]).max(v[2]));
            let edge = GRID * TILE as i32;
            let (low, high) = (low.div_euclid(edge), high.div_euclid(edge));
            (high >= 0 && low < end as i32)
                .then(|| low.max(0) as usize..=(high as usize).min(end - 1))
        };
        for (at, triangle) in triangles.iter().enumerate() {
            let (Some(columns), Some(rows)) = (span(&triangle.x, across), span(&triangle.y, down))
            else {
                continue;
            };
            for row in rows {
                for column in columns.clone() {
                    lists[row * across + column].push(at as u32);
                }
            }
        }
        Self { lists }
    }

    /// The triangles of one tile, in their order.
    pub(super) fn of<'a>(
        &'a self,
        tile: usize,
        triangles: &'a [Triangle],
    ) -> impl Iterator<Item = &'a Triangle> {
        self.places(tile).map(|at| &triangles[at])
    }

    /// Their places in the list.
    pub(super) fn places(&self, tile: usize) -> impl Iterator<Item = usize> + '_ {
        self.lists[tile].iter().map(|at| *at as usize)
    }
}

/// How many tiles a picture has, across and down.
pub(super) fn tiles([width, height]: [usize; 2]) -> [usize; 2] {
    [width.div_ceil(TILE), height.div_ceil(TILE)]
}

#[cfg(test)]
mod tests {
    use super::super::visible::Visible;
    use super::*;

    #[test]
    fn one_behind_another_edge_to_edge_over_tiles_is_whole() {
        let size = [150, 100];
        let corners = [[-300.0, -200.0], [700.0, -100.0], [10.0, 900.0]];
        let grid = |part: usize| corners.map(|c: [f64; 2]| (c[part] * f64::from(GRID)) as i32);
        let all = [Triangle {
            x: grid(0),
            y: grid(1),
            near: [1.0; 3],
            rgba: [[7; 4]; 3],
        }];
        let bins = Bins::new(&all, size);
        let [across, down] = tiles(size);
        let mut seen = 0;
        for number in 0..across * down {
            let mut tile = Visible::new(number, size);
            bins.of(number, &all).for_each(|t| tile.draw(t, 0));
            seen += tile.nearest().filter(|near| *near == 1.0).count();
        }
        assert_eq!(seen, 150 * 100);
    }
}
