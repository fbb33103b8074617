//! What numbers can be: no band is drawn where they cannot lie, and no axis goes there.

/// Last words of the names of shares.
const SHARES: [&str; 6] = [
    "coverage",
    "delivery",
    "delivery in range",
    "ratio",
    "share",
    "soc",
];
/// Units in which zero is a place like any other.
const SIGNED: [&str; 4] = ["dBm", "dB", "°C", "deg"];
/// Places and velocities along an axis.
const ALONG: [&str; 5] = ["climb", "altitude", "x", "y", "z"];

/// The least and the most that numbers can be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Limits {
    pub(super) least: f64,
    pub(super) most: f64,
}

impl Limits {
    /// None.
    pub(super) const NONE: Self = Self {
        least: f64::NEG_INFINITY,
        most: f64::INFINITY,
    };

    /// Those of some values of a quantity: none of what has a sign; of all else zero if no value is below it,
    /// and one of shares if none is above it.
    pub(super) fn of(name: &str, unit: &str, values: impl Iterator<Item = f64>) -> Self {
        // Readings of sensors, `bee/imu:fx`, have offsets and noise.
        let signed = SIGNED.contains(&unit) || ALONG.contains(&name) || name.contains(':');
        if signed {
            return Self::NONE;
        }
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values {
            (low, high) = (low.min(value), high.max(value));
        }
        let last = name.rsplit(['/', '.']).next().unwrap_or(name);
        let whole = match unit {
            "" if SHARES.contains(&last) => 1.0,
            "%" => 100.0,
            _ => f64::INFINITY,
        };
        if low < 0.0 {
            return Self::NONE;
        }
        Self {
            least: 0.0,
            most: if high <= whole { whole } else { f64::INFINITY },
        }
    }

    /// Both: what holds for the numbers of two quantities.
    pub(super) fn or(self, other: Self) -> Self {
        Self {
            least: self.least.min(other.least),
            most: self.most.max(other.most),
        }
    }

    /// The part of a band that there can be, and whether it is not all of it.
    pub(super) fn cut(self, [low, high]: [f64; 2]) -> ([f64; 2], bool) {
        let kept = [low.max(self.least), high.min(self.most)];
        (kept, kept != [low, high])
    }

    /// Where bands were cut, to stand behind what they are.
    pub(super) fn said(self, [low, high]: [bool; 2]) -> String {
        match (low, high) {
            (true, true) => format!(", cut at 0 and {}", self.most),
            (true, false) => ", cut at 0".to_owned(),
            (false, true) => format!(", cut at {}", self.most),
            (false, false) => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits(name: &str, unit: &str, values: &[f64]) -> [f64; 2] {
        let limits = Limits::of(name, unit, values.iter().copied());
        [limits.least, limits.most]
    }

    #[test]
    fn counts_end_at_zero_and_shares_at_one_too() {
        let inf = f64::INFINITY;
        assert_eq!(limits("trips", "", &[0.0, 1.0]), [0.0, inf]);
        assert_eq!(limits("error", "m", &[-0.1, 1.0]), [-inf, inf]);
        assert_eq!(limits("bee-1/battery/soc", "", &[0.9, 1.0]), [0.0, 1.0]);
        assert_eq!(limits("packets/delivery", "", &[0.2]), [0.0, 1.0]);
        assert_eq!(limits("lost", "%", &[3.0]), [0.0, 100.0]);
        assert_eq!(
            limits("coverage", "", &[0.2, 1.5]),
            [0.0, inf],
            "no share, then"
        );
    }

    #[test]
    fn what_has_a_sign_has_no_limits() {
        for (name, unit) in [
            ("altitude", "m"),
            ("rssi", "dBm"),
            ("air", "°C"),
            ("bee-1/imu:fz", "m/s²"),
        ] {
            assert_eq!(
                limits(name, unit, &[1.0, 2.0])[0],
                f64::NEG_INFINITY,
                "{name}"
            );
        }
    }

    #[test]
    fn a_band_is_cut_where_nothing_can_be() {
        let share = Limits {
            least: 0.0,
            most: 1.0,
        };
        assert_eq!(share.cut([-0.1, 0.4]), ([0.0, 0.4], true));
        assert_eq!(share.cut([0.1, 0.4]), ([0.1, 0.4], false));
        assert_eq!(share.said([true, true]), ", cut at 0 and 1");
        assert_eq!(share.said([false, false]), "");
    }
}
