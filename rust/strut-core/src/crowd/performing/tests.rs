use super::super::*;
use super::*;
use crate::fixtures::{Gait, NEUTRAL, database, walk};
use crate::humanoid::Role;
use crate::kinematics::WorldPose;
use crate::math::{Vec2, Vec3};
use crate::transfer::{Model, Recorder, Stylizer};

/// A five-second walk in the two styles of a small database.
fn predictions() -> Arc<Predictions> {
    let input = walk(&Gait { period: 63.0, ..NEUTRAL }, 300, 0.15).poses;
    recorded(&input)
}

fn recorded(input: &[Pose]) -> Arc<Predictions> {
    let stylizer = Stylizer::new(Arc::new(Model::new(database())), crate::transfer::Options::DEFAULT).unwrap();
    let mut recorder = Recorder::new(&stylizer);
    for pose in input {
        recorder.push(pose);
    }
    Arc::new(recorder.finish().unwrap())
}

fn performers(count: usize, seed: u32) -> Performers {
    Performers::new(predictions(), Options { count, seed }).unwrap()
}

fn vertex(x: f32, z: f32) -> Vertex {
    Vertex { style: 1, x, z, reach: 4.0, intensity: 1.0 }
}

fn places(performers: &Performers) -> Vec<Vec2> {
    performers.world().chunks_exact(WALKER_FLOATS).map(|of| Vec2::new(of[0], of[2])).collect()
}

fn bits(performers: &Performers) -> Vec<u32> {
    let weights = performers.weights().iter().map(|weight| u32::from(*weight));
    performers.world().iter().map(|v| v.to_bits()).chain(weights).collect()
}

/// Places of all joints of all performers.
fn joints(performers: &Performers) -> Vec<Vec3> {
    performers.world().chunks_exact(JOINT_FLOATS).map(Vec3::from_slice).collect()
}

#[test]
fn performers_stay_on_the_ground_and_apart() {
    for count in [1, 12, 100] {
        let mut performers = performers(count, 7);
        performers.set_field(&[Vertex { intensity: 1.5, ..vertex(-3.0, 0.0) }]).unwrap();
        let mut together = vec![0u16; count * count];
        let (mut farthest, mut longest) = (0.0_f32, 0);
        for _ in 0..60 * TICK_HZ as usize {
            performers.tick();
            let places = places(&performers);
            farthest = places.iter().map(|at| at.length()).fold(farthest, f32::max);
            for (i, a) in places.iter().enumerate() {
                for (j, b) in places.iter().enumerate().take(i) {
                    let ticks = &mut together[i * count + j];
                    *ticks = if a.distance(*b) < 0.25 { *ticks + 1 } else { 0 };
                    longest = longest.max(*ticks);
                }
            }
        }
        println!("{count}: {farthest} m of {} m, together for {longest} ticks", performers.radius());
        assert!(farthest <= 1.2 * performers.radius(), "{farthest} m of {} m, {count}", performers.radius());
        assert!(f32::from(longest) <= TICK_HZ, "{longest} ticks, {count}");
    }
}

#[test]
fn feet_that_stand_do_not_slide_though_their_owner_turns() {
    // A single performer has no others to avoid.
    let mut performers = performers(1, 4);
    performers.set_field(&[vertex(1.0, 1.0)]).unwrap();
    let soles = Soles::new(performers.predictions().proportions());
    let (mut slid, mut stood, mut turned) = (0.0, 0.0, 0.0);
    let mut before = None;
    for _ in 0..30 * TICK_HZ as usize {
        performers.tick();
        let member = &performers.agents[0];
        let (world, planted) = (member.world(), member.planted());
        if let Some((was, was_planted)) = before.replace((world, planted)) {
            let was: WorldPose = was;
            let was_planted: [bool; 2] = was_planted;
            let [a, b] = [was, world].map(|world| world.rotations[0] * Vec3::Z);
            turned += a.cross(b).y.abs();
            for side in 0..2 {
                if planted[side] && was_planted[side] {
                    slid += soles.of(&world, side).pivot_travel(&soles.of(&was, side)).length();
                    stood += 1.0 / TICK_HZ;
                }
            }
        }
    }
    let skate = slid / stood;
    println!("{:.1} cm/s over {stood:.1} s", 100.0 * skate);
    assert!(stood > 15.0 && turned > 1.0, "{stood} s, {turned} rad");
    assert!(skate < 0.06, "{skate} m/s");
}

#[test]
fn loops_and_new_fields_cause_no_jumps() {
    let mut performers = performers(40, 2);
    performers.set_field(&[vertex(2.0, 0.0)]).unwrap();
    let mut before = joints(&performers);
    let mut largest = 0.0_f32;
    // Three loops of the motion, with a field that changes often.
    for tick in 0..15 * TICK_HZ as usize {
        if tick % 40 == 39 {
            let side = if tick % 80 == 79 { 1.0 } else { -1.0 };
            performers.set_field(&[Vertex { intensity: INTENSITY[1], ..vertex(3.0 * side, 1.0) }]).unwrap();
        }
        performers.tick();
        let now = joints(&performers);
        largest = now.iter().zip(&before).map(|(a, b)| a.distance(*b)).fold(largest, f32::max);
        before = now;
    }
    println!("{largest} m");
    // A fast swinging hand or foot moves at 4 m/s, and legs that swap sides in 0.2 s at twice that.
    assert!(largest < 0.3, "{largest} m in a tick");
}

#[test]
fn a_vertex_changes_whoever_it_reaches_within_half_a_second() {
    let mut performers = performers(30, 5);
    (0..30).for_each(|_| performers.tick());
    assert!(performers.weights().iter().all(|weight| *weight == 0));
    performers.set_field(&[Vertex { reach: 10.0, ..vertex(0.0, 0.0) }]).unwrap();
    performers.tick();
    assert!(performers.weights().chunks_exact(2).all(|of| of[1] > 0 && of[1] < 100), "they go over to it");
    (0..15).for_each(|_| performers.tick());
    assert!(performers.weights().chunks_exact(2).all(|of| of[0] == 0 && of[1] > 150), "{:?}", performers.weights());
}

#[test]
fn a_lone_neutral_agent_matches_a_performer() {
    let mut performers = performers(1, 3);
    let predictions = predictions();
    let mut alone = crate::transfer::Performer::new(Arc::clone(&predictions), None);
    // Joints below the hips have the rotations of a frame of the loop, or lie between two.
    let frames: Vec<Pose> = (0..2 * predictions.period()).map(|_| alone.advance().pose).collect();
    let knee = Role::LeftLowerLeg.index();
    for _ in 0..60 {
        performers.tick();
        let own = performers.agents[0].pose().rotations[knee];
        let nearest = frames.iter().map(|pose| pose.rotations[knee].dot(own).abs()).fold(0.0, f32::max);
        assert!(nearest > 0.999, "{nearest}");
    }
}

#[test]
fn motion_in_place_is_not_turned() {
    let mut pose = walk(&NEUTRAL, 1, 0.0).poses[0];
    pose.root.x = 0.0;
    let standing = vec![pose; 60];
    let mut performers = Performers::new(recorded(&standing), Options { count: 3, seed: 1 }).unwrap();
    let seen = |performers: &Performers| -> Vec<(Vec3, Vec3)> {
        let poses = performers.agents.iter().map(Performing::pose);
        poses.map(|pose| (pose.root, pose.rotations[0] * Vec3::Z)).collect()
    };
    (0..10).for_each(|_| performers.tick());
    let before = seen(&performers);
    (0..300).for_each(|_| performers.tick());
    for (was, is) in before.iter().zip(seen(&performers)) {
        assert!(was.0.distance(is.0) < 0.1 && was.1.dot(is.1) > 0.99, "{was:?} {is:?}");
    }
}

#[test]
fn the_same_seed_gives_the_same_bits_also_by_way_of_numbers() {
    let run = |predictions: Arc<Predictions>, seed: u32| {
        let mut performers = Performers::new(predictions, Options { count: 10, seed }).unwrap();
        performers.set_field(&[vertex(2.0, 2.0)]).unwrap();
        (0..200).for_each(|_| performers.tick());
        bits(&performers)
    };
    let own = predictions();
    let carried = Arc::new(Predictions::from_floats(&own.to_floats()).unwrap());
    assert_eq!(run(Arc::clone(&own), 4), run(carried, 4));
    assert_ne!(run(Arc::clone(&own), 4), run(own, 5));
}

#[test]
fn performers_come_and_go_at_the_end() {
    let (few, mut many) = (performers(5, 1), performers(9, 1));
    assert_eq!(few.world(), &many.world()[..few.world().len()], "a performer does not depend on the count");
    many.tick();
    many.set_count(MAX_COUNT).unwrap();
    assert_eq!((many.world().len(), many.weights().len()), (MAX_COUNT * WALKER_FLOATS, 2 * MAX_COUNT));
    many.set_count(3).unwrap();
    many.tick();
    assert_eq!(many.count(), 3);
}

#[test]
fn ahead_gives_the_ticks_of_a_lone_agent() {
    let mut performers = performers(1, 9);
    performers.set_field(&[vertex(1.0, 1.0)]).unwrap();
    (0..50).for_each(|_| performers.tick());
    for pose in performers.ahead(0, 90).unwrap() {
        performers.tick();
        assert_eq!(performers.agents[0].pose(), &pose);
        assert_eq!(performers.world()[..3], pose.root.to_array());
    }
    assert_eq!(performers.ahead(1, 1), None);
}

#[test]
fn invalid_parameters_are_rejected_and_changes_nothing() {
    let predictions = predictions();
    for count in [0, MAX_COUNT + 1] {
        let refused = Performers::new(Arc::clone(&predictions), Options { count, seed: 1 });
        assert_eq!(refused.unwrap_err(), CrowdError::Count(count));
    }
    let (mut crowd, mut other) = (performers(8, 1), performers(8, 1));
    assert_eq!(crowd.set_count(0), Err(CrowdError::Count(0)));
    let style = Vertex { style: 2, ..vertex(0.0, 0.0) };
    assert_eq!(crowd.set_field(&[style]), Err(CrowdError::Style { style: 2, styles: 2 }));
    assert!(matches!(crowd.set_route(&[[0.0, 0.0], [f32::NAN, 1.0]]), Err(CrowdError::Place(_))));
    let mut bones = *predictions.proportions();
    bones.offsets[4].x = f32::NAN;
    assert!(matches!(crowd.set_bones(bones), Err(CrowdError::Bone(_))));
    (0..40).for_each(|_| (crowd.tick(), other.tick()).0);
    assert_eq!(bits(&crowd), bits(&other));
}

#[test]
fn nothing_is_allocated_in_a_tick() {
    let mut performers = performers(20, 1);
    performers.set_field(&[vertex(3.0, 0.0)]).unwrap();
    performers.set_route(&[[-5.0, 0.0], [5.0, 0.0], [0.0, 5.0]]).unwrap();
    performers.tick();
    let counted = allocation_counter::measure(|| (0..200).for_each(|_| performers.tick()));
    assert_eq!(counted.count_total, 0);
}
