//! Text that is not UTF-8: files in UTF-16, and names in legacy encodings.
//!
//! The encoding of a name cannot be determined. Its bytes are kept and written back unchanged. The displayed name is
//! Japanese if the bytes are Shift-JIS of characters that occur in joint names; otherwise it has one letter per byte.

use std::borrow::Cow;

/// Code point of byte 0 in [`escaped`] text, which contains only bytes from 0x80 on. It is in a private-use area that
/// names do not contain.
const ESCAPED: u32 = 0x10_FE00;
/// Code point of byte 0 for bytes that would be control characters.
const LETTERS: u32 = 0x100;

/// Shift-JIS codes of the kanji in joint names, in order.
#[rustfmt::skip]
const KANJI: [(u16, char); 51] = [
    (0x88DA, '移'), (0x8945, '右'), (0x89A1, '横'), (0x89BA, '下'), (0x89F1, '回'), (0x8BB9, '胸'), (0x8CA8, '肩'), (0x8CB3, '元'),
    (0x8CE3, '後'), (0x8D98, '腰'), (0x8D9C, '骨'), (0x8DAA, '根'), (0x8DB6, '左'), (0x8DEC, '作'), (0x8E77, '指'), (0x8EE8, '手'),
    (0x8EF1, '首'), (0x8F95, '助'), (0x8FAC, '小'), (0x8FE3, '上'), (0x904B, '尻'), (0x9053, '心'), (0x9065, '親'), (0x9067, '身'),
    (0x906C, '人'), (0x909E, '裾'), (0x90E3, '舌'), (0x90E6, '先'), (0x914F, '前'), (0x9153, '全'), (0x9180, '操'), (0x91AB, '足'),
    (0x91B3, '袖'), (0x91CC, '体'), (0x9286, '中'), (0x935D, '転'), (0x93AA, '頭'), (0x93AE, '動'), (0x94AF, '髪'), (0x94BC, '半'),
    (0x94FB, '眉'), (0x9547, '膝'), (0x9549, '肘'), (0x9574, '付'), (0x95A0, '腹'), (0x95E2, '補'), (0x96DA, '目'), (0x96F2, '薬'),
    (0x97BC, '両'), (0x9872, '腕'), (0x9D80, '捩'),
];
/// Ranges of Shift-JIS that map to ranges of Unicode: first and last code of the range, first code point in Unicode.
#[rustfmt::skip]
const RUNS: [(u16, u16, u32); 10] = [
    (0x8140, 0x8140, 0x3000), (0x8145, 0x8145, 0x30FB), (0x8151, 0x8151, 0xFF3F), (0x815B, 0x815B, 0x30FC),
    (0x824F, 0x8258, 0xFF10), (0x8260, 0x8279, 0xFF21), (0x8281, 0x829A, 0xFF41),
    (0x829F, 0x82F1, 0x3041), (0x8340, 0x837E, 0x30A1), (0x8380, 0x8396, 0x30E0),
];

/// The text as UTF-8 without a byte order mark, and whether it was UTF-16.
pub(super) fn utf_8(bytes: &[u8]) -> (Cow<'_, [u8]>, bool) {
    let (text, unit): (_, fn([u8; 2]) -> u16) = match bytes {
        [0xFF, 0xFE, text @ ..] => (text, u16::from_le_bytes),
        [0xFE, 0xFF, text @ ..] => (text, u16::from_be_bytes),
        _ => return (bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).into(), false),
    };
    let mut out = Vec::with_capacity(text.len() / 2);
    for c in char::decode_utf16(text.as_chunks().0.iter().map(|pair| unit(*pair))) {
        let c = c.unwrap_or(char::REPLACEMENT_CHARACTER);
        out.extend_from_slice(c.encode_utf8(&mut [0; 4]).as_bytes());
    }
    (out.into(), true)
}

/// Displayed name, and the original bytes if they differ from its UTF-8 bytes.
pub(super) fn name(bytes: &[u8]) -> (String, Option<Vec<u8>>) {
    let plain =
        std::str::from_utf8(bytes).ok().filter(|name| !name.chars().any(|c| c.is_control() || byte(c).is_some()));
    if let Some(name) = plain {
        return (name.to_owned(), None);
    }
    let letter = |b: &u8| match b {
        0x80..0xA0 => char::from_u32(LETTERS + u32::from(*b)).unwrap_or(char::REPLACEMENT_CHARACTER),
        _ => char::from(*b),
    };
    (shift_jis(bytes).unwrap_or_else(|| bytes.iter().map(letter).collect()), Some(bytes.to_vec()))
}

/// Text decoded from Shift-JIS; `None` if a character is unknown.
fn shift_jis(mut bytes: &[u8]) -> Option<String> {
    let mut text = String::new();
    while let [first, rest @ ..] = bytes {
        bytes = rest;
        if first.is_ascii() {
            text.push(char::from(*first));
            continue;
        }
        let (second, rest) = bytes.split_first()?;
        bytes = rest;
        let code = u16::from_be_bytes([*first, *second]);
        let run = RUNS.iter().find(|(from, to, _)| (*from..=*to).contains(&code));
        text.push(match run {
            Some((from, _, first)) => char::from_u32(first + u32::from(code - from))?,
            None => KANJI[KANJI.binary_search_by_key(&code, |(code, _)| *code).ok()?].1,
        });
    }
    Some(text)
}

/// Returns whether a byte may be the first of two in Shift-JIS. The second may have the value of a brace.
pub(super) fn leads(byte: u8) -> bool {
    matches!(byte, 0x81..=0x9F | 0xE0..=0xFC)
}

/// Bytes of a name as characters, which [`unescaped`] converts back to bytes.
pub(super) fn escaped(bytes: &[u8]) -> impl Iterator<Item = char> {
    bytes.iter().map(|&b| match b {
        0x80.. => char::from_u32(ESCAPED + u32::from(b)).unwrap_or(char::REPLACEMENT_CHARACTER),
        _ => char::from(b),
    })
}

/// Bytes of a text whose names were [`escaped`].
pub(super) fn unescaped(text: &str) -> Vec<u8> {
    let mut out = Vec::with_capacity(text.len());
    for c in text.chars() {
        match byte(c) {
            Some(byte) => out.push(byte),
            None => out.extend_from_slice(c.encode_utf8(&mut [0; 4]).as_bytes()),
        }
    }
    out
}

/// Byte that a character represents in [`escaped`] text.
fn byte(c: char) -> Option<u8> {
    u8::try_from(u32::from(c).checked_sub(ESCAPED)?).ok().filter(|b| !b.is_ascii())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn kanji_are_in_order_for_the_search() {
        assert!(KANJI.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }

    #[test]
    fn names_in_shift_jis_are_seen_as_japanese() {
        let cases: [(&[u8], &str); 3] = [
            (b"\x89\xBA\x94\xBC\x90\x67", "下半身"),
            (b"\x8D\xB6\x82\xD0\x82\xB4", "左ひざ"),
            (b"\x83\x5A\x83\x93\x83\x5E\x81\x5B2", "センター2"),
        ];
        for (bytes, seen) in cases {
            assert_eq!(name(bytes), (seen.to_owned(), Some(bytes.to_vec())));
        }
    }

    #[test]
    fn other_names_are_seen_as_a_letter_a_byte() {
        assert_eq!(name(b"Gr\xF6\xDFe").0, "Größe");
        assert_eq!(name(b"\x8E\x77\x88").0, "\u{18E}w\u{188}");
        assert_eq!(name("Größe".as_bytes()), ("Größe".to_owned(), None));
    }

    proptest! {
        #[test]
        fn any_bytes_come_back_and_are_seen_without_control_characters(bytes in prop::collection::vec(0x20_u8.., 1..40)) {
            prop_assume!(!bytes.contains(&0x7F));
            let (seen, kept) = name(&bytes);
            prop_assert!(!seen.contains(char::is_control), "{seen:?}");
            let text = kept.map_or(seen, |kept| escaped(&kept).collect());
            prop_assert_eq!(unescaped(&text), bytes);
        }
    }
}
