//! In place of `trained` where the methods that are trained beforehand are left out: there is never one.

use super::mar::Input;
use super::model::Model;
use super::options::Options;
use crate::pose_vector::PoseRow;

/// No predictor.
#[derive(Clone, Copy, Debug)]
pub(super) enum Trained {}

impl Trained {
    /// None.
    pub(super) fn new(_model: &Model, _options: &Options, _classes: &[usize], _style: usize) -> Option<Self> {
        None
    }

    pub(super) fn start(&mut self, _model: &Model, _nearest: Option<usize>) {
        match *self {}
    }

    pub(super) fn predict(&mut self, _input: Input<'_>, _previous_output: &PoseRow) -> PoseRow {
        match *self {}
    }

    pub(super) fn step_secs(self) -> f32 {
        match self {}
    }
}
