//! `strut inspect`: prints the contents of a file.

use crate::manners::{self, BimodalEntry};
use crate::print::print;
use crate::read_args::ReadArgs;
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;
use strut_core::contact;
use strut_core::database::{Class, Database, bimodal_styles};
use strut_core::humanoid::{JOINTS, Role};
use strut_core::math::Vec3;
use strut_core::motion::Motion;
use strut_core::retarget::{Binding, to_humanoid};
use strut_formats::bvh::{self, Bvh};
use strut_formats::joints::Reading;
use strut_formats::strutdb::{self, ClipInfo, SkeletonInfo};
use strut_tasks::counted;
use strut_tasks::files::{self, Outputs};
use strut_tasks::note_report::NoteReport;
use strut_tasks::{Outcome, TaskError};

/// Output of `--json`.
const JSON_HELP: &str = "\
The report of --json on a BVH file:
  file, kind (\"bvh\"), frames, frame_time_secs, rate_hz, duration_secs
  joints         [{name, parent (index), offset, channels, end_site, role}]
  humanoid       {confidence, metres_per_unit, up, floor_m, mirrored, leg_length_m, travel_m,
                 unmapped, notes}, or null
  notes          [{code, text}]: possible problems; empty for a clean file
  not_humanoid   why the skeleton is not a humanoid, or null
  contacts       [[left, right]] for every frame, 1 while the foot is planted
  planted_share  [left, right]
  steps          [left, right]

The report of --json on a database:
  file, kind (\"database\"), version, generator, rate_hz, frames, duration_secs,
  counterparts_per_style
  skeleton       {names, parents, offsets_cm, roles}
  actions, styles, neutral
  two_manners    [{action, style, separation, clips [[name], [name]]}], as in the report of
                 build-db
  classes        [{action, style, clips, frames, duration_secs, planted_share}]
  clips          [{name, action, style, take, frames, first_frame, source, licence}]";

/// Print the contents of a .bvh file or a database: skeleton, rate, length, labels, contacts
#[derive(clap::Args)]
#[command(after_long_help = JSON_HELP)]
pub(crate) struct Args {
    /// A .bvh file or a database
    file: PathBuf,
    #[command(flatten)]
    reading: ReadArgs,
    /// Write the result as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check(args.json.as_deref())?;
    let path = args.file.display().to_string();
    let is_database = args.file.extension().is_some_and(|e| e.eq_ignore_ascii_case("strutdb"));
    let bytes = files::read(&args.file, if is_database { strutdb::KIND.max_bytes } else { bvh::MAX_BYTES })?;
    // A safetensors header begins after its eight length bytes.
    let (json, text) = if is_database || bytes.get(8) == Some(&b'{') {
        let report = database_report(path, &bytes).map_err(|e| TaskError::in_file(&args.file, e))?;
        (serde_json::to_vec_pretty(&report), report.text())
    } else {
        let report =
            bvh_report(path, &bytes, &args.reading.reading()?).map_err(|e| TaskError::in_file(&args.file, e))?;
        (serde_json::to_vec_pretty(&report), report.text())
    };
    if let Some(target) = &args.json {
        let mut outputs = Outputs::default();
        outputs.stage(target, &json.map_err(TaskError::new)?)?;
        outputs.commit()?;
    }
    print(&text);
    Ok(())
}

#[derive(Serialize)]
struct BvhReport {
    file: String,
    kind: &'static str,
    joints: Vec<JointReport>,
    frames: usize,
    frame_time_secs: f64,
    rate_hz: f64,
    duration_secs: f64,
    humanoid: Option<HumanoidReport>,
    /// Warnings.
    notes: Vec<NoteReport>,
    not_humanoid: Option<String>,
    contacts: Vec<[u8; 2]>,
    planted_share: [f32; 2],
    steps: [usize; 2],
}

#[derive(Serialize)]
struct JointReport {
    name: String,
    parent: Option<usize>,
    offset: [f64; 3],
    channels: Vec<&'static str>,
    end_site: Option<[f64; 3]>,
    role: Option<&'static str>,
}

#[derive(Serialize)]
struct HumanoidReport {
    confidence: f32,
    metres_per_unit: f32,
    /// The file's up axis.
    up: &'static str,
    /// Height of the ground along the up axis.
    floor_m: f32,
    /// Whether left and right are swapped in the file.
    mirrored: bool,
    leg_length_m: f32,
    /// Horizontal distance that the hips travel.
    travel_m: f32,
    /// Joints without a role.
    unmapped: Vec<String>,
    notes: Vec<String>,
}

fn bvh_report(path: String, bytes: &[u8], reading: &Reading) -> Result<BvhReport, bvh::BvhError> {
    let (file, mut doubts) = bvh::parse_noted(bytes)?;
    let motion = file.to_motion()?;
    let (binding, not_humanoid) = match reading.bind(&motion) {
        Ok(binding) => (Some(binding), None),
        Err(reason) => (None, Some(reason.to_string())),
    };
    doubts.extend(binding.iter().flat_map(|b| b.doubts.iter().cloned()));
    let (humanoid, contacts) = binding.as_ref().map(|b| describe_humanoid(&motion, b)).unzip();
    let contacts = contacts.unwrap_or_default();
    Ok(BvhReport {
        file: path,
        kind: "bvh",
        joints: describe_joints(&file, binding.as_ref().map(|b| &b.joint_of_role)),
        frames: file.frames,
        frame_time_secs: file.frame_time_secs,
        rate_hz: 1.0 / file.frame_time_secs,
        duration_secs: motion.duration_secs(),
        humanoid,
        notes: NoteReport::of(&doubts),
        not_humanoid,
        planted_share: planted_share(&contacts),
        steps: [0, 1].map(|side| contacts.windows(2).filter(|w| w[0][side] < w[1][side]).count()),
        contacts,
    })
}

fn describe_joints(file: &Bvh, joint_of_role: Option<&[Option<usize>; JOINTS]>) -> Vec<JointReport> {
    let role_of = |joint: usize| {
        let joints = joint_of_role?;
        Role::ALL.into_iter().find(|r| joints[r.index()] == Some(joint)).map(Role::name)
    };
    let report = |(i, joint): (usize, &bvh::Joint)| JointReport {
        name: joint.name.clone(),
        parent: joint.parent,
        offset: joint.offset,
        channels: joint.channels.iter().map(|c| c.name()).collect(),
        end_site: joint.end_site,
        role: role_of(i),
    };
    file.joints.iter().enumerate().map(report).collect()
}

fn describe_humanoid(motion: &Motion, binding: &Binding) -> (HumanoidReport, Vec<[u8; 2]>) {
    let body = to_humanoid(motion, binding, &binding.proportions);
    let over_ground =
        |w: &[strut_core::humanoid::Pose]| Vec3::new(w[1].root.x - w[0].root.x, 0.0, w[1].root.z - w[0].root.z);
    let report = HumanoidReport {
        confidence: binding.confidence,
        metres_per_unit: binding.metres_per_unit,
        up: binding.up.name(),
        floor_m: binding.floor_metres,
        mirrored: binding.is_mirrored,
        leg_length_m: binding.proportions.leg_length(),
        travel_m: body.poses.windows(2).map(|w| over_ground(w).length()).sum(),
        unmapped: binding.unmapped.iter().map(|&j| motion.skeleton.joints()[j].name.clone()).collect(),
        notes: binding.notes.clone(),
    };
    (report, contact::label(&body).into_iter().map(|c| c.map(u8::from)).collect())
}

/// Returns the share of the frames in which the left and the right foot is planted.
fn planted_share(contacts: &[[u8; 2]]) -> [f32; 2] {
    [0, 1].map(|side| contacts.iter().filter(|c| c[side] == 1).count() as f32 / contacts.len().max(1) as f32)
}

impl BvhReport {
    fn text(&self) -> String {
        let mut out = String::new();
        let channels: usize = self.joints.iter().map(|j| j.channels.len()).sum();
        line(&mut out, format_args!("{}", self.file));
        line(
            &mut out,
            format_args!(
                "  skeleton  {} joints, {channels} channels, root '{}'",
                self.joints.len(),
                self.joints[0].name
            ),
        );
        line(
            &mut out,
            format_args!(
                "  length    {} at {:.5} Hz, {:.2} s",
                counted(self.frames, "frame"),
                self.rate_hz,
                self.duration_secs
            ),
        );
        if let Some(h) = &self.humanoid {
            let roles = self.joints.iter().filter(|j| j.role.is_some()).count();
            line(&mut out, format_args!("  humanoid  {roles} of {JOINTS} roles, confidence {:.2}", h.confidence));
            line(
                &mut out,
                format_args!(
                    "  size      one unit is {:.4} m, legs {:.2} m, travels {:.2} m",
                    h.metres_per_unit, h.leg_length_m, h.travel_m
                ),
            );
            let percent = self.planted_share.map(|s| 100.0 * s);
            line(
                &mut out,
                format_args!(
                    "  contacts  left {} steps, planted {:.0} %; right {} steps, planted {:.0} %",
                    self.steps[0], percent[0], self.steps[1], percent[1]
                ),
            );
            for fact in &h.notes {
                line(&mut out, format_args!("  reading   {fact}"));
            }
            for note in &self.notes {
                line(&mut out, format_args!("  note      {}", note.text));
            }
        }
        if let Some(reason) = &self.not_humanoid {
            line(&mut out, format_args!("  humanoid  none: {reason}"));
        }
        out
    }
}

#[derive(Serialize)]
struct DatabaseReport {
    file: String,
    kind: &'static str,
    version: String,
    generator: String,
    rate_hz: f32,
    frames: usize,
    duration_secs: f32,
    skeleton: SkeletonInfo,
    actions: Vec<String>,
    styles: Vec<String>,
    neutral: String,
    counterparts_per_style: usize,
    classes: Vec<ClassReport>,
    two_manners: Vec<BimodalEntry>,
    clips: Vec<ClipInfo>,
}

#[derive(Serialize)]
struct ClassReport {
    action: String,
    style: String,
    clips: usize,
    frames: usize,
    duration_secs: f32,
    planted_share: [f32; 2],
}

fn database_report(path: String, bytes: &[u8]) -> Result<DatabaseReport, strutdb::StrutdbError> {
    let metadata = strutdb::read_metadata(bytes)?;
    let db = strutdb::read(bytes)?.database;
    Ok(DatabaseReport {
        file: path,
        kind: "database",
        version: metadata.version,
        generator: metadata.generator,
        rate_hz: db.rate_hz,
        frames: db.frames(),
        duration_secs: db.frames() as f32 / db.rate_hz,
        skeleton: metadata.skeleton,
        actions: metadata.actions,
        styles: metadata.styles,
        neutral: metadata.neutral,
        counterparts_per_style: db.counterparts_per_style,
        classes: db.classes().iter().map(|class| describe_class(&db, class)).collect(),
        two_manners: manners::entries(&bimodal_styles(&db)),
        clips: metadata.clips,
    })
}

fn describe_class(db: &Database, class: &Class) -> ClassReport {
    ClassReport {
        action: db.actions[usize::from(class.action)].clone(),
        style: db.styles[usize::from(class.style)].clone(),
        clips: class.clips.len(),
        frames: class.rows.len(),
        duration_secs: class.rows.len() as f32 / db.rate_hz,
        planted_share: planted_share(&db.contact[class.rows.clone()]),
    }
}

impl DatabaseReport {
    fn text(&self) -> String {
        let mut out = String::new();
        line(&mut out, format_args!("{}", self.file));
        line(&mut out, format_args!("  database  version {}, made by {}", self.version, self.generator));
        line(
            &mut out,
            format_args!(
                "  length    {}, {} at {} Hz, {:.1} s",
                counted(self.clips.len(), "clip"),
                counted(self.frames, "frame"),
                self.rate_hz,
                self.duration_secs
            ),
        );
        line(&mut out, format_args!("  actions   {}", self.actions.join(", ")));
        line(&mut out, format_args!("  styles    {} (neutral: {})", self.styles.join(", "), self.neutral));
        let width =
            self.classes.iter().map(|c| c.action.chars().count() + c.style.chars().count()).max().unwrap_or(0) + 1;
        for class in &self.classes {
            let name = format!("{}/{}", class.action, class.style);
            let percent = class.planted_share.map(|s| 100.0 * s);
            line(
                &mut out,
                format_args!(
                    "  class     {name:width$} {:4} clips {:7} frames, planted left {:3.0} %, right {:3.0} %",
                    class.clips, class.frames, percent[0], percent[1]
                ),
            );
        }
        out + &manners::text(&self.two_manners)
    }
}

fn line(out: &mut String, text: std::fmt::Arguments<'_>) {
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{text}");
}
