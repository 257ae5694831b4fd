//! Windows as a graphics processor reads them.
//!
//! A row holds one frame: its joints minus their weighted centroid on the ground, and minus the mean height of each joint
//! in the database, √(w/5) folded in. Windows share rows. What a window travels is kept apart from that: the five centroids
//! in an orthonormal basis of four (Helmert's), so that no large numbers cancel. D = N + N′ − 2 (h + |g|) with the squared
//! lengths N, the heights' inner product h and the ground's complex one g, over joints and travel.

use crate::error::GpuError;
use crate::rounding;
use std::ops::Range;
use strut_core::search::{Index, JOINT_WEIGHTS, Query, QueryWindow, RawPoints, WINDOW};

/// Joints of a frame.
pub(crate) const JOINTS: usize = JOINT_WEIGHTS.len();
/// Numbers of a row: heights, then x, then z.
pub(crate) const ROW: usize = 3 * JOINTS;
/// Windows, and queries, that one workgroup compares; classes are padded to multiples of it.
pub(crate) const TILE: usize = 32;
/// Squared length of padding: farther away than any window.
pub(crate) const FAR: f32 = 3e38;
/// Numbers of [`Window::travel`]: x, then z.
const TRAVEL: usize = 2 * (WINDOW - 1);

/// One frame.
pub(crate) type Row = [f32; ROW];

/// A window but for its rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Window {
    /// The centroids in Helmert's basis, √(Σw/5) folded in.
    pub(crate) travel: [f32; TRAVEL],
    /// Squared length, m².
    pub(crate) norm: f32,
    /// Its last row.
    pub(crate) end: u32,
}

/// Words of [`Window::words`].
pub(crate) const WINDOW_WORDS: usize = 12;

impl Window {
    /// Fills a class up to whole tiles.
    pub(crate) const PADDING: Self = Self { travel: [0.0; TRAVEL], norm: FAR, end: WINDOW as u32 - 1 };

    /// The shaders' `struct Window`, which ends in padding.
    pub(crate) fn words(&self) -> [u32; WINDOW_WORDS] {
        let mut words = [0; WINDOW_WORDS];
        for (word, v) in words.iter_mut().zip(&self.travel) {
            *word = v.to_bits();
        }
        (words[TRAVEL], words[TRAVEL + 1]) = (self.norm.to_bits(), self.end);
        words
    }
}

/// The windows of a class in the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Class {
    pub(crate) first: usize,
    /// Without padding.
    pub(crate) count: usize,
    /// Greatest squared length, m².
    pub(crate) greatest: f32,
}

impl Class {
    /// Its windows, without padding.
    pub(crate) fn windows(&self) -> Range<usize> {
        self.first..self.first + self.count
    }
}

/// All windows of a database.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    measure: Measure,
    pub(crate) rows: Vec<Row>,
    /// Class by class, each filled up to whole tiles.
    pub(crate) windows: Vec<Window>,
    pub(crate) classes: Vec<Class>,
}

impl Table {
    /// The windows of an index.
    ///
    /// # Errors
    /// If windows have a length other than [`WINDOW`].
    pub(crate) fn new(index: &Index) -> Result<Self, GpuError> {
        if index.window_length() != WINDOW {
            return Err(GpuError::WindowLength(index.window_length()));
        }
        let measure = Measure::new(index);
        let frames: Vec<Frame> = (0..index.rows()).map(|row| measure.frame(&index.positions(row))).collect();
        let (mut windows, mut classes) = (Vec::new(), Vec::new());
        for class in 0..index.classes() {
            let first = windows.len();
            let window = |end: usize| measure.window(&frames[end + 1 - WINDOW..=end], end);
            windows.extend(index.window_ends(class).map(window));
            let greatest = windows[first..].iter().fold(0.0, |greatest: f32, w| greatest.max(w.norm));
            classes.push(Class { first, count: windows.len() - first, greatest });
            windows.resize(windows.len().next_multiple_of(TILE), Window::PADDING);
        }
        Ok(Self { measure, rows: frames.iter().map(|frame| frame.row).collect(), windows, classes })
    }

    /// Windows of `index` to be compared with all.
    ///
    /// # Errors
    /// If one has another length than [`WINDOW`], which an empty one has.
    pub(crate) fn batch(&self, index: &Index, queries: &[(&QueryWindow, Query<'_>)]) -> Result<Batch, GpuError> {
        let mut batch = Batch { rows: Vec::new(), windows: Vec::new(), margins: Vec::new() };
        for (window, query) in queries {
            let frames: Vec<Frame> = window.positions().map(|positions| self.measure.frame(&positions)).collect();
            if frames.len() != WINDOW {
                return Err(GpuError::WindowLength(frames.len()));
            }
            batch.rows.extend(frames.iter().map(|frame| frame.row));
            let window = self.measure.window(&frames, batch.rows.len() - 1);
            let margin =
                |(c, class): (usize, &Class)| rounding::margin(window.norm, class.greatest, index.rounding(query, c));
            batch.margins.extend(self.classes.iter().enumerate().map(margin));
            batch.windows.push(window);
        }
        Ok(batch)
    }
}

/// Windows to be compared with a table's.
#[derive(Clone, Debug)]
pub(crate) struct Batch {
    /// [`WINDOW`] of each query.
    pub(crate) rows: Vec<Row>,
    pub(crate) windows: Vec<Window>,
    /// How much farther than the k-th nearest a candidate may seem: for each query, of every class, m².
    pub(crate) margins: Vec<f32>,
}

/// One frame, before it is part of a window.
struct Frame {
    row: Row,
    /// Squared length of the row before it was rounded, m².
    norm: f64,
    /// Weighted centroid on the ground, metres.
    centroid: [f64; 2],
}

/// What positions are compared by.
#[derive(Clone, Debug)]
struct Measure {
    weights: [f64; JOINTS],
    /// √(w/5).
    roots: [f64; JOINTS],
    heights: [f64; JOINTS],
}

impl Measure {
    fn new(index: &Index) -> Self {
        let weights = Index::joint_weights();
        let rows = index.rows();
        let mut heights = [0.0; JOINTS];
        for row in 0..rows {
            for (sum, [height, ..]) in heights.iter_mut().zip(index.positions(row)) {
                *sum += height;
            }
        }
        let heights = heights.map(|sum| sum / rows.max(1) as f64);
        Self { roots: weights.map(|w| (w / WINDOW as f64).sqrt()), weights, heights }
    }

    fn frame(&self, positions: &RawPoints) -> Frame {
        let total: f64 = self.weights.iter().sum();
        let mean = |axis: usize| self.weights.iter().zip(positions).map(|(w, p)| w * p[axis]).sum::<f64>() / total;
        let centroid = [mean(1), mean(2)];
        let (mut row, mut norm) = ([0.0; ROW], 0.0);
        for (i, (root, p)) in self.roots.iter().zip(positions).enumerate() {
            let centred = [p[0] - self.heights[i], p[1] - centroid[0], p[2] - centroid[1]];
            for (axis, v) in centred.into_iter().enumerate() {
                let v = root * v;
                norm += v * v;
                row[axis * JOINTS + i] = v as f32;
            }
        }
        Frame { row, norm, centroid }
    }

    fn window(&self, frames: &[Frame], end: usize) -> Window {
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
        Window { travel, norm: norm as f32, end: end as u32 }
    }
}
