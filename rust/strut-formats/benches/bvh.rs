//! Throughput of the BVH parser and writer in bytes of text per second, on a generated clip of the usual form: 22
//! joints with six channels each, six decimals.
#![allow(missing_docs)] // Criterion's macro makes an undocumented public function.

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use strut_core::math::float_funcs::double;
use strut_formats::bvh::{self, Axis, Bvh, Channel, Joint};

const FRAMES: usize = 2000;
const JOINTS: usize = 22;

fn generated() -> Bvh {
    let axes = [Axis::X, Axis::Y, Axis::Z];
    let channels: Vec<Channel> = axes.map(Channel::Position).into_iter().chain(axes.map(Channel::Rotation)).collect();
    let joints = (0..JOINTS).map(|i| Joint {
        name: format!("Joint{i}"),
        name_bytes: None,
        parent: i.checked_sub(1),
        offset: [0.0, 12.5, 0.25],
        channels: channels.clone(),
        end_site: (i + 1 == JOINTS).then_some([0.0, 5.0, 0.0]),
    });
    let channels = JOINTS * channels.len();
    let value = |i: usize| (double::sin(i as f64 * 0.37) * 180e6).round() / 1e6;
    Bvh {
        added_positions: false,
        joints: joints.collect(),
        frame_time_secs: 1.0 / 60.0,
        frames: FRAMES,
        values: (0..FRAMES * channels).map(value).collect(),
    }
}

fn benchmark(criterion: &mut Criterion) {
    let document = generated();
    let text = bvh::write(&document);
    let mut group = criterion.benchmark_group("bvh");
    group.throughput(Throughput::BytesDecimal(text.len() as u64)).sample_size(20);
    group.bench_function("parse", |b| b.iter(|| bvh::parse(&text)));
    group.bench_function("write", |b| b.iter(|| bvh::write(&document)));
    group.bench_function("to_motion", |b| b.iter_batched(|| (), |()| document.to_motion(), BatchSize::PerIteration));
    group.finish();
}

criterion_group!(benches, benchmark);
criterion_main!(benches);
