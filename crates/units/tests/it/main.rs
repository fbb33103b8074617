//! What other crates and scenario files see of this one: text, serde and schema of every type.

mod schema;
mod serial;
mod text;
