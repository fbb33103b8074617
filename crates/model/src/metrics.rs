//! Numbers that models publish ([`Cx::metric`](crate::Cx::metric)), summed up for the summary.
//!
//! What is kept is small and made while the run goes on, whether somebody watches or not: of each model and
//! name how many values there were, the last, the least, the greatest and their sum. Nothing of it reaches
//! the trace.

use crate::summary::MetricLine;
use simbeeotic_kernel::ModelId;
use std::collections::BTreeMap;

/// The values of one name that one model has published. Those that are not numbers (NaN) do not count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tally {
    /// How many.
    pub count: u64,
    /// The last.
    pub last: f64,
    /// The least.
    pub min: f64,
    /// The greatest.
    pub max: f64,
    /// All together.
    pub sum: f64,
}

impl Tally {
    const NONE: Self = Self {
        count: 0,
        last: f64::NAN,
        min: f64::INFINITY,
        max: f64::NEG_INFINITY,
        sum: 0.0,
    };

    /// Their mean.
    pub fn mean(&self) -> f64 {
        self.sum / self.count as f64
    }

    fn add(&mut self, value: f64) {
        self.count += 1;
        self.last = value;
        self.min = self.min.min(value);
        self.max = self.max.max(value);
        self.sum += value;
    }
}

/// What one model has published under one name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelMetric {
    /// The model.
    pub model: ModelId,
    /// The name.
    pub name: &'static str,
    /// What it is counted in.
    pub unit: &'static str,
    /// The values.
    pub values: Tally,
}

/// All metrics of a run.
#[derive(Debug, Default)]
pub(crate) struct Metrics(BTreeMap<Metric, Tallies>);

/// What is counted. The same name in another unit is another metric.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Metric {
    name: &'static str,
    unit: &'static str,
}

/// The values of one metric, by model, up to the last model that has published.
#[derive(Debug, Default)]
struct Tallies(Vec<Tally>);

impl Metrics {
    pub(crate) fn add(
        &mut self,
        model: ModelId,
        name: &'static str,
        value: f64,
        unit: &'static str,
    ) {
        if !value.is_nan() {
            let tallies = self.0.entry(Metric { name, unit }).or_default();
            tallies.of(model).add(value);
        }
    }

    /// What each model has published, by name, then by model.
    pub(crate) fn by_model(&self) -> Vec<ModelMetric> {
        let all = self.0.iter().flat_map(|(&Metric { name, unit }, tallies)| {
            tallies.published().map(move |(model, values)| ModelMetric {
                model,
                name,
                unit,
                values,
            })
        });
        all.collect()
    }

    /// What all models have published, by name.
    pub(crate) fn lines(&self) -> Vec<MetricLine> {
        let all = self.0.iter();
        all.map(|(&metric, tallies)| tallies.line(metric)).collect()
    }
}

impl Tallies {
    fn of(&mut self, model: ModelId) -> &mut Tally {
        let Self(tallies) = self;
        if tallies.len() <= model.index() {
            tallies.resize(model.index() + 1, Tally::NONE);
        }
        &mut tallies[model.index()]
    }

    fn published(&self) -> impl Iterator<Item = (ModelId, Tally)> {
        let all = self.0.iter().enumerate();
        all.filter(|(_, tally)| tally.count > 0)
            .map(|(model, tally)| (ModelId(model as u32), *tally))
    }

    fn line(&self, Metric { name, unit }: Metric) -> MetricLine {
        let mut line = MetricLine {
            name: name.to_owned(),
            unit: unit.to_owned(),
            models: 0,
            count: 0,
            sum: 0.0,
            mean: 0.0,
            min: f64::INFINITY,
            max: f64::NEG_INFINITY,
        };
        for (_, tally) in self.published() {
            line.models += 1;
            line.count += tally.count;
            line.sum += tally.last;
            line.min = line.min.min(tally.last);
            line.max = line.max.max(tally.last);
        }
        line.mean = line.sum / line.models as f64;
        line
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn last_values_are_summed_over_models_and_all_values_within_one() {
        let mut metrics = Metrics::default();
        assert!(metrics.lines().is_empty());
        for (model, name, value, unit) in [
            (2, "pollen", 5.0, "1"),
            (0, "pollen", 1.0, "1"),
            (2, "height", 3.0, "m"),
            (2, "pollen", f64::NAN, "1"),
            (2, "pollen", 3.0, "1"),
            (1, "height", 7.0, "ft"),
        ] {
            metrics.add(ModelId(model), name, value, unit);
        }
        let names: Vec<_> = (metrics.by_model().iter())
            .map(|m| (m.name, m.unit, m.model.0))
            .collect();
        assert_eq!(
            names,
            [
                ("height", "ft", 1),
                ("height", "m", 2),
                ("pollen", "1", 0),
                ("pollen", "1", 2)
            ]
        );
        let two = metrics.by_model()[3].values;
        assert_eq!((two.count, two.last, two.mean()), (2, 3.0, 4.0));
        assert_eq!((two.min, two.max), (3.0, 5.0));
        let pollen = &metrics.lines()[2];
        assert_eq!((pollen.models, pollen.count), (2, 3));
        assert_eq!((pollen.sum, pollen.mean), (4.0, 2.0));
        assert_eq!((pollen.min, pollen.max), (1.0, 3.0));
    }
}
