//! The book's scenarios run. Its Rust code is compiled as doctests of the facade.

use crate::program::Program;

#[test]
fn the_scenarios_of_the_first_chapter_run() {
    let chapter = include_str!("../../../../docs/book/src/first-swarm.md");
    let mut scenarios = 0;
    for block in chapter.split("```toml").skip(1) {
        let text = block.split("```").next().expect("a block ends");
        // Blocks without [run] show a part of a file; behaviours of the chapter's own crate are
        // compiled there.
        if !text.contains("[run]") || text.contains("\"homing-bee\"") {
            continue;
        }
        let program = Program::new();
        program.write("book.toml", text);
        let call = program.call(&["run", "book.toml", "--quiet", "--end-time", "2 s"]);
        assert_eq!(call.code, Some(0), "{}\n{text}", call.err);
        scenarios += 1;
    }
    assert!(scenarios >= 2, "the chapter shows scenarios");
}

#[test]
fn the_world_of_the_book_stands_and_bees_of_its_shape_fly_in_it() {
    let chapter = include_str!("../../../../docs/book/src/world.md");
    let mut blocks = chapter.split("```toml").skip(1);
    let mut next = || {
        let block = blocks.next().expect("the chapter shows files");
        block.split("```").next().expect("a block ends")
    };
    let (world, vehicle) = (next(), next());
    let program = Program::new();
    program.write("garden.toml", world);
    let scenario = format!(
        "world = \"garden.toml\"\n[run]\nend_time = \"1 s\"\n[[model]]\nuse = \"inert-bee\"\n{vehicle}"
    );
    program.write("book.toml", &scenario);
    let call = program.call(&["run", "book.toml", "--quiet"]);
    assert_eq!(call.code, Some(0), "{}\n{scenario}", call.err);
    assert!(!call.err.contains("warning"), "{}", call.err);
}

#[test]
fn the_battery_of_the_book_runs_down() {
    let chapter = include_str!("../../../../docs/book/src/energy.md");
    let block = chapter.split("```toml").nth(1).expect("a scenario");
    let scenario = block.split("```").next().expect("a block ends");
    let program = Program::new();
    program.write("energy.toml", scenario);
    let call = program.call(&["run", "energy.toml"]);
    assert_eq!(call.code, Some(0), "{}", call.err);
    // Half an ampere for five minutes are most of a fifth of 250 mAh, and more.
    let said = format!("{}{}", call.out, call.err);
    assert!(said.contains("empty 1 times"), "{said}");
}

#[test]
fn the_sensors_of_the_book_are_read_and_recorded_beside_the_truth() {
    let chapter = include_str!("../../../../docs/book/src/sensors.md");
    let block = chapter.split("```toml").nth(1).expect("a scenario");
    let scenario = block.split("```").next().expect("a block ends");
    let program = Program::new();
    program.write("senses.toml", scenario);
    let call = program.call(&["run", "senses.toml", "--quiet", "--end-time", "2 s"]);
    assert_eq!(call.code, Some(0), "{}", call.err);
    let export = [
        "export",
        "senses.mcap",
        "--readings",
        "imu.csv",
        "--model",
        "bee-0/imu",
    ];
    let call = program.call(&export);
    assert_eq!(call.code, Some(0), "{}", call.err);
    let table = std::fs::read_to_string(program.path("imu.csv")).expect("a table");
    // Six numbers a sample, a hundred samples a second.
    assert!(
        (1200..=1207).contains(&table.lines().count()),
        "{}",
        table.lines().count()
    );
}

#[test]
fn the_bees_of_the_page_on_the_surroundings_fly_and_see() {
    let page = include_str!("../../../../docs/book/src/sensors-environment.md");
    let block = page.split("```toml").nth(1).expect("it shows a scenario");
    let scenario = block.split("```").next().expect("a block ends");
    let program = Program::new();
    program.write("book.toml", scenario);
    let call = program.call(&["run", "book.toml", "--quiet", "--end-time", "2 s"]);
    assert_eq!(call.code, Some(0), "{}", call.err);
    assert!(!call.err.contains("warning"), "{}", call.err);
}

#[test]
fn the_scenarios_of_the_chapter_on_radio_run() {
    let chapter = include_str!("../../../../docs/book/src/radio.md");
    let blocks = chapter.split("```toml").skip(1);
    let blocks = blocks.map(|block| block.split("```").next().expect("a block ends"));
    let (whole, parts): (Vec<&str>, Vec<&str>) = blocks.partition(|text| text.contains("[run]"));
    // The first is of the chapter's own behaviour, and runs where that is compiled.
    assert!(whole[0].contains("\"hello-bee\"") && whole.len() == 2);
    let program = Program::new();
    program.write("fidelity.toml", whole[1]);
    for set in [
        "model.bee.params.phase=aligned",
        "channel.medium=simple",
        "channel.medium={ use = \"ieee802154\", preset = \"ns3\", queue = 10 }",
    ] {
        let call = program.call(&["run", "fidelity.toml", "--end-time", "2 s", "--set", set]);
        assert_eq!(call.code, Some(0), "{}", call.err);
    }
    // Two radios and a channel, as parts of a file.
    let radios = parts
        .iter()
        .find(|text| text.contains("radio.long"))
        .expect("two radios");
    let channel = parts
        .iter()
        .find(|text| text.contains("[channel]"))
        .expect("a channel");
    let two =
        format!("[run]\nend_time = \"1 s\"\n{channel}\n[[model]]\nuse = \"slot-bee\"\n{radios}");
    program.write("two.toml", &two);
    let call = program.call(&["run", "two.toml"]);
    assert_eq!(call.code, Some(0), "{}\n{two}", call.err);
    let said = format!("{}{}", call.out, call.err);
    assert!(said.contains("1 bodies, 2 radios"), "{said}");
}

#[test]
fn a_recording_names_the_object_that_was_touched() {
    let program = Program::new();
    let scenario = r#"
        [run]
        end_time = "2 s"
        [record]
        path = "x.mcap"
        [[model]]
        use = "inert-bee"
        name = "bee"
        start = ["4 m", "0 m", "2 m"]
        [[world.obstacle]]
        position = ["4 m", "0 m", "0 m"]
        shape = { box = {} }
        label = "tower"
    "#;
    program.write("x.toml", scenario);
    let call = program.call(&["run", "x.toml", "--quiet"]);
    assert_eq!(call.code, Some(0), "{}", call.err);
    let recording = simbeeotic_record::Recording::open(program.path("x.mcap")).expect("it reads");
    let first = recording.events().next().expect("it fell on it");
    let first = first.expect("it reads");
    assert_eq!(
        (first.kind.as_str(), first.text.as_str()),
        ("contact", "obstacle.0 tower")
    );
    assert_eq!(first.paths, ["bee"]);
}

#[test]
fn the_camera_of_the_book_takes_pictures_that_are_exported() {
    let page = include_str!("../../../../docs/book/src/camera.md");
    let block = page.split("```toml").nth(1).expect("a scenario");
    let scenario = block.split("```").next().expect("a block ends");
    let program = Program::new();
    program.write("eye.toml", scenario);
    std::fs::create_dir(program.path("worlds")).expect("a folder");
    let yard = include_str!("../../../../worlds/yard.toml");
    program.write("worlds/yard.toml", yard);
    let call = program.call(&["run", "eye.toml", "--quiet", "--end-time", "1 s"]);
    assert_eq!(call.code, Some(0), "{}", call.err);
    let call = program.call(&["export", "eye.mcap", "--images", "frames"]);
    assert_eq!(call.code, Some(0), "{}", call.err);
    for channel in ["depth", "colour", "labels"] {
        let name = format!("frames/bee/eye/{channel}-000000200000us.png");
        let file = std::fs::read(program.path(&name)).expect("a picture");
        assert_eq!(file[1..4], *b"PNG", "{name}");
    }
    let nobody = [
        "export", "eye.mcap", "--images", "none", "--model", "bee/nope",
    ];
    let call = program.call(&nobody);
    assert_eq!(call.code, Some(1));
    assert!(call.err.contains("no camera matches"), "{}", call.err);
    let picture = [
        "picture",
        "worlds/yard.toml",
        "-o",
        "yard.png",
        "--size",
        "64x48",
    ];
    let call = program.call(&picture);
    assert_eq!(call.code, Some(0), "{}", call.err);
    let wrong = [&picture[..], &["--kind", "smell"]].concat();
    let call = program.call(&wrong);
    assert_eq!(call.code, Some(2));
    assert!(call.err.contains("it is one of colour"), "{}", call.err);
}
