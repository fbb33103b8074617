//! What a recording says once, before anything moves, besides who flies: what models are made of, what stands in the
//! world.

use crate::data::Attachment;
use crate::scene;
use crate::stage::{Stage, textures};
use prost::Message;
use simbeeotic_model::{About, View};
use std::collections::BTreeMap;

/// What is known about models is written up to this size, and asked of so many sections.
const MODELS_BYTES_MAX: usize = 8 << 20;
const SECTIONS_MAX: usize = 2_000;

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
