//! Links: how many frames each radio sent that another could hear, and how many of them it heard.

use super::aloft::Flight;
use crate::air::Link;
use simbeeotic_model::packets::LINKED_RADIOS_MAX;
use simbeeotic_model::radio::RadioId;

/// Sums over ordered pairs of radios in one period.
#[derive(Clone, Debug)]
pub struct Pairs {
    /// How many radios are followed.
    followed: usize,
    /// Those among which there are links; none if they are too many.
    radios: Vec<RadioId>,
    /// The place of each radio in `radios`, by id.
    places: Vec<Option<u32>>,
    /// Row by row: a row for each sender.
    sums: Vec<Sum>,
    /// The places in `sums` that are not zero.
    used: Vec<u32>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    sent: u32,
    received: u32,
    rssi_dbm: f64,
    distance_m: f64,
}

impl Pairs {
    /// Pairs of these among `all` radios; none if they are more than [`LINKED_RADIOS_MAX`].
    pub fn new(followed: &[RadioId], all: usize) -> Self {
        let few = followed.len() <= LINKED_RADIOS_MAX;
        let radios: Vec<RadioId> = if few { followed.to_vec() } else { Vec::new() };
        let mut places = vec![None; all];
        for (place, radio) in (0..).zip(&radios) {
            if let Some(slot) = places.get_mut(radio.index()) {
                *slot = Some(place);
            }
        }
        Self {
            followed: followed.len(),
            sums: vec![Sum::default(); radios.len() * radios.len()],
            radios,
            places,
            used: Vec::new(),
        }
    }

    /// How many radios are followed, with links or without.
    pub fn followed(&self) -> usize {
        self.followed
    }

    /// The radios of [`Link::from`] and [`Link::to`].
    pub fn radios(&self) -> &[RadioId] {
        &self.radios
    }

    fn sum(&mut self, from: RadioId, to: RadioId) -> Option<&mut Sum> {
        let [from, to] = [from, to].map(|radio| self.places.get(radio.index()).copied().flatten());
        let place = from? as usize * self.radios.len() + to? as usize;
        let sum = self.sums.get_mut(place)?;
        if sum.sent == 0 && sum.received == 0 {
            self.used.push(place as u32);
        }
        Some(sum)
    }

    /// Counts a frame that has ended.
    pub fn add<P>(&mut self, flight: &Flight<P>) {
        for (listener, distance_m) in &flight.listeners {
            if let Some(sum) = self.sum(flight.radio, *listener) {
                sum.sent += 1;
                sum.distance_m += f64::from(*distance_m);
            }
        }
        for (_, reception) in &flight.receptions {
            if let Some(sum) = self.sum(flight.radio, reception.radio) {
                sum.received += 1;
                sum.rssi_dbm += f64::from(reception.rssi.dbm() as f32);
            }
        }
    }

    /// The pairs between which there was a frame, by sender, then by receiver; all begin anew. What was heard
    /// and had begun before it was known who listened has `received` above `sent`.
    pub fn take(&mut self) -> Vec<Link> {
        let count = self.radios.len();
        self.used.sort_unstable();
        let mut links = Vec::with_capacity(self.used.len());
        for place in self.used.drain(..) {
            let place = place as usize;
            let Sum {
                sent,
                received,
                rssi_dbm,
                distance_m,
            } = std::mem::take(&mut self.sums[place]);
            links.push(Link {
                from: (place / count) as u32,
                to: (place % count) as u32,
                sent,
                received,
                // 0 / 0 is NaN: nothing was received.
                rssi_dbm: (rssi_dbm / f64::from(received)) as f32,
                distance_m: (distance_m / f64::from(sent)) as f32,
            });
        }
        links
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flight(radio: u32, listeners: &[(u32, f32)]) -> Flight<()> {
        Flight::on_air(RadioId(radio), listeners)
    }

    #[test]
    fn pairs_come_in_order_and_begin_anew() {
        let ids = [RadioId(2), RadioId(5), RadioId(9)];
        let mut pairs = Pairs::new(&ids, 10);
        pairs.add(&flight(9, &[(2, 3.0), (5, 4.0), (7, 1.0)]));
        pairs.add(&flight(9, &[(2, 5.0)]));
        pairs.add(&flight(2, &[(9, 4.0)]));
        let told: Vec<_> = (pairs.take().iter())
            .map(|link| (link.from, link.to, link.sent, link.distance_m))
            .collect();
        assert_eq!(told, [(0, 2, 1, 4.0), (2, 0, 2, 4.0), (2, 1, 1, 4.0)]);
        assert!(pairs.take().is_empty());
        pairs.add(&flight(2, &[(9, 1.0)]));
        assert_eq!(pairs.take()[0].distance_m, 1.0, "nothing is left of before");
    }

    #[test]
    fn too_many_radios_have_no_links() {
        let ids: Vec<RadioId> = (0..=LINKED_RADIOS_MAX as u32).map(RadioId).collect();
        let mut pairs = Pairs::new(&ids, ids.len());
        assert_eq!(pairs.followed(), ids.len());
        pairs.add(&flight(0, &[(1, 1.0)]));
        assert!(pairs.radios().is_empty() && pairs.take().is_empty());
    }
}
