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

/// From so many models on, a scenario says how much memory it takes.
pub const MODELS_MANY: u64 = 1_000_000;

/// What a model takes of memory, about, in bytes.
pub const MODEL_BYTES: u64 = 1_200;

/// Where a model may start: so far from the origin along each axis, at most, in metres.
pub const START_M_MAX: f64 = 1e7;

/// How far from the middle of a body its gear may sit, along each axis, in metres.
pub const MOUNT_M_MAX: f64 = 1e3;

/// Most faults that are shown; the rest is counted.
pub const FAULTS_SHOWN: usize = 60;

/// Largest file that a world may name, in bytes.
pub const FILE_BYTES_MAX: u64 = 1 << 28;

/// Most packets that may wait in a radio.
pub const QUEUE_FRAMES_MAX: usize = 1_000_000;

/// What models may take over from others with `like`, all together, in bytes of memory, about.
pub const LIKE_BYTES_MAX: usize = 1 << 27;
