//! `[channel]`: what distance, places and echoes do.

use crate::{good, shown};
use simbeeotic_model::ShadowingKind;
use simbeeotic_scenario::{Request, load_text};

/// A scenario of a bee with a radio.
fn channel(lines: &str) -> String {
    format!(
        "[run]\nend_time = \"1 s\"\n[channel]\n{lines}\n\
         [[model]]\nuse = \"inert-bee\"\n[model.radio]\nuse = \"cc2420\"\n"
    )
}

#[test]
fn every_propagation_and_fading_of_the_shelf_is_read_with_its_parameters() {
    for lines in [
        "use = \"free-space\"",
        "use = \"log-distance\"\nexponent = 2.7\nreference_distance = \"2 m\"\nreference_loss = \"46.6777 dB\"",
        "use = \"two-ray\"\nform = \"ns3\"\nminimum_distance = \"0.5 m\"\nheight = \"20 cm\"",
        "use = \"two-ray\"\nform = \"original\"",
        "use = \"two-ray-exact\"\npolarisation = \"horizontal\"\nground = \"sea-water\"",
        "use = \"two-ray-exact\"\npermittivity = 12\nconductivity = \"5 mS/m\"",
        "shadowing = { sigma = \"4 dB\", distance = \"10 m\" }",
        "shadowing = { sigma = \"4 dB\", kind = \"links\" }\nfading = \"rayleigh\"",
        "fading = { use = \"rician\", k = \"6 dB\" }",
        "fading = { use = \"nakagami\", m = 1.5 }",
        "fading = { use = \"nakagami\", steps = [[\"80 m\", 1.5], [\"200 m\", 0.75]] }",
    ] {
        let loaded = good("swarm.toml", &channel(lines));
        assert!(loaded.faults().is_empty(), "{lines}");
        loaded.setup().expect("a set-up");
    }
}

#[test]
fn shadowing_is_a_field_unless_said() {
    let loaded = good("swarm.toml", &channel("shadowing = { sigma = \"6 dB\" }"));
    let channel = loaded.plan().channel.as_ref().expect("there is one");
    let shadowing = channel.shadowing.as_ref().expect("it has shadowing");
    assert_eq!(shadowing.kind, ShadowingKind::Field);
    assert_eq!(shadowing.sigma.db(), 6.0);
    assert!(channel.fading.is_none());
}

#[test]
fn what_is_wrong_is_told_at_its_place_with_what_was_meant() {
    for (lines, column, words) in [
        (
            "shadowing = { sgima = \"4 dB\" }",
            15,
            "did you mean `sigma`",
        ),
        (
            "shadowing = { sigma = \"-1 dB\" }",
            23,
            "must lie between 0 dB and 40 dB",
        ),
        ("shadowing = { sigma = \"4 m\" }", 23, "dB"),
        (
            "shadowing = { kind = \"link\" }",
            22,
            "did you mean `links`",
        ),
        (
            "shadowing = { kind = \"links\", distance = \"9 m\" }",
            42,
            "goes with the kind `field`",
        ),
        ("fading = \"ricean\"", 10, "did you mean `rician`"),
        (
            "fading = { use = \"rician\", kk = \"6 dB\" }",
            28,
            "unknown key `kk`",
        ),
        (
            "fading = { use = \"rician\", k = \"99 dB\" }",
            32,
            "must lie between",
        ),
        (
            "fading = { use = \"nakagami\", m = 0.1 }",
            34,
            "must lie between 0.5 and 100",
        ),
        (
            "fading = { use = \"nakagami\", steps = [[\"9 m\", 1], [\"8 m\", 1]] }",
            38,
            "that rise",
        ),
        (
            "use = \"log-distance\"\nexponent = -1",
            12,
            "must lie between 0 and 20",
        ),
        ("use = \"two-rays\"", 7, "did you mean `two-ray`"),
        (
            "use = \"two-ray-exact\"\nground = \"wett\"",
            10,
            "did you mean `wet`",
        ),
        ("fadin = \"rayleigh\"", 1, "did you mean `fading`"),
        ("medium = \"iee802154\"", 10, "did you mean `ieee802154`"),
        (
            "medium = { use = \"bernoulli\", delivery = 2 }",
            42,
            "delivery",
        ),
        (
            "use = \"link-table\"\nfile = \"nowhere.csv\"",
            8,
            "cannot be read",
        ),
    ] {
        let Err(rejected) = load_text("swarm.toml", &channel(lines), &Request::default()) else {
            panic!("this should be wrong: {lines}");
        };
        let shown = shown(&rejected);
        assert_eq!(rejected.faults.len(), 1, "more than the fault:\n{shown}");
        assert!(shown.contains(words), "{lines}:\n{shown}");
        let line = 3 + lines.lines().count();
        assert!(
            shown.contains(&format!(":{line}:{column}")),
            "{lines}, {line}:{column}:\n{shown}"
        );
    }
}

#[test]
fn what_a_medium_leaves_aside_is_warned_of_at_its_key_and_runs() {
    let noise = "noise_floor = { mean = \"-100 dBm\", sigma = \"10 dB\" }";
    let steady = "noise_floor = { mean = \"-100 dBm\", sigma = \"0 dB\" }";
    let shadows = "shadowing = { sigma = \"4 dB\" }\nfading = \"rayleigh\"\nwalls = true";
    for (medium, lines, keys) in [
        ("ieee802154", noise, vec!["noise_floor"]),
        ("ieee802154", steady, vec![]),
        ("ieee802154", shadows, vec![]),
        ("simple", noise, vec![]),
        ("simple", shadows, vec![]),
        ("bernoulli", shadows, vec!["shadowing", "fading", "walls"]),
        (
            "gilbert-elliott",
            shadows,
            vec!["shadowing", "fading", "walls"],
        ),
        ("bernoulli", "walls = false", vec![]),
        ("off", shadows, vec![]),
    ] {
        let text = channel(&format!("medium = \"{medium}\"\n{lines}"));
        let loaded = good("swarm.toml", &text);
        let found: Vec<&str> = loaded
            .faults()
            .iter()
            .map(|fault| {
                assert!(!fault.is_error(), "{fault}");
                let span = fault.span.expect("a place");
                &text[span.start..span.end]
            })
            .collect();
        assert_eq!(found, keys, "{medium}, {lines}");
        loaded.setup().expect("a set-up");
    }
}

#[test]
fn names_of_a_link_table_that_no_radio_has_are_told_before_the_run() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("links.csv");
    let line = format!("use = \"link-table\"\nfile = '{}'", file.display());
    let text = channel(&line).replace("\"inert-bee\"", "\"inert-bee\"\ncount = 3\nname = \"bee\"");
    let with = |rows: &str| {
        std::fs::write(&file, format!("tx, rx, loss_db\n{rows}\n")).expect("a file");
        load_text("swarm.toml", &text, &Request::default())
    };
    let fine = with("bee-0, bee-1, 50\nbee-2/radio, bee-0, 60").expect("all are there");
    assert!(fine.faults().is_empty());
    let odd = with("bee-0, bee-1, 50\nbee-0, bee-9, 60").expect("a warning alone");
    let [warning] = odd.faults() else {
        panic!("{:?}", odd.faults());
    };
    assert!(!warning.is_error());
    let place = "links.csv:3:8: no radio is called `bee-9`; did you mean `bee-0`?";
    assert!(warning.message.contains(place), "{warning}");
    let span = warning.span.expect("a place");
    assert!(text[span.start..span.end].contains("links.csv"));
    let Err(rejected) = with("n-0, bee-1, 50") else {
        panic!("no link of it is between two radios");
    };
    let shown = shown(&rejected);
    assert!(
        shown.contains("links.csv:2:1: no radio is called `n-0`"),
        "{shown}"
    );
    assert!(shown.contains("is between two radios"), "{shown}");
}

#[test]
fn a_channel_needs_no_use_in_the_schema_either() {
    let schema = simbeeotic_scenario::schema::schema();
    let choices = schema["properties"]["channel"]["oneOf"].as_array();
    let own = choices.into_iter().flatten().filter_map(|choice| {
        let keys = choice.get("properties")?.as_object()?;
        Some((keys, choice.get("required")))
    });
    let own: Vec<_> = own.collect();
    let [(keys, required)] = own[..] else {
        panic!("{own:?}");
    };
    assert_eq!(required, None);
    assert!(keys.contains_key("medium") && !keys.contains_key("use"));
}

#[test]
fn radios_without_a_channel_are_told_so_once() {
    let without = channel("").replace("[channel]\n", "");
    let loaded = good("swarm.toml", &without);
    let messages: Vec<&str> = loaded.faults().iter().map(|f| f.message.as_str()).collect();
    assert_eq!(
        messages,
        ["its radio is heard by nobody: there is no `[channel]`"]
    );
    assert!(good("swarm.toml", &channel("")).faults().is_empty());
}

#[test]
fn the_originals_two_rays_keep_their_form() {
    let xml = crate::XML.replace("FreeSpacePropagationModel", "TwoRayPropagationModel");
    assert_ne!(xml, crate::XML);
    let loaded = good("old.xml", &xml);
    let toml = loaded.toml();
    assert!(
        toml.contains("use = \"two-ray\"") && toml.contains("form = \"original\""),
        "{toml}"
    );
    assert!(!good("old.xml", crate::XML).toml().contains("form"));
}
