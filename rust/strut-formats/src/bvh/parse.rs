//! Text to [`Bvh`].

use super::number::parse_prefix;
use super::{
    Bvh, BvhError, Channel, FRAME_TIME_SECS, Joint, MAX_ABS_VALUE, MAX_BYTES, MAX_CHANNELS_PER_JOINT, MAX_FRAMES,
    MAX_JOINTS, MAX_NAME_BYTES,
};
use crate::quotation::quotation;

/// Reads a file. See the [module documentation](super) for what is accepted.
///
/// # Errors
/// The first thing that is wrong, with its line; see [`BvhError`].
pub fn parse(bytes: &[u8]) -> Result<Bvh, BvhError> {
    let (joints, mut cursor) = beginning(bytes)?;
    let channels: usize = joints.iter().map(|j| j.channels.len()).sum();
    let (frames, frame_time_secs) = motion_header(&mut cursor)?;
    let values = frame_values(&mut cursor, frames, channels)?;
    Ok(Bvh { joints, frame_time_secs, frames, values })
}

/// Reads what stands before the frames of a file, as it is sent before a stream of frames: what follows the joints is not
/// read, and the only frame has 0 in every channel.
///
/// # Errors
/// As [`parse`].
pub fn parse_hierarchy(bytes: &[u8]) -> Result<Bvh, BvhError> {
    let (joints, _) = beginning(bytes)?;
    let values = vec![0.0; joints.iter().map(|j| j.channels.len()).sum()];
    Ok(Bvh { joints, frame_time_secs: 1.0, frames: 1, values })
}

/// From `HIERARCHY` to after the root's closing brace.
fn beginning(bytes: &[u8]) -> Result<(Vec<Joint>, Cursor<'_>), BvhError> {
    if bytes.len() > MAX_BYTES {
        return Err(BvhError::TooManyBytes { bytes: bytes.len() });
    }
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let mut cursor = Cursor { text, at: 0, line: 1, line_begin: 0 };
    cursor.skip_blanks_and_lines();
    if cursor.peek().is_none() {
        return Err(BvhError::Empty);
    }
    cursor.keyword("HIERARCHY")?;
    let joints = hierarchy(&mut cursor)?;
    if joints.iter().all(|j| j.channels.is_empty()) {
        return Err(BvhError::NoChannels);
    }
    Ok((joints, cursor))
}

/// From after `HIERARCHY` to after the root's closing brace.
fn hierarchy(cursor: &mut Cursor) -> Result<Vec<Joint>, BvhError> {
    cursor.keyword("ROOT")?;
    let mut joints = vec![joint(cursor, None)?];
    // The joints whose braces are open, innermost last.
    let mut open = vec![0];
    while let Some(&current) = open.last() {
        if cursor.take_keyword("JOINT") {
            if joints.len() == MAX_JOINTS {
                return Err(BvhError::TooManyJoints { line: cursor.line });
            }
            open.push(joints.len());
            joints.push(joint(cursor, Some(current))?);
        } else if cursor.take_keyword("End") {
            if joints[current].end_site.is_some() {
                return Err(BvhError::SecondEndSite { line: cursor.line });
            }
            cursor.keyword("Site")?;
            cursor.keyword("{")?;
            cursor.keyword("OFFSET")?;
            joints[current].end_site = Some(cursor.vector()?);
            cursor.keyword("}")?;
        } else if cursor.take_keyword("}") {
            open.pop();
        } else {
            return Err(cursor.unexpected("JOINT, End Site or '}'"));
        }
    }
    if cursor.take_keyword("ROOT") {
        return Err(BvhError::SecondRoot { line: cursor.line });
    }
    Ok(joints)
}

/// A joint from its name to its channels; its opening brace stays open.
fn joint(cursor: &mut Cursor, parent: Option<usize>) -> Result<Joint, BvhError> {
    let name = cursor.name()?;
    cursor.keyword("{")?;
    let (mut offset, mut channels) = (None, None);
    loop {
        if offset.is_none() && cursor.take_keyword("OFFSET") {
            offset = Some(cursor.vector()?);
        } else if channels.is_none() && cursor.take_keyword("CHANNELS") {
            channels = Some(channel_list(cursor)?);
        } else if let Some(offset) = offset {
            return Ok(Joint { name, parent, offset, channels: channels.unwrap_or_default(), end_site: None });
        } else {
            return Err(cursor.unexpected("OFFSET"));
        }
    }
}

fn channel_list(cursor: &mut Cursor) -> Result<Vec<Channel>, BvhError> {
    let count = cursor.count("the number of channels")?;
    if count > MAX_CHANNELS_PER_JOINT as u64 {
        return Err(BvhError::TooManyChannels { line: cursor.line, channels: count as usize });
    }
    let mut channels = Vec::with_capacity(count as usize);
    for _ in 0..count {
        let token = cursor.token();
        let channel =
            Channel::from_name(token).ok_or_else(|| cursor.unexpected("a channel such as Xposition or Zrotation"))?;
        if matches!(channel, Channel::Position(_)) && channels.contains(&channel) {
            return Err(BvhError::RepeatedPosition { line: cursor.line, channel: channel.name() });
        }
        cursor.at += token.len();
        channels.push(channel);
    }
    Ok(channels)
}

/// `MOTION`, `Frames:` and `Frame Time:`; ends at the end of the line.
fn motion_header(cursor: &mut Cursor) -> Result<(usize, f64), BvhError> {
    cursor.keyword("MOTION")?;
    cursor.label(&["Frames"], "'Frames:'")?;
    let frames = cursor.count("the number of frames")?;
    if frames == 0 || frames > MAX_FRAMES as u64 {
        return Err(BvhError::Frames { line: cursor.line, frames });
    }
    cursor.label(&["Frame", "Time"], "'Frame Time:'")?;
    cursor.skip_blanks();
    let secs = cursor.any_number("the frame time in seconds")?;
    if !FRAME_TIME_SECS.contains(&secs) {
        return Err(BvhError::FrameTime { line: cursor.line, secs });
    }
    if !cursor.at_line_end() {
        return Err(cursor.unexpected("the end of the line"));
    }
    Ok((frames as usize, secs))
}

/// One line of `channels` numbers for each of `frames` frames, then nothing but blanks.
fn frame_values(cursor: &mut Cursor, frames: usize, channels: usize) -> Result<Vec<f64>, BvhError> {
    // A value takes two bytes at least, so that a short file cannot reserve much memory.
    let most = (cursor.text.len() - cursor.at) / 2 + 1;
    let mut values = Vec::with_capacity((frames * channels).min(most));
    for frame in 0..frames {
        cursor.skip_blanks_and_lines();
        if cursor.peek().is_none() {
            return Err(BvhError::MissingFrames { line: cursor.line, found: frame, announced: frames });
        }
        for found in 0..channels {
            if cursor.at_line_end() {
                return Err(BvhError::FrameWidth { line: cursor.line, found, needed: channels });
            }
            values.push(cursor.bounded_number()?);
        }
        let mut found = channels;
        while !cursor.at_line_end() {
            cursor.bounded_number()?;
            found += 1;
        }
        if found > channels {
            return Err(BvhError::FrameWidth { line: cursor.line, found, needed: channels });
        }
    }
    cursor.skip_blanks_and_lines();
    if cursor.peek().is_some() {
        return Err(BvhError::ExtraFrames { line: cursor.line, announced: frames });
    }
    Ok(values)
}

/// A position in the text with its line.
struct Cursor<'a> {
    text: &'a [u8],
    at: usize,
    /// Counts from 1.
    line: usize,
    /// Where the line begins in `text`.
    line_begin: usize,
}

impl<'a> Cursor<'a> {
    fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    fn skip_blanks(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t')) {
            self.at += 1;
        }
    }

    fn skip_blanks_and_lines(&mut self) {
        loop {
            match self.peek() {
                Some(b' ' | b'\t') => self.at += 1,
                Some(b'\n') => self.next_line(1),
                Some(b'\r') => self.next_line(if self.text.get(self.at + 1) == Some(&b'\n') { 2 } else { 1 }),
                _ => return,
            }
        }
    }

    fn next_line(&mut self, length: usize) {
        self.at += length;
        self.line += 1;
        self.line_begin = self.at;
    }

    /// Skips blanks; whether nothing else is left on the line.
    fn at_line_end(&mut self) -> bool {
        self.skip_blanks();
        matches!(self.peek(), None | Some(b'\n' | b'\r'))
    }

    /// Skips blanks and lines; the bytes to the next blank, line end or brace, not consumed. A brace is a
    /// token of its own.
    fn token(&mut self) -> &'a [u8] {
        self.skip_blanks_and_lines();
        let rest = &self.text[self.at..];
        if let Some(b'{' | b'}') = rest.first() {
            return &rest[..1];
        }
        let length = rest.iter().position(|b| matches!(b, b' ' | b'\t' | b'\n' | b'\r' | b'{' | b'}'));
        &rest[..length.unwrap_or(rest.len())]
    }

    /// Consumes the next token if it is this word, in any case.
    fn take_keyword(&mut self, word: &str) -> bool {
        let token = self.token();
        let taken = token.eq_ignore_ascii_case(word.as_bytes());
        if taken {
            self.at += token.len();
        }
        taken
    }

    fn keyword(&mut self, word: &'static str) -> Result<(), BvhError> {
        if self.take_keyword(word) { Ok(()) } else { Err(self.unexpected(word)) }
    }

    /// Words and a colon, with or without blanks around it.
    fn label(&mut self, words: &[&str], expected: &'static str) -> Result<(), BvhError> {
        self.skip_blanks_and_lines();
        for word in words {
            self.skip_blanks();
            let end = self.at + word.len();
            if !self.text.get(self.at..end).is_some_and(|t| t.eq_ignore_ascii_case(word.as_bytes())) {
                return Err(self.unexpected(expected));
            }
            self.at = end;
        }
        self.skip_blanks();
        if self.peek() != Some(b':') {
            return Err(self.unexpected(expected));
        }
        self.at += 1;
        Ok(())
    }

    /// The rest of the line without blanks around and opening braces at its end, where the joint may begin: what is a name can
    /// be written and read again.
    fn name(&mut self) -> Result<String, BvhError> {
        self.skip_blanks();
        let rest = &self.text[self.at..];
        let line = &rest[..rest.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(rest.len())];
        let name_end = line.iter().rposition(|b| *b != b'{' && !b.is_ascii_whitespace());
        let name = &line[..name_end.map_or(0, |last| last + 1)];
        if name.is_empty() || name.len() > MAX_NAME_BYTES {
            return Err(self.unexpected("a joint name of 1 to 256 bytes"));
        }
        let name_text = std::str::from_utf8(name).ok().filter(|n| !n.contains(char::is_control));
        let name_text = name_text.ok_or_else(|| self.unexpected("a joint name in UTF-8"))?;
        self.at += name.len();
        Ok(name_text.to_owned())
    }

    /// A whole number, saturated.
    fn count(&mut self, expected: &'static str) -> Result<u64, BvhError> {
        let token = self.token();
        if token.is_empty() || !token.iter().all(u8::is_ascii_digit) {
            return Err(self.unexpected(expected));
        }
        self.at += token.len();
        Ok(token.iter().fold(0_u64, |n, b| n.saturating_mul(10).saturating_add(u64::from(b - b'0'))))
    }

    fn vector(&mut self) -> Result<[f64; 3], BvhError> {
        let mut vector = [0.0; 3];
        for v in &mut vector {
            self.skip_blanks_and_lines();
            *v = self.bounded_number()?;
        }
        Ok(vector)
    }

    /// The number here, at most [`MAX_ABS_VALUE`] in magnitude.
    fn bounded_number(&mut self) -> Result<f64, BvhError> {
        let begin = self.at;
        let value = self.any_number("a number")?;
        if value.abs() <= MAX_ABS_VALUE {
            return Ok(value);
        }
        self.at = begin;
        Err(BvhError::TooLarge { line: self.line, column: self.column(), found: self.shown() })
    }

    /// The number here, up to a blank, line end or brace.
    fn any_number(&mut self, expected: &'static str) -> Result<f64, BvhError> {
        let Some((value, length)) = parse_prefix(&self.text[self.at..]) else {
            return Err(self.unexpected(expected));
        };
        match self.text.get(self.at + length) {
            None | Some(b' ' | b'\t' | b'\n' | b'\r' | b'{' | b'}') => {
                self.at += length;
                Ok(value)
            }
            Some(_) => Err(self.unexpected(expected)),
        }
    }

    fn column(&self) -> usize {
        self.at - self.line_begin + 1
    }

    /// The next token as a message quotes it.
    fn shown(&mut self) -> String {
        const MOST: usize = 24;
        let token = self.token();
        if token.is_empty() {
            return if self.peek().is_none() { "the end of the file" } else { "a blank" }.to_owned();
        }
        let text = String::from_utf8_lossy(&token[..token.len().min(4 * MOST)]);
        let shown = quotation(&text, MOST);
        if shown.len() < token.len() && text.chars().count() > MOST {
            format!("'{shown}…'")
        } else {
            format!("'{shown}'")
        }
    }

    fn unexpected(&mut self, expected: &'static str) -> BvhError {
        // First the token: finding it may lead to a further line.
        let found = self.shown();
        BvhError::Unexpected { line: self.line, column: self.column(), found, expected }
    }
}
