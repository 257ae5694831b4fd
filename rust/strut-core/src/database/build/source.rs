//! Source clips of a database.

use crate::humanoid::HumanoidMotion;

/// Minimum number of frames of a clip at the database's rate: a search window and its neighbours.
pub const MIN_CLIP_FRAMES: usize = 8;
/// A labelled clip, retargeted to the database's proportions.
#[derive(Clone, Debug, PartialEq)]
pub struct SourceClip {
    /// File stem or other name for display.
    pub name: String,
    /// Name of the action, e.g. "walk".
    pub action: String,
    /// Name of the style, e.g. "old".
    pub style: String,
    /// Number of the take. It orders the clips of a class.
    pub take: u32,
    /// Motion, at any rate. All clips of a build have the same proportions.
    pub motion: HumanoidMotion,
    /// Origin of the clip.
    pub source: String,
    /// Licence, empty if unknown.
    pub licence: String,
    /// Known correspondence with other clips of the action, if any.
    pub script: Option<Script>,
}

/// Known correspondence. Performances of one script (a procedural motion rendered in every style, or clips annotated by
/// hand) show the same instant where their script times are equal. It replaces registration if every clip of an action
/// has a script.
#[derive(Clone, Debug, PartialEq)]
pub struct Script {
    /// Identifier of the script. Clips of an action correspond only if they perform the same script. A style's
    /// counterparts of a frame come from its first 8 performances of that script.
    pub id: u32,
    /// Script time of every frame of the clip, at the clip's own rate: finite, strictly increasing, in
    /// seconds of a neutral performance. Its pace is the pace of the style (`time_step`).
    pub time: Vec<f32>,
}
