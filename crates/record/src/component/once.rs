//! What a recording says once, before anything moves: who flies and how it looks, what models are made of,
//! what stands in the world.

use crate::data::{Attachment, Vehicle};
use crate::scene;
use crate::stage::{Piece, Stage, pieces_of, textures};
use prost::Message;
use simbeeotic_model::kernel::ModelId;
use simbeeotic_model::physics::Shape;
use simbeeotic_model::{About, View};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Swarms have few shapes: a shape is looked for among so many.
const SHAPES_MAX: usize = 64;

/// What is known about models is written up to this size, and asked of so many sections.
const MODELS_BYTES_MAX: usize = 8 << 20;
const SECTIONS_MAX: usize = 2_000;

/// All bodies as vehicles of a recording; those of one shape share their pieces.
pub(super) fn vehicles(view: &View<'_>, bodies: &[ModelId]) -> Vec<Vehicle> {
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

/// What all models are made of, those that are alike together; and what there is to say about those
/// that were left out.
pub(super) fn models(view: &View<'_>) -> (Vec<(Vec<String>, About)>, Option<String>) {
    let mut places: BTreeMap<Vec<u8>, usize> = BTreeMap::new();
    let mut all: Vec<(Vec<String>, About)> = Vec::new();
    let (mut bytes, mut left_out) = (0, 0_usize);
    // Those of one section of the scenario are alike: one is asked.
    let mut sections: BTreeMap<usize, usize> = BTreeMap::new();
    for (id, member) in view.population().iter() {
        let section = view.section(id);
        if let Some(place) = section.and_then(|section| sections.get(&section)) {
            all[*place].0.push(member.path.to_owned());
            continue;
        }
        if sections.len() >= SECTIONS_MAX || bytes > MODELS_BYTES_MAX {
            left_out += 1;
            continue;
        }
        let about = view.about(id);
        // As it is written: without what is the model's alone.
        let key = scene::pack_about(&[], &about).encode_to_vec();
        let size = key.len();
        let place = *places.entry(key).or_insert_with(|| {
            bytes += size;
            all.push((Vec::new(), about));
            all.len() - 1
        });
        sections.extend(section.map(|section| (section, place)));
        all[place].0.push(member.path.to_owned());
    }
    let note = (left_out > 0).then(|| format!("the parameters of {left_out} models are left out"));
    (all, note)
}

/// What stands in the world, with the files of its textures.
pub(super) fn world(view: &View<'_>) -> (Stage, Vec<Attachment>, Vec<String>) {
    let stage = Stage::of(view.world(), view.origin().seed);
    let (files, notes) = textures(view.world());
    (stage, files, notes)
}
