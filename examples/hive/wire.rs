//! What is said by radio, and its bytes.
//!
//! | first byte | who, to whom | then |
//! |---|---|---|
//! | 1 | MAV to hive: where it is | cell 2, state of charge 1 (of 255) |
//! | 2 | MAV to hive: done, what next? | ticket 2, cell 2, flowers 1, task 1 |
//! | 3 | MAV to hive: goes home, the task is not done | ticket 2 |
//! | 4 | hive to MAV: the next task | ticket 2, task 1, cell 2, then 4 for each flower: east, north |
//! | 5 | hive to MAV: nothing to do, come home | |
//! | 6 | MAV to all: goes to a cell | cell 2 |
//! | 7 | MAV to all: leaves a cell | cell 2, flowers left 1 |
//! | 8 | MAV to all: beacons, what do you know? | |
//! | 9 | beacon to all: its cell | cell 2, visits 1 (in sixteenths), flowers left 1, taken 1 |
//!
//! Numbers are big-endian; places are signed, in units of 5 cm from the hive. Anything else is not ours
//! and is left alone.

use simbeeotic::units::glam::DVec2;

/// What a MAV is sent to a cell for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Task {
    /// Fly over it in lanes and look for flowers.
    Search,
    /// Hover over each flower and find out where it is.
    Sample,
    /// Come down to each flower and stay.
    Pollinate,
}

impl Task {
    const ALL: [Self; 3] = [Self::Search, Self::Sample, Self::Pollinate];
}

/// One dispatch: a task in a cell.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Job {
    /// The number of this dispatch; results refer to it.
    pub(crate) ticket: u16,
    pub(crate) task: Task,
    pub(crate) cell: u16,
    /// Where flowers are, as far as the sender knows.
    pub(crate) places: Vec<DVec2>,
}

/// A packet.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Word {
    Status {
        cell: u16,
        charge: u8,
    },
    Done {
        ticket: u16,
        cell: u16,
        count: u8,
        task: Task,
    },
    Homeward {
        ticket: u16,
    },
    Next(Job),
    ComeHome,
    Claim {
        cell: u16,
    },
    Mark {
        cell: u16,
        left: u8,
    },
    Listen,
    Trail {
        cell: u16,
        visits: u8,
        left: u8,
        taken: bool,
    },
}

/// So many flowers fit into a frame; the others are found on the spot.
const PLACES_MAX: usize = 20;
/// The unit of places, m.
const PLACE_UNIT_M: f64 = 0.05;

impl Word {
    /// Its bytes; places count from `hive`.
    pub(crate) fn encode(&self, hive: DVec2) -> Vec<u8> {
        let two = |number: &u16| number.to_be_bytes();
        match self {
            Self::Status { cell, charge } => [&[1][..], &two(cell), &[*charge]].concat(),
            Self::Done {
                ticket,
                cell,
                count,
                task,
            } => [&[2][..], &two(ticket), &two(cell), &[*count, *task as u8]].concat(),
            Self::Homeward { ticket } => [&[3][..], &two(ticket)].concat(),
            Self::Next(job) => {
                let head = [
                    &[4][..],
                    &two(&job.ticket),
                    &[job.task as u8],
                    &two(&job.cell),
                ];
                let mut bytes = head.concat();
                for place in job.places.iter().take(PLACES_MAX) {
                    let steps = (*place - hive) / PLACE_UNIT_M;
                    bytes.extend((steps.x.round() as i16).to_be_bytes());
                    bytes.extend((steps.y.round() as i16).to_be_bytes());
                }
                bytes
            }
            Self::ComeHome => vec![5],
            Self::Claim { cell } => [&[6][..], &two(cell)].concat(),
            Self::Mark { cell, left } => [&[7][..], &two(cell), &[*left]].concat(),
            Self::Listen => vec![8],
            Self::Trail {
                cell,
                visits,
                left,
                taken,
            } => [&[9][..], &two(cell), &[*visits, *left, u8::from(*taken)]].concat(),
        }
    }

    /// What the bytes say, if they are ours.
    pub(crate) fn decode(bytes: &[u8], hive: DVec2) -> Option<Self> {
        let (kind, rest) = bytes.split_first()?;
        Some(match (kind, rest) {
            (1, &[c0, c1, charge]) => Self::Status {
                cell: two(c0, c1),
                charge,
            },
            (2, &[t0, t1, c0, c1, count, task]) => Self::Done {
                ticket: two(t0, t1),
                cell: two(c0, c1),
                count,
                task: *Task::ALL.get(usize::from(task))?,
            },
            (3, &[t0, t1]) => Self::Homeward {
                ticket: two(t0, t1),
            },
            (4, &[t0, t1, task, c0, c1, ref places @ ..]) => {
                let task = *Task::ALL.get(usize::from(task))?;
                let (places, rest) = places.as_chunks::<4>();
                if !rest.is_empty() {
                    return None;
                }
                let place = |[e0, e1, n0, n1]: &[u8; 4]| {
                    let (east, north) = (
                        i16::from_be_bytes([*e0, *e1]),
                        i16::from_be_bytes([*n0, *n1]),
                    );
                    hive + DVec2::new(f64::from(east), f64::from(north)) * PLACE_UNIT_M
                };
                Self::Next(Job {
                    ticket: two(t0, t1),
                    task,
                    cell: two(c0, c1),
                    places: places.iter().map(place).collect(),
                })
            }
            (5, []) => Self::ComeHome,
            (6, &[c0, c1]) => Self::Claim { cell: two(c0, c1) },
            (7, &[c0, c1, left]) => Self::Mark {
                cell: two(c0, c1),
                left,
            },
            (8, []) => Self::Listen,
            (9, &[c0, c1, visits, left, taken]) => Self::Trail {
                cell: two(c0, c1),
                visits,
                left,
                taken: taken != 0,
            },
            _ => return None,
        })
    }
}

fn two(high: u8, low: u8) -> u16 {
    u16::from_be_bytes([high, low])
}

/// A share from 0 to 1 as a byte.
pub(crate) fn share_byte(share: f64) -> u8 {
    (share.clamp(0.0, 1.0) * 255.0).round() as u8
}

/// A count as a byte: 255 is that or more.
pub(crate) fn count_byte(count: usize) -> u8 {
    u8::try_from(count).unwrap_or(u8::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words() -> Vec<Word> {
        let job = |task, places| {
            Word::Next(Job {
                ticket: 700,
                task,
                cell: 399,
                places,
            })
        };
        vec![
            Word::Status {
                cell: 300,
                charge: 9,
            },
            Word::Done {
                ticket: 1,
                cell: 2,
                count: 3,
                task: Task::Sample,
            },
            Word::Homeward { ticket: 65_535 },
            job(Task::Search, vec![]),
            job(
                Task::Pollinate,
                vec![DVec2::new(-70.05, 99.95), DVec2::new(3.0, 4.0)],
            ),
            Word::ComeHome,
            Word::Claim { cell: 17 },
            Word::Mark {
                cell: 256,
                left: 12,
            },
            Word::Listen,
            Word::Trail {
                cell: 1,
                visits: 33,
                left: 0,
                taken: true,
            },
        ]
    }

    #[test]
    fn what_is_encoded_is_decoded() {
        let hive = DVec2::new(10.0, -20.0);
        for word in words() {
            let back = Word::decode(&word.encode(hive), hive).expect("ours");
            match (&word, &back) {
                (Word::Next(a), Word::Next(b)) => {
                    assert_eq!((a.ticket, a.task, a.cell), (b.ticket, b.task, b.cell));
                    assert_eq!(a.places.len(), b.places.len());
                    for (a, b) in a.places.iter().zip(&b.places) {
                        assert!((*a - *b).length() < PLACE_UNIT_M, "{a} {b}");
                    }
                }
                _ => assert_eq!(word, back),
            }
        }
    }

    #[test]
    fn bytes_that_are_cut_or_foreign_say_nothing() {
        for word in words() {
            let bytes = word.encode(DVec2::ZERO);
            for len in 1..bytes.len() {
                let cut = Word::decode(&bytes[..len], DVec2::ZERO);
                // A list of places may end earlier, and is a shorter list then.
                assert!(
                    cut.is_none() || bytes[0] == 4 && (len - 6) % 4 == 0,
                    "{bytes:?} {len}"
                );
            }
        }
        assert_eq!(Word::decode(&[], DVec2::ZERO), None);
        assert_eq!(Word::decode(&[4, 0, 0, 3, 0, 0], DVec2::ZERO), None);
        assert_eq!(Word::decode(&[99, 1, 2], DVec2::ZERO), None);
    }

    #[test]
    fn a_long_list_is_cut_to_what_a_frame_holds() {
        let places = vec![DVec2::ONE; 60];
        let word = Word::Next(Job {
            ticket: 1,
            task: Task::Sample,
            cell: 1,
            places,
        });
        assert!(word.encode(DVec2::ZERO).len() <= 100);
    }
}
