//! Platforms that do with their radios what a script says, for tests.

use simbeeotic::prelude::*;
use simbeeotic::radio::{Channel, Loss as Lost, cc2420};
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
            ["power", _, level] => {
                let level = level.parse().expect("a number");
                let (level, current) = cc2420::pa_level(level).expect("a level");
                me.set_power(radio, level, current);
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
pub(crate) struct Cast<'a> {
    pub(crate) name: &'a str,
    pub(crate) kind: &'a str,
    pub(crate) east_m: f64,
    pub(crate) radios: &'a str,
    pub(crate) script: &'a [&'a str],
}

impl<'a> Cast<'a> {
    pub(crate) fn bee(name: &'a str, east_m: f64, script: &'a [&'a str]) -> Self {
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
pub(crate) const SIMPLE: &str = r#"[channel]
    medium = "simple"
    range_limit = "20 m"
    noise_floor = { mean = "-100 dBm", sigma = "0 dB" }"#;

/// What is said in a run of a second, or why it ends early.
pub(crate) fn play(channel: &str, cast: &[Cast<'_>]) -> Result<Vec<String>, String> {
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

/// Two radios, far apart in the spectrum and in strength.
pub(crate) const TWO: &str = r#"
            [model.radio.long]
            use = "cc2420"
            channel = 11
            [model.radio.short]
            use = "cc2420"
            channel = 26
            tx_level = 3"#;
