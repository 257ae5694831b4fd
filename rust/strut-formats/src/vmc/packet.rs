//! Packets of Open Sound Control: bytes that anybody may have sent.

use super::arguments::read_message;
use super::error::{MAX_MESSAGES, MAX_NESTING, MAX_PACKET_BYTES, PacketError};
use super::message::Message;
use rosc::{OscBundle, OscMessage, OscPacket, OscTime};

/// Largest packet that is sent unless one message is larger, bytes: what networks carry in one piece.
pub const PACKET_BYTES: usize = 1_400;

/// The address of a bundle; its time follows.
const BUNDLE: &[u8] = b"#bundle\0";
const TIME_BYTES: usize = 8;
const BUNDLE_HEADER_BYTES: usize = BUNDLE.len() + TIME_BYTES;
/// Bytes of a length.
const LENGTH_BYTES: usize = 4;
/// "At once".
const NOW: OscTime = OscTime { seconds: 0, fractional: 1 };

/// Reads the messages of a packet, in their order, after those that are in `messages` already. Gives the number of messages
/// that were dropped: for their arguments, or as they could not be read. The others of their bundle are read nevertheless.
///
/// # Errors
/// [`PacketError`]; nothing is read then.
pub fn decode(packet: &[u8], messages: &mut Vec<Message>) -> Result<usize, PacketError> {
    if packet.len() > MAX_PACKET_BYTES {
        return Err(PacketError::TooLarge);
    }
    let mut found = Vec::new();
    collect(packet, 0, &mut found)?;
    let all = found.len();
    let before = messages.len();
    messages.extend(found.into_iter().flatten().filter_map(Message::read));
    Ok(all - (messages.len() - before))
}

/// The messages of a packet or of a part of a bundle, which lies in `depth` others; `None` for one that cannot be read.
fn collect(part: &[u8], depth: usize, found: &mut Vec<Option<OscMessage>>) -> Result<(), PacketError> {
    let Some(bundle) = part.strip_prefix(BUNDLE) else {
        let message = read_message(part)?;
        if message.is_none() && depth == 0 && part.first() != Some(&b'/') {
            return Err(PacketError::NotOsc);
        }
        if found.len() == MAX_MESSAGES {
            return Err(PacketError::TooMany);
        }
        found.push(message);
        return Ok(());
    };
    if depth == MAX_NESTING {
        return Err(PacketError::TooDeep);
    }
    let mut rest = bundle.get(TIME_BYTES..).unwrap_or_default();
    while let Some((length, after)) = rest.split_first_chunk::<LENGTH_BYTES>() {
        // A length that is too large ends the bundle, as does what only pads it.
        let length = u32::from_be_bytes(*length) as usize;
        let Some((element, next)) = after.split_at_checked(length).filter(|_| length > 0) else { break };
        collect(element, depth + 1, found)?;
        rest = next;
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
