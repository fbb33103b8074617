//! Timers, messages, queries and components: what models have whatever carries them.

use crate::swarm::{bee, model, run, setup, with_radio};
use simbeeotic_model::host::{Bodiless, Cx};
use simbeeotic_model::kernel::SimTime;
use simbeeotic_model::radio::{Inbox, Packet, Ticket};
use simbeeotic_model::units::Time;
use simbeeotic_model::{
    Bee, Behavior, BuildError, Call, Component, ComponentError, Kit, Mark, Message, Note,
    RadioHandle, Simulation, Summary, TimerHandle, View, behavior, params,
};
use std::sync::{Arc, Mutex};

/// None.
#[params]
#[derive(Default)]
struct NoParams {}

/// A component that keeps what it sees.
#[derive(Clone, Default)]
struct Witness {
    seen: Arc<Mutex<Vec<String>>>,
}

impl Component for Witness {
    fn period(&self) -> Option<Time> {
        Some(Time::from_millis(300.0))
    }

    fn start(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        self.note(format!("start {}", view.population().len()));
        Ok(())
    }

    fn observe(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        for mark in view.marks() {
            match mark {
                Mark::Log { time, text, .. } => self.note(format!("{time} {text}")),
                Mark::Metric {
                    name, value, unit, ..
                } => self.note(format!("{name} {value} {unit}")),
                _ => {}
            }
        }
        Ok(())
    }

    fn finish(&mut self, view: &View<'_>, _: &Summary) -> Result<Vec<Note>, ComponentError> {
        self.observe(view)?;
        Ok(vec![Note {
            key: "witness".into(),
            text: "done".into(),
        }])
    }
}

impl Witness {
    fn note(&self, line: String) {
        self.seen.lock().expect("one thread at a time").push(line);
    }

    fn lines(&self) -> Vec<String> {
        self.seen.lock().expect("one thread at a time").clone()
    }
}

/// Runs models with a witness; returns what they logged.
fn watch(models: Vec<simbeeotic_model::ModelPlan>, seconds: u64) -> Vec<String> {
    let witness = Witness::default();
    let mut setup = setup(models, seconds);
    setup
        .components
        .push(("witness".to_owned(), Box::new(witness.clone())));
    let outcome = Simulation::new(setup)
        .expect("it can be put together")
        .run();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    assert_eq!(outcome.summary.notes.len(), 1);
    witness.lines()
}

/// A model of timers.
#[behavior("test-clock", host = Bodiless)]
struct Clock {
    slow: TimerHandle,
    alarm: TimerHandle,
    never: TimerHandle,
    late: Call,
}

impl Behavior<Bodiless> for Clock {
    type Params = NoParams;

    fn build(_: NoParams, kit: &mut Kit<Self, Bodiless>) -> Result<Self, BuildError> {
        let slow = kit.every(Time::from_secs(1.0), Self::tick);
        let alarm = kit.timer(Self::ring);
        let never = kit.once(Time::from_secs(0.5), |_, cx| cx.fault("it was cancelled"));
        let late = kit.call(|_, cx| cx.log("late"));
        Ok(Self {
            slow,
            alarm,
            never,
            late,
        })
    }
}

impl Clock {
    fn tick(&mut self, cx: &mut Cx<'_>) {
        cx.log("tick");
        if cx.now() == SimTime::ZERO {
            cx.cancel(self.never);
            cx.arm(self.alarm, Time::from_secs(0.25));
            assert_eq!(cx.next_firing(self.alarm), Some(SimTime::from_millis(250)));
            assert_eq!(cx.next_firing(self.never), None);
            cx.after(Time::from_secs(0.75), self.late);
        }
        if cx.now() == SimTime::from_secs(2) {
            // The original ignored a reset to one shot from within the timer's own call.
            cx.arm(self.slow, Time::from_secs(0.1));
        }
    }

    fn ring(&mut self, cx: &mut Cx<'_>) {
        cx.log("ring");
    }
}

#[test]
fn timers_fire_when_they_should_and_not_when_they_were_moved() {
    let lines = watch(vec![model("clock", "test-clock")], 5);
    let expected = [
        "start 1",
        "0 s tick",
        "0.25 s ring",
        "0.75 s late",
        "1 s tick",
        "2 s tick",
        "2.1 s tick",
    ];
    assert_eq!(lines, expected);
}

/// Asks whoever is called "echo", and counts the answers.
#[behavior("test-asker", host = Bodiless)]
struct Asker;

impl Behavior<Bodiless> for Asker {
    type Params = NoParams;

    fn build(_: NoParams, kit: &mut Kit<Self, Bodiless>) -> Result<Self, BuildError> {
        kit.once(Time::from_secs(1.0), |_, cx| {
            assert!(cx.find("nobody").is_none());
            let echo = cx.find("echo").expect("there is one");
            assert_eq!(cx.population().of_kind("test-echo"), [echo]);
            assert_eq!(cx.path_of(echo), "echo");
            assert!(cx.pose_of(echo).is_none(), "it has no body");
            cx.tell(echo, 20_u32);
            cx.tell_after(Time::from_secs(1.0), echo, 21_u32);
        });
        Ok(Self)
    }

    fn on_message(&mut self, message: &Message, cx: &mut Cx<'_>) {
        let answer = message.get::<u32>().expect("the echo answers in numbers");
        cx.metric("answer", f64::from(*answer), "1");
        cx.log(answer);
    }
}

/// Answers with twice the number.
#[behavior("test-echo", host = Bodiless)]
struct Echo;

impl Behavior<Bodiless> for Echo {
    type Params = NoParams;

    fn build(_: NoParams, _kit: &mut Kit<Self, Bodiless>) -> Result<Self, BuildError> {
        Ok(Self)
    }

    fn on_message(&mut self, message: &Message, cx: &mut Cx<'_>) {
        if let Some(number) = message.get::<u32>() {
            cx.tell(message.sender, number * 2);
        }
    }
}

#[test]
fn messages_arrive_in_the_next_round_or_after_their_delay() {
    let lines = watch(
        vec![model("asker", "test-asker"), model("echo", "test-echo")],
        5,
    );
    assert_eq!(
        lines,
        ["start 2", "answer 40 1", "1 s 40", "answer 42 1", "2 s 42"]
    );
}

#[test]
fn a_component_changes_no_trace() {
    let models = || {
        vec![
            model("clock", "test-clock"),
            bee("bee", "random-walk-bee", &[], [0.0, 0.0, 9.0]),
        ]
    };
    let mut alone = run(models(), 5);
    assert!(alone.run().error.is_none());
    let mut setup = setup(models(), 5);
    setup
        .components
        .push(("witness".to_owned(), Box::new(Witness::default())));
    let mut watched = Simulation::new(setup).expect("it can be put together");
    assert!(watched.run().error.is_none());
    assert_eq!(alone.trace().total(), watched.trace().total());
}

/// Sends one packet to the other bee and one to nobody that is there to hear.
#[behavior("test-caller")]
struct Caller {
    radio: RadioHandle,
}

impl Behavior for Caller {
    type Params = NoParams;

    fn build(_: NoParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        kit.once(Time::from_secs(1.0), |caller: &mut Self, bee| {
            let other = bee.find("listener").expect("there is one");
            bee.send_to(caller.radio, other, b"for you");
            bee.send_with_ticket(caller.radio, None, b"for all", Ticket(7));
        });
        Ok(Self {
            radio: kit.radio()?,
        })
    }

    fn on_packets(&mut self, inbox: Inbox<'_>, bee: &mut Bee<'_>) {
        for outcome in inbox.outcomes() {
            bee.log(format!(
                "ticket {} {}",
                outcome.ticket.0,
                outcome.result.is_ok()
            ));
        }
    }
}

/// Says what it hears.
#[behavior("test-listener")]
struct Listener;

impl Behavior for Listener {
    type Params = NoParams;

    fn build(_: NoParams, _kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        Ok(Self)
    }

    fn on_packet(&mut self, packet: &Packet<'_>, bee: &mut Bee<'_>) {
        let text = String::from_utf8_lossy(packet.payload()).into_owned();
        let from = bee.path_of(packet.sender()).to_owned();
        let me = bee.path().to_owned();
        bee.log(format!(
            "{me} hears {text} from {from} with {:.1} dBm",
            packet.rssi().dbm()
        ));
    }
}

#[test]
fn packets_go_to_whom_they_are_for_and_tickets_come_back() {
    let radio = |name, kind, x| with_radio(bee(name, kind, &[], [x, 0.0, 10.0]));
    let lines = watch(
        vec![
            radio("caller", "test-caller", 0.0),
            radio("listener", "test-listener", 10.0),
            radio("third", "test-listener", -10.0),
        ],
        2,
    );
    // 0 dBm over 10 m at 2405 MHz: 60.07 dB (Friis); the original lost 80.07 dB.
    let heard = [
        "start 3",
        "1 s ticket 7 true",
        "1 s listener hears for you from caller with -60.1 dBm",
        "1 s listener hears for all from caller with -60.1 dBm",
        "1 s third hears for all from caller with -60.1 dBm",
    ];
    assert_eq!(lines, heard);
}
