//! The settings that an evaluation varies.

use super::choices::{Labels, Part, PassMode, Registration};
use super::request::Request;
use crate::error::{Outcome, TaskError};
use crate::search::Search;
use crate::stylize::Switch;
use cpu_time::ThreadTime;
use serde::Serialize;
use std::sync::Arc;
use strut_core::catalogue::Catalogue;
use strut_core::database::Database;
use strut_core::database::build::BuildOptions;
use strut_core::humanoid::HumanoidMotion;
use strut_core::registration;
use strut_core::search::{Index, MAX_WINDOW};
use strut_core::transfer::{MAX_WEIGHT, Model, Options, Stylizer};
use strut_evaluation::baselines::method_named;
use strut_evaluation::quality::{Styled, style};
use strut_formats::quotation;

/// Settings of a database build.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Build {
    pub(super) registration: Registration,
    /// Greatest number of takes of each target class; 0 for all.
    pub(super) takes: usize,
    /// Number of frames of a search window.
    pub(super) window: usize,
    pub(super) search: Search,
}

impl Build {
    /// Returns the core's build options.
    pub(super) fn options(self, source: &str) -> BuildOptions {
        let registration = registration::Options { warp: self.registration.warp(), ..registration::Options::default() };
        BuildOptions { neutral: Some(source.to_owned()), registration, ..BuildOptions::default() }
    }

    /// Builds the model of a database with the search index of these settings.
    pub(super) fn model(self, database: Database) -> Arc<Model> {
        let index = self.search.of(Index::with_window(&database, self.window));
        Arc::new(Model::of(Catalogue::with_index(database, index)))
    }
}

/// Settings of the styling of an input.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Setting {
    pub(super) method: String,
    pub(super) labels: Labels,
    pub(super) mode: PassMode,
    pub(super) k: usize,
    pub(super) delta: f32,
    pub(super) lambda: f32,
    #[serde(serialize_with = "finite_or_text")]
    pub(super) kappa: f32,
    pub(super) rho: f32,
    pub(super) tempo: f32,
    pub(super) coherence: Switch,
    /// Weight of the target style.
    pub(super) intensity: f32,
    /// Part of the body that takes the target style; the rest is neutral.
    pub(super) part: Part,
}

/// Writes infinity as text, which JSON numbers do not have.
#[allow(clippy::trivially_copy_pass_by_ref)] // The signature that serde expects.
fn finite_or_text<S: serde::Serializer>(value: &f32, to: S) -> Result<S::Ok, S::Error> {
    if value.is_finite() { to.serialize_f32(*value) } else { to.serialize_str("inf") }
}

impl Setting {
    /// Returns the defaults, of which the others are variations.
    fn of_method(method: &str) -> Self {
        let Options { k, delta, lambda, kappa, rho, tempo, .. } = Options::DEFAULT;
        Self {
            method: method.to_owned(),
            labels: Labels::None,
            mode: PassMode::Offline,
            k,
            delta,
            lambda,
            kappa,
            rho,
            tempo,
            coherence: Switch::On,
            intensity: 1.0,
            part: Part::Whole,
        }
    }

    /// Returns a stylizer that turns inputs of an action, if the database has it, completely into a target style.
    pub(super) fn stylizer(&self, model: &Arc<Model>, action: Option<&str>, target: &str) -> Outcome<Stylizer> {
        let db = model.catalogue();
        let mut options = self.options()?;
        if matches!(self.labels, Labels::Both | Labels::Action) {
            options.action = action.and_then(|a| db.action_index(a));
        }
        if matches!(self.labels, Labels::Both | Labels::Style) {
            options.input_style = Some(db.neutral);
        }
        let mut stylizer = Stylizer::new(Arc::clone(model), options).map_err(TaskError::new)?;
        let missing = || TaskError::new(format_args!("a database without the held-out take has no style '{target}'"));
        let mut weights = vec![0.0; db.styles.len()];
        weights[usize::from(db.style_index(target).ok_or_else(missing)?)] = self.intensity;
        match self.part.parts() {
            None => stylizer.set_styles(&weights).map_err(TaskError::new)?,
            Some(parts) => {
                for &part in parts {
                    stylizer.set_part_styles(part, Some(&weights)).map_err(TaskError::new)?;
                }
            }
        }
        Ok(stylizer)
    }

    /// Styles an input. Returns the result and the CPU time per frame, milliseconds, which other programs hardly
    /// affect.
    pub(super) fn styled(&self, stylizer: &Stylizer, input: &HumanoidMotion) -> (Styled, f64) {
        let begin = ThreadTime::now();
        let styled = style(stylizer, input, self.mode.mode());
        // In the online mode the prediction before footplant takes its own pass.
        let passes = if self.mode == PassMode::Online { 2.0 } else { 1.0 };
        let ms = begin.elapsed().as_secs_f64() * 1e3 / passes;
        (styled, ms / input.poses.len().max(1) as f64)
    }

    fn options(&self) -> Outcome<Options> {
        let &Self { k, delta, lambda, kappa, rho, tempo, .. } = self;
        let coherence = self.coherence == Switch::On;
        let method = method_named(&self.method).ok_or_else(|| {
            TaskError::usage(format_args!(
                "there is no method '{}'; nn, knn, lar, mar, gar, lti, lti-dof or gp was expected",
                quotation(&self.method, 40)
            ))
        })?;
        let options = Options { k, delta, lambda, kappa, rho, tempo, coherence, method, ..Options::DEFAULT };
        options.validate().map_err(TaskError::usage)?;
        if self.intensity.is_nan() || self.intensity.abs() > MAX_WEIGHT {
            let expected = format_args!("a number from -{MAX_WEIGHT} to {MAX_WEIGHT} was expected");
            return Err(TaskError::usage(format_args!("the intensity is {}; {expected}", self.intensity)));
        }
        Ok(options)
    }
}

/// All combinations of builds and settings.
pub(super) struct Grid {
    pub(super) builds: Vec<Build>,
    pub(super) settings: Vec<Setting>,
}

impl Grid {
    /// Creates all combinations of the arguments' values.
    pub(super) fn new(args: &Request) -> Outcome<Self> {
        if let Some(window) = args.window.iter().find(|&&w| !(1..=MAX_WINDOW).contains(&w)) {
            return Err(TaskError::usage(format_args!(
                "a window has {window} frames; 1 to {MAX_WINDOW} were expected"
            )));
        }
        let mut builds = Vec::new();
        for &registration in &args.registration {
            for &takes in &args.takes {
                for &window in &args.window {
                    builds.extend(args.search.iter().map(|&search| Build { registration, takes, window, search }));
                }
            }
        }
        let mut settings: Vec<Setting> = args.methods.iter().map(|method| Setting::of_method(method)).collect();
        vary(&mut settings, &args.labels, |s, labels| s.labels = labels);
        vary(&mut settings, &args.mode, |s, mode| s.mode = mode);
        vary(&mut settings, &args.k, |s, k| s.k = k);
        vary(&mut settings, &args.delta, |s, delta| s.delta = delta);
        vary(&mut settings, &args.lambda, |s, lambda| s.lambda = lambda);
        vary(&mut settings, &args.kappa, |s, kappa| s.kappa = kappa);
        vary(&mut settings, &args.rho, |s, rho| s.rho = rho);
        vary(&mut settings, &args.tempo, |s, tempo| s.tempo = tempo);
        vary(&mut settings, &args.coherence, |s, coherence| s.coherence = coherence);
        vary(&mut settings, &args.intensity, |s, intensity| s.intensity = intensity);
        vary(&mut settings, &args.part, |s, part| s.part = part);
        settings.iter().try_for_each(|s| s.options().map(|_| ()))?;
        Ok(Self { builds, settings })
    }
}

/// Repeats every setting with each of the values.
fn vary<T: Copy>(settings: &mut Vec<Setting>, values: &[T], set: fn(&mut Setting, T)) {
    let with_each = |setting: &Setting| {
        let mut varied = vec![setting.clone(); values.len()];
        varied.iter_mut().zip(values).for_each(|(s, &value)| set(s, value));
        varied
    };
    *settings = settings.iter().flat_map(with_each).collect();
}
