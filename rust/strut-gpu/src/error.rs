//! Errors of the GPU.

/// Reason why a GPU gives no result; the CPU can always compute it instead.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GpuError {
    /// There is no GPU that wgpu can use.
    #[error("no GPU was found: {0}")]
    NoAdapter(String),
    /// The GPU could not be opened.
    #[error("the GPU could not be opened: {0}")]
    NoDevice(String),
    /// Data exceed the size limit of one binding.
    #[error("{bytes} bytes exceed the GPU's limit of {limit}")]
    TooLarge {
        /// Required size.
        bytes: u64,
        /// Limit of the device.
        limit: u64,
    },
    /// There are more windows than workgroups.
    #[error("{windows} windows exceed the GPU's limit of {limit}")]
    TooMany {
        /// Number of windows, including the padding of classes to whole tiles.
        windows: u64,
        /// Limit of the device.
        limit: u64,
    },
    /// Windows have a length other than [`WINDOW`](strut_core::search::WINDOW).
    #[error("windows are {0} frames long; {expected} were expected", expected = strut_core::search::WINDOW)]
    WindowLength(usize),
    /// Arrays do not match.
    #[error("the arrays of {0} do not fit each other")]
    Malformed(&'static str),
    /// The device stopped working permanently.
    #[error("the GPU stopped responding: {0}")]
    Lost(String),
    /// The device rejected a command.
    #[error("the GPU failed: {0}")]
    Failed(String),
}
