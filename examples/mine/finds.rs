//! Where people were seen: sightings of one place are one find.

use simbeeotic::units::glam::DVec3;

/// Sightings as close as this are of one person, m.
const SAME_M: f64 = 1.3;
/// A find counts after so many sightings: sensors see some who are not there.
const SURE: u8 = 3;
/// What a packet with finds begins with, bytes of a find, and how many one packet holds.
const KIND: u8 = 0xa2;
const ENTRY: usize = 7;
const ENTRIES: usize = 16;

/// Somebody seen, at the mean of the sightings, from the shaft's foot: east, north, up, m.
#[derive(Clone, Copy, Debug)]
struct Find {
    at: DVec3,
    sightings: u8,
}

/// All that are known.
#[derive(Clone, Debug, Default)]
pub struct Finds {
    all: Vec<Find>,
    /// The first of the next packet.
    next: usize,
}

impl Finds {
    fn near(&mut self, at: DVec3) -> Option<&mut Find> {
        let close = |find: &&mut Find| find.at.distance(at) < SAME_M;
        self.all.iter_mut().find(close)
    }

    /// Notes a sighting.
    pub fn see(&mut self, at: DVec3) {
        if let Some(find) = self.near(at) {
            find.sightings = find.sightings.saturating_add(1);
            find.at += (at - find.at) / f64::from(find.sightings);
        } else {
            self.all.push(Find { at, sightings: 1 });
        }
    }

    /// The places of those that count.
    pub fn sure(&self) -> impl Iterator<Item = DVec3> {
        self.all
            .iter()
            .filter(|find| find.sightings >= SURE)
            .map(|find| find.at)
    }

    /// Some of those that count as a packet, each call the next ones; `None` if there are none.
    pub fn packet(&mut self) -> Option<Vec<u8>> {
        let sure: Vec<Find> = self
            .all
            .iter()
            .filter(|f| f.sightings >= SURE)
            .copied()
            .collect();
        if sure.is_empty() {
            return None;
        }
        let mut bytes = vec![KIND];
        let first = self.next % sure.len();
        for find in sure
            .iter()
            .cycle()
            .skip(first)
            .take(sure.len().min(ENTRIES))
        {
            for metres in find.at.to_array() {
                bytes.extend(((metres * 100.0).round() as i16).to_be_bytes());
            }
            bytes.push(find.sightings);
        }
        self.next = first + ENTRIES;
        Some(bytes)
    }

    /// Takes over what somebody else has found; of the same person the find of more sightings. Bytes
    /// that are no packet of finds are left alone.
    pub fn hear(&mut self, bytes: &[u8]) {
        let Some((&KIND, entries)) = bytes.split_first() else {
            return;
        };
        for entry in entries.as_chunks::<ENTRY>().0 {
            let [a, b, c, d, e, f, sightings] = *entry;
            let metres = |bytes| f64::from(i16::from_be_bytes(bytes)) / 100.0;
            let at = DVec3::new(metres([a, b]), metres([c, d]), metres([e, f]));
            let heard = Find { at, sightings };
            match self.near(at) {
                Some(known) if known.sightings < sightings => *known = heard,
                Some(_) => {}
                None => self.all.push(heard),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_sightings_of_one_place_are_a_find_and_one_is_none() {
        let mut finds = Finds::default();
        finds.see(DVec3::new(9.0, 9.0, 1.0));
        for x in [2.9, 3.0, 3.1] {
            finds.see(DVec3::new(x, 0.0, 1.0));
        }
        let sure: Vec<DVec3> = finds.sure().collect();
        assert_eq!(sure.len(), 1);
        assert!(sure[0].distance(DVec3::new(3.0, 0.0, 1.0)) < 1e-9);
    }

    #[test]
    fn finds_go_by_packet_and_noise_is_no_find() {
        let mut finds = Finds::default();
        for person in 0..20 {
            for _ in 0..3 {
                finds.see(DVec3::new(-3.0 * f64::from(person), 0.5, 6.0));
            }
        }
        let mut other = Finds::default();
        for _ in 0..2 {
            let packet = finds.packet().expect("there are some");
            assert!(packet.len() <= 116);
            other.hear(&packet);
        }
        assert_eq!(other.sure().count(), 20);
        for noise in [&[][..], &[KIND, 1, 2, 3], &[0; 30]] {
            other.hear(noise);
        }
        assert_eq!(other.sure().count(), 20);
    }
}
