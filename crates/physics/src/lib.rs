//! Simbeeotic: rigid bodies on their own clocks, wrenches, contacts at computed times.
