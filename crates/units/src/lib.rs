//! Simbeeotic: quantities with units as text, frames, time, decibels.
