//! The value tree that every scenario becomes, whatever it was written in.
//!
//! TOML, the original's XML and `--set path=value` all turn into one tree of [`Node`]s. Each node
//! and each key knows the bytes it came from ([`Span`]), so an error found late (by the part that
//! reads its parameters) still points at the line the user wrote.
//!
//! Reading order: [`node`] (the tree), [`fault`] (what may be wrong with it), [`de`] (serde: from
//! a node to a typed value), [`read`](mod@read) (all faults of a section at once).

pub mod de;
pub mod fault;
pub mod node;
pub mod read;
pub mod ser;

pub use fault::{Fault, Level};
pub use node::{Key, Node, Source, SourceId, Sources, Span, Table, Value};
pub use read::{Params, read, read_params};
pub use ser::to_node;
