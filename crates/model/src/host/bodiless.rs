//! A host without a body.

use super::{Cx, Host};
use crate::behavior::BuildError;
use crate::instance::Instance;
use simbeeotic_physics::BodySpec;

/// Carries a model without physical presence: a planner, a referee, a source of events. Its
/// behaviour sees a [`Cx`].
#[derive(Debug)]
pub struct Bodiless;

impl Host for Bodiless {
    type View<'a> = Cx<'a>;

    fn assemble(instance: &mut Instance<'_>, _body: Option<BodySpec>) -> Result<Self, BuildError> {
        instance.refuse_vehicle("a model without a body")?;
        instance.refuse_gear("a model without a body")?;
        Ok(Self)
    }

    fn view<'a>(&'a mut self, cx: Cx<'a>) -> Cx<'a> {
        cx
    }
}
