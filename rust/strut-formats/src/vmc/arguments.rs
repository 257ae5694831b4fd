//! Encoding of a message: its address, the types of its arguments, and the arguments.

use super::error::{MAX_NESTING, PacketError};
use rosc::{OscArray, OscColor, OscMessage, OscMidiMessage, OscTime, OscType};

/// Texts and blobs are padded to multiples of this, bytes.
const ALIGNMENT: usize = 4;

/// Parses a message; `None` if the bytes are not a message, or if it has an argument of a type whose size is unknown.
///
/// # Errors
/// [`PacketError::TooDeep`].
pub(super) fn read_message(bytes: &[u8]) -> Result<Option<OscMessage>, PacketError> {
    let mut bytes = Bytes(bytes);
    let Some(addr) = bytes.text().filter(|addr| addr.starts_with('/')) else { return Ok(None) };
    let types = if bytes.0.is_empty() { Some(String::new()) } else { bytes.text() };
    let Some(types) = types.filter(|types| types.is_empty() || types.starts_with(',')) else { return Ok(None) };
    let mut args = Vec::new();
    // Arguments before each open array.
    let mut outside: Vec<Vec<OscType>> = Vec::new();
    for kind in types.bytes().skip(1) {
        let arg = match kind {
            b'[' if outside.len() == MAX_NESTING => return Err(PacketError::TooDeep),
            b'[' => {
                outside.push(std::mem::take(&mut args));
                continue;
            }
            b']' => {
                let Some(before) = outside.pop() else { return Ok(None) };
                Some(OscType::Array(OscArray { content: std::mem::replace(&mut args, before) }))
            }
            _ => bytes.argument(kind),
        };
        let Some(arg) = arg else { return Ok(None) };
        args.push(arg);
    }
    Ok(outside.is_empty().then_some(OscMessage { addr, args }))
}

/// Bytes that are not yet read.
struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    /// Reads an argument of a type.
    fn argument(&mut self, kind: u8) -> Option<OscType> {
        Some(match kind {
            b'i' => OscType::Int(i32::from_be_bytes(self.chunk()?)),
            b'h' => OscType::Long(i64::from_be_bytes(self.chunk()?)),
            b'f' => OscType::Float(f32::from_be_bytes(self.chunk()?)),
            b'd' => OscType::Double(f64::from_be_bytes(self.chunk()?)),
            b's' | b'S' => OscType::String(self.text()?),
            b'b' => {
                let length = u32::from_be_bytes(self.chunk()?) as usize;
                OscType::Blob(self.padded(length, length)?.to_vec())
            }
            b't' => {
                let [seconds, fractional] = [self.chunk()?, self.chunk()?].map(u32::from_be_bytes);
                OscType::Time(OscTime { seconds, fractional })
            }
            b'c' => {
                let code = u32::from_be_bytes(self.chunk()?);
                OscType::Char(char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER))
            }
            b'r' => {
                let [red, green, blue, alpha] = self.chunk()?;
                OscType::Color(OscColor { red, green, blue, alpha })
            }
            b'm' => {
                let [port, status, data1, data2] = self.chunk()?;
                OscType::Midi(OscMidiMessage { port, status, data1, data2 })
            }
            b'T' => OscType::Bool(true),
            b'F' => OscType::Bool(false),
            b'N' => OscType::Nil,
            b'I' => OscType::Inf,
            _ => return None,
        })
    }

    fn chunk<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (chunk, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*chunk)
    }

    /// Reads a text up to its terminating zero.
    fn text(&mut self) -> Option<String> {
        let length = self.0.iter().position(|&byte| byte == 0)?;
        String::from_utf8(self.padded(length, length + 1)?.to_vec()).ok()
    }

    /// Reads `length` bytes, which are padded. The padding at the end of a message may be missing.
    fn padded(&mut self, length: usize, with_end: usize) -> Option<&'a [u8]> {
        let found = self.0.get(..length)?;
        let next = with_end.checked_next_multiple_of(ALIGNMENT)?;
        self.0 = self.0.get(next..).unwrap_or_default();
        Some(found)
    }
}
