//! Feet and joints of styled clips on real motion capture, if it is present (`STRUT_MOCAP`): a sample of all pairs of
//! clip and style, or all with `STRUT_ALL_CLIPS=1`. The clips are processed as in `strut stylize`, except for the text
//! of the file.

use crate::common::{all_clips, mocap, read_bvh, strut_ok};
use rayon::prelude::*;
use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use strut_core::humanoid::{HumanoidMotion, JOINTS, Role};
use strut_core::kinematics::world_from_local;
use strut_core::math::Quat;
use strut_core::retarget::{Binding, to_humanoid};
use strut_core::transfer::{Model, NoClock, Options, Stylizer, beyond_anatomy, ground_clearance, stylize_clip};
use strut_core::{contact, metrics};
use strut_formats::strutdb;

/// Returns the clips of a folder whose names contain a text, sorted.
fn clips(mocap: &Path, set: &str, containing: &str) -> Vec<PathBuf> {
    let mut clips = mocap::clips_of(mocap, set);
    clips.retain(|p| p.to_str().unwrap().contains(containing));
    clips
}

fn build(inputs: &[PathBuf], [neutral, pattern]: [&str; 2]) -> Arc<Model> {
    let folder = tempfile::tempdir().unwrap();
    let mut args = vec!["build-db", "-o", "db", "--neutral", neutral, "--pattern", pattern];
    args.extend(inputs.iter().map(|p| p.to_str().unwrap()));
    strut_ok(folder.path(), &args);
    Arc::new(Model::new(strutdb::read(&fs::read(folder.path().join("db")).unwrap()).unwrap().database))
}

const BANDAI_NAMCO: [&str; 2] = ["normal", "{set}_{action}_{style}_{take}.bvh"];
const XIA: [&str; 2] = ["neutral", "{style}_{action}_{take}.bvh"];

/// A clip before and after styling, each on its own body.
struct Styled {
    name: String,
    input: HumanoidMotion,
    output: HumanoidMotion,
    /// Detected contacts of the input's left and right foot, by frame at the database's rate.
    contact: Vec<[bool; 2]>,
}

/// Styles each clip in the styles that `wanted` returns for its index, and passes each pair to `check`.
fn for_each_styled(
    model: &Arc<Model>,
    clips: &[PathBuf],
    wanted: impl Fn(usize) -> Vec<String> + Sync,
    check: impl Fn(&Styled) + Sync,
) {
    let pairs: Vec<(usize, String)> =
        (0..clips.len()).flat_map(|i| wanted(i).into_iter().map(move |s| (i, s))).collect();
    pairs.par_iter().for_each(|(i, style)| check(&styled(model, &clips[*i], style)));
}

fn styled(model: &Arc<Model>, clip: &Path, style: &str) -> Styled {
    let db = model.catalogue();
    let motion = read_bvh(clip).to_motion().unwrap();
    let binding = Binding::detect(&motion).unwrap();
    let mut stylizer = Stylizer::new(Arc::clone(model), Options::DEFAULT).unwrap();
    let weights: Vec<f32> = db.styles.iter().map(|s| f32::from(u8::from(s == style))).collect();
    stylizer.set_styles(&weights).unwrap();
    let input = to_humanoid(&motion, &binding, &db.proportions).resampled(db.rate_hz).unwrap();
    let styled = stylize_clip(&stylizer, &input.poses, &mut NoClock, |_, _| ControlFlow::Continue(())).unwrap();
    let output = styled.on_skeleton(db.rate_hz, &motion, &binding);
    let on_own_body = |motion: &_| to_humanoid(motion, &binding, &binding.proportions);
    Styled {
        name: format!("{} → {style}", clip.file_stem().unwrap().to_str().unwrap()),
        input: on_own_body(&motion),
        // With the floor of the input: that of the output would be estimated again.
        output: on_own_body(&output),
        contact: styled.frames.iter().map(|f| f.contact.map(|c| c > 0.5)).collect(),
    }
}

/// Returns one of `styles` for each index, in turn, or all of them if all are requested.
fn in_turn(styles: &[String]) -> impl Fn(usize) -> Vec<String> + Sync {
    move |i| if all_clips() { styles.to_vec() } else { vec![styles[i % styles.len()].clone()] }
}

/// Foot skate with the rule of `docs/methods/mar.md` §3, applied to the motion itself.
fn skate_cm_s(motion: &HumanoidMotion) -> f32 {
    100.0 * metrics::foot_skate(motion, &contact::label(motion))
}

/// Returns the height of the lowest point of any sole, cm.
fn lowest_sole_cm(motion: &HumanoidMotion) -> f32 {
    100.0 * motion.poses.iter().map(|p| ground_clearance(&motion.proportions, p)).fold(f32::INFINITY, f32::min)
}

/// Returns the greatest acceleration of any joint at 60 Hz, m/s².
fn peak_acceleration(motion: &HumanoidMotion) -> f32 {
    let poses = motion.resampled(60.0).unwrap().poses;
    let at: Vec<_> = poses.iter().map(|p| world_from_local(&motion.proportions, p).positions).collect();
    let peak =
        |w: &[metrics::Points]| (0..JOINTS).map(|j| (w[2][j] - 2.0 * w[1][j] + w[0][j]).length()).fold(0.0, f32::max);
    at.windows(3).map(peak).fold(0.0, f32::max) * 3600.0
}

#[test]
fn no_style_skates_more_than_its_input_or_sinks() {
    let Some(mocap) = mocap::folder() else { return };
    let mut inputs = clips(&mocap, "cmu", "");
    inputs.extend(clips(&mocap, "xia", "").into_iter().step_by(if all_clips() { 1 } else { 3 }));
    for (set, naming) in [("bandai-namco-2", BANDAI_NAMCO), ("xia", XIA)] {
        let model = build(&clips(&mocap, set, ""), naming);
        for_each_styled(&model, &inputs, in_turn(&model.catalogue().styles), |s| {
            let (before, after) = (skate_cm_s(&s.input), skate_cm_s(&s.output));
            let lowest = lowest_sole_cm(&s.output);
            let peaks = [&s.input, &s.output].map(peak_acceleration);
            println!(
                "{set}: {:<40} skate {before:5.2} → {after:5.2} cm/s, sole {lowest:5.2} cm, peak {:4.0} → {:4.0} m/s²",
                s.name, peaks[0], peaks[1]
            );
            assert!(after <= before, "{set}: {}: {after} cm/s, input {before}", s.name);
            assert!(lowest >= -1.0, "{set}: {}: {lowest} cm", s.name);
        });
    }
}

#[test]
fn contacts_of_unseen_takes_are_recognised_and_their_feet_held() {
    let Some(mocap) = mocap::folder() else { return };
    let (held_out, known): (Vec<PathBuf>, Vec<PathBuf>) =
        clips(&mocap, "bandai-namco-2", "").into_iter().partition(|p| p.to_str().unwrap().ends_with("_001.bvh"));
    let model = build(&known, BANDAI_NAMCO);
    let db = model.catalogue();
    let is = |p: &&PathBuf, what: &str| p.to_str().unwrap().contains(what);

    let walks: Vec<PathBuf> = held_out.iter().filter(|p| is(p, "_walk_")).cloned().collect();
    let (alike, all) = (AtomicUsize::new(0), AtomicUsize::new(0));
    for_each_styled(&model, &walks, in_turn(&db.styles), |s| {
        let labels = contact::label(&s.input.resampled(db.rate_hz).unwrap());
        let feet = s.contact.iter().flatten().zip(labels.iter().flatten());
        let (frames, own) = (feet.clone().count(), feet.filter(|(seen, label)| seen == label).count());
        println!("{}: contacts agree in {:.2} %", s.name, 100.0 * own as f32 / frames as f32);
        alike.fetch_add(own, Relaxed);
        all.fetch_add(frames, Relaxed);
    });
    let agreement = alike.into_inner() as f32 / all.into_inner() as f32;
    println!("contacts of held-out walks agree in {:.2} %", 100.0 * agreement);
    assert!(agreement >= 0.99, "{agreement}");

    let normal: Vec<PathBuf> = held_out.iter().filter(|p| is(p, "_normal_") && !is(p, "wave")).cloned().collect();
    assert_eq!(normal.len(), 4, "walk, run and two turns");
    let others: Vec<String> = db.styles.iter().filter(|s| *s != "normal").cloned().collect();
    let two = |i: usize| if all_clips() { others.clone() } else { others[i % 3 * 2..][..2].to_vec() };
    for_each_styled(&model, &normal, two, |s| {
        let skate = skate_cm_s(&s.output);
        println!("{}: skate {:.2} → {skate:.2} cm/s", s.name, skate_cm_s(&s.input));
        assert!(skate <= 1.4, "{}: {skate} cm/s", s.name);
    });
}

/// Returns for each joint how far a motion exceeds the anatomical limits, radians.
fn beyond(rotations: impl Iterator<Item = [Quat; JOINTS]>) -> [f32; JOINTS] {
    let mut most = [0.0_f32; JOINTS];
    for rotations in rotations {
        for role in Role::ALL {
            most[role.index()] = most[role.index()].max(beyond_anatomy(role, rotations[role.index()]));
        }
    }
    most
}

#[test]
fn one_take_a_class_is_enough_to_stay_within_limits() {
    let Some(mocap) = mocap::folder() else { return };
    let sets = ["cmu", "xia", "bandai-namco-1"];
    let inputs: Vec<PathBuf> = sets.iter().flat_map(|set| clips(&mocap, set, "")).collect();
    let inputs: Vec<PathBuf> = inputs.into_iter().step_by(if all_clips() { 1 } else { 13 }).collect();
    for (set, naming) in [("xia", XIA), ("bandai-namco-1", BANDAI_NAMCO)] {
        let model = build(&clips(&mocap, set, ""), naming);
        let db = model.catalogue();
        let known = beyond((0..db.frames()).map(|row| {
            let row = db.rows().get(row);
            Role::ALL.map(|role| db.chart.rotation(role, &row))
        }));
        for_each_styled(&model, &inputs, in_turn(&db.styles), |s| {
            let (before, after) =
                (beyond(s.input.poses.iter().map(|p| p.rotations)), beyond(s.output.poses.iter().map(|p| p.rotations)));
            for role in Role::ALL {
                let allowed = before[role.index()].max(known[role.index()]);
                // Legs bend slightly more where feet are held.
                let excess = after[role.index()] - allowed;
                assert!(excess < 0.1, "{set}: {}: {} is {excess} rad beyond its limits", s.name, role.name());
            }
            let (hips, legs) = (Role::Hips.index(), s.output.proportions.leg_length());
            for pose in &s.output.poses {
                assert!(pose.rotations.iter().all(|q| q.is_finite()), "{set}: {}: a turn is no number", s.name);
                let height = world_from_local(&s.output.proportions, pose).positions[hips].y;
                assert!((0.0..3.0 * legs).contains(&height), "{set}: {}: hips at {height} m", s.name);
            }
        });
    }
}
