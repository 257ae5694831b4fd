//! Nearest recorded style, compared with a scan of all: `cargo bench -p strut-motion-core --bench nearest_style`.

#![allow(missing_docs)] // of the function that criterion makes

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;
use strut_core::humanoid::{JOINTS, Proportions};
use strut_core::math::Quat;
use strut_core::math::random::SplitMix64;
use strut_core::somn::{KeyStyleModel, MAX_AXES, Measure, PoseSpace, Style, Synthesis};

const AXES: usize = 2;
const QUERIES: usize = 500;

/// Styles as in a walk: on a ring about the mean, with some inside it.
fn ring(random: &mut SplitMix64, frames: usize) -> Vec<Style> {
    let style = || loop {
        let [x, y] = place(random);
        if (1.2..2.2).contains(&(x * x + y * y)) {
            return [x, y, 0.0];
        }
    };
    std::iter::repeat_with(style).take(frames).collect()
}

/// A random point within two standard deviations on either axis.
fn place(random: &mut SplitMix64) -> [f64; AXES] {
    std::array::from_fn(|_| random.below(1 << 20) as f64 / f64::from(1 << 18) - 2.0)
}

fn synthesis(styles: Vec<Style>) -> Synthesis {
    Synthesis::new(Arc::new(KeyStyleModel {
        space: PoseSpace::new(&Proportions::default(), [Quat::IDENTITY; JOINTS]),
        axes: Measure::parse_list("foot_separation, foot_height_difference").unwrap(),
        style_mean: [0.0; MAX_AXES],
        style_deviation: [1.0; MAX_AXES],
        components: Vec::new(),
        variance: 1.0,
        least_support: 0.0,
        travels: true,
        clips: Vec::new(),
        rows: Vec::new(),
        styles,
    }))
}

/// First frame of the nearest ones, found by comparing all.
fn scanned(styles: &[Style], u: &Style) -> Option<usize> {
    let square = |v: &Style| (0..MAX_AXES).map(|j| (u[j] - v[j]) * (u[j] - v[j])).sum::<f64>();
    let all = styles.iter().enumerate().map(|(frame, v)| (square(v), frame));
    all.reduce(|a, b| if b.0 < a.0 { b } else { a }).map(|(_, frame)| frame)
}

fn nearest_style(criterion: &mut Criterion) {
    let mut random = SplitMix64::new(1);
    let queries: Vec<Style> = (0..QUERIES).map(|_| place(&mut random)).map(|[x, y]| [x, y, 0.0]).collect();
    let mut group = criterion.benchmark_group(format!("{QUERIES} styles"));
    for frames in [500, 5000, 50_000] {
        let styles = ring(&mut random, frames);
        let synthesis = synthesis(styles.clone());
        assert!(queries.iter().all(|u| synthesis.nearest(u) == scanned(&styles, u)));
        group.bench_with_input(BenchmarkId::new("scan", frames), &styles, |b, styles| {
            b.iter(|| queries.iter().for_each(|u| _ = black_box(scanned(styles, black_box(u)))));
        });
        group.bench_with_input(BenchmarkId::new("nearest", frames), &synthesis, |b, synthesis| {
            b.iter(|| queries.iter().for_each(|u| _ = black_box(synthesis.nearest(black_box(u)))));
        });
        group.bench_with_input(BenchmarkId::new("within reach", frames), &synthesis, |b, synthesis| {
            b.iter(|| queries.iter().for_each(|u| _ = black_box(synthesis.within_reach(black_box(u)))));
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = nearest_style
}
criterion_main!(benches);
