//! Prints the world of `scenarios/ring.toml`: a thousand obstacles on a field of 100 m by 100 m.
//!
//! ```sh
//! cargo run -p simbeeotic --example ring_world > worlds/ring.toml
//! ```

use simbeeotic::kernel::Stream;
use std::fmt::Write;

const COUNT: usize = 1000;
/// Edge of the field, m.
const FIELD_M: f64 = 100.0;

/// The world file: the same for the same seed.
pub fn world(seed: u64) -> String {
    let mut rng = Stream::new(seed, "world/ring", "obstacles");
    let mut text = String::from(
        "# A thousand obstacles on a field of 100 m by 100 m, from 4 m to 10 m high: trunks, boxes, cones and\n\
         # balls. For `scenarios/ring.toml`; printed by `cargo run -p simbeeotic --example ring_world`.\n\n\
         obstacle = [\n",
    );
    // One in each cell of a grid, somewhere in its middle: no two overlap.
    let columns = (COUNT as f64).sqrt().ceil();
    let cell_m = FIELD_M / columns;
    for at in 0..COUNT {
        let (row, column) = ((at as f64 / columns).floor(), at as f64 % columns);
        let within =
            |index: f64, draw: f64| (index + 0.5 + 0.5 * (draw - 0.5)) * cell_m - 0.5 * FIELD_M;
        let (x, y) = (within(column, rng.uniform()), within(row, rng.uniform()));
        let wide = rng.uniform_in(0.3..1.0);
        let high = rng.uniform_in(4.0..10.0);
        let shape = match rng.below(10) {
            0..6 => {
                format!("cylinder = {{ diameter = \"{wide:.2} m\", height = \"{high:.1} m\" }}")
            }
            6..8 => {
                let turn = rng.uniform_in(0.0..90.0);
                format!(
                    "box = {{ length = \"{wide:.2} m\", width = \"{wide:.2} m\", height = \"{high:.1} m\", rotation = \"{turn:.0} deg\" }}"
                )
            }
            8 => format!(
                "cone = {{ radius = \"{:.2} m\", height = \"{high:.1} m\" }}",
                0.5 * wide
            ),
            _ => format!("sphere = {{ radius = \"{:.2} m\" }}", 0.5 * wide),
        };
        writeln!(
            text,
            "  {{ position = [\"{x:.2} m\", \"{y:.2} m\", \"0 m\"], shape = {{ {shape} }} }},"
        )
        .expect("a string takes it");
    }
    text.push_str("]\n");
    text
}

#[allow(clippy::print_stdout, reason = "a program that prints its result")]
fn main() {
    print!("{}", world(1));
}
