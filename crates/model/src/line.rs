//! The straight way between two places, and what is in it.

use crate::message::Thing;
use crate::sees::SeesWhat;
use crate::swarm::Swarm;
use crate::view::Truth;
use crate::{Ray, Seen};
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_physics::{BodyId, Kind};
use simbeeotic_units::{Decibels, Frequency, Length, Position};
use simbeeotic_world::material::LOSS_DB_MAX;

/// More things than these are as good as ground.
const MOST: usize = 16;
/// What rounding does to a place.
const HAIR_M: f64 = 1e-6;
/// Who is deeper is in the ground, and not on it.
const DEEP_M: f64 = -0.01;

/// One thing in the way.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// What it is.
    pub thing: Thing,
    /// How long the way through it is.
    pub thickness: Length,
}

/// A ray that cannot be cast: from, to, or over a place that is too far from the origin.
struct Refused;

/// Who looks along a line.
#[derive(Clone, Copy)]
pub(crate) struct Line<'a> {
    pub(crate) swarm: &'a Swarm,
    pub(crate) now: SimTime,
    /// The body that the line begins on: it is not in the way.
    pub(crate) but: Option<BodyId>,
    /// The model that it ends on: it is not, either.
    pub(crate) target: Option<ModelId>,
    pub(crate) sees: SeesWhat,
}

impl Line<'_> {
    /// What is in the way first.
    fn first(
        &self,
        from: Position,
        to: Position,
        target: Option<ModelId>,
    ) -> Result<Option<Seen>, Refused> {
        let way = to - from;
        // What `to` is fixed to is not in its way.
        let range = way.length() - Length::si(HAIR_M);
        if range <= Length::ZERO {
            return Ok(None);
        }
        let ray = Ray {
            origin: from,
            direction: way.si().to_array(),
            range,
        };
        let hits = self.swarm.cast_rays(&[ray], self.now, self.sees, self.but);
        let hit = hits.map_err(|_| Refused)?.into_iter().next().flatten();
        Ok(hit.filter(|hit| target.is_none() || hit.thing.model() != target))
    }

    /// Whether nothing is in the way. Where no ray can be cast, something is.
    pub(crate) fn is_free(&self, from: Position, to: Position) -> bool {
        matches!(self.first(from, to, self.target), Ok(None))
    }

    /// See [`Truth::crossings`].
    pub(crate) fn crossings(&self, from: Position, to: Position) -> Option<Vec<Crossing>> {
        let total_m = (to - from).length().get();
        let Some(direction) = (to - from).direction() else {
            return Some(Vec::new());
        };
        let place = |along_m: f64| from + Position::along(direction, Length::si(along_m));
        let (mut at_m, mut found) = (0.0, Vec::<Crossing>::new());
        let mut left_m = f64::NEG_INFINITY;
        let mut next = self.first(from, to, self.target).ok()?;
        while let Some(hit) = next {
            if matches!(hit.kind, Kind::Ground | Kind::Terrain) || found.len() == MOST {
                return None;
            }
            let enter_m = at_m + hit.distance.get();
            // From within one does not see where it ends, but looking back from the next thing.
            at_m = enter_m + HAIR_M;
            next = self.first(place(at_m), to, self.target).ok()?;
            let beyond_m = next.map_or(total_m, |next| at_m + next.distance.get());
            let (from_m, back_m) = (beyond_m - HAIR_M, enter_m);
            let back = self.first(place(from_m), place(back_m), None).ok()?;
            let back = back.filter(|back| back.thing == hit.thing);
            let leave_m = beyond_m - back.map_or(0.0, |back| HAIR_M + back.distance.get());
            let thickness = Length::si((leave_m - enter_m).max(0.0));
            match found.last_mut() {
                Some(last) if last.thing == hit.thing && enter_m - left_m < 10.0 * HAIR_M => {
                    last.thickness += thickness;
                }
                _ => found.push(Crossing {
                    thing: hit.thing,
                    thickness,
                }),
            }
            left_m = leave_m;
        }
        Some(found)
    }
}

impl Truth<'_> {
    /// Whether nothing is in the way from `from`, a place on the host, to `to`, which may be the place of
    /// the model `target`. Where no ray can be cast, something is.
    pub fn is_free(
        &self,
        from: Position,
        to: Position,
        target: Option<ModelId>,
        sees: SeesWhat,
    ) -> bool {
        self.line_of_sight(target, sees).is_free(from, to)
    }

    /// What is in the way as in [`is_free`](Self::is_free), in order, and how thick. `None` if there is no
    /// way through: ground, terrain, or more than 16 things, or where no ray can be cast. Parts of one thing
    /// that touch are one; a mesh is hollow: two things without thickness.
    pub fn crossings(
        &self,
        from: Position,
        to: Position,
        target: Option<ModelId>,
        sees: SeesWhat,
    ) -> Option<Vec<Crossing>> {
        self.line_of_sight(target, sees).crossings(from, to)
    }
}

impl Swarm {
    /// What all things between two antennas take from a wave: for each its material's loss over the length
    /// of the straight way through it; the carriers do not count. Ground and terrain take
    /// [`LOSS_DB_MAX`], as do more than 16 things. A thing of unknown material takes nothing.
    ///
    /// Diffraction is not modelled: what goes around an edge or through a door beside the straight way is
    /// left out, and so are reflections.
    pub(crate) fn obstruction(
        &self,
        ends: [(ModelId, Position); 2],
        frequency: Frequency,
        now: SimTime,
    ) -> Decibels {
        let [mut a, mut b] = ends;
        // Always from the same end, whoever asks: the same to the last bit.
        let key = |end: &(ModelId, Position)| end.1.si().to_array();
        if key(&b) < key(&a) {
            (a, b) = (b, a);
        }
        let ((host, from), (target, to)) = (a, b);
        let line = Line {
            swarm: self,
            now,
            but: self.body_of(host),
            target: Some(target),
            sees: above_ground(from, to),
        };
        let Some(crossings) = line.crossings(from, to) else {
            return Decibels::si(LOSS_DB_MAX);
        };
        let loss = |crossing: Crossing| {
            let object = crossing.thing.object()?;
            let material = self.world.material_of(object)?;
            Some(material.loss(frequency, crossing.thickness))
        };
        let sum = crossings
            .into_iter()
            .filter_map(loss)
            .map(Decibels::get)
            .sum::<f64>();
        Decibels::si(sum.min(LOSS_DB_MAX))
    }
}

/// Two places that are not in the flat ground have none of it between them, and one that lies on it shall not
/// find itself in it by rounding.
fn above_ground(from: Position, to: Position) -> SeesWhat {
    if from.si().z.min(to.si().z) < DEEP_M {
        return SeesWhat::EVERYTHING;
    }
    let mut kinds = Kind::ALL.to_vec();
    kinds.retain(|kind| *kind != Kind::Ground);
    SeesWhat::only(&kinds)
}
