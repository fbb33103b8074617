//! Who flies, and how it looks.

use crate::data::Vehicle;
use crate::stage::{Piece, pieces_of};
use simbeeotic_model::View;
use simbeeotic_model::kernel::ModelId;
use simbeeotic_model::physics::Shape;
use std::sync::Arc;

/// Swarms have few shapes: a shape is looked for among so many.
const SHAPES_MAX: usize = 64;

/// These bodies as vehicles of a recording, or of a page; those of one shape share their pieces.
pub fn vehicles_of(view: &View<'_>, bodies: &[ModelId]) -> Vec<Vehicle> {
    let mut shapes: Vec<(&Shape, Arc<[Piece]>)> = Vec::new();
    let mut look = |shape| -> Arc<[Piece]> {
        if let Some((_, pieces)) = shapes.iter().find(|(known, _)| *known == shape) {
            return Arc::clone(pieces);
        }
        let pieces: Arc<[Piece]> = pieces_of(shape).into();
        if shapes.len() < SHAPES_MAX {
            shapes.push((shape, Arc::clone(&pieces)));
        }
        pieces
    };
    let vehicle = |id: &ModelId| {
        let member = view.population().get(*id);
        Vehicle {
            path: member.map(|m| m.path.to_owned()).unwrap_or_default(),
            kind: member.map(|m| m.kind.to_owned()).unwrap_or_default(),
            radius_m: view.radius(*id).map_or(0.0, |r| r.metres()),
            role: view
                .body_kind(*id)
                .map_or("", |kind| kind.name())
                .to_owned(),
            color: (view.color(*id)).map_or([0; 4], |c| [c.red, c.green, c.blue, c.alpha]),
            pieces: view.shape(*id).map(&mut look).unwrap_or_default(),
        }
    };
    bodies.iter().map(vehicle).collect()
}
