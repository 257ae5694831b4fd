//! Notes for the user: guesses, repairs and doubts about a file.
//!
//! A file that is as clean as those of the published data sets has none. Each note has a code for programs and a sentence for
//! people. `docs/reading.md` lists the codes.

use std::borrow::Cow;

/// Declares the codes with their names.
macro_rules! note_codes {
    ($($(#[doc = $doc:literal])+ $code:ident = $name:literal,)+) => {
        /// Subject of a note.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum NoteCode {
            $($(#[doc = $doc])+ $code,)+
        }

        impl NoteCode {
            /// All codes.
            pub const ALL: &[NoteCode] = &[$(NoteCode::$code,)+];

            /// Name in files and in other languages.
            pub const fn name(self) -> &'static str {
                match self {
                    $(NoteCode::$code => $name,)+
                }
            }
        }
    };
}

note_codes! {
    /// The floor is not at height 0 of the file.
    Floor = "floor",
    /// No foot rests in the clip, so its floor is unknown.
    NoFloor = "no-floor",
    /// Feet rest at heights that differ by more than a step.
    FloorChanges = "floor-changes",
    /// The motion jumps to another place or pose.
    Cut = "cut",
    /// The clip begins with a calibration pose, which is kept.
    CalibrationPose = "calibration-pose",
    /// Frames or joints were unusable and were replaced.
    Repaired = "repaired",
    /// Up is not +Y in the file.
    Up = "up",
    /// The up axis could not be determined.
    UpUnsure = "up-unsure",
    /// The file is a mirror image: joints named left are on the right.
    Mirrored = "mirrored",
    /// The body is probably not human.
    NotHuman = "not-human",
    /// The file declares another number of frames than it contains.
    FrameCount = "frame-count",
    /// The frames are not written as one frame per line.
    Rows = "rows",
    /// There is text after the frames.
    TextAfter = "text-after",
    /// The hierarchy has joints or end sites in an unusual notation.
    Hierarchy = "hierarchy",
    /// The text is not UTF-8.
    Encoding = "encoding",
    /// The frame time was interpreted as milliseconds.
    Milliseconds = "milliseconds",
    /// Position channels were interpreted as added to the offsets.
    AddedPositions = "added-positions",
    /// The body is far from the origin of the file.
    Far = "far",
    /// Joints were found by the shape of the skeleton, not by their names.
    JointsByShape = "joints-by-shape",
    /// The motion resembles nothing in the database.
    Unfamiliar = "unfamiliar",
    /// The styled motion travels much farther than the input, or much less far.
    Travel = "travel",
}

/// A note for the user about a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Its subject.
    pub code: NoteCode,
    /// The sentence.
    pub text: Cow<'static, str>,
}

impl Note {
    /// Creates a note.
    pub fn new(code: NoteCode, text: impl Into<Cow<'static, str>>) -> Self {
        Self { code, text: text.into() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_spelt_differently() {
        let mut names: Vec<&str> = NoteCode::ALL.iter().map(|code| code.name()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), NoteCode::ALL.len());
    }
}
