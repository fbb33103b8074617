//! Where in the spectrum a radio sends and listens.

use simbeeotic_units::constants::SPEED_OF_LIGHT;
use simbeeotic_units::{Frequency, Length};
use std::fmt;

/// A piece of spectrum: centre and width.
///
/// Two radios hear each other only on the same channel, that is, equal in both numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Channel {
    /// The middle of the channel.
    pub centre: Frequency,
    /// Its whole width.
    pub width: Frequency,
}

impl Channel {
    /// Channel `number` of IEEE 802.15.4 in the 2.4 GHz band: 5 MHz around 2405 + 5 (number - 11) MHz.
    /// `None` unless 11 ≤ number ≤ 26.
    ///
    /// Source: IEEE 802.15.4-2011, 8.1.2.2.
    #[must_use]
    pub fn ieee802154(number: u8) -> Option<Self> {
        (11..=26).contains(&number).then(|| Self {
            centre: Frequency::si(2.405e9 + 5e6 * f64::from(number - 11)),
            width: Frequency::si(5e6),
        })
    }

    /// Whether the two channels share some spectrum. Channels that only touch do not.
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        let apart = (self.centre.get() - other.centre.get()).abs();
        2.0 * apart < self.width.get() + other.width.get()
    }

    /// The wavelength at the centre: speed of light over frequency.
    #[must_use]
    pub fn wavelength(&self) -> Length {
        SPEED_OF_LIGHT / self.centre
    }
}

impl fmt::Display for Channel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} around {}", self.width, self.centre)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zigbee_channels_lie_5_mhz_apart() {
        let first = Channel::ieee802154(11).unwrap();
        let last = Channel::ieee802154(26).unwrap();
        assert_eq!(first.centre.get(), 2.405e9);
        assert_eq!(last.centre.get(), 2.480e9);
        assert!(Channel::ieee802154(10).is_none() && Channel::ieee802154(27).is_none());
    }

    #[test]
    fn neighbouring_channels_touch_and_do_not_overlap() {
        // The original's test was true for all disjoint bands.
        let [a, b] = [11, 12].map(|k| Channel::ieee802154(k).unwrap());
        let wide = Channel {
            width: Frequency::si(85e6),
            ..a
        };
        assert!(a.overlaps(&a) && wide.overlaps(&b) && b.overlaps(&wide));
        assert!(!a.overlaps(&b));
    }

    #[test]
    fn wavelength_is_12_centimetres_not_one() {
        // The original divided by 10e6 for "mega": ten times too short, 20 dB too much loss.
        let lambda = Channel::ieee802154(11).unwrap().wavelength();
        assert!((lambda.get() - 0.124_653_8).abs() < 1e-7, "{lambda}");
    }
}
