//! Curves over time of the first fold, as in figures 3 and 4 of the paper.

use super::cross_validation::protocol;
use super::request::Request;
use super::settings::{Grid, Setting};
use crate::error::{Outcome, TaskError};
use serde::Serialize;
use strut_core::database::build::SourceClip;
use strut_core::humanoid::Role;
use strut_core::math::float_funcs::acos;
use strut_core::metrics::Points;
use strut_evaluation::leave_one_out::Trial;
use strut_evaluation::truth::Aligned;

/// One trial with the results of all settings.
#[derive(Serialize)]
pub struct TrialCurves {
    action: String,
    target: String,
    take: u32,
    /// Frames of the input over which errors are measured, [first, end).
    segments: Vec<[usize; 2]>,
    curves: Vec<Curve>,
}

/// Curves with one value per frame of the input.
#[derive(Serialize)]
struct Curve {
    /// "input", "truth", or the setting's method.
    name: String,
    #[serde(flatten)]
    setting: Option<Setting>,
    /// Angle of the left knee, degrees; 0 is straight.
    left_knee_degrees: Vec<f32>,
    /// Content time at each frame, seconds. That of the truth is continuous only within a segment.
    time_secs: Vec<f64>,
}

pub(super) fn of_first_fold(args: &Request, grid: &Grid, clips: &[SourceClip]) -> Outcome<Vec<TrialCurves>> {
    let build = grid.builds[0];
    let options = build.options(&args.source);
    let protocol = protocol(args, clips, build, &options);
    let Some(&take) = protocol.takes().first() else { return Ok(Vec::new()) };
    let model = build.model(protocol.database_without(take, 0).map_err(TaskError::new)?);
    let of_trial = |trial: &Trial| {
        let mut curves = vec![
            curve("input".into(), None, &Aligned::unchanged(&trial.input)),
            curve("truth".into(), None, &trial.truth),
        ];
        for setting in &grid.settings {
            let stylizer = setting.stylizer(&model, Some(&trial.action), &trial.target)?;
            let predicted = setting.styled(&stylizer, &trial.input).0.predicted;
            curves.push(curve(setting.method.clone(), Some(setting.clone()), &trial.aligned(&predicted)));
        }
        Ok(TrialCurves {
            action: trial.action.clone(),
            target: trial.target.clone(),
            take,
            segments: trial.segments.iter().map(|s| [s.start, s.end]).collect(),
            curves,
        })
    };
    protocol.trials(take).iter().map(of_trial).collect()
}

fn curve(name: String, setting: Option<Setting>, of: &Aligned) -> Curve {
    Curve {
        name,
        setting,
        left_knee_degrees: of.points.iter().map(left_knee_degrees).collect(),
        time_secs: of.time_secs.clone(),
    }
}

/// Returns the angle between thigh and shin, degrees.
fn left_knee_degrees(points: &Points) -> f32 {
    let at = |role: Role| points[role.index()];
    let thigh = at(Role::LeftLowerLeg) - at(Role::LeftUpperLeg);
    let shin = at(Role::LeftFoot) - at(Role::LeftLowerLeg);
    acos(thigh.dot(shin) / (thigh.length() * shin.length()).max(1e-6)).to_degrees()
}
