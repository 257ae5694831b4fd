//! The online stylizer: one input frame in, one styled frame out. Composes all stages.

use super::blend::{StyleBlend, StyleError};
use super::body_part::BodyPart;
use super::contact_likelihood::RecentFeet;
use super::contact_likelihood::{VOTERS, Votes, vote};
use super::found::FoundFrame;
use super::frame::{NoClock, Stage, StageClock, StyledFrame, Trace};
use super::input::Input;
use super::input_stream::{InputFrame, InputStream};
use super::mar::{Mixture, StylePrediction};
use super::model::Model;
use super::options::{Options, OptionsError};
use super::output::{Output, OutputInput, Predicted};
use crate::humanoid::Pose;
use crate::pose_vector::{Placement, PoseRow};
use crate::search::Neighbours;
use crate::search::{Neighbour, QueryWindow};
use std::sync::Arc;

/// Styles a stream of poses. The output for a frame depends on that frame and earlier ones only. After the first frames
/// with a set of styles, nothing is allocated.
#[derive(Clone, Debug)]
pub struct Stylizer {
    model: Arc<Model>,
    options: Options,
    blend: StyleBlend,
    mixture: Mixture,
    styles: Vec<StylePrediction>,
    contacts: Neighbours,
    votes: Votes,

    input: InputStream,
    /// Data of the last input frame that the output needs.
    output_input: Option<OutputInput>,
    output: Output,
}

impl Stylizer {
    /// Creates a stylizer of the neutral style. Its targets are computed for the first frame, unless another style is
    /// set before.
    ///
    /// # Errors
    /// If an option is out of range, or the database has no class of the specified action and input style.
    pub fn new(model: Arc<Model>, options: Options) -> Result<Self, OptionsError> {
        options.validate()?;
        let mixture = Mixture::new(&model, &options)
            .ok_or(OptionsError::NoClass { action: options.action, style: options.input_style })?;
        let db = model.catalogue();
        Ok(Self {
            blend: StyleBlend::new(db.styles.len(), db.neutral.into()),
            mixture,
            styles: Vec::with_capacity(db.styles.len()),
            contacts: Neighbours::default(),
            votes: Votes::default(),
            input: InputStream::new(model.index().window_length()),
            output_input: None,
            output: Output::new(&db.chart, &db.proportions, db.rate_hz, db.observed_range()),
            options,
            model,
        })
    }

    /// Sets one weight for each style of the database, for the whole body. The neutral style receives the remainder to
    /// a sum of 1.
    ///
    /// # Errors
    /// If the number of weights is wrong or one is not finite; the previous weights are then kept.
    pub fn set_styles(&mut self, weights: &[f32]) -> Result<(), StyleError> {
        self.blend.set_whole(weights)?;
        self.activate_styles();
        Ok(())
    }

    /// Sets the weights of one body part. With `None` it uses the weights of the whole body again.
    ///
    /// # Errors
    /// As [`Stylizer::set_styles`].
    pub fn set_part_styles(&mut self, part: BodyPart, weights: Option<&[f32]>) -> Result<(), StyleError> {
        self.blend.set_part(part, weights)?;
        self.activate_styles();
        Ok(())
    }

    /// Sets the interpolation factor of pose, duration and contacts from the input's to the styles', from 0 to 1: for input
    /// that the database does not contain, such as standing in a database of walks. NaN counts as 1.
    pub fn set_style_share(&mut self, share: f32) {
        self.output.set_share(if share.is_nan() { 1.0 } else { share.clamp(0.0, 1.0) });
    }

    /// Replaces the options; the stream continues. Changing the method, the labels, `k`, or a ridge that a method was
    /// trained with restarts the autoregression.
    ///
    /// # Errors
    /// As [`Stylizer::new`]; the previous options are then kept.
    pub fn set_options(&mut self, options: Options) -> Result<(), OptionsError> {
        options.validate()?;
        let begins_anew = !self.options.predicts_like(&options);
        if begins_anew {
            self.mixture = Mixture::new(&self.model, &options)
                .ok_or(OptionsError::NoClass { action: options.action, style: options.input_style })?;
        }
        self.options = options;
        if begins_anew {
            // The old predictions keep the target tables in memory that the new ones need.
            let before = std::mem::take(&mut self.styles);
            if !before.is_empty() {
                self.activate_styles();
            }
        }
        Ok(())
    }

    /// Restarts, for example after a seek. The output starts at `placement`, or else at the next input frame's.
    pub fn reset(&mut self, placement: Option<Placement>) {
        self.input.reset();
        self.forget_input();
        self.output.reset(placement);
    }

    /// Styles the next input frame: a pose on the database's proportions, one frame after the last at the database's rate.
    pub fn push(&mut self, pose: &Pose) -> &StyledFrame {
        self.push_timed(pose, &mut NoClock)
    }

    /// [`Stylizer::push`]; calls a clock when each stage ends.
    pub fn push_timed(&mut self, pose: &Pose, clock: &mut impl StageClock) -> &StyledFrame {
        self.predict_frame(pose, None, clock);
        self.output.plant(self.options.footplant);
        clock.end(Stage::Footplant);
        &self.output.frame
    }

    /// The last frame.
    pub fn frame(&self) -> &StyledFrame {
        &self.output.frame
    }

    /// Data from which the last frame was computed.
    pub fn trace(&self) -> Trace<'_> {
        Trace {
            catalogue: self.model.catalogue(),
            class_weights: self.mixture.class_weights(),
            neighbours: self.mixture.heaviest_neighbours(),
            neighbour_weights: self.mixture.heaviest_neighbour_weights(),
            blend: &self.blend,
            bias: self.mixture.bias,
            frame: &self.output.frame,
        }
    }

    /// Degrees of freedom predicted for a style in the last frame, before styles are blended; `None` for a style
    /// without weight.
    pub fn predicted_row(&self, style: usize) -> Option<&PoseRow> {
        self.styles.iter().find(|s| s.style == style).map(|s| &s.now.row)
    }

    /// Likelihoods that the left and the right foot of the input are planted in the last frame, from that frame alone.
    pub fn contact_votes(&self) -> [f32; 2] {
        self.votes.now
    }

    /// The options.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// The shared model.
    pub fn model(&self) -> &Arc<Model> {
        &self.model
    }

    /// Data of the last input frame that its output needs; `None` before the first.
    pub(super) fn output_input(&self) -> Option<&OutputInput> {
        self.output_input.as_ref()
    }

    /// Predictions of the last frame, one per style.
    pub(super) fn predicted(&self) -> impl Iterator<Item = (usize, &Predicted)> {
        predicted(&self.styles)
    }

    pub(super) fn mixture(&self) -> &Mixture {
        &self.mixture
    }

    /// Internal state of the last frame's prediction, for [`super::Lens`].
    pub(super) fn inside(&self) -> Inside<'_> {
        Inside {
            mixture: &self.mixture,
            window: self.input.window(),
            voters: self.contacts.as_slice(),
            feet: self.input.feet(),
            input: self.input.last_row(),
            blend: &self.blend,
        }
    }

    /// Runs all stages except contact smoothing and footplant. Uses `found`, the earlier search results for this frame
    /// and these options, in place of a search.
    pub(super) fn predict_frame(
        &mut self,
        pose: &Pose,
        found: Option<&FoundFrame<'_>>,
        clock: &mut impl StageClock,
    ) -> &StyledFrame {
        clock.start();
        if self.styles.is_empty() {
            self.activate_styles();
        }
        let model = Arc::clone(&self.model);
        let input = self.take_input(pose);
        clock.end(Stage::Features);

        match found {
            Some(found) => self.mixture.adopt(&self.options, found),
            None => self.mixture.search(&model, &self.options, self.input.window()),
        }
        self.mixture.weigh(&model, &self.options);
        clock.end(Stage::Search);

        let of_input = Input { current: &input.row, previous: &input.previous };
        self.mixture.predict(&model, &self.options, of_input, &mut self.styles);
        clock.end(Stage::Regression);
        self.mixture.predict_durations_and_contacts(&model, &self.options, of_input, &mut self.styles);
        clock.end(Stage::Timing);

        self.replace_unusable(&input.row);
        let output_input = self.output_input.insert(OutputInput::new(&input.row, input.at, input.previous_at));
        self.output.place(&self.blend, output_input, predicted(&self.styles), self.options.timing);
        for s in &mut self.styles {
            s.previous = s.now.row;
        }
        clock.end(Stage::Blend);

        match found {
            Some(found) => self.contacts.assign(found.voters()),
            None => self.mixture.search_contacts(&model, self.input.window(), VOTERS, &mut self.contacts),
        }
        self.votes = vote(model.catalogue(), self.contacts.as_slice(), self.input.feet());
        self.output.take_contacts(&self.blend, self.votes.now, predicted(&self.styles));
        clock.end(Stage::Contact);
        &self.output.frame
    }

    /// Likelihood that the feet of the input were planted in the frame before the last, now that the last is known.
    pub(super) fn contact_before(&self) -> [f32; 2] {
        self.votes.before
    }

    /// Reads the input frame. A cut restarts the stream.
    fn take_input(&mut self, pose: &Pose) -> InputFrame {
        let input = self.input.push(self.model.catalogue(), pose);
        if input.cut {
            self.forget_input();
        }
        self.output.frame.repaired = input.repaired;
        self.output.frame.repaired_total += u32::from(input.repaired);
        input
    }

    /// Replaces predictions that are not finite, or that have no neighbours, by the input.
    fn replace_unusable(&mut self, input: &PoseRow) {
        let frame_secs = self.output.frame_secs();
        for s in &mut self.styles {
            let Predicted { row, step_secs, contact } = &s.now;
            let finite = row.iter().chain(contact).chain([step_secs]).all(|v| v.is_finite());
            if !finite || !self.mixture.found_any() {
                s.now = Predicted { row: *input, step_secs: frame_secs, contact: [0.0; 2] };
            }
            s.started = true;
        }
    }

    /// Discards the predictions from the input so far, but keeps the placement of the output.
    fn forget_input(&mut self) {
        self.mixture.forget_input();
        self.styles.iter_mut().for_each(|s| s.started = false);
    }

    /// Keeps a prediction for each style that has a weight. Other styles lose theirs and start again later.
    fn activate_styles(&mut self) {
        let blend = &self.blend;
        self.styles.retain(|s| blend.is_active(s.style));
        for style in 0..self.model.catalogue().styles.len() {
            if blend.is_active(style) && self.styles.iter().all(|s| s.style != style) {
                let at = self.styles.partition_point(|s| s.style < style);
                self.styles.insert(at, self.mixture.prediction_of(&self.model, &self.options, style));
            }
        }
    }
}

/// Predictions, one per style.
fn predicted(styles: &[StylePrediction]) -> impl Iterator<Item = (usize, &Predicted)> + Clone {
    styles.iter().map(|s| (s.style, &s.now))
}

/// Parts of a [`Stylizer`] from which its last frame was computed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inside<'a> {
    pub(super) mixture: &'a Mixture,
    pub(super) window: &'a QueryWindow,
    /// Neighbours that vote for the contacts.
    pub(super) voters: &'a [Neighbour],
    pub(super) feet: &'a RecentFeet,
    /// xₜ; `None` before the first frame.
    pub(super) input: Option<&'a PoseRow>,
    pub(super) blend: &'a StyleBlend,
}

#[cfg(test)]
mod tests;
