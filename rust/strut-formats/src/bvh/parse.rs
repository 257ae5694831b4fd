//! Parses text to [`Bvh`].

use super::number::parse_prefix;
use super::{
    Bvh, BvhError, Channel, FRAME_TIME_SECS, Joint, MAX_ABS_VALUE, MAX_BYTES, MAX_CHANNELS_PER_JOINT, MAX_FRAMES,
    MAX_JOINTS, MAX_NAME_BYTES, MAX_TRANSFORMS, encoding,
};
use crate::quotation::quotation;
use std::borrow::Cow;
use strut_core::note::{Note, NoteCode};

/// Frame times that are treated as milliseconds if the motion has small steps: 20 to 250 Hz.
const MILLISECONDS: std::ops::RangeInclusive<f64> = 4.0..=50.0;

/// Maximum number of characters of the file that a message quotes.
const MOST_SHOWN: usize = 24;

/// Parses a file. See the [module documentation](super) for the accepted format.
///
/// # Errors
/// Returns the first error, with its line; see [`BvhError`].
pub fn parse(bytes: &[u8]) -> Result<Bvh, BvhError> {
    Ok(parse_noted(bytes)?.0)
}

/// Parses a file and returns notes on all guesses; empty for a file without faults.
///
/// # Errors
/// As [`parse`].
pub fn parse_noted(bytes: &[u8]) -> Result<(Bvh, Vec<Note>), BvhError> {
    let (text, is_utf_16) = text_of(bytes)?;
    let (joints, mut cursor) = beginning(&text)?;
    if is_utf_16 {
        cursor.notes.push(Note::new(NoteCode::Encoding, "The file is in UTF-16. It is written back in UTF-8."));
    }
    let channels: usize = joints.iter().map(|j| j.channels.len()).sum();
    let (announced, frame_time) = motion_header(&mut cursor)?;
    let Frames { mut values, cut_off } = frame_values(&mut cursor, announced, channels)?;
    values.truncate(values.len() - cut_off);
    let frames = values.len() / channels;
    if frames > MAX_TRANSFORMS / joints.len() {
        return Err(BvhError::TooManyTransforms { frames, joints: joints.len() });
    }
    if frames != announced || cut_off > 0 {
        let rest = if cut_off > 0 { "Its last row is incomplete and was left out." } else { "All of them were read." };
        cursor.notes.push(Note::new(
            NoteCode::FrameCount,
            format!("The file declares {announced} frames and has {frames}. {rest}"),
        ));
    }
    let mut bvh = Bvh { joints, added_positions: false, frame_time_secs: frame_time.value, frames, values };
    if MILLISECONDS.contains(&frame_time.value) && bvh.moves_in_small_steps() {
        bvh.frame_time_secs = frame_time.value / 1000.0;
        cursor.notes.push(Note::new(
            NoteCode::Milliseconds,
            format!(
                "The frame time {} was read as milliseconds: in seconds, the motion would be too slow for a person.",
                frame_time.value
            ),
        ));
    } else if !FRAME_TIME_SECS.contains(&frame_time.value) {
        return Err(BvhError::FrameTime { line: frame_time.line, secs: frame_time.value });
    }
    if bvh.collapses() {
        bvh.added_positions = true;
        cursor.notes.push(Note::new(
            NoteCode::AddedPositions,
            "Position channels were added to the offsets of their joints: without the offsets, the body would \
             collapse.",
        ));
    }
    if let Some(far) = bvh.far() {
        let [x, y, z] = far.place;
        cursor.notes.push(Note::new(
            NoteCode::Far,
            format!(
                "The body is far from the origin of the file, at ({x:.0}, {y:.0}, {z:.0}). It was moved near the \
                 origin."
            ),
        ));
    }
    Ok((bvh, cursor.notes))
}

/// Parses the part of a file before the frames, as it is sent before a stream of frames. The text after the joints is
/// ignored, and the only frame has 0 in every channel.
///
/// # Errors
/// As [`parse`].
pub fn parse_hierarchy(bytes: &[u8]) -> Result<Bvh, BvhError> {
    let (text, _) = text_of(bytes)?;
    let (joints, _) = beginning(&text)?;
    let values = vec![0.0; joints.iter().map(|j| j.channels.len()).sum()];
    Ok(Bvh { joints, added_positions: false, frame_time_secs: 1.0, frames: 1, values })
}

/// The file as UTF-8, except for names, and whether it was UTF-16.
fn text_of(bytes: &[u8]) -> Result<(Cow<'_, [u8]>, bool), BvhError> {
    if bytes.len() > MAX_BYTES {
        return Err(BvhError::TooManyBytes { bytes: bytes.len() });
    }
    Ok(encoding::utf_8(bytes))
}

/// Parses from `HIERARCHY` to after the root's closing brace.
fn beginning(text: &[u8]) -> Result<(Vec<Joint>, Cursor<'_>), BvhError> {
    let mut cursor = Cursor { text, at: 0, line: 1, line_begin: 0, notes: Vec::new() };
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

/// Parses from after `HIERARCHY` to after the root's closing brace.
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
            let is_usual = cursor.take_keyword("Site");
            end_site(cursor, &mut joints[current], is_usual)?;
        } else if cursor.take_keyword("EndSite") || cursor.take_keyword("End_Site") {
            end_site(cursor, &mut joints[current], false)?;
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

/// Parses an end site after its keyword. If a joint has several, the first one is used.
fn end_site(cursor: &mut Cursor, joint: &mut Joint, mut is_usual: bool) -> Result<(), BvhError> {
    if !cursor.at_line_end() && cursor.peek() != Some(b'{') {
        cursor.name()?;
        is_usual = false;
    }
    cursor.keyword("{")?;
    cursor.keyword("OFFSET")?;
    let offset = cursor.vector()?;
    if cursor.take_keyword("CHANNELS") {
        if !channel_list(cursor)?.is_empty() {
            return Err(cursor.unexpected("an End Site without channels"));
        }
        is_usual = false;
    }
    cursor.keyword("}")?;
    is_usual &= joint.end_site.is_none();
    joint.end_site.get_or_insert(offset);
    if !is_usual {
        let text = "End Sites are in an unusual notation. Each was read as the end of its joint's bone.";
        cursor.note_once(NoteCode::Hierarchy, || text.into());
    }
    Ok(())
}

/// Parses a joint from its name to its channels; its opening brace stays open.
fn joint(cursor: &mut Cursor, parent: Option<usize>) -> Result<Joint, BvhError> {
    let (name, name_bytes) = encoding::name(cursor.name()?);
    if name_bytes.is_some() {
        let line = cursor.line;
        let text = || format!("Names from line {line} on are not in UTF-8. They are written back byte for byte.");
        cursor.note_once(NoteCode::Encoding, || text().into());
    }
    cursor.keyword("{")?;
    let (mut offset, mut channels) = (None, None);
    loop {
        if offset.is_none() && cursor.take_keyword("OFFSET") {
            offset = Some(cursor.vector()?);
        } else if channels.is_none() && cursor.take_keyword("CHANNELS") {
            channels = Some(channel_list(cursor)?);
        } else if let Some(offset) = offset {
            let channels = channels.unwrap_or_default();
            return Ok(Joint { name, name_bytes, parent, offset, channels, end_site: None });
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

/// Value of `Frame Time:`.
struct FrameTime {
    /// Seconds, or milliseconds.
    value: f64,
    line: usize,
}

/// Parses `MOTION`, `Frames:` and `Frame Time:`; stops before the first frame.
fn motion_header(cursor: &mut Cursor) -> Result<(usize, FrameTime), BvhError> {
    cursor.keyword("MOTION")?;
    let begin = cursor.line;
    cursor.label(&["Frames"], "'Frames:'")?;
    let frames = cursor.count("the number of frames")?;
    if frames == 0 || frames > MAX_FRAMES as u64 {
        return Err(BvhError::Frames { line: cursor.line, frames });
    }
    cursor.label(&["Frame", "Time"], "'Frame Time:'")?;
    cursor.skip_blanks();
    let value = cursor.any_number("the frame time in seconds")?;
    if !FRAME_TIME_SECS.contains(&value) && !MILLISECONDS.contains(&value) {
        return Err(BvhError::FrameTime { line: cursor.line, secs: value });
    }
    // If the header is on one line, the frames may be on it too.
    if !cursor.at_line_end() && cursor.line != begin {
        return Err(cursor.unexpected("the end of the line"));
    }
    Ok((frames as usize, FrameTime { value, line: cursor.line }))
}

/// Numbers of the frames.
struct Frames {
    values: Vec<f64>,
    /// Number of values of an incomplete last frame.
    cut_off: usize,
}

/// Parses lines of `channels` numbers each, up to the end of the frames; their number may differ from `frames`. A line
/// may also contain a part of a frame, or several whole frames.
fn frame_values(cursor: &mut Cursor, frames: usize, channels: usize) -> Result<Frames, BvhError> {
    // A value takes at least two bytes, so that a short file cannot reserve much memory.
    let most = (cursor.text.len() - cursor.at) / 2 + 1;
    let mut values = Vec::with_capacity(frames.saturating_mul(channels).min(most));
    // First line of another length, and last line.
    let (mut uneven, mut last) = (None, 0);
    loop {
        cursor.skip_blanks_and_lines();
        if cursor.ends_or_has_text(&values, channels, frames) {
            break;
        }
        last = cursor.line;
        let begun = values.len() % channels;
        let before = values.len();
        while !cursor.at_line_end() {
            values.push(cursor.bounded_number()?);
        }
        let found = values.len() - before;
        if found == 0 {
            // There is an end-of-file mark between numbers.
            return Err(cursor.unexpected("a number"));
        }
        if found != channels {
            uneven = uneven.or(Some((last, found)));
        }
        let is_whole = begun == 0 && found.is_multiple_of(channels);
        if let (false, true, Some((line, found))) = (is_whole, begun + found > channels, uneven) {
            return Err(BvhError::FrameWidth { line, found, needed: channels });
        }
        if values.len() / channels > MAX_FRAMES {
            return Err(BvhError::ExtraFrames { line: last, announced: frames });
        }
    }
    let cut_off = values.len() % channels;
    match uneven {
        Some((line, found)) if values.len() < channels => {
            return Err(BvhError::FrameWidth { line, found, needed: channels });
        }
        Some((line, _)) if line != last || cut_off == 0 => cursor.notes.push(Note::new(
            NoteCode::Rows,
            "The lines do not hold one frame each. The numbers were read in sequence, as every frame ends at the end \
             of a line.",
        )),
        _ => {}
    }
    if values.is_empty() {
        return Err(BvhError::MissingFrames { line: cursor.line, found: 0, announced: frames });
    }
    if frames > most / channels + 1 {
        return Err(BvhError::NoRoom { announced: frames, most: most / channels });
    }
    Ok(Frames { values, cut_off })
}

/// Returns whether the text after a brace is the start of a joint, not the rest of a name.
fn begins_joint(text: &[u8]) -> bool {
    let text = text.trim_ascii_start();
    let Some((word, rest)) = text.split_at_checked(text.iter().take_while(|b| b.is_ascii_alphabetic()).count()) else {
        return false;
    };
    let is = |keyword: &[u8]| word.eq_ignore_ascii_case(keyword);
    let number = rest.trim_ascii_start();
    (is(b"OFFSET") || is(b"CHANNELS")) && number.len() < rest.len() && number.first().is_some_and(|b| is_numeric(*b))
}

/// Returns whether a byte may be the first of a number.
fn is_numeric(b: u8) -> bool {
    matches!(b, b'-' | b'+' | b'.' | b'0'..=b'9')
}

/// Returns whether a line after whole frames is a frame, possibly a damaged one: it starts with a number or, if frames
/// are missing, with a word that contains a digit; or it has as many words as a frame has numbers, or more than
/// half as many numbers.
fn is_frame(line: &[u8], channels: usize, is_short: bool) -> bool {
    let is = |word: &[u8]| line.get(..3).is_some_and(|w| w.eq_ignore_ascii_case(word));
    if line.first().is_some_and(|b| is_numeric(*b)) || is(b"nan") || is(b"inf") {
        return true;
    }
    let words = || line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    let first = words().next().unwrap_or_default();
    if is_short && !first.starts_with(b"#") && first.iter().any(u8::is_ascii_digit) {
        return true;
    }
    let numbers = words().filter(|word| parse_prefix(word).is_some_and(|(_, length)| length == word.len())).count();
    channels > 1 && (words().count() == channels || 2 * numbers > channels)
}

/// A position in the text with its line.
struct Cursor<'a> {
    text: &'a [u8],
    at: usize,
    /// Counts from 1.
    line: usize,
    /// Start of the line in `text`.
    line_begin: usize,
    /// Notes on guesses so far.
    notes: Vec<Note>,
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

    /// Returns whether the frames end here: at the end of the file, or at text after whole frames that contains no
    /// frame ([`is_frame`]).
    fn ends_or_has_text(&mut self, values: &[f64], channels: usize, announced: usize) -> bool {
        let rest = &self.text[self.at..];
        let Some(first) = rest.first() else { return true };
        if is_numeric(*first) || values.is_empty() || !values.len().is_multiple_of(channels) {
            return false;
        }
        let is_short = values.len() / channels < announced;
        let mut lines = rest.split(|b| matches!(b, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
        if lines.any(|line| is_frame(line, channels, is_short)) {
            return false;
        }
        // End-of-file marks need no note.
        if rest.iter().any(|b| !matches!(b, 0 | 0x1A | b' ' | b'\t' | b'\r' | b'\n')) {
            let line = self.line;
            self.notes.push(Note::new(
                NoteCode::TextAfter,
                format!("The text after the frames, from line {line} on, was ignored."),
            ));
        }
        true
    }

    /// Adds a note only once, for faults that occur many times in a file.
    fn note_once(&mut self, code: NoteCode, text: impl FnOnce() -> Cow<'static, str>) {
        if self.notes.iter().all(|note| note.code != code) {
            self.notes.push(Note::new(code, text()));
        }
    }

    /// Skips blanks and returns whether the line ends. The end-of-file marks of some programs also end a line.
    fn at_line_end(&mut self) -> bool {
        self.skip_blanks();
        matches!(self.peek(), None | Some(b'\n' | b'\r' | 0 | 0x1A))
    }

    /// Skips blanks and lines, and returns the bytes up to the next blank, line end or brace without consuming them. A
    /// brace is a token of its own.
    fn token(&mut self) -> &'a [u8] {
        self.skip_blanks_and_lines();
        let rest = &self.text[self.at..];
        if let Some(b'{' | b'}') = rest.first() {
            return &rest[..1];
        }
        let length = rest.iter().position(|b| matches!(b, b' ' | b'\t' | b'\n' | b'\r' | b'{' | b'}'));
        &rest[..length.unwrap_or(rest.len())]
    }

    /// Consumes the next token if it is this word, in any case. Returns whether it did.
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

    /// Parses words and a colon, with or without blanks around it.
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

    /// Parses a name: the rest of the line without surrounding blanks and without opening braces at its end, or up to a
    /// brace after which the joint starts on the same line. A name in this form can be written and read again.
    fn name(&mut self) -> Result<&'a [u8], BvhError> {
        self.skip_blanks();
        let rest = &self.text[self.at..];
        let length = rest.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(rest.len());
        let (line, after) = rest.split_at(length);
        let joint = (0..length).find(|&i| line[i] == b'{' && begins_joint(&line[i + 1..]));
        let line = line[..joint.unwrap_or(length)].trim_ascii_end();
        let begins = line.iter().rposition(|b| *b != b'{' && !b.is_ascii_whitespace()).map_or(0, |last| last + 1);
        // In Shift-JIS the second byte of a letter may have the value of a brace; another brace then opens the joint.
        let is_opened = || line.len() > begins + 1 || joint.is_some() || after.trim_ascii_start().starts_with(b"{");
        let is_letter = begins > 0 && encoding::leads(line[begins - 1]) && line.len() > begins && is_opened();
        let name = &line[..begins + usize::from(is_letter && line[begins] == b'{')];
        if name.is_empty() || name.len() > MAX_NAME_BYTES {
            return Err(self.unexpected("a joint name of 1 to 256 bytes"));
        }
        if name.contains(&b'\t') {
            let found = quotation(&encoding::name(name).0, MOST_SHOWN);
            return Err(BvhError::TabInName { line: self.line, found });
        }
        if name.iter().any(u8::is_ascii_control) {
            return Err(self.unexpected("a joint name without control characters"));
        }
        self.at += name.len();
        Ok(name)
    }

    /// Parses a whole number, saturated.
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

    /// Parses a number of absolute value at most [`MAX_ABS_VALUE`].
    fn bounded_number(&mut self) -> Result<f64, BvhError> {
        let begin = self.at;
        let value = self.any_number("a number")?;
        if value.abs() <= MAX_ABS_VALUE {
            return Ok(value);
        }
        self.at = begin;
        Err(BvhError::TooLarge { line: self.line, column: self.column(), found: self.shown() })
    }

    /// Parses a number up to a blank, line end or brace.
    fn any_number(&mut self, expected: &'static str) -> Result<f64, BvhError> {
        let Some((value, length)) = parse_prefix(&self.text[self.at..]) else {
            return Err(self.unexpected(expected));
        };
        match self.text.get(self.at + length) {
            None | Some(b' ' | b'\t' | b'\n' | b'\r' | b'{' | b'}' | 0 | 0x1A) => {
                self.at += length;
                Ok(value)
            }
            Some(b',') if self.text.get(self.at + length + 1).is_some_and(u8::is_ascii_digit) => {
                Err(BvhError::DecimalComma { line: self.line, column: self.column(), found: self.shown() })
            }
            Some(_) => Err(self.unexpected(expected)),
        }
    }

    fn column(&self) -> usize {
        self.at - self.line_begin + 1
    }

    /// Next token in the form that a message quotes.
    fn shown(&mut self) -> String {
        let token = self.token();
        if token.is_empty() {
            return if self.peek().is_none() { "the end of the file" } else { "a blank" }.to_owned();
        }
        let text = String::from_utf8_lossy(&token[..token.len().min(4 * MOST_SHOWN)]);
        let shown = quotation(&text, MOST_SHOWN);
        if shown.len() < token.len() && text.chars().count() > MOST_SHOWN {
            format!("'{shown}…'")
        } else {
            format!("'{shown}'")
        }
    }

    fn unexpected(&mut self, expected: &'static str) -> BvhError {
        // The token comes first: finding it may advance to a later line.
        let found = self.shown();
        BvhError::Unexpected { line: self.line, column: self.column(), found, expected }
    }
}
