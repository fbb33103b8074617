//! Drives a medium by itself, without an engine: nodes that stay where they are, and requests that are
//! known before. For comparisons with other simulators, benches and pictures.
//!
//! ```
//! use simbeeotic_kernel::{ModelId, SimTime, rng::path_key};
//! use simbeeotic_radio::{Medium, RadioSpec, SimpleConfig, SimpleMedium, cc2420, drive};
//! use simbeeotic_units::Position;
//! use std::sync::Arc;
//!
//! let mut medium = SimpleMedium::new(SimpleConfig::default())?;
//! for node in 0..2 {
//!     let key = path_key(&format!("node-{node}/radio"));
//!     let spec = cc2420::spec(11, 31).expect("channel 11 and level 31 exist");
//!     medium.add(RadioSpec { owner: ModelId(node), key, ..spec })?;
//! }
//! let nodes = drive::Still::at([Position::default(); 2]);
//! let until = SimTime::from_secs(10);
//! let requests = drive::each_second(&[0, 250_000_000], Arc::from(*b"buzz"), until);
//! assert_eq!(drive::drive(&mut medium, &nodes, requests), 20);
//! assert_eq!(medium.totals().sent, 20);
//! # Ok::<(), simbeeotic_radio::RadioError>(())
//! ```

use crate::frame::Request;
use crate::medium::{Medium, Poses};
use crate::radio::RadioId;
use crate::scratch::Scratch;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_units::{Attitude, Pose, Position};
use std::sync::Arc;

/// Platforms that stay where they are, and look east. Asking for one beyond the last panics.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Still(Vec<Pose>);

impl Still {
    /// Model `i` is at the place `i`.
    pub fn at(places: impl IntoIterator<Item = Position>) -> Self {
        let pose = |place| Pose::new(place, Attitude::IDENTITY);
        Self(places.into_iter().map(pose).collect())
    }
}

impl Poses for Still {
    fn pose(&self, owner: ModelId) -> Pose {
        self.0[owner.index()]
    }
}

/// One broadcast a second of each radio, in the order of time: radio `i` asks at `phases_ns[i]` after each
/// full second, as long as that is before `until`. Who asks at the same instant does so in the order of
/// radios.
///
/// # Panics
/// If a phase is a second or more.
pub fn each_second(
    phases_ns: &[u64],
    payload: Arc<[u8]>,
    until: SimTime,
) -> impl Iterator<Item = (SimTime, Request)> {
    let mut order: Vec<(u64, RadioId)> =
        phases_ns.iter().copied().zip((0..).map(RadioId)).collect();
    order.sort_unstable();
    let last = order.last().map_or(0, |&(phase_ns, _)| phase_ns);
    assert!(
        last < SECOND_NS,
        "a phase lies below a second, this is {last} ns"
    );
    let seconds = match order.is_empty() {
        true => 0,
        false => until.nanos().div_ceil(SECOND_NS),
    };
    (0..seconds)
        .flat_map(move |second| {
            let start = SimTime::from_secs(second);
            let order = order.clone();
            order
                .into_iter()
                .map(move |(ns, radio)| (start.saturating_add_nanos(ns), radio))
        })
        .take_while(move |&(time, _)| time < until)
        .map(move |(time, radio)| (time, Request::broadcast(radio, Arc::clone(&payload))))
}

const SECOND_NS: u64 = 1_000_000_000;

/// Hands `requests` to a medium, each at its time, and goes on until nothing is under way. Everybody
/// collects what is for them, as under the engine. Returns how many packets were received, counted at each
/// receiver; the rest is in the medium's counters.
///
/// `requests` are in the order of time. Those of one instant follow what was under way before it.
pub fn drive(
    medium: &mut dyn Medium,
    poses: &dyn Poses,
    requests: impl IntoIterator<Item = (SimTime, Request)>,
) -> u64 {
    let radios = (0..medium.radios() as u32).map(RadioId);
    let mut radios: Vec<(ModelId, RadioId)> = radios
        .map(|radio| (medium.spec(radio).owner, radio))
        .collect();
    radios.sort_unstable();
    let mut requests = requests.into_iter().peekable();
    let (mut owners, mut scratch, mut received) = (Vec::new(), Scratch::new(), 0);
    loop {
        let next = requests.peek().map(|(time, _)| *time);
        let Some(now) = [next, medium.next_time()].into_iter().flatten().min() else {
            return received;
        };
        medium.open(now, poses, &mut owners);
        // Both lists ascend, and the next owner is often the next of the radios'.
        let mut at = 0;
        for &owner in &owners {
            if radios.get(at).is_some_and(|&(other, _)| other < owner) {
                at += radios[at..].partition_point(|&(other, _)| other < owner);
            }
            while let Some(&(_, radio)) = radios.get(at).filter(|(other, _)| *other == owner) {
                received += medium.collect(radio, poses, &mut scratch).len() as u64;
                at += 1;
            }
        }
        while let Some((_, request)) = requests.next_if(|(time, _)| *time <= now) {
            medium.submit(now, request);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{RadioSpec, SimpleConfig, SimpleMedium, cc2420};
    use simbeeotic_kernel::rng::path_key;

    fn asked(phases_ns: &[u64], until_ns: u64) -> Vec<(u64, u32)> {
        let until = SimTime::from_nanos(until_ns);
        each_second(phases_ns, Arc::from(*b"buzz"), until)
            .map(|(time, request)| (time.nanos(), request.radio.0))
            .collect()
    }

    #[test]
    fn each_radio_asks_once_a_second_at_its_phase_before_the_end() {
        assert_eq!(
            asked(&[700, 5, 0], 2_000_000_005),
            [
                (0, 2),
                (5, 1),
                (700, 0),
                (1_000_000_000, 2),
                (1_000_000_005, 1),
                (1_000_000_700, 0),
                (2_000_000_000, 2),
            ]
        );
        assert_eq!(asked(&[0, 0], 1_000_000_000), [(0, 0), (0, 1)]);
        assert_eq!(asked(&[], u64::MAX), []);
        assert_eq!(asked(&[0], 0), []);
    }

    #[test]
    fn both_radios_of_a_platform_collect_what_is_theirs() {
        let mut medium = SimpleMedium::new(SimpleConfig::default()).unwrap();
        for (owner, name) in [(1, "b/long"), (0, "a/radio"), (1, "b/short")] {
            let spec = RadioSpec {
                owner: ModelId(owner),
                key: path_key(name),
                ..cc2420::spec(11, 31).unwrap()
            };
            medium.add(spec).unwrap();
        }
        let nodes = Still::at([Position::default(); 2]);
        let until = SimTime::from_secs(3);
        let requests = each_second(&[1, 2, 3], Arc::from(*b"buzz"), until);
        assert_eq!(drive(&mut medium, &nodes, requests), 3 * 3 * 2);
        let of_one = |radio| medium.counters(RadioId(radio)).received;
        assert_eq!([0, 1, 2].map(of_one), [6, 6, 6]);
    }
}
