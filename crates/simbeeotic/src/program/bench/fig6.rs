//! Figure 6: 32 bees, and ever more obstacles. The paper does not say what they are and where they
//! stand; its cost grows linearly with their number.
//!
//! Here they are boxes, one in each cell of a lattice, turned and shifted at random, those next to the
//! bees' start first. `--reach in` puts this field around the start: the first thousands stand where
//! the bees fly, the rest behind. `--reach out` puts the same field to the east of wherever the bees
//! can come in the time they have: whoever is not met must not cost anything, nor change a bit of the
//! run. Without a word, both are measured.

use super::alone::Case;
use super::arguments::{self, Common};
use super::files::Facts;
use super::measure::{self, Experiment, Row as Measurement};
use super::report::Report;
use super::workload::{self, Cost, MAX_SPEED_M_S, Most, PAPER_EDGE_M, SEED, Workload};
use super::{Failure, input, paper, remark, table};
use clap::Args;
use serde::Serialize;
use simbeeotic_kernel::rng::Stream;
use simbeeotic_model::world::{Obstacle, ObstacleShape, World};
use simbeeotic_scenario::Loaded;
use simbeeotic_units::glam::DVec3;
use simbeeotic_units::{Angle, Length, Position};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Bees of the experiment, as in the paper.
pub(super) const BEES: u32 = 32;

/// Arguments of `bench fig6`.
#[derive(Args)]
pub(in crate::program) struct Options {
    /// Numbers of obstacles; none is always among them [default: see below]
    #[arg(
        long,
        value_delimiter = ',',
        value_parser = number,
        allow_negative_numbers = true
    )]
    obstacles: Vec<u32>,
    /// Where they stand: in (where the bees fly) or out (farther than they can fly), or both, in,out
    #[arg(long, value_delimiter = ',', default_value = "in,out", value_parser = ["out", "in"])]
    reach: Vec<String>,
    /// Distance from obstacle to obstacle: each has a cube of this edge to itself
    #[arg(
        long,
        default_value = "4 m",
        value_name = "LENGTH",
        allow_hyphen_values = true
    )]
    spacing: String,
    /// Threads that run models
    #[arg(
        long,
        default_value_t = 1,
        value_parser = super::super::arguments::threads,
        allow_negative_numbers = true
    )]
    threads: usize,
    #[command(flatten)]
    common: Common,
}

/// What is below the options in the help.
pub(super) const HELP: &str = "\
Numbers: 0,10,100,1000,10000,100000, each for 100 s; with --full also 1, 2, 5, 20, 50 and so on. The limit is
searched beyond them, up to ten million, as far as the time (--within) and half of the free memory go: an
obstacle takes about a kilobyte.

Examples:
  simbeeotic bench fig6
  simbeeotic bench fig6 --full -o out/fig6-full
  simbeeotic bench fig6 --reach in --spacing \"2 m\" --obstacles 1000,10000";

/// Numbers of the quick and of the whole experiment.
const NUMBERS: [&[u32]; 2] = [
    &[0, 10, 100, 1_000, 10_000, 100_000],
    &[
        0, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1_000, 2_000, 5_000, 10_000, 20_000, 50_000, 100_000,
    ],
];

/// More obstacles than this take longer to make than anybody waits.
const OBSTACLES_MAX: u32 = 10_000_000;

fn number(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(n) if n <= OBSTACLES_MAX => Ok(n),
        _ => Err(format!("obstacles number between 0 and {OBSTACLES_MAX}")),
    }
}

/// One row of the table.
#[derive(Serialize)]
struct Row {
    obstacles: u32,
    reach: String,
    threads: usize,
    #[serde(flatten)]
    cost: Cost,
    /// Physics' time over that without obstacles, the start apart.
    physics_ratio: f64,
}

/// The experiment, its arguments read.
struct Fig6<'a> {
    options: &'a Options,
    duration_s: f64,
    spacing_m: f64,
    numbers: Vec<u32>,
    reach: Vec<String>,
}

impl Fig6<'_> {
    fn load(&self) -> Result<Loaded, Failure> {
        let workload = Workload {
            bees: BEES,
            duration_s: self.duration_s,
            edges_m: [PAPER_EDGE_M; 3],
            phase: &self.options.common.phase,
            contacts: true,
            channel: None,
        };
        workload.load()
    }

    /// So many obstacles, where the bees fly or where they cannot come.
    fn world(&self, loaded: &Loaded, case: Case) -> Result<Arc<World>, Failure> {
        let starts = input::setup(loaded)?.models;
        let starts: Vec<DVec3> = starts
            .iter()
            .map(|model| model.start.position.si())
            .collect();
        let reach_m = PAPER_EDGE_M + MAX_SPEED_M_S * self.duration_s;
        let east_m = match self.out(case.line) {
            true => reach_m + field_m(case.size, &starts, self.spacing_m),
            false => 0.0,
        };
        Ok(Arc::new(world(case.size, self.spacing_m, east_m, &starts)))
    }

    fn out(&self, line: usize) -> bool {
        self.reach[line] == "out"
    }

    fn facts(&self, case: Case) -> Facts {
        Facts {
            n: Some(BEES),
            obstacles: Some(case.size),
            threads: Some(self.options.threads),
            start: "paper".to_owned(),
            phase: self.options.common.phase.clone(),
            contacts: "on".to_owned(),
            reach: self.reach[case.line].clone(),
            spacing_m: Some(self.spacing_m),
            ..Facts::default()
        }
    }
}

impl Experiment for Fig6<'_> {
    fn name(&self) -> &'static str {
        "fig6"
    }

    fn common(&self) -> &Common {
        &self.options.common
    }

    fn setup(&self) -> Vec<(&'static str, String)> {
        vec![
            ("duration", format!("{} s", self.duration_s)),
            ("spacing", format!("{} m", self.spacing_m)),
            ("phase", self.options.common.phase.clone()),
            ("threads", self.options.threads.to_string()),
        ]
    }

    fn duration_s(&self) -> f64 {
        self.duration_s
    }

    fn sizes(&self) -> &[u32] {
        &self.numbers
    }

    fn is_ladder(&self) -> bool {
        self.options.obstacles.is_empty()
    }

    fn lines(&self) -> Vec<String> {
        let name = |line| {
            if self.out(line) {
                "out of reach"
            } else {
                "in the way"
            }
        };
        (0..self.reach.len())
            .map(|line| name(line).to_owned())
            .collect()
    }

    fn ceiling(&self) -> u32 {
        OBSTACLES_MAX
    }

    /// More than of the others: its runs are short.
    fn repeats(&self) -> u32 {
        7
    }

    fn warm_up(&self) -> Result<(), Failure> {
        workload::run(&self.load()?, self.options.threads, None, Most::default()).map(drop)
    }

    fn run(&self, case: Case, most: Most) -> Result<Cost, Failure> {
        let loaded = self.load()?;
        let world = self.world(&loaded, case)?;
        workload::run(&loaded, self.options.threads, Some(&world), most)
    }
}

pub(super) fn fig6(options: &Options) -> Result<(), Failure> {
    let common = &options.common;
    let mut numbers = arguments::sizes(&options.obstacles, common.full, NUMBERS[0], NUMBERS[1]);
    if numbers.first() != Some(&0) {
        numbers.insert(0, 0);
    }
    let experiment = Fig6 {
        options,
        duration_s: common.duration_s("100 s")?,
        spacing_m: spacing_m(&options.spacing)?,
        numbers,
        reach: arguments::once(&options.reach),
    };
    let setup = format!(
        "{BEES} bees, {} s virtual, boxes {} m apart {}, {} timers",
        experiment.duration_s,
        experiment.spacing_m,
        experiment.lines().join(" or "),
        common.phase,
    );
    if !common.json && common.alone.is_none() {
        remark(format!("figure 6: {setup}"));
    }
    let report = Report {
        name: "fig6",
        title: "Figure 6: 32 bees, and ever more obstacles",
        setup,
        x: "obstacles",
        all_shares: true,
        paper: paper::FIG6,
        facts: &|case| experiment.facts(case),
        searched: |facts, obstacles| facts.obstacles = obstacles,
    };
    let so_far = |rows: &[Measurement], probes: &[Measurement]| {
        report.so_far(&experiment, rows, probes);
    };
    let Some(measured) = measure::measure(&experiment, &so_far)? else {
        return Ok(());
    };
    let rows = rows(&experiment, &measured.rows);
    unmoved(&rows)?;
    if !common.json {
        print(&rows)?;
        table::method(&measured.rows);
        if rows.iter().any(|row| row.reach == "out") {
            remark(
                "out of reach the run is the same with any number of obstacles: equal trace hashes",
            );
        }
    }
    report.finish(&experiment, measured, &rows)
}

fn rows(experiment: &Fig6<'_>, measured: &[Measurement]) -> Vec<Row> {
    // The first row of each line is without obstacles.
    let first = |line: usize| measured.iter().find(|row| row.case.line == line);
    let row = |row: &Measurement| Row {
        obstacles: row.case.size,
        reach: experiment.reach[row.case.line].clone(),
        threads: experiment.options.threads,
        physics_ratio: first(row.case.line)
            .map_or(1.0, |first| row.least.physics_s / first.least.physics_s),
        cost: row.least.clone(),
    };
    measured.iter().map(row).collect()
}

/// Whoever is out of reach must not change the run.
fn unmoved(rows: &[Row]) -> Result<(), Failure> {
    let mut out = rows.iter().filter(|row| row.reach == "out");
    let Some(empty) = out.next() else {
        return Ok(());
    };
    match out.find(|row| row.cost.trace_hash != empty.cost.trace_hash) {
        None => Ok(()),
        Some(row) => Err(Failure::run(format!(
            "{} obstacles that nobody can reach change the run: trace hash {}, {} without",
            row.obstacles, row.cost.trace_hash, empty.cost.trace_hash
        ))),
    }
}

fn print(rows: &[Row]) -> Result<(), Failure> {
    let head = ["obstacles", "reach"].into_iter().chain(table::SHARES);
    table::line(head.chain(["cpu s", "touches", "ratio"]))?;
    for row in rows {
        let mut columns = vec![row.obstacles.to_string(), row.reach.clone()];
        columns.extend(table::shares(&row.cost));
        columns.push(table::figure(row.cost.cpu_s, 3));
        columns.push(row.cost.touches.to_string());
        columns.push(format!("{:.2}x", row.physics_ratio));
        table::line(columns.iter().map(String::as_str))?;
    }
    Ok(())
}

fn spacing_m(text: &str) -> Result<f64, Failure> {
    match text.parse::<Length>() {
        Ok(spacing) if (0.1..=1000.0).contains(&spacing.get()) => Ok(spacing.get()),
        Ok(spacing) => Err(Failure::input(format!(
            "--spacing {spacing}: it lies between 0.1 m and 1000 m"
        ))),
        Err(e) => Err(Failure::input(format!("--spacing: {e}"))),
    }
}

/// Cells along each edge of a field of `n` obstacles, with room for those that a start displaces.
fn cells(n: u32, starts: &[DVec3]) -> u32 {
    let mut edge = 1;
    let needed = u64::from(n) + 8 * starts.len() as u64;
    while u64::from(edge).pow(3) < needed {
        edge += 1;
    }
    edge
}

/// From the middle of a field of `n` obstacles to beyond its end, along `x`, m.
fn field_m(n: u32, starts: &[DVec3], spacing: f64) -> f64 {
    f64::from(cells(n, starts)) * spacing
}

/// A world with `n` boxes around the middle of the bees' start, or so far to the east of it; none
/// holds a start.
fn world(n: u32, spacing: f64, east_m: f64, starts: &[DVec3]) -> World {
    let middle = DVec3::splat(0.5 * PAPER_EDGE_M);
    let edge = cells(n, starts);
    let low = middle.with_z(0.0) - 0.5 * spacing * DVec3::new(edge.into(), edge.into(), 0.0);
    let mut centres = Vec::new();
    for z in 0..edge {
        for y in 0..edge {
            for x in 0..edge {
                let cell = DVec3::new(x.into(), y.into(), z.into());
                centres.push(low + spacing * (cell + 0.5));
            }
        }
    }
    // A stable sort: cells at one distance keep the lattice's order.
    centres.sort_by(|a, b| {
        let [a, b] = [a, b].map(|centre| centre.distance_squared(middle));
        a.total_cmp(&b)
    });

    let mut chance = Stream::new(SEED, "obstacles", "field");
    let mut obstacles = Vec::with_capacity(n as usize);
    for centre in centres {
        if obstacles.len() == n as usize {
            break;
        }
        // Half the diagonal is at most 0.33 spacings; shifted by 0.17, it still stays in its cell.
        let mut edge = || spacing * chance.uniform_in(0.125..0.375);
        let size = [edge(), edge(), edge()];
        let mut shift = || spacing * chance.uniform_in(-0.17..0.17);
        let centre = centre + DVec3::new(shift(), shift(), shift());
        let rotation = Angle::si(chance.uniform_in(0.0..TAU));
        let room = 0.5 * DVec3::from_array(size).length() + 0.1;
        if east_m == 0.0 && starts.iter().any(|start| start.distance(centre) < room) {
            continue;
        }
        let [length, width, height] = size.map(Length::si);
        let foot = centre + DVec3::new(east_m, 0.0, -0.5 * size[2]);
        obstacles.push(Obstacle {
            position: Position::from_si(foot),
            shape: ObstacleShape::Box {
                length,
                width,
                height,
                rotation,
            },
            ..Obstacle::default()
        });
    }
    let needed = 2.0 * (east_m + f64::from(cells(n, starts)) * spacing);
    World {
        radius: Length::si(needed.max(10_000.0)),
        obstacles,
        ..World::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STARTS: [DVec3; 3] = [
        DVec3::new(10.0, 10.0, 10.0),
        DVec3::new(1.0, 12.0, 0.5),
        DVec3::new(19.0, 3.0, 19.0),
    ];

    /// The edges of a box.
    fn size(obstacle: &Obstacle) -> DVec3 {
        match obstacle.shape {
            ObstacleShape::Box {
                length,
                width,
                height,
                ..
            } => DVec3::new(length.get(), width.get(), height.get()),
            _ => panic!("the field is of boxes"),
        }
    }

    fn middle(obstacle: &Obstacle) -> DVec3 {
        obstacle.position.si() + DVec3::new(0.0, 0.0, 0.5 * size(obstacle).z)
    }

    fn half_diagonal(obstacle: &Obstacle) -> f64 {
        0.5 * size(obstacle).length()
    }

    #[test]
    fn a_field_has_its_number_and_holds_no_start() {
        for n in [0, 1, 10, 100, 3_000] {
            let world = world(n, 1.0, 0.0, &STARTS);
            assert_eq!(world.obstacles.len(), n as usize);
            assert!(world.check().is_empty());
            for obstacle in &world.obstacles {
                assert!(obstacle.position.si().z >= 0.0);
                for start in STARTS {
                    let distance = middle(obstacle).distance(start);
                    assert!(distance >= half_diagonal(obstacle) + 0.1);
                }
            }
        }
    }

    #[test]
    fn boxes_do_not_overlap() {
        let world = world(200, 4.0, 0.0, &STARTS);
        for (i, a) in world.obstacles.iter().enumerate() {
            for b in &world.obstacles[..i] {
                let distance = middle(a).distance(middle(b));
                assert!(distance > half_diagonal(a) + half_diagonal(b));
            }
        }
    }

    #[test]
    fn a_field_out_of_reach_begins_where_the_reach_ends() {
        let reach = 220.0;
        for n in [1, 1_000] {
            let east = reach + field_m(n, &STARTS, 4.0);
            let world = world(n, 4.0, east, &STARTS);
            assert_eq!(world.obstacles.len(), n as usize);
            for obstacle in &world.obstacles {
                assert!(middle(obstacle).x - half_diagonal(obstacle) > reach);
            }
        }
    }
}
