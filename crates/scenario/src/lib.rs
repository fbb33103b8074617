//! Scenario and world files to a checked plan to the set-up of a run.
//!
//! ```text
//!  x.toml --toml--+                       +-- faults, all at once --> render
//!                 +--> tree of nodes --plan
//!  x.xml  --xml---+      ^     |          +-- Plan --> Setup --> Simulation
//!                        |     +--print--> x.toml
//!            --set a.b=c-+
//! ```
//! Whatever a scenario was written in, it becomes one tree whose nodes know their places. Parts
//! read their parameters from it; what is wrong, anywhere, is told together, each fault with its
//! line and a guess at what was meant.
//!
//! ```
//! use simbeeotic_scenario::{Request, load_text, render};
//!
//! let rejected = load_text("swarm.toml", "[run]\nend_tiem = \"10 s\"\n", &Request::default())
//!     .err()
//!     .expect("it is wrong");
//! let text = render::faults(&rejected.faults, &rejected.sources, false);
//! assert!(text.contains("swarm.toml:2:1"));
//! assert!(text.contains("did you mean `end_time`?"));
//! ```
//!
//! Reading order: [`load`] (the whole way), [`mod@toml`] and [`xml`] (text to tree), [`set`] (changes
//! from the command line), [`sweep`] (one scenario, many runs), [`variables`] (placeholders), `like` (models
//! like others), [`plan`] (tree to parts), [`render`] (faults to text), [`mod@print`] (tree
//! to text), [`schema`] (for editors), [`generate`] (worlds made
//! by rule), [`limit`] (how large an input may be).

mod files;
pub mod generate;
mod like;
pub mod limit;
pub mod load;
pub mod plan;
pub mod print;
pub mod render;
pub mod schema;
pub mod set;
pub mod sweep;
pub mod toml;
pub mod variables;
mod world;
pub mod xml;

pub use load::{
    Checked, Converted, Loaded, Rejected, Request, check_file, convert_file, convert_world,
    load_file, load_text,
};
pub use plan::Plan;
pub use sweep::Sweep;

// The tests read scenarios, and those name parts.
#[cfg(test)]
use simbeeotic_models as _;
