//! Stub without the feature `baselines`: no trained method exists.

use crate::pose_vector::PoseRow;
use crate::transfer::input::Input;
use crate::transfer::model::Model;
use crate::transfer::options::Options;

/// A type without values.
#[derive(Clone, Copy, Debug)]
pub(in crate::transfer) enum Trained {}

impl Trained {
    /// Always `None`.
    pub(in crate::transfer) fn new(
        _model: &Model,
        _options: &Options,
        _classes: &[usize],
        _style: usize,
    ) -> Option<Self> {
        None
    }

    pub(in crate::transfer) fn start(&mut self, _model: &Model, _nearest: Option<usize>) {
        match *self {}
    }

    pub(in crate::transfer) fn predict(&mut self, _input: Input<'_>, _previous_output: &PoseRow) -> PoseRow {
        match *self {}
    }

    pub(in crate::transfer) fn step_secs(self) -> f32 {
        match self {}
    }
}
