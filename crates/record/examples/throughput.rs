//! What recording costs on this machine.
//!
//! ```text
//! cargo run --release -p simbeeotic-record --example throughput -- [VEHICLES] [TICKS] [FOLDER]
//! ```
//!
//! Records bees that wander, as fast as the writer takes them, and reads them back. One should
//! see some 50 bytes a vehicle and tick with fine precision and 80 with full, and the time of the
//! run's own thread far below that of the writer.

#![expect(clippy::print_stdout, reason = "a program")]
#![expect(
    clippy::disallowed_methods,
    reason = "the wall clock is the subject here"
)]

use simbeeotic_record::{
    Header, Precision, Recorder, Recording, Sample, Selection, Vehicle, export_csv, export_parquet,
};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let vehicles = arguments.next().map_or(Ok(10_000), |n| n.parse())?;
    let ticks = arguments.next().map_or(Ok(200), |n| n.parse())?;
    let folder = arguments.next().map_or(std::env::temp_dir(), PathBuf::from);

    for precision in [Precision::Fine, Precision::Full] {
        let path = folder.join(format!("throughput-{precision:?}.mcap"));
        for (twists, points) in [(false, false), (true, false), (true, true)] {
            record(&path, precision, (twists, points), vehicles, ticks)?;
        }
        read(&path, vehicles, ticks)?;
    }
    Ok(())
}

fn record(
    path: &Path,
    precision: Precision,
    (twists, points): (bool, bool),
    count: usize,
    ticks: u64,
) -> Result<(), Box<dyn Error>> {
    let vehicle = |number| Vehicle {
        path: format!("bee-{number}"),
        kind: "random-walk-bee".into(),
        radius_m: 0.01,
        ..Vehicle::default()
    };
    let header = Header {
        vehicles: (0..count).map(vehicle).collect(),
        precision,
        twists,
        points,
        ..Header::default()
    };
    let mut noise = Noise(1);
    let mut samples = vec![Sample::default(); count];
    for sample in &mut samples {
        sample.position_m = [0; 3].map(|_| 20.0 * noise.next());
    }

    let mut recorder = Recorder::create(path, header)?;
    let start = Instant::now();
    let mut inside = Duration::ZERO;
    for tick in 0..ticks {
        samples
            .iter_mut()
            .for_each(|sample| wander(sample, &mut noise));
        let since = Instant::now();
        recorder.tick(tick * 100_000_000, samples.iter().copied())?;
        inside += since.elapsed();
    }
    let blocked = recorder.stats().blocked;
    let stats = recorder.finish(&serde_json::Value::Null)?;

    let rows = count as f64 * ticks as f64;
    let each_ns = |time: Duration| time.as_secs_f64() * 1e9 / rows;
    println!(
        "{precision:?}, twists {twists}, points {points}: {:.1} B a vehicle and tick; {:.0} ns in the run's thread, \
         {:.0} ns blocked, {:.0} ns until all is written",
        stats.bytes as f64 / rows,
        each_ns(inside - blocked),
        each_ns(blocked),
        each_ns(start.elapsed()),
    );
    Ok(())
}

fn read(path: &Path, count: usize, ticks: u64) -> Result<(), Box<dyn Error>> {
    let rows = count as f64 * ticks as f64;
    let report = |what: &str, since: Instant, bytes: u64| {
        println!(
            "  {what}: {:.0} ns and {:.1} B a row",
            since.elapsed().as_secs_f64() * 1e9 / rows,
            bytes as f64 / rows
        );
    };

    let since = Instant::now();
    let recording = Recording::open(path)?;
    println!("  opened in {:.1} ms", since.elapsed().as_secs_f64() * 1e3);
    let since = Instant::now();
    for tick in recording.ticks() {
        assert_eq!(tick?.samples.len(), count);
    }
    report("read", since, path.metadata()?.len());

    let table = path.with_extension("parquet");
    let since = Instant::now();
    export_parquet(&recording, &Selection::default(), &table)?;
    report("Parquet", since, table.metadata()?.len());

    let text = path.with_extension("csv");
    let since = Instant::now();
    export_csv(
        &recording,
        &Selection::default(),
        &mut std::fs::File::create(&text)?,
    )?;
    report("CSV", since, text.metadata()?.len());
    Ok(())
}

/// A step of a random walk like a bee's: the nose and the speed change a little, the bee tilts.
fn wander(sample: &mut Sample, noise: &mut Noise) {
    let [w, x, y, z] = sample.world_from_body;
    let turned = [
        w - 0.05 * z * noise.next(),
        0.01 * noise.next(),
        0.01 * noise.next(),
        z + 0.05 * w * noise.next(),
    ];
    let norm = turned.iter().map(|q| q * q).sum::<f64>().sqrt();
    sample.world_from_body = turned.map(|q| q / norm);
    sample.rate_rad_s = [x, y, noise.next()];
    for axis in 0..3 {
        sample.velocity_m_s[axis] = 0.9 * sample.velocity_m_s[axis] + 0.1 * noise.next();
        sample.position_m[axis] += 0.1 * sample.velocity_m_s[axis];
    }
}

/// Numbers in -1 .. 1 by splitmix64.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
