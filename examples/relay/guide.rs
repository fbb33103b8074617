//! From fixes to flight: a MAV that knows roughly where it is, and flies to a place.

use simbeeotic::models::sensor::gnss::Fix;
use simbeeotic::prelude::*;
use simbeeotic::units::glam::{DVec2, DVec3};

/// It closes this part of the way in each second, 1/s.
const GAIN_HZ: f64 = 0.8;

/// Knows where its MAV is by a sensor called `gnss`.
pub(super) struct Guide {
    gnss: Handle<Option<Fix>>,
    fix: Option<(Fix, SimTime)>,
}

impl Guide {
    pub(super) fn new(gnss: Handle<Option<Fix>>) -> Self {
        Self { gnss, fix: None }
    }

    /// Where it is. `None` before the first fix.
    pub(super) fn here(&mut self, bee: &mut Bee<'_>) -> Option<DVec3> {
        let sample = bee.sample(self.gnss);
        if let Some(fix) = sample.reading {
            self.fix = Some((fix, sample.taken));
        }
        let (fix, taken) = self.fix.as_ref()?;
        Some(fix.position.si() + fix.velocity.si() * (bee.now() - *taken).secs())
    }

    /// Flies to a place, no faster than `limit`; hovers if there is none, or if nobody knows where it is.
    pub(super) fn fly(
        &mut self,
        place: Option<DVec2>,
        height: Length,
        limit: Speed,
        bee: &mut Bee<'_>,
    ) {
        let here = self.here(bee);
        let wanted = match (here, place) {
            (Some(here), Some(place)) => (place.extend(height.get()) - here) * GAIN_HZ,
            _ => DVec3::ZERO,
        };
        let wanted = Velocity::<Enu>::from_si(wanted).limit(limit);
        let wanted = bee.attitude().unrotate(wanted);
        bee.fly(wanted);
    }
}
