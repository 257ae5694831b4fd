//! Styling of clips: settings by name, one clip on one thread or on all, and a summary.

mod frames;
mod settings;
mod styling;
mod summary;
mod trace;
mod track;

pub use settings::{METHODS, StyleSettings, Switch};
pub use styling::{Spread, Styled, Styling, input_of};
pub use summary::Summary;
pub use trace::{Spool, StageTimer, TraceLog, class_names};
pub use track::{StyleKey, StyleTrack};
