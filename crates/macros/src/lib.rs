//! Simbeeotic: attribute macros for parts and their parameters.
