//! Where vehicles were: the positions of those that are wanted, tick by tick.

use super::super::Failure;
use super::source::Source;
use simbeeotic_record::Selection;
use simbeeotic_units::did_you_mean;
use std::sync::Arc;

/// Who stayed within this distance of the start stands still, m.
const STILL_M: f32 = 0.05;

/// Vehicles and where they were.
#[derive(Clone, Debug, Default)]
pub(super) struct Flights {
    /// When, s.
    pub(super) times_s: Vec<f64>,
    pub(super) flights: Vec<Flight>,
}

/// One vehicle.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Flight {
    pub(super) path: String,
    /// Of several runs, the place of its own.
    pub(super) run: usize,
    /// When it was at its points, s.
    pub(super) times_s: Arc<[f64]>,
    /// What it counts as, if that was recorded.
    pub(super) role: String,
    /// Where it was at each time (east, north, up), m; NaN where that is not known.
    pub(super) points_m: Vec<[f32; 3]>,
}

impl Flight {
    /// Those of its points that are known, with their places in the list.
    pub(super) fn known(&self) -> impl Iterator<Item = (usize, [f64; 3])> {
        let points = self.points_m.iter().enumerate();
        points
            .map(|(at, point)| (at, point.map(f64::from)))
            .filter(|(_, point)| point.iter().all(|x| x.is_finite()))
    }

    /// Whether it never went anywhere: a hive, a beacon.
    pub(super) fn is_still(&self) -> bool {
        let mut points = self
            .points_m
            .iter()
            .filter(|p| p.iter().all(|x| x.is_finite()));
        let Some(first) = points.next() else {
            return true;
        };
        points.all(|point| (0..3).all(|k| (point[k] - first[k]).abs() <= STILL_M))
    }

    /// Whether it counts as a vehicle: a hive or a beacon does not.
    pub(super) fn is_vehicle(&self) -> bool {
        is_vehicle(&self.role, !self.is_still())
    }

    /// The group it belongs to: its path without the number at its end.
    pub(super) fn group(&self) -> &str {
        let bare = self
            .path
            .trim_end_matches(|letter: char| letter.is_ascii_digit());
        match bare.strip_suffix('-') {
            Some(group) if !group.is_empty() => group,
            _ => &self.path,
        }
    }
}

/// Whether it is a vehicle. Older recordings do not say what is a station: there it is what never moves.
pub(super) fn is_vehicle(role: &str, moved: bool) -> bool {
    match role {
        "station" => false,
        "" => moved,
        _ => true,
    }
}

impl Flights {
    /// Reads them.
    pub(super) fn read(source: &Source, patterns: &[String]) -> Result<Self, Failure> {
        let places = selected(source, patterns)?;
        let vehicles = source.recording.vehicles();
        let mut read = Self {
            times_s: Vec::new(),
            flights: places
                .iter()
                .map(|at| Flight {
                    path: vehicles[*at].path.clone(),
                    role: vehicles[*at].role.clone(),
                    ..Flight::default()
                })
                .collect(),
        };
        for tick in source.recording.ticks_in(source.times_ns.clone()) {
            let tick = tick.map_err(Failure::run)?;
            read.times_s.push(tick.time_ns as f64 * 1e-9);
            for (flight, at) in read.flights.iter_mut().zip(&places) {
                let point = tick.samples[*at].position_m;
                flight.points_m.push(point.map(|x| x as f32));
            }
        }
        if read.times_s.is_empty() {
            return Err(source.nothing(
                source.recording.ticks().next().is_some(),
                "positions",
                "nothing was recorded of where the models are",
            ));
        }
        let times_s: Arc<[f64]> = read.times_s.as_slice().into();
        for flight in &mut read.flights {
            flight.times_s = Arc::clone(&times_s);
        }
        Ok(read)
    }

    /// Leaves those out who are no vehicles, and tells who that is; if nobody is a vehicle, all stay.
    pub(super) fn vehicles_only(&mut self) -> Vec<String> {
        if !self.flights.iter().any(Flight::is_vehicle) {
            return Vec::new();
        }
        let mut left_out = Vec::new();
        self.flights.retain(|flight| {
            let counts = flight.is_vehicle();
            if !counts {
                left_out.push(flight.path.clone());
            }
            counts
        });
        left_out
    }

    /// When it begins and ends, ns.
    pub(super) fn times_ns(&self) -> [u64; 2] {
        let nanos = |time: Option<&f64>| (time.copied().unwrap_or(0.0) * 1e9).round() as u64;
        [self.times_s.first(), self.times_s.last()].map(nanos)
    }

    /// The least and the greatest coordinate along an axis; `None` if nothing is known.
    pub(super) fn span(&self, axis: usize) -> Option<[f64; 2]> {
        let mut span = None;
        for (_, point) in self.flights.iter().flat_map(Flight::known) {
            let [low, high] = span.get_or_insert([point[axis]; 2]);
            (*low, *high) = (low.min(point[axis]), high.max(point[axis]));
        }
        span
    }
}

/// The places of the vehicles that patterns take; all, if there are no patterns.
pub(super) fn selected(source: &Source, patterns: &[String]) -> Result<Vec<usize>, Failure> {
    let vehicles = source.recording.vehicles();
    if vehicles.is_empty() {
        return Err(source.nothing(false, "models with a body", "there is nobody to draw"));
    }
    for pattern in patterns {
        let one = selection(std::slice::from_ref(pattern));
        if vehicles.iter().any(|vehicle| one.takes(&vehicle.path)) {
            continue;
        }
        let paths = || vehicles.iter().map(|vehicle| vehicle.path.as_str());
        let guess = did_you_mean(pattern, paths())
            .map_or(".".to_owned(), |guess| format!("; did you mean {guess:?}?"));
        let some: Vec<&str> = paths().take(5).collect();
        let more = if vehicles.len() > 5 { " ..." } else { "" };
        return Err(Failure::input(format!(
            "--models: no path in {} matches {pattern:?}{guess} It has {} models: {}{more}",
            source.file(),
            vehicles.len(),
            some.join(", ")
        )));
    }
    let wanted = selection(patterns);
    let places = (0..vehicles.len()).filter(|at| wanted.takes(&vehicles[*at].path));
    Ok(places.collect())
}

/// Paths that match one of the patterns; all, if there are none.
pub(super) fn selection(patterns: &[String]) -> Selection {
    Selection {
        models: patterns.to_vec(),
        ..Selection::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_are_paths_without_their_numbers() {
        let group = |path: &str| {
            let flight = Flight {
                path: path.to_owned(),
                ..Flight::default()
            };
            flight.group().to_owned()
        };
        assert_eq!(group("bee-17"), "bee");
        assert_eq!(group("hive"), "hive");
        assert_eq!(group("hive/bee-3"), "hive/bee");
        assert_eq!(group("42"), "42");
        assert_eq!(group("x2"), "x2");
    }

    #[test]
    fn stations_are_no_vehicles_and_in_old_recordings_what_never_moves_is_none() {
        let counted = |role| [false, true].map(|moved| is_vehicle(role, moved));
        assert_eq!(counted("station"), [false, false]);
        assert_eq!(counted("vehicle"), [true, true]);
        assert_eq!(counted(""), [false, true]);
    }

    #[test]
    fn who_stays_is_left_out_and_named_unless_all_stay() {
        let flight = |path: &str, role: &str| Flight {
            path: path.to_owned(),
            role: role.to_owned(),
            points_m: vec![[0.0; 3]; 2],
            ..Flight::default()
        };
        let flights = |roles: &[&str]| Flights {
            flights: roles.iter().map(|role| flight(role, role)).collect(),
            ..Flights::default()
        };
        let mut both = flights(&["vehicle", "station"]);
        assert_eq!(both.vehicles_only(), ["station"]);
        assert_eq!(both.flights.len(), 1, "a vehicle that waits is one");
        let mut none = flights(&["station", "station"]);
        assert!(none.vehicles_only().is_empty() && none.flights.len() == 2);
    }

    #[test]
    fn who_does_not_move_is_still_and_who_is_nowhere_too() {
        let flight = |points: &[[f32; 3]]| Flight {
            points_m: points.to_vec(),
            ..Flight::default()
        };
        assert!(flight(&[[1.0, 2.0, 0.0], [1.0, 2.02, 0.0]]).is_still());
        assert!(!flight(&[[1.0, 2.0, 0.0], [1.0, 2.2, 0.0]]).is_still());
        assert!(flight(&[[f32::NAN; 3]]).is_still());
    }
}
