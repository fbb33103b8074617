//! The hive: a box and pads with chargers, a radio, and in the central scheme a planner.

use super::cells::Cells;
use super::landing::{Briefing, Order, Ready, Received, Report};
use super::planner::{Finding, Planner, PlannerParams};
use super::scheme::Scheme;
use super::wire::{Task, Word};
use simbeeotic::models::dock::{Dock, DockParams};
use simbeeotic::prelude::*;
use simbeeotic::units::glam::{DVec2, DVec3};
use std::collections::{BTreeMap, BTreeSet};

/// A box with pads on the ground around it, on which its MAVs land, are charged, hand in what they found and
/// are sent out again.
///
/// MAVs nested in it are put on their pads before the run begins. What it knows of the field comes from
/// reports at landing, of those alone who rest on its pads, and from packets.
///
/// It publishes `known` (share of cells that it was told to be searched), `docked`, `aloft` (MAVs heard of by
/// radio in the last half minute), `dispatches`, `refused` (words of those who do not rest here).
#[behavior("search-hive", host = Station)]
pub struct SearchHive {
    params: SearchHiveParams,
    radio: Option<RadioHandle>,
    dock: Dock,
    crew: BTreeMap<ModelId, u32>,
    /// What it works with, once it knows where it stands.
    desk: Option<Desk>,
    /// Cells that were reported as searched.
    searched: BTreeSet<u16>,
    /// Words of those who do not rest here.
    refused: u64,
    /// When it heard of each by radio last.
    heard: BTreeMap<ModelId, SimTime>,
    dispatches: u64,
}

struct Desk {
    home: DVec2,
    cells: Cells,
    planner: Option<Planner>,
}

/// Parameters of [`SearchHive`].
#[params]
pub struct SearchHiveParams {
    /// Who decides where MAVs go.
    pub scheme: Scheme,
    /// Edge of the square field around the hive that its MAVs search.
    pub field: Length,
    /// Edge of a cell of it. At most 255 by 255 cells are made.
    pub cell: Length,
    /// The box, and the charger: `pad_radius` is how far from its middle there are pads.
    pub dock: DockParams,
    /// Distance of two pads. Each MAV has one of its own, and `dock.pads` of them have power at a time.
    pub spot: Length,
    /// What the planner believes, in the central scheme.
    pub planner: PlannerParams,
}

impl Default for SearchHiveParams {
    fn default() -> Self {
        Self {
            scheme: Scheme::Central,
            field: Length::si(200.0),
            cell: Length::si(10.0),
            dock: DockParams {
                width: Length::si(1.0),
                height: Length::si(0.8),
                pads: 25,
                pad_radius: Length::si(4.0),
                current: Current::si(2.5),
                period: Time::si(1.0),
            },
            spot: Length::si(0.5),
            planner: PlannerParams::default(),
        }
    }
}

/// Who was heard of by radio in this time is aloft, as far as the hive knows, s.
const LATELY_S: f64 = 30.0;

impl Behavior<Station> for SearchHive {
    type Params = SearchHiveParams;

    fn build(params: SearchHiveParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        positive("field", params.field)?;
        positive("cell", params.cell)?;
        positive("spot", params.spot)?;
        params.planner.check()?;
        let dock = Dock::new(params.dock.clone())?;
        kit.every(params.dock.period, Self::look);
        kit.every(Time::si(10.0), Self::publish);
        Ok(Self {
            radio: kit.optional_radio(),
            params,
            dock,
            crew: BTreeMap::new(),
            desk: None,
            searched: BTreeSet::new(),
            refused: 0,
            heard: BTreeMap::new(),
            dispatches: 0,
        })
    }

    fn body(params: &SearchHiveParams) -> Option<BodySpec> {
        Some(params.dock.body())
    }

    fn on_message(&mut self, message: &Message, hive: &mut Platform<'_>) {
        if self.dock.heard(message) {
            return;
        }
        if !self.dock.holds(message.sender) {
            self.refused += 1;
            return;
        }
        if let Some(Report(findings)) = message.get() {
            findings.iter().for_each(|finding| self.learn(finding));
            hive.tell(message.sender, Received);
        } else if message.get::<Ready>().is_some()
            && let Some(planner) = self.planner()
            && let Some(job) = planner.dispatch(None, hive.now())
        {
            self.dispatches += 1;
            hive.tell(message.sender, Order(job));
        }
    }

    fn on_packet(&mut self, packet: &Packet<'_>, hive: &mut Platform<'_>) {
        let Some(home) = self.desk.as_ref().map(|desk| desk.home) else {
            return;
        };
        let (Some(radio), Some(word)) = (self.radio, Word::decode(packet.payload(), home)) else {
            return;
        };
        if !self.crew.contains_key(&packet.sender()) {
            return;
        }
        let now = hive.now();
        self.heard.insert(packet.sender(), now);
        match word {
            Word::Done {
                ticket,
                cell,
                count,
                task,
            } => {
                self.learn(&Finding {
                    ticket,
                    task,
                    cell,
                    complete: true,
                    count: u16::from(count),
                    places: Vec::new(),
                });
                let Some(planner) = self.planner() else {
                    return;
                };
                let answer = match planner.dispatch(Some(cell), now) {
                    Some(job) => Word::Next(job),
                    None => Word::ComeHome,
                };
                self.dispatches += u64::from(answer != Word::ComeHome);
                hive.send_to(radio, packet.sender(), &answer.encode(home));
            }
            Word::Homeward { ticket } => {
                if let Some(planner) = self.planner() {
                    planner.returned(ticket);
                }
            }
            _ => {}
        }
    }
}

impl SearchHive {
    fn planner(&mut self) -> Option<&mut Planner> {
        self.desk.as_mut()?.planner.as_mut()
    }

    /// Takes a result in.
    fn learn(&mut self, finding: &Finding) {
        if finding.complete || finding.task != Task::Search {
            self.searched.insert(finding.cell);
        }
        if let Some(planner) = self.planner() {
            planner.result(finding);
        }
    }

    /// Once a period: who is here, who is new.
    fn look(&mut self, hive: &mut Platform<'_>) {
        self.dock.look(hive);
        let pads = hive.position().si().truncate().extend(0.0);
        if self.desk.is_none() {
            let home = pads.truncate();
            let (field, cell) = (self.params.field.metres(), self.params.cell.metres());
            let cells = Cells::around(home, field, cell);
            let central = self.params.scheme == Scheme::Central;
            let planner = || Planner::new(self.params.planner.clone(), cells, home);
            self.desk = Some(Desk {
                home,
                cells,
                planner: central.then(planner),
            });
        }
        let guests = self.dock.guests().map(|(id, _)| id);
        let new: Vec<ModelId> = guests.filter(|id| !self.crew.contains_key(id)).collect();
        if !new.is_empty() {
            self.brief(&new, pads, hive);
        }
    }

    /// Tells new guests where they are, and what their share is.
    fn brief(&mut self, new: &[ModelId], pads: DVec3, hive: &mut Platform<'_>) {
        let Some(cells) = self.desk.as_ref().map(|desk| desk.cells) else {
            return;
        };
        let first = self.crew.len();
        let shares = shares(&cells, new.len());
        let spots = spots(self.params.dock.width.metres(), self.params.spot.metres());
        let spots: Vec<DVec2> = spots.skip(first).take(new.len()).collect();
        let far_m = spots.iter().map(|at| at.length()).fold(0.0, f64::max);
        let radius_m = self.params.dock.pad_radius.metres();
        if far_m > radius_m {
            return hive.fault(format!(
                "{} MAVs at pads {} m apart reach {far_m:.1} m from the hive, and only up to dock.pad_radius = \
                 {radius_m} m do they have power and are they heard: raise dock.pad_radius, or have fewer MAVs",
                first + new.len(),
                self.params.spot.metres(),
            ));
        }
        for (at, id) in new.iter().enumerate() {
            let number = (first + at) as u32;
            self.crew.insert(*id, number);
            hive.tell(
                *id,
                Briefing {
                    home: pads,
                    spot: pads + spots[at].extend(0.0),
                    number,
                    cells,
                    scheme: self.params.scheme,
                    share: shares[at].clone(),
                },
            );
        }
    }

    fn publish(&mut self, hive: &mut Platform<'_>) {
        let Some(desk) = &self.desk else { return };
        let known = self.searched.len() as f64 / f64::from(desk.cells.len());
        hive.metric("known", known, "1");
        hive.metric("docked", self.dock.guests().count() as f64, "1");
        let lately = |at: &&SimTime| (hive.now() - **at).secs() < LATELY_S;
        let aloft = self.heard.values().filter(lately).count();
        hive.metric("aloft", aloft as f64, "1");
        hive.metric("dispatches", self.dispatches as f64, "1");
        hive.metric("refused", self.refused as f64, "1");
        if let Some(planner) = &desk.planner {
            hive.metric("planned/searched", planner.searched(), "1");
            hive.metric("planned/out", planner.out() as f64, "1");
        }
    }
}

/// The cells in as many wedges, equal but for one, each with its nearest cells first.
fn shares(cells: &Cells, count: usize) -> Vec<Vec<u16>> {
    let turn = cells.by_direction();
    let middle = cells.middle(cells.len() / 2);
    let share = |at: usize| {
        let (from, to) = (at * turn.len() / count, (at + 1) * turn.len() / count);
        let mut share = turn[from..to].to_vec();
        let far = |cell: &u16| cells.middle(*cell).distance_squared(middle);
        share.sort_by(|a, b| far(a).total_cmp(&far(b)).then(a.cmp(b)));
        share
    };
    (0..count).map(share).collect()
}

/// Where pads are from the middle, in square rings around the box; without end.
fn spots(box_m: f64, spot_m: f64) -> impl Iterator<Item = DVec2> {
    let first = (0.5 * box_m / spot_m).floor() as i32 + 1;
    (first..).flat_map(move |ring| {
        let square = (-ring..=ring).flat_map(move |y| (-ring..=ring).map(move |x| (x, y)));
        let edge = square.filter(move |(x, y)| x.abs() == ring || y.abs() == ring);
        edge.map(move |(x, y)| DVec2::new(f64::from(x), f64::from(y)) * spot_m)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pads_are_beside_the_box_and_apart() {
        let spots: Vec<DVec2> = spots(1.0, 0.5).take(200).collect();
        assert!(spots.iter().all(|at| at.abs().max_element() >= 1.0));
        for (at, one) in spots.iter().enumerate() {
            assert!(
                one.length() < 6.0 && spots[..at].iter().all(|other| one.distance(*other) > 0.49)
            );
        }
    }

    #[test]
    fn shares_are_equal_and_hold_each_cell_once() {
        let cells = Cells::around(DVec2::ZERO, 200.0, 10.0);
        let shares = shares(&cells, 50);
        assert!(shares.iter().all(|share| share.len() == 8));
        let mut all = shares.concat();
        all.sort_unstable();
        assert_eq!(all, (0..400).collect::<Vec<_>>());
    }
}
