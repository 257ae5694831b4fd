//! The subspace in which most of the differences between windows lie.
//!
//! A window is a real vector y of heights and a complex one z of the ground plane ([`super::metric`]). Let a be the
//! coordinates of y − mean in an orthonormal basis of a few dimensions, r the length of what lies outside, and c and q
//! the same for z. Then, by the inequalities of Bessel and Cauchy–Schwarz, for any basis and any mean,
//!
//! D ≥ |a − a'|² + (r − r')² + |c|² + |c'|² − 2 |⟨c, c'⟩| + (q − q')².
//!
//! The right-hand side is the squared distance of two short vectors modulo the phase of their complex parts: a metric
//! too. The bound is tightest where the basis holds the directions of greatest variance.

use super::lanes::{Floats, inner_product, total};
use super::metric::{CentredWindow, GroundRow, HeightRow, LANES, POINTS};
use super::principal::{Complex, inner, principal_directions};

/// Dimensions of the basis for heights …
const HEIGHT_DIMENSIONS: usize = 14;
/// … and complex ones of that for the ground plane.
pub(super) const GROUND_DIMENSIONS: usize = 12;
/// Real coordinates: those of the heights and both lengths outside.
pub(super) const REAL: usize = HEIGHT_DIMENSIONS + 2;
/// All coordinates; the complex ones follow the real ones, real and imaginary part in turn.
pub(super) const COORDINATES: usize = REAL + 2 * GROUND_DIMENSIONS;

/// Bound on what rounding does to a projection, as a share of the window's length, for windows of at most 15 frames.
///
/// Each of 38 real coordinates is a sum that rounds at most 82 times (75 products a running sum, and the sums of those),
/// and what remains is off by as much in every direction: √(2 · 38) · 82 · 2⁻²⁴ of the length. Taking a direction away
/// rounds thrice. With 1e-6 for bases that are orthonormal to so much ([`Subspace::from_floats`]) it is 5e-5.
const ROUNDING: f32 = 1.0 / 16_384.0;

/// Bound on what rounding does to the window itself, as a share of its length before the mean is taken off.
const INPUT_ROUNDING: f32 = 1.0 / 4_194_304.0;

/// Greatest departure from orthonormality (Frobenius norm): what rounding to single precision makes.
const MAX_SKEW: f64 = 1e-6;

/// A mean of heights, and orthonormal directions.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Subspace {
    mean: Vec<HeightRow>,
    height: Vec<HeightRow>,
    ground: Vec<GroundRow>,
}

/// A window in the subspace.
#[derive(Clone, Copy, Debug)]
pub(super) struct Projection {
    /// Metres; see [`REAL`].
    pub(super) coordinates: [f32; COORDINATES],
    /// Length of the coordinates.
    pub(super) length: f32,
    /// How far the coordinates may be from those of exact arithmetic.
    pub(super) error: f32,
}

impl Subspace {
    /// Numbers that [`Subspace::floats`] returns.
    pub(super) const fn float_count(frames: usize) -> usize {
        frames * POINTS * (1 + HEIGHT_DIMENSIONS + 2 * GROUND_DIMENSIONS)
    }

    /// The directions in which these windows, each of `frames` frames, differ most.
    pub(super) fn fit(windows: &[CentredWindow], frames: usize) -> Self {
        let dimension = frames * POINTS;
        let root = windows.first().map_or(1.0, |w| f64::from(w.scale).sqrt());
        let mut mean = vec![HeightRow::default(); frames];
        for (f, row) in mean.iter_mut().enumerate() {
            for (i, v) in row.iter_mut().flatten().enumerate() {
                let sum: f64 = windows.iter().map(|w| f64::from(w.height[f].as_flattened()[i])).sum();
                *v = (sum / windows.len().max(1) as f64) as f32;
            }
        }
        let heights = |w: &CentredWindow| -> Vec<Complex> {
            let differences = w.height.iter().flatten().flatten().zip(mean.iter().flatten().flatten());
            differences.map(|(v, m)| [(f64::from(*v) - f64::from(*m)) / root, 0.0]).collect()
        };
        let ground = |w: &CentredWindow| -> Vec<Complex> {
            let lanes = w.ground[..frames].iter().flat_map(|row| row.chunks_exact(2));
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
        };
        let height = directions(&heights, HEIGHT_DIMENSIONS);
        subspace.height.iter_mut().flatten().flatten().zip(height).for_each(|(v, [re, _])| *v = re as f32);
        for (i, [re, im]) in directions(&ground, GROUND_DIMENSIONS).enumerate() {
            let row = &mut subspace.ground[i / POINTS];
            let (lane, at) = (i % POINTS / 4, i % 4);
            row[2 * lane][at] = re as f32;
            row[2 * lane + 1][at] = im as f32;
        }
        Self { mean, ..subspace }
    }

    /// All numbers, as [`Subspace::from_floats`] takes them.
    pub(super) fn floats(&self) -> Vec<f32> {
        let heights = self.mean.iter().chain(&self.height).flatten().flatten();
        heights.chain(self.ground.iter().flatten().flatten()).copied().collect()
    }

    /// Of the numbers of another subspace for windows of so many frames; `None` if they are none: whatever else they
    /// are, bounds hold.
    pub(super) fn from_floats(floats: &[f32], frames: usize) -> Option<Self> {
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
        };
        (subspace.skew() <= MAX_SKEW).then_some(subspace)
    }

    /// How far the directions are from orthonormal.
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
        let mean = inner_product::<LANES, LANES>(&self.mean, &self.mean) / scale;
        ROUNDING * (norm.sqrt() + mean.sqrt()) + INPUT_ROUNDING * norm.sqrt()
    }

    /// A window in this subspace.
    pub(super) fn project(&self, window: &CentredWindow) -> Projection {
        let frames = self.mean.len();
        let (mut height, mut ground) = (window.height, window.ground);
        let (height, ground) = (&mut height[..frames], &mut ground[..frames]);
        add_multiple(height, &self.mean, -1.0);
        let mut coordinates = [0.0; COORDINATES];
        let (real, complex) = coordinates.split_at_mut(REAL);
        let (of_height, outside) = real.split_at_mut(HEIGHT_DIMENSIONS);
        // All coordinates before anything is taken away: none need wait for another.
        for (c, direction) in of_height.iter_mut().zip(self.height.chunks_exact(frames)) {
            *c = inner_product::<LANES, LANES>(height, direction);
        }
        for (c, direction) in complex.chunks_exact_mut(2).zip(self.ground.chunks_exact(frames)) {
            c.copy_from_slice(&complex_product(ground, direction));
        }
        for (c, direction) in of_height.iter().zip(self.height.chunks_exact(frames)) {
            add_multiple(height, direction, -c);
        }
        for (c, direction) in complex.chunks_exact(2).zip(self.ground.chunks_exact(frames)) {
            add_complex_multiple(ground, direction, [-c[0], -c[1]]);
        }
        outside[0] = inner_product::<LANES, LANES>(height, height).sqrt();
        outside[1] = inner_product::<{ 2 * LANES }, LANES>(ground, ground).sqrt();
        // Window vectors carry a factor √scale too much.
        let metres = 1.0 / window.scale.sqrt();
        let coordinates = coordinates.map(|c| c * metres);
        let length = coordinates.iter().map(|c| c * c).sum::<f32>().sqrt();
        Projection { coordinates, length, error: ROUNDING * length + INPUT_ROUNDING * window.norm.sqrt() }
    }
}

/// Adds `factor` · `other`.
fn add_multiple(rows: &mut [HeightRow], other: &[HeightRow], factor: f32) {
    let factor = Floats::splat(factor);
    for (lane, other) in rows.as_flattened_mut().iter_mut().zip(other.as_flattened()) {
        *lane = Floats::of(lane).plus(factor.times(Floats::of(other))).array();
    }
}

/// The same, where x and z of the rows are real and imaginary parts.
fn add_complex_multiple(rows: &mut [GroundRow], other: &[GroundRow], factor: [f32; 2]) {
    let [re, im] = factor.map(Floats::splat);
    for (z, b) in rows.as_flattened_mut().chunks_exact_mut(2).zip(other.as_flattened().chunks_exact(2)) {
        let [b_re, b_im] = [&b[0], &b[1]].map(Floats::of);
        z[0] = Floats::of(&z[0]).plus(re.times(b_re).minus(im.times(b_im))).array();
        z[1] = Floats::of(&z[1]).plus(re.times(b_im).plus(im.times(b_re))).array();
    }
}

/// Σ z b*, where x and z of the rows are real and imaginary parts.
fn complex_product(z: &[GroundRow], b: &[GroundRow]) -> [f32; 2] {
    let mut sums = [Floats::splat(0.0); 4];
    for (z, b) in z.as_flattened().chunks_exact(2).zip(b.as_flattened().chunks_exact(2)) {
        let [z_re, z_im, b_re, b_im] = [&z[0], &z[1], &b[0], &b[1]].map(Floats::of);
        let products = [z_re.times(b_re), z_im.times(b_im), z_im.times(b_re), z_re.times(b_im)];
        for (sum, product) in sums.iter_mut().zip(products) {
            *sum = sum.plus(product);
        }
    }
    [sums[0].plus(sums[1]), sums[2].minus(sums[3])].map(total)
}

/// How far directions are from orthonormal: Frobenius norm of the difference of their inner products from 0 and 1.
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
