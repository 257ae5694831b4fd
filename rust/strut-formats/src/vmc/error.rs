//! Limits of packets, and why one is dropped.

use thiserror::Error;

/// Largest packet that is read, bytes: what UDP holds.
pub const MAX_PACKET_BYTES: usize = 65_507;
/// How deep bundles, and arrays of arguments, may lie in each other.
pub const MAX_NESTING: usize = 4;
/// Most messages of a packet.
pub const MAX_MESSAGES: usize = 256;

/// Why a packet is dropped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum PacketError {
    /// Too many bytes.
    #[error("the packet has more than {MAX_PACKET_BYTES} bytes")]
    TooLarge,
    /// Bundles or arrays in too many others.
    #[error("its bundles or arrays lie in more than {MAX_NESTING} others")]
    TooDeep,
    /// Too many messages.
    #[error("it has more than {MAX_MESSAGES} messages")]
    TooMany,
    /// Not Open Sound Control.
    #[error("it is no Open Sound Control packet")]
    NotOsc,
}
