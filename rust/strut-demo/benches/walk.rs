//! `cargo bench -p strut-motion-demo --bench walk`: frames of walks from the model of the built-in styles, and of a crowd.
#![allow(missing_docs)] // Criterion's macro makes an undocumented public function.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;
use strut_core::crowd::{self, MAX_COUNT, Vertex, Walkers};
use strut_core::hsmm::{LabelledClip, Options, RuntimeWalkModel, Track, WALK, Walker, train, walk_of};
use strut_core::humanoid::Proportions;
use strut_core::parallel::Sequential;

/// Walk model of the built-in walks.
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
    let model = model();
    let mut walker = Walker::new(Arc::clone(&model));
    c.bench_function("walk/frame", |b| b.iter(|| black_box(walker.advance().root)));

    let mut crowd = Walkers::new(model, crowd::Options { count: MAX_COUNT, seed: 1 }).expect("the count is allowed");
    let vertex = |style: usize, x: f32, z: f32| Vertex { style, x, z, reach: 8.0, intensity: 1.0 };
    crowd
        .set_field(&[vertex(1, 15.0, 0.0), vertex(2, -10.0, 12.0), vertex(3, -8.0, -14.0)])
        .expect("they are vertices");
    c.bench_function("crowd/tick of 1,000", |b| {
        b.iter(|| {
            crowd.tick();
            black_box(crowd.world()[0])
        });
    });
}

criterion_group!(benches, walk);
criterion_main!(benches);
