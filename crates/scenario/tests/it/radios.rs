//! Radios and antennas of scenarios, the original's among them, loaded and run.

use crate::{bad, good, shown};
use simbeeotic_model::Simulation;
use simbeeotic_model::config::Level;
use simbeeotic_model::units::glam::DVec3;
use simbeeotic_scenario::{Loaded, Request, load_file, render};

/// Three bees of the original that speak once a second, with this radio.
fn xml(radio: &str) -> String {
    format!(
        r#"<scenario xmlns="http://harvard/robobees/simbeeotic/configuration/scenario">
  <master-seed><constant value="7"/></master-seed>
  <simulation><end-time>3.5</end-time></simulation>
  <models>
    <model>
      <java-class>harvard.robobees.simbeeotic.model.comms.FreeSpacePropagationModel</java-class>
      <properties><prop name="noise-floor-sigma" value="0"/></properties>
    </model>
    <model count="3">
      <java-class>harvard.robobees.simbeeotic.example.InstrumentBee</java-class>
      <properties>
        <prop name="use-radio" value="true"/>
        <prop name="use-random-start" value="true"/>
        <prop name="random-start-bound" value="3"/>
      </properties>
      <sensor name="compass">
        <java-class>harvard.robobees.simbeeotic.model.sensor.DefaultCompass</java-class>
      </sensor>
      <radio>{radio}</radio>
      <start-position x="0" y="0" z="0"/>
    </model>
  </models>
</scenario>"#
    )
}

fn said(loaded: &Loaded) -> String {
    render::faults(loaded.faults(), loaded.sources(), false)
}

/// Packets sent and received until the end.
fn counts(loaded: &Loaded) -> (u64, u64) {
    let setup = loaded.setup().expect("a set-up");
    let outcome = Simulation::new(setup).expect("a run").run();
    let packets = outcome.summary.packets;
    (packets.sent, packets.received)
}

#[test]
fn an_rf230_of_the_original_loads_and_runs() {
    let loaded = good(
        "rf230.xml",
        &xml(
            r#"<java-class>harvard.robobees.simbeeotic.model.comms.RF230</java-class>
               <properties>
                 <prop name="channel" value="15"/>
                 <prop name="tx-power-level" value="4"/>
               </properties>"#,
        ),
    );
    let setup = loaded.setup().expect("a set-up");
    let radio = &setup.models[0].gear.radios[0].spec;
    assert_eq!(radio.tx_power.dbm(), 1.1);
    assert_eq!(radio.channel.centre.get(), 2.425e9);
    assert!(
        !said(&loaded).contains("not simulated yet"),
        "{}",
        said(&loaded)
    );
    let (sent, received) = counts(&loaded);
    assert!(sent > 0 && received == 2 * sent, "{sent} {received}");
}

#[test]
fn a_default_radio_of_the_original_loads_and_runs() {
    let loaded = good(
        "default.xml",
        &xml(
            r#"<java-class>harvard.robobees.simbeeotic.model.comms.DefaultRadio</java-class>
               <properties>
                 <prop name="max-power" value="15"/>
                 <prop name="snr-margin" value="9"/>
                 <prop name="tx-energy" value="20"/>
                 <prop name="bandwidth" value="125"/>
               </properties>"#,
        ),
    );
    let setup = loaded.setup().expect("a set-up");
    let radio = &setup.models[0].gear.radios[0].spec;
    assert_eq!(radio.tx_power.dbm(), 15.0);
    assert!((radio.currents.tx.milliamperes() - 20.0).abs() < 1e-12);
    assert_eq!(radio.data_rate.get(), 125e3);
    // What the original did wrong with its rate is told.
    assert!(said(&loaded).contains("125 times"), "{}", said(&loaded));
    let (sent, received) = counts(&loaded);
    assert!(sent > 0 && received == 2 * sent, "{sent} {received}");
}

#[test]
fn the_original_s_rotation_and_send_queue_do_something() {
    let loaded = good(
        "turned.xml",
        &xml(
            r#"<java-class>harvard.robobees.simbeeotic.model.comms.CC2420</java-class>
               <properties>
                 <prop name="rotation" value="1.5707963267948966"/>
                 <prop name="send-queue-size" value="12"/>
               </properties>"#,
        ),
    );
    let quiet = loaded.faults().iter().all(|f| f.level == Level::Note);
    assert!(quiet, "{}", said(&loaded));
    let setup = loaded.setup().expect("a set-up");
    let radio = &setup.models[0].gear.radios[0];
    assert_eq!(radio.spec.queue_frames, 12);
    let left = radio.mount.attitude.forward() - DVec3::Y;
    assert!(left.length() < 1e-12, "{left}");
}

/// A bee with one radio, as TOML.
fn toml(radio: &str) -> String {
    format!(
        "[run]\nend_time = \"1 s\"\n[[model]]\nuse = \"broadcast-bee\"\n[model.radio]\n{radio}\n"
    )
}

#[test]
fn a_queue_without_room_is_refused() {
    let text = bad("x.toml", &toml("use = \"cc2420\"\nqueue_frames = 0"));
    assert!(
        text.contains("`queue_frames` must lie between 1 and"),
        "{text}"
    );
    let loaded = good("x.toml", &toml("use = \"nrf51\"\nqueue_frames = 3"));
    let setup = loaded.setup().expect("a set-up");
    assert_eq!(setup.models[0].gear.radios[0].spec.queue_frames, 3);
}

#[test]
fn every_radio_and_antenna_can_be_chosen_by_name() {
    for radio in [
        "cc2420",
        "rf230",
        "rf233",
        "nrf24",
        "nrf51",
        "sx127x",
        "default-radio",
    ] {
        for antenna in [
            "isotropic",
            "short-dipole",
            "half-wave-dipole",
            "patch",
            "cosine",
        ] {
            let text = toml(&format!("use = \"{radio}\"\nantenna = \"{antenna}\""));
            good("x.toml", &text).setup().expect("a set-up");
        }
    }
    let text = bad(
        "x.toml",
        &toml("use = \"cc2420\"\nantenna = { use = \"patch\", e_plane = \"180 deg\" }"),
    );
    assert!(
        text.contains("beamwidth in the E plane of 180 deg"),
        "{text}"
    );
}

#[test]
fn an_antenna_s_file_is_looked_for_beside_the_scenario() {
    let folder = tempfile::tempdir().expect("a folder");
    let scenario = folder.path().join("x.toml");
    let text = toml("use = \"cc2420\"\nantenna = { use = \"pattern\", file = \"chip.csv\" }");
    std::fs::write(&scenario, text).expect("written");
    let table = folder.path().join("chip.csv");
    std::fs::write(&table, "azimuth,elevation,gain\n0,0,3\n180,0,-5\n").expect("written");
    let loaded =
        load_file(&scenario, &Request::default()).unwrap_or_else(|r| panic!("{}", shown(&r)));
    let setup = loaded.setup().expect("a set-up");
    let antenna = &setup.models[0].gear.radios[0].antenna;
    assert!((antenna.gain(DVec3::X).db() - 3.0).abs() < 1e-9);

    std::fs::write(
        &table,
        "azimuth,elevation,gain\n0,0,3\n180,0,west\n90,95,1\n",
    )
    .expect("written");
    let Err(rejected) = load_file(&scenario, &Request::default()) else {
        panic!("the table is wrong");
    };
    let text = shown(&rejected);
    assert!(text.contains("chip.csv:3:7: `west` is no number"), "{text}");
    assert!(text.contains("chip.csv:4:4: an elevation of 95"), "{text}");
}
