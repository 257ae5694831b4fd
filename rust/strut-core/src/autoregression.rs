//! Constants common to the local and the global autoregression.

/// Greatest magnitude of the coefficient of the previous output: with more, errors feed back faster than they decay.
pub const MAX_FEEDBACK: f32 = 0.9;
