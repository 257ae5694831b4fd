//! `cargo bench -p strut-demo --bench walk`: frames of walks by the model of the built-in styles.
#![allow(missing_docs)] // Criterion's macro makes an undocumented public function.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;
use strut_core::hsmm::{LabelledClip, Options, RuntimeWalkModel, Track, WALK, Walker, train, walk_of};
use strut_core::humanoid::Proportions;
use strut_core::parallel::Sequential;

/// The model of the built-in walks.
fn model() -> Arc<RuntimeWalkModel> {
    let tracks: Vec<(String, Track)> = strut_demo::clips()
        .into_iter()
        .filter(|clip| clip.action == WALK)
        .filter_map(|clip| Some((clip.style, walk_of(&clip.motion).ok()?.0)))
        .collect();
    let clips: Vec<LabelledClip> = tracks.iter().map(|(style, track)| LabelledClip { style, track }).collect();
    let model = train(&Proportions::default(), &clips, Options::default(), &Sequential).expect("they are walks");
    Arc::new(RuntimeWalkModel::new(&model))
}

fn walk(c: &mut Criterion) {
    let mut walker = Walker::new(model());
    c.bench_function("walk/frame", |b| b.iter(|| black_box(walker.advance().root)));
}

criterion_group!(benches, walk);
criterion_main!(benches);
