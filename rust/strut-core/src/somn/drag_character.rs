//! A character whose style is dragged interactively (`docs/methods/somn.md` §7).

use super::mixture::Style;
use super::model::KeyStyleModel;
use super::pose_space::{DIMS, Row};
use super::synthesis::{Mode, Synthesis};
use crate::humanoid::Pose;
use crate::kinematics::root_path::{RootPath, Support};
use crate::math::Vec3;
use crate::math::float_funcs::double;
use std::f64::consts::LN_2;
use std::sync::Arc;

/// Half-life with which the pose approaches its target, seconds.
const HALF_LIFE_SECS: f64 = 0.1;
/// Longest time step, seconds.
const LONGEST_SECS: f64 = 1.0;

/// A body that follows the pose of a style by a critically damped spring. Its lowest foot supports it, except in flight. If
/// the recordings travel, the supporting foot moves the body and flight continues the motion; otherwise the body stays in
/// place.
#[derive(Clone, Debug)]
pub struct DragCharacter {
    synthesis: Synthesis,
    mode: Mode,
    style: Style,
    row: Row,
    velocity: Row,
    path: RootPath,
    pose: Pose,
}

impl DragCharacter {
    /// Creates a character at rest in the mean style.
    pub fn new(model: Arc<KeyStyleModel>) -> Self {
        let mut character = Self {
            path: RootPath::new(&model.space.proportions),
            style: model.style_mean,
            synthesis: Synthesis::new(model),
            mode: Mode::default(),
            row: [0.0; DIMS],
            velocity: [0.0; DIMS],
            pose: Pose::default(),
        };
        let mean = character.style;
        character.reset(&mean);
        character
    }

    /// Resets to rest above the origin in a style.
    pub fn reset(&mut self, style: &Style) {
        self.style = self.synthesis.within_reach(style);
        self.row = self.synthesis.row(&self.style, self.mode);
        self.velocity = [0.0; DIMS];
        self.path.reset(Vec3::ZERO);
        self.place(0.0);
    }

    /// Sets how the components are combined.
    pub fn set_mode(&mut self, mode: Mode) {
        self.mode = mode;
    }

    /// Advances by a time, seconds, towards a style in the axes' units, or the nearest one within reach; returns the pose.
    pub fn drag(&mut self, style: &Style, secs: f64) -> &Pose {
        let secs = if secs.is_finite() { secs.clamp(0.0, LONGEST_SECS) } else { 0.0 };
        self.style = self.synthesis.within_reach(style);
        let target = self.synthesis.row(&self.style, self.mode);
        let omega = 2.0 * LN_2 / HALF_LIFE_SECS;
        let decay = double::exp(-omega * secs);
        for ((y, velocity), x) in self.row.iter_mut().zip(&mut self.velocity).zip(&target) {
            let from = *y - x;
            let rate = *velocity + from * omega;
            *y = decay * (from + rate * secs) + x;
            *velocity = decay * (*velocity - rate * omega * secs);
        }
        self.place(secs);
        &self.pose
    }

    /// Sets the pose to a row, at rest, a time after the previous pose, seconds; returns the pose.
    pub fn take(&mut self, row: &Row, secs: f64) -> &Pose {
        self.row = *row;
        self.velocity = [0.0; DIMS];
        self.place(secs);
        &self.pose
    }

    /// Moves the character back to the origin, in its present pose.
    pub fn go_back(&mut self) {
        self.path.reset(Vec3::ZERO);
        self.place(0.0);
    }

    /// The present pose; it faces +Z.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// The pose as a row.
    pub fn row(&self) -> &Row {
        &self.row
    }

    /// The target style, within reach.
    pub fn style(&self) -> &Style {
        &self.style
    }

    /// The axes' measures of the pose.
    pub fn measured(&self) -> Style {
        self.synthesis.measured(&self.pose)
    }

    /// Whether the left and the right foot are planted.
    pub fn planted(&self) -> [bool; 2] {
        self.path.planted()
    }

    /// The synthesis behind the character, for component weights and support.
    pub fn synthesis(&self) -> &Synthesis {
        &self.synthesis
    }

    fn place(&mut self, secs: f64) {
        let model = self.synthesis.model();
        self.pose = model.space.pose(&self.row);
        let above = self.synthesis.flight_of(&self.row, &self.pose);
        self.path.place_above(&mut self.pose, Support::Auto, 0.0, secs as f32, above);
        if !model.travels {
            (self.pose.root.x, self.pose.root.z) = (0.0, 0.0);
        }
    }
}
