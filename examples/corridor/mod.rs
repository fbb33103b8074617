//! Corridor flight by optical flow: centring, speed and saccades from how the picture moves, and from
//! nothing else.
//!
//! A bee that flies at `u` through a corridor of half width `a`, `y` to the left of its middle line and
//! turned by `psi` to the left, sees the wall at an azimuth `g` go by at
//!
//! ```text
//! f(g) = u sin(g) sin(g + psi) / (a - y)          left wall; right wall: a + y, -psi            (1)
//! ```
//!
//! With `L`, `R` the flow seen straight to the left and right (`g` = 90 degrees), `FL`, `FR` halfway to
//! the front and `BL`, `BR` halfway to the back it follows that
//!
//! ```text
//! (L + R) / 2               = u / a                near the middle                              (2)
//! (L - R) / (L + R)         = y / a                                                             (3)
//! (FL - BL - FR + BR) / (L + R) = psi              for small psi                                (4)
//! ```
//!
//! Nobody needs to know `u`, `a` or where they are. The behaviour holds (2) at a set value, so that its
//! speed is in proportion to the width (honeybees: M. V. Srinivasan, S. W. Zhang, M. Lehrer and T. S.
//! Collett, *Honeybee navigation en route to the goal: visual flight control and odometry*, J. Exp.
//! Biol. 199 (1996) 237-244); it sidesteps against (3), which is the centring response of the same
//! paper, and turns against (4). Weighing the flow all around in this way is J. S. Humbert and A. M.
//! Hyslop's, *Bioinspired visuomotor convergence*, IEEE Trans. Robotics 26 (2010) 121-130.
//!
//! What is straight ahead does not go by: it grows. The flow in front spreads with `u / Z`, one over the
//! time to contact. Where it passes a threshold the bee makes a saccade, a quick turn by a fixed angle to
//! the side with less flow, as flies do (J.-C. Zufferey and D. Floreano, *Fly-inspired visual steering
//! of an ultralight indoor aircraft*, IEEE Trans. Robotics 22 (2006) 137-146).
//!
//! (The papers were not at hand; equations 1 to 4 were derived anew.)

pub mod bee;
pub mod judge;
#[cfg(test)]
mod test;
