//! `cargo bench -p strut-motion-demo --bench key_style`: trains a key-style model of the built-in neutral walks, and
//! computes poses.
#![allow(missing_docs)] // Criterion's macro makes an undocumented public function.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;
use strut_core::hsmm::WALK;
use strut_core::somn::{Measure, Mode, Options, Recording, Synthesis, train};

fn key_style(c: &mut Criterion) {
    let walks: Vec<Recording> = strut_demo::clips()
        .into_iter()
        .filter(|clip| clip.action == WALK && clip.style == "neutral")
        .map(|clip| Recording::new("walk", &clip.motion).expect("it is a walk"))
        .collect();
    let walks: Vec<&Recording> = walks.iter().collect();
    let axes = Measure::parse_list("foot_separation, foot_height_difference").expect("both are measures");
    let model = || train(&walks, &axes, Options::default()).expect("there are enough frames");
    let mut group = c.benchmark_group("key style");
    group.sample_size(10).bench_function("training", |b| b.iter(|| black_box(model().styles.len())));
    group.finish();

    let mut synthesis = Synthesis::new(Arc::new(model()));
    let styles: Vec<_> = synthesis.model().styles.iter().map(|style| synthesis.model().in_units(style)).collect();
    let mut frame = 0;
    c.bench_function("key style/pose", |b| {
        b.iter(|| {
            frame = (frame + 1) % styles.len();
            black_box(synthesis.pose(&styles[frame], Mode::default()).root)
        });
    });
}

criterion_group!(benches, key_style);
criterion_main!(benches);
