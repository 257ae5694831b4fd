//! Settings of a build.

use crate::registration;
use std::ops::RangeInclusive;

/// Frame rates that a database may have, frames per second.
pub const RATES_HZ: RangeInclusive<f32> = 10.0..=480.0;

/// Options of a build.
#[derive(Clone, Debug, PartialEq)]
pub struct BuildOptions {
    /// Frames per second of the database, within [`RATES_HZ`]. All thresholds of the method were measured at the default, 60.
    pub rate_hz: f32,
    /// Name of the neutral style. With `None` it is "neutral" or "normal" if present, otherwise the first style.
    pub neutral: Option<String>,
    /// Options of the registration.
    pub registration: registration::Options,
}

impl Default for BuildOptions {
    fn default() -> Self {
        Self { rate_hz: 60.0, neutral: None, registration: registration::Options::default() }
    }
}
