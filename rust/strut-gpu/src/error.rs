//! What can go wrong.

/// Why a graphics processor gives no result; the processor can always give it instead.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GpuError {
    /// There is no graphics processor that wgpu can use.
    #[error("no graphics processor was found: {0}")]
    NoAdapter(String),
    /// There is one, but it could not be opened.
    #[error("the graphics processor could not be opened: {0}")]
    NoDevice(String),
    /// Data exceed what one binding may hold.
    #[error("{bytes} bytes exceed the {limit} that the graphics processor takes at once")]
    TooLarge {
        /// What is needed.
        bytes: u64,
        /// What the device allows.
        limit: u64,
    },
    /// There are more windows than workgroups for them.
    #[error("{windows} windows exceed the {limit} that the graphics processor compares at once")]
    TooMany {
        /// Windows, with those that fill classes up to whole tiles.
        windows: u64,
        /// What the device allows.
        limit: u64,
    },
    /// Windows have a length other than [`WINDOW`](strut_core::search::WINDOW).
    #[error("windows are {0} frames long; {expected} were expected", expected = strut_core::search::WINDOW)]
    WindowLength(usize),
    /// Arrays do not fit each other.
    #[error("the arrays of {0} do not fit each other")]
    Malformed(&'static str),
    /// The device stopped working and remains so.
    #[error("the graphics processor stopped: {0}")]
    Lost(String),
    /// The device refused a command.
    #[error("the graphics processor failed: {0}")]
    Failed(String),
}
