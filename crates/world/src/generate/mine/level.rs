//! What is open on one level of a mine: tunnels are dug cell by cell, before anything is measured.

use super::MineParams;
use simbeeotic_kernel::rng::Stream;

/// The open cells of one level, row by row from the south; the shaft's among them.
pub(super) struct Level {
    pub(super) open: Vec<bool>,
    pub(super) columns: i32,
    pub(super) rows: i32,
    /// Where tunnels end.
    pub(super) ends: Vec<[i32; 2]>,
}

/// East, north, west, south.
const WAYS: [[i32; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

/// A tunnel still to be dug: the first cell, the way it runs, how often it branched off.
struct Tunnel {
    from: [i32; 2],
    way: usize,
    depth: u32,
}

/// The next cell that way.
pub(super) fn step([x, y]: [i32; 2], way: usize) -> [i32; 2] {
    let [dx, dy] = WAYS[way % 4];
    [x + dx, y + dy]
}

impl Level {
    /// Digs level `at` of a mine whose shaft takes `across` cells each way from the cell `shaft` on.
    pub(super) fn dug(p: &MineParams, at: u32, shaft: [i32; 2], across: i32) -> Self {
        let path = format!("mine/level-{at}");
        let stream = |purpose| Stream::new(p.seed.cast_unsigned(), &path, purpose);
        let mut level = Self {
            open: vec![false; (p.columns * p.rows) as usize],
            columns: p.columns as i32,
            rows: p.rows as i32,
            ends: Vec::new(),
        };
        let (mut sides, mut chance) = (stream("openings"), stream("tunnels"));
        let [x, y] = shaft;
        let middle = across / 2;
        let mut tunnels: Vec<Tunnel> = Vec::new();
        let gates = [
            [x + across, y + middle],
            [x + middle, y + across],
            [x - 1, y + middle],
            [x + middle, y - 1],
        ];
        for (way, from) in gates.into_iter().enumerate() {
            // Each side has its draw, the eastern one too.
            if sides.bernoulli(p.openings) || way == 0 {
                tunnels.push(Tunnel {
                    from,
                    way,
                    depth: 0,
                });
            }
        }
        // The shaft is dug last: a tunnel that leaves it has rock on both sides.
        while let Some(tunnel) = (!tunnels.is_empty()).then(|| tunnels.remove(0)) {
            tunnels.extend(level.run(&tunnel, p, &mut chance));
        }
        for dy in 0..across {
            for dx in 0..across {
                level.dig([x + dx, y + dy]);
            }
        }
        level
    }

    pub(super) fn is_open(&self, [x, y]: [i32; 2]) -> bool {
        let inside = (0..self.columns).contains(&x) && (0..self.rows).contains(&y);
        inside && self.open[(y * self.columns + x) as usize]
    }

    /// Whether a cell may be dug at all: the outermost ones stay rock.
    fn diggable(&self, [x, y]: [i32; 2]) -> bool {
        (1..self.columns - 1).contains(&x) && (1..self.rows - 1).contains(&y)
    }

    fn dig(&mut self, [x, y]: [i32; 2]) {
        self.open[(y * self.columns + x) as usize] = true;
    }

    /// Whether a tunnel may go on to `cell`: rock, with rock on both sides of it and ahead.
    fn is_free(&self, cell: [i32; 2], way: usize) -> bool {
        let beside = [way, way + 1, way + 3].map(|way| step(cell, way));
        self.diggable(cell) && !self.is_open(cell) && beside.iter().all(|c| !self.is_open(*c))
    }

    fn run(&mut self, tunnel: &Tunnel, params: &MineParams, chance: &mut Stream) -> Vec<Tunnel> {
        let mut branches = Vec::new();
        let mut cell = tunnel.from;
        if !self.is_free(cell, tunnel.way) {
            return branches;
        }
        let branching = params.branches / f64::from(tunnel.depth.max(1));
        loop {
            self.dig(cell);
            for side in [1, 3] {
                if chance.bernoulli(branching) {
                    let way = tunnel.way + side;
                    branches.push(Tunnel {
                        from: step(cell, way),
                        way,
                        depth: tunnel.depth + 1,
                    });
                }
            }
            let goes_on = tunnel.depth == 0 || chance.bernoulli(params.advance);
            let next = step(cell, tunnel.way);
            if !goes_on || !self.is_free(next, tunnel.way) {
                break;
            }
            cell = next;
        }
        if chance.bernoulli(params.chambers) {
            let [x, y] = cell;
            let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| [x + dx, y + dy]));
            for cell in around {
                if self.diggable(cell) {
                    self.dig(cell);
                }
            }
        }
        self.ends.push(cell);
        branches
    }
}
