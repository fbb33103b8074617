//! Simbeeotic: antennas, propagation, error models, radios, the shared medium.
