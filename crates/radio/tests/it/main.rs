//! Tests of the radio crate through its public face.

mod agreement;
mod antennas;
mod behaviour;
mod reference;
mod support;
