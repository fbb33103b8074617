//! A MAV's way home, and down to its pad.

use super::*;

impl SearchMav {
    /// Up, and back over its spot.
    pub(super) fn go_home(&mut self, bee: &mut Bee<'_>) {
        let Some(spot) = self.brief.as_ref().map(|(_, brief)| brief.spot) else {
            return;
        };
        bee.hover(true);
        self.work = None;
        self.phase = Phase::Home;
        self.pilot.clear(bee.now());
        let (here, up_m) = (self.pilot.here, self.layer());
        let speed_m_s = self.params.speed.get();
        let up = Leg::pass(here.truncate().extend(up_m), speed_m_s);
        self.pilot.add(Leg { firm: true, ..up });
        let over = Leg::pass(spot.truncate().extend(up_m), speed_m_s);
        self.pilot.add(Leg {
            firm: true,
            near_m: 0.4,
            ..over
        });
    }

    /// Comes down over its spot: fast while it is high, slowly at the end.
    pub(super) fn sink(&mut self, low: u32, bee: &mut Bee<'_>) -> DVec3 {
        let Some(spot) = self.brief.as_ref().map(|(_, brief)| brief.spot) else {
            return DVec3::ZERO;
        };
        let here = self.pilot.here;
        let height_m = bee
            .read(self.gear.height)
            .map_or(10.0, |height| height.metres());
        let low = if height_m < 0.12 { low + 1 } else { 0 };
        self.phase = Phase::Sinks { low };
        if low >= 5 {
            self.rest(bee);
            return DVec3::ZERO;
        }
        let aside = toward((spot - here).truncate().extend(0.0), 1.0);
        let down_m_s = match height_m {
            high if high > 2.0 => 1.5,
            low if low < 0.3 => 0.15,
            _ => 0.4,
        };
        let near = (spot - here).truncate().length() < 0.5;
        aside - DVec3::Z * if near { down_m_s } else { 0.0 }
    }

    /// It has landed: motors off, and the log to the hive.
    pub(super) fn rest(&mut self, bee: &mut Bee<'_>) {
        bee.hover(false);
        bee.fly(Velocity::ZERO);
        self.work = None;
        self.phase = Phase::Docked {
            since: bee.now(),
            heard: false,
        };
    }
}
