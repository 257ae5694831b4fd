//! Handle of a lens.

use crate::common::{EngineError, floats_of, poses_of};
use crate::engine::database::Database;
use crate::engine::input::Input;
use std::sync::Arc;
use strut_core::humanoid::{HumanoidMotion, Pose};
use strut_core::transfer::{self, FitSettings, Options, QueryChange};
use wasm_bindgen::prelude::wasm_bindgen;

/// Numbers per turned joint: its index and the three of the rotation vector.
const TURN: usize = 4;

/// Reads the change of a query from numbers: four per turned joint.
fn change(turns: &[f32], heading: f32, shift: [f32; 2], reversed: bool) -> Result<QueryChange, EngineError> {
    let (turns, rest) = turns.as_chunks::<TURN>();
    if !rest.is_empty() {
        return Err(EngineError::bad_input("turns are four numbers each: a joint, and an axis times an angle"));
    }
    // The cast saturates; an invalid joint is refused below.
    let turns = turns.iter().map(|&[joint, x, y, z]| (joint as usize, [x, y, z]));
    QueryChange::new(turns, heading, shift, reversed).map_err(EngineError::bad_input)
}

#[wasm_bindgen]
impl Input {
    /// Returns a walk or run of the built-in database in the neutral style, by the name of its take such as
    /// "walk-pace"; `undefined` if there is none.
    #[wasm_bindgen(js_name = ofTake)]
    pub fn of_take(database: &Database, name: &str) -> Option<Self> {
        let catalogue = database.model().catalogue();
        let performed = strut_demo::counterpart(name, &catalogue.styles[usize::from(catalogue.neutral)])?;
        Some(Self::of_poses(catalogue.proportions, catalogue.rate_hz, performed.poses))
    }

    /// Returns this input with joints turned in every frame: for each joint its index, and a rotation vector in its
    /// parent's frame, radians. The whole body is turned about the vertical through the first frame's hips by
    /// `heading`, radians.
    ///
    /// # Errors
    /// If there is no such joint, or a number is not finite.
    pub fn turned(&self, turns: &[f32], heading: f32) -> Result<Self, EngineError> {
        let change = change(turns, heading, [0.0; 2], false)?;
        let poses = &self.humanoid().poses;
        let about = poses.first().map_or_else(Default::default, |pose| pose.root);
        let poses = poses.iter().map(|pose| change.applied(pose, about)).collect();
        let HumanoidMotion { proportions, rate_hz, .. } = *self.humanoid();
        Ok(Self::of_poses(proportions, rate_hz, poses))
    }
}

/// Inspection of one frame of a style transfer.
#[wasm_bindgen]
pub struct Lens {
    lens: transfer::Lens,
    change: QueryChange,
}

#[wasm_bindgen]
impl Lens {
    /// Creates a lens on an input in these styles, one weight per style of the database, with the default options.
    ///
    /// # Errors
    /// If the input is too short, or the weights are invalid.
    #[wasm_bindgen(constructor)]
    pub fn new(database: &Database, input: &Input, styles: &[f32]) -> Result<Self, EngineError> {
        let (model, poses) = (Arc::clone(database.model()), input.humanoid().poses.clone());
        let lens = transfer::Lens::new(model, poses, Options::DEFAULT, styles).map_err(EngineError::bad_input)?;
        Ok(Self { lens, change: QueryChange::default() })
    }

    /// Sets the options that lessons change.
    ///
    /// # Errors
    /// If one is out of range; the former options are then kept.
    pub fn configure(
        &mut self,
        k: f64,
        lambda: f32,
        rho: f32,
        kappa: f32,
        delta: f32,
        coherence: bool,
    ) -> Result<(), EngineError> {
        // The cast saturates; an invalid count becomes 0 or too large, and is refused.
        let options =
            Options { k: k as usize, lambda, rho, kappa, delta, coherence, ..*self.lens.stylizer().options() };
        self.lens.set_options(options).map_err(EngineError::bad_input)
    }

    /// Sets one weight per style of the database.
    ///
    /// # Errors
    /// If there is not one finite weight per style; the former weights are then kept.
    #[wasm_bindgen(js_name = setStyles)]
    pub fn set_styles(&mut self, weights: &[f32]) -> Result<(), EngineError> {
        self.lens.set_styles(weights).map_err(EngineError::bad_input)
    }

    /// Selects a frame. Returns the selected one, the nearest that has two frames before it.
    pub fn at(&mut self, frame: usize) -> usize {
        self.lens.look_at(frame);
        self.lens.frame()
    }

    /// Changes the query of neighbours and profiles: for each turned joint its index and a rotation vector in its
    /// parent's frame; a turn about the vertical and a shift on the ground; whether time runs backwards. Returns the
    /// query's pose.
    ///
    /// # Errors
    /// If there is no such joint, or a number is not finite.
    pub fn query(
        &mut self,
        turns: &[f32],
        heading: f32,
        x: f32,
        z: f32,
        reversed: bool,
    ) -> Result<Vec<f32>, EngineError> {
        self.change = change(turns, heading, [x, z], reversed)?;
        Ok(floats_of([self.lens.query_pose(&self.change)].iter()))
    }

    /// Returns λⱼ and Dⱼ in m² of every class, interleaved.
    pub fn classes(&mut self) -> Vec<f32> {
        self.lens.classes().iter().flat_map(|c| [c.weight, c.mean_square]).collect()
    }

    /// Returns the class with the largest weight.
    #[wasm_bindgen(js_name = heaviestClass)]
    pub fn heaviest_class(&self) -> Option<usize> {
        self.lens.heaviest_class()
    }

    /// Returns the first row of a class; its rows are consecutive.
    ///
    /// # Errors
    /// If there is no such class.
    #[wasm_bindgen(js_name = firstRow)]
    pub fn first_row(&self, class: usize) -> Result<usize, EngineError> {
        let class = self.lens.model().catalogue().classes().get(class);
        class.map(|c| c.rows.start).ok_or_else(|| EngineError::bad_input("there is no such class"))
    }

    /// Returns the `k` windows of `length` frames in a class that are nearest to the query, nearest first.
    ///
    /// # Errors
    /// If there is no such class.
    pub fn neighbours(&self, class: usize, k: usize, length: usize) -> Result<NearestWindows, EngineError> {
        let found = self.lens.neighbours(class, k, length, &self.change).map_err(EngineError::bad_input)?;
        Ok(NearestWindows {
            rows: found.iter().map(|n| n.row as u32).collect(),
            distances: found.iter().map(|n| n.square.sqrt()).collect(),
            weights: found.iter().map(|n| n.weight).collect(),
        })
    }

    /// Returns √D in metres between the query and the window of `length` frames that ends at each row of a class; NaN
    /// where no window ends.
    ///
    /// # Errors
    /// If there is no such class.
    pub fn profile(&self, class: usize, length: usize) -> Result<Vec<f32>, EngineError> {
        let squares = self.lens.profile(class, length, &self.change).map_err(EngineError::bad_input)?;
        Ok(squares.into_iter().map(f32::sqrt).collect())
    }

    /// Returns the pose of a row of the database above the origin, heading along +Z.
    ///
    /// # Errors
    /// If there is no such row.
    #[wasm_bindgen(js_name = rowPose)]
    pub fn row_pose(&self, row: usize) -> Result<Vec<f32>, EngineError> {
        self.lens.row_pose(row).map(|pose| floats_of([pose].iter())).map_err(EngineError::bad_input)
    }

    /// Returns the degrees of freedom of every frame of the input: 68 numbers per frame, of which the last is padding.
    pub fn rows(&self) -> Vec<f32> {
        self.lens.rows().concat()
    }

    /// Returns the mean rotation of each joint, x y z w: the centres of the exponential maps.
    pub fn means(&self) -> Vec<f32> {
        self.lens.model().catalogue().chart.means.iter().flat_map(|q| q.to_array()).collect()
    }

    /// Returns the styled pose of the frame.
    pub fn styled(&self) -> Vec<f32> {
        floats_of([self.lens.stylizer().frame().pose].iter())
    }

    /// Returns the duration of the styled frame, seconds.
    #[wasm_bindgen(js_name = stepSecs)]
    pub fn step_secs(&self) -> f32 {
        self.lens.stylizer().frame().dt_secs
    }

    /// Fits one degree of freedom in the class with the largest weight, for the style with the largest weight.
    ///
    /// # Errors
    /// If a setting is out of range.
    pub fn fit(&self, dof: usize, k: usize, lambda: f32, noise: f32, taper: bool) -> Result<Fit, EngineError> {
        self.lens.fit(&FitSettings { dof, k, lambda, noise, taper }).map(Fit).map_err(EngineError::bad_input)
    }

    /// Returns, for each λ, the root mean square error of one degree of freedom against the input's counterpart. It is
    /// predicted over the whole input from its own past.
    ///
    /// # Errors
    /// If a setting is out of range, or there is not one pose per frame.
    pub fn sweep(
        &mut self,
        dof: usize,
        k: usize,
        lambdas: &[f32],
        noise: f32,
        taper: bool,
        ideal: &[f32],
    ) -> Result<Vec<f32>, EngineError> {
        let ideal: Vec<Pose> = poses_of(ideal)?.collect();
        let settings = FitSettings { dof, k, lambda: 0.0, noise, taper };
        self.lens.sweep(&settings, lambdas, &ideal).map_err(EngineError::bad_input)
    }

    /// Returns the neighbours' estimate of the frame's duration in a style with a weight.
    ///
    /// # Errors
    /// If there is no such style, or it has no weight.
    pub fn timing(&self, style: usize) -> Result<FrameTiming, EngineError> {
        self.lens.timing(style).map(FrameTiming).map_err(EngineError::bad_input)
    }

    /// Returns the neighbours' votes on foot contacts.
    pub fn contacts(&self) -> FrameContacts {
        FrameContacts(self.lens.contacts())
    }
}

/// Windows similar to a query, nearest first.
#[wasm_bindgen]
pub struct NearestWindows {
    rows: Vec<u32>,
    distances: Vec<f32>,
    weights: Vec<f32>,
}

#[wasm_bindgen]
impl NearestWindows {
    /// Returns the last row of each window.
    pub fn rows(&self) -> Vec<u32> {
        self.rows.clone()
    }

    /// Returns √D of each window, metres.
    pub fn distances(&self) -> Vec<f32> {
        self.distances.clone()
    }

    /// Returns the weight of each window in regressions, 0 to 1.
    pub fn weights(&self) -> Vec<f32> {
        self.weights.clone()
    }
}

/// A fitted line; see [`transfer::Fit`].
#[wasm_bindgen]
pub struct Fit(transfer::Fit);

#[wasm_bindgen]
impl Fit {
    /// Returns the class of the examples.
    pub fn class(&self) -> usize {
        self.0.class
    }

    /// Returns the neighbours' rows, nearest first.
    pub fn rows(&self) -> Vec<u32> {
        self.0.rows.iter().map(|&row| row as u32).collect()
    }

    /// Returns xₜ, xₜ₋₁, yₜ, yₜ₋₁ and v of the neighbours, column by column.
    pub fn columns(&self) -> Vec<f32> {
        let transfer::Fit { x, x_previous, y, y_previous, weights, .. } = &self.0;
        [&x[..], x_previous, y, y_previous, weights].concat()
    }

    /// Returns the coefficients a, b, c of xₜ₋₁, yₜ₋₁ and xₜ; these three values of the query; the means of xₜ₋₁, yₜ₋₁,
    /// xₜ and yₜ; σ of the neighbours' xₜ, σ of all rows, Δx and yₜ.
    pub fn numbers(&self) -> Vec<f32> {
        let transfer::Fit { beta, query, means, deviation, global_deviation, bias, predicted, .. } = &self.0;
        [&beta[..], query, means, &[*deviation, *global_deviation, *bias, *predicted]].concat()
    }
}

/// Durations of a frame's neighbours; see [`transfer::Timing`].
#[wasm_bindgen]
pub struct FrameTiming(transfer::Timing);

#[wasm_bindgen]
impl FrameTiming {
    /// Returns d, in standard deviations.
    pub fn distances(&self) -> Vec<f32> {
        self.0.distances.clone()
    }

    /// Returns w, seconds.
    pub fn durations(&self) -> Vec<f32> {
        self.0.durations.clone()
    }

    /// Returns g, relative to the nearest.
    pub fn kernel(&self) -> Vec<f32> {
        self.0.kernel.clone()
    }

    /// Returns v.
    pub fn weights(&self) -> Vec<f32> {
        self.0.weights.clone()
    }

    /// Returns h.
    pub fn bandwidth(&self) -> f32 {
        self.0.bandwidth
    }

    /// Returns the duration of the frame, seconds.
    pub fn duration(&self) -> Option<f32> {
        self.0.duration
    }
}

/// The contact vote of a frame; see [`transfer::Contacts`].
#[wasm_bindgen]
pub struct FrameContacts(transfer::Contacts);

#[wasm_bindgen]
impl FrameContacts {
    /// Returns P of the left and the right foot in this frame alone, after smoothing, and combined with those of the
    /// targets.
    pub fn likelihoods(&self) -> Vec<f32> {
        let transfer::Contacts { votes, smoothed, output, .. } = &self.0;
        [*votes, *smoothed, *output].concat()
    }

    /// Returns whether each foot is held.
    pub fn planted(&self) -> Vec<u8> {
        self.0.planted.map(u8::from).into()
    }

    /// Returns the rows that vote.
    pub fn rows(&self) -> Vec<u32> {
        self.0.rows.iter().map(|&row| row as u32).collect()
    }

    /// Returns g of each row, left and right interleaved.
    pub fn voices(&self) -> Vec<f32> {
        self.0.voices.concat()
    }

    /// Returns c of each row, left and right interleaved.
    pub fn contacts(&self) -> Vec<u8> {
        self.0.contacts.iter().flat_map(|c| c.map(u8::from)).collect()
    }
}
