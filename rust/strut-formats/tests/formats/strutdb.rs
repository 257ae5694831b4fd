//! A database is unchanged after writing and reading, and every damage is detected.

use proptest::prelude::*;
use std::sync::OnceLock;
use strut_core::database::{Clip, Database, DatabaseParts};
use strut_core::humanoid::{JOINTS, Proportions};
use strut_core::math::float_funcs::sin;
use strut_core::math::{Quat, Vec3};
use strut_core::pose_vector::{DOFS, PoseChart, ROW};
use strut_core::search::Index;
use strut_formats::container::ContainerError;
use strut_formats::strutdb::{self, Contents, Metadata, StrutdbError};

/// Two actions, two styles, three clips of different lengths; all values are different.
fn small() -> Database {
    let clip = |name: &str, action, style, first_frame, frames| Clip {
        name: name.into(),
        action,
        style,
        take: 3,
        first_frame,
        frames,
        source: r#"a "quoted" \source\", "checksum":"12345678""#.into(),
        licence: "CC0 ü".into(),
    };
    let clips = vec![clip("a", 0, 0, 0, 4), clip("b", 0, 1, 4, 3), clip("c", 1, 0, 7, 2)];
    let n = 9;
    let number = |i: usize| sin(i as f32 * 0.731);
    let mut chart = PoseChart::default();
    chart.means[3] = Quat::from_rotation_x(0.4);
    let parts = DatabaseParts {
        rate_hz: 60.0,
        proportions: Proportions::default(),
        chart,
        actions: vec!["walk".into(), "run".into()],
        styles: vec!["neutral".into(), "proud".into()],
        neutral: 0,
        clips,
        pose: (0..n)
            .map(|f| std::array::from_fn::<f32, ROW, _>(|d| if d < DOFS { number(f * 71 + d) } else { 0.0 }))
            .collect(),
        point_cloud: (0..n).map(|f| [Vec3::new(number(f), number(f + 50), 1.0); JOINTS]).collect(),
        canonical_time: (0..n).map(|f| f as f32 * 0.5).collect(),
        time_step: (0..n).map(|f| 0.02 + f as f32 * 1e-3).collect(),
        contact: (0..n).map(|f| [(f % 2) as u8, (f % 3 == 0).into()]).collect(),
        counterparts_per_style: 3,
        counterpart: (0..n * 2 * 3).map(|i| if i % 3 == 2 { -1.0 } else { (i % 8) as f32 + 0.25 }).collect(),
    };
    Database::new(parts).unwrap()
}

fn file_of(db: &Database) -> Vec<u8> {
    strutdb::write(db, &Index::build(db).plan(), "test 1")
}

/// The file of [`small`], written once: thousands of cases change it.
fn small_file() -> Vec<u8> {
    static FILE: OnceLock<Vec<u8>> = OnceLock::new();
    FILE.get_or_init(|| file_of(&small())).clone()
}

fn error(bytes: &[u8]) -> String {
    strutdb::read(bytes).expect_err("refused").to_string()
}

/// The file with a part of its header replaced by text of the same length.
fn replaced(from: &str, to: &str) -> Vec<u8> {
    let mut bytes = small_file();
    let at = bytes.windows(from.len()).position(|w| w == from.as_bytes()).expect("occurs");
    bytes[at..at + to.len()].copy_from_slice(to.as_bytes());
    bytes
}

#[test]
fn a_database_comes_back_as_it_was() {
    let db = small();
    let file = file_of(&db);
    assert_eq!(*read(&file).database, *db);
    assert_eq!(file_of(&read(&file).database), file);
}

fn read(file: &[u8]) -> Contents {
    strutdb::read(file).unwrap()
}

#[test]
fn the_plan_of_the_search_index_comes_back_as_it_was() {
    let db = small();
    let file = file_of(&db);
    assert_eq!(read(&file).plan.unwrap(), Index::build(&db).plan());
    assert_eq!(read(&file).into_catalogue().index().plan(), Index::build(&db).plan());
}

#[test]
fn the_metadata_are_those_of_the_contract() {
    let file = small_file();
    let (_, header) = safetensors::SafeTensors::read_metadata(&file).unwrap();
    let json = &header.metadata().as_ref().unwrap()["strut"];
    let metadata: Metadata = serde_json::from_str(json).unwrap();
    assert_eq!((metadata.version.as_str(), metadata.generator.as_str()), ("1.0", "test 1"));
    assert_eq!(metadata.skeleton.parents[..3], [-1, 0, 1]);
    assert!((metadata.skeleton.offsets_cm[0][1] - 94.1).abs() < 1e-4);
    assert_eq!(metadata.pose_columns.len(), DOFS);
    assert_eq!((metadata.clips[1].action.as_str(), metadata.clips[1].style.as_str()), ("walk", "proud"));
}

#[test]
fn a_file_is_opened_in_parts_as_it_is_read() {
    let db = longer();
    let mut plan = Index::build(&db).plan();
    for damage in [false, true] {
        if damage {
            plan.points[1][4][2] += 500;
        }
        let file = strutdb::write(&db, &plan, "test");
        let [opened, expected] = [strutdb::read_catalogue(&file, Some(1 << 30)).unwrap(), read(&file).into_catalogue()];
        assert!(opened.index().plan() == Index::build(&db).plan());
        assert!(format!("{opened:?}") == format!("{expected:?}"));
    }
}

/// The database with clips so long that they are read in several parts.
fn longer() -> Database {
    let mut parts = (*small()).clone();
    let mut rows = 0;
    for (clip, frames) in parts.clips.iter_mut().zip([700, 3, 300]) {
        (clip.first_frame, clip.frames) = (rows, frames);
        rows += frames;
    }
    let row = |i: usize, period: usize| i % period;
    let (pose, cloud) = (parts.pose.clone(), parts.point_cloud.clone());
    let scaled = |i: usize| 1.0 + 0.3 * sin(i as f32 * 0.05);
    parts.pose = (0..rows).map(|i| pose[row(i, 9)].map(|v| v * scaled(i))).collect();
    parts.point_cloud = (0..rows).map(|i| cloud[row(i, 7)].map(|v| v * scaled(i))).collect();
    parts.canonical_time = (0..rows).map(|i| i as f32 * 0.5).collect();
    parts.time_step = (0..rows).map(|i| 0.02 + row(i, 9) as f32 * 1e-3).collect();
    parts.contact = (0..rows).map(|i| [(i % 2) as u8, (i % 3 == 0).into()]).collect();
    parts.counterpart = (0..rows * 6).map(|i| if i % 3 == 2 { -1.0 } else { (i % 900) as f32 + 0.25 }).collect();
    Database::new(parts).unwrap()
}

/// The header announces 50 million frames, which are neither in the file nor fit in memory.
#[test]
fn a_database_that_does_not_fit_is_refused_before_it_is_read() {
    let file = checked(|json| json.replacen(r#""frames":4"#, r#""frames":50000000"#, 1));
    let refusal = strutdb::read_catalogue(&file, Some(3_000_000_000)).expect_err("refused");
    assert!(
        matches!(refusal, StrutdbError::Memory { frames: 50_000_005, most: Some(3_000_000_000), .. }),
        "{refusal:?}"
    );
    let sentence = "the database has 50000005 frames: styling needs ";
    assert!(refusal.to_string().starts_with(sentence), "{refusal}");
    assert!(refusal.to_string().ends_with(" MB of memory; 3000 MB are available"), "{refusal}");
    let unlimited = strutdb::read_catalogue(&file, None).expect_err("refused");
    assert_eq!(unlimited.to_string(), "the database is not consistent: more than 4000000 frames");
    // More than any machine has, and more than the numbers can represent.
    let endless = checked(|json| json.replace(r#""frames":"#, r#""frames":1844674407370955161"#));
    let refusal = strutdb::read_catalogue(&endless, Some(u64::MAX)).expect_err("refused");
    assert!(matches!(refusal, StrutdbError::Memory { most: None, .. }), "{refusal:?}");
    assert!(refusal.to_string().ends_with(" MB of memory; less is available"), "{refusal}");
}

/// The small file with changed metadata, and their correct checksum.
fn checked(change: impl Fn(&str) -> String) -> Vec<u8> {
    let file = small_file();
    let (_, header) = safetensors::SafeTensors::read_metadata(&file).unwrap();
    let tensors = safetensors::SafeTensors::deserialize(&file).unwrap();
    with_checksum(&tensors.tensors(), &change(&header.metadata().as_ref().unwrap()["strut"]))
}

/// A file with these tensors, with a checksum computed as a reader in another language does.
fn with_checksum(views: &Views<'_>, json: &str) -> Vec<u8> {
    let mut json = json.to_owned();
    let at = json.find("\"checksum\":\"").unwrap() + 12;
    json.replace_range(at..at + 8, "00000000");
    let serialized = |json: String| {
        safetensors::serialize(views.clone(), Some(std::iter::once(("strut".to_owned(), json)).collect())).unwrap()
    };
    let sum = crc32fast::hash(&serialized(json.clone()));
    json.replace_range(at..at + 8, &format!("{sum:08x}"));
    serialized(json)
}

type Views<'a> = Vec<(String, safetensors::tensor::TensorView<'a>)>;

#[test]
fn further_tensors_are_ignored_but_missing_ones_named() {
    let file = small_file();
    let (_, header) = safetensors::SafeTensors::read_metadata(&file).unwrap();
    let tensors = safetensors::SafeTensors::deserialize(&file).unwrap();
    let with = |change: &dyn Fn(&mut Views)| {
        let mut views = tensors.tensors();
        change(&mut views);
        with_checksum(&views, &header.metadata().as_ref().unwrap()["strut"])
    };
    let more = with(&|views| {
        let extra = views[0].1.clone();
        views.push(("extra".into(), extra));
    });
    assert_eq!(*read(&more).database, *small());
    let without_index = with(&|views| views.retain(|(name, _)| name != "search_order"));
    assert_eq!(*read(&without_index).database, *small());
    assert_eq!(read(&without_index).plan, None);
    let wrong_index = with(&|views| {
        let times = views.iter().find(|(name, _)| name == "time_step").unwrap().1.clone();
        let order = safetensors::tensor::TensorView::new(safetensors::Dtype::U32, vec![9], times.data()).unwrap();
        views.iter_mut().find(|(name, _)| name == "search_order").unwrap().1 = order;
    });
    let is_accepted = |contents: Contents| Index::from_plan(&contents.database, contents.plan.unwrap()).is_ok();
    assert!(is_accepted(read(&file)) && !is_accepted(read(&wrong_index)));
    let less = with(&|views| views.retain(|(name, _)| name != "contact"));
    assert_eq!(error(&less), "the Strut database has no tensor 'contact'");
    let other = with(&|views| {
        let pose = views.iter().find(|(name, _)| name == "pose").unwrap().1.clone();
        views.iter_mut().find(|(name, _)| name == "time_step").unwrap().1 = pose;
    });
    assert_eq!(error(&other), "tensor 'time_step' is F32 [9, 67]; F32 [9] was expected");
}

#[test]
fn damage_is_described_in_a_sentence() {
    let file = small_file();
    assert_eq!(
        error(&file[..file.len() / 2]),
        "the file is cut short or damaged: its length does not agree with its header"
    );
    let no_database = "this is not a Strut database, or its beginning is damaged; a safetensors header was expected";
    assert_eq!(error(b""), no_database);
    assert_eq!(error(b"HIERARCHY\nROOT Hips\n{\n"), no_database);
    assert_eq!(
        error(&replaced("\\\"version\\\":\\\"1.0", "\\\"version\\\":\\\"2.0")),
        "the Strut database has version 2.0; this release of Strut reads version 1.0"
    );
    assert_eq!(error(&replaced("__metadata__", "__metadatb__")), no_database);
    let flipped = replaced("proud", "prouD");
    assert!(matches!(strutdb::read(&flipped), Err(StrutdbError::File(ContainerError::Checksum { .. }))));
    let other = safetensors::serialize(Vec::<(&str, safetensors::tensor::TensorView)>::new(), None).unwrap();
    assert_eq!(error(&other), "this safetensors file is not a Strut database: it has no 'strut' metadata");
}

/// The duration of a style's step is a ratio of two of these.
#[test]
fn time_steps_whose_ratios_are_no_numbers_are_refused() {
    for (secs, shown) in [(1e-40, "0.0000"), (0.0, "0"), (f32::INFINITY, "inf"), (f32::NAN, "NaN")] {
        let mut parts = (*small()).clone();
        parts.time_step[3] = secs;
        let refusal = Database::new(parts).expect_err("refused").to_string();
        assert!(refusal.contains("time_step") && refusal.contains(shown), "{refusal}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn every_changed_byte_is_noticed(at: prop::sample::Index, change in 1_u8..) {
        let mut file = small_file();
        let at = at.index(file.len());
        file[at] ^= change;
        let message = error(&file);
        prop_assert!(!message.contains('\n') && !message.is_empty());
    }

    #[test]
    fn every_cut_is_noticed(length: prop::sample::Index) {
        let file = small_file();
        prop_assert!(strutdb::read(&file[..length.index(file.len())]).is_err());
    }

    #[test]
    fn garbage_is_refused(mut bytes in prop::collection::vec(any::<u8>(), 0..300), header in 0_u64..300) {
        if let Some(first) = bytes.first_chunk_mut::<8>() {
            *first = header.to_le_bytes();
        }
        prop_assert!(strutdb::read(&bytes).is_err());
    }
}

mod packed {
    use super::small;
    use proptest::prelude::*;
    use strut_core::database::{Clip, Database, DatabaseParts};
    use strut_core::humanoid::{HumanoidMotion, Pose, Proportions, Role};
    use strut_core::math::{Quat, Vec3};
    use strut_core::pose_vector::{Placement, point_cloud};
    use strut_formats::container::ContainerError;
    use strut_formats::strutdb::StrutdbError;
    use strut_formats::strutdb::packed::{self, MAGIC, NamedMotion, ROW_STEP, STEP};

    /// The small database with point clouds that follow from the rows, as in every database that was built.
    fn built() -> Database {
        let db = small();
        let cloud = |row| point_cloud(&db.proportions, &db.chart.decode(row, Placement::default()), 0.0);
        Database::new(DatabaseParts { point_cloud: db.pose.iter().map(cloud).collect(), ..(*db).clone() }).unwrap()
    }

    /// Turns about the vertical while it travels, with angles of more than half a turn.
    fn input(name: &str, frames: u16) -> NamedMotion {
        let pose = |f: u16| {
            let t = f32::from(f) * 0.2;
            let mut pose = Pose { root: Vec3::new(t, 0.9, -t * t), ..Pose::default() };
            pose.rotations[0] = Quat::from_rotation_y(t);
            pose.rotations[Role::Chest.index()] = Quat::from_rotation_x(0.3 * t);
            pose
        };
        let poses = (0..frames).map(pose).collect();
        NamedMotion {
            name: name.into(),
            motion: HumanoidMotion { proportions: Proportions::default(), rate_hz: 60.0, poses },
        }
    }

    fn file() -> Vec<u8> {
        packed::write(&built(), &[input("a", 40), input("“b”", 3)])
    }

    #[test]
    fn a_database_comes_back_to_within_half_a_step() {
        let (db, back) = (built(), packed::read_database(&file()).unwrap());
        assert_eq!((&back.clips, &back.actions, &back.styles), (&db.clips, &db.actions, &db.styles));
        assert_eq!((back.neutral, &back.contact, back.chart), (db.neutral, &db.contact, db.chart));
        assert_eq!((back.rate_hz, &back.canonical_time), (db.rate_hz, &db.canonical_time));
        for (a, b) in db.pose.iter().flatten().zip(back.pose.iter().flatten()) {
            assert!((a - b).abs() <= 0.501 * STEP, "{a} {b}");
        }
        for (a, b) in db.counterpart.iter().zip(&back.counterpart) {
            assert!((a - b).abs() <= 0.501 * ROW_STEP && (*a < 0.0) == (*b < 0.0), "{a} {b}");
        }
        for (a, b) in db.point_cloud.iter().flatten().zip(back.point_cloud.iter().flatten()) {
            assert!((*a - *b).length() < 2e-3, "{a} {b}");
        }
    }

    #[test]
    fn motions_come_back_by_name() {
        let file = file();
        assert_eq!(packed::input_names(&file).unwrap(), ["a", "“b”"]);
        assert_eq!(packed::read_input(&file, "c").unwrap(), None);
        for input in [input("a", 40), input("“b”", 3)] {
            let back = packed::read_input(&file, &input.name).unwrap().unwrap();
            assert_eq!((back.poses.len(), back.proportions), (input.motion.poses.len(), input.motion.proportions));
            for (a, b) in input.motion.poses.iter().zip(&back.poses) {
                assert!((a.root - b.root).length() < STEP);
                assert!(a.rotations.iter().zip(&b.rotations).all(|(a, b)| a.dot(*b).abs() > 1.0 - 1e-6));
            }
        }
    }

    /// Position of a clip in a header: the length of its name, the name, action, style, take and frames, a byte each.
    fn entry_of(clip: &Clip, header: &[u8]) -> usize {
        let name = clip.name.as_bytes();
        let [action, style] = [clip.action, clip.style].map(|index| index as u8);
        let entry = [&[name.len() as u8], name, &[action, style, clip.take as u8, clip.frames as u8]].concat();
        header.windows(entry.len()).position(|window| window == entry).unwrap()
    }

    /// The database of one clip of [`built`] and one input, then the whole database.
    fn sets() -> (Vec<u8>, Vec<u8>) {
        let db = built();
        let others: Vec<usize> = (1..db.clips.len()).collect();
        let first = packed::write(&db.without_clips(&others).unwrap(), &[input("“b”", 3)]);
        let mut both = first.clone();
        packed::append(&mut both, &db, &[input("a", 40), input("“b”", 3)]).unwrap();
        (first, both)
    }

    #[test]
    fn a_set_takes_from_the_one_before_what_it_has() {
        let (first, both) = sets();
        assert_eq!(packed::input_names(&first).unwrap(), ["“b”"]);
        assert_eq!(packed::input_names(&both).unwrap(), ["a", "“b”"]);
        assert_eq!(packed::read_database(&first).unwrap().clips.len(), 1);
        let (stored, whole) = (packed::read_database(&both).unwrap(), packed::read_database(&file()).unwrap());
        assert_eq!(*stored, *whole);
        for name in ["a", "“b”"] {
            assert_eq!(packed::read_input(&both, name).unwrap(), packed::read_input(&file(), name).unwrap());
        }
        let poses = |file: &[u8]| file.len() - packed::write(&built(), &[]).len();
        assert!(poses(&both) < poses(&file()) + first.len(), "the second set stores the first again");
    }

    #[test]
    fn a_set_with_another_clip_of_the_same_name_is_refused() {
        let (mut first, db) = (sets().0, built());
        let mut parts = (*db).clone();
        parts.chart.means[1] = Quat::from_rotation_y(0.5);
        let turned = Database::new(parts).unwrap();
        assert_eq!(packed::append(&mut first, &turned, &[]), Err(StrutdbError::Layout("joints")));
        // A second set that contains a clip of the first set several times.
        let (first, both) = sets();
        let mut second = both[first.len()..].to_vec();
        for clip in &db.clips {
            let name = entry_of(clip, &second) + 1;
            second[name] = db.clips[0].name.as_bytes()[0];
        }
        let hostile = [first, second].concat();
        assert_eq!(packed::read_database(&hostile).unwrap_err(), StrutdbError::Layout("clips"));
    }

    #[test]
    fn another_file_is_refused_with_a_sentence() {
        assert_eq!(packed::read_database(&super::file_of(&built())).unwrap_err(), StrutdbError::NotPacked);
        assert_eq!(packed::input_names(b"").unwrap_err(), StrutdbError::NotPacked);
        let mut newer = file();
        newer[MAGIC.len() - 1] += 1;
        assert_eq!(packed::read_database(&newer).unwrap_err(), StrutdbError::NotPacked);
    }

    /// A file that announces more frames than it contains makes the reader allocate no memory for them.
    #[test]
    fn claimed_frames_need_bytes() {
        let (db, mut bytes) = (built(), file());
        let frames = entry_of(&db.clips[0], &bytes) + 5;
        // 3,999,900 in LEB128.
        bytes.splice(frames..=frames, [0x9C, 0x91, 0xF4, 0x01]);
        assert_eq!(packed::read_database(&bytes).unwrap_err(), StrutdbError::File(ContainerError::Length));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn damage_never_panics(at: prop::sample::Index, change in 1_u8..) {
            for mut file in [file(), sets().1] {
                let at = at.index(file.len());
                file[at] ^= change;
                let _ = (packed::read_database(&file), packed::read_input(&file, "a"));
            }
        }

        #[test]
        fn every_cut_is_noticed(length: prop::sample::Index) {
            let file = file();
            prop_assert!(packed::read_database(&file[..length.index(file.len())]).is_err());
            let (first, both) = sets();
            let length = length.index(both.len());
            prop_assert!(length == first.len() || packed::read_database(&both[..length]).is_err());
        }
    }
}
