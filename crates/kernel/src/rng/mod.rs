//! Random numbers that do not depend on the order in which they are asked for.
//!
//! A stream is named, not numbered: `(master seed, path of the part, purpose)`, for example
//! `(111982, "bee-17/compass", "noise")`. Adding a vehicle, a sensor or a second purpose leaves every
//! other stream as it was. (In the original each model got the next draw of one parent generator,
//! so one more sensor shifted the random numbers of everything created after it.)
//!
//! - [`Stream`] is for parts that draw again and again. It is a counter and a key around
//!   Philox 4x32-10, 24 bytes, and can be copied or stored at any point.
//! - [`draw_u64`] and [`draw_u32`] have no state: one number for `(key, a, b)` or `(key, a)`, such as
//!   (frame, receiver). Use them where the order of asking is an accident: inside parallel loops.
//!
//! The generator, the uniform, the normal and all other samplers are ours and fixed for good:
//! a library that improves its sampling changes every recorded run.
//!
//! Distinct names give streams that are distinct up to the chance that two 64-bit keys collide:
//! 3e-8 for a million streams.

mod draw;
mod key;
mod philox;
mod stream;

pub use draw::{draw_f64, draw_u32, draw_u64};
pub use key::{mix, path_key};
pub use philox::philox4x32;
pub use stream::Stream;
