//! Tests of the radio crate through its public face.

mod agreement;
mod antennas;
mod behaviour;
mod fading;
mod ieee802154;
mod ns3;
mod path_loss;
mod reference;
mod support;
mod tuning;
