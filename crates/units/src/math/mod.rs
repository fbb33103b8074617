//! Functions whose bits agree on every machine.
//!
//! The standard library calls the platform's sine; two platforms differ in the last bit, and a run
//! that depends on that bit has a different trace on each. These functions are `libm`'s (the MUSL
//! routines in Rust), the same everywhere. Results of a simulation go through them and never
//! through `f64::sin` and its kind. Square root, absolute value, floor and the four operations are
//! exact by IEEE 754 and may be the standard ones.

mod functions;
mod normal;

pub use functions::{
    acos, asin, atan, atan2, cos, erf, erfc, exp, exp_m1, hypot, ln, ln_1p, log2, log10, pow, sin,
    sin_cos, sinc, tan, tanh, wrap_positive, wrap_signed,
};
pub use normal::{normal_cdf, normal_quantile};
