//! What goes over the air besides beacons.

use simbeeotic::prelude::*;
use simbeeotic::units::glam::DVec2;

const HELLO: u8 = 0xe1;
const REPORT: u8 = 0xe2;
const WORD: u8 = 0xe3;

/// A step of a place on the air, m.
const PLACE_M: f64 = 0.1;
/// A place is no farther from the origin than this, m, east or north: 16 bits of it, and some to spare.
pub(super) const FARTHEST_M: f64 = 3200.0;
/// Steps of a cost on the air, in one transmission.
const COST_STEPS: f64 = 64.0;
/// What stands for no place on the trail yet, and for no way to the base.
const NONE: u16 = u16::MAX;

/// Who I am: where on the trail, how many transmissions from the base, whether the chain is torn ahead of me, how
/// much of the trail I know, and some of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Hello {
    pub(super) s_m: Option<f64>,
    pub(super) cost: Option<f64>,
    pub(super) torn: bool,
    pub(super) known: u8,
    /// The number of the first crumb of those below.
    pub(super) first: u8,
    pub(super) crumbs: Vec<DVec2>,
}

/// What the explorer has to say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Report {
    pub(super) number: u16,
    pub(super) made: SimTime,
    pub(super) place: DVec2,
    /// How often it was sent on.
    pub(super) hops: u8,
}

/// One of ours, as it came in.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Message {
    Hello(Hello),
    Report(Report),
    /// The base's answer to the report of this number.
    Word(u16),
}

impl Message {
    pub(super) fn encode(&self) -> Vec<u8> {
        match self {
            Self::Hello(hello) => {
                let s = steps(hello.s_m, 1.0 / PLACE_M);
                let cost = steps(hello.cost, COST_STEPS);
                let mut bytes = vec![HELLO];
                bytes.extend([s, cost].map(u16::to_be_bytes).as_flattened());
                bytes.extend([u8::from(hello.torn), hello.known, hello.first]);
                bytes.extend(hello.crumbs.iter().flat_map(|crumb| place_bytes(*crumb)));
                bytes
            }
            Self::Report(report) => {
                let mut bytes = vec![REPORT];
                bytes.extend(report.number.to_be_bytes());
                bytes.extend(report.made.nanos().to_be_bytes());
                bytes.extend(place_bytes(report.place));
                bytes.push(report.hops);
                bytes
            }
            Self::Word(number) => {
                let [high, low] = number.to_be_bytes();
                vec![WORD, high, low]
            }
        }
    }

    /// `None` for bytes that are not ours.
    pub(super) fn decode(bytes: &[u8]) -> Option<Self> {
        match bytes {
            [HELLO, s1, s0, c1, c0, torn, known, first, rest @ ..] => {
                let (crumbs, []) = rest.as_chunks::<4>() else {
                    return None;
                };
                let number = |steps: u16| (steps != NONE).then(|| f64::from(steps));
                let cost = number(u16::from_be_bytes([*c1, *c0]));
                let s = number(u16::from_be_bytes([*s1, *s0]));
                Some(Self::Hello(Hello {
                    s_m: s.map(|s| s * PLACE_M),
                    cost: cost.map(|cost| cost / COST_STEPS),
                    torn: *torn != 0,
                    known: *known,
                    first: *first,
                    crumbs: crumbs.iter().map(|crumb| place(*crumb)).collect(),
                }))
            }
            [REPORT, n1, n0, rest @ ..] => {
                let (made, rest) = rest.split_first_chunk()?;
                let (at, [hops]) = rest.split_first_chunk()? else {
                    return None;
                };
                Some(Self::Report(Report {
                    number: u16::from_be_bytes([*n1, *n0]),
                    made: SimTime::from_nanos(u64::from_be_bytes(*made)),
                    place: place(*at),
                    hops: *hops,
                }))
            }
            [WORD, n1, n0] => Some(Self::Word(u16::from_be_bytes([*n1, *n0]))),
            _ => None,
        }
    }
}

/// A number in steps, so many to the whole.
fn steps(number: Option<f64>, to_one: f64) -> u16 {
    number.map_or(NONE, |number| {
        ((number * to_one).round() as u16).min(NONE - 1)
    })
}

fn place_bytes(place: DVec2) -> [u8; 4] {
    let [[x1, x0], [y1, y0]] = place
        .to_array()
        .map(|m| ((m / PLACE_M).round() as i16).to_be_bytes());
    [x1, x0, y1, y0]
}

fn place([x1, x0, y1, y0]: [u8; 4]) -> DVec2 {
    let words = [[x1, x0], [y1, y0]].map(i16::from_be_bytes);
    DVec2::from_array(words.map(|word| f64::from(word) * PLACE_M))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_said_is_what_is_heard() {
        let hello = |s_m, cost| {
            Message::Hello(Hello {
                s_m,
                cost,
                torn: true,
                known: 51,
                first: 49,
                crumbs: vec![DVec2::new(-70.0, 2.0), DVec2::new(-65.0, 2.0)],
            })
        };
        let report = Message::Report(Report {
            number: 700,
            made: SimTime::from_millis(350_000),
            place: DVec2::new(144.0, -112.0),
            hops: 3,
        });
        for message in [
            hello(Some(250.0), Some(3.25)),
            hello(None, None),
            report,
            Message::Word(700),
        ] {
            assert_eq!(Message::decode(&message.encode()), Some(message));
        }
    }

    #[test]
    fn other_bytes_are_nothing() {
        let report = [REPORT; 15];
        for bytes in [
            &b""[..],
            b"hello",
            &[HELLO; 7],
            &[HELLO; 10],
            &report,
            &[WORD],
        ] {
            assert_eq!(Message::decode(bytes), None);
        }
    }
}
