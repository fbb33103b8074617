//! Lines of sight, and what is in the way.

use simbeeotic_model::kernel::ModelId;
use simbeeotic_model::physics::Kind;
use simbeeotic_model::units::{Length, Position};
use simbeeotic_model::{Ray, Seen, SeesWhat, Thing, Truth};

/// More things than these are as good as ground.
const MOST: usize = 16;
/// What rounding does to a place.
const HAIR_M: f64 = 1e-6;

/// A ray that cannot be cast: from, to, or over a place that is too far from the origin.
struct Refused;

/// What is in the way first from `from` to `to`. The host itself is not, nor is `target`.
fn first(
    truth: &Truth<'_>,
    from: Position,
    to: Position,
    target: Option<ModelId>,
    sees: SeesWhat,
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
    let hits = truth.cast_rays(&[ray], sees).map_err(|_| Refused)?;
    let hit = hits.into_iter().next().flatten();
    Ok(hit.filter(|hit| target.is_none() || hit.thing.model() != target))
}

/// Whether nothing is in the way from `from`, a place on the host, to `to`, which may be the place of the
/// model `target`. Where no ray can be cast, something is.
pub(super) fn is_free(
    truth: &Truth<'_>,
    from: Position,
    to: Position,
    target: Option<ModelId>,
    sees: SeesWhat,
) -> bool {
    matches!(first(truth, from, to, target, sees), Ok(None))
}

/// One thing in the way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    pub(super) thing: Thing,
    /// How long the way through it is.
    pub(super) thickness: Length,
}

/// What is in the way as in [`is_free`], in order. `None` if there is no way through: ground, terrain, or
/// more than 16 things, or where no ray can be cast. Parts of one thing that touch are one; a mesh is hollow: two things without thickness.
pub(super) fn crossings(
    truth: &Truth<'_>,
    from: Position,
    to: Position,
    target: Option<ModelId>,
    sees: SeesWhat,
) -> Option<Vec<Crossing>> {
    let total_m = (to - from).length().get();
    let Some(direction) = (to - from).direction() else {
        return Some(Vec::new());
    };
    let place = |along_m: f64| from + Position::along(direction, Length::si(along_m));
    let (mut at_m, mut found) = (0.0, Vec::<Crossing>::new());
    let mut left_m = f64::NEG_INFINITY;
    let mut next = first(truth, from, to, target, sees).ok()?;
    while let Some(hit) = next {
        if matches!(hit.kind, Kind::Ground | Kind::Terrain) || found.len() == MOST {
            return None;
        }
        let enter_m = at_m + hit.distance.get();
        // From within one does not see where it ends, but looking back from the next thing.
        at_m = enter_m + HAIR_M;
        next = first(truth, place(at_m), to, target, sees).ok()?;
        let beyond_m = next.map_or(total_m, |next| at_m + next.distance.get());
        let (from_m, back_m) = (beyond_m - HAIR_M, enter_m);
        let back = first(truth, place(from_m), place(back_m), None, sees).ok()?;
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
