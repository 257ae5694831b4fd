//! Subspace that contains most of the differences between windows.
//!
//! A window is a real vector y of heights and a complex one z of the ground plane ([`super::metric`]). Let a be the
//! coordinates of y − mean in an orthonormal basis of a few dimensions, r the length of the residual, and c and q the
//! same for z. Then, by the inequalities of Bessel and Cauchy–Schwarz, for any basis and any mean,
//!
//! D ≥ |a − a'|² + (r − r')² + |c|² + |c'|² − 2 |⟨c, c'⟩| + (q − q')².
//!
//! The right-hand side is the squared distance of two short vectors modulo the phase of their complex parts, which is a
//! metric too. The bound is tightest if the basis contains the directions of greatest variance.

use super::lanes::{FloatLane, Floats, inner_product, total};
use super::metric::{CentredWindow, MAX_WINDOW, Metric};
use super::points::{FramePoints, GroundRow, HeightRow, LANES, LEG_LANES, POINTS, PointRow};
use super::principal::{Complex, inner, principal_directions};

/// Dimensions of the basis for heights …
const HEIGHT_DIMENSIONS: usize = 14;
/// … and complex dimensions of the basis for the ground plane.
pub(super) const GROUND_DIMENSIONS: usize = 12;
/// Number of real coordinates: those of the heights, and both lengths outside the basis.
pub(super) const REAL: usize = HEIGHT_DIMENSIONS + 2;
/// Number of all coordinates; the complex ones follow the real ones, with alternating real and imaginary parts.
pub(super) const COORDINATES: usize = REAL + 2 * GROUND_DIMENSIONS;

/// Bound on the rounding error of a projection, as a share of the window's length, for windows of at most 15 frames.
///
/// Each of 38 real coordinates is a sum that rounds at most 82 times (75 products in a running sum, and the sums of
/// those), and the residual has the same error in every direction: √(2 · 38) · 82 · 2⁻²⁴ of the length. Subtracting a
/// direction rounds three times. With 1e-6 for the bases' deviation from orthonormality ([`Subspace::from_floats`]) it
/// is 5e-5.
const ROUNDING: f32 = 1.0 / 16_384.0;

/// Bound on the rounding error of the window itself, as a share of its length before the mean is subtracted.
const INPUT_ROUNDING: f32 = 1.0 / 4_194_304.0;

/// Bound on the rounding error of a sum of squares and products of two windows, as a share of the sum of their squared
/// lengths: each of the terms rounds at most 82 times.
const SUM_ROUNDING: f32 = 128.0 / 16_777_216.0;

/// Greatest deviation from orthonormality (Frobenius norm) that rounding to single precision causes.
const MAX_SKEW: f64 = 1e-6;

/// A mean of heights, and orthonormal directions.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Subspace {
    mean: Vec<HeightRow>,
    height: Vec<HeightRow>,
    ground: Vec<GroundRow>,
    /// Whether windows, mean and directions are zero except for the points of the legs.
    legs_only: bool,
}

/// A window in the subspace.
#[derive(Clone, Copy, Debug)]
pub(super) struct Projection {
    /// Metres; see [`REAL`].
    pub(super) coordinates: [f32; COORDINATES],
    /// Length of the coordinates.
    pub(super) length: f32,
    /// Bound on the error of the coordinates against exact arithmetic.
    pub(super) error: f32,
}

impl Subspace {
    /// Number of values that [`Subspace::floats`] returns.
    pub(super) const fn float_count(frames: usize) -> usize {
        frames * POINTS * (1 + HEIGHT_DIMENSIONS + 2 * GROUND_DIMENSIONS)
    }

    /// Fits the directions in which these windows of a metric, each of `frames` frames, differ most.
    pub(super) fn fit(windows: &[CentredWindow], frames: usize, metric: Metric) -> Self {
        // Only the points of the metric are used, if they suffice for all directions.
        let points = if frames * metric.points() >= HEIGHT_DIMENSIONS { metric.points() } else { POINTS };
        let dimension = frames * points;
        let root = windows.first().map_or(1.0, |w| f64::from(w.scale).sqrt());
        let mut mean = vec![HeightRow::default(); frames];
        for (f, row) in mean.iter_mut().enumerate() {
            for (i, v) in row.iter_mut().flatten().enumerate() {
                let sum: f64 = windows.iter().map(|w| f64::from(w.height[f].as_flattened()[i])).sum();
                *v = (sum / windows.len().max(1) as f64) as f32;
            }
        }
        let heights = |w: &CentredWindow| -> Vec<Complex> {
            let rows = w.height.iter().zip(&mean);
            let differences = rows.flat_map(|(v, m)| v.as_flattened().iter().zip(m.as_flattened()).take(points));
            differences.map(|(v, m)| [(f64::from(*v) - f64::from(*m)) / root, 0.0]).collect()
        };
        let ground = |w: &CentredWindow| -> Vec<Complex> {
            let lanes = w.ground[..frames].iter().flat_map(|row| row.chunks_exact(2).take(points / 4));
            lanes.flat_map(|xz| (0..4).map(|i| [xz[0][i], xz[1][i]].map(|v| f64::from(v) / root))).collect()
        };
        let directions = |vector: &dyn Fn(&CentredWindow) -> Vec<Complex>, count| {
            principal_directions(&windows.iter().map(vector).collect::<Vec<_>>(), dimension, count)
                .into_iter()
                .flatten()
        };
        let mut subspace = Self {
            height: vec![HeightRow::default(); HEIGHT_DIMENSIONS * frames],
            ground: vec![GroundRow::default(); GROUND_DIMENSIONS * frames],
            mean: Vec::new(),
            legs_only: false,
        };
        for (i, [re, _]) in directions(&heights, HEIGHT_DIMENSIONS).enumerate() {
            subspace.height[i / points].as_flattened_mut()[i % points] = re as f32;
        }
        for (i, [re, im]) in directions(&ground, GROUND_DIMENSIONS).enumerate() {
            let row = &mut subspace.ground[i / points];
            let (lane, at) = (i % points / 4, i % 4);
            row[2 * lane][at] = re as f32;
            row[2 * lane + 1][at] = im as f32;
        }
        Self { mean, ..subspace }.for_metric(metric)
    }

    /// Restricts the subspace to windows of this metric.
    fn for_metric(self, metric: Metric) -> Self {
        let are_zero = |lanes: &[FloatLane]| lanes.as_flattened().iter().all(|v| *v == 0.0);
        let heights = self.mean.iter().chain(&self.height).all(|row| are_zero(&row[LEG_LANES..]));
        let legs_only =
            metric == Metric::LowerBody && heights && self.ground.iter().all(|row| are_zero(&row[2 * LEG_LANES..]));
        Self { legs_only, ..self }
    }

    /// All numbers, for [`Subspace::from_floats`].
    pub(super) fn floats(&self) -> Vec<f32> {
        let heights = self.mean.iter().chain(&self.height).flatten().flatten();
        heights.chain(self.ground.iter().flatten().flatten()).copied().collect()
    }

    /// Creates a subspace from the numbers of another for windows of this number of frames; `None` if they are not
    /// finite, not orthonormal or if their count is wrong. Bounds hold for any orthonormal basis.
    pub(super) fn from_floats(floats: &[f32], frames: usize, metric: Metric) -> Option<Self> {
        if floats.len() != Self::float_count(frames) || !floats.iter().all(|v| v.is_finite()) {
            return None;
        }
        let (heights, ground) = floats.split_at(frames * POINTS * (1 + HEIGHT_DIMENSIONS));
        let height_row = |v: &[f32]| -> HeightRow { std::array::from_fn(|l| std::array::from_fn(|i| v[4 * l + i])) };
        let ground_row = |v: &[f32]| -> GroundRow { std::array::from_fn(|l| std::array::from_fn(|i| v[4 * l + i])) };
        let mut rows = heights.chunks_exact(POINTS).map(height_row);
        let subspace = Self {
            mean: rows.by_ref().take(frames).collect(),
            height: rows.collect(),
            ground: ground.chunks_exact(2 * POINTS).map(ground_row).collect(),
            legs_only: false,
        };
        (subspace.skew() <= MAX_SKEW).then(|| subspace.for_metric(metric))
    }

    /// Deviation of the directions from orthonormality.
    fn skew(&self) -> f64 {
        let frames = self.mean.len();
        let height: Vec<Vec<Complex>> = self
            .height
            .chunks_exact(frames)
            .map(|d| d.iter().flatten().flatten().map(|v| [f64::from(*v), 0.0]).collect())
            .collect();
        let ground: Vec<Vec<Complex>> = self
            .ground
            .chunks_exact(frames)
            .map(|d| {
                let lanes = d.iter().flat_map(|row| row.chunks_exact(2));
                lanes.flat_map(|xz| (0..4).map(|i| [xz[0][i], xz[1][i]].map(f64::from))).collect()
            })
            .collect();
        skew(&height).max(skew(&ground))
    }

    /// Bound on [`Projection::error`] of windows of this [`CentredWindow::scale`] whose squared length is at most `norm`.
    pub(super) fn greatest_error(&self, norm: f32, scale: f32) -> f32 {
        let mean = inner_product::<LANES, LANES, LANES>(&self.mean, &self.mean) / scale;
        ROUNDING * (norm.sqrt() + mean.sqrt()) + INPUT_ROUNDING * norm.sqrt()
    }

    /// Squared length of the [projection](Subspace::project) of a stored window of a metric, metres², from its stored
    /// points, its [`CentredWindow::scale`] and its [`CentredWindow::norm`]; and a bound on its error.
    ///
    /// A projection includes the length of the part outside the basis, so that its squared length is |y − mean|² + |z|²
    /// = |y|² + |z|² − 2 ⟨y, mean⟩ + |mean|².
    pub(super) fn squared_length(&self, metric: Metric, frames: &[PointRow], scale: f32, norm: f32) -> (f32, f32) {
        let mut heights = [HeightRow::default(); MAX_WINDOW];
        heights.iter_mut().zip(frames).for_each(|(height, row)| *height = FramePoints(*row).heights());
        let heights = &heights[..frames.len()];
        let product = match metric {
            Metric::FullBody => inner_product::<LANES, LANES, LANES>(heights, &self.mean),
            Metric::LowerBody => inner_product::<LANES, LEG_LANES, LANES>(heights, &self.mean),
        };
        let mean = inner_product::<LANES, LANES, LANES>(&self.mean, &self.mean) / scale;
        let squared = (norm - (product + product) + mean).max(0.0);
        let error = self.greatest_error(norm, scale);
        (squared, error * (2.0 * squared.sqrt() + error) + SUM_ROUNDING * (norm + mean))
    }

    /// Projects a window of the subspace's metric.
    pub(super) fn project(&self, window: &CentredWindow) -> Projection {
        if self.legs_only {
            self.project_lanes::<LEG_LANES, { 2 * LEG_LANES }>(window)
        } else {
            self.project_lanes::<LANES, { 2 * LANES }>(window)
        }
    }

    /// [`Subspace::project`] using the first `H` lanes of heights and `G` of the ground plane; the others are zero.
    fn project_lanes<const H: usize, const G: usize>(&self, window: &CentredWindow) -> Projection {
        let frames = self.mean.len();
        let (mut height, mut ground) = (window.height, window.ground);
        let (height, ground) = (&mut height[..frames], &mut ground[..frames]);
        subtract_multiples::<H>(height, &self.mean, &[1.0]);
        let mut coordinates = [0.0; COORDINATES];
        let (real, complex) = coordinates.split_at_mut(REAL);
        let (of_height, outside) = real.split_at_mut(HEIGHT_DIMENSIONS);
        // All coordinates are computed before any direction is subtracted, so that none waits for another.
        for (c, direction) in of_height.iter_mut().zip(self.height.chunks_exact(frames)) {
            *c = inner_product::<LANES, H, LANES>(height, direction);
        }
        for (c, direction) in complex.chunks_exact_mut(2).zip(self.ground.chunks_exact(frames)) {
            c.copy_from_slice(&complex_product::<G>(ground, direction));
        }
        subtract_multiples::<H>(height, &self.height, of_height);
        subtract_complex_multiples::<G>(ground, &self.ground, complex);
        outside[0] = inner_product::<LANES, H, LANES>(height, height).sqrt();
        outside[1] = inner_product::<{ 2 * LANES }, G, LANES>(ground, ground).sqrt();
        // Window vectors are too large by a factor of √scale.
        let metres = 1.0 / window.scale.sqrt();
        let coordinates = coordinates.map(|c| c * metres);
        let length = coordinates.iter().map(|c| c * c).sum::<f32>().sqrt();
        Projection { coordinates, length, error: ROUNDING * length + INPUT_ROUNDING * window.norm.sqrt() }
    }
}

/// Subtracts multiples of directions, with as many rows as `rows`, in the first `H` lanes: one after the other from
/// each lane.
fn subtract_multiples<const H: usize>(rows: &mut [HeightRow], directions: &[HeightRow], factors: &[f32]) {
    let frames = rows.len();
    for (f, row) in rows.iter_mut().enumerate() {
        for (l, lane) in row[..H].iter_mut().enumerate() {
            let mut rest = Floats::of(lane);
            for (direction, factor) in directions[f..].iter().step_by(frames).zip(factors) {
                rest = rest.minus(Floats::splat(*factor).times(Floats::of(&direction[l])));
            }
            *lane = rest.array();
        }
    }
}

/// Same as [`subtract_multiples`], where x and z of the rows, and two successive factors, are real and imaginary parts.
fn subtract_complex_multiples<const G: usize>(rows: &mut [GroundRow], directions: &[GroundRow], factors: &[f32]) {
    let frames = rows.len();
    for (f, row) in rows.iter_mut().enumerate() {
        for (l, z) in row[..G].chunks_exact_mut(2).enumerate() {
            let [mut rest_re, mut rest_im] = [&z[0], &z[1]].map(Floats::of);
            for (direction, factor) in directions[f..].iter().step_by(frames).zip(factors.chunks_exact(2)) {
                let [re, im] = [factor[0], factor[1]].map(Floats::splat);
                let [b_re, b_im] = [&direction[2 * l], &direction[2 * l + 1]].map(Floats::of);
                rest_re = rest_re.minus(re.times(b_re).minus(im.times(b_im)));
                rest_im = rest_im.minus(re.times(b_im).plus(im.times(b_re)));
            }
            (z[0], z[1]) = (rest_re.array(), rest_im.array());
        }
    }
}

/// Σ z b*, where x and z of the rows are real and imaginary parts.
fn complex_product<const G: usize>(z: &[GroundRow], b: &[GroundRow]) -> [f32; 2] {
    let mut sums = [Floats::splat(0.0); 4];
    for (z, b) in z.iter().zip(b) {
        for (z, b) in z[..G].chunks_exact(2).zip(b.chunks_exact(2)) {
            let [z_re, z_im, b_re, b_im] = [&z[0], &z[1], &b[0], &b[1]].map(Floats::of);
            let products = [z_re.times(b_re), z_im.times(b_im), z_im.times(b_re), z_re.times(b_im)];
            for (sum, product) in sums.iter_mut().zip(products) {
                *sum = sum.plus(product);
            }
        }
    }
    [sums[0].plus(sums[1]), sums[2].minus(sums[3])].map(total)
}

/// Deviation of directions from orthonormality: Frobenius norm of the difference between their Gram matrix and the
/// identity.
fn skew(directions: &[Vec<Complex>]) -> f64 {
    let mut sum = 0.0;
    for (i, a) in directions.iter().enumerate() {
        for (j, b) in directions.iter().enumerate() {
            let [re, im] = inner(a, b);
            let re = re - f64::from(u8::from(i == j));
            sum += re * re + im * im;
        }
    }
    sum.sqrt()
}
