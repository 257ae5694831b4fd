//! Data for benchmarks: a database of any size, and motion that is not in it.
//!
//! Six gaits in eight styles, 48 classes. A take is performed in every style with irregularities and individual habits
//! (tempo, step, posture, arms, each within about a tenth of the style's), so that windows are as similar to each other
//! as in recordings and none is a copy. Deterministic: the same number of frames gives the same bits on every platform.

use crate::action::Action;
use crate::database::RATE_HZ;
use crate::noise::{split_mix, within_one};
use crate::perform::{Performance, perform};
use crate::script::{Script, passage};
use crate::style::Style;
use crate::styles::STYLES;
use strut_core::database::{Class, Clip, Database, DatabaseError, DatabaseParts};
use strut_core::humanoid::{HumanoidMotion, Proportions};
use strut_core::kinematics::world_from_local;
use strut_core::pose_vector::{HeadingFilter, Placement, PoseChart, PoseRow, VELOCITY_X, point_cloud};

/// Number of frames of the database for which the paper's Table 2 was measured.
pub const PAPER_FRAMES: usize = 79_829;
/// Minimum number of frames of a database: enough for K neighbours in every class.
pub const LEAST_FRAMES: usize = 4_800;

/// Motion that is not in the database.
#[derive(Clone, Debug, PartialEq)]
pub struct Query {
    /// Index of its action in the database.
    pub action: u16,
    /// Index of its style in the database.
    pub style: u16,
    /// Motion on the database's proportions and at its rate.
    pub motion: HumanoidMotion,
}

/// The six actions, sorted by name as in every database.
const ACTIONS: [Script; 6] = [
    script("jog", Action::Run, &[passage(4, 0.8, 0.0), passage(4, 0.7, 0.0), passage(4, 0.75, 0.0)]),
    script("run", Action::Run, &[passage(5, 1.0, 0.0), passage(4, 1.15, 0.0), passage(4, 1.05, 0.0)]),
    script("run turning", Action::Run, &[passage(4, 0.95, 80.0), passage(2, 0.9, 0.0), passage(4, 0.95, -80.0)]),
    script("stroll", Action::Walk, &[passage(4, 0.65, 0.0), passage(3, 0.75, 20.0), passage(4, 0.6, -20.0)]),
    script("walk", Action::Walk, &[passage(4, 1.0, 0.0), passage(4, 1.25, 0.0), passage(4, 0.9, 0.0)]),
    script("walk turning", Action::Walk, &[passage(3, 0.9, 90.0), passage(2, 1.0, 0.0), passage(4, 1.0, -150.0)]),
];

const fn script(name: &'static str, action: Action, passages: &'static [crate::Passage]) -> Script {
    Script { name, action, passages, seed: 0 }
}

/// Minimum number of frames to which a take may be cut, over all styles.
const LEAST_TAKE: usize = 400;
/// Takes from this number on are never part of a database.
const HELD_OUT: u64 = 1 << 32;
/// Number of motions of [`queries`].
const QUERIES: u64 = 12;
/// Stride of the poses from which the centres of the exponential maps are computed.
const CHART_STRIDE: usize = 7;

/// Builds a database of `frames` frames, at least [`LEAST_FRAMES`], in 48 classes with one counterpart per style.
///
/// # Errors
/// Never: the motions are valid.
pub fn database(frames: usize) -> Result<Database, DatabaseError> {
    let frames = frames.max(LEAST_FRAMES);
    let mut parts = DatabaseParts {
        rate_hz: RATE_HZ,
        proportions: Proportions::default(),
        chart: chart(),
        actions: ACTIONS.iter().map(|a| a.name.to_owned()).collect(),
        styles: STYLES.iter().map(|s| s.name.to_owned()).collect(),
        neutral: 0,
        clips: Vec::new(),
        pose: Vec::with_capacity(frames),
        point_cloud: Vec::with_capacity(frames),
        canonical_time: Vec::with_capacity(frames),
        time_step: Vec::with_capacity(frames),
        contact: Vec::with_capacity(frames),
        counterparts_per_style: 1,
        counterpart: Vec::with_capacity(frames * STYLES.len()),
    };
    for action in 0..ACTIONS.len() {
        let end = frames * (action + 1) / ACTIONS.len();
        let takes = takes(action, end - parts.pose.len());
        append(&mut parts, action, &takes);
    }
    Database::new(parts)
}

/// Motions of several classes of [`database`] that are in no database.
pub fn queries() -> Vec<Query> {
    (0..QUERIES)
        .map(|n| {
            let (action, style) = (n as usize % ACTIONS.len(), 3 * n as usize % STYLES.len());
            let motion = performance(action, HELD_OUT + n, style).motion;
            Query { action: action as u16, style: style as u16, motion }
        })
        .collect()
}

/// A recorded database without some of its clips, and these clips as queries. They are evenly distributed over the
/// clips whose class has others.
/// `None` if no class has two.
pub fn hold_out(database: &Database) -> Option<(Database, Vec<Query>)> {
    let of_company = |class: &Class| if class.clips.len() > 1 { class.clips.clone() } else { 0..0 };
    let clips: Vec<usize> = database.classes().iter().flat_map(of_company).collect();
    let mut held_out: Vec<usize> =
        (0..QUERIES as usize).filter_map(|n| clips.get(n * clips.len() / QUERIES as usize)).copied().collect();
    held_out.dedup_by_key(|clip| (database.clips[*clip].action, database.clips[*clip].style));
    if held_out.is_empty() {
        return None;
    }
    let query = |&clip: &usize| {
        let Clip { action, style, .. } = database.clips[clip];
        Query { action, style, motion: database.motion_of_clip(clip) }
    };
    Some((database.without_clips(&held_out).ok()?, held_out.iter().map(query).collect()))
}

/// Performances of one take, one per style, cut at the same phase.
type Take = Vec<Performance>;

/// Takes of an action with this number of frames in total.
fn takes(action: usize, frames: usize) -> Vec<Take> {
    let mut takes = Vec::new();
    let mut missing = frames;
    while missing > 0 {
        let number = takes.len() as u64;
        let mut take: Take = (0..STYLES.len()).map(|style| performance(action, number, style)).collect();
        let performed = take.iter().map(|p| p.phase.len()).sum();
        let kept = if missing <= performed { missing } else { (missing - LEAST_TAKE).min(performed) };
        if kept < performed {
            cut(&mut take, kept);
        }
        takes.push(take);
        missing -= kept;
    }
    takes
}

/// Keeps the first `frames` frames in order of their phase.
fn cut(take: &mut Take, frames: usize) {
    let mut phases: Vec<(f32, usize)> =
        take.iter().enumerate().flat_map(|(style, p)| p.phase.iter().map(move |&phase| (phase, style))).collect();
    phases.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    for (style, performance) in take.iter_mut().enumerate() {
        let kept = phases[..frames].iter().filter(|p| p.1 == style).count();
        performance.motion.poses.truncate(kept);
        performance.phase.truncate(kept);
        performance.planted.truncate(kept);
    }
}

/// A take of an action in a style.
fn performance(action: usize, take: u64, style: usize) -> Performance {
    let seed = split_mix(split_mix(action as u64) ^ take);
    let script = Script { seed, ..ACTIONS[action] };
    // Half of a take's individual deviations are the performer's, the same in all styles.
    let habits = Habits { performer: split_mix(seed), of_style: split_mix(seed ^ (style as u64 + 1)), field: 0 };
    perform(&script, &habits.applied_to(&STYLES[style]), &Proportions::default(), RATE_HZ)
}

/// Small deviations from a style: a sequence of numbers.
struct Habits {
    performer: u64,
    of_style: u64,
    field: u64,
}

impl Habits {
    fn next(&mut self) -> f32 {
        self.field += 1;
        let draw = |seed: u64| within_one(split_mix(seed ^ self.field << 32));
        0.5 * (draw(self.performer) + draw(self.of_style))
    }

    fn applied_to(mut self, style: &Style) -> Style {
        let mut style = *style;
        for (value, share) in [
            (&mut style.cadence, 0.08),
            (&mut style.step_length, 0.10),
            (&mut style.arm_swing, 0.25),
            (&mut style.sway, 0.3),
        ] {
            *value *= 1.0 + share * self.next();
        }
        for (degrees, most) in [
            (&mut style.crouch, 3.0),
            (&mut style.toe_out, 3.0),
            (&mut style.pelvis_tilt, 2.0),
            (&mut style.pelvis_yaw, 2.0),
            (&mut style.spine_pitch, 4.0),
            (&mut style.chest_pitch, 4.0),
            (&mut style.chest_yaw, 2.0),
            (&mut style.neck_pitch, 5.0),
            (&mut style.gaze_pitch, 6.0),
            (&mut style.shoulder_forward, 4.0),
            (&mut style.arm_forward, 6.0),
            (&mut style.arm_spread, 4.0),
            (&mut style.elbow, 8.0),
            (&mut style.elbow_swing, 3.0),
        ] {
            *degrees += most * self.next();
        }
        style
    }
}

/// Centres of the exponential maps: the neutral style's means over all actions.
fn chart() -> PoseChart {
    let motions: Vec<HumanoidMotion> = (0..ACTIONS.len()).map(|action| performance(action, 0, 0).motion).collect();
    let headings: Vec<Vec<f32>> = motions.iter().map(headings).collect();
    let poses = || motions.iter().zip(&headings).flat_map(|(m, h)| m.poses.iter().zip(h.iter().copied()));
    PoseChart::from_poses(poses().step_by(CHART_STRIDE))
}

fn headings(motion: &HumanoidMotion) -> Vec<f32> {
    let mut filter = HeadingFilter::default();
    motion
        .poses
        .iter()
        .map(|p| filter.update(&world_from_local(&motion.proportions, p), 1.0 / motion.rate_hz))
        .collect()
}

/// Adds the takes of an action, style by style.
fn append(parts: &mut DatabaseParts, action: usize, takes: &[Take]) {
    let first_clip = parts.clips.len();
    for (style, named) in STYLES.iter().enumerate() {
        for (number, take) in takes.iter().enumerate() {
            let performance = &take[style];
            parts.clips.push(Clip {
                name: format!("{}-{number}_{}", ACTIONS[action].name, named.name),
                action: action as u16,
                style: style as u16,
                take: number as u32,
                first_frame: parts.pose.len(),
                frames: performance.phase.len(),
                source: "procedural, strut-demo".into(),
                licence: env!("CARGO_PKG_LICENSE").into(),
            });
            append_frames(parts, &ACTIONS[action], performance);
        }
    }
    for style in 0..STYLES.len() {
        for (number, take) in takes.iter().enumerate() {
            let mut partners: Vec<Partner<'_>> = take
                .iter()
                .enumerate()
                .map(|(other, p)| {
                    let first_row = parts.clips[first_clip + other * takes.len() + number].first_frame;
                    Partner { phase: &p.phase, first_row, at: 0 }
                })
                .collect();
            for &phase in &take[style].phase {
                parts.counterpart.extend(partners.iter_mut().map(|p| p.row(phase)));
            }
        }
    }
}

/// A performance of the same take, read in order of the phase.
struct Partner<'a> {
    phase: &'a [f32],
    first_row: usize,
    at: usize,
}

impl Partner<'_> {
    /// Fractional row of a phase; the last row for a phase that was cut off.
    fn row(&mut self, phase: f32) -> f32 {
        while self.at + 1 < self.phase.len() && self.phase[self.at + 1] <= phase {
            self.at += 1;
        }
        let from = self.phase[self.at];
        let share = self.phase.get(self.at + 1).map_or(0.0, |to| ((phase - from) / (to - from)).clamp(0.0, 1.0));
        (self.first_row + self.at) as f32 + share
    }
}

/// Adds the rows of a clip without their counterparts.
fn append_frames(parts: &mut DatabaseParts, script: &Script, performance: &Performance) {
    let Performance { motion, phase, planted } = performance;
    let dt = 1.0 / RATE_HZ;
    let mut rows: Vec<PoseRow> = Vec::with_capacity(motion.poses.len());
    let mut previous = None;
    for (pose, heading) in motion.poses.iter().zip(headings(motion)) {
        rows.push(parts.chart.encode(pose, heading, previous, dt));
        previous = Some(Placement { x: pose.root.x, z: pose.root.z, heading });
        parts.point_cloud.push(point_cloud(&parts.proportions, pose, heading));
    }
    if let [first, second, ..] = rows.as_mut_slice() {
        // The first frame has no predecessor; zero velocity would be a false observation.
        first[VELOCITY_X..].copy_from_slice(&second[VELOCITY_X..]);
    }
    parts.pose.extend(rows);
    parts.contact.extend(planted.iter().map(|feet| feet.map(u8::from)));

    // A canonical frame is a frame of the neutral style at its preferred speed.
    let canonical_frames = RATE_HZ * 120.0 / script.action.style(&STYLES[0]).cadence;
    parts.canonical_time.extend(phase.iter().map(|p| p * canonical_frames));
    parts.time_step.extend((0..phase.len()).map(|i| {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(phase.len() - 1));
        let passed = (phase[after] - phase[before]) * canonical_frames;
        if passed > 0.0 { (after - before) as f32 * dt / passed } else { dt }
    }));
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn databases_have_the_frames_asked_for_in_48_classes() {
        for frames in [LEAST_FRAMES, 20_011] {
            let db = database(frames).unwrap();
            assert_eq!((db.frames(), db.classes().len()), (frames, 48));
            let rows = db.classes().iter().map(|c| c.rows.len());
            assert!(rows.clone().min() > Some(50) && rows.max() < Some(frames / 24), "classes are of similar size");
        }
    }

    #[test]
    fn no_frame_is_a_copy_and_none_of_the_queries_is_in_the_database() {
        let db = database(20_000).unwrap();
        let bits = |row: &PoseRow| row.map(f32::to_bits);
        let distinct: HashSet<_> = db.pose.iter().map(bits).collect();
        assert_eq!(distinct.len(), db.frames());
        for query in queries() {
            let rows = query.motion.poses.iter().zip(headings(&query.motion));
            let unseen =
                rows.filter(|(p, heading)| !distinct.contains(&bits(&db.chart.encode(p, *heading, None, 1.0))));
            assert_eq!(unseen.count(), query.motion.poses.len());
        }
    }

    #[test]
    fn what_is_held_out_of_a_database_is_not_in_what_is_left() {
        let whole = database(30_000).unwrap();
        let (rest, queries) = hold_out(&whole).unwrap();
        let frames: usize = queries.iter().map(|q| q.motion.poses.len()).sum();
        assert_eq!((rest.frames(), rest.classes().len()), (whole.frames() - frames, 48));
        assert!(queries.len() > 8);
        // A clip that moves to earlier rows because others were removed keeps its poses and counterparts.
        let last = |db: &Database| {
            let row = db.frames() - 1;
            let counterpart = db.counterparts(row, 7).next().unwrap();
            (db.pose[row].map(f32::to_bits), db.frames() as f32 - counterpart)
        };
        assert_eq!(last(&rest), last(&whole));
        // The decoded motion equals the clip.
        let motion = whole.motion_of_clip(3);
        let (rows, headings) = (whole.clips[3].rows(), headings(&motion));
        let again = whole.chart.encode(&motion.poses[50], headings[50], None, 1.0);
        let apart = again.iter().zip(&whole.pose[rows][50]).take(VELOCITY_X).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f32::max) < 0.05);
    }

    #[test]
    fn counterparts_are_at_the_same_phase() {
        let db = database(LEAST_FRAMES).unwrap();
        for row in (0..db.frames()).step_by(37) {
            for style in 0..STYLES.len() as u16 {
                let at = db.counterparts(row, style).next().unwrap();
                let time = |row: usize| db.canonical_time[row];
                let (i, t) = (at as usize, at.fract());
                let there = time(i) + if t > 0.0 { t * (time(i + 1) - time(i)) } else { 0.0 };
                assert!((there - time(row)).abs() < 3.0, "row {row}, style {style}: {there} for {}", time(row));
            }
        }
    }
}
