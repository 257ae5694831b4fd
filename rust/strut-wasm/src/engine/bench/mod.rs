//! Additions for `npm run bench` and `bench.html`: motion, the times of a frame's stages, and a reference
//! implementation. The page's build does not contain them.

mod naive;
mod workload;

pub use naive::Naive;
pub use workload::Workload;

use crate::common::EngineError;
use crate::common::poses_of;
use crate::engine::database::Database;
use crate::engine::input::Input;
use crate::engine::stylizer::Stylizer;
use strut_core::kinematics::world_from_local;
use strut_core::math::Vec3;
use strut_core::pose_vector::{HeadingFilter, Placement};
use strut_core::search::{JOINT_WEIGHTS, Metric, Neighbours, QueryWindow, Scratch};
use strut_core::transfer::{Options, Stage, StageClock};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// Returns the time of JavaScript's clock, milliseconds; the core has no clock.
    #[wasm_bindgen(js_namespace = performance)]
    fn now() -> f64;
}

/// Time of every stage, milliseconds, summed over frames.
#[derive(Default)]
struct StopWatch {
    last: f64,
    stages_ms: [f64; Stage::ALL.len()],
}

impl StageClock for StopWatch {
    fn start(&mut self) {
        self.last = now();
    }

    fn end(&mut self, stage: Stage) {
        let end = now();
        self.stages_ms[stage as usize] += end - self.last;
        self.last = end;
    }
}

/// Returns the names of the stages in the order of [`Stylizer::push_timed`].
#[wasm_bindgen(js_name = stageNames)]
pub fn stage_names() -> Vec<String> {
    Stage::ALL.into_iter().map(|stage| stage.name().to_owned()).collect()
}

/// Returns the weight of every joint in the full-body metric; 0 for an unused joint. The sum is arbitrary.
#[wasm_bindgen(js_name = jointWeights)]
pub fn joint_weights() -> Vec<f32> {
    let mut weights = vec![0.0; strut_core::humanoid::JOINTS];
    for (role, weight) in JOINT_WEIGHTS {
        weights[role.index()] = weight;
    }
    weights
}

/// Returns the joints of the lower-body metric. The last four are both ankles and both toes, left before right.
#[wasm_bindgen(js_name = legJoints)]
pub fn leg_joints() -> Vec<usize> {
    JOINT_WEIGHTS[..8].iter().map(|(role, _)| role.index()).collect()
}

/// Creates an input of poses on a database's humanoid and at its rate.
///
/// # Errors
/// If the array is not a whole number of poses.
#[wasm_bindgen(js_name = inputOf)]
pub fn input_of(database: &Database, poses: &[f32]) -> Result<Input, EngineError> {
    let db = database.model().catalogue();
    Ok(Input::of_poses(db.proportions, db.rate_hz, poses_of(poses)?.collect()))
}

/// Returns the poses as the database's degrees of freedom, row by row, and …
///
/// # Errors
/// If the array is not a whole number of poses.
#[wasm_bindgen(js_name = rowsOf)]
pub fn rows_of(database: &Database, poses: &[f32]) -> Result<Vec<f32>, EngineError> {
    let db = database.model().catalogue();
    let dt = 1.0 / db.rate_hz;
    let (mut filter, mut previous) = (HeadingFilter::default(), None);
    let row = |pose: strut_core::humanoid::Pose| {
        let heading = filter.update(&world_from_local(&db.proportions, &pose), dt);
        let row = db.chart.encode(&pose, heading, previous, dt);
        previous = Some(Placement { x: pose.root.x, z: pose.root.z, heading });
        row
    };
    Ok(poses_of(poses)?.flat_map(row).collect())
}

/// … as world positions of the joints, metres.
///
/// # Errors
/// If the array is not a whole number of poses.
#[wasm_bindgen(js_name = positionsOf)]
pub fn positions_of(database: &Database, poses: &[f32]) -> Result<Vec<f32>, EngineError> {
    let proportions = &database.model().catalogue().proportions;
    let positions = |pose| world_from_local(proportions, &pose).positions;
    Ok(poses_of(poses)?.flat_map(positions).flat_map(|p: Vec3| p.to_array()).collect())
}

#[wasm_bindgen]
impl Stylizer {
    /// Sets the input's class, −1 for an unknown label, and the least weight of a class in use relative to the largest.
    /// The stream continues.
    ///
    /// # Errors
    /// If the database has no such class.
    #[wasm_bindgen(js_name = setClasses)]
    pub fn set_classes(&mut self, action: i32, input_style: i32, least_weight: f32) -> Result<(), EngineError> {
        let [action, input_style] = [action, input_style].map(|label| u16::try_from(label).ok());
        let options = Options { action, input_style, least_weight, ..*self.core().options() };
        self.core_mut().set_options(options).map_err(EngineError::bad_input)
    }

    /// Turns off the phase lock, as the reference implementations have none: each frame is timed independently.
    ///
    /// # Errors
    /// None: the options of a stylizer are valid.
    #[wasm_bindgen(js_name = leaveTempo)]
    pub fn leave_tempo(&mut self) -> Result<(), EngineError> {
        let options = Options { tempo: 0.0, ..*self.core().options() };
        self.core_mut().set_options(options).map_err(EngineError::bad_input)
    }

    /// [`Stylizer::push`] with a clock. Returns the milliseconds of each stage over all poses.
    ///
    /// # Errors
    /// If the array is not a whole number of poses.
    #[wasm_bindgen(js_name = pushTimed)]
    pub fn push_timed(&mut self, poses: &[f32]) -> Result<Vec<f64>, EngineError> {
        let mut clock = StopWatch::default();
        for pose in poses_of(poses)? {
            self.core_mut().push_timed(&pose, &mut clock);
        }
        Ok(clock.stages_ms.to_vec())
    }

    /// Returns the degrees of freedom predicted for a style in the last frame; empty if it has no weight.
    pub fn predicted(&self, style: usize) -> Vec<f32> {
        self.core().predicted_row(style).map(|row| row.to_vec()).unwrap_or_default()
    }

    /// Returns the duration of the last frame, seconds, and the probability of contact of the input's left and right
    /// foot before smoothing.
    #[wasm_bindgen(js_name = stepAndContacts)]
    pub fn step_and_contacts(&self) -> Vec<f32> {
        let [left, right] = self.core().contact_votes();
        vec![self.core().frame().dt_secs, left, right]
    }

    /// Returns the rows of a class that the search finds from a cold start for the last of these poses, nearest first.
    ///
    /// # Errors
    /// If the array is not a whole number of poses.
    #[wasm_bindgen(js_name = neighboursIn)]
    pub fn neighbours_in(&self, class: usize, k: usize, poses: &[f32]) -> Result<Vec<u32>, EngineError> {
        let (db, index) = (self.core().model().catalogue(), self.core().model().index());
        let (mut window, mut filter) = (QueryWindow::new(index.window_length()), HeadingFilter::default());
        for pose in poses_of(poses)? {
            window.follow(&pose, &db.proportions, db.rate_hz, &mut filter);
        }
        let (mut scratch, mut found) = (Scratch::default(), Neighbours::default());
        index.nearest(&index.prepare(&window, Metric::FullBody), &[class], k, &mut scratch, &mut found);
        Ok(found.as_slice().iter().map(|n| n.row).collect())
    }
}
