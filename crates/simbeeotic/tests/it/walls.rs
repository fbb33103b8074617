//! Walls between radios: `[channel] walls = true`.

use crate::operator::{Cast, SIMPLE, play};
use simbeeotic::units::{Decibels, Frequency, Length};
use simbeeotic::world::material::BUILT_IN;

const IEEE: &str = "[channel]\nmedium = \"ieee802154\"";

/// A wall across the way at 5 m, from the ground to above the bees, with more about it.
fn wall(material: &str, width: &str, more: &str) -> String {
    format!(
        "walls = true\n[[world.structure]]\nposition = [\"5 m\", \"-5 m\", \"0 m\"]\nmaterial = \"{material}\"\n\
         shape.wall = {{ length = \"10 m\", width = \"{width}\", height = \"20 m\", rotation = \"90 deg\" {more} }}"
    )
}

/// What two bees 10 m apart hear of each other: the levels as they are told.
fn heard(channel: &str, between: Option<&str>) -> Vec<String> {
    let (ann, bob) = (["100 send radio one"], ["500 send radio two"]);
    let mut cast = vec![Cast::bee("ann", 0.0, &ann), Cast::bee("bob", 10.0, &bob)];
    cast.extend(between.map(|name| Cast::bee(name, 7.0, &["900 sleep radio"])));
    let said = play(channel, &cast).unwrap_or_else(|e| panic!("{e}"));
    let levels = said
        .iter()
        .filter(|line| line.contains("ann hears") || line.contains("bob hears"));
    let level = |line: &String| line.rsplit(' ').nth(1).map(str::to_owned);
    levels.filter_map(level).collect()
}

/// 0 dBm over 10 m at 2405 MHz is -60.07 dBm (Friis), less what the materials take.
fn level(materials: &[(&str, f64)]) -> String {
    let taken = materials.iter().map(|(name, metres)| {
        let material = BUILT_IN.iter().find(|m| m.name == *name).expect("built in");
        material.loss(
            Frequency::from_megahertz(2405.0),
            Length::from_metres(*metres),
        )
    });
    let taken: f64 = taken.map(Decibels::get).sum();
    format!("{:.1}", -60.0701 - taken)
}

#[test]
fn a_brick_wall_costs_what_its_table_says_in_both_directions() {
    for channel in [SIMPLE, IEEE] {
        for width in [0.1, 0.24] {
            let text = format!("{channel}\n{}", wall("brick", &format!("{width} m"), ""));
            let want = level(&[("brick", width)]);
            assert_eq!(heard(&text, None), [want.clone(), want], "{text}");
        }
    }
}

#[test]
fn a_hole_lets_the_signal_through_and_so_does_a_channel_without_walls() {
    let hole = ", windows = [{ position = \"4.5 m\", sill = \"9.5 m\", width = \"1 m\", height = \"1 m\" }]";
    let free = level(&[]);
    for channel in [SIMPLE, IEEE] {
        let text = format!("{channel}\n{}", wall("metal", "10 cm", hole));
        assert_eq!(heard(&text, None), [free.clone(), free.clone()], "{text}");
        let blind = wall("metal", "10 cm", "").replace("walls = true", "walls = false");
        let text = format!("{channel}\n{blind}");
        assert_eq!(heard(&text, None), [free.clone(), free.clone()], "{text}");
    }
}

#[test]
fn metal_stops_all_and_losses_of_several_things_add_up() {
    let text = format!("{SIMPLE}\n{}", wall("metal", "1 cm", ""));
    assert!(heard(&text, None).is_empty(), "nothing goes through metal");
    let post = "[[world.obstacle]]\nposition = [\"3 m\", \"0 m\", \"0 m\"]\nmaterial = \"wood\"\n\
                shape = { box = { length = \"40 cm\", width = \"1 m\", height = \"20 m\" } }";
    let text = format!("{SIMPLE}\n{}\n{post}", wall("plasterboard", "5 cm", ""));
    let want = level(&[("plasterboard", 0.05), ("wood", 0.4)]);
    assert_eq!(heard(&text, None), [want.clone(), want]);
}

#[test]
fn a_bee_in_the_way_takes_nothing_since_it_has_no_material() {
    let text = format!("{SIMPLE}\n{}", wall("brick", "20 cm", ""));
    let want = level(&[("brick", 0.2)]);
    assert_eq!(heard(&text, Some("carl")), [want.clone(), want]);
}
