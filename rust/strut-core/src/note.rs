//! Notes: what was guessed of a file, repaired or left in doubt, for the person whose file it is.
//!
//! A file that is as clean as those of the published data sets gets none. Each note has a code, which programs
//! compare, and a sentence, which people read. `docs/reading.md` lists the codes.

use std::borrow::Cow;

/// Declares the codes with their spelling.
macro_rules! note_codes {
    ($($(#[doc = $doc:literal])+ $code:ident = $name:literal,)+) => {
        /// What a note is about.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum NoteCode {
            $($(#[doc = $doc])+ $code,)+
        }

        impl NoteCode {
            /// All codes.
            pub const ALL: &[NoteCode] = &[$(NoteCode::$code,)+];

            /// Spelling in files and in other languages.
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
    /// No foot rests in the clip, so that its floor is unknown.
    NoFloor = "no-floor",
    /// Feet rest at heights that differ by more than a step.
    FloorChanges = "floor-changes",
    /// The motion jumps to another place or pose.
    Cut = "cut",
    /// The clip begins with a calibration pose, which is kept as it was.
    CalibrationPose = "calibration-pose",
    /// Frames or joints were unusable and were replaced.
    Repaired = "repaired",
    /// Up is not +Y in the file.
    Up = "up",
    /// Which way is up could not be decided.
    UpUnsure = "up-unsure",
    /// The file is a mirror image: what it calls left is on the right.
    Mirrored = "mirrored",
    /// The body is hardly that of a human.
    NotHuman = "not-human",
    /// The file announces another number of frames than it has.
    FrameCount = "frame-count",
    /// The numbers of the frames are not one frame a line.
    Rows = "rows",
    /// There is text after the frames.
    TextAfter = "text-after",
    /// The hierarchy has joints or end sites that are written in an unusual way.
    Hierarchy = "hierarchy",
    /// Text that is not UTF-8.
    Encoding = "encoding",
    /// The frame time was taken as milliseconds.
    Milliseconds = "milliseconds",
    /// Position channels were taken as added to the offsets.
    AddedPositions = "added-positions",
    /// The body is far from the origin of the file.
    Far = "far",
    /// Joints were found by the shape of the skeleton, not by their names.
    JointsByShape = "joints-by-shape",
    /// The motion is unlike all of the database.
    Unfamiliar = "unfamiliar",
    /// The styled motion travels much farther, or less far, than the input.
    Travel = "travel",
}

/// A sentence for the person whose file it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// What it is about.
    pub code: NoteCode,
    /// The sentence.
    pub text: Cow<'static, str>,
}

impl Note {
    /// A note of this code and sentence.
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
