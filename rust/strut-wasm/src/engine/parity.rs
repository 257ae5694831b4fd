//! Test that the engine computes the same bits natively and in WebAssembly.
//!
//! [`ParityReport`] runs the whole engine and hashes the output of every stage for every frame. The example `parity`
//! prints it natively; `tests/parity` compares that with the module that browsers load.

use crate::common::EngineError;
use crate::common::floats_of;
use crate::engine::clip_job::ClipJob;
use crate::engine::database::Database;
use crate::engine::input::Input;
use crate::engine::input_file::InputFile;
use crate::engine::packed_motions::PackedMotions;
use crate::engine::stylizer::Stylizer;
use std::fmt::Write;
use std::ops::ControlFlow;
use std::sync::Arc;
use strut_core::crowd::{self, Performers, Vertex, Walkers};
use strut_core::database::build::{BuildOptions, SourceClip, build};
use strut_core::hsmm::{
    JointPath, LabelledClip, Options as WalkOptions, PathOptions, RuntimeWalkModel, StyleMeans, Track, Walker,
    flattened, train, walk_of, walks_among,
};
use strut_core::humanoid::{Pose, Proportions, Role};
use strut_core::kinematics::world_from_local;
use strut_core::math::Vec3;
use strut_core::parallel::Sequential;
use strut_core::pose_vector::{HeadingFilter, Placement};
use strut_core::somn::{Learning, Measure, Options as LearningOptions, Recording, Trainer};
use strut_core::transfer::{Predictions, Recorder, StyledFrame};
use strut_formats::strutdb::packed::{self, NamedMotion};
use wasm_bindgen::prelude::wasm_bindgen;

/// Number of takes of the built-in walk that are registered again, without their known correspondence.
const REGISTERED_TAKES: u32 = 2;
/// Styles of the built-in walk that are registered again.
const REGISTERED_STYLES: [&str; 2] = ["neutral", "proud"];

/// Number of frames of the compared walk.
const WALK_FRAMES: usize = 600;

/// Number of walkers of the compared crowd, and its ticks.
const CROWD: usize = 50;
const CROWD_TICKS: usize = 300;

/// Number of frames of an input that a crowd performs, number of performers, and number of ticks, enough for every
/// performer to loop.
const PERFORMED_FRAMES: usize = 240;
const PERFORMERS: usize = 12;
const PERFORMED_TICKS: usize = 200;

/// Number of frames that are styled after a nudged one, enough to show its effect.
const FRAMES_AFTER_NUDGE: usize = 60;

/// Runs every stage on the built-in motions and on files.
#[wasm_bindgen]
#[derive(Default)]
pub struct ParityReport {
    files: Vec<(String, Vec<u8>)>,
}

#[wasm_bindgen]
impl ParityReport {
    /// Creates a report on the built-in motions.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a BVH file. Files named `SET_ACTION_STYLE_TAKE.bvh` also form a database.
    #[wasm_bindgen(js_name = addFile)]
    pub fn add_file(&mut self, name: &str, bytes: &[u8]) {
        self.files.push((name.into(), bytes.into()));
    }

    /// Returns one line per stage: its name, then a hash per frame, separated by blanks.
    ///
    /// With `nudged_frame` the input's root is one unit in the last place higher in that frame, after retargeting. If
    /// the report does not change, the comparison does not detect differences. Inputs end soon after that frame, and
    /// nothing else is reported after the first input.
    ///
    /// # Errors
    /// If a file cannot be read or nothing can be built from the files.
    pub fn run(&self, nudged_frame: Option<usize>) -> Result<String, EngineError> {
        let mut report = String::new();
        let synthesised = strut_demo::database().map_err(EngineError::bad_input)?;
        let packed = PackedMotions::new(packed::write(&synthesised, &built_in_inputs()));
        database_stages(&mut report, "synthesised database", &synthesised);
        let unpacked = packed.database()?;
        database_stages(&mut report, "built-in database", &unpacked);
        walk_stages(&mut report, &unpacked)?;
        learning_stages(&mut report, &unpacked)?;
        let database = Database::new(unpacked);
        for name in packed.inputs()? {
            let input = Input::from_packed(&database, &packed, &name)?;
            clip_stages(&mut report, &name, &database, &input, nudged_frame)?;
        }
        if nudged_frame.is_none() {
            performers_stage(&mut report, &database, &packed)?;
            database_stages(&mut report, "registered database", &registered(built_in_clips())?);
        }

        let mut clips = Vec::new();
        for (name, bytes) in &self.files {
            let input = Input::from_file(&database, InputFile::detect(bytes)?)?;
            clip_stages(&mut report, name, &database, &input, nudged_frame)?;
            clips.extend(labelled_clip(name, &input));
        }
        if nudged_frame.is_none() && !clips.is_empty() {
            database_stages(&mut report, "database of files", &registered(clips)?);
        }
        Ok(report)
    }
}

/// Reports every stage of styling one clip.
fn clip_stages(
    report: &mut String,
    name: &str,
    database: &Database,
    input: &Input,
    nudged_frame: Option<usize>,
) -> Result<(), EngineError> {
    let mut input = input.clone();
    if let Some(frame) = nudged_frame {
        let poses = input.poses_mut();
        poses.truncate(frame + FRAMES_AFTER_NUDGE);
        if let Some(pose) = poses.get_mut(frame) {
            pose.root.y = pose.root.y.next_up();
        }
    }
    let poses = &input.humanoid().poses;
    let mut stage = |stage: &str, hashes: Vec<u64>| line(report, name, stage, hashes);
    stage("retargeted", poses.iter().map(pose_hash).collect());
    stage("rows", row_hashes(database, poses));

    let mut online = Stylizer::new(database)?;
    online.set_styles(&mixed_styles(database))?;
    let mut whole = ClipJob::new(&online, &input);
    let (mut search, mut prediction, mut timing, mut contacts) = (vec![], vec![], vec![], vec![]);
    whole.run_traced(poses.len(), |trace| {
        let neighbours = trace.neighbours().flat_map(|n| [n.clip as u32, n.frame as u32, n.distance.to_bits()]);
        let weights = trace.class_weights.iter().chain([&trace.bias]).map(|w| w.to_bits());
        search.push(hash(neighbours.chain(weights)));
        prediction.push(pose_hash(&trace.frame.pose));
        timing.push(time_hash(trace.frame));
        contacts.push(hash(trace.frame.contact.map(f32::to_bits)));
    });
    stage("search", search);
    stage("prediction", prediction);
    stage("timing", timing);
    stage("contacts", contacts);

    let styled = online.push(&floats_of(poses.iter()))?;
    stage("online pose", styled.chunks_exact(styled.len() / poses.len()).map(float_hash).collect());
    let styled = whole.poses()?;
    stage("final pose", styled.chunks_exact(styled.len() / poses.len()).map(float_hash).collect());
    let bvh = whole.to_bvh(&input)?;
    stage("exported BVH", bvh.lines().map(|l| hash(l.bytes().map(u32::from))).collect());
    Ok(())
}

/// Reports a walk model of a database, one hash per style, and a walk with it that changes its style.
fn walk_stages(report: &mut String, db: &strut_core::database::Database) -> Result<(), EngineError> {
    let walks: Vec<(&str, Track)> = walks_among(db)
        .into_iter()
        .filter_map(|clip| {
            Some((db.styles[usize::from(db.clips[clip].style)].as_str(), walk_of(&db.motion_of_clip(clip)).ok()?.0))
        })
        .collect();
    let training: Vec<LabelledClip> = walks.iter().map(|(style, track)| LabelledClip { style, track }).collect();
    let model =
        train(&db.proportions, &training, WalkOptions::default(), &Sequential).map_err(EngineError::bad_input)?;
    let of_style = |m: &StyleMeans| {
        let numbers = flattened(&m.means).iter().chain(m.durations.as_flattened());
        hash(numbers.flat_map(|v| [v.to_bits() as u32, (v.to_bits() >> 32) as u32]))
    };
    line(report, "built-in walks", "model", model.means.iter().map(of_style).collect());

    let mut walker = Walker::new(Arc::new(RuntimeWalkModel::new(&model)));
    let alone = |style: usize, weight: f32| {
        let mut weights = vec![0.0; model.styles.len()];
        weights[style] = weight;
        weights
    };
    walker.set_styles(&alone(0, 1.5)).map_err(EngineError::bad_input)?;
    walker.plan_transition(6, 4, [&alone(1, -0.5), &alone(0, 0.5)]).map_err(EngineError::bad_input)?;
    walker.set_turn(0.05);
    let hashes = (0..WALK_FRAMES).map(|frame| {
        if frame == WALK_FRAMES / 2 {
            walker.set_variation(Some(7));
            walker.set_beat(113.0, 0.4);
        }
        pose_hash(walker.advance())
    });
    line(report, "built-in walks", "frames", hashes.collect());

    let runtime = RuntimeWalkModel::new(&model);
    let variances = [[1.0; 3], [1.0, 1000.0, 1000.0], [1.0, 1.0, 0.001]];
    let mut hashes = Vec::new();
    for variance in variances {
        let options = PathOptions { variance, rho: [1.1, 0.95] };
        let weights = alone(0, 1.5);
        let path = JointPath::new(&model, &runtime, [&weights, &weights], (Role::LeftUpperLeg, 0), options)
            .map_err(EngineError::bad_input)?;
        hashes.push(float_hash(&path.points.iter().map(|p| p.angle).collect::<Vec<_>>()));
    }
    line(report, "built-in walks", "paths", hashes);
    crowd_stage(report, runtime)
}

/// Reports a crowd with a style map and a route, one hash per tick.
fn crowd_stage(report: &mut String, runtime: RuntimeWalkModel) -> Result<(), EngineError> {
    let options = crowd::Options { count: CROWD, seed: 3 };
    let mut crowd = Walkers::new(Arc::new(runtime), options).map_err(EngineError::bad_input)?;
    let vertex = |style: usize, x: f32, intensity: f32| Vertex { style, x, z: 1.0, reach: 4.0, intensity };
    crowd.set_field(&[vertex(0, 3.0, 1.5), vertex(1, -4.0, -0.5)]).map_err(EngineError::bad_input)?;
    let mut hashes = Vec::new();
    for tick in 0..CROWD_TICKS {
        if tick == CROWD_TICKS / 2 {
            crowd.set_bones(Proportions::default()).map_err(EngineError::bad_input)?;
            crowd.set_route(&[[-5.0, -3.0], [0.0, 4.0], [5.0, -3.0]]).map_err(EngineError::bad_input)?;
        }
        crowd.tick();
        hashes
            .push(hash(crowd.world().iter().map(|v| v.to_bits()).chain(crowd.weights().iter().map(|w| u32::from(*w)))));
    }
    line(report, "built-in walks", "crowd", hashes);
    Ok(())
}

/// Reports a crowd that performs a walk with a style map, passed between packages as in the page; one hash per tick.
fn performers_stage(report: &mut String, database: &Database, packed: &PackedMotions) -> Result<(), EngineError> {
    let inputs = packed.inputs()?;
    let input = inputs.first().ok_or_else(|| EngineError::bad_input("there is no input"))?;
    let input = Input::from_packed(database, packed, input)?;
    let mut recorder = Recorder::new(Stylizer::new(database)?.core());
    input.humanoid().poses.iter().take(PERFORMED_FRAMES).for_each(|pose| recorder.push(pose));
    let numbers = recorder.finish().map(|of| of.to_floats()).unwrap_or_default();
    let predictions = Predictions::from_floats(&numbers).map_err(EngineError::bad_input)?;
    let options = crowd::Options { count: PERFORMERS, seed: 3 };
    let mut crowd = Performers::new(Arc::new(predictions), options).map_err(EngineError::bad_input)?;
    let vertex = |style: usize, x: f32, intensity: f32| Vertex { style, x, z: 1.0, reach: 4.0, intensity };
    let mut hashes = vec![float_hash(&numbers)];
    for tick in 0..PERFORMED_TICKS {
        if tick % (PERFORMED_TICKS / 2) == 0 {
            let field = [vertex(0, 3.0, 1.5), vertex(2, tick as f32 / 50.0 - 3.0, -0.5)];
            crowd.set_field(&field).map_err(EngineError::bad_input)?;
        }
        crowd.tick();
        hashes
            .push(hash(crowd.world().iter().map(|v| v.to_bits()).chain(crowd.weights().iter().map(|w| u32::from(*w)))));
    }
    line(report, "built-in walk", "performers", hashes);
    Ok(())
}

/// Reports the updates of a key-style model's training on one clip, with either signs, one hash per hundred updates.
fn learning_stages(report: &mut String, db: &strut_core::database::Database) -> Result<(), EngineError> {
    let clip = walks_among(db).into_iter().next().ok_or_else(|| EngineError::bad_input("there is no walk"))?;
    let recording = Recording::new("walk", &db.motion_of_clip(clip)).map_err(EngineError::bad_input)?;
    let axes = Measure::parse_list("foot_separation, foot_height_difference").map_err(EngineError::bad_input)?;
    for (name, learning) in [("learning", Learning::Som), ("learning as printed", Learning::AsPrinted)] {
        let options = LearningOptions { components: Some(4), seed: 1, learning };
        let mut trainer = Trainer::new(&[&recording], &axes, options).map_err(EngineError::bad_input)?;
        let mut hashes = Vec::new();
        while trainer.update().is_some() {
            if trainer.updates()[0].is_multiple_of(100) {
                let numbers =
                    trainer.components().iter().flat_map(|c| c.mean.iter().chain(&c.centre).chain([&c.weight]));
                hashes.push(hash(numbers.flat_map(|v| [v.to_bits() as u32, (v.to_bits() >> 32) as u32])));
            }
        }
        line(report, "built-in walk", name, hashes);
    }
    Ok(())
}

/// Reports every tensor of a database, one hash per clip.
fn database_stages(report: &mut String, name: &str, db: &strut_core::database::Database) {
    let per_frame = db.styles.len() * db.counterparts_per_style;
    let mut stage = |stage: &str, of_clip: &dyn Fn(std::ops::Range<usize>) -> u64| {
        line(report, name, stage, db.clips.iter().map(|c| of_clip(c.rows())).collect());
    };
    stage("pose", &|rows| float_hash(db.pose[rows].as_flattened()));
    stage("point cloud", &|rows| {
        let floats: Vec<f32> = db.point_cloud[rows].as_flattened().iter().flat_map(Vec3::to_array).collect();
        float_hash(&floats)
    });
    stage("canonical time", &|rows| float_hash(&db.canonical_time[rows]));
    stage("time step", &|rows| float_hash(&db.time_step[rows]));
    stage("contact", &|rows| hash(db.contact[rows].as_flattened().iter().map(|&c| c.into())));
    stage("counterpart", &|rows| float_hash(&db.counterpart[rows.start * per_frame..rows.end * per_frame]));
}

/// Returns two styles whose weights sum to more than 1, so that blending and extrapolation are included.
fn mixed_styles(database: &Database) -> Vec<f32> {
    let db = database.model().catalogue();
    let mut rest = [0.8, 0.4].into_iter();
    let neutral = usize::from(db.neutral);
    (0..db.styles.len()).map(|s| if s == neutral { 0.0 } else { rest.next().unwrap_or(0.0) }).collect()
}

fn row_hashes(database: &Database, poses: &[Pose]) -> Vec<u64> {
    let db = database.model().catalogue();
    let dt = 1.0 / db.rate_hz;
    let mut filter = HeadingFilter::default();
    let mut previous = None;
    let row_hash = |pose: &Pose| {
        let heading = filter.update(&world_from_local(&db.proportions, pose), dt);
        let row = db.chart.encode(pose, heading, previous, dt);
        previous = Some(Placement { x: pose.root.x, z: pose.root.z, heading });
        float_hash(&row)
    };
    poses.iter().map(row_hash).collect()
}

fn built_in_inputs() -> Vec<NamedMotion> {
    let named = |clip: strut_demo::NamedMotion| NamedMotion { name: clip.name.into(), motion: clip.motion };
    strut_demo::input_clips().into_iter().map(named).collect()
}

fn built_in_clips() -> Vec<SourceClip> {
    let mut clips = strut_demo::clips();
    clips.retain(|c| c.take <= REGISTERED_TAKES && REGISTERED_STYLES.contains(&c.style.as_str()));
    for clip in &mut clips {
        clip.script = None;
    }
    clips
}

/// Returns the clip of a file with labels in its name.
fn labelled_clip(name: &str, input: &Input) -> Option<SourceClip> {
    let words: Vec<&str> = name.strip_suffix(".bvh")?.split('_').collect();
    let [_, action, style, take] = words[..] else { return None };
    Some(SourceClip {
        name: name.into(),
        action: action.into(),
        style: style.into(),
        take: take.parse().ok()?,
        motion: input.humanoid().clone(),
        source: String::new(),
        licence: String::new(),
        script: None,
    })
}

fn registered(clips: Vec<SourceClip>) -> Result<strut_core::database::Database, EngineError> {
    build(&clips, &BuildOptions::default(), &Sequential, &mut |_| ControlFlow::Continue(()))
        .map(|(database, _)| database)
        .map_err(EngineError::bad_input)
}

fn line(report: &mut String, name: &str, stage: &str, hashes: Vec<u64>) {
    report.push_str(&format!("{name}/{stage}").replace(' ', "-"));
    for hash in hashes {
        // Writing to a string cannot fail.
        let _ = write!(report, " {hash:016x}");
    }
    report.push('\n');
}

fn pose_hash(pose: &Pose) -> u64 {
    float_hash(&floats_of([pose].into_iter()))
}

fn time_hash(frame: &StyledFrame) -> u64 {
    let out = frame.time_out_secs.to_bits();
    hash([frame.dt_secs.to_bits(), out as u32, (out >> 32) as u32])
}

fn float_hash(floats: &[f32]) -> u64 {
    hash(floats.iter().map(|v| v.to_bits()))
}

/// FNV-1a over 32-bit words.
fn hash(words: impl IntoIterator<Item = u32>) -> u64 {
    words.into_iter().fold(0xCBF2_9CE4_8422_2325, |h, w| (h ^ u64::from(w)).wrapping_mul(0x0100_0000_01B3))
}
