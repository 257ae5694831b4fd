//! Parsers: for any bytes they return a valid value, or an error with a message, and take no more memory than the
//! length of the bytes justifies.

use crate::memory::bounded;
use crate::{bases, edits};
use arbitrary::Unstructured;
use std::fmt::Display;
use std::str::FromStr;
use strut_core::database::Database;
use strut_core::humanoid::Pose;
use strut_core::search::Index;
use strut_core::somn::Measure;
use strut_formats::bvh;
use strut_formats::container::Kind;
use strut_formats::corpus::{Clip, Pattern, Table, assign, guess_pattern};
use strut_formats::strutdb::{self, packed};
use strut_formats::vmc::{FrameReader, Message, Performer, decode, encode};
use strut_formats::{key_style_model, style_keys, walk_model};

/// Words of BVH files.
pub(crate) const BVH_WORDS: [&str; 16] = [
    "HIERARCHY",
    "ROOT",
    "JOINT",
    "End",
    "Site",
    "End_Site",
    "{ OFFSET",
    "{",
    "}",
    "OFFSET",
    "CHANNELS",
    "MOTION",
    "Frames:",
    "Frame",
    "Time:",
    "Xrotation",
];

/// A text number of two bytes becomes one of eight, and then the rotation and the position of a joint.
const BVH_TIMES: u64 = 64;
/// A row of a database becomes a row, its points and those of its window.
const DATABASE_TIMES: u64 = 32;
/// Memory limit above which a database is refused; the edited ones need about as much.
const CATALOGUE_BYTES: u64 = 1 << 20;
/// A byte of packed motions is at least one number.
const PACKED_TIMES: u64 = 64;

/// Checks that an error is a message for users: not empty, on one line, and not long.
pub(crate) fn says_something(error: &impl Display) {
    let text = error.to_string();
    let length = text.chars().count();
    assert!((10..=2000).contains(&length), "an error of {length} characters: {text}");
    assert!(!text.contains('\n'), "an error of several lines: {text}");
}

/// Runs a target on the file that is derived from the bytes.
pub(crate) fn with_edited(
    data: &[u8],
    edit: impl FnOnce(&mut Unstructured<'_>) -> arbitrary::Result<Vec<u8>>,
    run: impl FnOnce(&[u8], &mut Unstructured<'_>),
) {
    let mut u = Unstructured::new(data);
    if let Ok(file) = edit(&mut u) {
        run(&file, &mut u);
    }
}

/// Arbitrary bytes as BVH.
pub(crate) fn bvh(data: &[u8]) {
    match bounded(data, BVH_TIMES, bvh::parse) {
        Err(e) => says_something(&e),
        Ok(file) => {
            assert!(file.values.iter().all(|v| v.abs() <= bvh::MAX_ABS_VALUE));
            assert_eq!(file.values.len(), file.frames * file.channels());
            // The value that was read is written, and is the same when it is read again.
            let text = bvh::write(&file);
            assert_eq!(bvh::parse(&text).as_ref(), Ok(&file));
            if let Err(e) = bounded(data, BVH_TIMES, Clip::parse) {
                says_something(&e);
            }
        }
    }
}

/// BVH files with a few changes.
pub(crate) fn bvh_edited(data: &[u8]) {
    with_edited(data, edited_bvh, |file, _| bvh(file));
}

/// Returns a changed BVH file.
pub(crate) fn edited_bvh(u: &mut Unstructured<'_>) -> arbitrary::Result<Vec<u8>> {
    let base = u.choose(&*bases::BVH)?;
    let text = edits::text(u, base, &BVH_WORDS)?;
    Ok(match u.int_in_range(0..=9)? {
        7 => format!("\u{FEFF}{}", String::from_utf8_lossy(&text)).encode_utf16().flat_map(u16::to_le_bytes).collect(),
        8 => text.iter().map(|b| if *b == b'\n' { b' ' } else { *b }).collect(),
        // Most names of joints have this letter; the second byte of its replacement is a brace.
        9 => text.split(|b| *b == b'g').collect::<Vec<_>>().join(&b"\x83{"[..]),
        _ => text,
    })
}

/// Arbitrary bytes as a database.
pub(crate) fn strutdb(data: &[u8]) {
    match bounded(data, DATABASE_TIMES, strutdb::read) {
        Err(e) => says_something(&e),
        Ok(contents) => {
            let database = &contents.database;
            assert_finite(database);
            if let Some(plan) = contents.plan {
                // A plan for other rows is refused; then the index is built.
                let _ = Index::from_plan(database, plan);
            }
        }
    }
    // Opened for styling, where it may be refused for its size.
    for most_bytes in [None, Some(CATALOGUE_BYTES)] {
        if let Err(e) = bounded(data, DATABASE_TIMES, |bytes| strutdb::read_catalogue(&bytes, most_bytes)) {
            says_something(&e);
        }
    }
}

fn assert_finite(database: &Database) {
    assert!(database.pose.iter().flatten().all(|v| v.is_finite()));
    assert!(database.canonical_time.iter().chain(&database.time_step).all(|v| v.is_finite()));
}

/// Databases with a few changes and the right checksum.
pub(crate) fn strutdb_edited(data: &[u8]) {
    with_edited(data, edited_database, |file, _| strutdb(file));
}

/// Returns a changed database.
pub(crate) fn edited_database(u: &mut Unstructured<'_>) -> arbitrary::Result<Vec<u8>> {
    edited(u, &bases::STRUTDB, strutdb::KIND)
}

/// Returns a changed file of a kind, or one with changed bytes but a correct checksum.
fn edited(u: &mut Unstructured<'_>, base: &[u8], kind: Kind) -> arbitrary::Result<Vec<u8>> {
    if u.ratio(1, 8)? {
        let mut file = edits::bytes(u, base)?;
        edits::enter_checksum(&mut file);
        return Ok(file);
    }
    edits::container(u, base, kind.entry)
}

/// Packed motions with a few changes.
pub(crate) fn packed_edited(data: &[u8]) {
    with_edited(
        data,
        |u| edits::bytes(u, &bases::PACKED),
        |file, _| {
            match bounded(file, PACKED_TIMES, packed::read_database) {
                Err(e) => says_something(&e),
                Ok(database) => assert_finite(&database),
            }
            for name in packed::input_names(file).unwrap_or_default() {
                match bounded(file, PACKED_TIMES, |bytes| packed::read_input(bytes, &name)) {
                    Err(e) => says_something(&e),
                    Ok(motion) => {
                        assert!(motion.iter().flat_map(|m| &m.poses).all(Pose::is_finite));
                    }
                }
            }
        },
    );
}

/// Returns a changed walk model.
pub(crate) fn edited_walk_model(u: &mut Unstructured<'_>) -> arbitrary::Result<Vec<u8>> {
    edited(u, &bases::WALK_MODEL, walk_model::KIND)
}

/// Walk models with a few changes.
pub(crate) fn walk_model_edited(data: &[u8]) {
    with_edited(data, edited_walk_model, |file, _| {
        if let Err(e) = bounded(file, DATABASE_TIMES, walk_model::read) {
            says_something(&e);
        }
    });
}

/// Returns a changed key-style model.
pub(crate) fn edited_key_style_model(u: &mut Unstructured<'_>) -> arbitrary::Result<Vec<u8>> {
    edited(u, &bases::KEY_STYLE_MODEL, key_style_model::KIND)
}

/// Key-style models with a few changes.
pub(crate) fn key_style_model_edited(data: &[u8]) {
    with_edited(data, edited_key_style_model, |file, _| {
        if let Err(e) = bounded(file, DATABASE_TIMES, key_style_model::read) {
            says_something(&e);
        }
    });
}

/// Tables of key styles.
pub(crate) fn style_keys(data: &[u8]) {
    let axes = Measure::parse_list(bases::AXES).expect("these are measures");
    let header = format!("time,\"{}\"\n", bases::AXES.split(", ").collect::<Vec<_>>().join("\",\""));
    let with_header = [header.as_bytes(), data].concat();
    for file in [data, &with_header] {
        match bounded(file, BVH_TIMES, |bytes| style_keys::parse(bytes, &axes)) {
            Err(e) => says_something(&e),
            Ok(keys) => {
                assert!(!keys.is_empty());
                assert!(keys.iter().all(|key| key.secs.is_finite() && key.style.iter().all(|v| v.is_finite())));
                assert!(keys.windows(2).all(|pair| pair[0].secs < pair[1].secs));
            }
        }
    }
}

/// Tables of labels, and the files that they name.
pub(crate) fn corpus_table(data: &[u8]) {
    let with_header = [b"file,action,style,take\n", data].concat();
    let name = |line: &str| format!("clips/{}", line.split(',').next().unwrap_or_default().trim());
    let paths: Vec<String> = String::from_utf8_lossy(data).lines().map(name).collect();
    for file in [data, &with_header] {
        match bounded(file, BVH_TIMES, Table::parse) {
            Err(e) => says_something(&e),
            Ok(table) => match assign(&paths, None, Some(&table)) {
                Err(e) => says_something(&e),
                Ok(labels) => assert_eq!(labels.len(), paths.len()),
            },
        }
    }
}

/// Patterns, and the labels that they find in names; and the pattern guessed from the names.
pub(crate) fn labels(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let mut lines = text.lines();
    let pattern = lines.next().unwrap_or_default();
    let names: Vec<&str> = lines.collect();
    match Pattern::from_str(pattern) {
        Err(e) => says_something(&e),
        Ok(pattern) => {
            assert_eq!(Pattern::from_str(&pattern.to_string()).as_ref(), Ok(&pattern));
            for name in &names {
                match pattern.labels(name) {
                    Err(e) => says_something(&e),
                    Ok(labels) => assert!(!labels.action.is_empty() && !labels.style.is_empty()),
                }
            }
        }
    }
    let _ = guess_pattern(&names);
}

/// Style variables.
pub(crate) fn expression(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    match bounded(data, BVH_TIMES, |_| Measure::parse_list(text)) {
        Err(e) => says_something(&e),
        Ok(measures) => {
            for measure in measures {
                let again = Measure::parse(measure.text()).expect("a measure's own text");
                assert_eq!(again.unit(), measure.unit());
            }
        }
    }
}

/// Packets of motion capture programs, several in a row; each is preceded by its length.
pub(crate) fn vmc(data: &[u8]) {
    let mut reader = FrameReader::default();
    let mut performer: Option<Performer> = None;
    let (mut rest, mut secs) = (data, 0.0);
    while let [low, high, packets @ ..] = rest {
        let length = usize::from(u16::from_le_bytes([*low, *high])).min(packets.len());
        let (packet, after) = packets.split_at(length);
        rest = after;
        secs += 0.01;
        let mut messages: Vec<Message> = Vec::new();
        if let Err(e) = decode(packet, &mut messages) {
            says_something(&e);
            continue;
        }
        // A message that was understood is sent again, and understood again.
        let mut again = Vec::new();
        for packet in encode(&messages) {
            decode(&packet, &mut again).expect("our own packet");
        }
        for frame in messages.iter().filter_map(|message| reader.push(message, secs)) {
            let performer = performer.get_or_insert_with(|| Performer::new(&frame, None));
            let pose = performer.pose(&frame);
            assert!(pose.is_finite(), "a frame gives {pose:?}");
        }
    }
}
