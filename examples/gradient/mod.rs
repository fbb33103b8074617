//! The gradient: RF beacons as guides, the paper's second scenario (B. Kate et al., *Simbeeotic*, IPSN
//! 2012, section 5.2, Figure 10), whose code was never published.
//!
//! Beacons lie on the ground, around a hive. Each broadcasts its value twice a second. Bees that know
//! neither where they are nor from which direction a packet comes travel by these packets alone from the hive
//! to the edge of the field, along one of two preferred paths, and back.
//!
//! # The value
//!
//! A beacon's value are two lengths that whoever laid it down has written into it, once: `along`, from
//! the hive to the point of the nearest path that is nearest to the beacon, on that path; and `across`,
//! from the beacon to this point. A bee makes a hill of them, whose crest are the paths:
//!
//! ```text
//! u = along - stay across      outbound: the crest rises from the hive to the edge       (1)
//! u = -along - stay across     homeward: the same crest, with its summit at the hive
//! ```
//! One field serves both ways: this is why a packet has two numbers and not their difference. Two marks stand
//! in packets besides: that a beacon is the hive's, and that one lies at the edge.
//!
//! # The estimate
//!
//! A bee cannot tell a beacon's direction, but a loud one is likely near. From the packets of the last
//! second it takes the mean of both lengths, each beacon weighed by its received power ([`nose`]). Power
//! is not distance: two rays make it fall with the second to the fourth power of it, and shadowing moves it by
//! decibels that nobody knows. The mean is a blurred hill, shifted by chance.
//!
//! # The walk
//!
//! The hill's height at one place is all that a bee knows, so it does as bacteria do: it flies straight
//! while `u` grows, and turns by a random angle soon after it no longer does ([`chemotaxis`]). When the loudest
//! beacon is one of the edge's, it turns to the other hill; when it is the hive's, a trip is done.
//!
//! A bee that flies out of the field hears the same few beacons from ever farther, and its estimate stays as
//! it is. Signal strength tells: below `quiet`, each decibel that the loudest beacon loses counts as a metre
//! down.
//!
//! Nobody tells a bee which path to take: at the hive both crests begin, and the first run that climbs decides.
//!
//! # What is left to chance
//!
//! The air is `ieee802154`: beacons speak at random phases, wait for a free channel and collide. It costs no more
//! than `simple` of equal reach, and is true as well where beacons lie close. It draws no noise of its own that matters
//! at these distances, so noise is what a field has: shadowing, a normal number of decibels for each place
//! of a bee and a beacon, correlated over 10 m (`noise` in the scenario). A longer mean does not remove it, only
//! flying on does.
//!
//! Exact here, and not in a field: a beacon's place when its value was written, the received power that a bee
//! reads (a CC2420 tells whole decibels, and errs by up to 6), and the flight, which holds its direction without
//! a compass (`vehicle.turn_sigma` and `vehicle.direction_sigma` are 0).
//!
//! Beacons' antennas are 5 cm above the ground. `two-ray` is a choice of simplicity, as in textbooks: nearer than
//! the crossover, some 15 m between a beacon and a bee 3 m high, it is free space. `two-ray-exact` sums both rays everywhere.
//!
//! # Delay
//!
//! Everything takes time: a packet counts for a second, the past is remembered for another, the vehicle turns
//! its flight within 0.3 s, so a bee learns that it has left the crest about a second and a half, or some two metres,
//! too late, and then draws turns until one leads up again. That is why a slow bee keeps closer to the path,
//! and why a longer memory, which bridges more noise, makes wider detours.
//!
//! Reading order: [`paths`] (geometry), [`places`] (where beacons lie), [`packet`], [`beacon`], [`nose`],
//! [`chemotaxis`], [`bee`], [`referee`] (who sees the truth, and measures).

pub mod beacon;
pub mod bee;
pub mod chemotaxis;
pub mod nose;
pub mod packet;
pub mod paths;
pub mod places;
pub mod referee;
#[cfg(test)]
mod test;
