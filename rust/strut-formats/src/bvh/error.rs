//! Errors of reading and writing, with line and column.

use super::{
    FRAME_TIME_SECS, MAX_ABS_VALUE, MAX_BYTES, MAX_CHANNELS_PER_JOINT, MAX_FRAMES, MAX_JOINTS, MAX_NAME_BYTES,
    MAX_TRANSFORMS,
};
use strut_core::motion::MotionError;
use strut_core::skeleton::SkeletonError;
use thiserror::Error;

/// Reason why bytes are not a BVH file, or a motion does not fit one. Lines and columns (in bytes) count from 1.
#[derive(Clone, Debug, PartialEq, Error)]
#[allow(missing_docs)]
pub enum BvhError {
    /// The file is larger than [`MAX_BYTES`].
    #[error("the file has {bytes} bytes; at most {MAX_BYTES} are supported")]
    TooManyBytes { bytes: usize },
    /// The file contains only white space.
    #[error("the file is empty; a BVH file begins with HIERARCHY")]
    Empty,
    /// The grammar does not allow a token.
    #[error("line {line}, column {column} has {found}; {expected} was expected")]
    Unexpected { line: usize, column: usize, found: String, expected: &'static str },
    /// There is a second `ROOT`.
    #[error("line {line} begins a second ROOT; one skeleton per file is supported")]
    SecondRoot { line: usize },
    /// There are more than [`MAX_JOINTS`] joints.
    #[error("line {line} begins joint {}; at most {MAX_JOINTS} are supported", MAX_JOINTS + 1)]
    TooManyJoints { line: usize },
    /// A joint has more than [`MAX_CHANNELS_PER_JOINT`] channels.
    #[error("line {line} declares {channels} channels; at most {MAX_CHANNELS_PER_JOINT} per joint are supported")]
    TooManyChannels { line: usize, channels: usize },
    /// A joint has a position channel twice.
    #[error("line {line} has {channel} twice on one joint; once was expected")]
    RepeatedPosition { line: usize, channel: &'static str },
    /// Numbers have commas in place of decimal points.
    #[error(
        "line {line}, column {column} has {found}, a decimal comma; decimal points were expected. Export the file \
         again with English number formatting"
    )]
    DecimalComma { line: usize, column: usize, found: String },
    /// A joint's name contains a tab, which most programs treat as the end of the name.
    #[error("line {line} has the joint name '{found}' with a tab in it; spaces or underscores were expected")]
    TabInName { line: usize, found: String },
    /// No joint has a channel.
    #[error("no joint has a channel; at least one was expected")]
    NoChannels,
    /// `Frames:` is 0 or above [`MAX_FRAMES`].
    #[error("line {line} declares {frames} frames; 1 to {MAX_FRAMES} were expected")]
    Frames { line: usize, frames: u64 },
    /// `Frame Time:` is outside [`FRAME_TIME_SECS`].
    #[error(
        "line {line} has a frame time of {secs} s; {} to {} s were expected",
        FRAME_TIME_SECS.start(),
        FRAME_TIME_SECS.end()
    )]
    FrameTime { line: usize, secs: f64 },
    /// A number is above [`MAX_ABS_VALUE`] or overflows.
    #[error("line {line}, column {column} has {found}; a number within ±{MAX_ABS_VALUE} was expected")]
    TooLarge { line: usize, column: usize, found: String },
    /// A frame has the wrong number of values.
    #[error("line {line} has {found} numbers; this skeleton needs {needed}")]
    FrameWidth { line: usize, found: usize, needed: usize },
    /// The file declares more frames than the rest of it could contain.
    #[error("the file declares {announced} frames; the rest of the file can hold at most {most}")]
    NoRoom { announced: usize, most: usize },
    /// The file ends before the first frame.
    #[error("the file ends at line {line} after {found} frames; {announced} were declared")]
    MissingFrames { line: usize, found: usize, announced: usize },
    /// The file contains more than [`MAX_FRAMES`] frames.
    #[error("line {line} comes after {MAX_FRAMES} frames; no more are supported, but {announced} were declared")]
    ExtraFrames { line: usize, announced: usize },
    /// Frames times joints exceeds [`MAX_TRANSFORMS`].
    #[error(
        "the file has {frames} frames of {joints} joints; at most {MAX_TRANSFORMS} joints in all frames are supported"
    )]
    TooManyTransforms { frames: usize, joints: usize },
    /// The hierarchy is not a valid skeleton.
    #[error(transparent)]
    Skeleton(#[from] SkeletonError),
    /// The frames are not a valid motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The motion has another hierarchy.
    #[error("the motion has {found} joints; this file has {needed}")]
    JointCount { found: usize, needed: usize },
    /// The motion has no frames, more than [`MAX_FRAMES`], or more than [`MAX_TRANSFORMS`] joints in all of them.
    #[error(
        "the motion has {frames} frames of {joints} joints; 1 to {MAX_FRAMES} frames, and at most {MAX_TRANSFORMS} joints in all \
         of them, can be written"
    )]
    UnwritableFrames { frames: usize, joints: usize },
    /// The motion's frame time is outside [`FRAME_TIME_SECS`].
    #[error(
        "the motion has a frame time of {secs} s; {} to {} s were expected",
        FRAME_TIME_SECS.start(),
        FRAME_TIME_SECS.end()
    )]
    UnwritableFrameTime { secs: f64 },
    /// A joint's name or offset could not be read back from a file.
    #[error(
        "the joint {joint:?} cannot be written; a name of at most {MAX_NAME_BYTES} bytes on one line, without tabs \
         and without spaces or braces at its ends, and offsets within ±{MAX_ABS_VALUE} were expected"
    )]
    UnwritableJoint { joint: String },
    /// A value of the motion could not be read back from a file.
    #[error(
        "frame {frame} of the motion moves joint '{joint}' by {value}; a number within ±{MAX_ABS_VALUE} was expected"
    )]
    Unwritable { frame: usize, joint: String, value: f64 },
}
