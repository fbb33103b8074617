//! Simbeeotic: scenario and world files to a checked plan to a simulation.
