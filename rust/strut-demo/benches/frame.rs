//! `cargo bench -p strut-motion-demo --bench frame`: a whole frame of the engine on the database of [`benchmark`].
#![allow(missing_docs)] // Criterion's macro makes an undocumented public function.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;
use strut_core::transfer::{Model, Options, Stylizer};
use strut_demo::benchmark::{self, PAPER_FRAMES};

fn frame(c: &mut Criterion) {
    let database = benchmark::database(PAPER_FRAMES).expect("the motions are valid");
    let model = Arc::new(Model::new(database));
    let queries = benchmark::queries();
    let query = &queries[0];
    let labelled = Options { action: Some(query.action), input_style: Some(query.style), ..Options::DEFAULT };
    let all = Options { least_weight: 0.0, ..Options::DEFAULT };
    let mut group = c.benchmark_group("frame");
    for (name, options, styles) in [
        ("labelled", labelled, 1),
        ("unlabelled", Options::DEFAULT, 1),
        ("unlabelled, 3 styles", Options::DEFAULT, 3),
        ("all", all, 1),
    ] {
        let mut stylizer = Stylizer::new(Arc::clone(&model), options).expect("the class exists");
        let share = |style| if style < styles { 1.0 / styles as f32 } else { 0.0 };
        let weights: Vec<f32> = (0..model.catalogue().styles.len()).map(share).collect();
        stylizer.set_styles(&weights).expect("one weight a style");
        let mut poses = query.motion.poses.iter().cycle();
        group.bench_function(name, |b| {
            b.iter(|| poses.next().map(|pose| black_box(stylizer.push(pose).dt_secs)));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(50);
    targets = frame
}
criterion_main!(benches);
