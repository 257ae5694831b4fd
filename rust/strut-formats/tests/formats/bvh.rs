//! Tests of the BVH reader: accepted files, rejected files with their messages, and lossless round trips.

use proptest::prelude::*;
use strut_formats::bvh::{self, Axis, Bvh, Channel, Joint};

const WALK: &str = "HIERARCHY
ROOT Hips
{
\tOFFSET 0 90 0
\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
\tJOINT Left Leg
\t{
\t\tOFFSET 10 -5 0
\t\tCHANNELS 3 Zrotation Xrotation Yrotation
\t\tEnd Site
\t\t{
\t\t\tOFFSET 0 -40 0
\t\t}
\t}
}
MOTION
Frames: 2
Frame Time: 0.0333333
0 91 2 0 0 90 10 20 30
0.5 91.5 2.5 1e1 -1.5E-2 +91 .5 5. -0
";

fn error(text: &str) -> String {
    bvh::parse(text.as_bytes()).expect_err("refused").to_string()
}

#[test]
fn reads_joints_channels_and_values() {
    let file = bvh::parse(WALK.as_bytes()).unwrap();
    assert_eq!(file.joints[1].name, "Left Leg");
    assert_eq!(file.joints[1].parent, Some(0));
    assert_eq!(file.joints[1].end_site, Some([0.0, -40.0, 0.0]));
    assert_eq!(file.joints[0].channels[3], Channel::Rotation(Axis::Z));
    assert_eq!((file.frames, file.frame_time_secs), (2, 0.033_333_3));
    assert_eq!(file.row(1), [0.5, 91.5, 2.5, 10.0, -0.015, 91.0, 0.5, 5.0, 0.0]);
}

#[test]
fn reads_every_usual_spelling_alike() {
    let expected = bvh::parse(WALK.as_bytes()).unwrap();
    let spellings = [
        WALK.replace('\n', "\r\n"),
        WALK.replace('\n', "\r"),
        format!("\u{FEFF}{WALK}"),
        format!("\n  {}\n\n \t\n", WALK.trim_end()),
        WALK.replace("End Site", "END SITE").replace("JOINT", "joint").replace("OFFSET", "Offset"),
        WALK.replace("Frames: ", "Frames:\t").replace("Frame Time: ", "Frame Time:\t"),
        WALK.replace("Frames: ", "Frames:").replace("Frame Time: ", "Frame  Time :"),
        WALK.replace("Hips\n{", "Hips {").replace("Leg\n\t{", "Leg{").replace("Zrotation", "ZROTATION"),
        WALK.replace(" 30\n", " 30 \t\n\n").replace("0 91 2", "\t0\t91   2"),
        WALK.trim_end().to_owned(),
    ];
    for text in spellings {
        assert_eq!(bvh::parse(text.as_bytes()).as_ref(), Ok(&expected), "{text:?}");
    }
}

#[test]
fn says_where_a_file_is_wrong_and_what_was_expected() {
    let replaced = |from: &str, to: &str| {
        assert!(WALK.contains(from), "{from}");
        error(&WALK.replacen(from, to, 1))
    };
    let cut = |after: &str| error(&WALK[..WALK.find(after).unwrap() + after.len()]);
    let cases = [
        (error(""), "the file is empty; a BVH file begins with HIERARCHY"),
        (error(" \r\n\t "), "the file is empty; a BVH file begins with HIERARCHY"),
        (error("Dear all,\n"), "line 1, column 1 has 'Dear'; HIERARCHY was expected"),
        (error("\0\0\0"), "line 1, column 1 has '\u{FFFD}\u{FFFD}\u{FFFD}'; HIERARCHY was expected"),
        (replaced("OFFSET 10 -5 0", "OFFSET 10 -5"), "line 9, column 3 has 'CHANNELS'; a number was expected"),
        (replaced("OFFSET 10 -5 0", "OFFSET 10 x 0"), "line 8, column 13 has 'x'; a number was expected"),
        (replaced("\tOFFSET 0 90 0\n", ""), "line 5, column 2 has 'JOINT'; OFFSET was expected"),
        (replaced("CHANNELS 3", "CHANNELS x"), "line 9, column 12 has 'x'; the number of channels was expected"),
        (replaced("CHANNELS 3", "CHANNELS 300"), "line 9 declares 300 channels; at most 12 per joint are supported"),
        (
            replaced("CHANNELS 3", "CHANNELS 4"),
            "line 10, column 3 has 'End'; a channel such as Xposition or Zrotation was expected",
        ),
        (replaced("Yposition", "Xposition"), "line 5 has Xposition twice on one joint; once was expected"),
        (replaced("ROOT Hips", "ROOT"), "line 3, column 1 has '{'; a joint name of 1 to 256 bytes was expected"),
        // A name that ends in a brace could not be written.
        (replaced("Left Leg", "Left Leg {{"), "line 6, column 18 has '{'; OFFSET was expected"),
        (
            replaced("Left Leg", "Left\tLeg"),
            "line 6 has the joint name 'Left\u{FFFD}Leg' with a tab in it; spaces or underscores were expected",
        ),
        (
            replaced("Left Leg", "Left\u{7}Leg"),
            "line 6, column 8 has 'Left\u{FFFD}Leg'; a joint name without control characters was expected",
        ),
        (replaced("Frames: 2", "Frames: 1000000000"), "line 17 declares 1000000000 frames; 1 to 1000000 were expected"),
        (
            replaced("\t}\n}", "\t}\n}\nROOT Other\n{"),
            "line 16 begins a second ROOT; one skeleton per file is supported",
        ),
        (replaced("\t\t}\n\t}", "\t\t}\n\t\tEnd Site\n\t}"), "line 15, column 2 has '}'; { was expected"),
        (replaced("MOTION", "Motion?"), "line 16, column 1 has 'Motion?'; MOTION was expected"),
        (replaced("Frames: 2", "Frames 2"), "line 17, column 8 has '2'; 'Frames:' was expected"),
        (replaced("Frames: 2", "Frames: 0"), "line 17 declares 0 frames; 1 to 1000000 were expected"),
        (replaced("Frames: 2", "Frames: -2"), "line 17, column 9 has '-2'; the number of frames was expected"),
        (
            replaced("Frames: 2", "Frames: 99999999999999999999999"),
            "line 17 declares 18446744073709551615 frames; 1 to 1000000 were expected",
        ),
        (replaced("Frames: 2", "Frames: 300"), "the file declares 300 frames; the rest of the file can hold at most 3"),
        (replaced("0.0333333", "0"), "line 18 has a frame time of 0 s; 0.0001 to 10 s were expected"),
        (replaced("0.0333333", "-0.03"), "line 18 has a frame time of -0.03 s; 0.0001 to 10 s were expected"),
        (replaced("0.0333333", "nan"), "line 18, column 13 has 'nan'; the frame time in seconds was expected"),
        (replaced(" 30\n", "\n"), "line 19 has 8 numbers; this skeleton needs 9"),
        (replaced(" 30\n", " 30 40\n"), "line 19 has 10 numbers; this skeleton needs 9"),
        (replaced("0 91 2", "0 NaN 2"), "line 19, column 3 has 'NaN'; a number was expected"),
        (
            replaced("0 91 2", "0 1,5 2"),
            "line 19, column 3 has '1,5', a decimal comma; decimal points were expected. Export the file again with \
             English number formatting",
        ),
        (replaced("0 91 2", "0 inf 2"), "line 19, column 3 has 'inf'; a number was expected"),
        (replaced("0 91 2", "0 1e30 2"), "line 19, column 3 has '1e30'; a number within ±10000000 was expected"),
        (replaced("0 91 2", "0 -1e999 2"), "line 19, column 3 has '-1e999'; a number within ±10000000 was expected"),
        (cut("JOINT Left Leg"), "line 6, column 16 has the end of the file; { was expected"),
        (cut("OFFSET 10 -5"), "line 8, column 15 has the end of the file; a number was expected"),
        (cut("-40 0\n\t\t}"), "line 13, column 4 has the end of the file; JOINT, End Site or '}' was expected"),
        (cut("\n}\n"), "line 16, column 1 has the end of the file; MOTION was expected"),
        (cut("0 91 2 0"), "line 19 has 4 numbers; this skeleton needs 9"),
    ];
    for (found, expected) in cases {
        assert_eq!(found, expected);
    }
}

/// The file of a changed walk, and the codes of its notes.
fn noted(text: &str) -> (Bvh, Vec<&'static str>) {
    let (file, notes) = bvh::parse_noted(text.as_bytes()).unwrap_or_else(|e| panic!("{e}\n{text}"));
    (file, notes.iter().map(|note| note.code.name()).collect())
}

#[test]
fn a_clean_file_gets_no_note() {
    assert_eq!(noted(WALK), (bvh::parse(WALK.as_bytes()).unwrap(), vec![]));
}

#[test]
fn what_other_programs_write_is_read_with_a_note() {
    let walk = bvh::parse(WALK.as_bytes()).unwrap();
    let rows = WALK.find("0 91 2").unwrap();
    let joined = [&WALK[..rows], &WALK[rows..].replace('\n', " ")].concat();
    let cases = [
        (WALK.replacen("Frames: 2", "Frames: 3", 1), vec!["frame-count"]),
        (WALK.replacen("Frames: 2", "Frames: 1", 1), vec!["frame-count"]),
        (WALK.replacen("20 30\n", "\n20 30\n", 1), vec!["rows"]),
        (WALK.replacen("20 30\n", "\n20 30\n", 1).replacen("Frames: 2", "Frames: 1", 1), vec!["rows", "frame-count"]),
        ([WALK.trim_end(), "\u{1A}"].concat(), vec![]),
        (joined, vec!["rows"]),
        ([WALK, "\u{1A}\0\0"].concat(), vec![]),
        ([WALK, "# made by hand\n"].concat(), vec!["text-after"]),
        (WALK.replacen("End Site", "End", 1), vec!["hierarchy"]),
        (WALK.replacen("End Site", "EndSite", 1), vec!["hierarchy"]),
        (WALK.replacen("End Site", "End_Site", 1), vec!["hierarchy"]),
        ([WALK, &"# made by hand\n".repeat(1000)].concat(), vec!["text-after"]),
        ([WALK, "v1.2 of the exporter\n"].concat(), vec!["text-after"]),
        (WALK.replacen("End Site", "End Site tip", 1), vec!["hierarchy"]),
        (WALK.replacen("0 -40 0\n", "0 -40 0\n\t\t\tCHANNELS 0\n", 1), vec!["hierarchy"]),
        (WALK.replacen("\t\t}\n\t}", "\t\t}\n\t\tEnd Site\n\t\t{\n\t\tOFFSET 1 1 1\n\t\t}\n\t}", 1), vec!["hierarchy"]),
    ];
    for (text, expected) in cases {
        let (file, codes) = noted(&text);
        assert_eq!((codes, &file), (expected, &walk), "{text}");
    }
}

#[test]
fn a_last_row_that_was_cut_off_is_left_out() {
    let (file, codes) = noted(WALK.trim_end().rsplit_once(' ').unwrap().0);
    assert_eq!((file.frames, codes), (1, vec!["frame-count"]));
    // Also if the remaining number of frames is the announced one.
    let (file, notes) = bvh::parse_noted([WALK, "1 2 3\n"].concat().as_bytes()).unwrap();
    assert_eq!((file.frames, notes.len()), (2, 1));
    assert_eq!(notes[0].text, "The file declares 2 frames and has 2. Its last row is incomplete and was left out.");
}

#[test]
fn damaged_rows_are_refused_although_the_numbers_make_whole_frames() {
    let rows = WALK.find("0 91 2").unwrap();
    let damaged = |text: &str| error(&[&WALK[..rows], text].concat());
    // A number of the second row is in the first row.
    assert_eq!(damaged("1 2 3 4 5 6 7 8 9 10\n2 3 4 5 6 7 8 9\n"), "line 19 has 10 numbers; this skeleton needs 9");
    assert_eq!(damaged("1 2 3 4 5 6 7 8\n1 2 3 4 5 6 7 8 9 10\n"), "line 19 has 8 numbers; this skeleton needs 9");
    // Rows that are too short and too long by the same number, with any rows between them.
    for (rows, line, found) in [
        ("1 2 3 4 5 6 7 8\n1 2 3 4 5 6 7 8 9\n1 2 3 4 5 6 7 8 9 10\n", 19, 8),
        ("1 2 3 4 5 6 7 8 9\n1 2 3 4 5 6\n1 2 3 4 5 6 7 8 9 10 11 12\n", 20, 6),
        ("1 2 3 4 5 6 7 8 9 10 11 12\n1 2 3 4 5 6 7 8 9\n1 2 3 4 5 6\n", 19, 12),
    ] {
        assert_eq!(damaged(rows), format!("line {line} has {found} numbers; this skeleton needs 9"));
    }
    // The last row: complete, together with the one before it, or cut off while rows are missing.
    for last in
        ["x0.5 2 3 4 5 6 7 8 9\n", "x0.5 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9\n", "x0.5 2 3\n", "x0.5 2 3 4 5 6\n# end\n"]
    {
        let error = damaged(&["1 2 3 4 5 6 7 8 9\n", last].concat());
        assert_eq!(error, "line 20, column 1 has 'x0.5'; a number was expected");
    }
}

#[test]
fn a_hierarchy_may_be_on_one_line() {
    let walk = bvh::parse(WALK.as_bytes()).unwrap();
    let (hierarchy, motion) = WALK.split_at(WALK.find("MOTION").unwrap());
    let on_one_line = hierarchy.split_ascii_whitespace().collect::<Vec<_>>().join(" ");
    let all = WALK.split_ascii_whitespace().collect::<Vec<_>>().join(" ");
    let cases = [
        (format!("{on_one_line}\n{motion}"), vec![]),
        (format!("{on_one_line} {motion}"), vec![]),
        (format!("{}\n{motion}", on_one_line.replace(" {", "{").replace("{ ", "{")), vec![]),
        (WALK.replace("\n{\n", " {\n").replace("\n\t{\n", " {\n").replace("\n\t\t{\n", " {\n"), vec![]),
        (WALK.replace("\n\tCHANNELS", " CHANNELS").replace("\n\t\tCHANNELS", " CHANNELS"), vec![]),
        (WALK.replace("\n\t{\n\t\tOFFSET", "\t{\tOFFSET"), vec![]),
        (WALK.replace("End Site\n\t\t{\n", "End Site tip {"), vec!["hierarchy"]),
        (all, vec!["rows"]),
    ];
    for (text, expected) in cases {
        let (file, codes) = noted(&text);
        assert_eq!((codes, &file), (expected, &walk), "{text}");
    }
}

#[test]
fn names_are_the_rest_of_their_line_also_with_braces() {
    for name in [
        "Left Leg",
        "Left {OFFSET} Leg",
        "Left {OFFSET",
        "a{b",
        "{a} OFFSET 1",
        "OFFSET 1 2 3",
        "Leg { CHANNELS",
        "左足",
    ] {
        for brace in ["\n{", "{", " {", " { "] {
            let text = WALK.replacen("Left Leg\n\t{", &[name, brace].concat(), 1);
            assert_eq!(noted(&text).0.joints[1].name, name, "{text}");
        }
    }
}

#[test]
fn utf_16_is_read_and_written_as_utf_8() {
    let text = WALK.replace("Left Leg", "左足");
    let walk = bvh::parse(text.as_bytes()).unwrap();
    let units = || format!("\u{FEFF}{text}").encode_utf16().collect::<Vec<u16>>();
    let little: Vec<u8> = units().iter().flat_map(|unit| unit.to_le_bytes()).collect();
    let big: Vec<u8> = units().iter().flat_map(|unit| unit.to_be_bytes()).collect();
    for bytes in [little, big] {
        let (file, notes) = bvh::parse_noted(&bytes).unwrap();
        assert_eq!(file, walk);
        assert_eq!(notes.len(), 1);
        assert_eq!(notes[0].text, "The file is in UTF-16. It is written back in UTF-8.");
        assert_eq!(bvh::parse_noted(&bvh::write(&file)).unwrap(), (file.clone(), vec![]));
        assert_eq!(bvh::parse_hierarchy(&bytes).unwrap().joints, walk.joints);
        // Half a character at the end is ignored.
        assert!(bvh::parse(&bytes[..bytes.len() - 1]).is_ok());
    }
}

/// A walk whose second joint has a name of these bytes, followed by `brace` before `OFFSET`.
fn named(name: &[u8], brace: &str) -> Vec<u8> {
    let (before, after) = WALK.split_once("Left Leg\n\t{\n").unwrap();
    [before.as_bytes(), name, brace.as_bytes(), after.as_bytes()].concat()
}

#[test]
fn names_in_other_encodings_are_written_back_as_they_came() {
    let cases: [(&[u8], &str); 6] = [
        // Shift-JIS; the second name has a letter whose last byte has the value of a brace.
        (b"\x8D\xB6\x91\xAB", "左足"),
        (b"\x8D\xB6\x83\x7B", "左ボ"),
        (b"Gr\xF6\xDFe", "Größe"),
        (b"\xCD\xEE\xE3\xE0 1", "Íîãà 1"),
        (b"\x8E\x84", "\u{18E}\u{184}"),
        // Valid UTF-8 of a control character.
        (b"\xC2\x85", "Â\u{185}"),
    ];
    for (bytes, seen) in cases {
        for brace in ["\n{\n", " {\n", "{\n", "{", "{ "] {
            let (file, notes) = bvh::parse_noted(&named(bytes, brace)).unwrap();
            let joint = &file.joints[1];
            assert_eq!((joint.name.as_str(), joint.name_bytes.as_deref()), (seen, Some(bytes)));
            assert!(!joint.name.contains(char::is_control));
            assert_eq!(notes.len(), 1);
            assert_eq!(notes[0].text, "Names from line 6 on are not in UTF-8. They are written back byte for byte.");
            let written = bvh::write(&file.with_motion(&file.to_motion().unwrap()).unwrap());
            assert!(written.windows(bytes.len()).any(|w| w == bytes));
            assert_eq!(bvh::parse(&written).unwrap().joints, file.joints);
        }
    }
}

#[test]
fn joints_without_channels_cannot_need_more_memory_than_there_is() {
    let joints = "JOINT j\n{\nOFFSET 0 1 0\n".repeat(511);
    let text = format!(
        "HIERARCHY\nROOT r\n{{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n{joints}{}MOTION\nFrames: 140000\nFrame Time: 0.1\n{}",
        "}\n".repeat(512),
        "0\n".repeat(140_000)
    );
    assert_eq!(
        error(&text),
        "the file has 140000 frames of 512 joints; at most 67108864 joints in all frames are supported"
    );
}

#[test]
fn a_frame_time_in_milliseconds_is_taken_as_such_where_the_motion_has_small_steps() {
    // The second frame of the walk differs strongly from the first.
    let slow = WALK.replacen("0.0333333", "8.33", 1);
    assert_eq!(noted(&slow).0.frame_time_secs, 8.33);
    let smooth = |time: &str| {
        [&slow[..slow.find("0 91 2").unwrap()], "1 2 3 4 5 6 7 8 9\n1 2 3 4 5 6 7 8 10\n"]
            .concat()
            .replacen("8.33", time, 1)
    };
    for (time, secs) in [("8.33", 0.00833), ("16.667", 0.016_667), ("33.3", 0.0333)] {
        let (file, codes) = noted(&smooth(time));
        assert_eq!(codes, ["milliseconds"]);
        assert!((file.frame_time_secs - secs).abs() < 1e-12);
    }
    assert_eq!(noted(&smooth("0.5")).1, [""; 0]);
    assert_eq!(error(&smooth("400")), "line 18 has a frame time of 400 s; 0.0001 to 10 s were expected");
}

#[test]
fn positions_that_would_fold_up_the_body_are_added_to_the_offsets() {
    let joint = |i: usize| format!("JOINT j{i}\n{{\nOFFSET 0 {i} 1\nCHANNELS 3 Xposition Yposition Zposition\n");
    let joints: String = (1..=4).map(joint).collect();
    let text = |value: &str| {
        let values = [value; 12].join(" ");
        format!(
            "HIERARCHY\nROOT r\n{{\nOFFSET 0 0 0\nCHANNELS 0\n{joints}{}MOTION\nFrames: 1\nFrame Time: 0.1\n{values}\n",
            "}\n".repeat(5)
        )
    };
    let (file, codes) = noted(&text("0"));
    assert_eq!(codes, ["added-positions"]);
    let motion = file.to_motion().unwrap();
    assert_eq!(motion.translations_at(0)[3].to_array(), [0.0, 3.0, 1.0]);
    assert_eq!(file.with_motion(&motion).unwrap(), file);
    assert_eq!(noted(&text("2")).1, [""; 0]);
}

#[test]
fn refuses_ten_thousand_joints_at_the_first_too_many() {
    let joint = " j\n{\nOFFSET 0 1 0\nCHANNELS 1 Xrotation\n";
    let text = ["HIERARCHY\nROOT", &vec![joint; 10_000].join("JOINT")].concat();
    assert_eq!(error(&text), "line 2050 begins joint 513; at most 512 are supported");
}

#[test]
fn position_channels_replace_the_offset_on_their_axis() {
    let text = WALK.replace("CHANNELS 3 Zrotation Xrotation Yrotation", "CHANNELS 3 Zrotation Yposition Yrotation");
    let motion = bvh::parse(text.as_bytes()).unwrap().to_motion().unwrap();
    assert_eq!(motion.translations_at(0)[0].to_array(), [0.0, 91.0, 2.0]);
    assert_eq!(motion.translations_at(0)[1].to_array(), [10.0, 20.0, 0.0]);
}

#[test]
fn rotations_apply_in_channel_order() {
    use strut_core::math::{Quat, Vec3};
    let motion = bvh::parse(WALK.as_bytes()).unwrap().to_motion().unwrap();
    let [z, x, y] = [10.0_f32, 20.0, 30.0].map(f32::to_radians);
    let expected = Quat::from_rotation_z(z) * Quat::from_rotation_x(x) * Quat::from_rotation_y(y);
    let found = motion.rotations_at(0)[1];
    assert!((found * Vec3::X - expected * Vec3::X).length() < 1e-6);
    assert!((found * Vec3::Y - expected * Vec3::Y).length() < 1e-6);
}

#[test]
fn a_motion_of_another_hierarchy_is_refused() {
    let file = bvh::parse(WALK.as_bytes()).unwrap();
    let mut other = file.clone();
    other.joints.pop();
    assert_eq!(
        other.with_motion(&file.to_motion().unwrap()).unwrap_err().to_string(),
        "the motion has 2 joints; this file has 1"
    );
}

#[test]
fn a_motion_that_could_not_be_read_back_is_refused() {
    let file = bvh::parse(WALK.as_bytes()).unwrap();
    for value in [f32::NAN, f32::INFINITY, 1e30] {
        let mut motion = file.to_motion().unwrap();
        motion.translations[2].y = value;
        let error = file.with_motion(&motion).unwrap_err().to_string();
        assert!(error.starts_with("frame 1 of the motion moves joint 'Hips' by "), "{error}");
        let mut motion = file.to_motion().unwrap();
        motion.rotations[3].x = f32::NAN;
        assert!(file.with_motion(&motion).is_err());
    }
}

fn channels() -> impl Strategy<Value = Vec<Channel>> {
    let axis = || prop_oneof![Just(Axis::X), Just(Axis::Y), Just(Axis::Z)];
    let rotations = prop::collection::vec(axis().prop_map(Channel::Rotation), 0..5);
    let positions = prop::sample::subsequence(vec![Axis::X, Axis::Y, Axis::Z], 0..=3)
        .prop_map(|axes| axes.into_iter().map(Channel::Position).collect::<Vec<_>>());
    (rotations, positions).prop_map(|(r, p)| [r, p].concat()).prop_shuffle()
}

fn offset() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(prop_oneof![Just(0.0), -1e3..1e3, -1e-7..1e-7, -1e7..=1e7])
}

/// Random trees: each joint is attached to the path to the joint before it, so that subtrees are contiguous.
fn hierarchy() -> impl Strategy<Value = Vec<Joint>> {
    let joint =
        ("[A-Za-z_][A-Za-z0-9_:. ]{0,12}[a-z0-9]", offset(), channels(), prop::option::of(offset()), 0_usize..4);
    prop::collection::vec(joint, 1..12).prop_map(|parts| {
        let mut joints: Vec<Joint> = Vec::new();
        for (name, offset, channels, end_site, up) in parts {
            let mut parent = joints.len().checked_sub(1);
            for _ in 0..up {
                parent = parent.and_then(|p| joints[p].parent).or(parent);
            }
            joints.push(Joint { name, name_bytes: None, parent, offset, channels, end_site });
        }
        joints
    })
}

fn document() -> impl Strategy<Value = Bvh> {
    // From 4 s on a frame time may be milliseconds.
    (hierarchy(), 1e-4..4.0f64, 1_usize..5)
        .prop_filter("a channel", |(joints, ..)| joints.iter().any(|j| !j.channels.is_empty()))
        .prop_flat_map(|(joints, frame_time_secs, frames)| {
            let channels: usize = joints.iter().map(|j| j.channels.len()).sum();
            let value = prop_oneof![-200.0..200.0, -1e7..=1e7, Just(0.0), -1e-9..1e-9];
            prop::collection::vec(value, frames * channels).prop_map(move |values| Bvh {
                added_positions: false,
                joints: joints.clone(),
                frame_time_secs,
                frames,
                values,
            })
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn reading_what_was_written_gives_the_same_document(document in document()) {
        let read = bvh::parse(&bvh::write(&document)).unwrap();
        // Whether positions are added is determined from the numbers.
        prop_assert_eq!(&read, &Bvh { added_positions: read.added_positions, ..document });
    }

    #[test]
    fn motion_survives_the_way_through_the_file(mut document in document()) {
        for v in &mut document.values {
            *v %= 400.0;
        }
        let motion = document.to_motion().unwrap();
        let written = document.with_motion(&motion).unwrap();
        prop_assert_eq!(&written.joints, &document.joints);
        let back = written.to_motion().unwrap();
        for (a, b) in motion.translations.iter().zip(&back.translations) {
            prop_assert!((*a - *b).abs().max_element() <= 1e-4 * (1.0 + 1e-3 * a.length()), "{a} {b}");
        }
        for (a, b) in motion.rotations.iter().zip(&back.rotations) {
            prop_assert!(a.inv_mul(*b).angle() < 1e-4, "{a:?} {b:?}");
        }
    }

    #[test]
    fn damaged_text_is_read_or_refused_without_panic(at in 0..WALK.len(), byte: u8, cut: bool) {
        let mut bytes = WALK.as_bytes().to_vec();
        bytes[at] = byte;
        if cut {
            bytes.truncate(at);
        }
        if let Ok(file) = bvh::parse(&bytes) {
            prop_assert_eq!(file.values.len(), file.frames * file.channels());
            prop_assert!(file.to_motion().is_ok());
        }
    }
}

#[test]
fn angles_run_on_where_a_turn_passes_half_a_circle() {
    let mut file = bvh::parse(WALK.as_bytes()).unwrap();
    file.frames = 80;
    file.values = (0..80).flat_map(|f| [0.0, 90.0, 0.0, 1.0, 2.0, f64::from(f) * 10.0, 0.0, 0.0, 0.0]).collect();
    let written = file.with_motion(&file.to_motion().unwrap()).unwrap();
    for f in 0..80 {
        assert!((written.row(f)[5] - file.row(f)[5]).abs() < 1e-3, "{} {}", f, written.row(f)[5]);
    }
}
