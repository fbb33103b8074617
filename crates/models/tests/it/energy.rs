//! Batteries in runs: when they are empty, what follows, and that no charge gets lost.

use crate::swarm::{bee, run, run_in, setup, vehicle, with_battery, with_radio};
use simbeeotic_model::host::Station;
use simbeeotic_model::kernel::SimTime;
use simbeeotic_model::physics::{BodySpec, Mobility, Shape};
use simbeeotic_model::radio::{Packet, RadioState};
use simbeeotic_model::units::{Angle, Current, Time, Velocity};
use simbeeotic_model::world::Calm;
use simbeeotic_model::{
    BatteryEvent, Bee, Behavior, BuildError, Condition, Consumer, Kit, ModelPlan, Platform,
    RadioHandle, Simulation, behavior, params,
};
use std::sync::{Arc, Mutex};

/// None.
#[params]
#[derive(Default)]
struct NoParams {}

/// What test bees have heard: path, time in ns, what.
static HEARD: Mutex<Vec<(String, u64, String)>> = Mutex::new(Vec::new());

fn note(path: &str, now: SimTime, what: impl std::fmt::Debug) {
    let line = (path.to_owned(), now.nanos(), format!("{what:?}"));
    HEARD.lock().expect("no panic holds it").push(line);
}

/// The seconds at which `path` heard of `what`.
fn heard(path: &str, what: &str) -> Vec<f64> {
    let heard = HEARD.lock().expect("no panic holds it");
    let own = heard.iter().filter(|(p, _, w)| p == path && w == what);
    own.map(|(_, at, _)| *at as f64 * 1e-9).collect()
}

/// Draws a constant current and does nothing else.
#[behavior("test-load", host = Station)]
struct Load;

/// When it draws something at once.
const FRAME_S: f64 = 100.0;

impl Behavior<Station> for Load {
    type Params = NoParams;

    fn build(_: NoParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        kit.once(Time::ZERO, |_, platform| {
            platform.set_load(Consumer::Avionics, Current::si(1.0));
        });
        kit.once(Time::from_secs(FRAME_S), |_, platform| {
            // A third of a milliampere-second at once: a frame, say.
            platform.draw(
                Consumer::RadioTx,
                simbeeotic_model::units::Charge::si(3.3e-4),
            );
        });
        Ok(Self)
    }

    fn body(_: &NoParams) -> Option<BodySpec> {
        Some(BodySpec {
            mobility: Mobility::Fixed,
            ..BodySpec::new(Shape::Sphere { radius_m: 0.1 }, 1.0)
        })
    }

    fn on_battery(&mut self, event: BatteryEvent, platform: &mut Platform<'_>) {
        note(platform.path(), platform.now(), event);
    }
}

/// Hovers, and sends once a second.
#[behavior("test-hoverer")]
struct Hoverer {
    radio: Option<RadioHandle>,
    ticks: u32,
}

impl Behavior for Hoverer {
    type Params = NoParams;

    fn build(_: NoParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        kit.every(Time::from_secs(1.0), Self::tick);
        Ok(Self {
            radio: kit.optional_radio(),
            ticks: 0,
        })
    }

    fn on_battery(&mut self, event: BatteryEvent, bee: &mut Bee<'_>) {
        note(bee.path(), bee.now(), event);
    }

    fn on_packet(&mut self, _: &Packet<'_>, bee: &mut Bee<'_>) {
        note(bee.path(), bee.now(), "packet");
    }

    fn on_finish(&mut self, bee: &mut Bee<'_>) {
        let state = self.radio.map(|radio| bee.radio_state(radio));
        let silent = state.is_none_or(|state| state == RadioState::Sleep);
        note(bee.path(), bee.now(), (self.ticks, bee.condition(), silent));
    }
}

impl Hoverer {
    fn tick(&mut self, bee: &mut Bee<'_>) {
        self.ticks += 1;
        bee.turn(Angle::from_degrees(10.0));
        bee.fly(Velocity::from_xyz(1.0, 0.0, 0.0));
        if let Some(radio) = self.radio {
            bee.send(radio, &[1, 2, 3, 4]);
        }
    }
}

/// 250 mAh that last to the last drop.
const PLAIN: [(&str, &str); 4] = [
    ("cutoff", "0 V"),
    ("reserve", "0"),
    ("on_empty", "stop"),
    ("low", "0.2"),
];

fn load(path: &str, keys: &[(&str, &str)]) -> ModelPlan {
    with_battery(bee(path, "test-load", &[], [0.0; 3]), keys)
}

/// 30 mAh, so that a hover of 0.5 A lasts 216 s.
fn hoverer(path: &str, at: [f64; 3], on_empty: &str, more: &[(&str, &str)]) -> ModelPlan {
    let mut keys = vec![
        ("capacity", "30 mAh"),
        ("on_empty", on_empty),
        ("cutoff", "0 V"),
    ];
    keys.extend_from_slice(more);
    with_battery(bee(path, "test-hoverer", &[], at), &keys)
}

/// The books balance: charge and energy, to 1e-9 of what there was.
fn assert_balanced(run: &Simulation, path: &str) {
    let (state, books) = run.battery(path).expect("a battery");
    let accounts = run.accounts(path).expect("a model");
    let drawn_c = accounts.total().get();
    let given = books.start_charge + books.charged_charge - books.lost_charge;
    let held_c = given.get() - drawn_c;
    let gap_c = held_c - state.charge.get();
    assert!(
        gap_c.abs() < 1e-9 * (books.start_charge + books.charged_charge).get(),
        "{path}: {gap_c} C of {}",
        books.start_charge
    );
    let used_j: f64 = Consumer::ALL.iter().map(|c| books.used(*c).get()).sum();
    let lost_j = books.start.get() + books.charged.get() - books.stored.get();
    let gap_j = lost_j - used_j - books.heat.get();
    assert!(
        gap_j.abs() < 1e-9 * (books.start + books.charged).get(),
        "{path}: {gap_j} J of {lost_j} J"
    );
}

#[test]
fn a_load_of_one_ampere_empties_250_mah_in_900_s_to_the_nanosecond() {
    let mut run = run(vec![load("exact", &PLAIN)], 2000);
    run.run_until(SimTime::from_secs(2000)).expect("it runs");
    // A fifth is left at 720 s; the draw at 100 s takes 0.33 ms of both.
    let (low, flat) = (heard("exact", "Low"), heard("exact", "Empty"));
    assert!(
        low.len() == 1 && (low[0] - (720.0 - 3.3e-4)).abs() < 2e-9,
        "{low:?}"
    );
    assert!(
        flat.len() == 1 && (flat[0] - (900.0 - 3.3e-4)).abs() < 2e-9,
        "{flat:?}"
    );
    assert_balanced(&run, "exact");
    let (state, books) = run.battery("exact").expect("a battery");
    assert!(state.soc < 1e-8 && state.condition == Condition::Off);
    assert_eq!(books.used(Consumer::Hover).get(), 0.0);
}

#[test]
fn waiting_for_the_end_takes_a_handful_of_events() {
    let mut run = run(vec![load("patient", &PLAIN)], 2000);
    let outcome = run.run();
    // Start, two of its own, end; the timer 90 % of the way four times to each threshold.
    assert!(outcome.summary.events < 24, "{}", outcome.summary.events);
}

#[test]
fn a_battery_is_empty_when_its_voltage_breaks_down() {
    // 3.78 V at a tenth: 1 A through 100 mohm shows 3.68 V there.
    let keys = [
        ("internal_resistance", "100 mohm"),
        ("cutoff", "3.68 V"),
        ("reserve", "0"),
        ("on_empty", "stop"),
        ("low", "0.05"),
    ];
    let mut run = run(vec![load("sag", &keys)], 2000);
    run.run_until(SimTime::from_secs(2000)).expect("it runs");
    let empty = heard("sag", "Empty");
    assert!((empty[0] - (810.0 - 3.3e-4)).abs() < 1e-6, "{empty:?}");
    let (state, _) = run.battery("sag").expect("a battery");
    assert!((state.soc - 0.1).abs() < 1e-8 && (state.voltage.get() - 3.78).abs() < 1e-6);
    assert_balanced(&run, "sag");
}

#[test]
fn it_lands_where_it_is_and_stays_there() {
    let plan = hoverer("lander", [0.0, 0.0, 3.0], "land", &[("low", "0.3")]);
    let mut run = run(vec![plan], 600);
    let outcome = run.run();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    let empty = heard("lander", "Empty")[0];
    // 95 % of 108 C at 0.5 A and something for flying.
    assert!((150.0..205.2).contains(&empty), "{empty}");
    assert_eq!(heard("lander", "Low").len(), 1);
    let height = run.pose("lander").expect("a body").position.si().z;
    assert!((height - 0.05).abs() < 1e-3, "{height}");
    assert!(run.twist("lander").expect("a body").linear.si().length() < 1e-6);
    let (state, _) = run.battery("lander").expect("a battery");
    // On the ground nothing draws any more, and landing took less than the reserve.
    assert_eq!(state.condition, Condition::Grounded);
    assert!(state.soc > 0.0 && state.soc < 0.05 && state.current == Current::ZERO);
    assert_balanced(&run, "lander");
}

#[test]
fn it_sinks_at_its_landing_speed_whatever_its_behaviour_wants() {
    let keys = [
        ("low", "0.3"),
        ("landing_speed", "0.4 m/s"),
        ("reserve", "0.3"),
    ];
    let mut run = run(
        vec![hoverer("sinker", [0.0, 0.0, 50.0], "land", &keys)],
        400,
    );
    run.run_until(SimTime::from_secs(190)).expect("it runs");
    let velocity = run.twist("sinker").expect("a body").linear.si();
    assert!((velocity.z + 0.4).abs() < 1e-3, "{velocity}");
    assert!(velocity.truncate().length() < 1e-3, "{velocity}");
}

#[test]
fn a_landing_longer_than_the_reserve_ends_in_a_fall() {
    let keys = [("low", "0.3"), ("reserve", "0.01")];
    let mut run = run(
        vec![hoverer("too-high", [0.0, 0.0, 200.0], "land", &keys)],
        400,
    );
    run.run_until(SimTime::from_secs(400)).expect("it runs");
    let (empty, flat) = (heard("too-high", "Empty")[0], heard("too-high", "Flat")[0]);
    assert!(flat > empty && flat < empty + 3.0, "{empty} {flat}");
    let (state, _) = run.battery("too-high").expect("a battery");
    assert_eq!(state.condition, Condition::Off);
    let height = run.pose("too-high").expect("a body").position.si().z;
    assert!(height < 0.1, "{height}");
    assert_balanced(&run, "too-high");
}

#[test]
fn it_falls_at_once_and_its_computer_lives_on() {
    let plan = hoverer("faller", [0.0, 0.0, 30.0], "fall", &[("avionics", "10 mA")]);
    let plan = with_radio(plan);
    let mut run = run(vec![plan], 260);
    let outcome = run.run();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    let empty = heard("faller", "Empty")[0];
    // A fall of 30 m takes 2.5 s: it lies by then, and ticks to the end of the run.
    assert!(empty < 210.0, "{empty}");
    let height = run.pose("faller").expect("a body").position.si().z;
    assert!(height < 0.1, "{height}");
    assert_eq!(heard("faller", "(261, Grounded, false)").len(), 1);
    assert_balanced(&run, "faller");
}

#[test]
fn when_everything_stops_nobody_is_called_and_nothing_is_drawn() {
    let at = [0.0, 0.0, 0.0];
    let on_board = [("charge", "0.1"), ("avionics", "10 mA")];
    let stopper = with_radio(hoverer("stopper", at, "stop", &on_board));
    let talker = with_radio(bee("talker", "test-hoverer", &[], [3.0, 0.0, 0.0]));
    let mut run = run(vec![stopper, talker], 100);
    let outcome = run.run();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    // A tenth of 108 C at 0.5 A and more.
    let empty = heard("stopper", "Empty");
    assert!(
        empty.len() == 1 && (10.0..21.0).contains(&empty[0]),
        "{empty:?}"
    );
    assert!(heard("stopper", "Flat").is_empty());
    let ticks = empty[0].floor() as u32 + 1;
    assert_eq!(heard("stopper", &format!("({ticks}, Off, true)")).len(), 1);
    let packets = heard("stopper", "\"packet\"");
    assert!(!packets.is_empty() && packets.iter().all(|at| *at <= empty[0]));
    let (state, _) = run.battery("stopper").expect("a battery");
    assert!(state.soc < 1e-6 && state.condition == Condition::Off);
    assert_balanced(&run, "stopper");
}

#[test]
fn batteries_do_not_hang_on_threads_and_give_other_traces_than_none() {
    let swarm = |battery: bool| -> Vec<ModelPlan> {
        let bee = |at: u32| {
            let place = [f64::from(at % 8), f64::from(at / 8), 5.0];
            let path = format!("swarm-{battery}-{at}");
            let plan = with_radio(hoverer(&path, place, "land", &[("charge", "0.1")]));
            match battery {
                true => plan,
                false => ModelPlan {
                    gear: without(&plan),
                    ..plan
                },
            }
        };
        (0..64).map(bee).collect()
    };
    let hash = |battery: bool, threads: usize| {
        let mut run = run_in(swarm(battery), 40, Arc::new(Calm), threads);
        let summary = run.run().summary;
        (summary.trace_hash, summary.trace_seconds)
    };
    let (one, two) = (hash(true, 1), hash(true, 2));
    assert_eq!(one, two);
    assert_ne!(one, hash(false, 1), "an empty battery changes nothing");
}

fn without(plan: &ModelPlan) -> Arc<simbeeotic_model::instance::GearPlan> {
    let mut gear = (*plan.gear).clone();
    gear.supply = None;
    Arc::new(gear)
}

#[test]
fn a_battery_that_never_runs_out_leaves_a_flight_alone() {
    let fly = |plan: ModelPlan| {
        let mut run = run(vec![plan], 20);
        run.run_until(SimTime::from_secs(20)).expect("it runs");
        run.pose("bee").expect("a body")
    };
    let plan = || bee("bee", "random-walk-bee", &[], [0.0, 0.0, 20.0]);
    assert_eq!(fly(plan()), fly(with_battery(plan(), &[])));
}

#[test]
fn what_needs_no_battery_is_refused_one() {
    let plan = with_battery(crate::swarm::model("clock", "test-bodiless"), &[]);
    let fault = Simulation::new(setup(vec![plan], 1))
        .err()
        .expect("it is refused");
    assert!(fault.to_string().contains("battery"), "{fault}");
}

/// Nothing.
#[behavior("test-bodiless", host = simbeeotic_model::host::Bodiless)]
struct Nobody;

impl Behavior<simbeeotic_model::host::Bodiless> for Nobody {
    type Params = NoParams;

    fn build(
        _: NoParams,
        _: &mut Kit<Self, simbeeotic_model::host::Bodiless>,
    ) -> Result<Self, BuildError> {
        Ok(Self)
    }
}

#[test]
fn the_originals_accounting_gives_the_originals_figures() {
    let keys = [("preset", "none"), ("accounting", "original")];
    let hover = |original: bool| {
        let plan = with_radio(vehicle("bee", "broadcast-bee", &[], &[], [0.0, 0.0, 5.0]));
        let plan = if original {
            with_battery(plan, &keys)
        } else {
            plan
        };
        let mut run = run(vec![plan], 2);
        run.run_until(SimTime::from_secs(2)).expect("it runs");
        let accounts = run.accounts("bee").expect("a model");
        move |consumer| accounts.drawn(consumer).milliampere_seconds()
    };
    // Hovering for 2 s are 21 steps of 0.1 s at 500 mA; what flows in 2 s are 1000 mA s.
    let close = |is: f64, want: f64| assert!((is - want).abs() < 1e-9, "{is} for {want}");
    let (original, exact) = (hover(true), hover(false));
    close(original(Consumer::Hover), 1050.0);
    close(exact(Consumer::Hover), 1000.0);
    // Each frame is payload / 125 / 250 s at 17.4 mA. 21 looks at an idle radio, 0.426 mA.
    let frames = original(Consumer::RadioTx) / (17.4 / 125.0 / 250.0);
    assert!(
        frames > 0.5 && (frames - frames.round()).abs() < 1e-9,
        "{frames}"
    );
    let idle = original(Consumer::RadioIdle);
    assert!(
        (idle - 0.426 * 2.1).abs() < 0.426 * 0.01 && idle < 0.426 * 2.1,
        "{idle}"
    );
}

/// A bee that lies on a hive, and one that lies beside it.
fn on_hive(path: &str, keys: &[(&str, &str)]) -> ModelPlan {
    let rest = [("hover_current", "0 A"), ("actuation_current", "0 A")];
    let plan = vehicle(path, "test-sleeper", &[], &rest, [0.1, 0.1, 0.2]);
    with_battery(plan, keys)
}

/// Lies where it is.
#[behavior("test-sleeper")]
struct Sleeper;

impl Behavior for Sleeper {
    type Params = NoParams;

    fn build(_: NoParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        kit.once(Time::ZERO, |_, bee| bee.hover(false));
        Ok(Self)
    }

    fn on_battery(&mut self, event: BatteryEvent, bee: &mut Bee<'_>) {
        note(bee.path(), bee.now(), event);
    }
}

#[test]
fn a_hive_charges_at_its_current_then_at_constant_voltage_until_full() {
    let hive = bee("hive", "charging-hive", &[("current", "0.25 A")], [0.0; 3]);
    let keys = [
        ("capacity", "50 mAh"),
        ("max_charge_current", "1 A"),
        ("charge", "0.5"),
        ("charge_efficiency", "0.9"),
    ];
    let bee = on_hive("guest", &keys);
    let mut run = run(vec![hive, bee], 600);
    run.run_until(SimTime::from_secs(200)).expect("it runs");
    let (state, _) = run.battery("guest").expect("a battery");
    // The first look may come before it has settled on the box.
    let want = 0.5 + 0.9 * 0.25 * 200.0 / 180.0;
    assert!(
        (state.soc - want).abs() < 0.9 * 0.25 * 3.0 / 180.0,
        "{} for {want}",
        state.soc
    );
    assert!(state.on_charger && (state.current.get() + 0.25).abs() < 1e-12);
    let open_v = 4.0 + 0.04 * (state.soc - 0.7) / 0.1;
    assert!((state.voltage.get() - open_v - 0.06 * 0.25).abs() < 1e-9);

    // 4.2 V - 0.25 A x 60 mohm = 4.185 V: constant voltage from a soc of 0.985.
    let turn_s = (0.985 - 0.5) * 180.0 / (0.9 * 0.25);
    run.run_until(SimTime::from_secs(turn_s as u64 + 5))
        .expect("it runs");
    let (state, _) = run.battery("guest").expect("a battery");
    assert!((state.voltage.get() - 4.2).abs() < 1e-9 && state.current.get() > -0.25);
    run.run_until(SimTime::from_secs(600)).expect("it runs");
    let (state, books) = run.battery("guest").expect("a battery");
    assert!(state.soc > 0.999 && !state.on_charger, "{state:?}");
    assert_eq!((heard("guest", "Charged").len(), books.fills), (1, 1));
    assert_balanced(&run, "guest");
}

#[test]
fn each_pad_serves_one_and_who_is_full_makes_room() {
    let pads = [("pads", "1"), ("current", "1 A")];
    let hive = bee("hive", "charging-hive", &pads, [0.0; 3]);
    let keys = [
        ("capacity", "10 mAh"),
        ("charge", "0.5"),
        ("max_charge_current", "0.1 A"),
    ];
    let mut models = vec![hive];
    models.extend(["one", "two"].map(|path| on_hive(path, &keys)));
    // One without a battery takes no pad for long, one in the air none at all.
    models.push(vehicle("none", "test-sleeper", &[], &[], [0.2, 0.0, 0.2]));
    let floater = hoverer("above", [0.0, 0.0, 1.0], "land", &[("charge", "0.5")]);
    models.push(floater);
    let mut run = run(models, 900);
    run.run_until(SimTime::from_secs(100)).expect("it runs");
    let soc = |run: &Simulation, path| run.battery(path).expect("a battery").0.soc;
    assert!(soc(&run, "one") > 0.7 && soc(&run, "two") == 0.5);
    assert!(soc(&run, "above") < 0.5);
    run.run_until(SimTime::from_secs(900)).expect("it runs");
    assert!(soc(&run, "one") > 0.99 && soc(&run, "two") > 0.99);
    assert!(heard("two", "Charged")[0] > heard("one", "Charged")[0] + 100.0);
}

#[test]
fn what_has_stopped_starts_again_when_it_is_charged() {
    let hive = bee(
        "hive",
        "charging-hive",
        &[("current", "1 A"), ("period", "50 s")],
        [0.0; 3],
    );
    let mut keys = PLAIN.to_vec();
    keys.extend([
        ("capacity", "10 mAh"),
        ("charge", "0.01"),
        ("avionics", "30 mA"),
    ]);
    keys.push(("max_charge_current", "0.1 A"));
    let plan = with_radio(on_hive("riser", &keys));
    let mut run = run(vec![hive, plan], 800);
    run.run_until(SimTime::from_secs(40)).expect("it runs");
    let (state, _) = run.battery("riser").expect("a battery");
    assert_eq!(
        (state.condition, state.current),
        (Condition::Off, Current::ZERO)
    );
    run.run_until(SimTime::from_secs(800)).expect("it runs");
    let (state, books) = run.battery("riser").expect("a battery");
    assert_eq!(
        (state.condition, books.fills, books.empties),
        (Condition::Fit, 1, 1)
    );
    assert_balanced(&run, "riser");
}

#[test]
fn foragers_come_home_and_set_out_again() {
    let hive = bee("hive", "charging-hive", &[("pads", "2")], [0.0; 3]);
    let keys = [
        ("capacity", "10 mAh"),
        ("low", "0.4"),
        ("max_charge_current", "0.3 A"),
    ];
    let forager = |at: u32| {
        let place = [f64::from(at) - 1.0, 2.0, 1.0];
        with_battery(
            bee(
                &format!("bee-{at}"),
                "forager-bee",
                &[("range", "10 m")],
                place,
            ),
            &keys,
        )
    };
    let mut models = vec![hive];
    models.extend((0..3).map(forager));
    let mut run = run(models, 500);
    let outcome = run.run();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    for at in 0..3 {
        let path = format!("bee-{at}");
        let (_, books) = run.battery(&path).expect("a battery");
        assert!(books.fills >= 2 && books.empties == 0, "{path}: {books:?}");
        assert_balanced(&run, &path);
    }
}

#[test]
fn a_hive_with_nonsense_is_refused() {
    for (key, value) in [
        ("pads", "0"),
        ("pads", "100001"),
        ("pad_radius", "0 m"),
        ("current", "0 A"),
        ("period", "0 s"),
    ] {
        let plan = bee("hive", "charging-hive", &[(key, value)], [0.0; 3]);
        let fault = Simulation::new(setup(vec![plan], 1)).err().expect(key);
        assert!(fault.to_string().contains(key), "{fault}");
    }
    for key in ["range", "height", "speed", "landing_radius"] {
        let zero = if key == "speed" { "0 m/s" } else { "0 m" };
        let plan = bee("bee", "forager-bee", &[(key, zero)], [0.0; 3]);
        let fault = Simulation::new(setup(vec![plan], 1)).err().expect(key);
        assert!(fault.to_string().contains(key), "{fault}");
    }
}
