//! The referee: what the swarm did, as truth. Nobody of the swarm hears of it.

use super::cells::Cells;
use simbeeotic::prelude::*;
use simbeeotic::units::glam::{DVec2, DVec3};
use simbeeotic::world::{ObjectId, ObjectKind};
use std::collections::{BTreeMap, BTreeSet};

/// Watches the swarm and publishes what it achieved.
///
/// | metric | what |
/// |---|---|
/// | `coverage` | share of cells of which three quarters or more were within a flower detector's reach |
/// | `flowers/seen` | flowers that a detector of a MAV has noticed |
/// | `flowers/served` | flowers beside which a MAV stayed for the time `stay` |
/// | `energy/flower` | J that the MAVs' batteries gave, for each flower served |
/// | `energy/used` | the same in all: what reached motors, radios and sensors, without the heat in the cells |
/// | `energy/beacons` | J that beacons on the ground have drawn, in neither of the two above |
/// | `lost` | MAVs that have lain elsewhere than on pads for half a minute, on whatever is there |
/// | `idleness` | mean time for which a MAV lay charged and got nothing to do, s |
/// | `waiting` | mean time for which a MAV lay on a pad without power, not charged, s |
#[behavior("search-referee", host = Bodiless)]
pub struct SearchReferee {
    params: SearchRefereeParams,
    /// The parts of cells that are told apart.
    fine: Cells,
    cells: Cells,
    seen_parts: Vec<bool>,
    /// Parts seen of each cell.
    parts: Vec<u8>,
    searched: usize,
    seen: BTreeSet<ObjectId>,
    served: BTreeSet<ObjectId>,
    /// Who stays beside which flowers, for how many looks.
    stays: BTreeMap<ModelId, Vec<(ObjectId, u32)>>,
    down: BTreeMap<ModelId, u32>,
    books: BTreeMap<ModelId, Books>,
    /// J that each beacon has drawn.
    beacons: BTreeMap<ModelId, f64>,
}

/// Parameters of [`SearchReferee`].
#[params]
pub struct SearchRefereeParams {
    /// Edge of the square around the origin whose coverage is told.
    pub field: Length,
    /// Edge of a cell.
    pub cell: Length,
    /// How far to each side a detector sees the ground, from the height of a search; at most `field`.
    pub swath: Length,
    /// A MAV searches no higher than this.
    pub ceiling: Length,
    /// So near a flower, from middle to its parts, it is served.
    pub reach: Length,
    /// For so long.
    pub stay: Time,
    /// So near the middle of a hive a MAV may lie: where its pads are (`pad_radius`).
    pub home: Length,
    /// Time between two looks.
    pub period: Time,
}

impl Default for SearchRefereeParams {
    fn default() -> Self {
        Self {
            field: Length::si(200.0),
            cell: Length::si(10.0),
            swath: Length::si(2.9),
            ceiling: Length::si(5.0),
            reach: Length::si(0.5),
            stay: Time::si(2.0),
            home: Length::si(4.0),
            period: Time::si(0.5),
        }
    }
}

/// What a MAV's own instruments say, for the books: told to the referee alone.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Books {
    pub(crate) energy_j: f64,
    pub(crate) idle_s: f64,
    pub(crate) waiting_s: f64,
}

/// What a beacon has drawn, for the books: told to the referee alone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BeaconBooks {
    pub(crate) energy_j: f64,
}

/// Flowers that a detector has noticed.
#[derive(Clone, Debug)]
pub(crate) struct Noticed(pub(crate) Vec<ObjectId>);

/// Parts along the edge of a cell.
const PARTS: u32 = 4;
/// So many parts of a cell are a cell.
const ENOUGH: u8 = 12;
/// Slower than this, for so long: it is not coming back.
const REST_M_S: f64 = 0.02;
const DOWN_S: f64 = 30.0;
/// No flower is higher than this, with the reach.
const LOW_M: f64 = 1.5;

impl Behavior<Bodiless> for SearchReferee {
    type Params = SearchRefereeParams;

    fn build(
        params: SearchRefereeParams,
        kit: &mut Kit<Self, Bodiless>,
    ) -> Result<Self, BuildError> {
        positive("field", params.field)?;
        positive("cell", params.cell)?;
        positive("swath", params.swath)?;
        in_range("swath", params.swath, Length::si(0.0)..=params.field)?;
        positive("ceiling", params.ceiling)?;
        positive("reach", params.reach)?;
        positive("stay", params.stay)?;
        positive("home", params.home)?;
        positive("period", params.period)?;
        kit.every(params.period, Self::watch);
        kit.every(Time::si(10.0), Self::publish);
        Ok(Self::new(params))
    }

    fn on_message(&mut self, message: &Message, _: &mut Cx<'_>) {
        if let Some(Noticed(flowers)) = message.get() {
            self.seen.extend(flowers);
        } else if let Some(books) = message.get::<Books>() {
            self.books.insert(message.sender, *books);
        } else if let Some(BeaconBooks { energy_j }) = message.get() {
            self.beacons.insert(message.sender, *energy_j);
        }
    }

    fn on_finish(&mut self, cx: &mut Cx<'_>) {
        self.publish(cx);
    }
}

impl SearchReferee {
    fn new(params: SearchRefereeParams) -> Self {
        let cells = Cells::around(DVec2::ZERO, params.field.metres(), params.cell.metres());
        let fine = cells.finer(PARTS);
        Self {
            params,
            seen_parts: vec![false; fine.count()],
            parts: vec![0; cells.count()],
            fine,
            cells,
            searched: 0,
            seen: BTreeSet::new(),
            served: BTreeSet::new(),
            stays: BTreeMap::new(),
            down: BTreeMap::new(),
            books: BTreeMap::new(),
            beacons: BTreeMap::new(),
        }
    }

    fn watch(&mut self, cx: &mut Cx<'_>) {
        let mavs = cx.population().of_kind("search-mav").to_vec();
        let hives = cx.population().of_kind("search-hive").iter();
        let hives: Vec<DVec2> = hives
            .filter_map(|id| Some(cx.pose_of(*id)?.position.si().truncate()))
            .collect();
        for id in mavs {
            let (Some(pose), Some(twist)) = (cx.pose_of(id), cx.twist_of(id)) else {
                continue;
            };
            let (place, speed_m_s) = (pose.position.si(), twist.linear.si().length());
            self.look_down(place);
            self.mind(id, place, speed_m_s, &hives);
            let beside = if place.z < LOW_M && speed_m_s > 1e-6 {
                self.beside(pose, cx)
            } else {
                BTreeSet::new()
            };
            self.attend(id, &beside);
        }
    }

    /// Marks what a MAV at this place can see of the ground.
    fn look_down(&mut self, place: DVec3) {
        if place.z > self.params.ceiling.metres() || place.z < LOW_M {
            return;
        }
        let (at, swath_m) = (place.truncate(), self.params.swath.metres());
        let size_m = self.fine.size_m();
        let reach = (swath_m / size_m).ceil() as i32;
        for step in (-reach..=reach).flat_map(|y| (-reach..=reach).map(move |x| (x, y))) {
            let near = at + DVec2::new(f64::from(step.0), f64::from(step.1)) * size_m;
            let Some(part) = self.fine.index_at(near) else {
                continue;
            };
            let middle = self.fine.middle_of(part);
            if self.seen_parts[part] || middle.distance(at) > swath_m {
                continue;
            }
            self.seen_parts[part] = true;
            if let Some(cell) = self.cells.index_at(middle) {
                self.parts[cell] += 1;
                self.searched += usize::from(self.parts[cell] == ENOUGH);
            }
        }
    }

    /// Counts for how long one lies where it should not.
    fn mind(&mut self, id: ModelId, place: DVec3, speed_m_s: f64, hives: &[DVec2]) {
        let home_m = self.params.home.metres();
        let away = |hive: &DVec2| hive.distance(place.truncate()) > home_m;
        if speed_m_s < REST_M_S && hives.iter().all(away) {
            *self.down.entry(id).or_default() += 1;
        } else {
            self.down.remove(&id);
        }
    }

    /// How many have lain where they should not for too long.
    fn lost(&self) -> usize {
        let down_for = (DOWN_S / self.params.period.get()) as u32;
        let down = self.down.values();
        down.filter(|looks| **looks >= down_for).count()
    }

    /// The flowers beside a MAV.
    fn beside(&self, pose: Pose, cx: &mut Cx<'_>) -> BTreeSet<ObjectId> {
        let ball = Shape::Sphere {
            radius_m: self.params.reach.metres(),
        };
        cx.overlapping(&ball, pose)
            .into_iter()
            .filter_map(Thing::object)
            .filter(|object| object.kind == ObjectKind::Flower)
            .collect()
    }

    /// Counts for how long a MAV stays beside flowers, and which it has served.
    fn attend(&mut self, id: ModelId, beside: &BTreeSet<ObjectId>) {
        let before = self.stays.remove(&id).unwrap_or_default();
        let looks = |object: &ObjectId| {
            let known = before.iter().find(|(at, _)| at == object);
            known.map_or(1, |(_, looks)| looks + 1)
        };
        let stays: Vec<(ObjectId, u32)> = beside.iter().map(|o| (*o, looks(o))).collect();
        let enough = (self.params.stay.get() / self.params.period.get()).ceil() as u32 + 1;
        let served = stays.iter().filter(|(_, looks)| *looks >= enough);
        self.served.extend(served.map(|(object, _)| *object));
        if !stays.is_empty() {
            self.stays.insert(id, stays);
        }
    }

    fn publish(&mut self, cx: &mut Cx<'_>) {
        let energy_j: f64 = self.books.values().map(|books| books.energy_j).sum();
        let idle_s: f64 = self.books.values().map(|books| books.idle_s).sum();
        let served = self.served.len() as f64;
        cx.metric(
            "coverage",
            self.searched as f64 / self.cells.count() as f64,
            "1",
        );
        cx.metric("flowers/seen", self.seen.len() as f64, "1");
        cx.metric("flowers/served", served, "1");
        cx.metric("lost", self.lost() as f64, "1");
        cx.metric("idleness", idle_s / self.books.len().max(1) as f64, "s");
        let waiting_s: f64 = self.books.values().map(|books| books.waiting_s).sum();
        let mavs = self.books.len().max(1) as f64;
        cx.metric("waiting", waiting_s / mavs, "s");
        cx.metric("energy/used", energy_j, "J");
        let beacons_j: f64 = self.beacons.values().sum();
        cx.metric("energy/beacons", beacons_j, "J");
        if served > 0.0 {
            cx.metric("energy/flower", energy_j / served, "J");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MAV: ModelId = ModelId(7);

    /// A field of four cells of 10 m, each of sixteen parts.
    fn referee() -> SearchReferee {
        SearchReferee::new(SearchRefereeParams {
            field: Length::si(20.0),
            swath: Length::si(2.0),
            ..SearchRefereeParams::default()
        })
    }

    #[test]
    fn a_cell_is_searched_once_three_quarters_of_its_parts_were_seen_from_low_enough() {
        let mut referee = referee();
        let parts = |columns: std::ops::Range<u32>| {
            let middle = |n: u32| 1.25 + 2.5 * f64::from(n);
            columns.flat_map(move |x| (0..4).map(move |y| DVec2::new(middle(x), middle(y))))
        };
        // Three of its four columns, but for the last part: too high, too low, and as searches are flown.
        for up_m in [5.1, 1.4, 5.0] {
            for part in parts(0..3).take(11) {
                referee.look_down(part.extend(up_m));
            }
            assert_eq!(referee.searched, 0, "{up_m} m up");
        }
        assert_eq!(referee.parts.iter().sum::<u8>(), 11);
        // What was seen before counts once.
        referee.look_down(DVec3::new(1.25, 1.25, 4.0));
        assert_eq!(referee.searched, 0);
        referee.look_down(parts(0..3).last().expect("twelve").extend(4.0));
        assert_eq!(referee.searched, 1);
        for part in parts(0..4) {
            referee.look_down(part.extend(4.0));
        }
        assert_eq!(referee.searched, 1, "a cell counts once");
        assert_eq!(referee.parts.iter().sum::<u8>(), 16, "one cell of four");
    }

    #[test]
    fn who_lies_half_a_minute_away_from_all_pads_is_lost_until_it_moves() {
        let mut referee = referee();
        let hives = [DVec2::ZERO, DVec2::new(50.0, 0.0)];
        let looks = |referee: &mut SearchReferee, count: u32, east_m: f64, speed_m_s: f64| {
            for _ in 0..count {
                referee.mind(MAV, DVec3::X * east_m, speed_m_s, &hives);
            }
            referee.lost()
        };
        assert_eq!(looks(&mut referee, 100, 3.9, 0.0), 0, "on a pad");
        assert_eq!(looks(&mut referee, 100, 46.1, 0.0), 0, "of another hive");
        assert_eq!(looks(&mut referee, 59, 25.0, 0.01), 0);
        assert_eq!(looks(&mut referee, 1, 25.0, 0.01), 1);
        assert_eq!(looks(&mut referee, 1, 25.0, 0.03), 0, "it moves");
        assert_eq!(looks(&mut referee, 59, 25.0, 0.0), 0, "counted anew");
    }

    #[test]
    fn a_flower_is_served_by_one_that_stays_beside_it_without_a_break() {
        let mut referee = referee();
        let flower = |item| ObjectId {
            item,
            ..ObjectId::new(ObjectKind::Flower, 0)
        };
        let beside = |items: &[u32]| items.iter().map(|item| flower(*item)).collect();
        // Two seconds are four periods, from the first of five looks to the last.
        for items in [&[1, 2][..], &[1, 2], &[1], &[1, 2]] {
            referee.attend(MAV, &beside(items));
        }
        assert!(referee.served.is_empty());
        // Another that comes by does not go on where the first is.
        referee.attend(ModelId(8), &beside(&[1]));
        assert!(referee.served.is_empty());
        referee.attend(MAV, &beside(&[1, 2]));
        assert_eq!(referee.served, beside(&[1]));
        referee.attend(MAV, &beside(&[]));
        assert_eq!(referee.served, beside(&[1]), "once served, for ever");
        assert!(!referee.stays.contains_key(&MAV));
    }
}
