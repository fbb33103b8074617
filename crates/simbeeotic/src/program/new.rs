//! `simbeeotic new`: a crate with one behaviour, one scenario and one test.

use super::{Failure, say};
use std::fs;
use std::path::{Path, PathBuf};

/// Makes the crate `name` in the folder `path`.
pub(super) fn new(name: &str, path: Option<&Path>, library: Option<&Path>) -> Result<(), Failure> {
    check_name(name)?;
    let folder = path.map_or_else(|| PathBuf::from(name), Path::to_owned);
    if folder.exists() {
        return Err(Failure::input(format!(
            "{} is there already; choose another name",
            folder.display()
        )));
    }
    let dependency = dependency(library)?;
    let files = [
        ("Cargo.toml", include_str!("template/Cargo.toml.txt")),
        ("src/lib.rs", include_str!("template/lib.rs.txt")),
        ("src/main.rs", include_str!("template/main.rs.txt")),
        (
            "src/orbit_bee.rs",
            include_str!("template/orbit_bee.rs.txt"),
        ),
        ("tests/orbit.rs", include_str!("template/orbit.rs.txt")),
        (
            "scenarios/orbit.toml",
            include_str!("template/orbit.toml.txt"),
        ),
        ("README.md", include_str!("template/README.md.txt")),
        (".gitignore", "/target\n*.mcap\n"),
    ];
    for (path, text) in files {
        let path = folder.join(path);
        let text = text
            .replace("{{name}}", name)
            .replace("{{crate}}", &name.replace('-', "_"))
            .replace("{{dependency}}", &dependency);
        let written = path
            .parent()
            .map_or(Ok(()), fs::create_dir_all)
            .and_then(|()| fs::write(&path, text));
        written.map_err(|e| Failure::run(format!("cannot write {}: {e}", path.display())))?;
    }
    say(format!(
        "made {0}: a behaviour, a scenario, a test\n\n  cd {0}\n  cargo test\n  cargo run -- run scenarios/orbit.toml\n",
        folder.display()
    ))
}

/// Cargo's rules for a package name, and a bit stricter: it becomes a Rust path too.
fn check_name(name: &str) -> Result<(), Failure> {
    let fits = name.starts_with(|c: char| c.is_ascii_lowercase())
        && name
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '_');
    if !fits {
        return Err(Failure::input(format!(
            "`{name}` cannot name a crate: use small letters, digits and dashes, such as my-swarm"
        )));
    }
    if RESERVED.contains(&name) {
        return Err(Failure::input(format!(
            "`{name}` is reserved: Rust, Cargo or Simbeeotic uses that name itself; choose another, such as my-{name}"
        )));
    }
    Ok(())
}

/// Crates that are there already, folders that Cargo makes, and Rust's keywords.
#[rustfmt::skip]
const RESERVED: [&str; 65] = [
    "simbeeotic", "test", "core", "std", "alloc", "proc_macro", "proc-macro",
    "deps", "examples", "build", "incremental",
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate",
    "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl",
    "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref",
    "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "union", "unsafe", "unsized", "use", "virtual", "where", "while", "yield", "raw", "safe",
];

/// Where the new crate finds Simbeeotic: the folder this program was built from, unless told.
fn dependency(library: Option<&Path>) -> Result<String, Failure> {
    let built_from = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path: PathBuf = library.unwrap_or(built_from).to_owned();
    match path.join("Cargo.toml").canonicalize() {
        Ok(manifest) => {
            let folder = manifest.parent().unwrap_or(&path).display().to_string();
            Ok(format!("{{ path = {folder:?} }}"))
        }
        Err(_) if library.is_none() => Ok(format!("{:?}", env!("CARGO_PKG_VERSION"))),
        Err(e) => Err(Failure::input(format!(
            "no crate in {}: {e}; --library names the folder of the simbeeotic crate",
            path.display()
        ))),
    }
}
