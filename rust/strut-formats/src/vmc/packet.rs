//! Packets of Open Sound Control: untrusted bytes.

use super::arguments::read_message;
use super::error::{MAX_MESSAGES, MAX_NESTING, MAX_PACKET_BYTES, PacketError};
use super::message::Message;
use rosc::{OscBundle, OscMessage, OscPacket, OscTime};

/// Largest packet that is sent unless a message is larger, bytes: the size that networks transmit without fragmentation.
pub const PACKET_BYTES: usize = 1_400;

/// Address of a bundle, followed by its time.
const BUNDLE: &[u8] = b"#bundle\0";
const TIME_BYTES: usize = 8;
const BUNDLE_HEADER_BYTES: usize = BUNDLE.len() + TIME_BYTES;
/// Number of bytes of a length.
const LENGTH_BYTES: usize = 4;
/// The time "immediately".
const NOW: OscTime = OscTime { seconds: 0, fractional: 1 };

/// Appends the messages of a packet to `messages` in order. Returns the number of messages that were dropped because
/// their arguments were invalid or they could not be parsed. The other messages of their bundle are read nevertheless.
///
/// # Errors
/// [`PacketError`]; then no message is appended.
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

/// Messages of a packet or of an element of a bundle at nesting depth `depth`; `None` for one that cannot be parsed.
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
        // A length that is too large ends the bundle, as does padding.
        let length = u32::from_be_bytes(*length) as usize;
        let Some((element, next)) = after.split_at_checked(length).filter(|_| length > 0) else { break };
        collect(element, depth + 1, found)?;
        rest = next;
    }
    Ok(())
}

/// Packets of bundles of these messages, in order, each of at most [`PACKET_BYTES`] or one message.
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
