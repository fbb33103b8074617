//! Simbeeotic: events, instants, random streams, trace hash, pacing.
