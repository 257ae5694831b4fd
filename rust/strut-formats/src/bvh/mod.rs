//! Biovision hierarchy (BVH): the motion capture text format, read within limits and written losslessly.
//!
//! A file lists joints (`HIERARCHY`), each with an offset from its parent and the channels that move it, then one line
//! of channel values for each frame (`MOTION`). There is no standard; this module reads the files of capture software
//! and published data sets:
//!
//! - keywords in any case, `End Site` or `End site`, any indentation, LF, CR LF or CR, a byte order mark;
//! - any number and order of channels on any joint, up to [`MAX_CHANNELS_PER_JOINT`]. Rotations apply in
//!   the order listed: `Zrotation Xrotation Yrotation` is Rz·Rx·Ry. Position channels are the joint's
//!   translation in its parent's frame and replace `OFFSET` on their axis;
//! - names with spaces: a name is the rest of its line, except for a brace at its end or before `OFFSET`;
//! - a hierarchy, or all of a file, on one line.
//!
//! Deviations of other programs are read with a note ([`parse_noted`], `docs/reading.md`): a number of frames that
//! differs from the announced one, rows that are not one per line, text after the frames, other spellings of end sites,
//! position channels that are added to `OFFSET`, UTF-16, and names that are not in UTF-8.
//!
//! Everything else is rejected with a [`BvhError`] that names the position and the expected content. Lengths stay in
//! the file's own unit, angles in degrees.

mod any_skeleton;
mod encoding;
mod error;
mod euler;
mod far;
mod humanoid;
mod motion;
mod number;
mod parse;
mod write;

pub use error::BvhError;
#[cfg(feature = "vmc")]
pub(crate) use humanoid::NAMES as HUMANOID_NAMES;
pub use parse::{parse, parse_hierarchy, parse_noted};
pub use write::{write, write_text};

/// Greatest size of a file, bytes: 256 MiB.
pub const MAX_BYTES: usize = 256 << 20;
/// Greatest number of joints of a skeleton.
pub const MAX_JOINTS: usize = strut_core::skeleton::MAX_JOINTS;
/// Greatest number of channels of a joint.
pub const MAX_CHANNELS_PER_JOINT: usize = 12;
/// Greatest number of frames of a file: over two hours at 120 Hz.
pub const MAX_FRAMES: usize = 1_000_000;
/// Greatest number of joints times frames of a file. With joints without channels, a short text could otherwise need
/// more memory than there is.
pub const MAX_TRANSFORMS: usize = 1 << 26;
/// Greatest length of a joint's name, bytes.
pub const MAX_NAME_BYTES: usize = 256;
/// Largest magnitude of an offset or a channel value, in the file's length unit or degrees. Single
/// precision is too coarse for motion beyond it.
pub const MAX_ABS_VALUE: f64 = 1e7;
/// Shortest and longest time from one frame to the next, seconds.
pub const FRAME_TIME_SECS: std::ops::RangeInclusive<f64> = 1e-4..=10.0;

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Axis {
    X,
    Y,
    Z,
}

/// A channel: the quantity that a value of a frame sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Translation along an axis of the parent's frame, in the file's length unit.
    Position(Axis),
    /// Rotation about an axis, degrees.
    Rotation(Axis),
}

impl Channel {
    /// All channels with their spelling in files.
    const NAMES: [(Channel, &'static str); 6] = [
        (Channel::Position(Axis::X), "Xposition"),
        (Channel::Position(Axis::Y), "Yposition"),
        (Channel::Position(Axis::Z), "Zposition"),
        (Channel::Rotation(Axis::X), "Xrotation"),
        (Channel::Rotation(Axis::Y), "Yrotation"),
        (Channel::Rotation(Axis::Z), "Zrotation"),
    ];

    /// Spelling in files, `Xposition` for example.
    pub fn name(self) -> &'static str {
        Self::NAMES[match self {
            Channel::Position(axis) => axis as usize,
            Channel::Rotation(axis) => 3 + axis as usize,
        }]
        .1
    }

    /// Channel of this name, in any case.
    fn from_name(name: &[u8]) -> Option<Self> {
        Self::NAMES.iter().find(|(_, n)| name.eq_ignore_ascii_case(n.as_bytes())).map(|(c, _)| *c)
    }
}

/// One joint of a [`Bvh`].
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Name as in the file; not necessarily unique.
    pub name: String,
    /// Bytes of the name in the file if they are not UTF-8; `name` is then the displayed form.
    pub name_bytes: Option<Vec<u8>>,
    /// Index of the parent, smaller than the joint's own; `None` only for joint 0.
    pub parent: Option<usize>,
    /// `OFFSET`: position in the parent's frame on axes without a position channel, in the file's length unit.
    pub offset: [f64; 3],
    /// Channels in file order; no position channel occurs twice.
    pub channels: Vec<Channel>,
    /// `OFFSET` of the `End Site`, if there is one.
    pub end_site: Option<[f64; 3]>,
}

/// A file: hierarchy and frames.
#[derive(Clone, Debug, PartialEq)]
pub struct Bvh {
    /// Joints in file order: parents first, joint 0 the only root, every subtree contiguous.
    pub joints: Vec<Joint>,
    /// Whether position channels of joints below the root are added to `OFFSET` instead of replacing it.
    pub added_positions: bool,
    /// Seconds from one frame to the next, within [`FRAME_TIME_SECS`].
    pub frame_time_secs: f64,
    /// Number of frames, at least 1.
    pub frames: usize,
    /// `frames` rows of [`Bvh::channels`] values, joint by joint in file order.
    pub values: Vec<f64>,
}

impl Bvh {
    /// Values of a frame, at least 1.
    pub fn channels(&self) -> usize {
        self.joints.iter().map(|j| j.channels.len()).sum()
    }

    /// Values of frame `f`.
    ///
    /// # Panics
    /// If `f` is not below `frames`.
    pub fn row(&self, f: usize) -> &[f64] {
        let n = self.channels();
        &self.values[f * n..(f + 1) * n]
    }
}
