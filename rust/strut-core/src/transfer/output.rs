//! Post-processing of predictions: style blend, root integration, foot planting (`docs/methods/mar.md` §10 and §11).

use super::blend::{StyleBlend, blended};
use super::body_part::BodyPart;
use super::contact_likelihood::CausalSmoother;
use super::footplant::Footplant;
use super::frame::StyledFrame;
use super::joint_limits::JointLimits;
use crate::humanoid::Proportions;
use crate::math::float_funcs::wrap_angle;
use crate::pose_vector::{Placement, PoseChart, PoseRow, ROW};

/// Shortest and longest output frame, as multiples of the input's.
const DURATION_RANGE: [f32; 2] = [0.2, 5.0];

/// Prediction for a style in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Predicted {
    /// yₜ.
    pub(super) row: PoseRow,
    /// Duration of the frame, seconds.
    pub(super) step_secs: f32,
    /// Likelihood that each foot of the registered targets is planted.
    pub(super) contact: [f32; 2],
}

/// Data of an input frame that its output needs, in addition to predictions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OutputInput {
    /// xₜ.
    pub(super) row: PoseRow,
    pub(super) at: Placement,
    /// Change of the heading since the frame before, radians.
    pub(super) turn: f32,
}

impl OutputInput {
    pub(super) fn new(row: &PoseRow, at: Placement, previous_at: Placement) -> Self {
        Self { row: *row, at, turn: wrap_angle(at.heading - previous_at.heading) }
    }
}

/// Output of one character.
#[derive(Clone, Debug)]
pub(super) struct Output {
    pub(super) frame: StyledFrame,
    chart: PoseChart,
    rate_hz: f32,
    /// Interpolation factor from the input to the styles, 0 to 1.
    share: f32,
    parts: [BodyPart; ROW],
    limits: JointLimits,
    /// Placement where the output starts; the input's if `None`.
    start: Option<Placement>,
    /// Placement of the last output frame before the footplant.
    place: Option<Placement>,
    /// Smoothing filters of the input's and of the output's contacts.
    smoothers: [CausalSmoother; 2],
    footplant: Footplant,
    frames: u64,
}

impl Output {
    /// Output for frames of this chart, body and rate, and for these observed ranges of the degrees of freedom.
    pub(super) fn new(
        chart: &PoseChart,
        proportions: &Proportions,
        rate_hz: f32,
        observed_range: &[PoseRow; 2],
    ) -> Self {
        Self {
            frame: StyledFrame::default(),
            chart: *chart,
            rate_hz,
            share: 1.0,
            parts: BodyPart::of_row(),
            limits: JointLimits::new(observed_range),
            start: None,
            place: None,
            smoothers: Default::default(),
            footplant: Footplant::new(*proportions),
            frames: 0,
        }
    }

    /// Restarts at a placement, or at the next input frame's.
    pub(super) fn reset(&mut self, placement: Option<Placement>) {
        self.start = placement;
        self.place = None;
        self.smoothers = Default::default();
        self.footplant.reset();
        self.frames = 0;
        self.frame = StyledFrame::default();
    }

    /// Sets the interpolation factor from the input to the styles.
    pub(super) fn set_share(&mut self, share: f32) {
        self.share = share;
    }

    /// Heading of the last frame, radians about +Y; 0 before the first.
    pub(super) fn heading(&self) -> f32 {
        self.place.map_or(0.0, |place| place.heading)
    }

    /// Duration of a frame of the input, seconds.
    pub(super) fn frame_secs(&self) -> f32 {
        1.0 / self.rate_hz
    }

    /// Moves the blended row to the next placement of the output: the heading turns as the input's does, and the root
    /// travels at the predicted velocity for the predicted duration. `timing`: whether the frame lasts as long as
    /// predicted.
    pub(super) fn place<'a>(
        &mut self,
        blend: &StyleBlend,
        output_input: &OutputInput,
        styles: impl Iterator<Item = (usize, &'a Predicted)> + Clone,
        timing: bool,
    ) {
        let frame_secs = self.frame_secs();
        let mut step_secs = 0.0;
        for (style, of) in styles.clone() {
            step_secs += blend.weight(BodyPart::Legs, style) * of.step_secs;
        }
        let [least, greatest] = DURATION_RANGE.map(|r| r * frame_secs);
        let step_secs = self.shared(frame_secs, step_secs.clamp(least, greatest));
        let rows = styles.map(|(style, of)| (style, &of.row));
        let mut row = blended(blend, &self.parts, &self.limits, &output_input.row, rows);
        for (styled, &of_input) in row.iter_mut().zip(&output_input.row) {
            *styled = self.shared(of_input, *styled);
        }
        let place = match self.place {
            None => self.start.unwrap_or(output_input.at),
            Some(p) => p.advanced(&row, step_secs, output_input.turn),
        };
        let first = self.place.is_none();
        self.place = Some(place);
        self.frame.pose = self.chart.decode(&row, place);
        self.limits.apply(&self.chart, &row, &output_input.row, &mut self.frame.pose);
        self.frame.dt_secs = match (first, timing) {
            (true, _) => 0.0,
            (false, true) => step_secs,
            (false, false) => frame_secs,
        };
        self.frame.time_in_secs = self.frames as f64 / f64::from(self.rate_hz);
        self.frame.time_out_secs += f64::from(self.frame.dt_secs);
        self.frames += 1;
    }

    /// Sets the likelihoods that the feet of the input are planted. Those of the output are their mean with the
    /// registered targets' likelihoods.
    pub(super) fn take_contacts<'a>(
        &mut self,
        blend: &StyleBlend,
        of_input: [f32; 2],
        styles: impl Iterator<Item = (usize, &'a Predicted)>,
    ) {
        let mut of_targets = [0.0; 2];
        for (style, of) in styles {
            let weight = blend.weight(BodyPart::Legs, style);
            of_targets.iter_mut().zip(of.contact).for_each(|(sum, c)| *sum += weight * c);
        }
        self.frame.contact = of_input;
        self.frame.contact_out = std::array::from_fn(|side| {
            self.shared(of_input[side], 0.5 * (of_input[side] + of_targets[side].clamp(0.0, 1.0)))
        });
    }

    /// Smooths the contacts and, if `footplant` is set, holds planted feet in place.
    pub(super) fn plant(&mut self, footplant: bool) {
        self.frame.contact = self.smoothers[0].push(self.frame.contact);
        self.frame.contact_out = self.smoothers[1].push(self.frame.contact_out);
        if footplant {
            // The first frame has no duration; no speed is measured in it.
            let dt_secs = if self.frame.dt_secs > 0.0 { self.frame.dt_secs } else { self.frame_secs() };
            self.frame.planted = self.footplant.apply(&mut self.frame.pose, self.frame.contact_out, dt_secs);
        }
    }

    /// Interpolates between the input's and the styled value. A share of 1 returns the styled value unchanged.
    fn shared(&self, of_input: f32, styled: f32) -> f32 {
        if self.share < 1.0 { of_input + self.share * (styled - of_input) } else { styled }
    }
}
