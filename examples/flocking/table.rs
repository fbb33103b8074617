//! What goes over the air, and what is known of others by it.

use simbeeotic::prelude::*;
use simbeeotic::units::glam::DVec3;
use std::collections::BTreeMap;

/// What a packet of this flock starts with.
const KIND: u8 = 0xfb;
/// A step of a position on the air, m: 16 bits reach 1.6 km.
const PLACE_M: f64 = 0.05;
/// A step of a velocity on the air, m/s: 8 bits reach 12.7 m/s.
const SPEED_M_S: f64 = 0.1;

/// Where somebody is and how it moves, at some time: as it believes itself, or as another has heard it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct State {
    pub(super) time: SimTime,
    pub(super) p_enu: DVec3,
    pub(super) v_enu: DVec3,
}

impl State {
    /// Where it is at another time if it goes on like this.
    pub(super) fn at(&self, now: SimTime) -> DVec3 {
        self.p_enu + self.v_enu * (now - self.time).secs()
    }

    /// Twelve bytes: kind, time, position, velocity. The time is the low 16 bits of its milliseconds, since
    /// satellites give everybody the same clock.
    pub(super) fn encode(&self) -> [u8; 12] {
        let mut bytes = [KIND; 12];
        let (head, speeds) = bytes.split_at_mut(9);
        let millis = (self.time.nanos() / 1_000_000) as u16;
        let words = self.p_enu.to_array().map(|m| (m / PLACE_M).round() as i16);
        let [x, y, z] = words.map(i16::to_be_bytes);
        head[1..].copy_from_slice([millis.to_be_bytes(), x, y, z].as_flattened());
        for (byte, speed) in speeds.iter_mut().zip(self.v_enu.to_array()) {
            *byte = ((speed / SPEED_M_S).round() as i8).to_be_bytes()[0];
        }
        bytes
    }

    /// What a packet says that was received `now`; `None` if it is none of ours.
    pub(super) fn decode(payload: &[u8], now: SimTime) -> Option<Self> {
        let [KIND, t1, t0, x1, x0, y1, y0, z1, z0, vx, vy, vz] = *payload else {
            return None;
        };
        let millis = (now.nanos() / 1_000_000) as u16;
        let age_ms = millis.wrapping_sub(u16::from_be_bytes([t1, t0]));
        let taken_ms = (now.nanos() / 1_000_000).checked_sub(u64::from(age_ms))?;
        let place = [[x1, x0], [y1, y0], [z1, z0]];
        let place = place.map(|word| f64::from(i16::from_be_bytes(word)) * PLACE_M);
        let speed = [vx, vy, vz].map(|byte| f64::from(i8::from_be_bytes([byte])) * SPEED_M_S);
        Some(Self {
            time: SimTime::from_millis(taken_ms),
            p_enu: DVec3::from_array(place),
            v_enu: DVec3::from_array(speed),
        })
    }
}

/// The newest that was heard of each neighbour.
#[derive(Clone, Debug, Default)]
pub(super) struct Table {
    known: BTreeMap<ModelId, State>,
}

impl Table {
    /// Takes note of a packet. Whether it was one of ours.
    pub(super) fn hear(&mut self, packet: &Packet<'_>) -> bool {
        let state = State::decode(packet.payload(), packet.time());
        if let Some(state) = state {
            self.known.insert(packet.sender(), state);
        }
        state.is_some()
    }

    /// Forgets what is older than `memory`.
    pub(super) fn forget(&mut self, now: SimTime, memory: Time) {
        self.known.retain(|_, state| now - state.time <= memory);
    }

    pub(super) fn neighbours(&self) -> impl ExactSizeIterator<Item = &State> {
        self.known.values()
    }

    /// How old what is known is, in the mean; `None` if nothing is.
    pub(super) fn age(&self, now: SimTime) -> Option<Time> {
        let ages = self.known.values().map(|state| (now - state.time).secs());
        let count = self.known.len();
        (count > 0).then(|| Time::from_secs(ages.sum::<f64>() / count as f64))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(millis: u64) -> State {
        State {
            time: SimTime::from_millis(millis),
            p_enu: DVec3::new(-71.3, 0.02, 12.0),
            v_enu: DVec3::new(3.0, -4.94, 0.0),
        }
    }

    #[test]
    fn a_packet_brings_a_state_to_within_half_a_step_even_when_its_clock_has_turned_over() {
        let sent = state(65_500);
        let heard = State::decode(&sent.encode(), SimTime::from_millis(65_600)).expect("ours");
        assert_eq!(heard.time, sent.time);
        assert!((heard.p_enu - sent.p_enu).abs().max_element() <= PLACE_M / 2.0);
        assert!((heard.v_enu - sent.v_enu).abs().max_element() <= SPEED_M_S / 2.0 + 1e-9);
    }

    #[test]
    fn what_is_off_the_scale_ends_at_its_end() {
        let far = State {
            p_enu: DVec3::X * 1e9,
            ..state(0)
        };
        let heard = State::decode(&far.encode(), SimTime::ZERO).expect("ours");
        assert!((heard.p_enu.x - 1638.35).abs() < 1e-9);
    }

    #[test]
    fn bytes_of_others_are_nothing() {
        for payload in [&b""[..], b"hello", &[KIND; 11], &[0; 12], &[KIND; 13]] {
            assert_eq!(State::decode(payload, SimTime::from_secs(9)), None);
        }
        // A packet from before the beginning of time.
        assert_eq!(State::decode(&[KIND; 12], SimTime::ZERO), None);
    }

    #[test]
    fn a_state_is_carried_on_by_its_velocity() {
        let later = state(1000).at(SimTime::from_millis(3000));
        assert!((later.x - (-71.3 + 2.0 * 3.0)).abs() < 1e-12);
    }
}
