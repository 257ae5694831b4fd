//! The clips that a database is built from.

use crate::humanoid::HumanoidMotion;

/// Fewest frames of a clip at the database's rate: a search window and its neighbours.
pub const MIN_CLIP_FRAMES: usize = 8;
/// A labelled clip, retargeted to the database's proportions.
#[derive(Clone, Debug, PartialEq)]
pub struct SourceClip {
    /// File stem or other name, for people.
    pub name: String,
    /// Name of the action, e.g. "walk".
    pub action: String,
    /// Name of the style, e.g. "old".
    pub style: String,
    /// Number of the take: orders the clips of a class.
    pub take: u32,
    /// The motion, at any rate; every clip of a build has the same proportions.
    pub motion: HumanoidMotion,
    /// Where the clip comes from.
    pub source: String,
    /// Its licence, empty if unknown.
    pub licence: String,
    /// Known correspondence with other clips of the action, where there is one.
    pub script: Option<Script>,
}

/// Known correspondence: performances of one script (a procedural motion rendered in every style, or clips
/// annotated by hand) show the same instant where their script times are equal. Used instead of
/// registration when every clip of an action has one.
#[derive(Clone, Debug, PartialEq)]
pub struct Script {
    /// Clips of an action correspond only if they perform the same script; a style's counterparts of a
    /// frame come from all its performances of that script (the first 8).
    pub id: u32,
    /// Script time of every frame of the clip, at the clip's own rate: finite, strictly increasing, in
    /// seconds of a neutral performance. How fast it runs is how fast the style performs (`time_step`).
    pub time: Vec<f32>,
}
