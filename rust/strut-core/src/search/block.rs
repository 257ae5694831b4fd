//! Sixteen quantised windows: lower bounds of their distances to a query in a few hundred instructions.
//!
//! Coordinates in the [subspace](super::subspace) are 16-bit integers. No vector is longer than [`MAX_LENGTH`], except
//! for rounding, so that by the Cauchy–Schwarz inequality no inner product exceeds 32 bits.

use super::lanes::{FloatLane, Floats, Integers, Pairs};
use super::subspace::{COORDINATES, GROUND_DIMENSIONS, Projection, REAL};

/// Number of windows of a block.
pub(super) const BLOCK: usize = 16;
/// Blocks are computed four windows at a time.
pub(super) const QUADS: usize = BLOCK / 4;
const REAL_PAIRS: usize = REAL / 2;
const PAIRS: usize = COORDINATES / 2;

/// Integers per metre.
pub(super) const PER_METRE: f32 = 32_760.0;
/// Greatest length of a vector in metres, twice a person's reach.
const MAX_LENGTH: f32 = 1.0;
/// Bound on the error of a vector by rounding to integers, √40 · 0.51, including the error of comparing lengths of this
/// size.
pub(super) const QUANTISATION: f32 = 4.0;
/// Bound on the rounding error of [`Block::squared_distances`]: integers below 2³⁰ are converted to floats (32 each),
/// and combined by sums, a root and differences; 1 120 in all.
pub(super) const ERROR: f32 = 2048.0;

/// A window as integers.
pub(super) type Point = [i16; COORDINATES];

/// Quantises a vector; one that is too long is shortened.
///
/// Shortening is the projection onto a ball, which does not increase the distance of any two vectors: bounds stay valid.
pub(super) fn quantise(of: &Projection) -> Point {
    let scale = if of.length <= MAX_LENGTH { PER_METRE } else { PER_METRE * MAX_LENGTH / of.length };
    // Rounded to nearest by truncating a positive number, for which every machine has an instruction.
    of.coordinates.map(|c| ((c * scale + 65_536.5) as i32 - 65_536) as i16)
}

/// Returns whether a point may belong to a window whose projection has this squared length with an error of at most
/// `error`, metres². [`quantise`] limits the length of points.
pub(super) fn has_squared_length(point: &Point, expected: f32, error: f32) -> bool {
    let found: i64 = point.iter().map(|&v| i64::from(v) * i64::from(v)).sum();
    let found = found as f64 / f64::from(PER_METRE * PER_METRE);
    let (expected, error) = (f64::from(expected), f64::from(error));
    let longest = f64::from(MAX_LENGTH * MAX_LENGTH);
    let [least, greatest] = [expected - error, expected + error].map(|squared| squared.clamp(0.0, longest).sqrt());
    let rounding = f64::from(QUANTISATION / PER_METRE);
    (least - rounding..=greatest + rounding).contains(&found.sqrt())
}

/// Squared length, below 2³¹.
pub(super) fn squared_length(point: &Point) -> i32 {
    point.iter().map(|&v| i32::from(v) * i32::from(v)).sum()
}

/// ⟨a, b⟩ of the complex parts.
pub(super) fn complex_product(a: &Point, b: &Point) -> [i32; 2] {
    let (mut re, mut im) = (0_i32, 0_i32);
    for (a, b) in a[REAL..].chunks_exact(2).zip(b[REAL..].chunks_exact(2)) {
        let [a, b] = [a, b].map(|v| [i32::from(v[0]), i32::from(v[1])]);
        re += a[0] * b[0] + a[1] * b[1];
        im += a[1] * b[0] - a[0] * b[1];
    }
    [re, im]
}

/// A query in the layout of a block: every pair is repeated four times.
#[derive(Clone, Copy, Debug)]
pub(super) struct Probe {
    straight: [Pairs; PAIRS],
    /// −i times the complex part.
    turned: [Pairs; GROUND_DIMENSIONS],
    squared_length: f32,
}

impl Probe {
    pub(super) fn new(point: &Point) -> Self {
        let splat = |a: i16, b: i16| [a, b, a, b, a, b, a, b];
        Self {
            straight: std::array::from_fn(|p| splat(point[2 * p], point[2 * p + 1])),
            turned: std::array::from_fn(|p| splat(point[REAL + 2 * p + 1], -point[REAL + 2 * p])),
            squared_length: squared_length(point) as f32,
        }
    }
}

/// Squared distances of sixteen windows, four at a time.
#[derive(Clone, Copy, Debug)]
pub(super) struct SquaredDistances(pub(super) [FloatLane; QUADS]);

impl SquaredDistances {
    /// Bit i is set unless number i is greater than limit i. It is also set if the limit is NaN.
    #[inline]
    pub(super) fn within(&self, limits: &[FloatLane; QUADS]) -> u32 {
        let pairs = self.0.iter().zip(limits).rev();
        pairs.fold(0, |bits, (s, limit)| (bits << 4) | (Floats::of(s).greater_than(Floats::of(limit)) ^ 15))
    }
}

/// Sixteen windows.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pairs: [[Pairs; PAIRS]; QUADS],
    squared_lengths: [FloatLane; QUADS],
}

impl Block {
    /// Creates a block of at most sixteen points; the others are zero.
    pub(super) fn new(points: &[Point]) -> Self {
        let mut block = Self { pairs: [[[0; 8]; PAIRS]; QUADS], squared_lengths: [[0.0; 4]; QUADS] };
        for (i, point) in points.iter().enumerate() {
            for (p, pair) in point.chunks_exact(2).enumerate() {
                block.pairs[i / 4][p][2 * (i % 4)..][..2].copy_from_slice(pair);
            }
            block.squared_lengths[i / 4][i % 4] = squared_length(point) as f32;
        }
        block
    }

    /// Integers of window `i`.
    pub(super) fn point(&self, i: usize) -> Point {
        std::array::from_fn(|c| self.pairs[i / 4][c / 2][2 * (i % 4) + c % 2])
    }

    /// Squared distances of the windows to the query, modulo the phase of the complex part and within [`ERROR`].
    #[inline(never)]
    pub(super) fn squared_distances(&self, probe: &Probe) -> SquaredDistances {
        SquaredDistances(std::array::from_fn(|quad| self.squared_distances_of_quad(probe, quad).array()))
    }

    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn squared_distances_of_quad(&self, probe: &Probe, quad: usize) -> Floats {
        let (real, complex) = self.pairs[quad].split_at(REAL_PAIRS);
        let product = |a: &[Pairs], b: &[Pairs]| {
            let sum = a.iter().zip(b).fold(Integers::zero(), |sum, (a, b)| sum.plus(Integers::products(a, b)));
            sum.floats()
        };
        let re = product(complex, &probe.straight[REAL_PAIRS..]);
        let im = product(complex, &probe.turned);
        let product = product(real, &probe.straight).plus(re.times(re).plus(im.times(im)).root());
        let lengths = Floats::splat(probe.squared_length).plus(Floats::of(&self.squared_lengths[quad]));
        lengths.minus(product.plus(product))
    }
}
