//! Windows in the form for computing all distances between many of them: rows of numbers that a GPU can read.
//!
//! A row contains one frame: its joints minus their weighted centroid on the ground, and minus the mean height of each
//! joint in the database, multiplied by √(w/5). Windows share rows. The travel of a window is stored separately: the
//! five centroids in an orthonormal basis of four (Helmert's), so that no large numbers cancel. D = N + N′ − 2 (h +
//! |g|) with the squared lengths N, the heights' inner product h and the complex inner product g on the ground, over
//! joints and travel.

use super::index::Index;
use super::lanes::{Floats, total};
use super::metric::{QueryWindow, WINDOW};
use super::points::{JOINT_WEIGHTS, LANES, LEG_POINTS};
use super::raw::RawPoints;
use crate::humanoid::Role;
use crate::math::order::positive;
use std::ops::Range;

/// Number of joints of a frame.
pub const PACKED_JOINTS: usize = JOINT_WEIGHTS.len();
/// Number of values of a [`PackedRow`]: heights, then x, then z.
pub const PACKED_ROW: usize = 3 * PACKED_JOINTS;
/// Classes are padded to a multiple of this number of windows, which one GPU workgroup compares.
pub const PACKED_TILE: usize = 32;
/// Squared length of the padding: farther away than any window, m².
pub const FAR: f32 = 3e38;
/// Number of values of [`PackedWindow::travel`]: x, then z.
pub const TRAVEL: usize = 2 * (WINDOW - 1);
/// Number of words of [`PackedWindow::words`].
pub const PACKED_WINDOW: usize = 12;

/// The numbers of one frame.
pub type PackedRow = [f32; PACKED_ROW];

/// Joints that are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BodyPart {
    /// All joints, as in the search.
    #[default]
    Whole,
    /// Upper and lower legs, feet and toes.
    Legs,
    /// Upper and lower arms, and hands.
    Arms,
    /// Hips, chest and shoulders.
    Torso,
    /// Neck and head.
    Head,
}

impl BodyPart {
    /// All parts.
    pub const ALL: [Self; 5] = [Self::Whole, Self::Legs, Self::Arms, Self::Torso, Self::Head];

    /// Returns whether the part contains a joint, given its index in [`JOINT_WEIGHTS`].
    fn has(self, joint: usize) -> bool {
        use Role as R;
        let role = JOINT_WEIGHTS[joint].0;
        let of_trunk = matches!(role, R::Hips | R::Chest | R::LeftShoulder | R::RightShoulder);
        let of_head = matches!(role, R::Neck | R::Head);
        match self {
            Self::Whole => true,
            Self::Legs => joint < LEG_POINTS,
            Self::Arms => joint >= LEG_POINTS && !of_trunk && !of_head,
            Self::Torso => of_trunk,
            Self::Head => of_head,
        }
    }

    /// Weights of joints; they sum to 1 except for rounding.
    fn weights(self) -> [f64; PACKED_JOINTS] {
        let all = Index::joint_weights();
        if self == Self::Whole {
            return all;
        }
        let own = |i: usize| if self.has(i) { all[i] } else { 0.0 };
        let sum: f64 = (0..PACKED_JOINTS).map(own).sum();
        std::array::from_fn(|i| own(i) / sum)
    }

    /// Lanes of a row's joints that have weights.
    fn lanes(self) -> Range<usize> {
        let weights = self.weights();
        let has = |lane: &usize| weights[4 * lane..][..4].iter().any(|w| *w > 0.0);
        let first = (0..LANES).find(has).unwrap_or(0);
        first..(0..LANES).rev().find(has).map_or(first, |last| last + 1)
    }
}

/// A window without its rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PackedWindow {
    /// Centroids in Helmert's basis, multiplied by √(Σw/5).
    pub travel: [f32; TRAVEL],
    /// Squared length, m².
    pub norm: f32,
    /// Last row.
    pub end: u32,
}

impl PackedWindow {
    /// Padding of a class to whole tiles.
    pub const PADDING: Self = Self { travel: [0.0; TRAVEL], norm: FAR, end: WINDOW as u32 - 1 };

    /// Encodes the shaders' `struct Window`, which ends in padding.
    pub fn words(&self) -> [u32; PACKED_WINDOW] {
        let mut words = [0; PACKED_WINDOW];
        for (word, v) in words.iter_mut().zip(&self.travel) {
            *word = v.to_bits();
        }
        (words[TRAVEL], words[TRAVEL + 1]) = (self.norm.to_bits(), self.end);
        words
    }
}

/// Windows of a class in the list of all windows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PackedClass {
    /// Index of the first window.
    pub first: usize,
    /// Number of windows without padding.
    pub count: usize,
    /// Greatest squared length, m².
    pub greatest: f32,
}

impl PackedClass {
    /// Windows of the class, without padding.
    pub fn windows(&self) -> Range<usize> {
        self.first..self.first + self.count
    }
}

/// All windows of a database.
#[derive(Clone, Debug)]
pub struct PackedWindows {
    measure: Measure,
    /// Rows of the database, in order.
    pub rows: Vec<PackedRow>,
    /// Windows ordered by class, each class padded to whole tiles.
    pub windows: Vec<PackedWindow>,
    /// Position of each class in `windows`.
    pub classes: Vec<PackedClass>,
}

/// A window that is compared with all, with its rows.
#[derive(Clone, Debug, PartialEq)]
pub struct PackedQuery {
    /// Rows of its frames.
    pub rows: [PackedRow; WINDOW],
    /// The window; its last row is the last of `rows`.
    pub window: PackedWindow,
}

impl PackedWindows {
    /// Packs the windows of an index, whose length must be [`WINDOW`] frames.
    ///
    /// # Panics
    /// If the window length differs.
    pub fn new(index: &Index, part: BodyPart) -> Self {
        assert_eq!(index.window_length(), WINDOW);
        let measure = Measure::new(index, part);
        let frames: Vec<Frame> = (0..index.rows()).map(|row| measure.frame(&index.positions(row))).collect();
        let (mut windows, mut classes) = (Vec::new(), Vec::new());
        for class in 0..index.classes() {
            let first = windows.len();
            let window = |end: usize| measure.window(&frames[end + 1 - WINDOW..=end], end);
            windows.extend(index.window_ends(class).map(window));
            let greatest = windows[first..].iter().fold(0.0, |greatest: f32, w| greatest.max(w.norm));
            classes.push(PackedClass { first, count: windows.len() - first, greatest });
            windows.resize(windows.len().next_multiple_of(PACKED_TILE), PackedWindow::PADDING);
        }
        Self { measure, rows: frames.iter().map(|frame| frame.row).collect(), windows, classes }
    }

    /// Packs a window to be compared with all; `None` if it is empty or its length is not [`WINDOW`].
    pub fn query(&self, window: &QueryWindow) -> Option<PackedQuery> {
        let frames: Vec<Frame> = window.positions().map(|positions| self.measure.frame(&positions)).collect();
        let mut rows = [[0.0; PACKED_ROW]; WINDOW];
        if frames.len() != rows.len() {
            return None;
        }
        rows.iter_mut().zip(&frames).for_each(|(row, frame)| *row = frame.row);
        Some(PackedQuery { rows, window: self.measure.window(&frames, WINDOW - 1) })
    }

    /// D between a query and a window, m². As in the shaders, a root of 0 is replaced by 10⁻¹⁵.
    pub fn distance(&self, query: &PackedQuery, window: &PackedWindow) -> f32 {
        let (h, [re, im]) = self.products(query, window);
        // `f32::max` would be a function call in WebAssembly, for every window.
        let squared = re * re + im * im;
        let turned = if squared > 1e-30 { squared } else { 1e-30 }.sqrt();
        positive(query.window.norm + window.norm - 2.0 * (h + turned))
    }

    /// h, and both parts of g.
    fn products(&self, query: &PackedQuery, window: &PackedWindow) -> (f32, [f32; 2]) {
        let [[ax, az], [bx, bz]] = [query.window.travel, window.travel].map(|travel| {
            let (x, z) = travel.split_at(WINDOW - 1);
            [x, z].map(|v| Floats::of(&std::array::from_fn(|i| v[i])))
        });
        let mut h = Floats::splat(0.0);
        let mut re = ax.times(bx).plus(az.times(bz));
        let mut im = ax.times(bz).minus(az.times(bx));
        let end = window.end as usize;
        for (a, b) in query.rows.iter().zip(&self.rows[end + 1 - WINDOW..=end]) {
            let [(a, _), (b, _)] = [a, b].map(|row| row.as_chunks::<4>());
            for l in self.measure.lanes.clone() {
                let [ay, ax, az] = [l, LANES + l, 2 * LANES + l].map(|l| Floats::of(&a[l]));
                let [by, bx, bz] = [l, LANES + l, 2 * LANES + l].map(|l| Floats::of(&b[l]));
                h = h.plus(ay.times(by));
                re = re.plus(ax.times(bx).plus(az.times(bz)));
                im = im.plus(ax.times(bz).minus(az.times(bx)));
            }
        }
        (total(h), [total(re), total(im)])
    }
}

/// One frame, before it is part of a window.
struct Frame {
    row: PackedRow,
    /// Squared length of the row before rounding, m².
    norm: f64,
    /// Weighted centroid on the ground, metres.
    centroid: [f64; 2],
}

/// Parameters of the comparison of positions.
#[derive(Clone, Debug)]
struct Measure {
    weights: [f64; PACKED_JOINTS],
    /// √(w/5).
    roots: [f64; PACKED_JOINTS],
    /// Mean height of each joint.
    heights: [f64; PACKED_JOINTS],
    /// Lanes of a row's joints that have weights.
    lanes: Range<usize>,
}

impl Measure {
    fn new(index: &Index, part: BodyPart) -> Self {
        let weights = part.weights();
        let rows = index.rows();
        let mut heights = [0.0; PACKED_JOINTS];
        for row in 0..rows {
            for (sum, [height, ..]) in heights.iter_mut().zip(index.positions(row)) {
                *sum += height;
            }
        }
        let heights = heights.map(|sum| sum / rows.max(1) as f64);
        Self { roots: weights.map(|w| (w / WINDOW as f64).sqrt()), weights, heights, lanes: part.lanes() }
    }

    fn frame(&self, positions: &RawPoints) -> Frame {
        let total: f64 = self.weights.iter().sum();
        let mean = |axis: usize| self.weights.iter().zip(positions).map(|(w, p)| w * p[axis]).sum::<f64>() / total;
        let centroid = [mean(1), mean(2)];
        let (mut row, mut norm) = ([0.0; PACKED_ROW], 0.0);
        for (i, (root, p)) in self.roots.iter().zip(positions).enumerate() {
            let centred = [p[0] - self.heights[i], p[1] - centroid[0], p[2] - centroid[1]];
            for (axis, v) in centred.into_iter().enumerate() {
                let v = root * v;
                norm += v * v;
                row[axis * PACKED_JOINTS + i] = v as f32;
            }
        }
        Frame { row, norm, centroid }
    }

    fn window(&self, frames: &[Frame], end: usize) -> PackedWindow {
        let root = (self.weights.iter().sum::<f64>() / WINDOW as f64).sqrt();
        let mut norm: f64 = frames.iter().map(|frame| frame.norm).sum();
        let mut travel = [0.0; TRAVEL];
        for axis in 0..2 {
            let mut sum = 0.0;
            for n in 1..WINDOW {
                sum += frames[n - 1].centroid[axis];
                let n_f64 = n as f64;
                let v = root * (sum - n_f64 * frames[n].centroid[axis]) / (n_f64 * (n_f64 + 1.0)).sqrt();
                norm += v * v;
                travel[axis * (WINDOW - 1) + n - 1] = v as f32;
            }
        }
        PackedWindow { travel, norm: norm as f32, end: end as u32 }
    }
}
