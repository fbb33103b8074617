//! The judge of the corridor: it alone knows where everybody is.

use simbeeotic::prelude::*;
use simbeeotic::units::glam::DVec2;
use std::collections::BTreeSet;

/// Watches all `corridor-bee`s, and measures what they do not know.
///
/// The middle line of the corridor is the world's places `way 0`, `way 1`, ...; the radius of each is
/// half of the width there. It publishes how many are `through`; `deviation`, the root mean square of
/// their distances from the middle line over all, as a share of the width; and `speed-wide` and
/// `speed-narrow`, their mean speed along it on stretches that are as wide as the widest, as narrow as
/// the narrowest.
#[behavior("corridor-judge", host = Bodiless)]
pub struct CorridorJudge {
    line: Vec<Station>,
    through: BTreeSet<ModelId>,
    deviation: Mean,
    wide: Mean,
    narrow: Mean,
}

/// Parameters of [`CorridorJudge`].
#[params]
pub struct CorridorJudgeParams {
    /// Time between two looks.
    pub period: Time,
}

impl Default for CorridorJudgeParams {
    fn default() -> Self {
        Self {
            period: Time::from_millis(100.0),
        }
    }
}

/// A point of the middle line.
#[derive(Clone, Copy)]
struct Station {
    at: DVec2,
    half_width_m: f64,
}

/// What is known of a place beside the middle line.
struct Beside {
    offset_m: f64,
    half_width_m: f64,
    /// The direction of the line there.
    along: DVec2,
    /// Behind its last point.
    behind: bool,
}

#[derive(Default)]
struct Mean {
    sum: f64,
    count: f64,
}

impl Mean {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1.0;
    }

    /// 0 of nothing.
    fn get(&self) -> f64 {
        self.sum / self.count.max(1.0)
    }
}

impl Behavior<Bodiless> for CorridorJudge {
    type Params = CorridorJudgeParams;

    fn build(
        params: CorridorJudgeParams,
        kit: &mut Kit<Self, Bodiless>,
    ) -> Result<Self, BuildError> {
        kit.every(params.period, Self::look);
        Ok(Self {
            line: Vec::new(),
            through: BTreeSet::new(),
            deviation: Mean::default(),
            wide: Mean::default(),
            narrow: Mean::default(),
        })
    }

    fn on_finish(&mut self, judge: &mut Cx<'_>) {
        judge.metric("through", self.through.len() as f64, "1");
        judge.metric("deviation", self.deviation.get().sqrt(), "1");
        judge.metric("speed-wide", self.wide.get(), "m/s");
        judge.metric("speed-narrow", self.narrow.get(), "m/s");
    }
}

impl CorridorJudge {
    fn look(&mut self, judge: &mut Cx<'_>) {
        if self.line.is_empty() {
            self.line = middle_line(judge);
        }
        if self.line.len() < 2 {
            return judge.fault("the world has no places `way 0`, `way 1`, ...");
        }
        let widths = self.line.iter().map(|station| station.half_width_m);
        let widest = widths.clone().fold(0.0, f64::max);
        let narrowest = widths.fold(f64::INFINITY, f64::min);
        for bee in judge.population().of_kind("corridor-bee").to_vec() {
            let (Some(pose), Some(twist)) = (judge.pose_of(bee), judge.twist_of(bee)) else {
                continue;
            };
            let there = self.beside(pose.position.si().truncate());
            if there.behind && self.through.insert(bee) {
                judge.metric("through", self.through.len() as f64, "1");
            }
            if self.through.contains(&bee) {
                continue;
            }
            let share = there.offset_m / (2.0 * there.half_width_m);
            self.deviation.add(share * share);
            let speed = twist.linear.si().truncate().dot(there.along);
            if there.half_width_m > 0.99 * widest {
                self.wide.add(speed);
            } else if there.half_width_m < 1.01 * narrowest {
                self.narrow.add(speed);
            }
        }
    }

    /// The nearest point of the middle line.
    fn beside(&self, at: DVec2) -> Beside {
        let mut best = Beside {
            offset_m: f64::INFINITY,
            half_width_m: 1.0,
            along: DVec2::X,
            behind: false,
        };
        for (index, pair) in self.line.windows(2).enumerate() {
            let (from, to) = (pair[0], pair[1]);
            let way = to.at - from.at;
            let share = (at - from.at).dot(way) / way.length_squared();
            let held = share.clamp(0.0, 1.0);
            let offset_m = at.distance(from.at + way * held);
            if offset_m < best.offset_m {
                best = Beside {
                    offset_m,
                    half_width_m: from.half_width_m + (to.half_width_m - from.half_width_m) * held,
                    along: way.normalize_or_zero(),
                    behind: index + 2 == self.line.len() && share > 1.0,
                };
            }
        }
        best
    }
}

/// `way 0`, `way 1`, ... up to the first that is missing.
fn middle_line(judge: &Cx<'_>) -> Vec<Station> {
    let place = |index: usize| {
        let place = judge.world().place(&format!("way {index}"))?;
        Some(Station {
            at: place.position.si().truncate(),
            half_width_m: place.radius.get(),
        })
    };
    (0..).map_while(place).collect()
}
