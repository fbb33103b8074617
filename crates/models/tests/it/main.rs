//! The shelf in flight: what the parts do in a run, against closed forms and the paper's numbers.

mod agents;
mod beams;
mod energy;
mod flight;
mod pushes;
mod recorded;
mod refusals;
mod sight;
mod solid;
mod swarm;
