//! Text messages of the server, but for the first one.

use super::Message;
use serde::Serialize;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// A text message to a page. Numbers that are not finite become `null`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
pub enum Said {
    /// How the run goes.
    State {
        /// Virtual time, s.
        time_s: f64,
        /// Whether it is held.
        paused: bool,
        /// The pace asked for.
        factor: Option<f64>,
        /// Virtual seconds a second.
        speed: f64,
        /// Why it ended.
        ended: Option<String>,
        /// Events so far.
        events: u64,
        /// Pages that look.
        viewers: usize,
        /// Frames that this page was not sent because it was slow.
        skipped: u64,
    },
    /// Series, before any value of them.
    Series {
        /// Which.
        list: Vec<SeriesInfo>,
    },
    /// All there is of one series.
    History {
        /// Its number.
        id: u32,
        /// s.
        times_s: Vec<f64>,
        /// In the unit of the series.
        values: Vec<f64>,
    },
    /// What happened.
    Marks {
        /// In the order of their times.
        list: Vec<Mark>,
        /// How many more there were.
        dropped: u64,
    },
    /// What was sent over the air.
    Packets {
        /// In the order of their ends.
        list: Vec<Packet>,
        /// How many more there were.
        dropped: u64,
    },
    /// Who heard whom.
    Links {
        /// The end of the period, s.
        t: f64,
        /// Its length, s.
        period_s: f64,
        /// From, to, mean RSSI (dBm), share received.
        list: Vec<Link>,
    },
    /// The air.
    Wind {
        /// s.
        t: f64,
        /// Position (m) and velocity (m/s), ENU.
        arrows: Vec<[f32; 6]>,
    },
    /// About the selected vehicle.
    Details(Details),
    /// All of a fetch has been sent.
    Fetched {
        /// Whose.
        id: u32,
    },
    /// Something is wrong.
    Error {
        /// For people.
        text: String,
    },
}

/// One series.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeriesInfo {
    /// Its number.
    pub id: u32,
    /// Its name.
    pub name: String,
    /// What it is counted in.
    pub unit: String,
    /// Whose it is; `None`: the run's.
    pub vehicle: Option<u32>,
}

/// One mark on the time line.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mark {
    /// When, s.
    pub t: f64,
    /// `contact`, `log`, or whatever was recorded.
    pub kind: Cow<'static, str>,
    /// The vehicles it happened to.
    pub who: Vec<u32>,
    /// For people.
    pub text: String,
}

/// One packet.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Packet {
    /// When its transmission began, s.
    pub t: f64,
    /// Who sent it.
    pub from: u32,
    /// Its length on the air.
    pub bytes: u32,
    /// Who received it, and how well (dBm).
    pub to: Vec<(u32, f32)>,
}

/// From, to, mean RSSI (dBm), share received.
pub type Link = (u32, u32, f32, f32);

/// Links that one message has.
const LINKS_MAX: usize = 2000;

/// The best of too many links: those that are heard loudest.
pub(crate) fn best(mut list: Vec<Link>) -> Vec<Link> {
    if list.len() > LINKS_MAX {
        list.sort_by(|a, b| b.2.total_cmp(&a.2));
        list.truncate(LINKS_MAX);
    }
    list
}

/// About one vehicle.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Details {
    /// Which.
    pub vehicle: u32,
    /// When, s.
    pub t: f64,
    /// What it is made of.
    pub parts: Vec<Part>,
    /// Its sensors.
    pub sensors: Vec<SensorDetails>,
    /// Its battery.
    pub battery: Option<BatteryDetails>,
    /// Its radios.
    pub radios: Vec<RadioDetails>,
    /// Its last packets, the newest first.
    pub packets: Vec<PacketDetails>,
}

/// One part of a vehicle.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Part {
    /// What it is to it.
    pub place: String,
    /// Its name on the shelf.
    pub name: String,
    /// With their values.
    pub parameters: Vec<(String, String)>,
}

/// One sensor of a vehicle.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SensorDetails {
    /// Its name on board.
    pub name: String,
    /// When it read last, s.
    pub t: Option<f64>,
    /// Where it sits.
    pub mount: MountDetails,
    /// Where it looks.
    pub beams: Option<BeamsDetails>,
    /// Names and units of a row.
    pub columns: Vec<(String, String)>,
    /// What it read last.
    pub reading: Option<Vec<f64>>,
    /// What was true.
    pub truth: Option<Vec<f64>>,
    /// Whether that reading was lost.
    pub lost: bool,
}

/// Where a sensor sits in the body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MountDetails {
    /// FLU, m.
    pub at: [f64; 3],
    /// From its own axes to the body's.
    pub turn: [f64; 4],
}

impl Default for MountDetails {
    fn default() -> Self {
        Self {
            at: [0.0; 3],
            turn: [1.0, 0.0, 0.0, 0.0],
        }
    }
}

/// Where a sensor looks.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum BeamsDetails {
    /// Along rays.
    Rays {
        /// Unit vectors.
        rays: Vec<[f64; 3]>,
        /// m.
        range_m: f64,
    },
    /// Around the line of sight.
    Cone {
        /// Half the angle, rad.
        cone: f64,
        /// m.
        range_m: f64,
    },
    /// A picture.
    Frustum {
        /// Whole angles, horizontal and vertical, rad.
        frustum: [f64; 2],
        /// m.
        range_m: f64,
    },
    /// All around.
    Ball {
        /// Always true.
        ball: bool,
        /// m.
        range_m: f64,
    },
}

/// A battery.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BatteryDetails {
    /// State of charge, 0 to 1.
    pub soc: f64,
    /// V.
    pub voltage_v: f64,
    /// A.
    pub current_a: f64,
    /// `fit`, or what became of its platform; empty: not known.
    pub condition: String,
}

/// A radio.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct RadioDetails {
    /// Its name on board.
    pub name: String,
    /// Its IEEE 802.15.4 channel, if it is one.
    pub channel: Option<u8>,
    /// `listening`, `asleep`, ...
    pub state: Option<String>,
    /// Frames; `None` if nobody counted.
    pub sent: Option<u64>,
    /// Frames; `None` if nobody counted.
    pub received: Option<u64>,
    /// Frames, by reason; empty if nobody counted.
    pub lost: BTreeMap<String, u64>,
}

/// A packet as the selected vehicle saw it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PacketDetails {
    /// When its transmission began, s.
    pub t: f64,
    /// Whether it sent it; else it received it.
    pub sent: bool,
    /// The other one: the sender, or the only receiver.
    pub other: Option<u32>,
    /// Its length on the air.
    pub bytes: u32,
    /// How well it was received, dBm.
    pub rssi_dbm: Option<f32>,
}

impl Said {
    /// As it goes to the page.
    pub fn message(&self) -> Message {
        // Plain structs with text keys: it cannot fail.
        let text = serde_json::to_string(self).unwrap_or_default();
        Message::Text(text.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    fn said(said: Said) -> Value {
        let message = said.message();
        serde_json::from_slice(message.bytes()).expect("it is JSON")
    }

    #[test]
    fn states_are_as_the_protocol_says() {
        let state = Said::State {
            time_s: 12.5,
            paused: false,
            factor: None,
            speed: 0.98,
            ended: None,
            events: 1234,
            viewers: 1,
            skipped: 0,
        };
        let expected = json!({ "type": "state", "time_s": 12.5, "paused": false, "factor": null,
            "speed": 0.98, "ended": null, "events": 1234, "viewers": 1, "skipped": 0 });
        assert_eq!(said(state), expected);
    }

    #[test]
    fn numbers_that_are_none_become_null() {
        let history = Said::History {
            id: 8,
            times_s: vec![0.0, 1.0],
            values: vec![f64::NAN, f64::INFINITY],
        };
        let expected =
            json!({ "type": "history", "id": 8, "times_s": [0.0, 1.0], "values": [null, null] });
        assert_eq!(said(history), expected);
    }

    #[test]
    fn links_and_packets_are_lists_of_lists() {
        let links = Said::Links {
            t: 4.0,
            period_s: 1.0,
            list: vec![(3, 5, -71.5, 0.5)],
        };
        let expected =
            json!({ "type": "links", "t": 4.0, "period_s": 1.0, "list": [[3, 5, -71.5, 0.5]] });
        assert_eq!(said(links), expected);
        let packets = Said::Packets {
            list: vec![Packet {
                t: 3.5,
                from: 3,
                bytes: 24,
                to: vec![(5, -71.5)],
            }],
            dropped: 2,
        };
        let expected = json!({ "type": "packets", "dropped": 2,
            "list": [{ "t": 3.5, "from": 3, "bytes": 24, "to": [[5, -71.5]] }] });
        assert_eq!(said(packets), expected);
    }

    #[test]
    fn details_have_all_keys_and_untagged_beams() {
        let details = Details {
            vehicle: 3,
            t: 4.0,
            sensors: vec![SensorDetails {
                name: "ranger".to_owned(),
                beams: Some(BeamsDetails::Ball {
                    ball: true,
                    range_m: 4.0,
                }),
                columns: vec![(String::new(), "m".to_owned())],
                ..SensorDetails::default()
            }],
            ..Details::default()
        };
        let expected = json!({ "type": "details", "vehicle": 3, "t": 4.0, "parts": [],
            "sensors": [{ "name": "ranger", "t": null,
                "mount": { "at": [0.0, 0.0, 0.0], "turn": [1.0, 0.0, 0.0, 0.0] },
                "beams": { "ball": true, "range_m": 4.0 },
                "columns": [["", "m"]], "reading": null, "truth": null, "lost": false }],
            "battery": null, "radios": [], "packets": [] });
        assert_eq!(said(Said::Details(details)), expected);
    }
}
