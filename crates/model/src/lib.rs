//! Simbeeotic: what authors write against: behaviours, vehicles, sensors, radios, the registry, the simulation.
