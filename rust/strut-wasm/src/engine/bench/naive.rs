//! Reference implementation: the transfer as written in the paper, loop by loop.
//!
//! Its numbers equal the engine's for the default options, except for rounding: `bench/yardstick_bench.ts` compares
//! them. It has no index, no SIMD and no memory optimisation. `bench/naive.ts` is the same in plain JavaScript.
#![allow(clippy::needless_range_loop)] // The loops of the formulas.

use crate::common::EngineError;
use std::sync::Arc;
use strut_core::catalogue::{Catalogue, TargetTable};
use strut_core::database::Database;
use strut_core::humanoid::JOINTS;
use strut_core::math::float_funcs::{exp, half_life_share, sin_cos};
use strut_core::pose_vector::{DOFS, HEADING_RATE, Placement, PoseRow, ROW};
use strut_core::search::{JOINT_WEIGHTS, WINDOW};
use strut_core::transfer::MAX_FEEDBACK;
use strut_core::transfer::Options;
use strut_formats::strutdb;
use wasm_bindgen::prelude::wasm_bindgen;

/// Number of points of a frame. The points of the legs come first; the last four of those are the feet's.
const POINTS: usize = JOINT_WEIGHTS.len();
const LEG_POINTS: usize = 8;
const FEET: usize = 4;
/// Least deviation of the neighbours: relative to the global one, and absolute.
const LEAST_DEVIATION: [f32; 2] = [0.05, 0.005];
/// D at which an input is half known, m².
const HALF_KNOWN: f32 = 0.0025;
/// Lower bound of class distances, m².
const LEAST_DISTANCE: f32 = 1e-6;
/// Half-life of the difference between expectation and prediction for known input, seconds; the factor for unknown
/// input; and D of the nearest neighbour halfway between, m².
const HALF_LIFE_SECS: f32 = 1.0 / 120.0;
const LONGEST: f32 = 6.0;
const HALF_UNKNOWN: f32 = 0.0016;
/// Number of windows with similar legs that vote on foot contacts; differences of a point's height, metres, and speed,
/// m/s, at which a vote's weight halves; and the least sum of their squares.
const VOTERS: usize = 40;
const SAME_HEIGHT: f32 = 0.01;
const SAME_SPEED: f32 = 0.15;
const SAME: f32 = 0.05;

type Point = [f32; 3];

/// A stored window near the query.
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
    step_secs: Vec<f32>,
    step_sigma: PoseRow,
    points: Vec<[Point; POINTS]>,
    /// Norms of the windows that end at each row: with all points, and with the leg points.
    norms: [Vec<f32>; 2],
    /// Rows at which a window of each class ends.
    windows: Vec<Vec<u32>>,
    /// The nearest windows in each class, by (distance, row).
    nearest: Vec<Vec<Near>>,
    /// Weight of each class in the last prediction.
    weights: Vec<f32>,
}

#[wasm_bindgen]
impl Naive {
    /// Opens the database of a `.strutdb` file, with a target style.
    ///
    /// # Errors
    /// If the bytes are invalid.
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
            // Near the origin numbers are small and their products accurate.
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
        let mut norms = [(); 2].map(|()| vec![0.0; points.len()]);
        let mut windows = vec![Vec::new(); db.classes().len()];
        for (clip, row) in db.clips.iter().flat_map(|c| c.rows().skip(WINDOW - 1).map(move |row| (c, row))) {
            for (norms, count) in norms.iter_mut().zip([POINTS, LEG_POINTS]) {
                norms[row] = centred(&points[row + 1 - WINDOW..=row], count).1;
            }
            windows[db.class_of_row(clip.first_frame)].push(row as u32);
        }
        let nearest = vec![Vec::new(); windows.len()];
        let table = TargetTable::new(Arc::new(Catalogue::new(db.clone())), style);
        let targets = (0..db.frames()).map(|row| table.pose(row)).collect();
        let step_secs = (0..db.frames()).map(|row| table.step_secs(row)).collect();
        let (step_sigma, weights) = (step_deviation(&db), Vec::new());
        Ok(Self { db, targets, step_secs, step_sigma, points, norms, windows, nearest, weights })
    }

    /// Finds the nearest windows of the classes `from` to `to` for the last frames: 5 × 21 world positions.
    pub fn search(&mut self, frames: &[f32], from: usize, to: usize) {
        let (query, norm) = centred(&points_of(frames), POINTS);
        for class in 0..self.windows.len() {
            self.nearest[class].clear();
            if class < from || class >= to {
                continue;
            }
            let k = neighbours_of(self.windows[class].len());
            for &row in &self.windows[class] {
                let stored = &self.points[row as usize + 1 - WINDOW..=row as usize];
                let products = products(&query, stored, POINTS);
                let distance = (norm + self.norms[0][row as usize] - 2.0 * products / WINDOW as f32).max(0.0);
                insert(&mut self.nearest[class], k, Near { distance, row });
            }
        }
    }

    /// Returns the probability of contact of the left and right foot in the last of these frames, 5 × 21 world
    /// positions: the vote of the windows with the nearest legs in the classes of the last prediction.
    pub fn contacts(&self, frames: &[f32]) -> Vec<f32> {
        let points = points_of(frames);
        let (query, norm) = centred(&points, LEG_POINTS);
        let mut nearest = Vec::new();
        for class in (0..self.windows.len()).filter(|&class| self.weights[class] > 0.0) {
            for &row in &self.windows[class] {
                let stored = &self.points[row as usize + 1 - WINDOW..=row as usize];
                let products = products(&query, stored, LEG_POINTS);
                let distance = (norm + self.norms[1][row as usize] - 2.0 * products / WINDOW as f32).max(0.0);
                insert(&mut nearest, VOTERS, Near { distance, row });
            }
        }
        let input = self.feet(&points);
        let (mut votes, mut voices) = ([0.0; 2], [0.0; 2]);
        for row in nearest.iter().map(|n| n.row as usize) {
            let feet = self.feet(&self.points[row + 1 - WINDOW..=row]);
            for side in 0..2 {
                let mut difference = 0.0;
                for point in [side, side + 2] {
                    let [height, speed] = [0, 1].map(|i| feet[point][i] - input[point][i]);
                    difference += square(height / SAME_HEIGHT) + square(speed / SAME_SPEED);
                }
                let voice = 1.0 / (difference + SAME);
                voices[side] += voice;
                votes[side] += voice * f32::from(self.db.contact[row][side]);
            }
        }
        vec![votes[0] / voices[0], votes[1] / voices[1]]
    }

    /// Returns height and speed of both ankles and both toes in the last but one frame.
    fn feet(&self, frames: &[[Point; POINTS]]) -> [[f32; 2]; 4] {
        let sum: f32 = JOINT_WEIGHTS.iter().map(|(_, w)| w).sum();
        std::array::from_fn(|i| {
            let root = (JOINT_WEIGHTS[FEET + i].1 / sum).sqrt();
            let at = |frame: usize, axis: usize| frames[frame][FEET + i][axis] / root;
            let step = [0, 1, 2].map(|axis| at(WINDOW - 1, axis) - at(WINDOW - 3, axis));
            let length = (step[0] * step[0] + step[1] * step[1] + step[2] * step[2]).sqrt();
            [at(WINDOW - 2, 1), 0.5 * length * self.db.rate_hz]
        })
    }

    /// Predicts the next row of the style from xₜ, xₜ₋₁ and yₜ₋₁, after [`Naive::search`]. Classes below `least_weight`
    /// times the largest weight are ignored.
    pub fn predict(&mut self, x: &[f32], x_before: &[f32], y_before: &[f32], least_weight: f32) -> Vec<f32> {
        self.weights = self.class_weights(least_weight);
        let Options { lambda, kappa, rho, .. } = Options::DEFAULT;
        let (db, inputs, targets) = (&self.db, &self.db.pose, &self.targets);
        let mut y = vec![0.0; ROW];
        let mut step: Vec<f32> = (0..ROW).map(|d| rho * (x[d] - x_before[d])).collect();
        for (nearest, &weight) in self.nearest.iter().zip(&self.weights) {
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
        let heaviest = (0..self.weights.len())
            .reduce(|best, class| if self.weights[class] > self.weights[best] { class } else { best })
            .unwrap_or_default();
        let ratio = square(self.nearest[heaviest][0].distance / HALF_UNKNOWN);
        let times = LONGEST - (LONGEST - 1.0) / (1.0 + square(ratio));
        let share = half_life_share(1.0 / db.rate_hz, times * HALF_LIFE_SECS);
        for d in 0..DOFS {
            let expected = y_before[d] + step[d];
            y[d] = expected + share * (y[d] - expected);
        }
        y
    }

    /// Returns the duration of the frame that was predicted last, seconds, from xₜ, xₜ₋₁, yₜ and yₜ₋₁.
    pub fn duration(&self, x: &[f32], x_before: &[f32], y: &[f32], y_before: &[f32]) -> f32 {
        let mut duration = 0.0;
        for (nearest, weight) in self.nearest.iter().zip(&self.weights) {
            if *weight == 0.0 {
                continue;
            }
            let (first, last) = (nearest[0].distance, nearest[nearest.len() - 1].distance);
            let mut squares = Vec::new();
            for row in nearest.iter().map(|n| n.row as usize) {
                let mut sum = 0.0;
                for (rows, now, before) in [(&self.db.pose, x, x_before), (&self.targets, y, y_before)] {
                    for d in 0..DOFS {
                        let pose = now[d] - rows[row][d];
                        let step = pose - (before[d] - rows[row - 1][d]);
                        sum += square(pose / self.db.sigma()[d]) + square(step / self.step_sigma[d]);
                    }
                }
                squares.push(sum);
            }
            let bandwidth = squares.iter().map(|s: &f32| s.sqrt()).sum::<f32>() / squares.len() as f32;
            let least = squares.iter().copied().fold(f32::INFINITY, f32::min);
            let (mut sum, mut total) = (0.0, 0.0);
            for (n, square) in nearest.iter().zip(&squares) {
                let taper = if last > first { (last - n.distance) / (last - first) } else { 1.0 };
                let w = taper * exp(0.5 * (least - square) / (bandwidth * bandwidth).max(1e-12));
                sum += w * self.step_secs[n.row as usize];
                total += w;
            }
            duration += weight * sum / total;
        }
        duration
    }

    /// Returns the rows of a class's neighbours, nearest first, …
    pub fn neighbours(&self, class: usize) -> Vec<u32> {
        self.nearest[class].iter().map(|n| n.row).collect()
    }

    /// … and their distances, m².
    pub fn distances(&self, class: usize) -> Vec<f32> {
        self.nearest[class].iter().map(|n| n.distance).collect()
    }

    /// Returns the weights of the classes, by the mean distance of their neighbours; 0 below a share of the largest.
    fn class_weights(&self, least_weight: f32) -> Vec<f32> {
        let mean = |n: &Vec<Near>| n.iter().map(|n| n.distance).sum::<f32>() / n.len() as f32;
        let distances: Vec<f32> =
            self.nearest.iter().map(|n| if n.is_empty() { f32::INFINITY } else { mean(n) }).collect();
        let least = distances.iter().copied().fold(f32::INFINITY, f32::min).max(LEAST_DISTANCE);
        let delta = Options::DEFAULT.delta;
        let square = (least / HALF_KNOWN) * (least / HALF_KNOWN);
        let width = delta * (3.0 - 2.0 / (1.0 + square * square));
        let weights = distances.iter().map(|d| exp((least - d).min(0.0) / (width * least)));
        let kept: Vec<f32> = weights.map(|w| if w < least_weight { 0.0 } else { w }).collect();
        let sum: f32 = kept.iter().sum();
        kept.iter().map(|w| w / sum).collect()
    }
}

/// Returns the number of neighbours for a class with this number of windows.
fn neighbours_of(windows: usize) -> usize {
    let k = Options::DEFAULT.k;
    if windows >= 4 * k { k } else { k.min((windows / 4).max(5)) }
}

/// Returns the points of a frame, multiplied by √w.
fn weighted(position: impl Fn(usize) -> Point) -> [Point; POINTS] {
    let sum: f32 = JOINT_WEIGHTS.iter().map(|(_, w)| w).sum();
    JOINT_WEIGHTS.map(|(role, w)| position(role.index()).map(|v| (w / sum).sqrt() * v))
}

/// Returns the points of frames of positions.
fn points_of(frames: &[f32]) -> Vec<[Point; POINTS]> {
    let frames = frames.chunks(3 * JOINTS);
    frames.map(|frame| weighted(|joint| [frame[3 * joint], frame[3 * joint + 1], frame[3 * joint + 2]])).collect()
}

/// Returns the inner product of two windows over their first points, maximised by turning the second.
fn products(query: &[[Point; POINTS]], stored: &[[Point; POINTS]], points: usize) -> f32 {
    let (mut heights, mut real, mut imaginary) = (0.0, 0.0, 0.0);
    for f in 0..WINDOW {
        for i in 0..points {
            let ([ax, ay, az], [bx, by, bz]) = (query[f][i], stored[f][i]);
            heights += ay * by;
            real += ax * bx + az * bz;
            imaginary += ax * bz - az * bx;
        }
    }
    heights + (real * real + imaginary * imaginary).sqrt()
}

/// Returns a window with the centroid of its first points above the origin, and the squared length of these points.
fn centred(frames: &[[Point; POINTS]], points: usize) -> (Vec<[Point; POINTS]>, f32) {
    let sum: f32 = JOINT_WEIGHTS.iter().map(|(_, w)| w).sum();
    let roots = JOINT_WEIGHTS.map(|(_, w)| (w / sum).sqrt());
    let squares: f32 = roots[..points].iter().map(|root| root * root).sum();
    let share = 1.0 / frames.len() as f32;
    let (mut x, mut z) = (0.0, 0.0);
    for frame in frames {
        for (root, p) in roots.iter().zip(frame).take(points) {
            x += share * root * p[0] / squares;
            z += share * root * p[2] / squares;
        }
    }
    let mut out = frames.to_vec();
    let mut norm = 0.0;
    for frame in &mut out {
        for (root, p) in roots.iter().zip(frame).take(points) {
            *p = [p[0] - root * x, p[1], p[2] - root * z];
            norm += share * (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        }
    }
    (out, norm)
}

/// Keeps the `k` nearest, by (distance, row). Candidates arrive in the order of their rows.
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

/// Returns the standard deviation of each degree of freedom's change between successive frames of a clip.
fn step_deviation(db: &Database) -> PoseRow {
    std::array::from_fn(|d| {
        let rows = db.clips.iter().flat_map(|clip| clip.rows().skip(1));
        let steps: Vec<f64> = rows.map(|row| f64::from(db.pose[row][d]) - f64::from(db.pose[row - 1][d])).collect();
        let mean = steps.iter().sum::<f64>() / steps.len() as f64;
        let variance = steps.iter().map(|s| (s - mean) * (s - mean)).sum::<f64>() / steps.len() as f64;
        (variance.sqrt() as f32).max(1e-5)
    })
}

/// Solves for the weights of the three regressors by Gaussian elimination. The weight of yₜ₋₁ is clamped, and the other
/// two are solved for it.
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

fn square(x: f32) -> f32 {
    x * x
}
