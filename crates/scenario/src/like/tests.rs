//! What a model takes over, and what it does not.

use super::*;
use crate::print::to_toml;
use simbeeotic_model::config::SourceId;

fn applied(text: &str) -> (String, Vec<Fault>) {
    let mut root = crate::toml::parse(text, SourceId(0)).expect("TOML");
    let mut faults = Vec::new();
    apply(&mut root, &mut faults);
    (to_toml(&root), faults)
}

/// Both texts are the same scenario, in whatever order keys stand.
#[track_caller]
fn same(short: &str, long: &str) {
    let [short, long] = [short, long].map(|text| {
        let mut root = crate::toml::parse(text, SourceId(0)).expect("TOML");
        let mut faults = Vec::new();
        apply(&mut root, &mut faults);
        assert!(faults.is_empty(), "{faults:?}");
        sort(&mut root);
        to_toml(&root)
    });
    assert_eq!(short, long);
}

fn sort(node: &mut Node) {
    match &mut node.value {
        Value::Table(table) => {
            table.entries.sort_by(|(a, _), (b, _)| a.text.cmp(&b.text));
            table.entries.iter_mut().for_each(|(_, node)| sort(node));
        }
        Value::Array(items) => items.iter_mut().for_each(sort),
        _ => {}
    }
}

const MAV: &str = "[[model]]\nuse = \"m\"\nname = \"mav\"\ncount = 45\nstart = { ball = \"2 m\" }\n\
    radio = \"cc2420\"\nparams = { reserve = 0.2, far = { a = 1, b = 2 } }\n\
    vehicle = { use = \"v\", mass = \"50 g\" }\nsensor = { p = { use = \"position\", sigma = 1 } }\n";

#[test]
fn a_model_takes_over_all_but_its_name_count_start_and_nested_models() {
    let nested = "[[model.model]]\nuse = \"guard\"\n";
    same(
        &format!("{MAV}{nested}[[model]]\nlike = \"mav\"\nname = \"heli\"\ncount = 5\n"),
        &format!(
            "{MAV}{nested}[[model]]\nuse = \"m\"\nname = \"heli\"\ncount = 5\nradio = \"cc2420\"\n\
             params = {{ reserve = 0.2, far = {{ a = 1, b = 2 }} }}\n\
             vehicle = {{ use = \"v\", mass = \"50 g\" }}\n\
             sensor = {{ p = {{ use = \"position\", sigma = 1 }} }}\n"
        ),
    );
}

/// What becomes of the key of a second model that says `own`.
#[track_caller]
fn merged(own: &str, key: &str) -> String {
    let text = format!("{MAV}[[model]]\nlike = \"mav\"\nname = \"heli\"\n{own}\n");
    let mut root = crate::toml::parse(&text, SourceId(0)).expect("TOML");
    let mut faults = Vec::new();
    apply(&mut root, &mut faults);
    assert!(faults.is_empty(), "{faults:?}");
    let models = root.as_table().and_then(|t| t.get(MODEL));
    let heli = models
        .and_then(Node::as_array)
        .and_then(|m| m[1].as_table());
    let value = heli.and_then(|heli| heli.get(key));
    value.map_or_else(String::new, crate::print::value)
}

#[test]
fn tables_are_merged_key_by_key_and_its_own_values_count_more() {
    for (own, key, merged_value) in [
        (
            "params = { far = { b = 3 } }",
            "params",
            "{ far = { b = 3, a = 1 }, reserve = 0.2 }",
        ),
        (
            "vehicle = { mass = \"9 g\" }",
            "vehicle",
            "{ mass = \"9 g\", use = \"v\" }",
        ),
        (
            "vehicle = { use = \"v\", size = 1 }",
            "vehicle",
            "{ use = \"v\", size = 1, mass = \"50 g\" }",
        ),
        (
            "sensor = { q = { use = \"compass\" } }",
            "sensor",
            "{ q = { use = \"compass\" }, p = { use = \"position\", sigma = 1 } }",
        ),
        (
            "radio = { tx_level = 3 }",
            "radio",
            "{ tx_level = 3, use = \"cc2420\" }",
        ),
    ] {
        let value = merged(own, key);
        assert_eq!(value, merged_value, "{own}");
    }
}

#[test]
fn another_part_takes_over_nothing_of_the_first() {
    for (own, key, value) in [
        ("vehicle = \"ghost\"", "vehicle", "\"ghost\""),
        ("vehicle = \"v\"", "vehicle", "\"v\""),
        (
            "vehicle = { use = \"ghost\" }",
            "vehicle",
            "{ use = \"ghost\" }",
        ),
        (
            "sensor = { p = { use = \"gnss\" } }",
            "sensor",
            "{ p = { use = \"gnss\" } }",
        ),
        (
            "radio = { a = { use = \"r\" }, b = { use = \"r\" } }",
            "radio",
            "{ a = { use = \"r\" }, b = { use = \"r\" } }",
        ),
        ("use = \"other\"\nparams = { x = 1 }", "params", "{ x = 1 }"),
        ("use = \"other\"", "params", ""),
        (
            "use = \"other\"",
            "vehicle",
            "{ use = \"v\", mass = \"50 g\" }",
        ),
    ] {
        assert_eq!(merged(own, key), value, "{own}");
    }
}

#[test]
fn a_model_is_found_by_what_it_uses_in_a_chain_and_around_its_list_nearest_first() {
    same(
        "[[model]]\nuse = \"m\"\nparams = { a = 1, b = 1 }\n\
         [[model]]\nlike = \"m\"\nname = \"n\"\nparams = { b = 2 }\n\
         [[model]]\nlike = \"n\"\nname = \"o\"\n[[model.model]]\nlike = \"n\"\nname = \"p\"\n\
         [[model.model]]\nuse = \"z\"\nname = \"n\"\n[[model.model]]\nlike = \"n\"\nname = \"q\"\n",
        "[[model]]\nuse = \"m\"\nparams = { a = 1, b = 1 }\n\
         [[model]]\nuse = \"m\"\nname = \"n\"\nparams = { b = 2, a = 1 }\n\
         [[model]]\nuse = \"m\"\nname = \"o\"\nparams = { b = 2, a = 1 }\n\
         [[model.model]]\nuse = \"m\"\nname = \"p\"\nparams = { b = 2, a = 1 }\n\
         [[model.model]]\nuse = \"z\"\nname = \"n\"\n[[model.model]]\nuse = \"z\"\nname = \"q\"\n",
    );
}

#[test]
fn what_is_no_model_before_it_is_a_fault_at_the_value() {
    for (like, name, message, help) in [
        ("\"mvv\"", "x", "unknown model `mvv`", "did you mean `mav`?"),
        ("3", "x", "where the name of a model is wanted", "like = "),
        ("\"late\"", "x", "`late` stands later", "move it behind"),
        ("\"x\"", "x", "its own name", ""),
    ] {
        let text = format!(
            "{MAV}[[model]]\nlike = {like}\nname = \"{name}\"\n[[model]]\nuse = \"m\"\nname = \"late\"\n"
        );
        let (shown, faults) = applied(&text);
        let [fault] = faults.as_slice() else {
            panic!("{like}: {faults:?}");
        };
        assert!(fault.message.contains(message), "{fault:?}");
        assert!(
            fault.help.as_deref().unwrap_or_default().contains(help),
            "{fault:?}"
        );
        let span = fault.span.expect("a place");
        assert_eq!(&text[span.start..span.end], like);
        // That it uses nothing is no second fault.
        assert!(!shown.contains("name = \"x\""), "{shown}");
    }
    let (_, faults) = applied("[[model]]\nlike = \"a\"\n[[model]]\nlike = 1\nname = \"a\"\n");
    assert_eq!(faults.len(), 2, "{faults:?}");
}

#[test]
fn a_long_chain_of_large_models_is_refused_and_not_unrolled() {
    let mut text = format!(
        "[[model]]\nuse = \"m\"\nparams = {{ a = \"{}\" }}\n",
        "x".repeat(400_000)
    );
    for _ in 0..2000 {
        text += "[[model]]\nlike = \"m\"\n";
    }
    let (_, faults) = applied(&text);
    assert_eq!(faults.len(), 1, "{faults:?}");
    assert!(faults[0].message.contains("more from others"), "{faults:?}");
}
