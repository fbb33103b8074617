//! A host that has a body and gear, and stays where forces put it.

use super::{Cx, Gear, Host, Platform};
use crate::behavior::BuildError;
use crate::instance::Instance;
use simbeeotic_physics::{BodySpec, Kind, Mobility};

/// Carries a thing with a body and gear that does not fly by itself: a hive, a beacon, a balloon.
/// Its behaviour says what the body is ([`Behavior::body`](crate::Behavior::body)) and sees a
/// [`Platform`].
pub struct Station {
    gear: Gear,
}

impl Host for Station {
    type View<'a> = Platform<'a>;

    fn assemble(instance: &mut Instance<'_>, body: Option<BodySpec>) -> Result<Self, BuildError> {
        instance.refuse_vehicle("a station")?;
        let body = body.ok_or_else(|| BuildError::other("its behaviour gives it no body"))?;
        let kind = match body.mobility {
            Mobility::Driven => Kind::Ghost,
            _ => Kind::Station,
        };
        instance.add_body(BodySpec {
            kind: body.kind.or(Some(kind)),
            ..body
        })?;
        Ok(Self {
            gear: Gear::assemble(instance)?,
        })
    }

    fn view<'a>(&'a mut self, cx: Cx<'a>) -> Platform<'a> {
        Platform::new(cx, &mut self.gear)
    }

    fn gear(&mut self) -> Option<&mut Gear> {
        Some(&mut self.gear)
    }
}
