//! Tests of the radio crate through its public face.

mod agreement;
mod antennas;
mod behaviour;
mod ieee802154;
mod fading;
mod path_loss;
mod reference;
mod support;
