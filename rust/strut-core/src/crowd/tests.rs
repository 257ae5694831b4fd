use super::*;
use crate::hsmm::tests::runtime;
use crate::hsmm::{RATE_HZ, STEP_FRAMES};
use crate::humanoid::Role;
use crate::math::{Vec2, Vec3};

fn crowd(count: usize, seed: u32) -> Walkers {
    Walkers::new(runtime(2), Options { count, seed }).unwrap()
}

fn vertex(style: usize, x: f32, z: f32) -> Vertex {
    Vertex { style, x, z, reach: 4.0, intensity: 1.0 }
}

fn places(crowd: &Walkers) -> Vec<Vec2> {
    crowd.world().chunks_exact(WALKER_FLOATS).map(|walker| Vec2::new(walker[0], walker[2])).collect()
}

fn bits(crowd: &Walkers) -> Vec<u32> {
    crowd.world().iter().map(|v| v.to_bits()).chain(crowd.weights().iter().map(|w| u32::from(*w))).collect()
}

#[test]
fn walkers_stay_on_the_ground() {
    for count in [1, 12, 60, 300] {
        let mut crowd = crowd(count, 7);
        crowd.set_field(&[vertex(0, 3.0, 2.0), Vertex { intensity: 1.5, ..vertex(1, -3.0, 0.0) }]).unwrap();
        for _ in 0..60 * RATE_HZ as usize {
            crowd.tick();
            let farthest = places(&crowd).iter().map(|at| at.length()).fold(0.0, f32::max);
            assert!(farthest <= 1.2 * crowd.radius(), "{farthest} m of {} m, {count}", crowd.radius());
        }
    }
}

#[test]
fn walkers_stay_apart() {
    const COUNT: usize = 300;
    for seed in [1, 2] {
        let mut crowd = crowd(COUNT, seed);
        let mut together = vec![0u16; COUNT * COUNT];
        let (mut longest, mut overlaps) = (0, 0);
        for _ in 0..60 * RATE_HZ as usize {
            crowd.tick();
            let places = places(&crowd);
            for (i, a) in places.iter().enumerate() {
                for (j, b) in places.iter().enumerate().take(i) {
                    let frames = &mut together[i * COUNT + j];
                    *frames = if a.distance(*b) < 0.25 { *frames + 1 } else { 0 };
                    longest = longest.max(*frames);
                    overlaps += u32::from(*frames > 0);
                }
            }
        }
        println!("seed {seed}: longest {longest} frames, {overlaps} in all");
        assert!(f32::from(longest) <= RATE_HZ, "{longest} frames");
    }
}

#[test]
fn people_keep_crossing_the_ground() {
    for count in [60, 200] {
        let mut crowd = crowd(count, 1);
        for minute in 1..=2 {
            let (mut within, mut standing) = (0, 0);
            for _ in 0..60 {
                let before = places(&crowd);
                (0..RATE_HZ as usize).for_each(|_| crowd.tick());
                let now = places(&crowd);
                within += now.iter().filter(|at| at.length() < 0.7 * crowd.radius()).count();
                standing += before.iter().zip(&now).filter(|(a, b)| a.distance(**b) < 0.15).count();
            }
            let share = |number: usize| number as f32 / (60 * count) as f32;
            let (within, standing) = (share(within), share(standing));
            assert!(within > 0.5, "{within} of {count} are within 0.7 radii in minute {minute}");
            assert!(standing < 0.15, "{standing} of {count} stand in minute {minute}");
        }
    }
}

#[test]
fn the_crowd_walks() {
    let mut crowd = crowd(100, 3);
    let mut way = 0.0;
    for _ in 0..20 * RATE_HZ as usize {
        let before = places(&crowd);
        crowd.tick();
        way += before.iter().zip(places(&crowd)).map(|(a, b)| a.distance(b)).sum::<f32>();
    }
    let speed = way / 100.0 / 20.0;
    assert!(speed > 0.5, "{speed} m/s on average");
}

#[test]
fn who_is_reached_by_a_vertex_changes_with_their_next_step() {
    let mut crowd = crowd(50, 5);
    crowd.set_field(&[vertex(0, 0.0, 0.0)]).unwrap();
    (0..60).for_each(|_| crowd.tick());
    crowd.set_field(&[vertex(1, 0.0, 0.0)]).unwrap();
    let mut begun = [false; 50];
    for _ in 0..=STEP_FRAMES[1] as usize {
        let (weights, steps): (Vec<u8>, Vec<u64>) =
            (crowd.weights().to_vec(), crowd.agents.iter().map(|m| m.walker.step().0).collect());
        crowd.tick();
        for (i, begun) in begun.iter_mut().enumerate() {
            let own = 2 * i..2 * i + 2;
            let begins = crowd.agents[i].walker.step().0 != steps[i];
            let changes = crowd.weights()[own.clone()] != weights[own.clone()];
            assert!(begins || !changes, "{i} changes within a step");
            if begins && !*begun {
                *begun = true;
                let [first, second] = crowd.weights()[own] else { panic!() };
                assert!(first == 0 && second > 10, "{i}: {first} {second}");
            }
        }
    }
    assert!(begun.iter().all(|begun| *begun));
}

#[test]
fn people_gather_on_a_route() {
    let mut crowd = crowd(40, 2);
    crowd.set_route(&[[-5.0, 0.0], [5.0, 0.0]]).unwrap();
    (0..20 * RATE_HZ as usize).for_each(|_| crowd.tick());
    let mean = |of: fn(&Vec2) -> f32| places(&crowd).iter().map(|at| of(at).abs()).sum::<f32>() / 40.0;
    let aside = mean(|at| at.y);
    crowd.set_route(&[]).unwrap();
    (0..20 * RATE_HZ as usize).for_each(|_| crowd.tick());
    let free = places(&crowd).iter().map(|at| at.y.abs()).sum::<f32>() / 40.0;
    assert!(aside < 3.0 && free > aside, "{aside} m, {free} m");
}

/// The place of a joint of a walker.
fn joint(crowd: &Walkers, walker: usize, role: Role) -> Vec3 {
    Vec3::from_slice(&crowd.world()[WALKER_FLOATS * walker + JOINT_FLOATS * role.index()..][..3])
}

#[test]
fn joints_lie_on_the_bones_of_another_body_and_its_feet_stay_where_they_stand() {
    let (mut own, mut other) = (crowd(20, 3), crowd(20, 3));
    let mut bones = *runtime(2).proportions();
    let neck = bones.offsets[Role::Neck.index()] + Vec3::new(0.0, 0.1, 0.02);
    bones.offsets[Role::Neck.index()] = neck;
    other.set_bones(bones).unwrap();
    for _ in 0..90 {
        own.tick();
        other.tick();
        for walker in 0..20 {
            for role in [Role::Hips, Role::LeftFoot, Role::RightToes] {
                let [was, is] = [&own, &other].map(|crowd| joint(crowd, walker, role));
                assert!(was.distance(is) < 1e-5, "{role:?} of {walker}: {was} {is}");
            }
            let [neck_at, parent] = [Role::Neck, Role::Chest].map(|role| joint(&other, walker, role));
            assert!((neck_at.distance(parent) - neck.length()).abs() < 1e-5);
        }
    }
    assert_eq!(own.weights(), other.weights());
    for bad in [f32::NAN, f32::INFINITY, 10.5] {
        let before = bits(&other);
        bones.offsets[4].x = bad;
        assert!(matches!(other.set_bones(bones), Err(CrowdError::Bone(_))));
        assert_eq!(bits(&other), before);
    }
}

#[test]
fn the_same_seed_gives_the_same_bits() {
    let run = |seed: u32| {
        let mut crowd = crowd(30, seed);
        crowd.set_field(&[vertex(1, 2.0, 2.0)]).unwrap();
        (0..200).for_each(|_| crowd.tick());
        bits(&crowd)
    };
    assert_eq!(run(4), run(4));
    assert_ne!(run(4), run(5));
}

#[test]
fn walkers_come_and_go_at_the_end() {
    let (few, mut crowd) = (crowd(10, 1), crowd(20, 1));
    assert_eq!(few.world(), &crowd.world()[..few.world().len()], "a walker does not depend on the count");
    (0..30).for_each(|_| crowd.tick());
    let before = bits(&crowd);
    crowd.set_count(1000).unwrap();
    assert_eq!(
        crowd.world()[..20 * WALKER_FLOATS].iter().map(|v| v.to_bits()).collect::<Vec<_>>(),
        before[..20 * WALKER_FLOATS]
    );
    assert_eq!((crowd.world().len(), crowd.weights().len()), (1000 * WALKER_FLOATS, 2000));
    crowd.tick();
    crowd.set_count(3).unwrap();
    crowd.tick();
    assert_eq!(crowd.count(), 3);
}

#[test]
fn the_next_frames_are_those_that_come_to_who_is_alone() {
    let mut crowd = crowd(1, 9);
    crowd.set_field(&[vertex(1, 1.0, 1.0)]).unwrap();
    (0..50).for_each(|_| crowd.tick());
    let ahead = crowd.ahead(0, 90).unwrap();
    for pose in ahead {
        crowd.tick();
        assert_eq!(crowd.agents[0].walker.pose(), &pose);
        assert_eq!(crowd.world()[..3], pose.root.to_array());
    }
    assert_eq!(crowd.ahead(1, 1), None);
}

#[test]
fn invalid_parameters_are_rejected() {
    for count in [0, MAX_COUNT + 1] {
        let refused = Walkers::new(runtime(2), Options { count, seed: 1 });
        assert_eq!(refused.unwrap_err(), CrowdError::Count(count));
    }
    let (mut crowd, mut other) = (crowd(8, 1), crowd(8, 1));
    assert_eq!(crowd.set_count(0), Err(CrowdError::Count(0)));
    assert_eq!(crowd.set_field(&[vertex(2, 0.0, 0.0)]), Err(CrowdError::Style { style: 2, styles: 2 }));
    assert!(matches!(crowd.set_route(&[[0.0, 0.0], [f32::NAN, 1.0]]), Err(CrowdError::Place(_))));
    (0..40).for_each(|_| (crowd.tick(), other.tick()).0);
    assert_eq!(bits(&crowd), bits(&other), "what was refused has changed nothing");
}

#[test]
fn one_style_is_enough() {
    let mut crowd = Walkers::new(runtime(1), Options { count: 5, seed: 1 }).unwrap();
    crowd.set_field(&[Vertex { intensity: 2.0, ..vertex(0, 0.0, 0.0) }]).unwrap();
    (0..100).for_each(|_| crowd.tick());
    assert!(crowd.world().iter().all(|v| v.is_finite()) && crowd.weights().iter().any(|w| *w > 0));
}

#[test]
fn nothing_is_allocated_in_a_tick() {
    let mut crowd = crowd(50, 1);
    crowd.set_field(&[vertex(0, 3.0, 0.0), vertex(1, -3.0, 0.0)]).unwrap();
    crowd.set_route(&[[-5.0, 0.0], [5.0, 0.0], [0.0, 5.0]]).unwrap();
    crowd.tick();
    let counted = allocation_counter::measure(|| (0..200).for_each(|_| crowd.tick()));
    assert_eq!(counted.count_total, 0);
}
