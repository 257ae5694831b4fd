//! Settings of a build.

use crate::registration;
use std::ops::RangeInclusive;

/// Rates that a database may have, frames per second.
pub const RATES_HZ: RangeInclusive<f32> = 10.0..=480.0;

/// How a database is built.
#[derive(Clone, Debug, PartialEq)]
pub struct BuildOptions {
    /// Frames per second of the database, within [`RATES_HZ`]. All thresholds of the method were measured at the default, 60.
    pub rate_hz: f32,
    /// Name of the neutral style; `None` takes "neutral" or "normal", else the first style.
    pub neutral: Option<String>,
    /// How clips are registered.
    pub registration: registration::Options,
}

impl Default for BuildOptions {
    fn default() -> Self {
        Self { rate_hz: 60.0, neutral: None, registration: registration::Options::default() }
    }
}
