//! Radios as behaviours use them: requests and what becomes of them, states, several on one platform.

use crate::operator::{Cast, SIMPLE, TWO, play};

#[test]
fn every_request_comes_back_with_its_ticket_and_in_order() {
    let ann = [
        "100 send radio one",
        "200 to radio bob two",
        "200 send radio three",
        "300 long radio 116",
        "400 long radio 117",
        "500 sleep radio",
        "600 send radio four",
        "700 wake radio",
        "800 send radio five",
        "800 own radio six",
        "900 count radio",
    ];
    let bob = ["250 sleep radio", "750 wake radio", "900 count radio"];
    let said = play(
        SIMPLE,
        &[Cast::bee("ann", 0.0, &ann), Cast::bee("bob", 10.0, &bob)],
    );
    let said = said.unwrap_or_else(|e| panic!("{e}"));
    // 0 dBm over 10 m at 2405 MHz: 60.07 dB (Friis).
    let expected = [
        "0.1 s ann #0 sent",
        "0.1 s bob hears one from ann on radio with -60.1 dBm",
        "0.2 s ann #1 sent",
        "0.2 s ann #2 sent",
        "0.2 s bob hears two from ann on radio with -60.1 dBm",
        "0.2 s bob hears three from ann on radio with -60.1 dBm",
        "0.3 s ann #3 sent",
        "0.4 s ann #4 too-long",
        "0.6 s ann #5 sender-asleep",
        "0.8 s ann #6 sent",
        "0.8 s ann #77 sent",
        "0.8 s bob hears five from ann on radio with -60.1 dBm",
        "0.8 s bob hears six from ann on radio with -60.1 dBm",
        "0.9 s ann radio: 6 sent, 0 received, 0 overheard, 1 sender-asleep, 1 too-long",
        "0.9 s bob radio: 0 sent, 5 received, 0 overheard, 1 asleep",
    ];
    assert_eq!(said, expected);
}

#[test]
fn where_there_is_no_channel_requests_come_back_too() {
    for channel in ["", "[channel]\nmedium = \"off\""] {
        let script = ["100 send radio one", "200 sense radio", "300 count radio"];
        let said = play(channel, &[Cast::bee("ann", 0.0, &script)]);
        let expected = [
            "0.1 s ann #0 no-channel",
            "0.2 s ann senses nothing on radio",
            "0.3 s ann radio: 0 sent, 0 received, 0 overheard",
        ];
        assert_eq!(
            said.as_deref(),
            Ok(&expected.map(str::to_owned)[..]),
            "{channel}"
        );
    }
}

#[test]
fn a_packet_to_nobody_ends_the_run_with_the_senders_name() {
    let error = play(SIMPLE, &[Cast::bee("ann", 0.0, &["100 nobody radio"])]).expect_err("nobody");
    assert!(error.contains("ann") && error.contains("999"), "{error}");
}

#[test]
fn stations_talk_as_vehicles_do() {
    let tower = Cast {
        kind: "test-tower",
        ..Cast::bee("tower", 0.0, &["100 to radio ann up"])
    };
    let said = play(
        SIMPLE,
        &[tower, Cast::bee("ann", 10.0, &["200 to radio tower down"])],
    );
    let said = said.unwrap_or_else(|e| panic!("{e}"));
    let who = |line: &String| {
        line.split(' ')
            .skip(2)
            .take(3)
            .collect::<Vec<_>>()
            .join(" ")
    };
    let said: Vec<String> = said.iter().map(who).collect();
    assert_eq!(
        said,
        [
            "tower #0 sent",
            "ann hears up",
            "tower hears down",
            "ann #0 sent"
        ]
    );
}

/// A channel on which packets take their time; queues of two.
const IEEE: &str = r#"[channel]
    medium = { use = "ieee802154", queue = 2 }"#;

/// What was said, without the times, by name.
fn by(name: &str, said: &[String]) -> Vec<String> {
    let words = |line: &String| line.splitn(4, ' ').map(str::to_owned).collect::<Vec<_>>();
    let lines = said.iter().map(words).filter(|words| words[2] == name);
    lines.map(|words| words[3].clone()).collect()
}

/// When a line was said, in ms.
fn when(what: &str, said: &[String]) -> f64 {
    let line = said.iter().find(|line| line.contains(what));
    let line = line.unwrap_or_else(|| panic!("{what} is not in {said:#?}"));
    let seconds = line.split(' ').next().expect("a time");
    1e3 * seconds.parse::<f64>().expect("a number")
}

#[test]
fn a_packet_to_somebody_is_acknowledged_and_others_overhear_it() {
    let ann = ["100 to radio bob hello"];
    let count = ["900 count radio"];
    let cast = [
        Cast::bee("ann", 0.0, &ann),
        Cast::bee("bob", 10.0, &count),
        Cast::bee("carol", -10.0, &count),
    ];
    let said = play(IEEE, &cast).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(by("ann", &said), ["#0 sent"]);
    let bob = [
        "hears hello from ann on radio with -60.1 dBm",
        "radio: 0 sent, 1 received, 0 overheard",
    ];
    assert_eq!(by("bob", &said), bob);
    assert_eq!(
        by("carol", &said),
        ["radio: 0 sent, 0 received, 1 overheard"]
    );
    // Access 0.32 to 2.56 ms, 22 bytes of 32 us; then 192 us of turnaround and 11 bytes.
    let (heard, acknowledged) = (when("hears", &said), when("#0", &said));
    assert!((101.024..=103.264).contains(&heard), "{heard} ms");
    assert!(
        (acknowledged - heard - 0.544).abs() < 1e-6,
        "{acknowledged} ms"
    );
}

#[test]
fn a_packet_that_nobody_acknowledges_is_sent_four_times_and_given_up() {
    let ann = ["100 to radio bob hello", "900 count radio"];
    let cast = [
        Cast::bee("ann", 0.0, &ann),
        Cast::bee(
            "bob",
            10.0,
            &["50 sleep radio", "500 wake radio", "900 count radio"],
        ),
    ];
    let said = play(IEEE, &cast).unwrap_or_else(|e| panic!("{e}"));
    let expected = [
        "#0 no-acknowledgement",
        "radio: 4 sent, 0 received, 0 overheard, 1 no-acknowledgement",
    ];
    assert_eq!(by("ann", &said), expected);
    assert_eq!(
        by("bob", &said),
        ["radio: 0 sent, 0 received, 0 overheard, 4 asleep"]
    );
}

#[test]
fn more_packets_than_the_queue_holds_are_refused_at_once() {
    let ann: Vec<String> = (0..5).map(|k| format!("100 send radio p{k}")).collect();
    let ann: Vec<&str> = ann.iter().map(String::as_str).collect();
    let cast = [Cast::bee("ann", 0.0, &ann), Cast::bee("bob", 10.0, &[])];
    let said = play(IEEE, &cast).unwrap_or_else(|e| panic!("{e}"));
    // One is being sent, two wait.
    let expected = [
        "#3 queue-full",
        "#4 queue-full",
        "#0 sent",
        "#1 sent",
        "#2 sent",
    ];
    assert_eq!(by("ann", &said), expected);
    assert_eq!(by("bob", &said).len(), 3);
    assert_eq!(when("#4", &said), 100.0);
}

#[test]
fn nobody_hears_while_it_sends() {
    let mut script: Vec<String> = (0..40)
        .map(|k| format!("{} send radio x", 20 * k))
        .collect();
    script.push("900 count radio".to_owned());
    let script: Vec<&str> = script.iter().map(String::as_str).collect();
    let cast = [
        Cast::bee("ann", 0.0, &script),
        Cast::bee("bob", 10.0, &script),
    ];
    let said = play(IEEE, &cast).unwrap_or_else(|e| panic!("{e}"));
    for name in ["ann", "bob"] {
        let lines = by(name, &said);
        let heard = lines
            .iter()
            .filter(|line| line.starts_with("hears"))
            .count();
        let counted = lines
            .iter()
            .find(|line| line.starts_with("radio:"))
            .expect("counters");
        assert!((20..40).contains(&heard), "{name} hears {heard}");
        let all = format!(
            "40 sent, {heard} received, 0 overheard, {} half-duplex",
            40 - heard
        );
        assert_eq!(*counted, format!("radio: {all}"), "{name}");
    }
}

#[test]
fn a_frame_on_the_air_is_sensed_and_makes_the_channel_busy() {
    // It begins 0.32 to 2.56 ms after the request, and lasts 3.744 ms.
    let ann = ["100 long radio 100", "103 sense radio", "103 state radio"];
    let bob = [
        "50 sense radio",
        "50 clear radio",
        "103 sense radio",
        "103 clear radio",
        "103 state radio",
        "110 clear radio",
        "120 sleep radio",
        "121 clear radio",
        "121 state radio",
    ];
    let cast = [Cast::bee("ann", 0.0, &ann), Cast::bee("bob", 10.0, &bob)];
    let said = play(IEEE, &cast).unwrap_or_else(|e| panic!("{e}"));
    let expected = [
        "senses nothing on radio",
        "radio is in state transmit",
        "#0 sent",
    ];
    assert_eq!(by("ann", &said), expected);
    let bob: Vec<String> = by("bob", &said);
    let expected = [
        "senses -95.5 on radio",
        "finds radio free",
        "senses -60.1 on radio",
        "finds radio busy",
        "radio is in state receive",
        "finds radio free",
        "finds radio unknown",
        "radio is in state sleep",
    ];
    let told: Vec<&String> = bob
        .iter()
        .filter(|line| !line.starts_with("hears"))
        .collect();
    assert_eq!(told, expected.iter().collect::<Vec<_>>());
}

#[test]
fn two_radios_on_two_channels_do_not_wait_for_each_other() {
    let two = |name, east_m, script| Cast {
        radios: TWO,
        ..Cast::bee(name, east_m, script)
    };
    let ann: Vec<String> = (0..30)
        .flat_map(|k| ["long", "short"].map(|name| format!("{} send {name} x", 20 * k)))
        .collect();
    let ann: Vec<&str> = ann.iter().map(String::as_str).collect();
    let bob = ["900 count long", "900 count short"];
    let said = play(
        IEEE,
        &[two("ann", 0.0, &ann[..]), two("bob", 5.0, &bob[..])],
    );
    let said = said.unwrap_or_else(|e| panic!("{e}"));
    let bob = by("bob", &said);
    let expected = [
        "long: 0 sent, 30 received, 0 overheard",
        "short: 0 sent, 30 received, 0 overheard",
    ];
    assert_eq!(bob[60..], expected);
}

#[test]
fn of_two_radios_each_hears_its_own_channel_and_packets_tell_which() {
    let two = |name, east_m, script| Cast {
        radios: TWO,
        ..Cast::bee(name, east_m, script)
    };
    let ann = [
        "100 send long one",
        "200 send short two",
        "300 tune short 11",
        "400 send short three",
    ];
    let bob = ["500 count long", "500 count short"];
    let said = play(
        SIMPLE,
        &[two("ann", 0.0, &ann[..]), two("bob", 10.0, &bob[..])],
    );
    let expected = [
        "0.1 s ann #0 sent",
        "0.1 s bob hears one from ann on long with -60.1 dBm",
        "0.2 s ann #1 sent",
        // 25 dB weaker, and 0.27 dB more loss at 2480 MHz.
        "0.2 s bob hears two from ann on short with -85.3 dBm",
        // Its own other radio hears it as well, without any loss.
        "0.4 s ann hears three from ann on long with -25.0 dBm",
        "0.4 s ann #2 sent",
        "0.4 s bob hears three from ann on long with -85.1 dBm",
        "0.5 s bob long: 0 sent, 2 received, 0 overheard",
        "0.5 s bob short: 0 sent, 1 received, 0 overheard",
    ];
    assert_eq!(said.unwrap_or_else(|e| panic!("{e}")), expected);
}

#[test]
fn a_radio_that_sleeps_senses_nothing_and_one_that_is_awake_the_noise() {
    let script = [
        "100 sense radio",
        "200 sleep radio",
        "300 sense radio",
        "300 state radio",
        "400 wake radio",
        "500 sense radio",
        "500 state radio",
    ];
    let said = play(SIMPLE, &[Cast::bee("ann", 0.0, &script)]).unwrap_or_else(|e| panic!("{e}"));
    let expected = [
        "0.1 s ann senses -100.0 on radio",
        "0.3 s ann senses nothing on radio",
        "0.3 s ann radio is in state sleep",
        "0.5 s ann senses -100.0 on radio",
        "0.5 s ann radio is in state idle",
    ];
    assert_eq!(said, expected);
}

#[test]
fn an_antenna_off_centre_goes_with_the_body_as_it_pitches() {
    // A mast of 5 m, up; bob is 10 m east. Pitched by 90 degrees it points to him, by -90 away.
    let mast = "radio = { use = \"cc2420\", mount = { position = [\"0 m\", \"0 m\", \"5 m\"] } }";
    let script = [
        "100 send radio up",
        "200 turn radio 90",
        "300 send radio near",
        "400 turn radio -180",
        "500 send radio far",
    ];
    let tower = Cast {
        kind: "test-tower",
        radios: mast,
        ..Cast::bee("tower", 0.0, &script)
    };
    let said =
        play(SIMPLE, &[tower, Cast::bee("bob", 10.0, &[])]).unwrap_or_else(|e| panic!("{e}"));
    let heard: Vec<&str> = said
        .iter()
        .filter_map(|line| line.split(" with ").nth(1))
        .collect();
    // Friis over sqrt(125) m, 5 m and 15 m.
    assert_eq!(heard, ["-61.0 dBm", "-54.0 dBm", "-63.6 dBm"]);
}

#[test]
fn a_dipole_tilts_with_the_body() {
    // Its gain is 2.15 dBi broadside, -5.43 at 30 degrees from its axis, 0.39 at 60.
    let dipole = "radio = { use = \"cc2420\", antenna = \"half-wave-dipole\" }";
    let script = [
        "100 send radio upright",
        "200 turn radio 60",
        "300 send radio tilted",
        "400 turn radio -90",
        "500 send radio tilted",
    ];
    for channel in [SIMPLE, IEEE] {
        let tower = Cast {
            kind: "test-tower",
            radios: dipole,
            ..Cast::bee("tower", 0.0, &script)
        };
        let said = play(channel, &[tower, Cast::bee("bob", 10.0, &[])]);
        let said = by("bob", &said.unwrap_or_else(|e| panic!("{e}")));
        let heard: Vec<&str> = said
            .iter()
            .filter_map(|line| line.split(" with ").nth(1))
            .collect();
        // -60.07 dBm by Friis, and the gain; bob's centre is 5 cm higher, which is 0.3 degrees.
        assert_eq!(heard, ["-57.9 dBm", "-65.6 dBm", "-59.6 dBm"], "{channel}");
    }
}

#[test]
fn a_new_power_level_is_heard_and_drawn() {
    let script = [
        "100 send radio loud",
        "200 power radio 3",
        "300 send radio low",
        "400 power radio 31",
        "500 send radio loud",
    ];
    for channel in [SIMPLE, IEEE] {
        let cast = [Cast::bee("ann", 0.0, &script), Cast::bee("bob", 10.0, &[])];
        let said = by(
            "bob",
            &play(channel, &cast).unwrap_or_else(|e| panic!("{e}")),
        );
        let heard: Vec<&str> = said
            .iter()
            .filter_map(|line| line.split(" with ").nth(1))
            .collect();
        assert_eq!(heard, ["-60.1 dBm", "-85.1 dBm", "-60.1 dBm"], "{channel}");
    }
}
