//! What a page may say.

use serde::Deserialize;

/// A message of a page.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "type", rename_all = "lowercase", deny_unknown_fields)]
#[non_exhaustive]
pub enum Asked {
    /// Holds the run.
    Pause {},
    /// Lets it go on.
    Resume {},
    /// Runs so far, and holds again.
    Step {
        /// So many instants ...
        #[serde(default)]
        instants: Option<u64>,
        /// ... or so long, virtual s.
        #[serde(default)]
        seconds: Option<f64>,
    },
    /// At most so many virtual seconds a second; `None`: as fast as possible.
    Pace {
        /// The factor.
        #[serde(deserialize_with = "Option::deserialize")]
        factor: Option<f64>,
    },
    /// Whose details and series are wanted; `None`: nobody's.
    Select {
        /// Its number.
        #[serde(deserialize_with = "Option::deserialize")]
        vehicle: Option<u32>,
        /// Of a recording: at this time, s.
        #[serde(default)]
        t: Option<f64>,
    },
    /// What to send as colour values; `None`: nothing.
    Colour {
        /// The name of a series that vehicles have.
        #[serde(deserialize_with = "Option::deserialize")]
        by: Option<String>,
    },
    /// A frame has been drawn.
    Got {
        /// Its time, s.
        time_s: f64,
    },
    /// Frames and what belongs to them, of a recording.
    Fetch {
        /// Comes back in `fetched`.
        id: u32,
        /// From this time on, s.
        from_s: f64,
        /// Up to this time, s.
        to_s: f64,
        /// One tick each so long, s; 0: all.
        step_s: f64,
    },
    /// All values of a series.
    History {
        /// Its number.
        id: u32,
    },
}

/// A message that is none of [`Asked`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BadMessage {
    /// The connection is over.
    #[error("this is no JSON: {0}")]
    NoJson(String),
    /// The connection goes on.
    #[error(
        "cannot read this message: {0}; there are pause, resume, step, pace, select, colour, got, fetch \
         and history"
    )]
    Unknown(String),
}

impl Asked {
    /// Reads a text message.
    ///
    /// # Errors
    /// What is wrong with it. Numbers are as JSON has them: finite.
    pub fn read(text: &str) -> Result<Self, BadMessage> {
        let json: serde_json::Value =
            serde_json::from_str(text).map_err(|e| BadMessage::NoJson(e.to_string()))?;
        serde_json::from_value(json).map_err(|e| BadMessage::Unknown(e.to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_message_of_the_protocol_is_read() {
        let read = |text| Asked::read(text).expect(text);
        assert_eq!(read(r#"{ "type": "pause" }"#), Asked::Pause {});
        assert_eq!(read(r#"{ "type": "resume" }"#), Asked::Resume {});
        let step = |instants, seconds| Asked::Step { instants, seconds };
        assert_eq!(read(r#"{"type":"step","instants":1}"#), step(Some(1), None));
        assert_eq!(
            read(r#"{"type":"step","seconds":0.1}"#),
            step(None, Some(0.1))
        );
        let pace = |factor| Asked::Pace { factor };
        assert_eq!(read(r#"{"type":"pace","factor":2.0}"#), pace(Some(2.0)));
        assert_eq!(read(r#"{"type":"pace","factor":null}"#), pace(None));
        let select = |vehicle, t| Asked::Select { vehicle, t };
        assert_eq!(
            read(r#"{"type":"select","vehicle":3}"#),
            select(Some(3), None)
        );
        assert_eq!(
            read(r#"{"type":"select","vehicle":null,"t":4.5}"#),
            select(None, Some(4.5))
        );
        let by = Some("pollen".to_owned());
        assert_eq!(
            read(r#"{"type":"colour","by":"pollen"}"#),
            Asked::Colour { by }
        );
        assert_eq!(
            read(r#"{"type":"got","time_s":4}"#),
            Asked::Got { time_s: 4.0 }
        );
        assert_eq!(
            read(r#"{"type":"fetch","id":4,"from_s":10,"to_s":12,"step_s":0}"#),
            Asked::Fetch {
                id: 4,
                from_s: 10.0,
                to_s: 12.0,
                step_s: 0.0
            }
        );
        assert_eq!(
            read(r#"{"type":"history","id":7}"#),
            Asked::History { id: 7 }
        );
    }

    #[test]
    fn what_is_no_json_differs_from_what_is_no_message() {
        for text in ["", "{", "pause", "{\"type\":", "[1,2", &"[".repeat(5000)] {
            let error = Asked::read(text).expect_err("it is no JSON");
            assert!(matches!(error, BadMessage::NoJson(_)), "{text}");
        }
        for text in [
            "1",
            "[]",
            "{}",
            r#"{"type":"stop"}"#,
            r#"{"type":"pause","now":1}"#,
            r#"{"type":"history","id":-1}"#,
            r#"{"type":"history","id":1e300}"#,
            r#"{"type":"pace","factor":"fast"}"#,
            r#"{"type":"pace"}"#,
            r#"{"type":"select"}"#,
            r#"{"type":"colour"}"#,
        ] {
            let error = Asked::read(text).expect_err("it is no message");
            assert!(matches!(error, BadMessage::Unknown(_)), "{text}: {error}");
        }
    }
}
