//! Distances between a set of windows and all windows of a database, as an image.
//!
//! An image has a column for each compared window, and a line for each range of the database's windows, which are
//! ordered by class and clip. A pixel is the least D between its column's window and the windows of its line.

use super::index::{Index, Query};
use super::metric::{LENGTH, Metric, QueryWindow, WINDOW};
use super::packed::{BodyPart, PACKED_TILE, PackedQuery, PackedWindows};
use super::points::JOINT_WEIGHTS;
use super::raw::RawPoints;
use crate::humanoid::{Pose, Proportions};
use crate::kinematics::world_from_local;
use crate::math::float_funcs::double;
use crate::pose_vector::Placement;
use std::ops::Range;

/// Index of the hips among the compared joints.
const HIPS: usize = 8;
/// Line index of windows that are on no line.
const NO_LINE: u32 = u32::MAX;

/// Part of the database that an image shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AtlasView {
    /// Joints that are compared.
    pub part: BodyPart,
    /// Index of the first window, by class and clip, and of the one after the last.
    pub windows: [usize; 2],
    /// Number of lines, at least one and at most the number of windows, which are distributed evenly.
    pub height: usize,
}

impl AtlasView {
    /// Windows of a line.
    fn windows_of(&self, line: usize) -> Range<usize> {
        let [first, last] = self.windows;
        let begin = |line: usize| first + (line * (last - first)).div_ceil(self.height);
        begin(line)..begin(line + 1)
    }
}

/// Nearest window of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestOfLine {
    /// Index of the window, by class and clip.
    pub window: usize,
    /// Row at which the window ends.
    pub row: usize,
    /// D, m².
    pub distance: f32,
}

/// Windows that are compared with all windows of an index, whose window length is [`WINDOW`].
#[derive(Clone, Debug)]
pub struct Atlas {
    /// Window of each column; none is empty.
    columns: Vec<QueryWindow>,
    /// Rows at which the windows end, by class and clip.
    ends: Vec<u32>,
    /// Index of the first window of each class, followed by the number of all windows.
    firsts: Vec<usize>,
    view: AtlasView,
    /// Line of the window that ends at each row.
    lines: Vec<u32>,
    /// Windows by the joints of the view; created when they are needed.
    packed: Option<(BodyPart, PackedWindows)>,
    /// Last column that was drawn by the index's own metric, and its nearest window of each line, by the row at which it
    /// ends. The windows that follow these are likely to be near to another column.
    last: (usize, Vec<u32>),
    scratch: Scratch,
}

impl Atlas {
    /// An image of one line, with these windows as columns; empty windows are omitted.
    ///
    /// # Panics
    /// If the window length of the index is not [`WINDOW`].
    pub fn new(index: &Index, columns: Vec<QueryWindow>) -> Self {
        assert_eq!(index.window_length(), WINDOW);
        let (mut ends, mut firsts) = (Vec::new(), vec![0]);
        for class in 0..index.classes() {
            ends.extend(index.window_ends(class).map(|row| row as u32));
            firsts.push(ends.len());
        }
        let columns = columns.into_iter().filter(|window| window.frames() > 0).collect();
        let view = AtlasView { part: BodyPart::Whole, windows: [0, ends.len()], height: 1 };
        let lines = vec![NO_LINE; index.rows()];
        let (last, scratch) = ((0, Vec::new()), Scratch::default());
        let mut atlas = Self { columns, ends, firsts, view, lines, packed: None, last, scratch };
        atlas.number_lines();
        atlas
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns.len()
    }

    /// The window of a column.
    pub fn column(&self, column: usize) -> Option<&QueryWindow> {
        self.columns.get(column)
    }

    /// Index of the first window of each class, followed by the number of all windows.
    pub fn firsts(&self) -> &[usize] {
        &self.firsts
    }

    /// Sets another view, whose limits are clamped to the existing windows.
    pub fn set_view(&mut self, view: AtlasView) {
        let all = self.ends.len();
        let first = view.windows[0].min(all.saturating_sub(1));
        let last = view.windows[1].clamp((first + 1).min(all), all);
        let height = view.height.clamp(1, (last - first).max(1));
        let view = AtlasView { part: view.part, windows: [first, last], height };
        if view != self.view {
            self.view = view;
            self.number_lines();
        }
    }

    /// The view.
    pub fn view(&self) -> AtlasView {
        self.view
    }

    fn number_lines(&mut self) {
        self.last.1.clear();
        self.lines.fill(NO_LINE);
        for line in 0..self.view.height {
            for window in self.view.windows_of(line) {
                self.lines[self.ends[window] as usize] = line as u32;
            }
        }
    }

    /// Line of each window of [`packed`](Self::packed), including padding of the classes; the greatest number for none.
    pub fn packed_lines(&self) -> Vec<u32> {
        let mut lines = Vec::new();
        for class in self.firsts.windows(2) {
            lines.extend(self.ends[class[0]..class[1]].iter().map(|&row| self.lines[row as usize]));
            lines.resize(lines.len().next_multiple_of(PACKED_TILE), NO_LINE);
        }
        lines
    }

    /// Windows of the index by the joints of the view.
    pub fn packed(&mut self, index: &Index) -> &PackedWindows {
        packed_by(&mut self.packed, index, self.view.part)
    }

    /// Columns by the joints of the view.
    pub fn packed_columns(&mut self, index: &Index) -> Vec<PackedQuery> {
        let packed = packed_by(&mut self.packed, index, self.view.part);
        self.columns.iter().filter_map(|window| packed.query(window)).collect()
    }

    /// Least D of each line in a column, m²; infinite for a line without windows.
    ///
    /// # Panics
    /// If the column does not exist, or the length of `out` is not the number of lines.
    pub fn draw(&mut self, index: &Index, column: usize, out: &mut [f32]) {
        assert_eq!(out.len(), self.view.height);
        out.fill(f32::INFINITY);
        if self.ends.is_empty() {
            return;
        }
        let Some(metric) = metric_of(self.view.part) else {
            self.draw_packed(index, column, out);
            return;
        };
        let Self { columns, ends, firsts, view, lines, last: (last, nearest), scratch, .. } = self;
        let query = index.prepare(&columns[column], metric);
        if nearest.len() != view.height {
            nearest.clear();
            nearest.extend((0..view.height).map(|line| ends[view.windows_of(line).start]));
        }
        // Initial window of each line: the successor of the nearest window of the last column, or any.
        for (line, (row, least)) in (0..).zip(nearest.iter_mut().zip(&mut *out)) {
            let next = (*row as usize + column).saturating_sub(*last);
            if lines.get(next) == Some(&line) {
                *row = next as u32;
            }
            *least = index.distance_to(&query, *row as usize);
        }
        *last = column;
        for (class, windows) in firsts.windows(2).enumerate() {
            let (first, last) = (windows[0].max(view.windows[0]), windows[1].min(view.windows[1]));
            if first < last {
                let of_class = lines[ends[first] as usize] as usize..lines[ends[last - 1] as usize] as usize + 1;
                index.least_of_lines(&query, class, lines, of_class, scratch, nearest, out);
            }
        }
    }

    fn draw_packed(&mut self, index: &Index, column: usize, out: &mut [f32]) {
        let packed = packed_by(&mut self.packed, index, self.view.part);
        let Some(query) = packed.query(&self.columns[column]) else { return };
        for class in &packed.classes {
            for window in &packed.windows[class.windows()] {
                if let Some(least) = out.get_mut(self.lines[window.end as usize] as usize) {
                    let distance = packed.distance(&query, window);
                    // `f32::min` would be a function call, as in `distance`.
                    if distance < *least {
                        *least = distance;
                    }
                }
            }
        }
    }

    /// Nearest window of a line in a column; `None` if the line or column does not exist.
    pub fn nearest(&mut self, index: &Index, column: usize, line: usize) -> Option<NearestOfLine> {
        let query = self.columns.get(column).filter(|_| line < self.view.height)?;
        let windows = self.view.windows_of(line);
        let distances: Vec<f32> = if let Some(metric) = metric_of(self.view.part) {
            let query = index.prepare(query, metric);
            self.ends[windows.clone()].iter().map(|&row| index.distance_to(&query, row as usize)).collect()
        } else {
            let packed = packed_by(&mut self.packed, index, self.view.part);
            let query = packed.query(query)?;
            let of = |window| packed.distance(&query, &packed.windows[packed_number(packed, &self.firsts, window)]);
            windows.clone().map(of).collect()
        };
        let of = |(window, distance)| NearestOfLine { window, row: self.ends[window] as usize, distance };
        windows.zip(distances).map(of).min_by(|a, b| a.distance.total_cmp(&b.distance))
    }
}

/// Windows by these joints: the existing ones, or new ones that replace them.
fn packed_by<'a>(
    packed: &'a mut Option<(BodyPart, PackedWindows)>,
    index: &Index,
    part: BodyPart,
) -> &'a PackedWindows {
    let same = packed.take().filter(|(of, _)| *of == part);
    &packed.insert(same.unwrap_or_else(|| (part, PackedWindows::new(index, part)))).1
}

/// Index of a window among the packed ones; `firsts` are the indices of the classes' first windows.
fn packed_number(packed: &PackedWindows, firsts: &[usize], window: usize) -> usize {
    let class = firsts.partition_point(|first| *first <= window) - 1;
    packed.classes[class].first + window - firsts[class]
}

/// Placement of a database pose that minimises the distance of its window to another by a rotation about the vertical
/// and a shift on the ground, relative to the newest hips of that window. `row` is the row at which the database window
/// ends, `pose` the pose of that row above the origin, heading along +Z, and `body` its proportions.
///
/// # Panics
/// If no window ends there.
pub fn nearest_placement(
    index: &Index,
    window: &QueryWindow,
    row: usize,
    pose: &Pose,
    body: &Proportions,
) -> Placement {
    let weights = Index::joint_weights();
    // Positions on the ground as x + i z, of the whole body, whichever part is compared.
    let centred = |frames: &[RawPoints]| {
        let all: Vec<(f64, [f64; 2])> =
            frames.iter().flat_map(|frame| weights.iter().zip(frame).map(|(w, p)| (*w, [p[1], p[2]]))).collect();
        let total: f64 = all.iter().map(|(w, _)| w).sum();
        let centre = [0, 1].map(|axis| all.iter().map(|(w, p)| w * p[axis]).sum::<f64>() / total);
        (centre, all.into_iter().map(move |(w, p)| (w, [p[0] - centre[0], p[1] - centre[1]])).collect::<Vec<_>>())
    };
    // Angle by which the second points are turned to be nearest to the first.
    let turn = |to: &[(f64, [f64; 2])], from: &[(f64, [f64; 2])]| {
        let (mut re, mut im) = (0.0, 0.0);
        for ((w, a), (_, b)) in to.iter().zip(from) {
            re += w * (a[0] * b[0] + a[1] * b[1]);
            im += w * (a[1] * b[0] - a[0] * b[1]);
        }
        double::atan2(im, re)
    };
    let query: Vec<RawPoints> = window.positions().collect();
    let stored: Vec<RawPoints> = (row + 1 - WINDOW..=row).map(|row| index.positions(row)).collect();
    let ((to, of_query), (from, of_stored)) = (centred(&query), centred(&stored));
    let turned = turn(&of_query, &of_stored);
    let newest = stored[WINDOW - 1];
    let world = world_from_local(body, pose);
    let at_origin =
        JOINT_WEIGHTS.map(|(role, _)| world.positions[role.index()]).map(|p| [p.y, p.x, p.z].map(f64::from));
    let heading = turn(&centred(&[newest]).1, &centred(&[at_origin]).1);
    let (sin, cos) = double::sin_cos(turned);
    let hips = [newest[HIPS][1] - from[0], newest[HIPS][2] - from[1]];
    Placement {
        x: (to[0] + cos * hips[0] - sin * hips[1]) as f32,
        z: (to[1] + sin * hips[0] + cos * hips[1]) as f32,
        // A heading turns x + i z in the opposite direction.
        heading: -(turned + heading) as f32,
    }
}

/// Metric by which the index compares these joints, if it has one.
fn metric_of(part: BodyPart) -> Option<Metric> {
    match part {
        BodyPart::Whole => Some(Metric::FullBody),
        BodyPart::Legs => Some(Metric::LowerBody),
        BodyPart::Arms | BodyPart::Torso | BodyPart::Head => None,
    }
}

/// Working memory of a column.
#[derive(Clone, Debug, Default)]
struct Scratch {
    /// Squared distance for each line above which windows are excluded.
    limits: Vec<f32>,
    /// Leaves that may contain nearer windows, each with a lower bound of their D.
    leaves: Vec<(f32, usize)>,
}

/// Number of leaves between two updates of the farthest line.
const LEAVES: usize = 16;

impl Index {
    /// Lowers the values of lines in `out` to the D of a class's windows, which are on the lines `of_class`. `lines`
    /// maps the rows at which windows end to lines. `nearest` receives the rows of the nearest windows.
    #[allow(clippy::too_many_arguments)] // Parts of one atlas.
    fn least_of_lines(
        &self,
        query: &Query<'_>,
        class: usize,
        lines: &[u32],
        of_class: Range<usize>,
        scratch: &mut Scratch,
        nearest: &mut [u32],
        out: &mut [f32],
    ) {
        let margins = self.margins(query, class);
        let Scratch { limits, leaves } = scratch;
        limits.clear();
        limits.extend(out.iter().map(|least| margins.squared_limit(*least)));
        let farthest = |out: &[f32]| out[of_class.clone()].iter().copied().fold(0.0, f32::max);
        leaves.clear();
        self.leaves_within(query, class, farthest(out), leaves);
        for leaves in leaves.chunks(LEAVES) {
            let of_all = margins.squared_limits(farthest(out));
            for &(_, leaf) in leaves {
                let distances = self.squared_distances(query, leaf);
                let mut windows = distances.within(&of_all);
                while windows != 0 {
                    let i = windows.trailing_zeros() as usize;
                    windows &= windows - 1;
                    let row = self.rows[leaf][i];
                    let line = lines.get(row as usize).map_or(usize::MAX, |line| *line as usize);
                    // NaN excludes nothing.
                    if limits.get(line).is_none_or(|limit| distances.0[i / 4][i % 4] > *limit) {
                        continue;
                    }
                    let d = self.distance::<LENGTH>(query, row as usize);
                    if d < out[line] {
                        (out[line], limits[line], nearest[line]) = (d, margins.squared_limit(d), row);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
