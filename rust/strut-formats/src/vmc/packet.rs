//! Packets of Open Sound Control: bytes that anybody may have sent.

use super::message::Message;
use rosc::{OscBundle, OscMessage, OscPacket, OscTime};
use thiserror::Error;

/// Largest packet that is read, bytes: what UDP holds.
pub const MAX_PACKET_BYTES: usize = 65_507;
/// How deep bundles, and arrays of arguments, may lie in each other.
pub const MAX_NESTING: usize = 4;
/// Most messages of a packet.
pub const MAX_MESSAGES: usize = 256;
/// Largest packet that is sent unless one message is larger, bytes: what networks carry in one piece.
pub const PACKET_BYTES: usize = 1_400;

/// The address of a bundle; its time follows.
const BUNDLE: &[u8] = b"#bundle";
const TIME_BYTES: usize = 8;
const BUNDLE_HEADER_BYTES: usize = BUNDLE.len() + 1 + TIME_BYTES;
/// Texts end with a zero and are padded to multiples of this.
const TEXT_ALIGNMENT: usize = 4;
/// Bytes of a length.
const LENGTH_BYTES: usize = 4;
/// "At once".
const NOW: OscTime = OscTime { seconds: 0, fractional: 1 };

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

/// Reads the messages of a packet, in their order, after those that are in `messages` already. Gives the number of messages
/// that were dropped for their arguments.
///
/// # Errors
/// [`PacketError`]; nothing is read then.
pub fn decode(packet: &[u8], messages: &mut Vec<Message>) -> Result<usize, PacketError> {
    if packet.len() > MAX_PACKET_BYTES {
        return Err(PacketError::TooLarge);
    }
    // The decoder calls itself for every bundle in a bundle, and what it returns is dropped so as well.
    check_nesting(packet, 0, 0)?;
    let (_, packet) = rosc::decoder::decode_udp(packet).map_err(|_| PacketError::NotOsc)?;
    let mut found = Vec::new();
    collect(packet, &mut found)?;
    let all = found.len();
    let before = messages.len();
    messages.extend(found.into_iter().filter_map(Message::read));
    Ok(all - (messages.len() - before))
}

/// Whether bundles and arrays lie in few others, in a part of a packet that begins at `offset`. Like the decoder it counts
/// the padding of texts from the beginning of the packet.
fn check_nesting(part: &[u8], offset: usize, depth: usize) -> Result<(), PacketError> {
    let Some(address_bytes) = part.iter().position(|&byte| byte == 0) else { return Ok(()) };
    let after_address = (offset + address_bytes + 1).next_multiple_of(TEXT_ALIGNMENT) - offset;
    let rest = part.get(after_address..).unwrap_or_default();
    if &part[..address_bytes] != BUNDLE {
        return check_arrays(rest);
    }
    if depth == MAX_NESTING {
        return Err(PacketError::TooDeep);
    }
    let mut at = after_address + TIME_BYTES;
    while let Some((length, after)) = part.get(at..).and_then(<[u8]>::split_first_chunk::<LENGTH_BYTES>) {
        let length = u32::from_be_bytes(*length) as usize;
        // A length that is too large ends the bundle for the decoder too.
        let Some(element) = after.get(..length) else { break };
        at += LENGTH_BYTES;
        check_nesting(element, offset + at, depth + 1)?;
        at += length;
    }
    Ok(())
}

/// Whether the arrays of a message lie in few others, given its types and what follows.
fn check_arrays(types: &[u8]) -> Result<(), PacketError> {
    let mut depth = 0_usize;
    for byte in types.iter().take_while(|&&byte| byte != 0) {
        match byte {
            b'[' => depth += 1,
            b']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > MAX_NESTING {
            return Err(PacketError::TooDeep);
        }
    }
    Ok(())
}

fn collect(packet: OscPacket, found: &mut Vec<OscMessage>) -> Result<(), PacketError> {
    match packet {
        OscPacket::Message(message) if found.len() < MAX_MESSAGES => found.push(message),
        OscPacket::Message(_) => return Err(PacketError::TooMany),
        OscPacket::Bundle(bundle) => {
            for packet in bundle.content {
                collect(packet, found)?;
            }
        }
    }
    Ok(())
}

/// Packets of bundles of these messages, in their order, each of at most [`PACKET_BYTES`] or one message.
pub fn encode(messages: &[Message]) -> Vec<Vec<u8>> {
    let mut packets = Vec::new();
    let mut content = Vec::new();
    let mut bytes = BUNDLE_HEADER_BYTES;
    let mut end = |content: &mut Vec<OscPacket>| {
        let bundle = OscPacket::Bundle(OscBundle { timetag: NOW, content: std::mem::take(content) });
        packets.extend(rosc::encoder::encode(&bundle));
    };
    for message in messages {
        let packet = OscPacket::Message(message.write());
        // Only writing to a failing device can fail.
        let Ok(encoded) = rosc::encoder::encode(&packet) else { continue };
        let length = encoded.len() + LENGTH_BYTES;
        if bytes + length > PACKET_BYTES && !content.is_empty() {
            end(&mut content);
            bytes = BUNDLE_HEADER_BYTES;
        }
        bytes += length;
        content.push(packet);
    }
    if !content.is_empty() {
        end(&mut content);
    }
    packets
}
