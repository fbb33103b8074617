//! `convert`: the original's XML as TOML.

use super::arguments::ConvertOptions;
use super::{Failure, colour, input, remark, same_file, say};
use simbeeotic_scenario::{Converted, convert_file, convert_world, render, xml};
use std::fs;
use std::path::{Path, PathBuf};

/// Converts a scenario, and its world if one is given. Nothing is written before both are good.
pub(super) fn convert(options: &ConvertOptions) -> Result<(), Failure> {
    let rejected = |rejected| Failure::input(input::text_of(&rejected));
    let world_path = options.world.as_deref();
    for path in [Some(options.scenario.as_path()), world_path]
        .into_iter()
        .flatten()
    {
        refuse_toml(path)?;
    }
    let target = world_path.map(|path| beside(path, options)).transpose()?;
    let scenario = convert_file(&options.scenario, world_path).map_err(rejected)?;
    let world = target
        .zip(world_path)
        .map(|(target, path)| Ok((target, convert_world(path, &scenario.variables)?)))
        .transpose()
        .map_err(rejected)?;
    if let Some(path) = &options.output {
        keep_input(path, options)?;
    }

    if let Some((_, world)) = &world {
        notes(world);
    }
    notes(&scenario);
    if let Some((path, world)) = &world {
        write(path, &world.toml)?;
    }
    match &options.output {
        Some(path) => write(path, &scenario.toml),
        None => say(scenario.toml.trim_end()),
    }
}

fn refuse_toml(path: &Path) -> Result<(), Failure> {
    // A file that cannot be read is told by who reads it in earnest.
    match fs::read_to_string(path) {
        Ok(text) if !xml::looks_like_xml(&text) => Err(Failure::input(format!(
            "{} is TOML already; `convert` reads the original's XML",
            path.display()
        ))),
        _ => Ok(()),
    }
}

/// Where a world goes: beside the output, under its own name.
fn beside(world: &Path, options: &ConvertOptions) -> Result<PathBuf, Failure> {
    let output = options.output.as_deref();
    let folder = output.and_then(Path::parent).unwrap_or(Path::new(""));
    let name = world.file_name().unwrap_or(world.as_os_str());
    let target = folder.join(name).with_extension("toml");
    if target.exists() {
        return Err(Failure::input(format!(
            "the world goes to {}, which is there already",
            target.display()
        )));
    }
    if output == Some(&target) {
        return Err(Failure::input(format!(
            "the scenario and its world would both be {}; choose another name with -o",
            target.display()
        )));
    }
    Ok(target)
}

fn keep_input(target: &Path, options: &ConvertOptions) -> Result<(), Failure> {
    let mut inputs = std::iter::once(&options.scenario).chain(&options.world);
    if inputs.any(|input| same_file(input, target)) {
        return Err(Failure::input(format!(
            "{} is the file to convert; choose another name with -o",
            target.display()
        )));
    }
    Ok(())
}

fn notes(converted: &Converted) {
    let notes = render::faults(&converted.faults, &converted.sources, colour());
    if !notes.is_empty() {
        remark(notes.trim_end());
    }
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    fs::write(path, text)
        .map_err(|e| Failure::run(format!("cannot write {}: {e}", path.display())))?;
    remark(format!("wrote {}", path.display()));
    Ok(())
}
