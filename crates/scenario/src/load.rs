//! From a file, or a text, to a checked scenario; from that to a run.

use crate::plan::{self, Context, Plan, folder_of, group};
use crate::print::to_toml;
use crate::sweep::{self, Fixed, Sweep};
use crate::variables::Variables;
use crate::xml::{self, Document};
use simbeeotic_model::component::Component;
use simbeeotic_model::config::{Fault, Node, SourceId, Sources, Span};
use simbeeotic_model::registry::{Make, Site};
use simbeeotic_model::world::{Calm, Weather};
use simbeeotic_model::{Origin, Setup};
use simbeeotic_world::World;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What is asked for besides the scenario itself.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// A world file that replaces the scenario's.
    pub world: Option<PathBuf>,
    /// Values that are changed: `run.end_time=5 s`. See [`crate::set`].
    pub sets: Vec<String>,
}

/// A scenario before a plan is made of it: what all runs of a sweep have in common.
#[derive(Clone, Debug)]
pub(crate) struct Base {
    name: String,
    /// The scenario without its sweep, placeholders in it.
    pub(crate) tree: Node,
    /// Variables that do not stand in the tree.
    pub(crate) given: Variables,
    pub(crate) folder: PathBuf,
    pub(crate) world: Option<PathBuf>,
    sources: Sources,
}

/// A scenario that can run.
pub struct Loaded {
    name: String,
    plan: Plan,
    tree: Node,
    faults: Vec<Fault>,
    sources: Sources,
    variables: Variables,
    sweep: Option<Varied>,
}

/// What varies in a scenario.
struct Varied {
    sweep: Sweep,
    /// The scenario with its sweep.
    whole: Node,
    /// Whether it has the values of the sweep's first run.
    is_first: bool,
}

/// A scenario that cannot run, and why.
#[derive(Debug)]
pub struct Rejected {
    /// Everything that is wrong with it, in the order of the text; warnings and notes too.
    pub faults: Vec<Fault>,
    /// The texts that the faults point into.
    pub sources: Sources,
}

/// A scenario or a world as TOML.
#[derive(Debug)]
pub struct Converted {
    /// The text.
    pub toml: String,
    /// Warnings and notes.
    pub faults: Vec<Fault>,
    /// The texts that the faults point into.
    pub sources: Sources,
    /// The variables of a scenario, for its world. Of a world: none.
    pub variables: Variables,
}

/// What was found in a file: a scenario or a world.
pub enum Checked {
    /// A scenario that can run.
    Scenario(Box<Loaded>),
    /// A world alone.
    World {
        /// What it is called: its file.
        name: String,
        /// The world.
        world: Box<World>,
        /// Warnings and notes.
        faults: Vec<Fault>,
        /// The texts that the faults point into.
        sources: Sources,
    },
}

/// Reads and checks a scenario file, or a world file given alone.
///
/// # Errors
/// Everything that is wrong with it.
pub fn check_file(path: &Path, request: &Request) -> Result<Checked, Rejected> {
    let mut reading = Reading::default();
    let text = read_text(path, None, &mut reading.sources, &mut reading.faults);
    let Some((source, text)) = text else {
        return Err(reading.reject());
    };
    if !xml::looks_like_xml(&text)
        && let Ok(tree) = crate::toml::parse(&text, source)
    {
        let faults = crate::world::neither(&tree);
        if !faults.is_empty() {
            reading.faults.extend(faults);
            return Err(reading.reject());
        }
    }
    let is_world = match xml::looks_like_xml(&text) {
        true => xml::root_name(&text, source).as_deref() == Some("world"),
        false => crate::toml::parse(&text, source).is_ok_and(|tree| crate::world::is_world(&tree)),
    };
    match is_world {
        true => reading.world(path, &text, source, request),
        false => reading
            .load(&text, source, folder_of(path), request)
            .map(|loaded| Checked::Scenario(Box::new(loaded))),
    }
}

/// The error that a world stands where a scenario is wanted.
pub(crate) fn world_where_scenario(span: Span) -> Fault {
    Fault::error(span, "this is a world, and a scenario is wanted").help(
        "a scenario names it, `world = \"FILE\"`, or `--world FILE` does; `simbeeotic check` takes it alone",
    )
}

/// Reads and checks a scenario file: TOML, or the original's XML.
///
/// Files that it names are looked for in its own folder.
///
/// # Errors
/// Everything that is wrong with it.
pub fn load_file(path: &Path, request: &Request) -> Result<Loaded, Rejected> {
    let mut reading = Reading::default();
    let text = read_text(path, None, &mut reading.sources, &mut reading.faults);
    match text {
        Some((source, text)) => reading.load(&text, source, folder_of(path), request),
        None => Err(reading.reject()),
    }
}

/// Reads and checks a scenario in a text; `name` is what errors call it.
///
/// Files that it names are looked for in the folder that the program runs in.
///
/// # Errors
/// Everything that is wrong with it.
pub fn load_text(name: &str, text: &str, request: &Request) -> Result<Loaded, Rejected> {
    let mut reading = Reading::default();
    let source = reading.sources.add(name, text);
    reading.load(text, source, PathBuf::new(), request)
}

/// Reads and checks a scenario file and gives it as TOML. `world` is its world file, TOML or XML;
/// the scenario shall name it as TOML, beside it.
///
/// # Errors
/// Everything that is wrong with it.
pub fn convert_file(path: &Path, world: Option<&Path>) -> Result<Converted, Rejected> {
    let request = Request {
        world: world.map(Path::to_path_buf),
        sets: Vec::new(),
    };
    let mut loaded = load_file(path, &request)?;
    let world = world.map(|path| path.with_extension("toml"));
    if let Some(name) = world.as_deref().and_then(Path::file_name) {
        let node = Node::string(Span::default(), name.to_string_lossy());
        let whole = loaded.sweep.as_mut().map(|varied| &mut varied.whole);
        if let Some(table) = whole.unwrap_or(&mut loaded.tree).as_table_mut() {
            table.set("world", node);
        }
    }
    let Loaded {
        tree,
        faults,
        sources,
        variables,
        sweep,
        ..
    } = loaded;
    let whole = sweep.map_or(tree, |varied| varied.whole);
    Ok(Converted {
        toml: to_toml(&whole),
        faults,
        sources,
        variables,
    })
}

/// Reads and checks a world file and gives it as TOML, with the values of `variables` in the place of
/// placeholders.
///
/// # Errors
/// Everything that is wrong with it.
pub fn convert_world(path: &Path, variables: &Variables) -> Result<Converted, Rejected> {
    let Reading {
        mut sources,
        mut faults,
    } = Reading::default();
    let text = read_text(path, None, &mut sources, &mut faults);
    let node =
        text.and_then(|(source, text)| crate::world::tree(&text, source, variables, &mut faults));
    let node =
        node.filter(|node| crate::world::check(node, &folder_of(path), &mut faults).is_some());
    match node {
        Some(node) => Ok(Converted {
            toml: to_toml(&node),
            faults,
            sources,
            variables: Variables::default(),
        }),
        None => Err(Rejected { faults, sources }),
    }
}

#[derive(Default)]
struct Reading {
    sources: Sources,
    faults: Vec<Fault>,
}

impl Reading {
    fn load(
        mut self,
        text: &str,
        source: SourceId,
        folder: PathBuf,
        request: &Request,
    ) -> Result<Loaded, Rejected> {
        if let Some(fault) = empty(text, source) {
            self.faults.push(fault);
            return Err(self.reject());
        }
        let mut variables = Variables::default();
        let read = if xml::looks_like_xml(text) {
            xml::parse(text, source, Document::Scenario, &mut variables)
        } else {
            crate::toml::parse(text, source).map(|node| (node, Vec::new()))
        };
        let mut tree = match read {
            Ok((tree, warnings)) => {
                self.faults.extend(warnings);
                tree
            }
            Err(faults) => {
                self.faults.extend(faults);
                return Err(self.reject());
            }
        };
        let fixed = Fixed {
            from: SourceId(self.sources.iter().count() as u32),
        };
        for argument in &request.sets {
            if let Err(faults) = crate::set::apply(&mut tree, argument, &mut self.sources) {
                self.faults.extend(faults);
            }
        }
        if crate::world::is_world(&tree) {
            let first = tree.as_table().and_then(|table| table.entries.first());
            let span = first.map_or(tree.span, |(key, _)| key.span);
            self.faults.push(world_where_scenario(span));
            return Err(self.reject());
        }
        let whole = tree.clone();
        let draft = sweep::read(&mut tree, fixed, &mut self.faults);
        let base = Base {
            name: self.sources.get(source).map_or("", |s| &s.name).to_owned(),
            tree,
            given: variables,
            folder,
            world: request.world.clone(),
            sources: self.sources,
        };
        let Some(draft) = draft else {
            return base.plan(base.tree.clone(), self.faults);
        };
        let sweep = match sweep::expand(draft, base.clone(), &mut self.faults) {
            Ok(sweep) => sweep,
            Err(tree) => return base.plan(tree, self.faults),
        };
        let first = sweep.tree(0, &mut self.faults);
        let mut is_first = crate::print::same(&base.tree, &first);
        // A scenario is what stands in it; one that lacks a value of its sweep is the first of its runs.
        let mut loaded = base.plan(base.tree.clone(), self.faults.clone());
        if loaded.is_err() {
            is_first = true;
            loaded = base.plan(first, self.faults);
        }
        match loaded {
            Ok(mut loaded) => {
                loaded.sweep = Some(Varied {
                    sweep,
                    whole,
                    is_first,
                });
                Ok(loaded)
            }
            Err(mut rejected) => {
                // The other values may be wrong, too.
                let others = sweep.check_but(&rejected.faults).err();
                rejected
                    .faults
                    .extend(others.into_iter().flat_map(|r| r.faults));
                rejected.faults.sort_by_key(|fault| fault.span);
                Err(rejected)
            }
        }
    }

    /// A world alone. `--set variables.NAME=VALUE` says what its placeholders stand for; other settings
    /// change it.
    fn world(
        mut self,
        path: &Path,
        text: &str,
        source: SourceId,
        request: &Request,
    ) -> Result<Checked, Rejected> {
        let mut settings = Node::table(Span::default());
        for argument in &request.sets {
            if let Err(faults) = crate::set::apply(&mut settings, argument, &mut self.sources) {
                self.faults.extend(faults);
            }
        }
        let others = settings.as_table().into_iter().flat_map(|t| &t.entries);
        for (key, _) in others.filter(|(key, _)| key.text != crate::variables::KEY) {
            let fault = Fault::error(key.span, "this file is a world, not a scenario");
            let help = "of a world alone only its variables are set: --set variables.NAME=VALUE";
            self.faults.push(fault.help(help));
        }
        let given = Variables::of(&settings, &mut self.faults);
        let node = crate::world::tree(text, source, &given, &mut self.faults);
        let folder = folder_of(path);
        let world = node.and_then(|node| crate::world::check(&node, &folder, &mut self.faults));
        self.faults.sort_by_key(|f| f.span);
        match world {
            Some(world) if !self.faults.iter().any(Fault::is_error) => Ok(Checked::World {
                name: self.sources.get(source).map_or("", |s| &s.name).to_owned(),
                world: Box::new(world),
                faults: self.faults,
                sources: self.sources,
            }),
            _ => Err(self.reject()),
        }
    }

    fn reject(mut self) -> Rejected {
        if !self.faults.iter().any(Fault::is_error) {
            self.faults
                .push(Fault::error(None, "this scenario cannot be read"));
        }
        Rejected {
            faults: self.faults,
            sources: self.sources,
        }
    }
}

impl Base {
    /// Makes a plan of a tree without a sweep; `faults` were found before.
    pub(crate) fn plan(&self, mut tree: Node, faults: Vec<Fault>) -> Result<Loaded, Rejected> {
        let mut reading = Reading {
            sources: self.sources.clone(),
            faults,
        };
        let mut variables = self.given.clone();
        variables.extend(Variables::of(&tree, &mut reading.faults));
        variables.apply(&mut tree, &mut reading.faults);
        crate::like::apply(&mut tree, &mut reading.faults);
        let mut cx = Context {
            faults: std::mem::take(&mut reading.faults),
            sources: &mut reading.sources,
            folder: self.folder.clone(),
            world: self.world.clone(),
            areas: None,
            variables: variables.clone(),
        };
        let plan = plan::plan(&tree, &mut cx);
        reading.faults = cx.faults;
        let said = |span: Span| {
            let source = reading.sources.get(span.source);
            source.is_some_and(|source| source.name == crate::set::NAME)
        };
        variables.unused(&tree, said, &mut reading.faults);
        crate::like::once(&mut reading.faults);
        reading.faults.sort_by_key(|f| f.span);
        match plan {
            Some(plan) if !reading.faults.iter().any(Fault::is_error) => Ok(Loaded {
                name: self.name.clone(),
                plan,
                tree,
                faults: reading.faults,
                sources: reading.sources,
                variables,
                sweep: None,
            }),
            _ => Err(reading.reject()),
        }
    }
}

impl Loaded {
    /// What the scenario is called: its file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What varies, if something does. All else is of the scenario as it stands, without its sweep.
    pub fn sweep(&self) -> Option<&Sweep> {
        self.sweep.as_ref().map(|varied| &varied.sweep)
    }

    /// Whether its values are those of the first run of its sweep. So it is if they stand in it; if it is XML,
    /// whose variables have no values beside those that vary; and if it lacks a value that only its sweep
    /// has.
    pub fn is_first_of_sweep(&self) -> bool {
        self.sweep.as_ref().is_some_and(|varied| varied.is_first)
    }

    /// The scenario, checked.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The scenario as a tree, as it stands after all changes.
    pub fn tree(&self) -> &Node {
        &self.tree
    }

    /// The scenario as TOML, as it stands after all changes.
    pub fn toml(&self) -> String {
        to_toml(&self.tree)
    }

    /// The same with what varies, and with placeholders; of a scenario without a sweep as
    /// [`toml`](Self::toml).
    pub fn toml_with_sweep(&self) -> String {
        match &self.sweep {
            Some(varied) => to_toml(&varied.whole),
            None => self.toml(),
        }
    }

    /// Warnings and notes.
    pub fn faults(&self) -> &[Fault] {
        &self.faults
    }

    /// The texts that faults point into.
    pub fn sources(&self) -> &Sources {
        &self.sources
    }

    /// What a run of it is made of. May be called again for another run.
    ///
    /// # Errors
    /// A part that could be made when the scenario was checked cannot be made any more.
    pub fn setup(&self) -> Result<Setup, Vec<Fault>> {
        let plan = &self.plan;
        let run = &plan.run;
        let mut faults = Vec::new();
        let site = Site {
            seed: run.seed,
            folder: &plan.folder,
        };
        let medium = plan.channel.as_ref().map(|channel| channel.medium(&site));
        let medium = match medium.transpose() {
            Ok(medium) => medium.flatten(),
            Err(found) => {
                faults.extend(found);
                None
            }
        };
        let weather = plan.weather.as_ref().map(|choice| match choice.part.make {
            Make::Weather(make) => make(&choice.params, &site),
            _ => Ok(Arc::new(Calm) as Arc<dyn Weather>),
        });
        let weather = match weather.transpose() {
            Ok(weather) => weather.unwrap_or_else(|| Arc::new(Calm)),
            Err(found) => {
                faults.extend(found);
                Arc::new(Calm)
            }
        };
        let mut components: Vec<(String, Box<dyn Component>)> = Vec::new();
        for choice in &plan.components {
            let Make::Component(make) = choice.part.make else {
                continue;
            };
            match make(&choice.params) {
                Ok(component) => components.push((choice.part.label.name.to_owned(), component)),
                Err(found) => faults.extend(found),
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let name = if plan.name.is_empty() {
            &self.name
        } else {
            &plan.name
        };
        Ok(Setup {
            origin: Origin {
                name: name.clone(),
                scenario: self.toml(),
                seed: run.seed,
                version: env!("CARGO_PKG_VERSION").to_owned(),
            },
            limits: run.limits.clone(),
            threads: run.threads,
            pace: run.pace,
            physics: plan.physics,
            medium,
            weather,
            world: Arc::clone(&plan.world),
            models: group::models(&plan.models, run.seed),
            components,
        })
    }
}

/// An error if nothing stands in a text.
pub(crate) fn empty(text: &str, source: SourceId) -> Option<Fault> {
    let bare = text.trim_start_matches('\u{feff}').trim();
    bare.is_empty()
        .then(|| Fault::error(Span::new(source, 0, 0), "this file is empty"))
}

/// The text of a file, and the id that its spans carry. `asked` is where another file names it.
pub(crate) fn read_text(
    path: &Path,
    asked: Option<Span>,
    sources: &mut Sources,
    faults: &mut Vec<Fault>,
) -> Option<(SourceId, Arc<str>)> {
    let name = path.display().to_string();
    let bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) => {
            faults.push(Fault::error(asked, format!("cannot read {name}: {error}")));
            return None;
        }
    };
    match String::from_utf8(bytes) {
        Ok(text) => {
            let text: Arc<str> = text.into();
            Some((sources.add(name, Arc::clone(&text)), text))
        }
        Err(error) => {
            let at = error.utf8_error().valid_up_to();
            let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
            let source = sources.add(name, text);
            let fault = Fault::error(Span::new(source, at, at), "from here on this is not UTF-8");
            faults.push(fault.help("save the file as UTF-8"));
            None
        }
    }
}
