//! Limits of packets, and reasons why a packet is dropped.

use thiserror::Error;

/// Largest packet that is read, bytes: the maximum of UDP.
pub const MAX_PACKET_BYTES: usize = 65_507;
/// Greatest nesting depth of bundles, and of arrays of arguments.
pub const MAX_NESTING: usize = 4;
/// Maximum number of messages in a packet.
pub const MAX_MESSAGES: usize = 256;

/// Reason why a packet is dropped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum PacketError {
    /// The packet has too many bytes.
    #[error("the packet has more than {MAX_PACKET_BYTES} bytes")]
    TooLarge,
    /// Bundles or arrays are nested too deeply.
    #[error("its bundles or arrays are nested more than {MAX_NESTING} deep")]
    TooDeep,
    /// The packet contains too many messages.
    #[error("it has more than {MAX_MESSAGES} messages")]
    TooMany,
    /// The packet is not Open Sound Control.
    #[error("it is not an Open Sound Control packet")]
    NotOsc,
}
