//! Path loss with shadowing and fading on it.

use super::{Link, Links, Propagation, Remark};
use crate::fading::{self, Fading};
use crate::shadowing::Shadowing;
use simbeeotic_units::Decibels;
use std::sync::Arc;

/// Path loss, with shadowing and fading on it: the decibels of the three add up.
///
/// Path and shadowing together never amplify: where shadowing would lift a link above 0 dB of loss, which is
/// within centimetres, it stays there. Fading has mean 1, and may.
#[derive(Debug)]
pub struct Composite {
    /// What distance does.
    pub path: Arc<dyn Propagation>,
    /// What places do.
    pub shadowing: Option<Shadowing>,
    /// What echoes do.
    pub fading: Option<Arc<dyn Fading>>,
}

impl Propagation for Composite {
    fn loss(&self, link: &Link) -> Decibels {
        let mut loss = self.path.loss(link);
        if let Some(shadowing) = &self.shadowing {
            loss = (loss + shadowing.loss(link)).max(Decibels::ZERO);
        }
        if let Some(fading) = &self.fading {
            loss -= Decibels::from_ratio(fading::gain(fading.as_ref(), link));
        }
        loss
    }

    fn remarks(&self, radios: &mut dyn Iterator<Item = String>) -> Vec<Remark> {
        self.path.remarks(radios)
    }

    fn gains(&self, links: &Links<'_>, gains: &mut [f32]) {
        self.path.gains(links, gains);
        if let Some(shadowing) = &self.shadowing {
            shadowing.shade(links, gains);
            for gain in gains.iter_mut() {
                *gain = if *gain < 1.0 { *gain } else { 1.0 };
            }
        }
        if let Some(fading) = &self.fading {
            fading::fade(fading.as_ref(), links, gains);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fading::{Nakagami, Rayleigh, Rician};
    use crate::propagation::testing::{along, assert_rows_agree, between};
    use crate::propagation::{FreeSpace, LogDistance};
    use glam::DVec3;
    use simbeeotic_kernel::rng::mix;
    use simbeeotic_units::{Length, math};

    fn composite(seed: u64, fading: Option<Arc<dyn Fading>>) -> Composite {
        let (sigma, distance) = (Decibels::from_db(6.0), Length::from_metres(20.0));
        Composite {
            path: Arc::new(LogDistance::default()),
            shadowing: Some(Shadowing::field(seed, sigma, distance)),
            fading,
        }
    }

    #[test]
    fn rows_of_links_agree_with_single_ones_in_either_role() {
        let fadings: [Arc<dyn Fading>; 3] = [
            Arc::new(Rayleigh),
            Arc::new(Rician::new(Decibels::from_db(6.0))),
            Arc::new(Nakagami::ns3()),
        ];
        assert_rows_agree(&composite(1, None), &along(300, 3.0), 2e-3);
        for fading in fadings {
            assert_rows_agree(&composite(1, Some(fading)), &along(300, 3.0), 3e-3);
        }
    }

    #[test]
    fn without_fading_it_is_symmetric_and_with_it_each_way_has_its_own_draw() {
        let link = between(DVec3::ZERO, DVec3::new(30.0, 8.0, 3.0));
        let back = Link {
            tx: link.rx,
            rx: link.tx,
            ..link
        };
        let calm = composite(3, None);
        assert_eq!(calm.loss(&link), calm.loss(&back));
        let faded = composite(3, Some(Arc::new(Rayleigh)));
        assert_ne!(faded.loss(&link), faded.loss(&back));
        let next = Link { frame: 100, ..link };
        assert_ne!(faded.loss(&link), faded.loss(&next));
        assert_eq!(
            faded.loss(&link),
            composite(3, Some(Arc::new(Rayleigh))).loss(&link)
        );
    }

    /// Suzuki's distribution: in decibels its mean is that of the path less 2.507 dB, its variance
    /// `sigma^2 + 5.570^2`.
    #[test]
    fn shadowing_and_rayleigh_fading_add_their_variances_in_decibels() {
        let link = between(DVec3::ZERO, DVec3::X * 50.0);
        let path = LogDistance::default().loss(&link).db();
        let losses: Vec<f64> = (0..8000)
            .map(|seed| {
                let frame = mix(seed);
                let model = composite(seed, Some(Arc::new(Rayleigh)));
                model.loss(&Link { frame, ..link }).db() - path
            })
            .collect();
        let n = losses.len() as f64;
        let mean = losses.iter().sum::<f64>() / n;
        let variance = losses.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / n;
        assert!((mean - 2.507).abs() < 0.3, "mean {mean} dB");
        let want = (36.0 + 5.570 * 5.570_f64).sqrt();
        assert!(
            (variance.sqrt() / want - 1.0).abs() < 0.03,
            "{}",
            variance.sqrt()
        );
    }

    #[test]
    fn shadowing_amplifies_nothing() {
        for seed in 0..50 {
            let model = Composite {
                path: Arc::new(FreeSpace),
                shadowing: Some(Shadowing::links(seed, Decibels::from_db(20.0))),
                fading: None,
            };
            for d in [0.0, 0.005, 0.02, 0.1] {
                let loss = model.loss(&between(DVec3::ZERO, DVec3::X * d));
                assert!(loss >= Decibels::ZERO, "{loss} at {d} m");
            }
            assert_rows_agree(&model, &[DVec3::new(0.25, -0.5, 1.51)], 1e-3);
        }
    }

    #[test]
    fn the_mean_power_over_frames_is_that_without_fading() {
        let link = between(DVec3::ZERO, DVec3::X * 40.0);
        let calm = (-composite(4, None).loss(&link)).ratio();
        let model = composite(4, Some(Arc::new(Nakagami::new(1.5))));
        let n = 50_000;
        let sum: f64 = (0..n)
            .map(|i| {
                (-model.loss(&Link {
                    frame: mix(i),
                    ..link
                }))
                .ratio()
            })
            .sum();
        let ratio_db = 10.0 * math::log10(sum / n as f64 / calm);
        assert!(ratio_db.abs() < 0.05, "{ratio_db} dB");
    }
}
