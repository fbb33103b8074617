//! A beacon on the ground: the memory of the emergent scheme.

use super::cells::Cells;
use super::referee::BeaconBooks;
use super::scheme::Scheme;
use super::wire::Word;
use simbeeotic::prelude::*;
use simbeeotic::units::glam::{DVec2, DVec3};
use simbeeotic::units::math;

/// Keeps how often its cell was visited lately, and how many flowers were left there, and tells it who asks.
/// In the other schemes its radio sleeps.
///
/// It tells a model called `referee`, if there is one, what it has drawn: for the books, nothing comes back.
///
/// Visits evaporate: after `evaporation` a share of 1/e is left of them.
#[behavior("trail-beacon", host = Station)]
pub struct TrailBeacon {
    params: TrailBeaconParams,
    radio: Option<RadioHandle>,
    timer: TimerHandle,
    cell: Option<u16>,
    visits: f64,
    left: u8,
    taken: Option<SimTime>,
    updated: SimTime,
}

/// Parameters of [`TrailBeacon`].
#[params]
pub struct TrailBeaconParams {
    /// It speaks in the emergent scheme alone.
    pub scheme: Scheme,
    /// Edge of the square field around the origin that the hive there has divided into cells.
    pub field: Length,
    /// Edge of a cell. A beacon outside of all cells is silent.
    pub cell: Length,
    /// It answers within this time, at random: all who have heard the question do.
    pub answer: Time,
    /// Time in which visits evaporate to 1/e.
    pub evaporation: Time,
    /// How long a cell is taken after somebody said to go there, if nobody says to leave it.
    pub claim: Time,
}

impl Default for TrailBeaconParams {
    fn default() -> Self {
        Self {
            scheme: Scheme::Emergent,
            field: Length::si(200.0),
            cell: Length::si(10.0),
            answer: Time::si(0.25),
            evaporation: Time::si(600.0),
            claim: Time::si(90.0),
        }
    }
}

/// How often it tells what it has drawn, and at which voltage that is reckoned: two cells of 1.5 V.
const BOOKS: Time = Time::si(10.0);
const SUPPLY_V: f64 = 3.0;
/// Half the edge of its box.
const HALF_M: f64 = 0.05;

impl Behavior<Station> for TrailBeacon {
    type Params = TrailBeaconParams;

    fn build(params: TrailBeaconParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        positive("field", params.field)?;
        positive("cell", params.cell)?;
        positive("answer", params.answer)?;
        positive("evaporation", params.evaporation)?;
        positive("claim", params.claim)?;
        kit.once(Time::ZERO, Self::settle);
        kit.every(BOOKS, Self::account);
        Ok(Self {
            timer: kit.timer(Self::speak),
            radio: kit.optional_radio(),
            params,
            cell: None,
            visits: 0.0,
            left: 0,
            taken: None,
            updated: SimTime::ZERO,
        })
    }

    fn body(_: &TrailBeaconParams) -> Option<BodySpec> {
        Some(BodySpec {
            p_enu: DVec3::new(0.0, 0.0, HALF_M),
            mobility: Mobility::Fixed,
            contacts: Contacts::None,
            ..BodySpec::new(
                Shape::Box {
                    half_m: DVec3::splat(HALF_M),
                },
                0.1,
            )
        })
    }

    fn on_packet(&mut self, packet: &Packet<'_>, beacon: &mut Platform<'_>) {
        let Some(own) = self.cell else { return };
        match Word::decode(packet.payload(), DVec2::ZERO) {
            Some(Word::Claim { cell }) if cell == own => {
                self.evaporate(beacon.now());
                self.visits += 1.0;
                self.taken = Some(beacon.now());
            }
            Some(Word::Mark { cell, left }) if cell == own => {
                (self.left, self.taken) = (left, None);
            }
            Some(Word::Listen) => {
                let wait = self.params.answer * beacon.uniform();
                beacon.arm(self.timer, wait);
            }
            _ => {}
        }
    }
}

impl TrailBeacon {
    /// Learns which cell is its own, from those who put it there; sleeps if it is not needed.
    fn settle(&mut self, beacon: &mut Platform<'_>) {
        if self.params.scheme == Scheme::Emergent {
            let (field, cell) = (self.params.field.metres(), self.params.cell.metres());
            let cells = Cells::around(DVec2::ZERO, field, cell);
            self.cell = cells.at(beacon.position().si().truncate());
        } else if let Some(radio) = self.radio {
            beacon.sleep_radio(radio);
        }
    }

    fn account(&mut self, beacon: &mut Platform<'_>) {
        if self.params.scheme != Scheme::Emergent {
            return;
        }
        let energy_j = beacon.accounts().total().get() * SUPPLY_V;
        if let Some(referee) = beacon.find("referee") {
            beacon.tell(referee, BeaconBooks { energy_j });
        }
    }

    fn evaporate(&mut self, now: SimTime) {
        let span = (now - self.updated).secs();
        self.updated = now;
        self.visits *= math::exp(-span / self.params.evaporation.get());
    }

    fn speak(&mut self, beacon: &mut Platform<'_>) {
        let now = beacon.now();
        self.evaporate(now);
        let claim_s = self.params.claim.get();
        let taken = self
            .taken
            .is_some_and(|since| (now - since).secs() < claim_s);
        if let (Some(radio), Some(cell)) = (self.radio, self.cell) {
            let word = Word::Trail {
                cell,
                visits: (self.visits * 16.0).round().min(255.0) as u8,
                left: self.left,
                taken,
            };
            beacon.send(radio, &word.encode(DVec2::ZERO));
        }
    }
}
