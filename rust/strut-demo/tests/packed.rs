//! The packed file that the page loads reproduces the built-in motions.

use strut_core::kinematics::world_from_local;
use strut_demo::{database, input_clips};
use strut_formats::strutdb::packed::{self, NamedMotion};

#[test]
fn packing_moves_no_joint_by_a_fifth_of_a_millimetre() {
    let db = database().unwrap();
    let inputs: Vec<NamedMotion> =
        input_clips().into_iter().map(|c| NamedMotion { name: c.name.into(), motion: c.motion }).collect();
    let file = packed::write(&db, &inputs);
    let back = packed::read_database(&file).unwrap();
    let clouds = db.point_cloud.iter().flatten().zip(back.point_cloud.iter().flatten());
    let mut worst = clouds.map(|(a, b)| (*a - *b).length()).fold(0.0, f32::max);
    println!("database: {:.3} mm", 1e3 * worst);
    for input in &inputs {
        let read = packed::read_input(&file, &input.name).unwrap().unwrap();
        for (a, b) in input.motion.poses.iter().zip(&read.poses) {
            let at = |pose| world_from_local(&input.motion.proportions, pose).positions;
            worst = at(a).iter().zip(at(b)).map(|(a, b)| (*a - b).length()).fold(worst, f32::max);
        }
    }
    println!("and inputs: {:.3} mm", 1e3 * worst);
    assert!(worst < 2e-4, "{worst} m");
    let rows = db.counterpart.iter().zip(&back.counterpart).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(rows <= packed::ROW_STEP, "{rows} rows");
}
