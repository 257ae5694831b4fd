//! Search for the 40 nearest windows of each of 48 classes, compared with brute force: `STRUT_DB=FILE cargo bench -p
//! strut-motion-core --bench search [-- FILTER]`. A part of the database in the file is held out for queries, and the
//! rest is grown to each size; `FRAMES=20000,1600000` selects other sizes.

#![allow(missing_docs)] // of the function that criterion makes

mod grown;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use strut_core::search::{Index, Metric, Neighbours, Scratch};

const CLASSES: usize = 48;
const K: usize = 40;

fn search(criterion: &mut Criterion) {
    let Ok(path) = std::env::var("STRUT_DB") else {
        println!("skipped: set STRUT_DB to a database of real motion");
        return;
    };
    let db = strut_formats::strutdb::read(&std::fs::read(path).unwrap()).unwrap().database;
    let windows = grown::held_out(&db);
    let sizes = std::env::var("FRAMES").unwrap_or_else(|_| "20000,80000,400000".into());
    for frames in sizes.split(',').map(|n| n.parse().unwrap()) {
        let db = grown::grown(&db, frames, CLASSES);
        let index = Index::build(&db);
        let mut group = criterion.benchmark_group(format!("search/{frames}"));
        group.bench_function("index", |b| b.iter(|| Index::build(&db)));
        let plan = index.plan();
        group.bench_function("index of a plan", |b| {
            b.iter_batched(
                || (db.clone(), plan.clone()),
                |(db, plan)| Index::from_plan(&db, plan).unwrap(),
                BatchSize::LargeInput,
            );
        });

        let classes: Vec<usize> = (0..CLASSES).collect();
        let (mut scratch, mut found) = (Scratch::default(), vec![Neighbours::default(); CLASSES]);
        let (mut one, mut union) = (Neighbours::default(), Neighbours::default());
        let mut queries = windows.iter().cycle();
        group.bench_function("all classes", |b| {
            b.iter(|| {
                let query = index.prepare(queries.next().unwrap(), Metric::FullBody);
                for (class, out) in classes.iter().zip(&mut found) {
                    index.nearest(&query, &[*class], K, &mut scratch, out);
                }
            });
        });
        group.bench_function("all classes, cold", |b| {
            let mut apart = windows.iter().cycle().step_by(97);
            let cold = || (apart.next().unwrap(), vec![Neighbours::default(); CLASSES]);
            b.iter_batched(
                cold,
                |(window, mut found)| {
                    let query = index.prepare(window, Metric::FullBody);
                    for (class, out) in classes.iter().zip(&mut found) {
                        index.nearest(&query, &[*class], K, &mut scratch, out);
                    }
                },
                BatchSize::SmallInput,
            );
        });
        group.bench_function("one class", |b| {
            b.iter(|| {
                let query = index.prepare(queries.next().unwrap(), Metric::FullBody);
                index.nearest(&query, &[CLASSES / 2], K, &mut scratch, &mut one);
            });
        });
        group.bench_function("union of 8 classes, legs", |b| {
            b.iter(|| {
                let query = index.prepare(queries.next().unwrap(), Metric::LowerBody);
                index.nearest(&query, &classes[8..16], K, &mut scratch, &mut union);
            });
        });
        group.bench_function("all classes, brute force", |b| {
            b.iter(|| {
                let query = index.prepare(queries.next().unwrap(), Metric::FullBody);
                for class in &classes {
                    index.nearest_by_brute_force(&query, &[*class], K, black_box(&mut one));
                }
            });
        });
    }
}

criterion_group!(benches, search);
criterion_main!(benches);
