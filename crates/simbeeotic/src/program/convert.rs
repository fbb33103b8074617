//! `convert`: the original's XML as TOML.

use super::arguments::ConvertOptions;
use super::{Failure, colour, remark, say};
use simbeeotic_scenario::{convert_file, render};
use std::fs;
use std::path::Path;

/// Converts a scenario, and its world if one is given.
pub(super) fn convert(options: &ConvertOptions) -> Result<(), Failure> {
    let world = options
        .world
        .as_deref()
        .map(|path| convert_one(path, options.output.as_deref()))
        .transpose()?;
    let converted = convert_file(&options.scenario, world.as_deref()).map_err(|rejected| {
        Failure::input(render::faults(&rejected.faults, &rejected.sources, colour()).trim_end())
    })?;
    let notes = render::faults(&converted.faults, &converted.sources, colour());
    if !notes.is_empty() {
        remark(notes.trim_end());
    }
    match &options.output {
        Some(path) => write(path, &converted.toml),
        None => {
            say(converted.toml.trim_end());
            Ok(())
        }
    }
}

/// Converts a world file to one beside the output; returns its path.
fn convert_one(world: &Path, output: Option<&Path>) -> Result<std::path::PathBuf, Failure> {
    let folder = output.and_then(Path::parent).unwrap_or(Path::new(""));
    let stem = world.file_stem().unwrap_or(world.as_os_str());
    let target = folder.join(stem).with_extension("toml");
    let converted = simbeeotic_scenario::convert_world(world).map_err(|rejected| {
        Failure::input(render::faults(&rejected.faults, &rejected.sources, colour()).trim_end())
    })?;
    if target.exists() {
        return Err(Failure::run(format!(
            "{} is there already",
            target.display()
        )));
    }
    write(&target, &converted.toml)?;
    Ok(target)
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    fs::write(path, text)
        .map_err(|e| Failure::run(format!("cannot write {}: {e}", path.display())))?;
    remark(format!("wrote {}", path.display()));
    Ok(())
}
