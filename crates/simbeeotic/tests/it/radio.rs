//! Radios as behaviours use them: requests and what becomes of them, states, several on one platform.

use simbeeotic::prelude::*;
use simbeeotic::radio::{Channel, Loss as Lost};
use simbeeotic::scenario::{Request, load_text};
use simbeeotic_model::{Component, ComponentError, Mark, Note, Simulation, Summary, View};
use std::sync::{Arc, Mutex};

/// Does what its script says, and tells what it hears.
struct Operator {
    script: Vec<Line>,
    next: usize,
    radios: Vec<(String, RadioHandle)>,
}

/// `1500 send radio hello` is a line: when, in milliseconds; what; with which radio.
#[derive(Clone)]
struct Line {
    at: Time,
    words: Vec<String>,
}

/// Parameters of the operators.
#[params]
#[derive(Default)]
struct OperatorParams {
    /// Lines of the script.
    script: Vec<String>,
    /// The radios, by name; the first on board if empty.
    radios: Vec<String>,
}

impl Operator {
    fn new(params: &OperatorParams, radios: Vec<(String, RadioHandle)>) -> Self {
        let line = |text: &String| {
            let mut words = text.split(' ').map(str::to_owned);
            let at = words.next().expect("a time").parse().expect("a number");
            let at = Time::from_millis(at);
            let words = words.collect();
            Line { at, words }
        };
        Self {
            script: params.script.iter().map(line).collect(),
            next: 0,
            radios,
        }
    }

    fn name(&self, radio: simbeeotic::radio::RadioId) -> &str {
        let named = self.radios.iter().find(|(_, handle)| handle.id() == radio);
        named.map_or("?", |(name, _)| name)
    }

    fn act(&mut self, me: &mut Platform<'_>) {
        let line = self.script[self.next].clone();
        self.next += 1;
        let words: Vec<&str> = line.words.iter().map(String::as_str).collect();
        let named = self.radios.iter().find(|(name, _)| *name == words[1]);
        let radio = named.expect("a radio of this name").1;
        match words[..] {
            ["send", _, text] => _ = me.send(radio, text.as_bytes()),
            ["to", _, path, text] => {
                let to = me.find(path).expect("somebody of this path");
                me.send_to(radio, to, text.as_bytes());
            }
            ["nobody", _] => _ = me.send_to(radio, ModelId(999), b"hello"),
            ["own", _, text] => me.send_with_ticket(radio, None, text.as_bytes(), Ticket(77)),
            ["long", _, bytes] => {
                let bytes = bytes.parse().expect("a number");
                me.send(radio, &vec![b'x'; bytes]);
            }
            ["sleep", _] => me.sleep_radio(radio),
            ["wake", _] => me.wake_radio(radio),
            ["tune", _, channel] => {
                let channel = channel.parse().expect("a number");
                me.tune_radio(radio, Channel::ieee802154(channel).expect("a channel"));
            }
            ["turn", _, degrees] => {
                let about = Angle::from_degrees(degrees.parse().expect("a number"));
                let pose = me.pose();
                let turned = pose.attitude * Attitude::from_rpy(Angle::ZERO, about, Yaw::EAST);
                me.set_pose(Pose::new(pose.position, turned));
            }
            ["sense", name] => {
                let sensed = me.sense(radio).map(|power| format!("{:.1}", power.dbm()));
                let line = format!(
                    "senses {} on {name}",
                    sensed.as_deref().unwrap_or("nothing")
                );
                self.say(me, &line);
            }
            ["clear", name] => {
                let clear = me.channel_clear(radio);
                let free = clear.map_or("unknown", |clear| if clear { "free" } else { "busy" });
                self.say(me, &format!("finds {name} {free}"));
            }
            ["state", name] => {
                let state = me.radio_state(radio).name();
                self.say(me, &format!("{name} is in state {state}"));
            }
            ["count", name] => {
                let all = me.radio_counters(radio);
                let lost = Lost::ALL.iter().filter(|reason| all.lost(**reason) > 0);
                let lost = lost.map(|reason| format!(", {} {}", all.lost(*reason), reason.name()));
                let lost: String = lost.collect();
                let (sent, received, overheard) = (all.sent, all.received, all.overheard);
                let sums = format!("{sent} sent, {received} received, {overheard} overheard{lost}");
                self.say(me, &format!("{name}: {sums}"));
            }
            _ => panic!("no such line: {words:?}"),
        }
    }

    fn say(&self, me: &mut Platform<'_>, what: &str) {
        let text = format!("{} {what}", me.path());
        me.log(text);
    }

    fn heard(&self, packet: &Packet<'_>, me: &mut Platform<'_>) {
        let text = String::from_utf8_lossy(packet.payload());
        let from = me.path_of(packet.sender()).to_owned();
        let (name, rssi) = (self.name(packet.radio()), packet.rssi().dbm());
        self.say(
            me,
            &format!("hears {text} from {from} on {name} with {rssi:.1} dBm"),
        );
    }

    fn sent(&self, outcome: &Outcome, me: &mut Platform<'_>) {
        let result = outcome.result.map_or_else(Lost::name, |()| "sent");
        self.say(me, &format!("#{} {result}", outcome.ticket.0));
    }
}

macro_rules! operator {
    ($name:literal, $type:ident, $host:ident, $view:ty) => {
        /// An operator.
        #[behavior($name, host = $host)]
        struct $type(Operator);

        impl Behavior<$host> for $type {
            type Params = OperatorParams;

            fn build(p: OperatorParams, kit: &mut Kit<Self, $host>) -> Result<Self, BuildError> {
                let names = p.radios.iter();
                let named = names.map(|n| Ok((n.clone(), kit.radio_named(n)?)));
                let mut radios = named.collect::<Result<Vec<_>, BuildError>>()?;
                if radios.is_empty() {
                    radios.push(("radio".to_owned(), kit.radio()?));
                }
                let operator = Operator::new(&p, radios);
                for line in &operator.script {
                    kit.once(line.at, |me: &mut Self, host| me.0.act(host));
                }
                kit.on_sent(|me, outcome, host| me.0.sent(outcome, host));
                Ok(Self(operator))
            }

            fn body(_: &OperatorParams) -> Option<BodySpec> {
                let ball = BodySpec::new(Shape::Sphere { radius_m: 0.1 }, 1.0);
                Some(BodySpec {
                    mobility: Mobility::Driven,
                    ..ball
                })
            }

            fn on_packet(&mut self, packet: &Packet<'_>, host: &mut $view) {
                self.0.heard(packet, host);
            }
        }
    };
}

operator!("test-operator", FlyingOperator, Flying, Bee<'_>);
operator!("test-tower", StandingOperator, Station, Platform<'_>);

/// Keeps what is said.
#[derive(Clone, Default)]
struct Log(Arc<Mutex<Vec<String>>>);

impl Component for Log {
    fn period(&self) -> Option<Time> {
        Some(Time::from_millis(50.0))
    }

    fn start(&mut self, _: &View<'_>) -> Result<(), ComponentError> {
        Ok(())
    }

    fn finish(&mut self, view: &View<'_>, _: &Summary) -> Result<Vec<Note>, ComponentError> {
        self.observe(view)?;
        Ok(Vec::new())
    }

    fn observe(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        for mark in view.marks() {
            let line = match mark {
                Mark::Log { time, text, .. } => format!("{time} {text}"),
                Mark::Metric {
                    time,
                    model,
                    name,
                    value,
                    ..
                } => format!("{time} {} {name} {value}", view.population().path(*model)),
                _ => continue,
            };
            self.0.lock().expect("one thread at a time").push(line);
        }
        Ok(())
    }
}

/// One platform of a scenario: what it is, where on the way east, its radios and its script.
struct Cast<'a> {
    name: &'a str,
    kind: &'a str,
    east_m: f64,
    radios: &'a str,
    script: &'a [&'a str],
}

impl<'a> Cast<'a> {
    fn bee(name: &'a str, east_m: f64, script: &'a [&'a str]) -> Self {
        let (kind, radios) = ("test-operator", "radio = { use = \"cc2420\" }");
        Self {
            name,
            kind,
            east_m,
            radios,
            script,
        }
    }

    fn text(&self) -> String {
        let Self {
            name,
            kind,
            east_m,
            radios,
            script,
        } = self;
        let names = match radios.contains("radio.") {
            true => "radios = [\"long\", \"short\"],",
            false => "",
        };
        format!(
            r#"
            [[model]]
            use = "{kind}"
            name = "{name}"
            start = ["{east_m} m", "0 m", "10 m"]
            params = {{ {names} script = {script:?} }}
            {radios}
            "#
        )
    }
}

/// The channel of the tests: no luck in it, frames of 20 m.
const SIMPLE: &str = r#"[channel]
    medium = "simple"
    range_limit = "20 m"
    noise_floor = { mean = "-100 dBm", sigma = "0 dB" }"#;

/// What is said in a run of a second, or why it ends early.
fn play(channel: &str, cast: &[Cast<'_>]) -> Result<Vec<String>, String> {
    let models: String = cast.iter().map(Cast::text).collect();
    play_text(&format!(
        "[run]\nseed = 1\nend_time = \"1 s\"\n{channel}\n{models}"
    ))
}

/// What is said and published in a run, or why it ends early.
pub(crate) fn play_text(text: &str) -> Result<Vec<String>, String> {
    let loaded = load_text("radio", text, &Request::default());
    let loaded = loaded.map_err(|rejected| format!("{:?}", rejected.faults))?;
    let mut setup = loaded.setup().map_err(|faults| format!("{faults:?}"))?;
    let log = Log::default();
    setup
        .components
        .push(("log".to_owned(), Box::new(log.clone())));
    let mut run = Simulation::new(setup).map_err(|error| error.to_string())?;
    match run.run().error {
        Some(error) => Err(error.to_string()),
        None => Ok(log.0.lock().expect("one thread at a time").clone()),
    }
}

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

/// Two radios, far apart in the spectrum and in strength.
const TWO: &str = r#"
            [model.radio.long]
            use = "cc2420"
            channel = 11
            [model.radio.short]
            use = "cc2420"
            channel = 26
            tx_level = 3"#;

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
