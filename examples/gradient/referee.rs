//! A referee: it sees where the bees truly are, and measures.

use super::paths::Paths;
use simbeeotic::prelude::*;

/// Sees where bees truly are, counts their trips and measures how far off their path they fly. It takes no
/// part in the flight.
///
/// A trip is out to the end of a path and back to the hive, both within `reach`. At each of its looks it
/// publishes, over all bees and since the start: `trips`; `trips/least`, those by the path that was taken
/// least; `trip/time`, the mean time of a trip, from when the bee was last seen near the hive before it reached
/// the path's end until it is there again; `deviation` and `deviation/max`, the mean and the greatest
/// distance to the nearest path; `lost`, the share of time outside of the field. `deviation/now` and
/// `lost/now` are the means over the bees at this instant.
#[behavior("gradient-referee", host = Bodiless)]
pub struct GradientReferee {
    params: GradientRefereeParams,
    paths: Paths,
    flights: Vec<Flight>,
    trips: Vec<u32>,
    trip_time: Time,
    looks: u32,
    deviation: [f64; 2],
    lost: f64,
}

/// Parameters of [`GradientReferee`].
#[params]
pub struct GradientRefereeParams {
    /// The same paths as the beacons have.
    pub paths: Vec<String>,
    /// Whom it watches: models of this kind.
    pub kind: String,
    /// How near the hive, or a path's end, counts as there. Above 0 m.
    pub reach: Length,
    /// Side of the field, a square around the first path's beginning. Above 0 m.
    pub side: Length,
    /// Time between two looks.
    pub period: Time,
}

impl Default for GradientRefereeParams {
    fn default() -> Self {
        Self {
            paths: vec!["0 m, 0 m; 50 m, 0 m".to_owned()],
            kind: "gradient-bee".to_owned(),
            reach: Length::si(10.0),
            side: Length::si(120.0),
            period: Time::from_millis(500.0),
        }
    }
}

/// What a bee has done since it was last in the hive.
struct Flight {
    bee: ModelId,
    /// When it was last seen near the hive; before that, the start.
    left: SimTime,
    /// The path whose end it has reached since then.
    reached: Option<usize>,
}

impl Flight {
    fn new(bee: ModelId) -> Self {
        Self {
            bee,
            left: SimTime::ZERO,
            reached: None,
        }
    }

    /// Takes in whether the bee is near the hive, and near the end of which path. A trip that ends now: by
    /// which path, and how long it took.
    fn see(&mut self, home: bool, end: Option<usize>, now: SimTime) -> Option<(usize, Time)> {
        if !home {
            self.reached = self.reached.or(end);
            return None;
        }
        let time = now - self.left;
        self.left = now;
        self.reached.take().map(|path| (path, time))
    }
}

impl Behavior<Bodiless> for GradientReferee {
    type Params = GradientRefereeParams;

    fn build(
        params: GradientRefereeParams,
        kit: &mut Kit<Self, Bodiless>,
    ) -> Result<Self, BuildError> {
        positive("reach", params.reach)?;
        positive("side", params.side)?;
        positive("period", params.period)?;
        let paths = Paths::read("paths", &params.paths)?;
        kit.once(Time::ZERO, Self::gather);
        kit.every_from(params.period, params.period, Self::look);
        Ok(Self {
            trips: vec![0; paths.ends().count()],
            paths,
            flights: Vec::new(),
            trip_time: Time::ZERO,
            looks: 0,
            deviation: [0.0; 2],
            lost: 0.0,
            params,
        })
    }
}

impl GradientReferee {
    /// Finds the bees.
    fn gather(&mut self, cx: &mut Cx<'_>) {
        self.flights = cx
            .population()
            .of_kind(&self.params.kind)
            .iter()
            .map(|bee| Flight::new(*bee))
            .collect();
        if self.flights.is_empty() {
            cx.fault(format!("there is no `{}` to watch", self.params.kind));
        }
    }

    fn look(&mut self, cx: &mut Cx<'_>) {
        let (mut off, mut lost) = (0.0, 0.0);
        for at in 0..self.flights.len() {
            let Some(pose) = cx.pose_of(self.flights[at].bee) else {
                continue;
            };
            let beside = self.paths.beside(pose.position);
            off += beside.across.metres();
            self.deviation[1] = self.deviation[1].max(beside.across.metres());
            lost += f64::from(u8::from(self.is_outside(pose.position)));
            self.follow(at, pose.position, cx.now());
        }
        let bees = self.flights.len() as f64;
        self.looks += 1;
        self.deviation[0] += off / bees;
        self.lost += lost / bees;
        let trips: u32 = self.trips.iter().sum();
        let least = self.trips.iter().min().copied().unwrap_or(0);
        let looks = f64::from(self.looks);
        cx.metric("trips", f64::from(trips), "1");
        cx.metric("trips/least", f64::from(least), "1");
        if trips > 0 {
            cx.metric("trip/time", self.trip_time.secs() / f64::from(trips), "s");
        }
        cx.metric("deviation/now", off / bees, "m");
        cx.metric("deviation", self.deviation[0] / looks, "m");
        cx.metric("deviation/max", self.deviation[1], "m");
        cx.metric("lost/now", lost / bees, "1");
        cx.metric("lost", self.lost / looks, "1");
    }

    /// Keeps the books of one bee's trips.
    fn follow(&mut self, at: usize, place: Position, now: SimTime) {
        let near = |goal: Position| {
            let way = (place - goal).si();
            way.truncate().length() <= self.params.reach.metres()
        };
        let (home, end) = (near(self.paths.hive()), self.paths.ends().position(near));
        if let Some((path, time)) = self.flights[at].see(home, end, now) {
            self.trips[path] += 1;
            self.trip_time += time;
        }
    }

    fn is_outside(&self, place: Position) -> bool {
        let way = (place - self.paths.hive()).si();
        way.x.abs().max(way.y.abs()) > 0.5 * self.params.side.metres()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The trips of a bee seen at these seconds: whether near the hive, and near which path's end.
    fn trips(seen: &[(f64, bool, Option<usize>)]) -> Vec<(usize, f64)> {
        let mut flight = Flight::new(ModelId(1));
        let see = |&(at_s, home, end): &(f64, bool, Option<usize>)| {
            let now = SimTime::from_time(Time::si(at_s)).expect("a time");
            let (path, time) = flight.see(home, end, now)?;
            Some((path, time.secs()))
        };
        seen.iter().filter_map(see).collect()
    }

    #[test]
    fn time_in_the_hive_is_no_part_of_a_trip() {
        let seen = [
            (0.0, true, None),
            (60.0, true, None),
            (61.0, false, None),
            (100.0, false, Some(1)),
            (150.0, true, None),
            (250.0, true, None),
            (290.0, false, Some(0)),
            (330.0, true, None),
        ];
        assert_eq!(trips(&seen), [(1, 90.0), (0, 80.0)]);
    }

    #[test]
    fn an_excursion_that_turned_back_early_is_no_trip_and_adds_no_time() {
        let seen = [
            (0.0, true, None),
            (40.0, false, None),
            (80.0, true, None),
            (120.0, false, Some(0)),
            (125.0, false, Some(1)),
            (160.0, true, None),
        ];
        assert_eq!(trips(&seen), [(0, 80.0)]);
    }
}
