//! Frames that are in the air, who could hear them, and who received them so far: what a recorder and a live
//! page both follow, and each makes something else of.

use simbeeotic_model::radio::RadioId;
use simbeeotic_model::units::Position;
use simbeeotic_model::{OnAir, Reception, Transmission, View};
use std::collections::BTreeMap;

/// Frames from their starts to their ends, in the order of their starts. `P` is what the watcher keeps of each.
#[derive(Debug)]
pub struct Aloft<P> {
    /// By id: whether the radio's frames are followed.
    wanted: Vec<bool>,
    most: usize,
    open: Vec<Flight<P>>,
    /// Where each stands in `open`, by the frame's key.
    places: BTreeMap<u64, usize>,
    late: u64,
}

/// One frame.
#[derive(Clone, Debug)]
pub struct Flight<P> {
    key: u64,
    /// Virtual time at which it leaves the air, ns.
    pub end_ns: u64,
    /// The radio that sends it.
    pub radio: RadioId,
    /// What its watcher keeps.
    pub packet: P,
    /// The radios that received it so far, each with the virtual time, ns.
    pub receptions: Vec<(u64, Reception)>,
    /// The followed radios that could hear it as it began, and from how far, m.
    pub listeners: Vec<(RadioId, f32)>,
}

impl<P> Aloft<P> {
    /// Follows the frames of the radios that are `wanted`, by id; at most so many at a time, the others are left
    /// out.
    pub fn new(wanted: Vec<bool>, most: usize) -> Self {
        Self {
            wanted,
            most,
            open: Vec::new(),
            places: BTreeMap::new(),
            late: 0,
        }
    }

    fn wants(&self, radio: RadioId) -> bool {
        self.wanted.get(radio.index()).copied().unwrap_or(false)
    }

    /// Takes frames that began.
    pub fn begun(
        &mut self,
        view: &View<'_>,
        air: &OnAir,
        mut packet: impl FnMut(&Transmission) -> P,
    ) {
        for sent in &air.frames {
            let (frame, radio) = (&sent.frame, sent.frame.radio());
            if !self.wants(radio) || self.open.len() >= self.most {
                continue;
            }
            let to = frame.destination();
            let hears = air.listeners.iter().filter(|listener| {
                let for_it = |to| view.radio_owner(listener.radio) == Some(to);
                self.wants(listener.radio)
                    && listener.radio != radio
                    && listener.channel == sent.channel
                    && to.is_none_or(for_it)
            });
            let listeners = hears
                .map(|it| (it.radio, distance_m(it.position, sent.position)))
                .collect();
            self.places.insert(frame.key(), self.open.len());
            self.open.push(Flight {
                key: frame.key(),
                end_ns: frame.sent().nanos().saturating_add(frame.airtime_nanos()),
                radio,
                packet: packet(sent),
                receptions: Vec::new(),
                listeners,
            });
        }
    }

    /// Takes what a radio received at a time, ns.
    pub fn heard(&mut self, time_ns: u64, receptions: &[Reception]) {
        for reception in receptions {
            if !self.wants(reception.sender) {
                continue;
            }
            match self.places.get(&reception.frame) {
                Some(place) => self.open[*place].receptions.push((time_ns, *reception)),
                None => self.late += 1,
            }
        }
    }

    /// The frames whose end has come, in the order of their starts; all of them if there is no more to come.
    pub fn ended(&mut self, now_ns: u64, all: bool) -> Vec<Flight<P>> {
        let over = |flight: &Flight<P>| all || flight.end_ns <= now_ns;
        if !self.open.iter().any(over) {
            return Vec::new();
        }
        let (ended, open) = std::mem::take(&mut self.open).into_iter().partition(over);
        self.open = open;
        let open = self.open.iter().enumerate();
        self.places = open.map(|(place, flight)| (flight.key, place)).collect();
        ended
    }

    /// Receptions of frames that had ended, or were not followed as they began.
    pub fn late(&self) -> u64 {
        self.late
    }

    /// Forgets what is in the air.
    pub fn clear(&mut self) {
        self.open.clear();
        self.places.clear();
    }
}

#[cfg(test)]
impl Flight<()> {
    /// A frame that nobody has received.
    pub(super) fn on_air(radio: RadioId, listeners: &[(u32, f32)]) -> Self {
        let listeners = listeners.iter().map(|(id, far)| (RadioId(*id), *far));
        Self {
            key: 0,
            end_ns: 0,
            radio,
            packet: (),
            receptions: Vec::new(),
            listeners: listeners.collect(),
        }
    }
}

fn distance_m(a: Position, b: Position) -> f32 {
    (a.si() - b.si()).length() as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_model::units::{Decibels, PowerLevel};

    fn flight(key: u64, end_ns: u64) -> Flight<u64> {
        Flight {
            key,
            end_ns,
            radio: RadioId(0),
            packet: key,
            receptions: Vec::new(),
            listeners: Vec::new(),
        }
    }

    fn aloft(flights: &[(u64, u64)]) -> Aloft<u64> {
        let mut aloft = Aloft::new(vec![true, false], 10);
        for (key, end_ns) in flights {
            aloft.places.insert(*key, aloft.open.len());
            aloft.open.push(flight(*key, *end_ns));
        }
        aloft
    }

    fn heard(frame: u64, sender: u32) -> Reception {
        Reception {
            frame,
            sender: RadioId(sender),
            radio: RadioId(1),
            rssi: PowerLevel::from_dbm(-70.0),
            snr: Decibels::from_db(20.0),
            lqi: 200,
        }
    }

    #[test]
    fn frames_come_down_in_the_order_of_their_starts() {
        let mut aloft = aloft(&[(7, 30), (8, 10), (9, 20)]);
        assert!(aloft.ended(9, false).is_empty());
        let keys = |ended: Vec<Flight<u64>>| -> Vec<u64> {
            ended.into_iter().map(|flight| flight.packet).collect()
        };
        assert_eq!(keys(aloft.ended(20, false)), [8, 9]);
        aloft.heard(25, &[heard(7, 0)]);
        let last = aloft.ended(25, true);
        assert_eq!(last[0].receptions.len(), 1, "it is still found");
        assert_eq!(keys(last), [7]);
        assert!(aloft.ended(100, true).is_empty());
    }

    #[test]
    fn what_comes_too_late_is_counted_and_what_nobody_follows_is_not() {
        let mut aloft = aloft(&[(7, 30)]);
        aloft.heard(5, &[heard(7, 0), heard(99, 0), heard(98, 1)]);
        assert_eq!(aloft.late(), 1);
        aloft.clear();
        assert!(aloft.ended(100, true).is_empty());
    }
}
