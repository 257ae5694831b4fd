//! Measures of any output that need no ground truth.

use super::off_database::compare;
use strut_core::contact;
use strut_core::humanoid::{HumanoidMotion, Role};
use strut_core::metrics::{foot_skate, mean_jerk};
use strut_core::transfer::{
    BodyPart, ClipJob, NoClock, PARTS, StyledFrame, StyledMotion, Stylizer, beyond_anatomy, ground_clearance,
};

/// Mode of styling a clip.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Mode {
    /// As a whole: contacts and footplant use future frames.
    #[default]
    Offline,
    /// Frame by frame, like a live input.
    Online,
}

/// A styled clip, before and after its feet are planted.
#[derive(Clone, Debug)]
pub struct Styled {
    /// Predictions of the mixture, one frame for each input frame.
    pub predicted: Vec<StyledFrame>,
    /// The finished clip.
    pub finished: StyledMotion,
    /// Finished clip at a constant frame rate, as it is written or displayed.
    pub output: HumanoidMotion,
}

/// Measures of one styled clip.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quality {
    /// Mean acceleration of the joints: ratio of prediction to input, frame by frame.
    pub acceleration_ratio: f64,
    /// Mean jerk of the joints in the world: ratio of finished output at a constant frame rate to input.
    pub jerk_ratio: f64,
    /// Correlation of the fast content of prediction and input: [`super::off_database::content_correlation`].
    pub content_correlation: f64,
    /// Mean joint distance between prediction and input, without heading and position, metres.
    pub distance: f64,
    /// Skate of the input while its own contact labels indicate a planted foot, m/s.
    pub skate_in: f64,
    /// Skate of the finished output at a constant frame rate while its own labels indicate a planted foot, m/s.
    pub skate_out: f64,
    /// Greatest depth of a sole of the finished output below the ground, metres; 0 if none is below.
    pub sole_depth: f64,
    /// Mean angle between prediction and input of the joints of each [`BodyPart`] except the hips, radians.
    pub turned: [f64; PARTS],
    /// Greatest angle by which a joint of the finished output exceeds the anatomical limits, minus that of the input
    /// itself, radians.
    pub beyond_anatomy: f64,
}

/// Styles a clip at the database's rate with the styles and options of a stylizer.
pub fn style(stylizer: &Stylizer, input: &HumanoidMotion, mode: Mode) -> Styled {
    let mut job = ClipJob::new(stylizer.clone());
    for pose in &input.poses {
        job.push(pose, &mut NoClock);
    }
    let predicted = job.frames().to_vec();
    match mode {
        Mode::Offline => {
            let finished = job.finish();
            let output = finished.on_body(&input.proportions, input.rate_hz).motion;
            Styled { predicted, finished, output }
        }
        Mode::Online => {
            let mut live = stylizer.clone();
            live.reset(None);
            let frames = input.poses.iter().map(|p| *live.push(p)).collect();
            let finished = StyledMotion::new(input.proportions, frames);
            let output = finished.resampled(input.rate_hz).motion;
            Styled { predicted, finished, output }
        }
    }
}

/// Measures a styled clip in comparison with its input.
pub fn quality(input: &HumanoidMotion, styled: &Styled) -> Quality {
    let motion = |frames: &[StyledFrame]| HumanoidMotion { poses: frames.iter().map(|f| f.pose).collect(), ..*input };
    let predicted = compare(input, &motion(&styled.predicted));
    let output = &styled.output;
    let skate = |m: &HumanoidMotion| f64::from(foot_skate(m, &contact::label(m)));
    let lowest = output.poses.iter().map(|p| ground_clearance(&output.proportions, p)).fold(0.0, f32::min);
    Quality {
        acceleration_ratio: predicted.acceleration_ratio.into(),
        jerk_ratio: f64::from(mean_jerk(output)) / f64::from(mean_jerk(input)).max(1e-9),
        content_correlation: predicted.correlation.into(),
        distance: predicted.distance.into(),
        skate_in: skate(input),
        skate_out: skate(output),
        sole_depth: f64::from(-lowest),
        turned: turned(input, &styled.predicted),
        beyond_anatomy: f64::from((most_beyond_anatomy(output) - most_beyond_anatomy(input)).max(0.0)),
    }
}

/// Mean angle between output and input of the joints of each part, radians.
fn turned(input: &HumanoidMotion, output: &[StyledFrame]) -> [f64; PARTS] {
    let (mut sum, mut count) = ([0.0; PARTS], [0_usize; PARTS]);
    for (before, after) in input.poses.iter().zip(output) {
        for role in Role::ALL.into_iter().filter(|&r| r != Role::Hips) {
            let (part, joint) = (BodyPart::of(role) as usize, role.index());
            sum[part] += f64::from(before.rotations[joint].inv_mul(after.pose.rotations[joint]).angle());
            count[part] += 1;
        }
    }
    std::array::from_fn(|part| sum[part] / count[part].max(1) as f64)
}

fn most_beyond_anatomy(motion: &HumanoidMotion) -> f32 {
    let joints = motion.poses.iter().flat_map(|p| Role::ALL.map(|r| beyond_anatomy(r, p.rotations[r.index()])));
    joints.fold(0.0, f32::max)
}
