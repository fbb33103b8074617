//! How large an input may be. Beyond these bounds an input is refused with a message.

/// Deepest nesting of tables and lists.
pub const DEPTH_MAX: usize = 48;

/// Deepest nesting of elements in XML: what they become stays within [`DEPTH_MAX`] and
/// [`KEY_DOTS_MAX`].
pub const ELEMENT_DEPTH_MAX: usize = 18;

/// Most dots in one key.
pub const KEY_DOTS_MAX: usize = 24;

/// Most instances of models in one scenario, nested ones included.
pub const MODELS_MAX: u64 = 4_000_000;

/// Most faults that are shown; the rest is counted.
pub const FAULTS_SHOWN: usize = 60;
