//! A MAV's eyes: it looks down while it flies, and corrects its way by what it sees.

use super::*;

impl SearchMav {
    /// One step along its legs.
    pub(super) fn steer(&mut self, bee: &mut Bee<'_>) -> DVec3 {
        let now = bee.now();
        let (wanted, step) = self.pilot.steer(now);
        match step {
            Step::Flies => {
                let act = self.pilot.leg().map_or(Act::Pass, |leg| leg.act);
                if act != Act::Pass && (now - self.looked).secs() >= LOOK_S {
                    self.looked = now;
                    self.look(act, bee);
                }
            }
            Step::Over(Act::Serve(which), true) => self.finds.serve(which),
            Step::Over(..) => {}
            Step::Idle => self.go_on(bee),
        }
        wanted
    }

    /// Looks down, and puts the flowers in sight on its map.
    pub(super) fn look(&mut self, act: Act, bee: &mut Bee<'_>) {
        let Some((cells, cell)) = self.brief.as_ref().map(|(_, b)| b.cells).zip(self.cell()) else {
            return;
        };
        let sightings = bee.read(self.gear.flowers);
        let mut new = Vec::new();
        for sighting in &sightings {
            if let Some(object) = sighting.thing.and_then(Thing::object)
                && self.noticed.insert(object)
            {
                new.push(object);
            }
            // The detector looks down: its forward axis is the body's down, its up the body's forward.
            let seen = sighting.position.si();
            let body = Velocity::<Flu>::from_xyz(seen.z, seen.y, -seen.x);
            let at = self.pilot.here + bee.attitude().rotate(body).si();
            match act {
                Act::Look if cells.holds(cell, at.truncate(), 0.0) => {
                    self.finds.sight(at, GATE_M);
                }
                Act::Sample(_) if cells.holds(cell, at.truncate(), 0.0) => {
                    self.finds.sight(at, GATE_NEAR_M);
                }
                Act::Serve(_) if self.finds.nearest(at.truncate(), GATE_NEAR_M).is_some() => {
                    self.finds.sight(at, GATE_NEAR_M);
                }
                _ => {}
            }
        }
        // It is nearer by now: the end of the leg is where the flower is seen.
        let (up_m, which) = match act {
            Act::Sample(which) => (SAMPLE_M, which),
            Act::Serve(which) => (DOWN_M, which),
            _ => (0.0, usize::MAX),
        };
        if let (Some(find), Some(leg)) = (self.finds.get(which), self.pilot.leg()) {
            leg.to = find.at + DVec3::Z * up_m;
        }
        if !new.is_empty()
            && let Some(referee) = bee.find("referee")
        {
            bee.tell(referee, Noticed(new));
        }
    }

    pub(super) fn cell(&self) -> Option<u16> {
        self.work.as_ref().map(|(job, _)| job.cell)
    }
}
