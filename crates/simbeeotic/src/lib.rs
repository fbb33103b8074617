//! Simbeeotic: the facade that users depend on, and the program.
