//! The paper's figure 12, as printed.

use crate::{FIGURE12, good};
use simbeeotic_model::config::Level;
use simbeeotic_scenario::print::same;
use simbeeotic_scenario::{Request, load_text, render};

#[test]
fn it_loads_as_printed() {
    let loaded = good("figure12.xml", FIGURE12);
    assert!(
        loaded.faults().iter().all(|f| f.level == Level::Note),
        "{:?}",
        loaded.faults()
    );
    let setup = loaded.setup().expect("a set-up");
    assert_eq!(setup.models.len(), 8193);
    assert_eq!(setup.origin.seed, 111_982);
    assert_eq!(setup.limits.end.as_secs_f64(), 100.0);
    assert!(setup.medium.is_some());
    assert_eq!(setup.models[0].path, "simple-hive");
    assert_eq!(setup.models[8192].path, "instrument-bee-8191");
    for bee in &setup.models[1..] {
        let at = bee.start.position.si();
        assert!(at.min_element() >= 0.0 && at.max_element() < 20.0, "{at}");
        assert_eq!((bee.gear.sensors.len(), bee.gear.radios.len()), (1, 1));
        assert!(bee.vehicle.is_some());
    }
}

#[test]
fn its_toml_says_the_same() {
    let xml = good("figure12.xml", FIGURE12);
    insta::assert_snapshot!(xml.toml());
    let toml = good("figure12.toml", &xml.toml());
    assert!(same(xml.tree(), toml.tree()));
    assert!(toml.faults().is_empty());
    let (a, b) = (
        xml.setup().expect("a set-up"),
        toml.setup().expect("a set-up"),
    );
    for (a, b) in a.models.iter().zip(&b.models) {
        assert_eq!((&a.path, a.start), (&b.path, b.start));
    }
}

#[test]
fn its_component_may_be_uncommented() {
    let text = FIGURE12
        .replace(
            "<!-- if you want to see what is happening, uncomment this component",
            "",
        )
        .replace("</components>\n  -->", "</components>");
    assert!(text.contains("</components>\n</scenario>"));
    let loaded = load_text("figure12.xml", &text, &Request::default())
        .unwrap_or_else(|r| panic!("{}", crate::shown(&r)));
    let said = render::faults(loaded.faults(), loaded.sources(), false);
    let viewer =
        simbeeotic_model::registry::find(simbeeotic_model::registry::Kind::Component, "viewer");
    assert_eq!(
        loaded.plan().components.len(),
        usize::from(viewer.is_some())
    );
    assert_eq!(
        said.contains("`VisComponent3D` is known, not simulated yet"),
        viewer.is_none()
    );
}

#[test]
fn another_seed_moves_every_bee() {
    let other = FIGURE12.replace("111982", "111983");
    let (a, b) = (good("a.xml", FIGURE12), good("b.xml", &other));
    let (a, b) = (a.setup().expect("a set-up"), b.setup().expect("a set-up"));
    assert!(
        a.models[1..]
            .iter()
            .zip(&b.models[1..])
            .all(|(a, b)| a.start != b.start)
    );
}
