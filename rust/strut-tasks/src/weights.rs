//! Style weights on the command line: `proud=0.7,angry=0.3`.

use crate::suggestion::unknown;
use serde::ser::{Serialize, SerializeStruct, Serializer};
use std::fmt::Display;
use std::str::FromStr;
use strut_core::catalogue::Catalogue;
use strut_core::hsmm::styles_named;
use strut_core::transfer::{BodyPart, MAX_WEIGHT};
use strut_formats::quotation;

/// Names of the body parts, for messages.
const PART_NAMES: [&str; 6] = ["head", "torso", "left_arm", "right_arm", "arms", "legs"];

/// Weights by style name, as given.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct StyleWeights(Vec<(String, f32)>);

impl FromStr for StyleWeights {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let weight = |item: &str| {
            let (name, weight) = match item.rsplit_once('=') {
                Some((name, text)) => (name.trim(), text.trim().parse().map_err(|_| unlike_a_weight(text.trim()))?),
                None => (item.trim(), 1.0),
            };
            Ok((name.to_owned(), weight))
        };
        Self::new(text.split(',').map(weight).collect::<Result<Vec<_>, String>>()?)
    }
}

fn unlike_a_weight(text: impl Display) -> String {
    let text = quotation(&text.to_string(), 40);
    format!("the weight is '{text}'; a number from -{MAX_WEIGHT} to {MAX_WEIGHT} was expected")
}

impl StyleWeights {
    /// Creates weights by style name.
    ///
    /// # Errors
    /// A message about a name that is empty or repeated, or a weight beyond [`MAX_WEIGHT`].
    pub fn new(weights: Vec<(String, f32)>) -> Result<Self, String> {
        for (i, (name, weight)) in weights.iter().enumerate() {
            if name.is_empty() {
                return Err("a style has no name; NAME or NAME=WEIGHT was expected".into());
            }
            if weights[..i].iter().any(|(other, _)| other == name) {
                return Err(format!("style '{}' has two weights; one was expected", quotation(name, 40)));
            }
            if weight.is_nan() || weight.abs() > MAX_WEIGHT {
                return Err(unlike_a_weight(weight));
            }
        }
        Ok(Self(weights))
    }

    /// Returns one weight per style of the database.
    ///
    /// # Errors
    /// A message about the first unknown name.
    pub fn of(&self, db: &Catalogue) -> Result<Vec<f32>, String> {
        self.among(&db.styles, |name| db.styles.iter().position(|s| s == name).into_iter().collect())
    }

    /// Returns one weight per style of a walk model. The weight of a name with several landmarks is shared among them.
    ///
    /// # Errors
    /// A message about the first unknown name.
    pub fn of_walks(&self, styles: &[String]) -> Result<Vec<f32>, String> {
        self.among(styles, |name| styles_named(styles, name))
    }

    /// Returns one weight for each of these styles. A name may stand for several styles.
    fn among(&self, styles: &[String], named: impl Fn(&str) -> Vec<usize>) -> Result<Vec<f32>, String> {
        let mut weights = vec![0.0; styles.len()];
        for (name, weight) in &self.0 {
            let named = named(name);
            if named.is_empty() {
                return Err(unknown("style", name, styles));
            }
            for &style in &named {
                weights[style] += weight / named.len() as f32;
            }
        }
        Ok(weights)
    }
}

/// Weights of some parts of the body: `legs:old=1`.
#[derive(Clone, Debug, PartialEq)]
pub struct PartWeights {
    /// The parts.
    pub parts: &'static [BodyPart],
    /// Their weights.
    pub weights: StyleWeights,
}

impl Serialize for PartWeights {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut entry = to.serialize_struct("PartWeights", 2)?;
        entry.serialize_field("parts", &self.parts.iter().map(|part| part.name()).collect::<Vec<_>>())?;
        entry.serialize_field("weights", &self.weights)?;
        entry.end()
    }
}

impl FromStr for PartWeights {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, weights) = text.split_once(':').ok_or("PART:NAME=WEIGHT was expected, as in legs:old=1")?;
        let parts = BodyPart::from_name(&name.replace('-', "_"));
        let parts = parts.ok_or_else(|| unknown("body part", name, &PART_NAMES))?;
        Ok(Self { parts, weights: weights.parse()? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_alone_weighs_one() {
        let StyleWeights(weights) = "proud=0.7, angry=-3e-1,old".parse().unwrap();
        assert_eq!(weights, [("proud".to_owned(), 0.7), ("angry".to_owned(), -0.3), ("old".to_owned(), 1.0)]);
    }

    #[test]
    fn weights_are_numbers_in_range_and_names_are_there_once() {
        for bad in ["", "a,", "=1", "a=", "a=x", "a=nan", "a=inf", "a=11", "a=1,a=2"] {
            assert!(bad.parse::<StyleWeights>().is_err(), "{bad}");
        }
    }

    #[test]
    fn messages_show_the_beginning_of_what_is_long() {
        for long in [format!("old={}", "9".repeat(5000)), format!("{}=1", "x".repeat(5000))] {
            let refused = long
                .parse::<StyleWeights>()
                .map(|w| w.among(&["old".into()], |_| Vec::new()))
                .map_or_else(|refused| refused, |refused| refused.unwrap_err());
            assert!(refused.chars().count() < 300, "{} characters", refused.chars().count());
        }
    }

    #[test]
    fn parts_have_names() {
        for name in PART_NAMES {
            assert!(format!("{name}:old=1").parse::<PartWeights>().is_ok(), "{name}");
        }
        assert_eq!("left-arm:old".parse::<PartWeights>().unwrap().parts, [BodyPart::LeftArm]);
        assert_eq!(
            "leg:old=1".parse::<PartWeights>().unwrap_err(),
            "there is no body part 'leg'; did you mean 'legs'?"
        );
        assert!("old=1".parse::<PartWeights>().is_err());
    }
}
