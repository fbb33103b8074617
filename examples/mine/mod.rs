//! The search of a mine for people, by vehicles that see walls and people near by, and talk where rock
//! lets them.
//!
//! A mine is dug on a grid: tunnels run along it, and the shaft leads from storey to storey. Each vehicle
//! keeps a chart of it ([`chart`]): for each cell where it is open, and how often somebody was there. It
//! goes where nobody was, by the neighbour that was visited least (node counting: S. Koenig, B. Szymanski
//! and Y. Liu, *Efficient and inefficient ant coverage methods*, Annals of Mathematics and Artificial
//! Intelligence 31 (2001) 41-76, from memory); where all neighbours are known, by the shortest known way
//! to the nearest cell that is not (the frontier of B. Yamauchi, CIRA 1997, from memory). If there is
//! none, or the battery is low, it goes home on its chart.
//!
//! Nobody knows where it is but by dead reckoning ([`odometry`]): body velocity, turned by the compass,
//! summed up. That drifts; the walls pull it back. With `s` the estimate along one axis, `P` the pitch of
//! the grid, `h` half the width of a tunnel, and a wall seen at the distance `d` ahead,
//!
//! ```text
//! s + d = k P + h   for a whole k       =>      s' = k P + h - d,   k = round((s + d - h) / P)       (1)
//! ```
//!
//! which holds as long as `s` is off by less than half a pitch.
//!
//! People are seen through the eyes of a sensor that misses some and sees some who are not there
//! ([`finds`]): a find counts once it was seen three times at the same place. Charts and finds go from
//! vehicle to vehicle and to the base at the foot of the shaft by radio ([`bee`], [`base`]), which rock
//! stops: news travel with those who fly. The referee ([`referee`]) alone knows who is where.

pub mod base;
pub mod bee;
pub mod chart;
pub mod finds;
pub mod odometry;
pub mod referee;
#[cfg(test)]
mod test;
