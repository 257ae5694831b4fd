//! Searches a clip's frames separately from styling. The search depends on the poses, the classes and K, not on the
//! styles or on the output of earlier frames. So portions of a clip can be searched at any time and in parallel.
//!
//! The result for a frame does not depend on the history either, though the search of a stream uses the history to be
//! faster. The last frame's distances order the classes, and a class that had no weight is skipped if its distance
//! certainly exceeds [`greatest_distance`](super::class_weights::greatest_distance) of the smallest distance so far. That
//! bound grows with the smallest distance, so that the class has no weight by its true distance either; nor can it be
//! the nearest class, relative to which the others are weighted.

use super::clip_input::ClipInput;
use super::contact_likelihood::VOTERS;
use super::found::Found;
use super::input_stream::InputStream;
use super::mar::Mixture;
use super::model::Model;
use super::options::Options;
use super::stylizer::Stylizer;
use crate::humanoid::Pose;
use crate::search::Neighbours;
use std::sync::Arc;

/// Frames of a portion. The first frame of each is searched without a previous frame, which takes about twice as long.
const PORTION: usize = 64;

/// A clip whose portions can be searched independently. The results are for [`ClipJob`](super::ClipJob)s of the same
/// stylizer.
#[derive(Clone, Debug)]
pub struct ClipSearch<'a> {
    model: Arc<Model>,
    options: Options,
    poses: &'a [Pose],
    /// Frames that follow a cut, ascending.
    cuts: &'a [usize],
    /// Frames of a portion; the last may have fewer.
    length: usize,
    /// State of the input stream before each portion.
    inputs: Vec<InputStream>,
    mixture: Mixture,
}

impl<'a> ClipSearch<'a> {
    /// Search of a clip at the database's rate, with a stylizer's options.
    pub fn new(stylizer: &Stylizer, poses: &'a [Pose]) -> Self {
        Self::in_portions(stylizer, poses, &[], PORTION)
    }

    /// Search of a clip whose cuts are known.
    pub fn of_input(stylizer: &Stylizer, input: &'a ClipInput) -> Self {
        Self::in_portions(stylizer, &input.motion.poses, &input.cuts, PORTION)
    }

    /// Search in portions of `length` frames, at least 1.
    fn in_portions(stylizer: &Stylizer, poses: &'a [Pose], cuts: &'a [usize], length: usize) -> Self {
        let model = Arc::clone(stylizer.model());
        let mut input = InputStream::new(model.index().window_length());
        let inputs = poses.chunks(length).enumerate().map(|(portion, poses)| {
            let before = input.clone();
            for (frame, pose) in (portion * length..).zip(poses) {
                if cuts.binary_search(&frame).is_ok() {
                    input.reset();
                }
                input.push(model.catalogue(), pose);
            }
            before
        });
        let inputs = inputs.collect();
        Self { options: *stylizer.options(), mixture: stylizer.mixture().clone(), model, poses, cuts, length, inputs }
    }

    /// Number of portions.
    pub fn portions(&self) -> usize {
        self.inputs.len()
    }

    /// The poses of a portion.
    ///
    /// # Panics
    /// If the portion does not exist.
    pub fn poses(&self, portion: usize) -> &'a [Pose] {
        let first = portion * self.length;
        &self.poses[first..self.poses.len().min(first + self.length)]
    }

    /// Searches a portion.
    ///
    /// # Panics
    /// If the portion does not exist.
    pub fn find(&self, portion: usize) -> Found {
        let Self { model, options, .. } = self;
        let (mut input, mut mixture) = (self.inputs[portion].clone(), self.mixture.clone());
        let (mut found, mut voters) = (Found::default(), Neighbours::with_capacity(VOTERS));
        for (frame, pose) in (portion * self.length..).zip(self.poses(portion)) {
            if self.cuts.binary_search(&frame).is_ok() {
                input.reset();
                mixture.forget_input();
            }
            input.push(model.catalogue(), pose);
            mixture.search(model, options, input.window());
            mixture.weigh(model, options);
            mixture.search_contacts(model, input.window(), VOTERS, &mut voters);
            found.add(mixture.weighted_neighbours(), voters.as_slice());
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{BENT, Gait, NEUTRAL, database, walk};
    use crate::transfer::{ClipJob, Method, NoClock, StyledMotion};
    use proptest::prelude::*;
    use std::sync::OnceLock;

    fn stylizer(options: Options) -> Stylizer {
        static MODEL: OnceLock<Arc<Model>> = OnceLock::new();
        let model = MODEL.get_or_init(|| Arc::new(Model::new(database())));
        let mut stylizer = Stylizer::new(Arc::clone(model), options).unwrap();
        stylizer.set_styles(&[0.2, 0.8]).unwrap();
        stylizer
    }

    /// A neutral walk that becomes a bent one, with the faults of real input: invalid poses and a cut.
    fn poses(period: f32) -> Vec<Pose> {
        let parts = [Gait { period, ..NEUTRAL }, BENT, Gait { arms: 0.7, turn: 0.4, ..NEUTRAL }];
        let mut poses: Vec<Pose> = parts.iter().flat_map(|gait| walk(gait, 30, 0.3).poses).collect();
        poses[17].root.y = f32::NAN;
        poses[62].rotations[5].x = f32::INFINITY;
        poses[70..].iter_mut().for_each(|pose| pose.root.x += 100.0);
        poses
    }

    /// Output of a job and the traces of its frames.
    fn styled(mut job: ClipJob, mut push: impl FnMut(&mut ClipJob, &mut Vec<String>)) -> (StyledMotion, Vec<String>) {
        let mut traces = Vec::new();
        push(&mut job, &mut traces);
        (job.finish(), traces)
    }

    fn in_one(options: Options, poses: &[Pose]) -> (StyledMotion, Vec<String>) {
        styled(ClipJob::new(stylizer(options)), |job, traces| {
            traces.extend(poses.iter().map(|pose| shown(&job.push(pose, &mut NoClock))));
        })
    }

    /// Searches the portions in reverse order.
    fn in_portions(options: Options, poses: &[Pose], length: usize) -> (StyledMotion, Vec<String>) {
        let stylizer = stylizer(options);
        let search = ClipSearch::in_portions(&stylizer, poses, &[], length);
        let mut found: Vec<Found> = (0..search.portions()).rev().map(|portion| search.find(portion)).collect();
        found.reverse();
        styled(ClipJob::new(stylizer), |job, traces| {
            for (portion, found) in found.iter().enumerate() {
                let frames = search.poses(portion).iter().zip(found.frames());
                traces.extend(frames.map(|(pose, found)| shown(&job.push_found(pose, &found))));
            }
        })
    }

    fn shown(trace: &crate::transfer::Trace<'_>) -> String {
        let bits = |values: &[f32]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        let weights = [bits(trace.class_weights), bits(trace.neighbour_weights)];
        format!("{weights:?} {:?} {}", trace.neighbours, trace.bias.to_bits())
    }

    /// Bits of the motion; `assert_eq!` would treat 0 and −0 as equal.
    fn bits(motion: &StyledMotion) -> Vec<u64> {
        let floats = |f: &crate::transfer::StyledFrame| {
            let pose = f.pose.rotations.iter().flat_map(|r| r.to_array()).chain(f.pose.root.to_array());
            let rest = [f.dt_secs].into_iter().chain(f.contact).chain(f.contact_out);
            let bits: Vec<u64> = pose.chain(rest).map(|v| v.to_bits().into()).collect();
            bits.into_iter().chain([f.time_out_secs.to_bits(), f.repaired_total.into()])
        };
        motion.frames.iter().flat_map(floats).collect()
    }

    fn assert_same(options: Options, poses: &[Pose], length: usize) {
        let (serial, portions) = (in_one(options, poses), in_portions(options, poses, length));
        assert_eq!(serial.0, portions.0, "{options:?} in portions of {length}");
        assert!(bits(&serial.0) == bits(&portions.0), "{options:?} in portions of {length}");
        assert!(serial.1 == portions.1, "{options:?} in portions of {length}: the traces differ");
    }

    #[test]
    fn frames_found_in_portions_are_styled_as_in_one_by_every_method() {
        let poses = poses(60.0);
        for method in [Method::Mar, Method::LocalAr, Method::NearestNeighbour, Method::Knn] {
            assert_same(Options { method, ..Options::DEFAULT }, &poses, 16);
        }
    }

    #[test]
    fn labels_and_the_settings_of_the_mixture_change_nothing_about_it() {
        let poses = poses(66.0);
        let labelled = Options { action: Some(0), input_style: Some(1), ..Options::DEFAULT };
        for options in [
            labelled,
            Options { input_style: None, ..labelled },
            Options { k: 3, coherence: false, ..Options::DEFAULT },
            Options { least_weight: 0.0, ..Options::DEFAULT },
            Options { delta: 3.0, timing: false, footplant: false, ..Options::DEFAULT },
        ] {
            assert_same(options, &poses, 25);
        }
        assert_same(Options::DEFAULT, &[], 7);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn neither_does_the_length_of_portions(period in 50.0f32..90.0, delta in 0.05f32..2.0, length in 1usize..100) {
            let options = Options { delta, ..Options::DEFAULT };
            assert_same(options, &poses(period), length);
        }
    }

    #[test]
    fn what_was_found_for_other_frames_is_not_ignored() {
        let poses = poses(60.0);
        let stylizer = stylizer(Options::DEFAULT);
        let found = ClipSearch::in_portions(&stylizer, &poses, &[], 90).find(0);
        let mut job = ClipJob::new(stylizer);
        for (pose, found) in poses.iter().zip(found.frames().skip(1)) {
            job.push_found(pose, &found);
        }
        assert!(
            job.frames()[..89].iter().zip(&in_one(Options::DEFAULT, &poses).0.frames).any(|(a, b)| a.pose != b.pose)
        );
    }
}
