//! Travel of an input and of its styled motion over the ground.
//!
//! Styles lengthen and shorten steps. If a styled motion stays in place where its input walked away, or the reverse,
//! the feet were read incorrectly or slide in the input, as on a treadmill.

use crate::humanoid::Pose;
use crate::math::Vec3;
use crate::note::{Note, NoteCode};

/// A path is measured between positions at this interval, seconds, so that the sway of the hips within a step does not
/// count.
const STEP_SECS: f32 = 0.5;

/// A note is added if the ratio of output to input path is outside this range and the paths also differ by this many
/// metres.
const USUAL: std::ops::RangeInclusive<f32> = 0.35..=2.5;
const NOTED_METRES: f32 = 1.0;

/// Length of a path over the ground, added up frame by frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct PathLength {
    metres: f32,
    frames: usize,
    from: Vec3,
}

impl PathLength {
    /// Adds the next frame. The distance across a cut does not count.
    pub(super) fn add(&mut self, pose: &Pose, rate_hz: f32, is_cut: bool) {
        let step = (STEP_SECS * rate_hz).round().max(1.0) as usize;
        if is_cut {
            self.frames = 0;
        }
        if self.frames.is_multiple_of(step) {
            if self.frames > 0 {
                self.metres += ((pose.root - self.from) * Vec3::new(1.0, 0.0, 1.0)).length();
            }
            self.from = pose.root;
        }
        self.frames += 1;
    }

    /// Length so far, metres.
    pub(super) fn metres(&self) -> f32 {
        self.metres
    }
}

/// Note for a styled motion whose travel differs from its input's, metres.
pub(super) fn travel_note(input: f32, output: f32) -> Option<Note> {
    let is_usual = USUAL.contains(&(output / input.max(f32::MIN_POSITIVE)));
    (!is_usual && (output - input).abs() > NOTED_METRES).then(|| {
        let text = format!("The styled motion travels {output:.1} m where the input travels {input:.1} m");
        Note::new(NoteCode::Travel, text + ": its feet may slide, or its floor may be elsewhere.")
    })
}
