//! `run --summary FILE`: the numbers of a run as a table.

use super::Failure;
use super::table::TableFile;
use simbeeotic_model::{Consumer, ModelMetric, Simulation, Summary};
use simbeeotic_record::Column;
use std::path::Path;

/// A file that a summary will be written to.
#[derive(Debug)]
pub(super) struct SummaryFile(TableFile);

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
        TableFile::new("--summary", path).map(Self)
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
        self.0.write(&columns(summary, &rows))
    }
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

/// The columns. `run` counts the runs of a sweep; here there is one.
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

#[cfg(test)]
mod tests {
    use super::super::table::csv;
    use super::*;

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
        csv(&mut text, &columns(&summary, &[row])).expect("memory");
        let text = String::from_utf8(text).expect("text");
        let (_, line) = text.split_once('\n').expect("two lines");
        assert_eq!(
            line,
            "0,-1,one,0f,\"a,b\",\"say \"\"bee\"\"\",height,m,1,0.5,0.5,0.5,0.5\n"
        );
        assert_eq!(text.lines().next().map(|l| l.split(',').count()), Some(13));
    }
}
