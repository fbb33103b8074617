//! What a component is told about a model: its parts with their parameters, its gear.

use simbeeotic::prelude::Time;
use simbeeotic::scenario::{Request, load_text};
use simbeeotic_model::{
    About, AboutPart, Beams, Component, ComponentError, Note, Simulation, Summary, View,
};
use std::sync::{Arc, Mutex};

/// Asks at the start.
struct Asker(Arc<Mutex<Vec<About>>>);

impl Component for Asker {
    fn period(&self) -> Option<Time> {
        None
    }

    fn start(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        let all = view.population().iter().map(|(id, _)| view.about(id));
        self.0.lock().expect("one thread at a time").extend(all);
        Ok(())
    }

    fn observe(&mut self, _: &View<'_>) -> Result<(), ComponentError> {
        Ok(())
    }

    fn finish(&mut self, _: &View<'_>, _: &Summary) -> Result<Vec<Note>, ComponentError> {
        Ok(Vec::new())
    }
}

fn about(text: &str) -> Vec<About> {
    let loaded = load_text("about", text, &Request::default()).expect("a good scenario");
    let mut setup = loaded.setup().expect("a good scenario");
    let told = Arc::default();
    let asker = Box::new(Asker(Arc::clone(&told)));
    setup.components.push(("asker".to_owned(), asker));
    let outcome = Simulation::new(setup).expect("a good scenario").run();
    assert!(outcome.error.is_none());
    std::mem::take(&mut told.lock().expect("one thread at a time"))
}

fn value<'a>(part: &'a AboutPart, key: &str) -> Option<&'a str> {
    let mut parameters = part.parameters.iter();
    let (_, value) = parameters.find(|(name, _)| name == key)?;
    Some(value)
}

const TEXT: &str = r#"
    [run]
    end_time = "1 ms"
    [channel]
    use = "free-space"
    [[model]]
    use = "random-walk-bee"
    name = "bee"
    count = 2
    params = { max_speed = "12 m/s" }
    vehicle = { use = "simple-bee", mass = "129 g" }
    battery = "1s-250mah"
    sensor.compass = { use = "compass", rate = "50 Hz", delay = "2 ms" }
    sensor.eye = { use = "range", field_of_view = "30 deg", max_range = "3 m" }
    radio.long = { use = "cc2420", antenna = { use = "isotropic" }, queue_frames = 7 }
    [[model]]
    use = "simple-hive"
    name = "hive"
    radio = "cc2420"
"#;

#[test]
fn a_model_is_told_with_its_parts_and_all_their_parameters() {
    let all = about(TEXT);
    assert_eq!(all.len(), 3);
    assert_eq!(all[0].parts, all[1].parts);
    let names: Vec<(&str, &str)> = (all[0].parts.iter())
        .map(|part| (part.place.as_str(), part.name.as_str()))
        .collect();
    assert_eq!(
        names,
        [
            ("model", "random-walk-bee"),
            ("vehicle", "simple-bee"),
            ("battery", "battery"),
            ("radio.long", "cc2420"),
            ("radio.long.antenna", "isotropic"),
            ("sensor.compass", "compass"),
            ("sensor.eye", "range"),
        ]
    );
    let [model, vehicle, battery, radio, _, compass, eye] = &all[0].parts[..] else {
        panic!("{names:?}")
    };
    assert_eq!(value(model, "max_speed"), Some("12 m/s"));
    // As it was written; by default in the shorter unit.
    assert_eq!(value(vehicle, "mass"), Some("129 g"));
    assert_eq!(value(eye, "field_of_view"), Some("30 deg"));
    assert_eq!(value(eye, "max_incidence"), Some("90 deg"));
    assert_eq!(value(eye, "sigma"), Some("0.05 m"));
    assert_eq!(value(battery, "preset"), Some("1s-250mah"));
    assert_eq!(value(radio, "channel"), Some("11"));
    assert_eq!(value(radio, "queue_frames"), Some("7"));
    assert_eq!(value(compass, "rate"), Some("50 Hz"));
    assert_eq!(value(compass, "delay"), Some("2 ms"));
    assert_eq!(value(compass, "dropout"), None);

    let [compass, eye] = &all[0].sensors[..] else {
        panic!("{:?}", all[0].sensors)
    };
    assert_eq!((compass.name.as_str(), &compass.beams), ("compass", &None));
    assert_eq!(eye.name, "eye");
    assert!(matches!(eye.beams, Some(Beams::Cone { range_m: 3.0, .. })));
    let ids = all
        .iter()
        .map(|about| about.radios[0].id.expect("a medium").0);
    assert_eq!(ids.collect::<Vec<_>>(), [0, 1, 2]);

    let hive: Vec<&str> = all[2].parts.iter().map(|p| p.place.as_str()).collect();
    assert_eq!(hive, ["model", "radio"]);
}

#[test]
fn every_part_on_the_shelf_tells_its_defaults() {
    let empty = simbeeotic_model::config::Node::table(Default::default());
    for part in simbeeotic_model::registry::parts() {
        let complete = (part.complete)(&empty).expect("all parameters have defaults");
        assert!(
            simbeeotic::scenario::print::same(&complete, &(part.defaults)()),
            "{}",
            part.label.name
        );
    }
}
