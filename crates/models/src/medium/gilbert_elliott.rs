//! Loss in bursts: links that are good for a while, and bad for a while.

use super::chance;
use simbeeotic_model::radio::{Delivery, GilbertElliott as Channel, Medium};
use simbeeotic_model::units::{Length, Time};
use simbeeotic_model::{Air, Aside, BuildError, Fidelity, medium, params};

/// An air in which each link is good for a while, then bad for a while: losses come in bursts.
///
/// A link is good for a random time of mean `good`, then bad for one of mean `bad` (both exponential:
/// a Markov chain of two states), and so on, apart from all other links. Each frame gets through with
/// the chance of the state that the link is in when it is sent: `good_delivery`, or that of `curve` at
/// its distance, and `bad_delivery`. Within `range_limit` of `[channel]` (10 m unless said); without air
/// time, interference or noise. Receivers' sensitivities and error models play no part; the RSSI is that
/// of the propagation. What is not delivered counts as lost by noise.
///
/// Of all frames, `good / (good + bad)` meet a good link. The state at two times s apart is correlated by
/// exp(-s (1 / good + 1 / bad)).
///
/// Sources: Gilbert 1960, Bell System Technical Journal 39(5); Elliott 1963, ibid. 42(5); here in
/// continuous time. The papers were not at hand.
#[medium("gilbert-elliott")]
pub struct GilbertElliott;

/// Parameters of [`GilbertElliott`].
#[params]
pub struct GilbertElliottParams {
    /// Mean time that a link stays good, 1 us to 1e9 s.
    pub good: Time,
    /// Mean time that a link stays bad, 1 us to 1e9 s.
    pub bad: Time,
    /// Chance of delivery while a link is good, 0 to 1. Without it, and without a curve, all is delivered.
    pub good_delivery: Option<f64>,
    /// Chance of delivery while a link is bad, 0 to 1.
    pub bad_delivery: f64,
    /// Chance of delivery over distance while a link is good, instead of `good_delivery`:
    /// `[["0 m", 1.0], ["20 m", 0.9], ...]`. Linear between points, to half a percent of the distance;
    /// level before the first and after the last.
    pub curve: Option<Vec<(Length, f64)>>,
    /// Whether both directions of a link are good and bad together; else each by itself.
    pub symmetric: bool,
}

impl Default for GilbertElliottParams {
    fn default() -> Self {
        Self {
            good: Time::from_secs(2.0),
            bad: Time::from_secs(0.5),
            good_delivery: None,
            bad_delivery: 0.0,
            curve: None,
            symmetric: true,
        }
    }
}

impl Fidelity for GilbertElliott {
    type Params = GilbertElliottParams;

    fn medium(
        params: GilbertElliottParams,
        air: &Air,
    ) -> Result<Option<Box<dyn Medium>>, BuildError> {
        let (good, curve) = (params.good_delivery, params.curve.as_deref());
        for (name, time) in [("good", params.good), ("bad", params.bad)] {
            if !(1e-6..=1e9).contains(&time.secs()) {
                let message = format!("must be from 1 us to 1e9 s, and is {time}");
                return Err(BuildError::parameter(name, message));
            }
        }
        let delivery = Delivery::Switching(Channel {
            good_for: params.good,
            bad_for: params.bad,
            good: chance::curve(("good_delivery", good), ("curve", curve))?,
            bad: chance::curve(("bad_delivery", Some(params.bad_delivery)), ("", None))?,
            symmetric: params.symmetric,
        });
        chance::medium(delivery, air)
    }

    fn leaves_aside(_air: &Air) -> Vec<Aside> {
        chance::aside()
    }
}
