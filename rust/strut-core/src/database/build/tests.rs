use super::*;
use crate::humanoid::{Pose, Proportions, Role};
use crate::math::Quat;
use crate::math::float_funcs::sin;
use crate::parallel::Sequential;

fn clip(action: &str, style: &str, take: u32, motion: HumanoidMotion) -> SourceClip {
    SourceClip {
        name: format!("{action}_{style}_{take}"),
        action: action.into(),
        style: style.into(),
        take,
        motion,
        source: "test".into(),
        licence: String::new(),
        script: None,
    }
}

/// The left arm rises and falls once a second of script time, performed at `pace` script seconds a second.
fn waving(style: &str, pace: f32, secs: f32) -> SourceClip {
    let frames = (secs / pace * 30.0) as usize + 1;
    let time: Vec<f32> = (0..frames).map(|f| f as f32 / 30.0 * pace).collect();
    let poses = time
        .iter()
        .map(|t| {
            let mut pose = Pose::default();
            let angle = 0.8 * sin(t * std::f32::consts::TAU);
            pose.rotations[Role::LeftUpperArm.index()] = Quat::from_rotation_z(angle);
            pose
        })
        .collect();
    let motion = HumanoidMotion { proportions: Proportions::default(), rate_hz: 30.0, poses };
    SourceClip { script: Some(Script { id: 1, time }), ..clip("wave", style, 1, motion) }
}

fn quiet(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

#[test]
fn known_correspondence_gives_counterparts_at_equal_script_time() {
    let clips = [waving("slow", 0.5, 2.0), waving("neutral", 1.0, 2.0)];
    let (db, report) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    assert_eq!(db.styles, ["neutral", "slow"]);
    assert_eq!((db.neutral, db.clips[0].frames, db.clips[1].frames), (0, 121, 241));
    assert_eq!(report.actions[0].method, registration::Method::Scripts);
    for row in 2..119 {
        let there = db.counterparts(row, 1).next().unwrap();
        assert!((there - (121.0 + 2.0 * row as f32)).abs() < 1e-2, "row {row}: {there}");
        assert!((db.time_step[row] * 60.0 - 1.0).abs() < 1e-3);
        assert!((db.time_step[there as usize] * 60.0 - 2.0).abs() < 1e-2);
    }
}

#[test]
fn unusable_clips_are_refused_with_a_reason_and_the_rest_is_built() {
    let mut broken = waving("broken", 1.0, 2.0);
    broken.motion.poses[7].root.x = f32::NAN;
    let mut other_bones = waving("tall", 1.0, 2.0);
    other_bones.motion.proportions.offsets[1].y += 0.1;
    let mut backwards = waving("backwards", 1.0, 2.0);
    if let Some(script) = &mut backwards.script {
        script.time[5] = script.time[4];
    }
    let clips = [waving("neutral", 1.0, 2.0), broken, other_bones, backwards, waving("short", 1.0, 0.05)];
    let (db, report) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    assert_eq!(db.styles, ["neutral"]);
    let refused: Vec<_> = report.refused().map(|c| (c.style.as_str(), c.refused.clone().unwrap())).collect();
    assert_eq!(
        refused,
        [
            ("backwards", Refusal::Script(5)),
            ("broken", Refusal::NotFinite(7)),
            ("short", Refusal::TooShort(3)),
            ("tall", Refusal::Proportions),
        ]
    );
}

#[test]
fn errors_say_what_was_expected() {
    let options = BuildOptions { neutral: Some("calm".into()), ..BuildOptions::default() };
    let error = build(&[waving("neutral", 1.0, 2.0)], &options, &Sequential, &mut quiet).unwrap_err();
    assert_eq!(error.to_string(), "no usable clip has the neutral style 'calm'; the styles are neutral");
    assert_eq!(build(&[], &options, &Sequential, &mut quiet).unwrap_err(), BuildError::NoClips);
    let cancelled =
        build(&[waving("a", 1.0, 2.0)], &BuildOptions::default(), &Sequential, &mut |_| ControlFlow::Break(()));
    assert_eq!(cancelled.unwrap_err(), BuildError::Cancelled);
}
