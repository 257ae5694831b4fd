//! Many characters that perform the same input in different styles.
//!
//! The prediction for a style does not depend on the weights of the styles, so that it is computed once for each style
//! and input frame ([`Recorder`]). A [`Performer`] only blends, decodes and plants feet. Its output has the same bits
//! as that of a [`Stylizer`] whose weights are constant. The input is looped: its last frames fade into its first ones.

mod floats;

pub use floats::PredictionsError;

use super::blend::{StyleBlend, StyleError};
use super::body_part::BodyPart;
use super::frame::StyledFrame;
use super::output::{Output, OutputInput, Predicted};
use super::stylizer::Stylizer;
use crate::humanoid::{Pose, Proportions};
use crate::pose_vector::{Placement, PoseChart, PoseRow};
use std::sync::Arc;

/// Frames over which the end of the input fades into its start: 0.2 s at 60 Hz.
pub const FADE_FRAMES: usize = 12;

/// Predictions for every frame of an input in every style of a database, and the other data that the outputs need.
#[derive(Clone, Debug)]
pub struct Predictions {
    chart: PoseChart,
    proportions: Proportions,
    rate_hz: f32,
    observed_range: Box<[PoseRow; 2]>,
    neutral: usize,
    styles: usize,
    timing: bool,
    footplant: bool,
    /// Of each frame, with the likelihoods that the input's feet are planted.
    output_inputs: Vec<(OutputInput, [f32; 2])>,
    /// Per frame, of every style.
    predicted: Vec<Predicted>,
}

impl Predictions {
    /// Number of frames of the input.
    pub fn frames(&self) -> usize {
        self.output_inputs.len()
    }

    /// Number of frames of one loop.
    pub fn period(&self) -> usize {
        self.frames() - FADE_FRAMES
    }

    /// Number of styles of the database.
    pub fn styles(&self) -> usize {
        self.styles
    }

    /// Bone offsets of the poses.
    pub fn proportions(&self) -> &Proportions {
        &self.proportions
    }

    /// Predictions of a frame, one per style.
    fn of_frame(&self, frame: usize) -> &[Predicted] {
        &self.predicted[frame * self.styles..][..self.styles]
    }
}

/// Predicts a clip in every style of a database, frame by frame.
#[derive(Clone, Debug)]
pub struct Recorder {
    stylizer: Stylizer,
    predictions: Predictions,
}

impl Recorder {
    /// Starts with the options of a stylizer, whose own stream is not changed.
    pub fn new(stylizer: &Stylizer) -> Self {
        let mut stylizer = stylizer.clone();
        let db = stylizer.model().catalogue();
        let styles = db.styles.len();
        let predictions = Predictions {
            chart: db.chart,
            proportions: db.proportions,
            rate_hz: db.rate_hz,
            observed_range: Box::new(*db.observed_range()),
            neutral: db.neutral.into(),
            styles,
            timing: stylizer.options().timing,
            footplant: stylizer.options().footplant,
            output_inputs: Vec::new(),
            predicted: Vec::new(),
        };
        // Every style has a weight, so that each is predicted. One finite weight per style is always accepted.
        let _ = stylizer.set_styles(&vec![1.0 / styles as f32; styles]);
        for part in BodyPart::ALL {
            let _ = stylizer.set_part_styles(part, None);
        }
        stylizer.reset(None);
        Self { stylizer, predictions }
    }

    /// Number of frames so far.
    pub fn frames(&self) -> usize {
        self.predictions.frames()
    }

    /// Adds the next frame: a pose on the database's proportions and at its rate.
    pub fn push(&mut self, pose: &Pose) {
        self.stylizer.push(pose);
        if let Some(output_input) = self.stylizer.output_input() {
            self.predictions.output_inputs.push((*output_input, self.stylizer.contact_votes()));
            self.predictions.predicted.extend(self.stylizer.predicted().map(|(_, of)| *of));
        }
    }

    /// Predictions so far; `None` where [`Recorder::finish`] returns `None`.
    pub fn predictions(&self) -> Option<&Predictions> {
        (self.predictions.frames() >= 2 * FADE_FRAMES).then_some(&self.predictions)
    }

    /// Ends the input. Returns `None` if the input has fewer than twice [`FADE_FRAMES`] frames, too few for a loop.
    pub fn finish(self) -> Option<Predictions> {
        (self.predictions.frames() >= 2 * FADE_FRAMES).then_some(self.predictions)
    }
}

/// A character that performs the input in a loop. Call [`Performer::advance`] for each frame of the input.
#[derive(Clone, Debug)]
pub struct Performer {
    predictions: Arc<Predictions>,
    blend: StyleBlend,
    output: Output,
    /// Next frame, and whether the input has been looped.
    next: usize,
    begun_anew: bool,
    /// Predictions of the next frame, where the end fades into the start.
    faded: Vec<Predicted>,
}

impl Performer {
    /// Starts at the first frame of the input, in the neutral style. The output starts at `placement`, or else at the
    /// input's.
    pub fn new(predictions: Arc<Predictions>, placement: Option<Placement>) -> Self {
        let of = &*predictions;
        let mut output = Output::new(&of.chart, &of.proportions, of.rate_hz, &of.observed_range);
        output.reset(placement);
        Self {
            blend: StyleBlend::new(of.styles, of.neutral),
            output,
            next: 0,
            begun_anew: false,
            faded: Vec::with_capacity(of.styles),
            predictions,
        }
    }

    /// Sets the start frame, modulo the period. Call it before the first `advance`.
    pub fn begin_at(&mut self, frame: usize) {
        self.next = frame % self.predictions.period();
    }

    /// Sets one weight for each style of the database. The neutral style receives the remainder to a sum of 1.
    ///
    /// # Errors
    /// If the number of weights is wrong or one is not finite; the previous weights are then kept.
    pub fn set_styles(&mut self, weights: &[f32]) -> Result<(), StyleError> {
        self.blend.set_whole(weights)
    }

    /// Advances by one frame of the input. Allocates nothing.
    pub fn advance(&mut self) -> &StyledFrame {
        let Self { predictions, blend, output, next, begun_anew, faded } = self;
        let (mut output_input, mut contact) = predictions.output_inputs[*next];
        let mut predicted = predictions.of_frame(*next);
        if *begun_anew && *next < FADE_FRAMES {
            let ending = predictions.period() + *next;
            let share = (*next + 1) as f32 / (FADE_FRAMES + 1) as f32;
            let (old, old_contact) = &predictions.output_inputs[ending];
            mix(&old.row, share, &mut output_input.row);
            output_input.turn = old.turn + share * (output_input.turn - old.turn);
            mix(old_contact, share, &mut contact);
            faded.clear();
            faded.extend(predicted.iter().zip(predictions.of_frame(ending)).map(|(new, old)| {
                let mut of = *new;
                mix(&old.row, share, &mut of.row);
                mix(&old.contact, share, &mut of.contact);
                of.step_secs = old.step_secs + share * (new.step_secs - old.step_secs);
                of
            }));
            predicted = faded;
        }
        // Only styles that have weights, as in a stylizer.
        let active = predicted.iter().enumerate().filter(|(style, _)| blend.is_active(*style));
        output.place(blend, &output_input, active.clone(), predictions.timing);
        output.take_contacts(blend, contact, active);
        output.plant(predictions.footplant);
        *next += 1;
        if *next == predictions.period() {
            (*next, *begun_anew) = (0, true);
        }
        &output.frame
    }

    /// The last frame.
    pub fn frame(&self) -> &StyledFrame {
        &self.output.frame
    }

    /// Heading in the last frame, radians about +Y; 0 before the first.
    pub fn heading(&self) -> f32 {
        self.output.heading()
    }
}

/// Linear interpolation from the old numbers to the new ones, written to `new`.
fn mix(old: &[f32], share: f32, new: &mut [f32]) {
    for (new, old) in new.iter_mut().zip(old) {
        *new = old + share * (*new - old);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{Gait, NEUTRAL, database, walk};
    use crate::humanoid::{JOINTS, Role};
    use crate::kinematics::world_from_local;
    use crate::pose_vector::ROW;
    use crate::transfer::{Model, Options};

    fn input() -> Vec<Pose> {
        walk(&Gait { period: 63.0, swing: 0.41, ..NEUTRAL }, 240, 0.15).poses
    }

    fn stylizer(options: Options) -> Stylizer {
        Stylizer::new(Arc::new(Model::new(database())), options).unwrap()
    }

    fn predictions(stylizer: &Stylizer, input: &[Pose]) -> Option<Arc<Predictions>> {
        let mut recorder = Recorder::new(stylizer);
        for pose in input {
            recorder.push(pose);
        }
        recorder.finish().map(Arc::new)
    }

    #[test]
    fn a_performer_gives_the_bits_of_a_stylizer_whose_weights_stay() {
        let input = input();
        for options in [Options::DEFAULT, Options { timing: false, footplant: false, ..Options::DEFAULT }] {
            let mut stylizer = stylizer(options);
            let predictions = predictions(&stylizer, &input).unwrap();
            // Between the styles, the neutral one alone, the other alone, and an extrapolation.
            for weight in [0.4, 0.0, 1.0, 1.5] {
                stylizer.reset(None);
                stylizer.set_styles(&[0.0, weight]).unwrap();
                let mut performer = Performer::new(Arc::clone(&predictions), None);
                performer.set_styles(&[0.0, weight]).unwrap();
                for (i, pose) in input[..predictions.period()].iter().enumerate() {
                    assert_eq!(performer.advance(), stylizer.push(pose), "frame {i} at {weight}");
                }
            }
        }
    }

    #[test]
    fn numbers_that_are_no_predictions_are_refused() {
        let numbers = predictions(&stylizer(Options::DEFAULT), &input()[..40]).unwrap().to_floats();
        assert!(Predictions::from_floats(&numbers).is_ok());
        let refuses = |change: &dyn Fn(&mut Vec<f32>)| {
            let mut numbers = numbers.clone();
            change(&mut numbers);
            Predictions::from_floats(&numbers).is_err()
        };
        // Reversed ranges, in one degree of freedom or in all.
        let range = 6 + 7 * JOINTS;
        let swings = range + 3 * Role::LeftUpperLeg.index();
        assert!(refuses(&|n| n.swap(swings, swings + ROW)));
        assert!(refuses(&|n| n[range..range + 2 * ROW].rotate_left(ROW)));
        // Means of the chart that are not rotations.
        assert!(refuses(&|n| n[6..10].fill(0.0)));
        assert!(refuses(&|n| n[6..10].iter_mut().for_each(|v| *v *= 2.0)));
        assert!(refuses(&|n| n[4] = f32::NAN) && refuses(&|n| n.truncate(n.len() - 1)) && refuses(&Vec::clear));
    }

    #[test]
    fn performers_begin_where_they_are_told_to() {
        let mut stylizer = stylizer(Options::DEFAULT);
        let predictions = predictions(&stylizer, &input()).unwrap();
        let start = Placement { x: 3.0, z: -2.0, heading: 1.0 };
        stylizer.reset(Some(start));
        let mut performer = Performer::new(predictions, Some(start));
        for pose in &input()[..100] {
            assert_eq!(performer.advance(), stylizer.push(pose));
        }
    }

    /// Largest displacement of a joint in each step between frames, metres.
    fn largest_steps(performer: &mut Performer, frames: usize) -> Vec<f32> {
        let proportions = *performer.predictions.proportions();
        let mut world = || world_from_local(&proportions, &performer.advance().pose).positions;
        let mut last = world();
        (1..frames)
            .map(|_| {
                let now = world();
                let moved = now.iter().zip(&last).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
                last = now;
                moved
            })
            .collect()
    }

    #[test]
    fn the_end_of_the_input_fades_into_its_beginning() {
        let stylizer = stylizer(Options::DEFAULT);
        // Three and a half cycles: at the end the legs are in the opposite phase.
        let predictions = predictions(&stylizer, &input()[..220]).unwrap();
        let period = predictions.period();
        let mut performer = Performer::new(predictions, None);
        performer.set_styles(&[0.0, 0.6]).unwrap();
        let steps = largest_steps(&mut performer, 3 * period);
        let largest = |frames: &[f32]| frames.iter().copied().fold(0.0, f32::max);
        let within = largest(&steps[FADE_FRAMES..period - 1]);
        // Legs that change sides within a fifth of a second swing faster than in a stride, but not as fast as in a
        // single frame.
        for begin in [period, 2 * period] {
            let fading = largest(&steps[begin - 1..begin + FADE_FRAMES]);
            assert!(fading < 2.5 * within, "{fading} m beside {within} m");
        }
        assert!(performer.frame().time_out_secs > 0.0);
    }

    #[test]
    fn weights_that_are_none_are_refused_and_an_input_that_is_too_short_ends_in_nothing() {
        let stylizer = stylizer(Options::DEFAULT);
        assert!(predictions(&stylizer, &input()[..2 * FADE_FRAMES - 1]).is_none());
        let shortest = predictions(&stylizer, &input()[..2 * FADE_FRAMES]).unwrap();
        let mut performer = Performer::new(shortest, None);
        assert!(performer.set_styles(&[f32::NAN, 0.0]).is_err() && performer.set_styles(&[1.0]).is_err());
        for _ in 0..5 * FADE_FRAMES {
            assert!(performer.advance().pose.root.is_finite());
        }
    }
}
