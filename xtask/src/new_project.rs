//! What `simbeeotic new` makes is a crate that builds, passes its test and runs.
//!
//! The project is made in a temporary folder outside the workspace, as a user's would be, and then tested
//! and run with this checkout as its `simbeeotic`, the workspace's lock file, profiles and target folder:
//! that builds the crates of this house and the project, and nothing else a second time.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};
use toml::{Table, Value};

use crate::program::{Profile, Program};
use crate::repo::Repo;
use crate::report::Report;

/// Name of the project that is made.
const NAME: &str = "my-swarm";

/// Makes a project, tests it, runs its first scenario.
pub(crate) fn check(repo: &Repo) -> Result<Report> {
    let scratch = Scratch::new()?;
    let project = scratch.path.join(NAME);
    let folder = project
        .to_str()
        .context("the temporary folder has a name that is not UTF-8")?;
    let program = Program::build(repo, Profile::Release)?;
    program.stdout(&["new", NAME, "--path", folder])?;

    let manifest = std::fs::read_to_string(project.join("Cargo.toml"))
        .context("`simbeeotic new` made no Cargo.toml where --path says")?;
    let config = scratch.path.join("config.toml");
    let settings = settings(&repo.read("Cargo.toml")?, &manifest, repo.root())?;
    std::fs::write(&config, settings.to_string())?;
    std::fs::copy(repo.path("Cargo.lock"), project.join("Cargo.lock"))?;

    let target = repo.target_dir()?;
    let cargo = |args: &[&str]| {
        let mut command = repo.cargo();
        command
            .current_dir(&project)
            .env("CARGO_TARGET_DIR", &target);
        command.arg("--config").arg(&config).args(args);
        command.stdin(Stdio::null());
        command
    };
    expect(&mut cargo(&["test", "--quiet"]), "its test fails")?;
    let scenario = first_scenario(&project)?;
    let run = cargo(&[
        "run", "--quiet", "--", "run", &scenario, "--quiet", "--json",
    ])
    .stderr(Stdio::inherit())
    .output()?;
    ensure!(run.status.success(), "`cargo run -- run {scenario}` fails");
    let summary: serde_json::Value =
        serde_json::from_slice(&run.stdout).context("its summary is not JSON")?;
    let hash = summary["trace_hash"]
        .as_str()
        .context("its summary has no `trace_hash`")?;

    Ok(Report::of(format!(
        "made, tested, run: {scenario} has trace hash {hash}"
    )))
}

fn expect(command: &mut Command, fault: &str) -> Result<()> {
    let status = command.status()?;
    ensure!(status.success(), "{fault}");
    Ok(())
}

/// Cargo settings for the project: the workspace's profiles, and this checkout instead of a published
/// `simbeeotic` (unless the project already points into a folder).
fn settings(workspace: &str, project: &str, root: &Path) -> Result<Table> {
    let workspace: Table = workspace.parse()?;
    let project: Table = project.parse()?;
    let dependency = project
        .get("dependencies")
        .and_then(|dependencies| dependencies.get("simbeeotic"))
        .context("the project does not depend on simbeeotic")?;

    let mut settings = Table::new();
    if let Some(profile) = workspace.get("profile") {
        let mut profile = profile.clone();
        quickly_built(&mut profile, &workspace);
        settings.insert("profile".to_owned(), profile);
    }
    if dependency.get("path").is_none() {
        let url = dependency.get("git").and_then(Value::as_str);
        let source = url.unwrap_or("crates-io");
        let here = root.join("crates").join("simbeeotic");
        let here = here
            .to_str()
            .context("the checkout has a name that is not UTF-8")?;
        let path = Table::from_iter([("path".to_owned(), Value::from(here))]);
        let crates = Table::from_iter([("simbeeotic".to_owned(), Value::from(path))]);
        let patch = Table::from_iter([(source.to_owned(), Value::from(crates))]);
        settings.insert("patch".to_owned(), Value::from(patch));
    }
    Ok(settings)
}

/// Has the crates of this house not optimised: all of them are compiled anew for the project, and for a run of a
/// second that is not worth a minute. Those of others are as in the workspace, which has built them.
fn quickly_built(profile: &mut Value, workspace: &Table) {
    let Some(dev) = profile.get_mut("dev").and_then(Value::as_table_mut) else {
        return;
    };
    let dependencies = workspace
        .get("workspace")
        .and_then(|workspace| workspace.get("dependencies"));
    let house = dependencies
        .and_then(Value::as_table)
        .into_iter()
        .flatten()
        .filter(|(_, dependency)| dependency.get("path").is_some())
        .map(|(name, _)| name.clone());
    let packages = dev.entry("package").or_insert_with(|| Table::new().into());
    for name in house {
        if let Some(packages) = packages.as_table_mut() {
            let own = Table::from_iter([("opt-level".to_owned(), Value::from(0))]);
            packages.insert(name, own.into());
        }
    }
}

/// The project's first scenario, as a path from the project: at its root or in `scenarios/`.
fn first_scenario(project: &Path) -> Result<String> {
    for folder in ["", "scenarios"] {
        let Ok(entries) = std::fs::read_dir(project.join(folder)) else {
            continue;
        };
        let mut names: Vec<String> = entries
            .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
            .filter(|name| name.ends_with(".toml"))
            .filter(|name| {
                !["Cargo.toml", "clippy.toml", "rust-toolchain.toml"].contains(&name.as_str())
            })
            .collect();
        names.sort();
        if let Some(name) = names.first() {
            return Ok(match folder {
                "" => name.clone(),
                folder => format!("{folder}/{name}"),
            });
        }
    }
    anyhow::bail!("the project has no scenario")
}

/// A folder of our own below the system's temporary one, removed when dropped.
struct Scratch {
    path: PathBuf,
}

impl Scratch {
    fn new() -> Result<Self> {
        let name = format!("simbeeotic-new-project-{}", std::process::id());
        let path = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&path)?;
        Ok(Self { path })
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // What cannot be removed stays in the temporary folder; there is nobody to tell.
        let _ = std::fs::remove_dir_all(&self.path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WORKSPACE: &str = "[workspace]\nmembers = []\n[profile.dev]\nopt-level = 1\n";

    fn patch_of(project: &str) -> Option<String> {
        let settings = settings(WORKSPACE, project, Path::new("here")).unwrap();
        assert_eq!(
            settings["profile"]["dev"]["opt-level"].as_integer(),
            Some(1)
        );
        settings.get("patch").map(ToString::to_string)
    }

    #[test]
    fn a_project_on_the_registry_or_on_git_is_given_this_checkout() {
        let patch = patch_of("[dependencies]\nsimbeeotic = \"0.1\"\n").unwrap();
        assert!(patch.contains("crates-io"), "{patch}");
        let patch =
            patch_of("[dependencies.simbeeotic]\ngit = \"https://example.org/s\"\n").unwrap();
        assert!(patch.contains("https://example.org/s"), "{patch}");
    }

    #[test]
    fn crates_of_the_house_are_not_optimised_and_others_are_as_in_the_workspace() {
        let workspace = "
            [workspace.dependencies]
            simbeeotic-a = { path = \"crates/a\" }
            simbeeotic-b = { path = \"crates/b\" }
            serde = { version = \"1\" }
            [profile.dev]
            opt-level = 1
            [profile.dev.package.simbeeotic-b]
            opt-level = 3
            [profile.dev.package.\"*\"]
            opt-level = 2
        ";
        let project = "[dependencies.simbeeotic]\npath = \"../s\"\n";
        let settings = settings(workspace, project, Path::new("here")).unwrap();
        let packages = settings["profile"]["dev"]["package"].as_table().unwrap();
        let level = |name: &str| {
            packages
                .get(name)
                .map(|own| own["opt-level"].as_integer().unwrap())
        };
        assert_eq!(level("simbeeotic-a"), Some(0));
        assert_eq!(level("simbeeotic-b"), Some(0));
        assert_eq!(level("*"), Some(2));
        assert_eq!(level("serde"), None);
    }

    #[test]
    fn a_project_that_points_into_a_folder_is_left_alone() {
        assert_eq!(
            patch_of("[dependencies.simbeeotic]\npath = \"../s\"\n"),
            None
        );
    }

    #[test]
    fn a_project_without_simbeeotic_is_refused() {
        assert!(settings(WORKSPACE, "[dependencies]\n", Path::new("here")).is_err());
    }

    #[test]
    fn the_first_scenario_is_found_at_the_root_or_in_its_folder() {
        let project = tempfile::tempdir().unwrap();
        assert!(first_scenario(project.path()).is_err());
        std::fs::write(project.path().join("Cargo.toml"), "").unwrap();
        std::fs::create_dir(project.path().join("scenarios")).unwrap();
        std::fs::write(project.path().join("scenarios/a.toml"), "").unwrap();
        assert_eq!(first_scenario(project.path()).unwrap(), "scenarios/a.toml");
        std::fs::write(project.path().join("scenario.toml"), "").unwrap();
        assert_eq!(first_scenario(project.path()).unwrap(), "scenario.toml");
    }
}
