//! Virtual Motion Capture: the messages by which motion capture programs and avatars exchange a body's bones, as Open
//! Sound Control 1.0 over UDP (`docs/live.md`).
//!
//! Bytes ↔ [`Message`]s ([`decode`], [`encode`]) ↔ [`Frame`]s ([`FrameReader`], [`Frame::messages`]) ↔ poses of a
//! canonical humanoid ([`Performer`]). Unity's axes are left-handed with +Y up, facing +Z with the right along +X. Here
//! the left is along +X, so that points and rotations are mirrored at x = 0 when they are read and written.

mod arguments;
mod bone;
mod error;
mod frame;
mod message;
mod packet;
mod performer;
mod place;

pub use bone::{BONES, Bone};
pub use error::{MAX_MESSAGES, MAX_NESTING, MAX_PACKET_BYTES, PacketError};
pub use frame::{Frame, FrameReader};
pub use message::Message;
pub use packet::{PACKET_BYTES, decode, encode};
pub use performer::{Calibration, Performer};
pub use place::{Place, RootPlace};
/// An Open Sound Control message.
pub use rosc::OscMessage;

#[cfg(test)]
mod tests;
