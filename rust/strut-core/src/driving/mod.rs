//! Driving: neutral motion that follows the user's steering, by motion matching over the neutral clips of a database.
//! Its frames are the stylizer's input.
//!
//! [`DrivingClips`] are the clips in the frame of their root. A [`Driver`] searches their rows exactly for the one that
//! continues the motion at the least cost, and plays them.

mod clips;
mod control;
mod driver;
mod features;
mod inertia;
mod matching;
mod moves;
mod path;
mod query;
mod smoothing;

pub use clips::{ClipKind, DrivingClip, DrivingClips, DrivingError, NeutralClip, RootMotion};
pub use control::Control;
pub use driver::{DrivenFrame, Driver};
pub use features::Trajectory;
pub(crate) use inertia::{Inertia, Moving};
pub use moves::Move;
pub use path::Path;

#[cfg(test)]
mod tests {
    use super::{Control, Driver, DrivingClips, NeutralClip};
    use crate::humanoid::{Pose, Proportions, Role};
    use crate::math::exp_map::log;
    use crate::math::{Quat, Vec2, Vec3};
    use crate::pose_vector::Placement;
    use std::sync::Arc;

    /// A body that glides round a circle at 60 Hz, from the origin towards +Z: `speed` m/s, `turn_rate` rad/s.
    pub(super) fn circle(frames: usize, speed: f32, turn_rate: f32) -> NeutralClip {
        let mut at = Proportions::default().offsets[0];
        let mut heading = 0.0_f32;
        let mut poses = Vec::new();
        for _ in 0..frames {
            let mut pose = Pose { root: at, ..Pose::default() };
            pose.rotations[0] = Quat::from_rotation_y(heading);
            poses.push(pose);
            heading += turn_rate / 120.0;
            at += Quat::from_rotation_y(heading) * Vec3::Z * (speed / 60.0);
            heading += turn_rate / 120.0;
        }
        let contacts = (0..frames).map(|frame| [frame % 60 < 35, frame % 60 > 25]).collect();
        NeutralClip { name: "circle".into(), action: "walk".into(), poses, contacts }
    }

    /// A driver over straight and curved paths, slow and fast, and with the given clips of moves.
    fn driver_with(moves: &[NeutralClip]) -> Driver {
        let paths = [
            (1.2, 0.0),
            (1.2, 0.3),
            (1.1, 0.7),
            (0.8, 0.0),
            (0.8, 1.0),
            (1.7, 0.0),
            (2.1, 0.0),
            (2.6, 0.0),
            (2.5, 0.5),
        ];
        let circles = paths.iter().map(|&(speed, turn)| circle(400, speed, turn));
        let clips: Vec<NeutralClip> = circles.chain(moves.iter().cloned()).collect();
        Driver::new(Arc::new(DrivingClips::new(Proportions::default(), 60.0, &clips, &[], &[]).unwrap()))
    }

    fn driver() -> Driver {
        driver_with(&[])
    }

    /// Places of the root during a drive.
    fn driven(driver: &mut Driver, frames: usize, control: &Control) -> Vec<Vec2> {
        let place = |frame: &Placement| Vec2::new(frame.x, frame.z);
        (0..frames).map(|_| place(&driver.next(control, None).root)).collect()
    }

    #[test]
    fn a_drawn_circle_is_followed_in_either_direction() {
        for side in [1.0, -1.0] {
            let mut driver = driver();
            let circle: Vec<Vec2> =
                (0..500).map(|i| (Vec2::X - Vec2::from_angle(i as f32 * 0.02)) * 2.0 * Vec2::new(side, -1.0)).collect();
            driver.set_path(&circle);
            let places = driven(&mut driver, 600, &Control { gait: 1.0, ..Control::default() });
            let off: Vec<f32> =
                places[120..].iter().map(|p| (p.distance(Vec2::X * (2.0 * side)) - 2.0).abs()).collect();
            let mean = off.iter().sum::<f32>() / off.len() as f32;
            assert!(mean < 0.05, "{mean} m off");
        }
    }

    #[test]
    fn a_stick_turns_the_character_and_a_gait_makes_it_run() {
        let mut driver = driver();
        let east = Control { wish: Vec2::X, gait: 1.0, ..Control::default() };
        driven(&mut driver, 120, &east);
        let walked = driven(&mut driver, 120, &east);
        let way = walked[119] - walked[0];
        assert!(way.normalize().x > 0.95 && (way.length() / 119.0 * 60.0 - driver.speeds()[0]).abs() < 0.2, "{way}");
        driven(&mut driver, 120, &Control { gait: 2.0, ..east });
        let run = driven(&mut driver, 60, &Control { gait: 2.0, ..east });
        let ran = (run[59] - run[0]).length() / 59.0 * 60.0;
        assert!(ran > driver.speeds()[0] + 0.4, "{ran} m/s");
    }

    /// A driver whose only clip goes straight on at a constant speed.
    fn straight(speed: f32) -> Driver {
        let clips = [circle(600, speed, 0.0)];
        Driver::new(Arc::new(DrivingClips::new(Proportions::default(), 60.0, &clips, &[], &[]).unwrap()))
    }

    #[test]
    fn a_clip_that_goes_straight_on_is_steered_round_a_curve_and_stays_on_it() {
        let mut driver = straight(1.2);
        let curve: Vec<Vec2> = (0..400).map(|i| (Vec2::X - Vec2::from_angle(i as f32 * -0.015)) * 3.0).collect();
        driver.set_path(&curve);
        let places = driven(&mut driver, 840, &Control { gait: 1.0, ..Control::default() });
        let off = places[600..].iter().map(|p| p.distance(Vec2::X * 3.0) - 3.0).sum::<f32>() / 240.0;
        assert!(off.abs() < 0.02, "{off} m to one side");
    }

    #[test]
    fn a_clip_is_paced_to_the_speed_asked_by_a_tenth_at_most() {
        for (asked, goes) in [(1.0, 1.0), (0.95, 0.95), (0.5, 0.9)] {
            let mut driver = straight(1.2);
            let places = driven(&mut driver, 300, &Control { wish: Vec2::Y, gait: asked, ..Control::default() });
            let speed = places[299].distance(places[180]) / 119.0 * 60.0;
            assert!((speed - 1.2 * goes).abs() < 0.01, "{asked}: {speed} m/s");
        }
    }

    #[test]
    fn a_frame_says_where_its_clip_would_go() {
        let mut driver = straight(1.2);
        let frame = driver.next(&Control::default(), None);
        let Placement { x, z, .. } = frame.root;
        for (i, (place, heading)) in frame.ahead.into_iter().enumerate() {
            let to = Vec2::new(x, z + 1.2 * (i + 1) as f32 / 3.0);
            assert!(place.distance(to) < 0.02 && heading.abs() < 0.01, "{place} {to} {heading}");
        }
    }

    #[test]
    fn what_is_not_a_number_counts_as_the_last_good_control() {
        let (mut one, mut other) = (driver(), driver());
        let good = Control { wish: Vec2::new(0.6, 0.8), gait: 1.0, ..Control::default() };
        let bad = Control { wish: Vec2::new(f32::NAN, 0.0), ..good };
        one.next(&good, None);
        other.next(&good, None);
        let nowhere = Some(Vec3::splat(f32::NAN));
        for _ in 0..200 {
            assert_eq!(one.next(&good, None), other.next(&bad, nowhere));
        }
    }

    /// In each clip an arm turns at a different rate; after a transition the arm first keeps its previous rate.
    #[test]
    fn a_transition_changes_no_turn_rate() {
        let arm = Role::LeftUpperArm.index();
        let clips = [(1.2, 1.0), (0.8, -2.0), (2.5, 3.0)].map(|(speed, rate): (f32, f32)| {
            let mut clip = circle(400, speed, 0.0);
            for (frame, pose) in clip.poses.iter_mut().enumerate() {
                pose.rotations[arm] = Quat::from_rotation_x(rate * frame as f32 / 60.0);
            }
            clip
        });
        let clips = DrivingClips::new(Proportions::default(), 60.0, &clips, &[], &[]).unwrap();
        let mut driver = Driver::new(Arc::new(clips));
        let mut shown = Vec::<Pose>::new();
        let mut transitions = 0;
        for frame in 0..900 {
            let control = Control { wish: Vec2::Y, gait: [1.0, 0.6, 2.0][frame / 90 % 3], ..Control::default() };
            let next = driver.next(&control, None);
            shown.push(next.pose);
            if let ([.., a, b, c], true) = (shown.as_slice(), next.switched) {
                let turned = |from: &Pose, to: &Pose| log(to.rotations[arm] * from.rotations[arm].inverse()) * 60.0;
                let change = turned(b, c) - turned(a, b);
                // The arm still slows down after an earlier transition.
                assert!(change.length() < 0.5, "frame {frame}: {change:?} rad/s");
                transitions += 1;
            }
        }
        assert!(transitions > 5, "{transitions} transitions");
    }

    /// A jump on the spot: one second of rest, a crouch, half a second of flight 0.3 m up, one second of rest.
    fn jump() -> NeutralClip {
        let stand = Proportions::default().offsets[0].y;
        let height = |frame: usize| match frame {
            60..90 => -0.1 * ((frame - 60) as f32 / 30.0),
            90..120 => {
                let t = (frame - 90) as f32 / 15.0 - 1.0;
                0.3 * (1.0 - t * t)
            }
            120..150 => -0.1 * ((150 - frame) as f32 / 30.0),
            _ => 0.0,
        };
        let poses = (0..210).map(|frame| Pose { root: Vec3::Y * (stand + height(frame)), ..Pose::default() }).collect();
        let contacts = (0..210).map(|frame| [!(90..120).contains(&frame); 2]).collect();
        NeutralClip { name: "jump".into(), action: "jump".into(), poses, contacts }
    }

    #[test]
    fn a_jump_from_a_run_takes_off_at_speed_and_runs_on() {
        let mut driver = driver_with(&[jump()]);
        let run = Control { wish: Vec2::Y, gait: 2.0, ..Control::default() };
        driven(&mut driver, 180, &run);
        let stand = Proportions::default().offsets[0].y;
        let (mut highest, mut jumped) = (0.0_f32, 0);
        for frame in 0..150 {
            let action = (frame < 10).then_some(super::Move::Jump);
            let shown = driver.next(&Control { action, ..run }, None);
            assert!(shown.speed > 1.9, "frame {frame}: {} m/s", shown.speed);
            assert!(shown.action.is_none() || frame <= 31 + 33, "the jump ends with its landing: frame {frame}");
            highest = highest.max(shown.pose.root.y - stand);
            jumped += usize::from(shown.action == Some(super::Move::Jump));
        }
        assert!((28..=33).contains(&jumped), "{jumped} frames of flight");
        assert!(highest > 0.2, "{highest} m");
    }

    #[test]
    fn a_jump_from_a_walk_begins_at_rest() {
        let mut driver = driver_with(&[jump()]);
        let walk = Control { wish: Vec2::Y, gait: 1.0, ..Control::default() };
        driven(&mut driver, 180, &walk);
        let jump = Control { action: Some(super::Move::Jump), ..walk };
        let shown: Vec<_> = (0..300).map(|_| driver.next(&jump, None).clone()).collect();
        let highest = shown.iter().max_by(|a, b| a.pose.root.y.total_cmp(&b.pose.root.y)).unwrap();
        assert!(highest.action == Some(super::Move::Jump) && highest.speed < 0.2, "{} m/s", highest.speed);
    }

    #[test]
    fn frames_follow_each_other_without_a_leap() {
        let mut driver = driver();
        let mut last = None;
        for frame in 0..900 {
            let wish = Vec2::from_angle(frame as f32 * 0.011);
            let pose =
                driver.next(&Control { wish, gait: 1.0 + (frame / 300) as f32 * 0.5, ..Control::default() }, None).pose;
            if let Some(before) = last.replace(pose.root) {
                assert!(pose.root.distance(before) < 3.5 / 60.0, "{frame}: {before} {}", pose.root);
            }
        }
    }
}
