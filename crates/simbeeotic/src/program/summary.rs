//! `run --summary FILE`: the numbers of a run as a table.

use super::Failure;
use simbeeotic_model::{Consumer, ModelMetric, Simulation, Summary};
use simbeeotic_record::{Column, publish, write_table};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// What a table of a summary can be written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Parquet,
    Csv,
    Json,
}

/// A file that a summary will be written to.
#[derive(Debug)]
pub(super) struct SummaryFile {
    path: PathBuf,
    format: Format,
}

/// One row: a metric of a model, or a number of the whole run.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    /// The model's path, and the name of its part; empty: the run's.
    model: [String; 2],
    metric: String,
    unit: String,
    count: u64,
    last: f64,
    mean: f64,
    min: f64,
    max: f64,
}

impl SummaryFile {
    /// Looks at the path before the run, so that no run is in vain.
    pub(super) fn new(path: &Path) -> Result<Self, Failure> {
        let ending = path.extension().and_then(|ending| ending.to_str());
        let format = match ending {
            Some("parquet") => Format::Parquet,
            Some("csv") => Format::Csv,
            Some("json") => Format::Json,
            _ => {
                let message = "its name must end in .parquet, .csv or .json";
                return Err(failed(path, message));
            }
        };
        let folder = path
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty());
        match folder {
            Some(folder) if !folder.is_dir() => {
                let message = format!("there is no folder {}", folder.display());
                Err(failed(path, message))
            }
            _ => Ok(Self {
                path: path.to_path_buf(),
                format,
            }),
        }
    }

    /// Writes it, whole or not at all.
    pub(super) fn write(&self, simulation: &Simulation, summary: &Summary) -> Result<(), Failure> {
        let mut rows = of_run(summary);
        for line in &summary.metrics {
            let [sum, mean] = [("sum", line.sum), ("mean", line.mean)].map(|(what, value)| Row {
                metric: format!("{}/{what}", line.name),
                unit: line.unit.clone(),
                count: line.models as u64,
                ..Row::single(value)
            });
            rows.extend([sum, mean]);
        }
        rows.extend(simulation.metrics().iter().map(|m| of_model(simulation, m)));
        self.write_rows(summary, &rows)
    }

    fn write_rows(&self, summary: &Summary, rows: &[Row]) -> Result<(), Failure> {
        let path = &self.path;
        match self.format {
            Format::Parquet => write_table(path, &columns(summary, rows)).map_err(Failure::run),
            Format::Csv => publish(path, |file| csv(BufWriter::new(file), summary, rows))
                .map_err(|e| failed(path, e)),
            Format::Json => publish(path, |file| json(BufWriter::new(file), summary, rows))
                .map_err(|e| failed(path, e)),
        }
    }
}

fn failed(path: &Path, what: impl std::fmt::Display) -> Failure {
    Failure::input(format!("--summary {}: {what}", path.display()))
}

impl Row {
    /// A number that there is once.
    fn single(value: f64) -> Self {
        Self {
            model: Default::default(),
            metric: String::new(),
            unit: String::new(),
            count: 1,
            last: value,
            mean: value,
            min: value,
            max: value,
        }
    }
}

fn of_model(simulation: &Simulation, metric: &ModelMetric) -> Row {
    let member = simulation.population().get(metric.model);
    let model = member.map(|m| [m.path, m.kind].map(str::to_owned));
    let values = &metric.values;
    Row {
        model: model.unwrap_or_default(),
        metric: metric.name.to_owned(),
        unit: metric.unit.to_owned(),
        count: values.count,
        last: values.last,
        mean: values.mean(),
        min: values.min,
        max: values.max,
    }
}

/// The run's own numbers.
fn of_run(s: &Summary) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut row = |metric: &str, unit: &str, value: f64| {
        rows.push(Row {
            metric: metric.to_owned(),
            unit: unit.to_owned(),
            ..Row::single(value)
        });
    };
    row("models", "1", s.models as f64);
    row("time/virtual", "s", s.virtual_s);
    row("time/wall", "s", s.wall_s);
    row("speed", "1", s.speed);
    row("threads", "1", s.threads as f64);
    row("events", "1", s.events as f64);
    row("instants", "1", s.instants as f64);
    row("contacts", "1", s.touches as f64);
    row("packets/sent", "1", s.packets.sent as f64);
    row("packets/received", "1", s.packets.received as f64);
    for (why, lost) in &s.packets.lost {
        row(&format!("packets/lost/{why}"), "1", *lost as f64);
    }
    for consumer in Consumer::ALL {
        let Some(line) = s.charge.get(consumer.name()) else {
            continue;
        };
        let charge = format!("charge/{}", consumer.name());
        row(&charge, "mA s", line.milliampere_seconds);
        if let Some(joules) = line.joules {
            row(&format!("energy/{}", consumer.name()), "J", joules);
        }
    }
    if let Some(all) = &s.batteries {
        row("energy/spent", "J", all.spent_j);
        row("energy/charged", "J", all.charged_j);
        row("energy/heat", "J", all.heat_j);
        row("battery/soc/mean", "1", all.soc_mean);
        row("battery/soc/min", "1", all.soc_min);
        row("battery/out-of-power", "1", all.out_of_power as f64);
    }
    rows
}

/// The columns of all formats, in their order. `run` counts the runs of a sweep; here there is one.
const NAMES: [&str; 13] = [
    "run",
    "seed",
    "scenario",
    "trace_hash",
    "model",
    "kind",
    "metric",
    "unit",
    "count",
    "last",
    "mean",
    "min",
    "max",
];

fn columns(summary: &Summary, rows: &[Row]) -> Vec<Column> {
    let texts = |name: &str, of: &dyn Fn(&Row) -> String| {
        Column::texts(name, rows.iter().map(of).collect())
    };
    let floats =
        |name: &str, of: fn(&Row) -> f64| Column::floats(name, rows.iter().map(of).collect());
    let integers = |name: &str, of: &dyn Fn(&Row) -> i64| {
        Column::integers(name, rows.iter().map(of).collect())
    };
    vec![
        integers("run", &|_| 0),
        integers("seed", &|_| summary.seed.cast_signed()),
        texts("scenario", &|_| summary.scenario.clone()),
        texts("trace_hash", &|_| summary.trace_hash.clone()),
        texts("model", &|row| row.model[0].clone()),
        texts("kind", &|row| row.model[1].clone()),
        texts("metric", &|row| row.metric.clone()),
        texts("unit", &|row| row.unit.clone()),
        integers("count", &|row| row.count.cast_signed()),
        floats("last", |row| row.last),
        floats("mean", |row| row.mean),
        floats("min", |row| row.min),
        floats("max", |row| row.max),
    ]
}

fn csv(mut to: impl Write, summary: &Summary, rows: &[Row]) -> io::Result<()> {
    writeln!(to, "{}", NAMES.join(","))?;
    let run = [
        "0".to_owned(),
        summary.seed.cast_signed().to_string(),
        quoted(&summary.scenario),
        quoted(&summary.trace_hash),
    ];
    let run = run.join(",");
    for row in rows {
        let [path, kind] = &row.model;
        let texts = [path, kind, &row.metric, &row.unit].map(|text| quoted(text));
        let numbers = [row.last, row.mean, row.min, row.max].map(|value| value.to_string());
        let (texts, numbers) = (texts.join(","), numbers.join(","));
        writeln!(to, "{run},{texts},{},{numbers}", row.count)?;
    }
    to.flush()
}

/// A text as a field of CSV (RFC 4180).
fn quoted(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

/// A list of objects, one a row. What is no finite number is `null`.
fn json(mut to: impl Write, summary: &Summary, rows: &[Row]) -> io::Result<()> {
    let rows = rows.iter().map(|row| {
        serde_json::json!({
            "run": 0,
            "seed": summary.seed.cast_signed(),
            "scenario": summary.scenario,
            "trace_hash": summary.trace_hash,
            "model": row.model[0],
            "kind": row.model[1],
            "metric": row.metric,
            "unit": row.unit,
            "count": row.count,
            "last": row.last,
            "mean": row.mean,
            "min": row.min,
            "max": row.max,
        })
    });
    serde_json::to_writer_pretty(&mut to, &rows.collect::<Vec<_>>())?;
    writeln!(to)?;
    to.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_says_by_its_ending_what_it_is() {
        for (name, format) in [
            ("a.parquet", Format::Parquet),
            ("a.b.csv", Format::Csv),
            ("a.json", Format::Json),
        ] {
            let file = SummaryFile::new(Path::new(name)).ok();
            assert_eq!(file.map(|file| file.format), Some(format));
        }
        for name in ["a", "a.txt", ".csv", "there/is/no/such/folder/a.csv"] {
            assert!(SummaryFile::new(Path::new(name)).is_err(), "{name}");
        }
    }

    #[test]
    fn fields_with_commas_and_quotes_are_quoted() {
        let row = Row {
            model: ["a,b".to_owned(), "say \"bee\"".to_owned()],
            metric: "height".to_owned(),
            unit: "m".to_owned(),
            ..Row::single(0.5)
        };
        let summary = Summary {
            scenario: "one".to_owned(),
            seed: u64::MAX,
            trace_hash: "0f".to_owned(),
            ..Summary::default()
        };
        let mut text = Vec::new();
        csv(&mut text, &summary, &[row]).expect("memory");
        let text = String::from_utf8(text).expect("text");
        let (_, line) = text.split_once('\n').expect("two lines");
        assert_eq!(
            line,
            "0,-1,one,0f,\"a,b\",\"say \"\"bee\"\"\",height,m,1,0.5,0.5,0.5,0.5\n"
        );
        assert_eq!(text.lines().next().map(|l| l.split(',').count()), Some(13));
    }

    #[test]
    fn the_columns_of_a_table_have_the_names_of_the_others() {
        let columns = columns(&Summary::default(), &[]);
        let names: Vec<&str> = columns.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, NAMES);
    }
}
