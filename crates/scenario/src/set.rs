//! `--set path=value`: one value of a scenario, changed from the command line.
//!
//! ```text
//! --set run.end_time="5 s"                        quotes around text may be left out
//! --set channel.range_limit=30m
//! --set model.bee.params.heading_sigma="0.1 rad"  models by their name, or by their place from 0
//! --set model.bee.sensor.compass.sigma="1 deg"
//! --set component.viewer.port=8080                components by what they use
//! ```
//! Each argument is a text of its own, so that a fault in it shows the argument, whether it is
//! found here or when the part reads its parameters.
//!
//! What varies is said in the same way:
//! ```text
//! --vary model.bee.count=10,20,50                 [sweep.vary] "model.bee.count" = [10, 20, 50]
//! --vary "channel.range_limit=10 m..50 m step 10 m"
//! --seeds 10    --seeds 1..20    --seeds 3,5,8    [sweep] seeds
//! ```

use crate::{like, sweep};
use simbeeotic_model::config::{Fault, Key, Node, SourceId, Sources, Span, Table, Value};

/// What errors call the place that arguments come from.
pub(crate) const NAME: &str = "command line";
/// What stands before an argument in the text that errors show.
const FLAG: &str = "--set ";
/// The same, of one that says what varies.
pub const VARY: &str = "--vary ";
/// The same, of one that says the seeds.
pub const SEEDS: &str = "--seeds ";

/// The same, of one that says the seed.
pub const SEED: &str = "--seed ";
/// The same, of one that says when the run ends.
pub const END_TIME: &str = "--end-time ";
/// Options for single values, and the paths of these.
const SHORT: [(&str, [&str; 2]); 2] = [(SEED, ["run", "seed"]), (END_TIME, ["run", "end_time"])];

/// Changes the tree of a scenario as one argument, `path=value`, says. One that begins with [`SEED`] or
/// [`END_TIME`] has a value alone; one that begins with [`VARY`] or [`SEEDS`] changes what the scenario sweeps
/// over.
///
/// # Errors
/// The argument is not of this form, or its path leads nowhere.
pub fn apply(root: &mut Node, argument: &str, sources: &mut Sources) -> Result<(), Vec<Fault>> {
    if let Some(text) = argument.strip_prefix(SEEDS) {
        let source = sources.add(NAME, argument);
        let value = several(text, source, SEEDS.len())?;
        let value = match &value.value {
            // A number alone says how many.
            Value::Array(items) if items.len() == 1 => items[0].clone(),
            _ => value,
        };
        return sweep_table(root, value.span, None)
            .map(|table| table.set(sweep::SEEDS, value))
            .map_err(|fault| vec![fault]);
    }
    for (flag, path) in SHORT {
        if let Some(text) = argument.strip_prefix(flag) {
            let source = sources.add(NAME, argument);
            let key = |word: &str| Key {
                text: word.to_owned(),
                span: Span::new(source, 0, flag.len() - 1),
            };
            let value = value(text, source, flag.len())?;
            return place(root, &path.map(key), value).map_err(|fault| vec![fault]);
        }
    }
    let (flag, argument, example) = match argument.strip_prefix(VARY) {
        Some(rest) => (VARY, rest, "--vary \"model.bee.count=10,20,50\""),
        None => (FLAG, argument, "--set run.end_time=\"5 s\""),
    };
    let source = sources.add(NAME, format!("{flag}{argument}"));
    let whole = Span::new(source, flag.len(), flag.len() + argument.len());
    let Some(equals) = equals_sign(argument) else {
        let fault = Fault::error(whole, "there is no `=` between a path and a value");
        return Err(vec![fault.help(format!("for example: {example}"))]);
    };
    let (path, text) = (&argument[..equals], &argument[equals + 1..]);
    let keys = split(path, flag.len(), source)?;
    let value_start = flag.len() + equals + 1;
    if flag == VARY {
        let value = several(text, source, value_start)?;
        let key = Key {
            text: path.trim().to_owned(),
            span: Span::new(source, flag.len(), flag.len() + path.len()),
        };
        let vary = sweep_table(root, value.span, Some(sweep::VARY)).map_err(|fault| vec![fault])?;
        let before = vary.get(&key.text).map(|node| node.span.source);
        if before.is_some_and(|id| sources.get(id).is_some_and(|source| source.name == NAME)) {
            let message = format!("a second `--vary {}`: a key varies once", key.text);
            return Err(vec![Fault::error(key.span, message)]);
        }
        vary.insert(key, value);
        return Ok(());
    }
    let value = value(text, source, value_start)?;
    place(root, &keys, value).map_err(|fault| vec![fault])
}

/// The table `[sweep]`, or one in it, made if it is not there.
fn sweep_table<'n>(
    root: &'n mut Node,
    span: Span,
    inner: Option<&str>,
) -> Result<&'n mut Table, Fault> {
    let mut node = root;
    for word in [Some(sweep::KEY), inner].into_iter().flatten() {
        let there = node.span;
        let table = node.as_table_mut();
        let table = table.ok_or_else(|| Fault::error(there, "a table is wanted here"))?;
        if table.get(word).is_none() {
            table.set(word, Node::table(span));
        }
        node = match table.get_mut(word) {
            Some(node) => node,
            None => return Err(Fault::error(span, "a table is wanted here")),
        };
    }
    let there = node.span;
    let table = node.as_table_mut();
    table.ok_or_else(|| Fault::error(there, "a table is wanted here"))
}

/// Several values: a list or a table as in TOML; values with commas between them; or a range,
/// `10 m..50 m step 10 m`.
fn several(text: &str, source: SourceId, start: usize) -> Result<Node, Vec<Fault>> {
    let whole = Span::new(source, start, start + text.len());
    if text.trim().is_empty() {
        return Err(vec![Fault::error(whole, "there is no value here")]);
    }
    if text.trim_start().starts_with(['[', '{']) && between_commas(text).len() == 1 {
        return value(text, source, start);
    }
    if let Some((from, rest)) = text.split_once("..")
        && sweep::split_quantity(from).is_some()
    {
        let (to, step) = match rest.split_once("step") {
            Some((to, step)) if !step.starts_with(char::is_alphabetic) => (to, Some(step)),
            _ => (rest, None),
        };
        let mut table = Table::default();
        table.set("from", value(from, source, start)?);
        let to_start = start + from.len() + 2;
        table.set("to", value(to, source, to_start)?);
        if let Some(step) = step {
            let step_start = to_start + to.len() + "step".len();
            table.set("step", value(step, source, step_start)?);
        }
        return Ok(Node::new(whole, Value::Table(table)));
    }
    let mut from = start;
    let mut items = Vec::new();
    for part in between_commas(text) {
        items.push(value(part, source, from)?);
        from += part.len() + 1;
    }
    Ok(Node::new(whole, Value::Array(items)))
}

/// The pieces of a text between its commas, but for those inside of quotes and brackets.
fn between_commas(text: &str) -> Vec<&str> {
    let mut quote = None;
    let (mut depth, mut from) = (0_i32, 0);
    let mut pieces = Vec::new();
    let mut letters = text.char_indices();
    while let Some((at, letter)) = letters.next() {
        match (letter, quote) {
            // What a backslash stands before in TOML's basic text.
            ('\\', Some('"')) => {
                letters.next();
            }
            // Of `bee's` the quote is a letter.
            ('"' | '\'', None) if depth > 0 || text[from..at].trim().is_empty() => {
                quote = Some(letter);
            }
            (letter, Some(open)) if letter == open => quote = None,
            ('[' | '{', None) => depth += 1,
            (']' | '}', None) => depth -= 1,
            (',', None) if depth <= 0 => {
                pieces.push(&text[from..at]);
                from = at + 1;
            }
            _ => {}
        }
    }
    pieces.push(&text[from..]);
    pieces
}

/// The first `=` that is not inside of quotes.
fn equals_sign(argument: &str) -> Option<usize> {
    let mut quote = None;
    for (at, letter) in argument.char_indices() {
        match (letter, quote) {
            ('"' | '\'', None) => quote = Some(letter),
            (letter, Some(open)) if letter == open => quote = None,
            ('=', None) => return Some(at),
            _ => {}
        }
    }
    None
}

/// The keys of a path: words with dots between them, in quotes if they have dots themselves.
/// The text that faults show has them from byte `start` on.
pub(crate) fn split(path: &str, start: usize, source: SourceId) -> Result<Vec<Key>, Vec<Fault>> {
    let mut keys = Vec::new();
    let mut from = 0;
    let mut quote = None;
    let ends = path.char_indices().chain([(path.len(), '.')]);
    for (at, letter) in ends {
        match (letter, quote) {
            ('"' | '\'', None) => quote = Some(letter),
            (letter, Some(open)) if letter == open => quote = None,
            ('.', None) => {
                keys.push(key(&path[from..at], start + from, source)?);
                from = at + 1;
            }
            _ => {}
        }
    }
    match quote {
        None => Ok(keys),
        Some(_) => {
            let span = Span::new(source, start, start + path.len());
            Err(vec![Fault::error(
                span,
                "a quote in this path is never closed",
            )])
        }
    }
}

fn key(word: &str, from: usize, source: SourceId) -> Result<Key, Vec<Fault>> {
    let span = Span::new(source, from, from + word.len());
    let bare = word.trim();
    let inner = ['"', '\'']
        .iter()
        .find_map(|q| bare.strip_prefix(*q)?.strip_suffix(*q));
    let text = inner.unwrap_or(bare);
    if text.is_empty() {
        return Err(vec![Fault::error(span, "a part of this path is empty")]);
    }
    Ok(Key {
        text: text.to_owned(),
        span,
    })
}

/// A value as in TOML; what is none there is text: `5 s` is `"5 s"`.
fn value(text: &str, source: SourceId, start: usize) -> Result<Node, Vec<Fault>> {
    let bare = text.trim();
    let lead = text.len() - text.trim_start().len();
    let span = Span::new(source, start + lead, start + lead + bare.len());
    if bare.is_empty() {
        return Err(vec![Fault::error(span, "there is no value behind the `=`")]);
    }
    match crate::toml::parse_value(bare, source) {
        Ok(mut node) => {
            shift(&mut node, start + lead);
            Ok(node)
        }
        // What starts like a list, a table or text in quotes was meant to be one.
        Err(mut faults) if bare.starts_with(['[', '{', '"', '\'']) => {
            for span in faults.iter_mut().filter_map(|f| f.span.as_mut()) {
                *span = Span::new(source, span.start + start + lead, span.end + start + lead);
            }
            Err(faults)
        }
        Err(_) => Ok(Node::string(span, bare)),
    }
}

fn shift(node: &mut Node, by: usize) {
    let moved = |span: Span| Span::new(span.source, span.start + by, span.end + by);
    node.span = moved(node.span);
    match &mut node.value {
        Value::Table(table) => {
            for (key, node) in &mut table.entries {
                key.span = moved(key.span);
                shift(node, by);
            }
        }
        Value::Array(items) => items.iter_mut().for_each(|n| shift(n, by)),
        _ => {}
    }
}

/// Puts the value at the path, making tables that are not there.
pub(crate) fn place(node: &mut Node, keys: &[Key], value: Node) -> Result<(), Fault> {
    let Some((key, rest)) = keys.split_first() else {
        *node = value;
        return Ok(());
    };
    match &mut node.value {
        Value::Table(table) => {
            if rest.is_empty() {
                table.insert(key.clone(), value);
                return Ok(());
            }
            if table.get(&key.text).is_none() {
                table.insert(key.clone(), Node::table(value.span));
            }
            match table.get_mut(&key.text) {
                Some(inner) => {
                    // A part by its name: the key is one of its table.
                    if let Some(word) = like::name_key(&key.text) {
                        like::into_table(inner, word);
                    }
                    place(inner, rest, value)
                }
                None => Ok(()),
            }
        }
        Value::Array(items) => {
            let at = element(items, key)?;
            place(&mut items[at], rest, value)
        }
        other => {
            let message = format!(
                "`{}` leads into {}, not into a table",
                key.text,
                other.kind()
            );
            Err(Fault::error(key.span, message))
        }
    }
}

/// What stands at a path, if something does.
pub(crate) fn find<'n>(node: &'n Node, keys: &[Key]) -> Option<&'n Node> {
    let Some((key, rest)) = keys.split_first() else {
        return Some(node);
    };
    match &node.value {
        Value::Table(table) => find(table.get(&key.text)?, rest),
        Value::Array(items) => find(&items[element(items, key).ok()?], rest),
        _ => None,
    }
}

/// A path with the elements of lists by their places, so that two paths to one value are equal. From where it
/// leads nowhere on, it is as it was.
pub(crate) fn place_of(root: &Node, keys: &[Key]) -> Vec<String> {
    let mut node = Some(root);
    let step = |key: &Key| {
        let (next, text) = match node.map(|node| &node.value) {
            Some(Value::Table(table)) => (table.get(&key.text), None),
            Some(Value::Array(items)) => match element(items, key) {
                Ok(at) => (items.get(at), Some(at.to_string())),
                Err(_) => (None, None),
            },
            _ => (None, None),
        };
        node = next;
        text.unwrap_or_else(|| key.text.clone())
    };
    keys.iter().map(step).collect()
}

/// Which element of a list a key means: its name, what it uses, or its place.
fn element(items: &[Node], key: &Key) -> Result<usize, Fault> {
    let word = |node: &Node, by: &str| {
        node.as_table()
            .and_then(|t| t.get(by))
            .and_then(Node::as_str)
            .map(str::to_owned)
    };
    let name = |node: &Node| word(node, "name").or_else(|| word(node, "use"));
    let named: Vec<usize> = (0..items.len())
        .filter(|at| name(&items[*at]).as_deref() == Some(&key.text))
        .collect();
    match named.as_slice() {
        [one] => return Ok(*one),
        [] => {}
        several => {
            let message = format!("`{}` means {} entries", key.text, several.len());
            let places: Vec<String> = several.iter().map(ToString::to_string).collect();
            let help = format!("say which by its place: {}", places.join(", "));
            return Err(Fault::error(key.span, message).help(help));
        }
    }
    if let Ok(at) = key.text.parse::<usize>() {
        if at < items.len() {
            return Ok(at);
        }
        let message = format!("there is no entry {at}: the list has {}", items.len());
        return Err(Fault::error(key.span, message));
    }
    let names: Vec<String> = items.iter().filter_map(name).collect();
    Err(Fault::unknown(
        key.span,
        "entry",
        &key.text,
        names.iter().map(String::as_str),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::print::to_toml;
    use crate::render;

    const SCENARIO: &str = r#"
        [run]
        seed = 1
        [channel]
        medium = "simple"
        [[model]]
        use = "simple-hive"
        [[model]]
        use = "instrument-bee"
        name = "bee"
        vehicle = "simple-bee"
        battery = "1s-170mah"
        radio = { use = "cc2420", antenna = "isotropic" }
        [[model]]
        use = "broadcast-bee"
        radio = "cc2420"
        [[component]]
        use = "viewer"
    "#;

    fn set(argument: &str) -> Result<String, String> {
        let mut sources = Sources::new();
        let id = sources.add("x.toml", SCENARIO);
        let mut root = crate::toml::parse(SCENARIO, id).expect("valid");
        match apply(&mut root, argument, &mut sources) {
            Ok(()) => Ok(to_toml(&root)),
            Err(faults) => Err(render::faults(&faults, &sources, false)),
        }
    }

    #[test]
    fn values_are_set_at_their_path() {
        for (argument, line) in [
            ("run.seed=7", "seed = 7"),
            ("run.end_time=5 s", "end_time = \"5 s\""),
            ("run.end_time=\"5 s\"", "end_time = \"5 s\""),
            (
                "channel.noise_floor.sigma = 3 dB",
                "noise_floor = { sigma = \"3 dB\" }",
            ),
            (
                "model.bee.params.heading_sigma=0.1 rad",
                "heading_sigma = \"0.1 rad\"",
            ),
            ("model.simple-hive.params.size=2 m", "size = \"2 m\""),
            (
                "model.0.start=[\"1 m\", \"2 m\", \"0 m\"]",
                "start = [\"1 m\", \"2 m\", \"0 m\"]",
            ),
            ("model.bee.sensor.\"a.b\".use=compass", "use = \"compass\""),
            ("component.viewer.port=80", "port = 80"),
            ("model.bee.params.use_radio=false", "use_radio = false"),
        ] {
            let text = set(argument).unwrap_or_else(|e| panic!("{argument}: {e}"));
            assert!(text.contains(line), "{argument}:\n{text}");
        }
    }

    #[test]
    fn a_part_by_its_name_becomes_a_table_when_a_key_of_it_is_set() {
        for (argument, line) in [
            (
                "model.bee.vehicle.mass=27 g",
                "[model.vehicle]\nuse = \"simple-bee\"\nmass = \"27 g\"",
            ),
            (
                "model.bee.vehicle.use=ghost",
                "[model.vehicle]\nuse = \"ghost\"\n",
            ),
            (
                "model.bee.battery.avionics=50 mA",
                "[model.battery]\npreset = \"1s-170mah\"\navionics = \"50 mA\"",
            ),
            (
                "model.bee.radio.antenna.gain=3 dB",
                "antenna = { use = \"isotropic\", gain = \"3 dB\" }",
            ),
            (
                "model.broadcast-bee.radio.tx_level=3",
                "[model.radio]\nuse = \"cc2420\"\ntx_level = 3",
            ),
            ("channel.medium.x=1", "medium = { use = \"simple\", x = 1 }"),
        ] {
            let text = set(argument).unwrap_or_else(|e| panic!("{argument}: {e}"));
            assert!(text.contains(line), "{argument}:\n{text}");
        }
        let error = set("model.bee.name.x=1").expect_err("a name is no part");
        assert!(error.contains("leads into text"), "{error}");
    }

    #[test]
    fn what_varies_is_said_as_a_list_or_a_range() {
        for (argument, line) in [
            ("--seeds 10", "seeds = 10"),
            ("--seeds 3,5", "seeds = [3, 5]"),
            ("--seeds 1..20", "seeds = { from = 1, to = 20 }"),
            (
                "--vary model.bee.count=10,20",
                "\"model.bee.count\" = [10, 20]",
            ),
            (
                "--vary run.end_time=10 s, 20 s",
                "\"run.end_time\" = [\"10 s\", \"20 s\"]",
            ),
            (
                "--vary x=10 m..50 m step 10 m",
                "x = { from = \"10 m\", to = \"50 m\", step = \"10 m\" }",
            ),
            ("--vary x=[[1, 2], [3, 4]]", "x = [[1, 2], [3, 4]]"),
            ("--vary x={ uniform = [1, 2] }", "x = { uniform = [1, 2] }"),
            (
                "--vary world=\"a,b.toml\",c.toml",
                "world = [\"a,b.toml\", \"c.toml\"]",
            ),
            (
                "--vary x={ ball = \"2 m\", center = [1, 2] }, { ball = \"3 m\" },[4, 5]",
                "x = [{ ball = \"2 m\", center = [1, 2] }, { ball = \"3 m\" }, [4, 5]]",
            ),
            ("--vary x=bee's,b", "x = [\"bee's\", \"b\"]"),
            (
                "--vary world=../a.toml,../b.toml",
                "world = [\"../a.toml\", \"../b.toml\"]",
            ),
        ] {
            let text = set(argument).unwrap_or_else(|e| panic!("{argument}: {e}"));
            assert!(text.contains(line), "{argument}:\n{text}");
        }
        for argument in [
            "--vary x",
            "--vary x=",
            "--vary x=1,,2",
            "--seeds ",
            "--vary x=1..",
            "--vary =1",
        ] {
            assert!(set(argument).is_err(), "{argument}");
        }
    }

    #[test]
    fn a_fault_shows_the_argument() {
        insta::assert_snapshot!(set("model.bea.params.x=1").expect_err("no such model"), @r"
        error: unknown entry `bea`
         --> command line:1:13
          |
        1 | --set model.bea.params.x=1
          |             ^^^
          |
          = help: did you mean `bee`?

        1 error in command line
        ");
    }

    #[test]
    fn nonsense_is_an_error() {
        for argument in [
            "",
            "=",
            "run.seed",
            "run.seed=",
            "=1",
            "run..seed=1",
            "run.seed.x=1",
            "model.9.use=a",
            "model.x.use=a",
            "run.\"seed=1",
            "run.x=[1, 2",
            "run.x={",
            "run.x=\"a",
            "model.-1.use=a",
        ] {
            assert!(set(argument).is_err(), "{argument}");
        }
    }
}
