//! Tests of the plausibility of the built-in motions, on every take in every style.

use strut_core::contact;
use strut_core::humanoid::{HumanoidMotion, JOINTS, Pose, Proportions, Role};
use strut_core::kinematics::{WorldPose, world_from_local};
use strut_core::math::{Vec3, exp_map};
use strut_core::transfer::beyond_anatomy;
use strut_demo::measure::{self, cycles_between};
use strut_demo::{
    Action, Drill, INTERLUDES, Interlude, JUMPS, KICKS, PUNCHES, Passage, Performance, RATE_HZ, RUN_TAKES, STYLES,
    Script, Style, TRANSITIONS, Transition, WALK_TAKES, WALKING_BANDS, input_clips, perform, perform_drill,
    perform_interlude, perform_transition,
};

/// Points of a sole that can carry the foot: joint, and position in its frame (heel, ball, tip of the toes).
const SOLE: [[(Role, Vec3); 3]; 2] = [
    [
        (Role::LeftFoot, Vec3::new(0.0, -0.118, -0.058)),
        (Role::LeftToes, Vec3::new(0.0, -0.034, 0.0)),
        (Role::LeftToes, Vec3::new(0.0, -0.034, 0.060)),
    ],
    [
        (Role::RightFoot, Vec3::new(0.0, -0.118, -0.058)),
        (Role::RightToes, Vec3::new(0.0, -0.034, 0.0)),
        (Role::RightToes, Vec3::new(0.0, -0.034, 0.060)),
    ],
];

/// Walking and running in every style.
fn takes() -> impl Iterator<Item = (&'static Style, &'static Script, Performance)> {
    STYLES.iter().flat_map(|style| {
        WALK_TAKES.iter().chain(&RUN_TAKES).map(move |script| (style, script, performed(script, style)))
    })
}

const DRILLS: [&Drill; 3] = [&JUMPS, &PUNCHES, &KICKS];

/// Jumps, punches and kicks in every style.
fn drills() -> impl Iterator<Item = (&'static Style, &'static Drill, Performance)> {
    let perform = |drill, style| perform_drill(drill, style, &Proportions::default(), RATE_HZ);
    STYLES.iter().flat_map(move |style| DRILLS.into_iter().map(move |drill| (style, drill, perform(drill, style))))
}

/// Transitions between walking and running in every style.
fn transitions() -> impl Iterator<Item = (&'static Style, &'static Transition, Performance)> {
    let perform = |transition, style| perform_transition(transition, style, &Proportions::default(), RATE_HZ);
    STYLES.iter().flat_map(move |style| TRANSITIONS.iter().map(move |t| (style, t, perform(t, style))))
}

/// Inputs that halt, in every style.
fn interludes() -> impl Iterator<Item = (String, Performance)> {
    let perform = |i: &'static Interlude, style| perform_interlude(i, style, &Proportions::default(), RATE_HZ);
    STYLES.iter().flat_map(move |style| {
        INTERLUDES.iter().map(move |i| (format!("{} {}", style.name, i.name()), perform(i, style)))
    })
}

/// All performances, with a name for messages.
fn everything() -> impl Iterator<Item = (String, Performance)> {
    let gaits = takes().map(|(style, script, take)| (format!("{} {}", style.name, script.name), take));
    let transitions = transitions().map(|(style, t, take)| (format!("{} {}", style.name, t.script.name), take));
    gaits
        .chain(transitions)
        .chain(interludes())
        .chain(drills().map(|(style, drill, take)| (format!("{} {}", style.name, drill.name), take)))
}

fn performed(script: &Script, style: &Style) -> Performance {
    perform(script, style, &Proportions::default(), RATE_HZ)
}

fn style(name: &str) -> &'static Style {
    STYLES.iter().find(|s| s.name == name).expect("a style of this name")
}

fn worlds(motion: &HumanoidMotion) -> Vec<WorldPose> {
    motion.poses.iter().map(|p| world_from_local(&motion.proportions, p)).collect()
}

fn at(world: &WorldPose, (role, local): (Role, Vec3)) -> Vec3 {
    world.positions[role.index()] + world.rotations[role.index()] * local
}

fn mean(values: impl Iterator<Item = f32>) -> f32 {
    let (sum, n) = values.fold((0.0, 0), |(s, n), v| (s + v, n + 1));
    sum / n as f32
}

#[test]
fn a_planted_foot_rests_on_a_point_that_does_not_slide() {
    for (name, take) in everything() {
        let worlds = worlds(&take.motion);
        for (side, sole) in SOLE.iter().enumerate() {
            // Position at which each point of the sole touched down in the current stance.
            let mut touched: [Option<Vec3>; 3] = [None; 3];
            for (world, planted) in worlds.iter().zip(&take.planted) {
                let mut carried = false;
                for (&point, touched) in sole.iter().zip(&mut touched) {
                    let p = at(world, point);
                    carried |= p.y < 1.5e-3;
                    if !planted[side] || p.y > 1e-3 {
                        *touched = None;
                        continue;
                    }
                    let first = *touched.get_or_insert(p);
                    let slid = (p - first).with_y(0.0).length();
                    assert!(slid <= 1e-3, "{name}: {slid} m");
                }
                assert!(carried || !planted[side], "{name}: a planted foot floats");
            }
        }
    }
}

#[test]
fn feet_in_contact_do_not_skate() {
    for (name, take) in everything() {
        let skate = 100.0 * measure::skate(&take.motion, &take.planted);
        assert!(skate <= 0.2, "{name}: {skate} cm/s");
    }
}

#[test]
fn soles_stay_above_the_ground() {
    for (name, take) in everything() {
        let edges = [(Role::LeftFoot, -0.066), (Role::RightFoot, -0.066)].map(|(r, z)| (r, Vec3::new(0.0, -0.118, z)));
        for world in worlds(&take.motion) {
            for &point in SOLE.iter().flatten().chain(&edges) {
                let height = at(&world, point).y;
                assert!(height > -0.005, "{name}: {height} m");
            }
        }
    }
}

#[test]
fn no_joint_of_a_gait_turns_faster_than_people_do_and_none_pops() {
    for (style, script, take) in takes() {
        assert_no_pop(&format!("{} {}", style.name, script.name), &take, 15.0, 750.0);
    }
    for (style, transition, take) in transitions() {
        assert_no_pop(&format!("{} {}", style.name, transition.script.name), &take, 15.0, 900.0);
    }
}

/// A fist reaches 10 m/s and a foot more: joints turn faster than in any gait.
#[test]
fn no_joint_of_a_drill_turns_faster_than_people_do_and_none_pops() {
    for (style, drill, take) in drills() {
        assert_no_pop(&format!("{} {}", style.name, drill.name), &take, 25.0, 1100.0);
    }
}

#[test]
fn who_halts_does_so_without_a_pop() {
    for (name, take) in interludes() {
        assert_no_pop(&name, &take, 25.0, 1100.0);
    }
}

fn assert_no_pop(name: &str, take: &Performance, fastest: f32, hardest: f32) {
    let velocity = |a: &Pose, b: &Pose, j: usize| exp_map::log(a.rotations[j].inv_mul(b.rotations[j])) * RATE_HZ;
    for w in take.motion.poses.windows(3) {
        for role in Role::ALL {
            let (v, next) = (velocity(&w[0], &w[1], role.index()), velocity(&w[1], &w[2], role.index()));
            let (speed, acceleration) = (v.length(), (next - v).length() * RATE_HZ);
            assert!(speed < fastest, "{name} {role:?}: {speed} rad/s");
            assert!(acceleration < hardest, "{name} {role:?}: {acceleration} rad/s²");
        }
    }
}

#[test]
fn no_joint_is_beyond_what_anatomy_allows() {
    for (name, take) in everything() {
        for pose in &take.motion.poses {
            for role in Role::ALL {
                let beyond = beyond_anatomy(role, pose.rotations[role.index()]).to_degrees();
                assert!(beyond == 0.0, "{name} {role:?}: {beyond}°");
            }
        }
    }
}

#[test]
fn jumpers_fall_freely_between_take_off_and_landing() {
    for style in &STYLES {
        let take = perform_drill(&JUMPS, style, &Proportions::default(), 120.0);
        let mut longest = 0;
        let mut flight: Vec<f32> = vec![];
        for (pose, planted) in take.motion.poses.iter().zip(&take.planted) {
            if planted[0] || planted[1] {
                flight.clear();
                continue;
            }
            flight.push(pose.root.y);
            longest = longest.max(flight.len());
            if let [.., a, b, c] = flight[..] {
                let acceleration = (a - 2.0 * b + c) * 120.0 * 120.0;
                assert!((acceleration + 9.81).abs() < 0.5, "{}: {acceleration} m/s²", style.name);
            }
        }
        let secs = longest as f32 / 120.0;
        let wanted = (8.0 * style.jump.rise / 9.81).sqrt();
        assert!((0.8..1.35).contains(&(secs / wanted)), "{}: {secs} s in the air, {wanted} wanted", style.name);
    }
}

#[test]
fn fists_and_feet_strike_ahead_in_bell_shaped_bursts() {
    for (style, drill, take) in drills().filter(|(_, drill, _)| drill.name != JUMPS.name) {
        let strikers = if drill.name == PUNCHES.name {
            [Role::LeftHand, Role::RightHand]
        } else {
            [Role::LeftFoot, Role::RightFoot]
        };
        let worlds = worlds(&take.motion);
        let reach = |w: &WorldPose| strikers.map(|r| w.positions[r.index()].z).into_iter().fold(f32::MIN, f32::max);
        let furthest = worlds.iter().map(reach).fold(f32::MIN, f32::max);
        assert!(furthest > 0.3, "{} {}: {furthest} m", style.name, drill.name);
        let fastest = worlds
            .windows(2)
            .flat_map(|w| strikers.map(|r| (w[1].positions[r.index()] - w[0].positions[r.index()]).length() * RATE_HZ))
            .fold(0.0, f32::max);
        assert!((1.0..14.0).contains(&fastest), "{} {}: {fastest} m/s", style.name, drill.name);
    }
}

#[test]
fn performing_twice_gives_the_same_bits() {
    let bits = |p: &Performance| -> Vec<u32> {
        let numbers = |pose: &Pose| {
            pose.root.to_array().into_iter().chain(pose.rotations.iter().flat_map(|q| q.to_array())).collect::<Vec<_>>()
        };
        p.motion.poses.iter().flat_map(numbers).chain(p.phase.iter().copied()).map(f32::to_bits).collect()
    };
    for script in &WALK_TAKES {
        assert_eq!(bits(&performed(script, &STYLES[1])), bits(&performed(script, &STYLES[1])));
    }
}

#[test]
fn every_style_is_as_fast_as_its_row_says() {
    for style in &STYLES {
        for (script, human) in [(&WALK_TAKES[1], 0.5..1.7), (&RUN_TAKES[0], 1.2..4.0)] {
            let take = performed(script, style);
            let path: f32 = take.motion.poses.windows(2).map(|w| (w[1].root - w[0].root).with_y(0.0).length()).sum();
            let speed = path * RATE_HZ / (take.motion.poses.len() - 1) as f32;
            let row = script.action.style(style);
            let said = row.step_length * row.cadence / 60.0;
            assert!(human.contains(&speed), "{}: {speed} m/s", style.name);
            assert!((speed / said - 1.0).abs() < 0.1, "{}: {speed} m/s, said {said}", style.name);
        }
    }
}

#[test]
fn runners_fly_and_walkers_do_not() {
    for (style, script, take) in takes() {
        let flying = mean(take.planted.iter().map(|p| f32::from(u8::from(!p[0] && !p[1]))));
        match script.action {
            Action::Walk => assert_eq!(flying, 0.0, "{} {}", style.name, script.name),
            Action::Run => assert!(flying > 0.1, "{} {}: {flying}", style.name, script.name),
        }
    }
}

#[test]
fn knees_bend_forward_and_arms_swing_against_the_legs() {
    for (style, script, take) in takes() {
        let mut opposition = 0.0;
        for pose in &take.motion.poses {
            for knee in [Role::LeftLowerLeg, Role::RightLowerLeg] {
                let flexion = exp_map::log(pose.rotations[knee.index()]);
                assert!(flexion.x > 0.03 && flexion.x < 2.2, "{} {}: {flexion}", style.name, script.name);
                assert!(flexion.y.abs() + flexion.z.abs() < 1e-2, "a knee is a hinge: {flexion}");
            }
            let world = world_from_local(&take.motion.proportions, pose);
            let position = |r: Role| world.positions[r.index()];
            let ahead = (position(Role::LeftUpperLeg) - position(Role::RightUpperLeg)).cross(Vec3::Y).normalize();
            let hands = (position(Role::LeftHand) - position(Role::RightHand)).dot(ahead);
            let feet = (position(Role::LeftFoot) - position(Role::RightFoot)).dot(ahead);
            opposition += hands * feet;
        }
        assert!(opposition < 0.0, "{} {}", style.name, script.name);
    }
}

#[test]
fn straight_walking_is_symmetric_up_to_irregularity() {
    let passages = &[Passage { strides: 12, speed: 1.0, turn_degrees: 0.0 }];
    let script = Script { name: "straight", action: Action::Walk, passages, seed: 3 };
    for style in &STYLES {
        let take = performed(&script, style);
        for role in Role::ALL {
            let size = |r: Role| mean(take.motion.poses.iter().map(|p| p.rotations[r.index()].angle()));
            let (here, there) = (size(role), size(role.mirrored()));
            assert!((here - there).abs() < 3.0_f32.to_radians(), "{} {role:?}: {here} {there}", style.name);
        }
    }
}

#[test]
fn every_pair_of_styles_differs_clearly() {
    // Mean distance of the joints at equal phases without hips and heading: the visible difference of poses.
    let script = &WALK_TAKES[0];
    let clouds: Vec<(Vec<f32>, Vec<[Vec3; JOINTS]>)> = STYLES
        .iter()
        .map(|s| {
            let take = performed(script, s);
            let cloud =
                worlds(&take.motion).iter().map(|w| w.positions.map(|p| p - w.positions[0].with_y(0.0))).collect();
            (take.phase, cloud)
        })
        .collect();
    for i in 0..STYLES.len() {
        for j in 0..i {
            let ((phases, a), (others, b)) = (&clouds[i], &clouds[j]);
            let distance = mean(phases.iter().zip(a).map(|(phase, a)| {
                let k = others.partition_point(|p| p < phase).min(others.len() - 1);
                mean(a.iter().zip(&b[k]).map(|(p, q)| (*p - *q).length()))
            }));
            assert!(distance > 0.04, "{} and {}: {distance} m", STYLES[i].name, STYLES[j].name);
        }
    }
}

#[test]
fn styles_show_what_their_sources_describe() {
    let script = &WALK_TAKES[0];
    let measure = |name: &str| {
        let take = performed(script, style(name));
        let worlds = worlds(&take.motion);
        let height = |r: Role| mean(worlds.iter().map(|w| w.positions[r.index()].y));
        let travelled = take.motion.poses.last().unwrap().root.z;
        let strides = take.phase.last().unwrap();
        let pelvis = |w: &WorldPose| w.rotations[Role::Hips.index()];
        let obliquity = worlds.iter().map(|w| (pelvis(w) * Vec3::X).y.abs()).fold(0.0, f32::max);
        let gaze = mean(worlds.iter().map(|w| (w.rotations[Role::Head.index()] * Vec3::Z).y));
        (height(Role::Neck), travelled / strides / 2.0, obliquity, gaze)
    };
    let (neutral, proud, old) = (measure("neutral"), measure("proud"), measure("old"));
    let (depressed, sexy) = (measure("depressed"), measure("sexy"));
    assert!(proud.0 > old.0 + 0.08 && neutral.0 > old.0 + 0.08, "chest height {} {} {}", proud.0, neutral.0, old.0);
    assert!(proud.1 > neutral.1 && neutral.1 > old.1 + 0.15, "step {} {} {}", proud.1, neutral.1, old.1);
    assert!(sexy.2 > 1.5 * neutral.2, "obliquity {} {}", sexy.2, neutral.2);
    assert!(proud.3 > 0.1 && depressed.3 < -0.5, "gaze {} {}", proud.3, depressed.3);
}

#[test]
fn planned_contacts_are_found_by_the_labeller() {
    for (style, script, take) in takes() {
        let found = contact::label(&take.motion);
        let pairs = found.iter().zip(&take.planted).flat_map(|(f, p)| f.iter().zip(p));
        let agreement = mean(pairs.map(|(f, p)| f32::from(u8::from(f == p))));
        assert!(agreement > 0.9, "{} {}: {agreement}", style.name, script.name);
    }
}

#[test]
fn inputs_can_be_repeated() {
    for input in input_clips() {
        let poses = &input.motion.poses;
        let (first, last) = (&poses[0], &poses[poses.len() - 1]);
        assert!(poses.len() as f32 > 10.0 * RATE_HZ, "{}", input.name);
        for role in Role::ALL.into_iter().skip(1) {
            let gap = last.rotations[role.index()].inv_mul(first.rotations[role.index()]).angle();
            assert!(gap < 0.2, "{} {role:?}: {gap}", input.name);
        }
    }
}

#[test]
fn an_input_changes_its_gait_and_comes_back() {
    let inputs = input_clips();
    let input = inputs.iter().find(|input| input.name.contains("run and walk")).unwrap();
    let poses = &input.motion.poses;
    let speed_at = |share: f32| {
        let i = (share * (poses.len() - 61) as f32) as usize;
        (poses[i + 60].root - poses[i].root).with_y(0.0).length()
    };
    let [begins, between, ends] = [0.0, 0.5, 1.0].map(speed_at);
    assert!(between > 1.5 * begins.max(ends), "{begins}, {between} and {ends} m/s");
    let skate = strut_core::metrics::foot_skate(&input.motion, &contact::label(&input.motion));
    assert!(skate < 0.05, "{skate} m/s");
}

#[test]
fn an_input_walks_in_a_circle() {
    let inputs = input_clips();
    let input = inputs.iter().find(|input| input.name.contains("circle")).unwrap();
    let poses = &input.motion.poses;
    let ahead: f32 = poses.windows(2).map(|w| (w[1].root - w[0].root).with_y(0.0).length()).sum();
    let farthest = poses.iter().map(|p| (p.root - poses[0].root).with_y(0.0).length()).fold(0.0, f32::max);
    assert!(ahead > 2.0 * farthest, "{ahead} m of way, {farthest} m away at most");
}

#[test]
fn joint_angles_of_neutral_walking_lie_within_the_normative_bands() {
    let passages = &[Passage { strides: 12, speed: 1.0, turn_degrees: 0.0 }];
    let take = performed(&Script { name: "straight", action: Action::Walk, passages, seed: 4 }, &STYLES[0]);
    let cycles = cycles_between(&take.motion, &measure::strikes(&take.phase));
    for (angle, band) in WALKING_BANDS.iter().enumerate() {
        let curve = measure::mean_and_sd(&cycles, angle);
        let share = measure::share_within(band, &curve);
        assert!(share >= 0.9, "{}: {share}", band.name);
    }
}

#[test]
fn a_transition_begins_as_one_gait_and_ends_as_the_other() {
    for (style, transition, take) in transitions() {
        let speed = |frames: &[Pose]| {
            let way: f32 = frames.windows(2).map(|w| (w[1].root - w[0].root).with_y(0.0).length()).sum();
            way * RATE_HZ / (frames.len() - 1) as f32
        };
        let poses = &take.motion.poses;
        let (begins, ends) = (speed(&poses[..12]), speed(&poses[poses.len() - 12..]));
        let runs_at_last = transition.to == Action::Run;
        assert_eq!(ends > 1.25 * begins, runs_at_last, "{}: {begins} m/s, then {ends} m/s", style.name);
        assert_eq!(begins > 1.25 * ends, !runs_at_last, "{}: {begins} m/s, then {ends} m/s", style.name);
    }
}
