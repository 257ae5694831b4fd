//! An order of windows in which near windows are adjacent.

use super::block::{BLOCK, Point, complex_product, squared_length};
use super::subspace::REAL;
use crate::math::order::sort_pairs;

/// Sorts `items`, indices of points, such that every sixteen are near each other.
///
/// A ball tree without its nodes: the items are split by which of two distant items is nearer, then each half is split
/// recursively.
pub(super) fn arrange(points: &[Point], items: &mut [usize]) {
    if items.len() <= BLOCK {
        return;
    }
    let first = farthest(points, items, items[0]);
    let second = farthest(points, items, first);
    let side = |i: usize| separation(&points[i], &points[first]) - separation(&points[i], &points[second]);
    let mut sides: Vec<(f32, usize)> = items.iter().map(|&i| (side(i), i)).collect();
    sort_pairs(&mut sides);
    items.iter_mut().zip(sides).for_each(|(item, (_, i))| *item = i);
    // All leaves except the last are full.
    let (left, right) = items.split_at_mut((items.len() / 2).next_multiple_of(BLOCK));
    arrange(points, left);
    arrange(points, right);
}

fn farthest(points: &[Point], items: &[usize], from: usize) -> usize {
    let mut best = (f32::NEG_INFINITY, from);
    for &i in items {
        let distance = separation(&points[i], &points[from]);
        if distance > best.0 {
            best = (distance, i);
        }
    }
    best.1
}

/// Squared distance modulo the phase of the complex part.
fn separation(a: &Point, b: &Point) -> f32 {
    let real: i32 = a[..REAL].iter().zip(&b[..REAL]).map(|(&a, &b)| i32::from(a) * i32::from(b)).sum();
    let [re, im] = complex_product(a, b).map(|v| v as f32);
    let lengths = squared_length(a) as f32 + squared_length(b) as f32;
    lengths - 2.0 * (real as f32 + (re * re + im * im).sqrt())
}
