//! The gases of a world in its weather, with the puffs at hand.
//!
//! Puffs are followed from their release; many who ask at one time should not follow them again and
//! again. [`Gases`] keeps the puffs of the latest time that anybody asked for. What it answers is a
//! function of place and time all the same: who asked before does not show.

use crate::field::GasField;
use crate::plume::Source;
use crate::puff::{Drift, step_of};
use crate::weather::Weather;
use crate::world::World;
use glam::DVec3;
use simbeeotic_kernel::SimTime;
use std::sync::{Arc, PoisonError, RwLock};

/// The gases of a world in some weather.
#[derive(Debug)]
pub struct Gases {
    sources: Vec<Followed>,
    weather: Arc<dyn Weather>,
}

#[derive(Debug)]
struct Followed {
    source: Source,
    latest: RwLock<Option<Arc<Drift>>>,
}

impl Gases {
    /// The gases of `world` in `weather`.
    pub fn new(world: &World, weather: Arc<dyn Weather>) -> Self {
        let followed = |source: &Source| Followed {
            source: source.clone(),
            latest: RwLock::new(None),
        };
        Self {
            sources: world.sources.iter().map(followed).collect(),
            weather,
        }
    }

    /// One of them as a field; empty if nothing gives it off.
    pub fn field<'a>(&'a self, name: &'a str) -> GasField<'a> {
        GasField { gases: self, name }
    }

    /// The names of all gases, each once, in the order of the sources.
    pub fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for followed in &self.sources {
            let name = followed.source.gas.as_str();
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    pub(crate) fn sample(&self, name: &str, at: DVec3, time: SimTime) -> (f64, DVec3) {
        let mut sum = (0.0, DVec3::ZERO);
        for followed in self.sources.iter().filter(|f| f.source.gas == name) {
            let drift = followed.drift(time, &*self.weather);
            let source = &followed.source;
            let (value, slope) = source.sample(at, time, &*self.weather, drift.as_deref());
            sum.0 += value;
            sum.1 += slope;
        }
        sum
    }
}

impl Followed {
    /// The puffs at a time; `None` if it has none.
    fn drift(&self, time: SimTime, weather: &dyn Weather) -> Option<Arc<Drift>> {
        let puffs = self.source.puffs.as_ref()?;
        let step = step_of(&self.source, puffs, time);
        let latest = self
            .latest
            .read()
            .unwrap_or_else(PoisonError::into_inner)
            .clone();
        if let Some(drift) = latest.filter(|drift| drift.step() == step) {
            return Some(drift);
        }
        let mut latest = self.latest.write().unwrap_or_else(PoisonError::into_inner);
        let at_hand = latest.as_ref().map(|drift| drift.step());
        match at_hand {
            // Somebody else was faster.
            Some(found) if found == step => latest.clone(),
            // The past: followed for this answer only.
            Some(found) if found > step => Some(Arc::new(Drift::followed(
                &self.source,
                puffs,
                time,
                weather,
            ))),
            _ => {
                let near = latest.take().filter(|drift| step - drift.step() <= 64);
                let drift = match near {
                    Some(drift) => {
                        let mut drift = Arc::unwrap_or_clone(drift);
                        while drift.step() < step {
                            drift.advance(&self.source, puffs, weather);
                        }
                        drift
                    }
                    None => Drift::followed(&self.source, puffs, time, weather),
                };
                let drift = Arc::new(drift);
                *latest = Some(Arc::clone(&drift));
                Some(drift)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ScalarField;
    use crate::plume::Stability;
    use crate::plume::tests::{Breeze, source};
    use crate::puff::Puffs;
    use simbeeotic_units::Position;

    #[test]
    fn what_was_asked_before_does_not_show() {
        let puffing = Source {
            puffs: Some(Puffs::default()),
            ..source(1.0, Stability::C)
        };
        let smoke = Source {
            gas: "smoke".into(),
            ..source(0.0, Stability::C)
        };
        let world = World {
            sources: vec![puffing, smoke],
            ..World::default()
        };
        let wind: Arc<dyn Weather> = Arc::new(Breeze(DVec3::new(1.0, 0.5, 0.0)));
        let gases = Gases::new(&world, Arc::clone(&wind));
        assert_eq!(gases.names(), ["gas", "smoke"]);
        let at = Position::from_xyz(8.0, 4.0, 1.2);
        for millis in [
            0, 100, 9_900, 10_000, 10_300, 60_000, 9_000, 200_000, 200_400, 1,
        ] {
            let time = SimTime::from_millis(millis);
            for name in ["gas", "smoke", "nothing"] {
                let fresh = world.gas_at(name, at, time, &*wind);
                assert_eq!(gases.field(name).value(at, time), fresh, "{name} at {time}");
            }
        }
        assert!(gases.field("gas").value(at, SimTime::from_secs(30)).get() > 0.0);
    }
}
