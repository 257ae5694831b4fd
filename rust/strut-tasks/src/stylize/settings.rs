//! Settings of the styling, by the names of the command's options.

use crate::error::{Outcome, TaskError};
use crate::search::Search;
use crate::suggestion::unknown;
use crate::weights::{PartWeights, StyleWeights};
use serde::Serialize;
use serde::ser::{SerializeStruct, Serializer};
use std::fmt::Display;
use std::path::Path;
use std::str::FromStr;
use std::sync::Arc;
use strut_core::retarget::{ReadAs, UpAxis};
use strut_core::transfer::{Method, Model, Options, Stylizer};
use strut_evaluation::baselines::method_named;
use strut_formats::joints::Reading;
use strut_formats::quotation;

/// Names that [`method_named`] accepts.
pub const METHODS: [&str; 8] = ["mar", "lar", "nn", "knn", "gar", "lti", "lti-dof", "gp"];

/// On or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
#[allow(missing_docs)] // The names are self-explanatory, and comments would appear in the help.
pub enum Switch {
    On,
    Off,
}

impl FromStr for Switch {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "on" => Ok(Self::On),
            "off" => Ok(Self::Off),
            _ => Err("on or off was expected".into()),
        }
    }
}

/// Settings of the styling: the options of `strut stylize` apart from files. Equal settings have equal serialised forms.
#[derive(Clone, Debug, Serialize)]
pub struct StyleSettings {
    /// Styles with their weights.
    pub styles: StyleWeights,
    /// Other weights for parts of the body.
    pub parts: Vec<PartWeights>,
    /// The input's action, if known.
    pub action: Option<String>,
    /// The input's own style, if known.
    pub input_style: Option<String>,
    /// Search method for the neighbours.
    pub search: Search,
    /// Explicit reading options of the inputs, which override those that are detected.
    #[serde(serialize_with = "serialize_reading")]
    pub reading: Reading,
    /// All other options. The labels in them come from the names above.
    #[serde(with = "SerializedOptions")]
    pub options: Options,
}

/// Serialises reading options field by field, without the joints of [`ReadAs`], which are not used here.
fn serialize_reading<S: Serializer>(Reading { joints, read_as }: &Reading, to: S) -> Result<S::Ok, S::Error> {
    let ReadAs { joints: _, metres_per_unit, up, floor_metres, swap_sides, mirrored } = read_as;
    let mut fields = to.serialize_struct("Reading", 6)?;
    fields.serialize_field("joints", joints)?;
    fields.serialize_field("metres_per_unit", metres_per_unit)?;
    fields.serialize_field("up", &up.map(UpAxis::name))?;
    fields.serialize_field("floor_metres", floor_metres)?;
    fields.serialize_field("swap_sides", swap_sides)?;
    fields.serialize_field("mirrored", mirrored)?;
    fields.end()
}

/// Serialised form of [`Options`]. Only κ may be a number that JSON lacks: infinity is `null`.
#[derive(Serialize)]
#[serde(remote = "Options")]
struct SerializedOptions {
    k: usize,
    delta: f32,
    least_weight: f32,
    lambda: f32,
    kappa: f32,
    rho: f32,
    tempo: f32,
    coherence: bool,
    timing: bool,
    footplant: bool,
    action: Option<u16>,
    input_style: Option<u16>,
    #[serde(serialize_with = "serialize_method")]
    method: Method,
}

#[allow(clippy::trivially_copy_pass_by_ref)] // The signature that serde expects.
fn serialize_method<S: Serializer>(method: &Method, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(method.name())
}

impl StyleSettings {
    /// Names of the options that [`Self::set`] accepts.
    pub const NAMES: [&'static str; 14] = [
        "action",
        "input-style",
        "k",
        "lambda",
        "rho",
        "tempo",
        "kappa",
        "delta",
        "coherence",
        "timing",
        "footplant",
        "method",
        "part",
        "search",
    ];

    /// Creates the default settings with these styles.
    pub fn new(styles: StyleWeights) -> Self {
        let (parts, search, options) = (Vec::new(), Search::Exact, Options::DEFAULT);
        Self { styles, parts, action: None, input_style: None, search, reading: Reading::default(), options }
    }

    /// Sets an option by the command's long name, from the value as typed.
    ///
    /// # Errors
    /// A message about the name or the value.
    pub fn set(&mut self, name: &str, value: &str) -> Outcome {
        fn parse<T: FromStr<Err: Display>>(name: &str, value: &str) -> Outcome<T> {
            value.parse().map_err(|e| TaskError::usage(format_args!("{name} is '{}': {e}", quotation(value, 40))))
        }
        let options = &mut self.options;
        match name {
            "action" => self.action = Some(value.to_owned()),
            "input-style" => self.input_style = Some(value.to_owned()),
            "k" => options.k = parse(name, value)?,
            "lambda" => options.lambda = parse(name, value)?,
            "rho" => options.rho = parse(name, value)?,
            "tempo" => options.tempo = parse(name, value)?,
            "kappa" => options.kappa = parse(name, value)?,
            "delta" => options.delta = parse(name, value)?,
            "coherence" => options.coherence = parse::<Switch>(name, value)? == Switch::On,
            "timing" => options.timing = parse::<Switch>(name, value)? == Switch::On,
            "footplant" => options.footplant = parse::<Switch>(name, value)? == Switch::On,
            "method" => {
                let method = method_named(value);
                options.method = method.ok_or_else(|| TaskError::usage(unknown("method", value, &METHODS)))?;
            }
            "part" => self.parts.push(parse(name, value)?),
            "search" => self.search = parse(name, value)?,
            _ => return Err(TaskError::usage(unknown("option", name, &Self::NAMES))),
        }
        self.validate()
    }

    /// Checks the numbers, without a database.
    ///
    /// # Errors
    /// A message about the first number that is out of range.
    pub fn validate(&self) -> Outcome {
        self.options.validate().map_err(TaskError::usage)
    }

    /// Creates a stylizer with these settings for a database of this name.
    ///
    /// # Errors
    /// If the database lacks a style or an action.
    pub fn stylizer(&self, model: &Arc<Model>, database: &Path) -> Outcome<Stylizer> {
        self.validate()?;
        let db = model.catalogue();
        let in_db =
            |reason: String| TaskError::of(crate::Code::BadInput, format_args!("{}: {reason}", database.display()));
        let mut options = self.options;
        if let Some(name) = &self.action {
            options.action = Some(db.action_index(name).ok_or_else(|| in_db(unknown("action", name, &db.actions)))?);
        }
        if let Some(name) = &self.input_style {
            options.input_style = Some(db.style_index(name).ok_or_else(|| in_db(unknown("style", name, &db.styles)))?);
        }
        let weights = self.styles.of(db).map_err(in_db)?;
        let mut parts = Vec::new();
        for PartWeights { parts: of, weights } in &self.parts {
            let weights = weights.of(db).map_err(in_db)?;
            parts.extend(of.iter().map(|&part| (part, weights.clone())));
        }
        let mut stylizer = Stylizer::new(Arc::clone(model), options).map_err(|_| {
            // The numbers are already checked; only the labels can be wrong.
            let label = |name: &Option<String>| name.clone().unwrap_or_else(|| "any".into());
            let (action, style) = (label(&self.action), label(&self.input_style));
            in_db(format!("there is no clip of action '{action}' in style '{style}'"))
        })?;
        stylizer.set_styles(&weights).map_err(TaskError::new)?;
        for (part, weights) in parts {
            stylizer.set_part_styles(part, Some(&weights)).map_err(TaskError::new)?;
        }
        Ok(stylizer)
    }

    /// Returns a text that is equal for equal settings.
    ///
    /// # Errors
    /// None in practice.
    pub fn canonical(&self) -> Outcome<String> {
        serde_json::to_string(self).map_err(|e| TaskError::of(crate::Code::Fault, e))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use strut_formats::joints::JointAssignment;

    fn settings() -> StyleSettings {
        StyleSettings::new("old".parse().unwrap())
    }

    #[test]
    fn options_are_set_by_the_commands_names_and_values() {
        let mut settings = settings();
        for (name, value) in [("k", "20"), ("rho", "0.5"), ("timing", "off"), ("method", "knn"), ("part", "legs:old=1")]
        {
            settings.set(name, value).unwrap();
        }
        let Options { k, rho, timing, method, .. } = settings.options;
        assert_eq!((k, rho, timing, method, settings.parts.len()), (20, 0.5, false, Method::Knn, 1));
        for (name, value, expected) in [
            ("q", "1", "there is no option 'q'"),
            ("k", "many", "k is 'many': "),
            ("timing", "yes", "on or off was expected"),
            ("method", "mur", "did you mean 'mar'?"),
            ("rho", "7", "rho"),
        ] {
            let error = settings.set(name, value).unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        }
    }

    #[test]
    fn messages_show_the_beginning_of_what_is_long() {
        let mut refused = 0;
        for name in StyleSettings::NAMES {
            if let Err(error) = settings().set(name, &"x".repeat(5000)) {
                assert!(error.message.chars().count() < 500, "{name}: {} characters", error.message.chars().count());
                refused += 1;
            }
        }
        assert!(refused > 5, "{refused}");
    }

    #[test]
    fn every_name_can_be_set() {
        for name in StyleSettings::NAMES {
            let of = |value: &str| settings().set(name, value).err().map(|e| e.to_string());
            assert!(["1", "on", "mar", "legs:old", "exact"].iter().any(|value| of(value).is_none()), "{name}");
        }
    }

    /// Batch keys are made of this text, so names of types and fields of the program must not occur in it.
    #[test]
    fn equal_settings_have_the_same_text_in_every_version() {
        let mut settings = settings();
        for (name, value) in [("kappa", "inf"), ("lambda", "0.1"), ("part", "arms:proud=0.5")] {
            settings.set(name, value).unwrap();
        }
        settings.reading = Reading {
            joints: Some(JointAssignment::parse(br#"{"joints": {"hips": "Bip01", "chest": null}}"#).unwrap()),
            read_as: ReadAs { up: Some(UpAxis::Z), floor_metres: Some(0.25), ..ReadAs::default() },
        };
        let expected =
            r#"{"styles":[["old",1.0]],"parts":[{"parts":["left_arm","right_arm"],"weights":[["proud",0.5]]}],"#
                .to_owned()
                + r#""action":null,"input_style":null,"search":"exact","reading":{"joints":{"joints":{"chest":null,"hips":"#
                + r#""Bip01"}},"metres_per_unit":null,"up":"z","floor_metres":0.25,"swap_sides":false,"mirrored":null},"#
                + r#""options":{"k":40,"delta":0.35,"least_weight":0.00002,"lambda":0.1,"kappa":null,"rho":0.7,"tempo":0.5,"#
                + r#""coherence":true,"timing":true,"footplant":true,"action":null,"input_style":null,"method":"mar"}}"#;
        assert_eq!(settings.canonical().unwrap(), expected);
    }

    #[test]
    fn settings_that_differ_have_other_texts() {
        let of = |name: &str, value: &str| {
            let mut settings = settings();
            settings.set(name, value).unwrap();
            settings.canonical().unwrap()
        };
        let texts = [of("k", "40"), of("k", "20"), of("rho", "0.5"), of("part", "legs:old"), of("part", "arms:old")];
        assert_eq!(texts[0], settings().canonical().unwrap(), "40 is the default");
        let different: std::collections::BTreeSet<&String> = texts.iter().collect();
        assert_eq!(different.len(), texts.len());
    }
}
