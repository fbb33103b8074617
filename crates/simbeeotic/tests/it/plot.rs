//! Pictures of recordings: they are drawn, and what cannot be drawn says why.

use crate::program::Program;
use quick_xml::Reader;
use quick_xml::events::Event;

/// Five bees that drift apart, on a channel where noise takes a part.
const FIVE: &str = r#"
[run]
seed = 1
end_time = "5 s"

[channel]
use = "free-space"
medium = "simple"
range_limit = "100 m"
noise_floor = { mean = "-85 dBm", sigma = "5 dB" }

[[model]]
use = "broadcast-bee"
name = "bee"
count = 5
start = { grid = [5, 1, 1], spacing = "15 m", from = ["0 m", "0 m", "5 m"] }
radio = { use = "cc2420" }

[[component]]
use = "recorder"
path = "five.mcap"
radios = ["bee-0"]
"#;

fn flown() -> Program {
    let program = Program::new();
    program.write("five.toml", FIVE);
    program.summary(&["five.toml"]);
    program
}

/// The words of a picture, if it is well-formed.
pub(crate) fn words(svg: &str) -> Vec<String> {
    let mut reader = Reader::from_str(svg);
    let mut words = Vec::new();
    let mut inside = false;
    loop {
        match reader.read_event().expect("well-formed") {
            Event::Start(tag) if tag.name().as_ref() == "text" => {
                inside = true;
                words.push(String::new());
            }
            Event::End(_) => inside = false,
            Event::Text(text) if inside => {
                let last = words.last_mut().expect("a text has begun");
                last.push_str(&text);
            }
            Event::Eof => return words,
            _ => {}
        }
    }
}

#[test]
fn every_kind_is_drawn_as_svg_and_as_png() {
    let program = flown();
    for (kind, told) in [
        ("links", "delivery ratio"),
        ("delivery", "distance, m"),
        ("rssi", "RSSI, dBm"),
        ("losses", "lost in 1 s"),
    ] {
        let title = "Five <b> & co";
        let call = program.call(&["plot", kind, "five.mcap", "-o", "x.svg", "--title", title]);
        assert_eq!(call.code, Some(0), "{}", call.err);
        let svg = std::fs::read_to_string(program.path("x.svg")).expect("it is there");
        let words = words(&svg);
        assert!(words.iter().any(|word| word == told), "{kind}: {words:?}");
        assert!(words[0].starts_with("Five "), "{words:?}");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{kind}");

        let call = program.call(&["plot", kind, "five.mcap", "-o", "x.png", "--width", "800"]);
        assert_eq!(call.code, Some(0), "{}", call.err);
        let png = std::fs::read(program.path("x.png")).expect("it is there");
        assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
        assert_eq!(png[16..24], [0, 0, 3, 32, 0, 0, 2, 188], "800 x 700");
    }
}

#[test]
fn a_map_of_links_has_each_radio_and_half_a_line_for_each_way() {
    let program = flown();
    let call = program.call(&["plot", "links", "five.mcap", "-o", "x.svg"]);
    assert_eq!(call.code, Some(0), "{}", call.err);
    let svg = std::fs::read_to_string(program.path("x.svg")).expect("it is there");
    assert_eq!(svg.matches("<circle").count(), 5);
    let words = words(&svg);
    for bee in 0..5 {
        assert!(words.contains(&format!("bee-{bee}")), "{words:?}");
    }
    assert!(words[1].ends_with("5 radios, 10 links"), "{}", words[1]);
    let some = [
        "plot",
        "links",
        "five.mcap",
        "-o",
        "x.svg",
        "--per-radio",
        "1",
    ];
    assert_eq!(program.call(&some).code, Some(0));
    let svg = std::fs::read_to_string(program.path("x.svg")).expect("it is there");
    assert!(svg.contains("the best link of each"), "{svg}");
}

#[test]
fn what_cannot_be_drawn_says_why() {
    let program = flown();
    let refused = |arguments: &[&str], code: i32, told: &str| {
        let call = program.call(&[&["plot"], arguments].concat());
        assert_eq!(call.code, Some(code), "{arguments:?}: {}", call.err);
        assert!(call.err.contains(told), "{told} is not in:\n{}", call.err);
    };
    refused(&["links", "five.mcap", "-o", "x.jpg"], 2, ".svg or .png");
    refused(&["links", "none.mcap", "-o", "x.svg"], 2, "none.mcap");
    refused(
        &["links", "five.toml", "-o", "x.svg"],
        2,
        "not an MCAP file",
    );
    refused(&["links", "five.mcap", "-o", "no/x.svg"], 1, "no/x.svg");
    let late = ["losses", "five.mcap", "-o", "x.svg", "--from", "1 h"];
    refused(&late, 2, "between these times");
    let turned = [
        "losses",
        "five.mcap",
        "-o",
        "x.svg",
        "--from",
        "2 s",
        "--to",
        "1 s",
    ];
    refused(&turned, 2, "--from 2");
    refused(
        &["rssi", "five.mcap", "-o", "x.svg", "--bin", "0 m"],
        2,
        "--bin",
    );
    refused(
        &["rssi", "five.mcap", "-o", "x.svg", "--bin", "1 mm"],
        2,
        "--bin",
    );
    refused(
        &["links", "five.mcap", "-o", "x.svg", "--least", "2"],
        2,
        "between 0 and 1",
    );
    refused(
        &["links", "five.mcap", "-o", "x.svg", "--width", "9"],
        2,
        "400 to 8000",
    );
    let other = [
        "losses",
        "five.mcap",
        "-o",
        "x.svg",
        "--radio",
        "bee-9/radio",
    ];
    refused(&other, 2, "\"bee-0/radio\"");
    let one = [
        "losses",
        "five.mcap",
        "-o",
        "x.svg",
        "--radio",
        "bee-0/radio",
    ];
    assert_eq!(
        program.call(&[&["plot"], one.as_slice()].concat()).code,
        Some(0)
    );

    program.summary(&["five.toml", "--set", "component.recorder.packets=[]"]);
    for kind in ["links", "delivery", "rssi"] {
        refused(
            &[kind, "five.mcap", "-o", "y.svg"],
            2,
            "component.recorder.packets",
        );
    }
    assert!(!program.path("y.svg").exists());
}
