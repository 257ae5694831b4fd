//! A yardstick: the transfer as one would write it down from the paper, loop by loop.
//!
//! The same numbers as the engine's for the default options, but for rounding: `bench/check.ts` compares them. No
//! index, no lanes, no thought of memory. `bench/naive.ts` is the same in plain JavaScript.
#![allow(clippy::needless_range_loop)] // The loops of the formulas.

use crate::error::EngineError;
use strut_core::database::{Database, TargetTable};
use strut_core::humanoid::JOINTS;
use strut_core::math::float_funcs::{exp, half_life_share, sin_cos};
use strut_core::pose_vector::{DOFS, HEADING_RATE, Placement, PoseRow, ROW};
use strut_core::search::{JOINT_WEIGHTS, WINDOW};
use strut_core::transfer::{MAX_FEEDBACK, Options};
use strut_formats::strutdb;
use wasm_bindgen::prelude::wasm_bindgen;

/// Points of a frame.
const POINTS: usize = JOINT_WEIGHTS.len();
/// Least deviation of the neighbours as a share of the global one, and whatever that is.
const LEAST_DEVIATION: [f32; 2] = [0.05, 0.005];
/// Least of the distances of classes, m².
const LEAST_DISTANCE: f32 = 1e-6;
/// Half-life of what separates expectation and prediction, seconds.
const HALF_LIFE_SECS: f32 = 1.0 / 120.0;

type Point = [f32; 3];

/// One stored window near the query.
#[derive(Clone, Copy)]
struct Near {
    distance: f32,
    row: u32,
}

/// Local autoregression on the nearest windows of every class, for one target style.
#[wasm_bindgen]
pub struct Naive {
    db: Database,
    targets: Vec<PoseRow>,
    points: Vec<[Point; POINTS]>,
    norms: Vec<f32>,
    /// Rows at which a window of each class ends.
    windows: Vec<Vec<u32>>,
    /// The nearest in each class, by (distance, row).
    nearest: Vec<Vec<Near>>,
}

#[wasm_bindgen]
impl Naive {
    /// On the database of a `.strutdb` file, towards a style.
    ///
    /// # Errors
    /// With what is wrong with the bytes.
    #[wasm_bindgen(constructor)]
    pub fn new(bytes: &[u8], style: u16) -> Result<Self, EngineError> {
        let db = strutdb::read(bytes).map_err(|e| EngineError::bad_file(e, ""))?.database;
        let mut points = Vec::new();
        for clip in &db.clips {
            let mut places = vec![Placement::default()];
            for row in clip.rows().skip(1) {
                let turn = db.pose[row][HEADING_RATE] / db.rate_hz;
                places.push(places[places.len() - 1].advanced(&db.pose[row], 1.0 / db.rate_hz, turn));
            }
            // Around the origin numbers are small and their products precise.
            let middle = places[places.len() / 2];
            for (row, at) in clip.rows().zip(places) {
                let (sin, cos) = sin_cos(at.heading);
                points.push(weighted(|joint| {
                    let p = db.point_cloud[row][joint];
                    let (x, z) = (at.x - middle.x, at.z - middle.z);
                    [x + cos * p.x + sin * p.z, p.y, z - sin * p.x + cos * p.z]
                }));
            }
        }
        let mut norms = vec![0.0; points.len()];
        let mut windows = vec![Vec::new(); db.classes().len()];
        for (clip, row) in db.clips.iter().flat_map(|c| c.rows().skip(WINDOW - 1).map(move |row| (c, row))) {
            norms[row] = centred(&points[row + 1 - WINDOW..=row]).1;
            windows[db.class_of_row(clip.first_frame)].push(row as u32);
        }
        let nearest = vec![Vec::new(); windows.len()];
        let table = TargetTable::build(&db, style);
        let targets = (0..db.frames()).map(|row| table.pose.get(row)).collect();
        Ok(Self { db, targets, points, norms, windows, nearest })
    }

    /// Finds the nearest windows of the classes `from` to `to` to the last frames: 5 × 21 positions in the world.
    pub fn search(&mut self, frames: &[f32], from: usize, to: usize) {
        let query: Vec<[Point; POINTS]> = frames
            .chunks(3 * JOINTS)
            .map(|frame| weighted(|joint| [frame[3 * joint], frame[3 * joint + 1], frame[3 * joint + 2]]))
            .collect();
        let (query, norm) = centred(&query);
        for class in 0..self.windows.len() {
            self.nearest[class].clear();
            if class < from || class >= to {
                continue;
            }
            let k = neighbours_of(self.windows[class].len());
            for &row in &self.windows[class] {
                let stored = &self.points[row as usize + 1 - WINDOW..=row as usize];
                let (mut heights, mut real, mut imaginary) = (0.0, 0.0, 0.0);
                for f in 0..WINDOW {
                    for i in 0..POINTS {
                        let ([ax, ay, az], [bx, by, bz]) = (query[f][i], stored[f][i]);
                        heights += ay * by;
                        real += ax * bx + az * bz;
                        imaginary += ax * bz - az * bx;
                    }
                }
                let products = heights + (real * real + imaginary * imaginary).sqrt();
                let distance = (norm + self.norms[row as usize] - 2.0 * products / WINDOW as f32).max(0.0);
                insert(&mut self.nearest[class], k, Near { distance, row });
            }
        }
    }

    /// The next row of the style from xₜ, xₜ₋₁ and yₜ₋₁, after [`Naive::search`]. Classes below `least_weight` times
    /// the largest weight are left out.
    pub fn predict(&self, x: &[f32], x_before: &[f32], y_before: &[f32], least_weight: f32) -> Vec<f32> {
        let Options { lambda, kappa, rho, .. } = Options::DEFAULT;
        let (db, inputs, targets) = (&self.db, &self.db.pose, &self.targets);
        let mut y = vec![0.0; ROW];
        let mut step: Vec<f32> = (0..ROW).map(|d| rho * (x[d] - x_before[d])).collect();
        for (nearest, weight) in self.nearest.iter().zip(self.class_weights(least_weight)) {
            if weight == 0.0 {
                continue;
            }
            let (first, last) = (nearest[0].distance, nearest[nearest.len() - 1].distance);
            let taper = |n: &Near| if last > first { (last - n.distance) / (last - first) } else { 1.0 };
            for d in 0..DOFS {
                let samples = || {
                    nearest.iter().map(|n| {
                        let row = n.row as usize;
                        let [p, c] = [inputs[row - 1][d], inputs[row][d]];
                        (taper(n), [p, c, targets[row - 1][d], targets[row][d]])
                    })
                };
                let mut mean = [0.0; 4];
                let mut total = 0.0;
                for (w, v) in samples() {
                    total += w;
                    for i in 0..4 {
                        mean[i] += w * v[i];
                    }
                }
                let mean = mean.map(|m| m / total);
                // Products of xₜ₋₁, xₜ and yₜ₋₁ with each other and with yₜ.
                let mut products = [[0.0; 4]; 3];
                for (w, v) in samples() {
                    for i in 0..3 {
                        for j in 0..4 {
                            products[i][j] += w * (v[i] - mean[i]) * (v[j] - mean[j]);
                        }
                    }
                }
                let sigma = db.sigma()[d];
                let deviation = (products[1][1] / total).sqrt().max(LEAST_DEVIATION[0] * sigma).max(LEAST_DEVIATION[1]);
                let reach = kappa * deviation;
                let bias = x[d] - x[d].clamp(mean[1] - reach, mean[1] + reach);
                for (i, row) in products.iter_mut().enumerate() {
                    row[i] += lambda * total * sigma * sigma;
                }
                let beta = solve(products);
                let known = [x_before[d] - bias, x[d] - bias, y_before[d] - rho * bias];
                let mut predicted = mean[3] + rho * bias;
                for i in 0..3 {
                    predicted += beta[i] * (known[i] - mean[i]);
                }
                y[d] += weight * predicted;
                step[d] += weight * (mean[3] - mean[2] - rho * (mean[1] - mean[0]));
            }
        }
        let share = half_life_share(1.0 / db.rate_hz, HALF_LIFE_SECS);
        for d in 0..DOFS {
            let expected = y_before[d] + step[d];
            y[d] = expected + share * (y[d] - expected);
        }
        y
    }

    /// Rows of a class's neighbours, nearest first, …
    pub fn neighbours(&self, class: usize) -> Vec<u32> {
        self.nearest[class].iter().map(|n| n.row).collect()
    }

    /// … and their distances, m².
    pub fn distances(&self, class: usize) -> Vec<f32> {
        self.nearest[class].iter().map(|n| n.distance).collect()
    }

    /// Weights of the classes by the mean distance of their neighbours; 0 below a share of the largest.
    fn class_weights(&self, least_weight: f32) -> Vec<f32> {
        let mean = |n: &Vec<Near>| n.iter().map(|n| n.distance).sum::<f32>() / n.len() as f32;
        let distances: Vec<f32> =
            self.nearest.iter().map(|n| if n.is_empty() { f32::INFINITY } else { mean(n) }).collect();
        let least = distances.iter().copied().fold(f32::INFINITY, f32::min).max(LEAST_DISTANCE);
        let weights = distances.iter().map(|d| exp((least - d).min(0.0) / (Options::DEFAULT.delta * least)));
        let kept: Vec<f32> = weights.map(|w| if w < least_weight { 0.0 } else { w }).collect();
        let sum: f32 = kept.iter().sum();
        kept.iter().map(|w| w / sum).collect()
    }
}

/// Neighbours of a class of so many windows.
fn neighbours_of(windows: usize) -> usize {
    let k = Options::DEFAULT.k;
    if windows >= 4 * k { k } else { k.min((windows / 4).max(5)) }
}

/// The points of a frame, √w folded in.
fn weighted(position: impl Fn(usize) -> Point) -> [Point; POINTS] {
    let sum: f32 = JOINT_WEIGHTS.iter().map(|(_, w)| w).sum();
    JOINT_WEIGHTS.map(|(role, w)| position(role.index()).map(|v| (w / sum).sqrt() * v))
}

/// A window with its middle above the origin, and its squared length.
fn centred(frames: &[[Point; POINTS]]) -> (Vec<[Point; POINTS]>, f32) {
    let sum: f32 = JOINT_WEIGHTS.iter().map(|(_, w)| w).sum();
    let roots = JOINT_WEIGHTS.map(|(_, w)| (w / sum).sqrt());
    let share = 1.0 / frames.len() as f32;
    let (mut x, mut z) = (0.0, 0.0);
    for frame in frames {
        for (root, p) in roots.iter().zip(frame) {
            x += share * root * p[0];
            z += share * root * p[2];
        }
    }
    let mut out = frames.to_vec();
    let mut norm = 0.0;
    for frame in &mut out {
        for (root, p) in roots.iter().zip(frame) {
            *p = [p[0] - root * x, p[1], p[2] - root * z];
            norm += share * (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        }
    }
    (out, norm)
}

/// Keeps the `k` nearest, by (distance, row); candidates come in order of their rows.
fn insert(nearest: &mut Vec<Near>, k: usize, candidate: Near) {
    if nearest.len() == k && candidate.distance >= nearest[k - 1].distance {
        return;
    }
    nearest.truncate(k - 1);
    let mut at = nearest.len();
    while at > 0 && nearest[at - 1].distance > candidate.distance {
        at -= 1;
    }
    nearest.insert(at, candidate);
}

/// Weights of the three regressors by Gaussian elimination; that of yₜ₋₁ is limited, and the other two solved for it.
fn solve(mut m: [[f32; 4]; 3]) -> [f32; 3] {
    for i in 0..3 {
        for j in i + 1..3 {
            let factor = m[j][i] / m[i][i];
            for k in i..4 {
                m[j][k] -= factor * m[i][k];
            }
        }
    }
    let feedback = (m[2][3] / m[2][2]).clamp(-MAX_FEEDBACK, MAX_FEEDBACK);
    let second = (m[1][3] - m[1][2] * feedback) / m[1][1];
    [(m[0][3] - m[0][2] * feedback - m[0][1] * second) / m[0][0], second, feedback]
}
