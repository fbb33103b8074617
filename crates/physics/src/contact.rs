//! What is reported of an impact.

use crate::body::BodyId;
use glam::DVec3;
use simbeeotic_kernel::SimTime;

/// Two bodies, or a body and the ground, touch.
///
/// What is pressed together meets many times a second in small bounces. Those are one lasting contact,
/// which is reported when it begins: a later impact of the same two is reported if they had been apart
/// for [`LASTING_S`](crate::limits::LASTING_S), or if they meet faster than
/// [`NEWS_SPEED_M_S`](crate::limits::NEWS_SPEED_M_S). Impulses act in any case. (What only detects is
/// reported each time it meets.)
///
/// Contacts of one report are ordered by `(time, a, b)`, the ground after all bodies; of two equal
/// keys (a pair that meets twice within a nanosecond) the earlier impact comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// When: the computed time of impact, rounded to a nanosecond.
    pub time: SimTime,
    /// The body, or of two bodies the one that was added first.
    pub a: BodyId,
    /// The other body; `None` is the ground.
    pub b: Option<BodyId>,
    /// Where they touch, ENU, m.
    pub point_enu: DVec3,
    /// Unit vector from `a` to `b` through the point of contact, ENU; downwards for the ground.
    pub normal_enu: DVec3,
    /// Velocity of `a` at the point of contact as seen from `b`, just before, ENU, m/s. Its component
    /// along the normal is the speed at which they meet.
    pub relative_velocity_enu: DVec3,
    /// What `a` received, ENU, N s; `b` received the opposite. Zero if contacts are only detected.
    pub impulse_enu: DVec3,
}

impl Contact {
    /// The speed at which the two met, along the normal, m/s.
    #[must_use]
    pub fn closing_speed_m_s(&self) -> f64 {
        self.relative_velocity_enu.dot(self.normal_enu)
    }
}
