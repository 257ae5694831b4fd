//! Small valid files from which edited files are made: built-in motions, generated once per process.

use std::ops::ControlFlow;
use std::sync::{Arc, LazyLock};
use strut_core::database::Database;
use strut_core::database::build::{self, BuildOptions, SourceClip};
use strut_core::hsmm::{self, LabelledClip, walk_of};
use strut_core::humanoid::{HumanoidMotion, Pose, Proportions};
use strut_core::parallel::Sequential;
use strut_core::search::Index;
use strut_core::somn::{self, Measure, Recording};
use strut_core::transfer::Model;
use strut_demo::{PUNCHES, RATE_HZ, STYLES, WALK_TAKES, perform, perform_drill};
use strut_formats::bvh::{self, Bvh, Channel};
use strut_formats::strutdb::packed;
use strut_formats::{GENERATOR, key_style_model, strutdb, walk_model};

/// Number of styles of the databases.
const DATABASE_STYLES: usize = 2;
/// Number of frames of the databases' clips: slightly more than a stride.
const CLIP_FRAMES: usize = 70;
/// Number of frames of the motion that databases are tested with.
const INPUT_FRAMES: usize = 24;
/// Number of frames of the clips that walk models are trained on.
const WALK_FRAMES: usize = 400;

/// A neutral walk at the demo's rate on the default body.
pub static WALK: LazyLock<HumanoidMotion> =
    LazyLock::new(|| perform(&WALK_TAKES[0], &STYLES[0], &Proportions::default(), RATE_HZ).motion);

/// The first frames of [`WALK`].
pub fn input() -> &'static [Pose] {
    &WALK.poses[..INPUT_FRAMES]
}

/// A database of a few short walks.
pub static DATABASE: LazyLock<Database> = LazyLock::new(|| {
    let clips: Vec<SourceClip> = STYLES[..DATABASE_STYLES]
        .iter()
        .map(|style| {
            let performance = perform(&WALK_TAKES[0], style, &Proportions::default(), RATE_HZ);
            let mut motion = performance.motion;
            motion.poses.truncate(CLIP_FRAMES);
            let time = performance.phase.iter().take(CLIP_FRAMES).copied().collect();
            SourceClip {
                name: format!("walk_{}", style.name),
                action: "walk".into(),
                style: style.name.into(),
                take: 1,
                motion,
                source: "procedural".into(),
                licence: String::new(),
                script: Some(build::Script { id: 1, time }),
            }
        })
        .collect();
    let options = BuildOptions { rate_hz: RATE_HZ, ..BuildOptions::default() };
    let (database, _) =
        build::build(&clips, &options, &Sequential, &mut |_| ControlFlow::Continue(())).expect("the clips are walks");
    database
});

/// [`DATABASE`] with its search index.
pub static MODEL: LazyLock<Arc<Model>> = LazyLock::new(|| Arc::new(Model::new(DATABASE.clone())));

/// [`DATABASE`] as a `.strutdb` file.
pub static STRUTDB: LazyLock<Vec<u8>> =
    LazyLock::new(|| strutdb::write(&DATABASE, &Index::build(&DATABASE).plan(), GENERATOR));

/// [`DATABASE`] and an input as packed motions.
pub static PACKED: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let motion = HumanoidMotion { poses: input().to_vec(), ..WALK.clone() };
    packed::write(&DATABASE, &[packed::NamedMotion { name: "walk".into(), motion }])
});

/// A `.strutwalk` file of two styles.
pub static WALK_MODEL: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let walks: Vec<_> = STYLES[..2]
        .iter()
        .map(|style| {
            let mut motion = perform(&WALK_TAKES[0], style, &Proportions::default(), RATE_HZ).motion;
            motion.poses.truncate(WALK_FRAMES);
            (style.name, walk_of(&motion).expect("it is a walk").0)
        })
        .collect();
    let clips: Vec<_> = walks.iter().map(|(style, track)| LabelledClip { style, track }).collect();
    let options = hsmm::Options::default();
    let model =
        hsmm::train(&Proportions::default(), &clips, options, &Sequential).expect("there are steps of both feet");
    walk_model::write(&model, GENERATOR)
});

/// A `.strutkeys` file with two axes.
pub static KEY_STYLE_MODEL: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let motion = perform_drill(&PUNCHES, &STYLES[0], &Proportions::default(), RATE_HZ).motion;
    let recording = Recording::new("punches", &motion).expect("the motion is finite");
    let axes = Measure::parse_list(AXES).expect("these are measures");
    let options = somn::Options { components: Some(4), ..somn::Options::default() };
    let model = somn::train(&[&recording], &axes, options).expect("punches vary in both");
    key_style_model::write(&model, GENERATOR)
});

/// Axes of [`KEY_STYLE_MODEL`].
pub const AXES: &str = "hips_height, hand_l.z - shoulder_l.z";

/// BVH files: our own skeleton, and one with other names, channels in other orders, positions everywhere and no end sites.
pub static BVH: LazyLock<[String; 2]> = LazyLock::new(|| {
    let motion = HumanoidMotion { poses: input().to_vec(), ..WALK.clone() };
    let own = Bvh::from_humanoid(&motion).expect("our motion is finite");
    let mut other = own.clone();
    let row = other.channels();
    other.frames = 12;
    other.values.truncate(12 * row);
    let (mut channels, mut values) = (0, Vec::new());
    let wide = other.joints.len() * 6;
    for joint in &mut other.joints {
        joint.name = format!("mixamorig:{}", joint.name);
        channels += joint.channels.len();
        joint.end_site = None;
    }
    assert_eq!(channels, row);
    for f in 0..other.frames {
        let mut at = 0;
        for joint in &other.joints {
            let [x, y, z] = joint.offset;
            let row = &own.row(f)[at..at + joint.channels.len()];
            at += joint.channels.len();
            let is_root = joint.parent.is_none();
            values.extend(if is_root { [row[0], row[1], row[2]] } else { [x, y, z] });
            values.extend(&row[row.len() - 3..]);
        }
    }
    assert_eq!(values.len(), other.frames * wide);
    for joint in &mut other.joints {
        let rotations = joint.channels.split_off(joint.channels.len() - 3);
        let positions = [bvh::Axis::X, bvh::Axis::Y, bvh::Axis::Z].map(Channel::Position);
        joint.channels = positions.into_iter().chain(rotations).collect();
    }
    other.values = values;
    [bvh::write_text(&own), bvh::write_text(&other)]
});
