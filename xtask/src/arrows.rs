//! Which crate may depend on which. Arrows point down only, and [`TABLE`] is the whole truth.
//!
//! A part of the program stays understandable because of what it *cannot* reach. So each crate lists what
//! it may see, with the reason; any other edge fails, at its line in the manifest. To add an edge is a
//! decision about the design: change the table and say why in an ADR.
//!
//! Dev-dependencies are free (a test may look at anything), except on the facade: that would make every
//! crate's tests wait for the whole program, and invite tests that belong there. The facade's own
//! dev-dependency on this crate, for its golden traces, is one of the free ones.

use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Context, Result};
use toml::de::{DeTable, DeValue};

use crate::repo::Repo;
use crate::report::Report;

/// What one crate may depend on.
struct Row {
    /// The crate, without the prefix `simbeeotic-`.
    name: &'static str,
    /// Crates that its `[dependencies]` and `[build-dependencies]` may name.
    sees: &'static [&'static str],
    /// Why no others: printed when one appears.
    because: &'static str,
}

/// The facade's short name.
const FACADE: &str = "simbeeotic";

/// The crates from the bottom of the house to its top: each sees only crates of earlier rows.
/// A row may stand here before its crate does.
const TABLE: &[Row] = &[
    Row {
        name: "units",
        sees: &[],
        because: "units is the vocabulary: it depends on nothing of ours",
    },
    Row {
        name: "kernel",
        sees: &["units"],
        because: "the kernel knows nothing of bodies and radios; it is generic over its domain",
    },
    Row {
        name: "world",
        sees: &["units", "kernel"],
        because: "the world is what is there, whoever moves in it: it sees no physics and no radio",
    },
    Row {
        name: "physics",
        sees: &["units", "kernel"],
        because: "physics and radio do not see each other, nor the world: `model` brings them together",
    },
    Row {
        name: "radio",
        sees: &["units", "kernel"],
        because: "radio and physics do not see each other, nor the world: `model` brings them together",
    },
    Row {
        name: "macros",
        sees: &[],
        because: "a macro writes tokens; the names in them are found where they land",
    },
    Row {
        name: "model",
        sees: &["units", "kernel", "world", "physics", "radio", "macros"],
        because: "`model` is what authors write against: it may not know a single finished part",
    },
    Row {
        name: "models",
        sees: &["units", "world", "physics", "radio", "macros", "model"],
        because: "the shelf is written with what every author of parts has; the engine is not among it",
    },
    Row {
        name: "scenario",
        sees: &["units", "world", "model"],
        because: "a scenario names its parts and the registry finds them: it sees no finished part and no engine",
    },
    Row {
        name: "record",
        sees: &["units", "world", "model"],
        because: "the recorder is handed data: it never sees the engine, so it cannot change a run",
    },
    Row {
        name: "view",
        sees: &["units", "world", "model", "record"],
        because: "a view is handed data and reads the log: it never sees the engine, so it cannot change a run",
    },
    Row {
        name: "testbed",
        sees: &["units", "world", "model", "record"],
        because: "a headless testbed must not drag in the view",
    },
    Row {
        name: FACADE,
        sees: &[
            "units", "kernel", "world", "physics", "radio", "macros", "model", "models",
            "scenario", "record", "view", "testbed",
        ],
        because: "the facade sees every crate, but not the checks",
    },
    Row {
        name: "examples",
        sees: &[FACADE],
        because: "examples are written with what every author of parts has: the facade alone",
    },
    Row {
        name: "xtask",
        sees: &[],
        because: "the checks must build when the crates do not",
    },
];

/// A manifest of a workspace member, as text.
#[derive(Clone, Debug)]
struct Manifest {
    /// Path from the root.
    path: String,
    text: String,
}

/// Checks the manifests of all workspace members, and that ARCHITECTURE.md has a word for each crate.
pub(crate) fn check(repo: &Repo) -> Result<Report> {
    let root = repo.read("Cargo.toml")?;
    let members = members(repo, &root)?;
    judge(
        &root,
        &members,
        repo.read("ARCHITECTURE.md").ok().as_deref(),
    )
}

/// The manifests named by `workspace.members`, in order of their paths.
fn members(repo: &Repo, root: &str) -> Result<Vec<Manifest>> {
    let document = DeTable::parse(root).context("Cargo.toml")?;
    let patterns = document
        .get_ref()
        .get("workspace")
        .and_then(|workspace| workspace.get_ref().get("members"))
        .and_then(|members| members.get_ref().as_array())
        .context("Cargo.toml has no workspace.members")?;

    let mut folders = BTreeSet::new();
    for pattern in patterns
        .iter()
        .filter_map(|pattern| pattern.get_ref().as_str())
    {
        if let Some(parent) = pattern.strip_suffix("/*") {
            for entry in std::fs::read_dir(repo.path(parent)).with_context(|| parent.to_owned())? {
                let name = entry?.file_name().to_string_lossy().into_owned();
                folders.insert(format!("{parent}/{name}"));
            }
        } else {
            folders.insert(pattern.to_owned());
        }
    }

    folders
        .into_iter()
        .map(|folder| format!("{folder}/Cargo.toml"))
        .filter(|path| repo.path(path).is_file())
        .map(|path| {
            let text = repo.read(&path)?;
            Ok(Manifest { path, text })
        })
        .collect()
}

/// How a dependency is declared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Normal,
    Dev,
}

/// One line of a manifest that names a dependency.
#[derive(Clone, Debug)]
struct Edge {
    /// Package name of the dependency, renames undone.
    to: String,
    kind: Kind,
    line: usize,
}

/// Looks at all edges between members. Pure: the tests hand it graphs of their own.
fn judge(root: &str, members: &[Manifest], architecture: Option<&str>) -> Result<Report> {
    let renames = workspace_renames(root)?;
    let mut packages = BTreeMap::new();
    for manifest in members {
        let document = DeTable::parse(&manifest.text).with_context(|| manifest.path.clone())?;
        let name = document
            .get_ref()
            .get("package")
            .and_then(|package| package.get_ref().get("name"))
            .and_then(|name| name.get_ref().as_str())
            .with_context(|| format!("{} names no package", manifest.path))?;
        let edges = edges(document.get_ref(), &manifest.text, &renames);
        packages.insert(name.to_owned(), (manifest.path.as_str(), edges));
    }

    let mut report = Report::default();
    let mut count = 0;
    for (package, (path, edges)) in &packages {
        let from = short(package);
        let example = path.starts_with("examples/");
        let row = TABLE.iter().find(|row| row.name == from);
        if row.is_none() && !example {
            report.faults.push(format!(
                "{path}:1: `{from}` has no row in xtask/src/arrows.rs: say there what it may see"
            ));
            continue;
        }
        for edge in edges {
            if !packages.contains_key(&edge.to) {
                continue; // not one of ours
            }
            count += 1;
            let to = short(&edge.to);
            let place = format!("{path}:{}", edge.line);
            match (edge.kind, row) {
                (Kind::Dev, _) if to == FACADE && !example => report.faults.push(format!(
                    "{place}: `{from}` has the facade as a dev-dependency: such a test belongs to the facade"
                )),
                (Kind::Dev, _) => {}
                (Kind::Normal, Some(row)) if !row.sees.contains(&to) => report.faults.push(format!(
                    "{place}: `{from}` may not depend on `{to}`: {}",
                    row.because
                )),
                (Kind::Normal, None) if to != FACADE => report.faults.push(format!(
                    "{place}: `{from}` may not depend on `{to}`: an example uses what its reader has, \
                     the facade"
                )),
                (Kind::Normal, _) => {}
            }
        }
    }

    match architecture {
        None => report
            .faults
            .push("ARCHITECTURE.md is missing: it must list every crate".to_owned()),
        Some(text) => {
            for package in packages.keys().filter(|package| !listed(text, package)) {
                report.faults.push(format!(
                    "ARCHITECTURE.md:1: `{}` is not listed: give it a line",
                    short(package)
                ));
            }
        }
    }

    report.summary = format!("{} crates, {count} arrows between them", packages.len());
    Ok(report)
}

/// `simbeeotic-kernel` is called `kernel` in the house.
fn short(package: &str) -> &str {
    package.strip_prefix("simbeeotic-").unwrap_or(package)
}

/// True if the text names the crate in backticks: `kernel`, `simbeeotic-kernel`, or by its folder.
fn listed(text: &str, package: &str) -> bool {
    let name = short(package);
    [
        format!("`{name}`"),
        format!("`{package}`"),
        format!("`crates/{name}`"),
        format!("`crates/{name}/`"),
    ]
    .iter()
    .any(|word| text.contains(word))
}

/// Keys of `[workspace.dependencies]` whose package has another name.
fn workspace_renames(root: &str) -> Result<BTreeMap<String, String>> {
    let document = DeTable::parse(root).context("Cargo.toml")?;
    let Some(DeValue::Table(dependencies)) = document
        .get_ref()
        .get("workspace")
        .and_then(|workspace| workspace.get_ref().get("dependencies"))
        .map(|dependencies| dependencies.get_ref())
    else {
        return Ok(BTreeMap::new());
    };

    Ok(dependencies
        .iter()
        .filter_map(|(key, value)| {
            let package = value.get_ref().get("package")?.get_ref().as_str()?;
            Some((key.get_ref().to_string(), package.to_owned()))
        })
        .collect())
}

/// All dependencies of a manifest, those of its targets included.
fn edges(manifest: &DeTable<'_>, text: &str, renames: &BTreeMap<String, String>) -> Vec<Edge> {
    let mut found = Vec::new();
    edges_of(manifest, text, renames, &mut found);
    if let Some(DeValue::Table(targets)) = manifest.get("target").map(|value| value.get_ref()) {
        for target in targets
            .values()
            .filter_map(|value| value.get_ref().as_table())
        {
            edges_of(target, text, renames, &mut found);
        }
    }
    found
}

fn edges_of(
    table: &DeTable<'_>,
    text: &str,
    renames: &BTreeMap<String, String>,
    found: &mut Vec<Edge>,
) {
    let sections = [
        ("dependencies", Kind::Normal),
        ("build-dependencies", Kind::Normal),
        ("dev-dependencies", Kind::Dev),
    ];
    for (section, kind) in sections {
        let Some(DeValue::Table(dependencies)) = table.get(section).map(|value| value.get_ref())
        else {
            continue;
        };
        for (key, value) in dependencies {
            let name = key.get_ref().as_ref();
            let package = value
                .get_ref()
                .get("package")
                .and_then(|package| package.get_ref().as_str())
                .or_else(|| renames.get(name).map(String::as_str))
                .unwrap_or(name);
            found.push(Edge {
                to: package.to_owned(),
                kind,
                line: text[..key.span().start].matches('\n').count() + 1,
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOT: &str = "[workspace]\nmembers = []\n[workspace.dependencies]\n";

    fn manifest(name: &str, rest: &str) -> Manifest {
        let folder = short(name);
        Manifest {
            path: format!("crates/{folder}/Cargo.toml"),
            text: format!("[package]\nname = \"{name}\"\n\n{rest}"),
        }
    }

    /// A small house: two crates that stand right, and the one under test.
    fn house(name: &str, rest: &str) -> Vec<Manifest> {
        let mut members = vec![
            manifest("simbeeotic-units", ""),
            manifest(
                "simbeeotic-kernel",
                "[dependencies]\nsimbeeotic-units.workspace = true\n",
            ),
            manifest("simbeeotic-models", ""),
            manifest("simbeeotic", ""),
        ];
        members.retain(|member| !member.text.contains(&format!("\"{name}\"")));
        members.push(manifest(name, rest));
        members
    }

    fn faults(members: &[Manifest]) -> Vec<String> {
        let text =
            "`units` `kernel` `physics` `models` `scenario` `record` `simbeeotic` `attic` `hello`";
        judge(ROOT, members, Some(text)).unwrap().faults
    }

    #[test]
    fn the_table_itself_points_down() {
        let mut below: Vec<&str> = Vec::new();
        for row in TABLE {
            for seen in row.sees {
                assert!(
                    below.contains(seen),
                    "{} sees {seen}, which is not below",
                    row.name
                );
            }
            below.push(row.name);
        }
    }

    #[test]
    fn the_promises_of_the_design_are_in_the_table() {
        let sees = |name: &str, other: &str| {
            let row = TABLE.iter().find(|row| row.name == name).unwrap();
            row.sees.contains(&other)
        };
        assert!(!sees("physics", "radio") && !sees("radio", "physics"));
        assert!(!sees("world", "physics"));
        assert!(!sees("record", "kernel") && !sees("view", "kernel"));
        assert!(!sees("view", "physics") && !sees("view", "scenario"));
        for row in TABLE {
            let is_facade = row.name == FACADE;
            assert_eq!(row.sees.contains(&"models"), is_facade, "{}", row.name);
        }
    }

    #[test]
    fn a_good_graph_passes() {
        let members = house(
            "simbeeotic-physics",
            "[dependencies]\nsimbeeotic-kernel.workspace = true\nlibm = \"0.2\"\n",
        );
        assert_eq!(faults(&members), Vec::<String>::new());
    }

    #[test]
    fn an_arrow_up_fails_with_file_and_line() {
        let members = house(
            "simbeeotic-units",
            "[dependencies]\nlibm = \"0.2\"\nsimbeeotic-kernel = { path = \"../kernel\" }\n",
        );
        let faults = faults(&members);
        assert_eq!(faults.len(), 1);
        assert!(
            faults[0].starts_with("crates/units/Cargo.toml:6: `units` may not depend on `kernel`"),
            "{}",
            faults[0]
        );
    }

    #[test]
    fn a_scenario_may_not_see_the_shelf() {
        let members = house(
            "simbeeotic-scenario",
            "[dependencies]\nsimbeeotic-models.workspace = true\n",
        );
        assert!(faults(&members)[0].contains("the registry finds them"));
    }

    #[test]
    fn a_renamed_dependency_is_seen_through() {
        let members = house(
            "simbeeotic-record",
            "[dependencies]\nengine = { package = \"simbeeotic-kernel\", path = \"../kernel\" }\n",
        );
        assert!(faults(&members)[0].contains("`record` may not depend on `kernel`"));

        let root = format!("{ROOT}engine = {{ package = \"simbeeotic-kernel\", path = \"x\" }}\n");
        let members = house(
            "simbeeotic-record",
            "[dependencies]\nengine.workspace = true\n",
        );
        let report = judge(&root, &members, Some("")).unwrap();
        assert!(report.faults[0].contains("`record` may not depend on `kernel`"));
    }

    #[test]
    fn dependencies_of_a_target_and_of_the_build_count() {
        for section in ["target.'cfg(unix)'.dependencies", "build-dependencies"] {
            let members = house(
                "simbeeotic-record",
                &format!("[{section}]\nsimbeeotic-kernel.workspace = true\n"),
            );
            assert_eq!(faults(&members).len(), 1, "{section}");
        }
    }

    #[test]
    fn dev_dependencies_are_free_except_on_the_facade() {
        let free = "[dev-dependencies]\nsimbeeotic-models.workspace = true\n";
        assert!(faults(&house("simbeeotic-physics", free)).is_empty());

        let facade = "[dev-dependencies]\nsimbeeotic.workspace = true\n";
        let faults = faults(&house("simbeeotic-physics", facade));
        assert!(
            faults[0].contains("crates/physics/Cargo.toml:5: `physics` has the facade"),
            "{}",
            faults[0]
        );
    }

    #[test]
    fn a_crate_without_a_row_fails() {
        let faults = faults(&house("simbeeotic-attic", ""));
        assert!(faults[0].contains("`attic` has no row"), "{}", faults[0]);
    }

    #[test]
    fn an_example_sees_the_facade_only() {
        let mut members = house("simbeeotic-physics", "");
        let mut example = manifest("hello", "[dependencies]\nsimbeeotic.workspace = true\n");
        example.path = "examples/hello/Cargo.toml".to_owned();
        members.push(example.clone());
        assert_eq!(faults(&members), Vec::<String>::new());

        example
            .text
            .push_str("simbeeotic-kernel.workspace = true\n");
        *members.last_mut().unwrap() = example;
        assert!(faults(&members)[0].contains("`hello` may not depend on `kernel`"));
    }

    #[test]
    fn a_crate_that_the_architecture_forgets_fails() {
        let members = house("simbeeotic-physics", "");
        let text = "the map: `units`, `crates/kernel/`, `simbeeotic-models`, `simbeeotic`; physics";
        let report = judge(ROOT, &members, Some(text)).unwrap();
        assert_eq!(
            report.faults,
            ["ARCHITECTURE.md:1: `physics` is not listed: give it a line"]
        );
        let report = judge(ROOT, &members, None).unwrap();
        assert_eq!(report.faults.len(), 1);
    }
}
