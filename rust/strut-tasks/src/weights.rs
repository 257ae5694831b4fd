//! Style weights on the command line: `proud=0.7,angry=0.3`.

use crate::suggestion::unknown;
use serde::ser::{Serialize, SerializeStruct, Serializer};
use std::str::FromStr;
use strut_core::catalogue::Catalogue;
use strut_core::hsmm::styles_named;
use strut_core::transfer::{BodyPart, MAX_WEIGHT};

/// Names of the body parts, for messages.
const PART_NAMES: [&str; 6] = ["head", "torso", "left_arm", "right_arm", "arms", "legs"];

/// Weights by style name, as given.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct StyleWeights(Vec<(String, f32)>);

impl FromStr for StyleWeights {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut weights: Vec<(String, f32)> = Vec::new();
        for item in text.split(',') {
            let (name, weight) = match item.rsplit_once('=') {
                Some((name, weight)) => (name.trim(), parse_weight(weight.trim())?),
                None => (item.trim(), 1.0),
            };
            if name.is_empty() {
                return Err("a style has no name; NAME or NAME=WEIGHT was expected".into());
            }
            if weights.iter().any(|(n, _)| n == name) {
                return Err(format!("style '{name}' has two weights; one was expected"));
            }
            weights.push((name.to_owned(), weight));
        }
        Ok(Self(weights))
    }
}

fn parse_weight(text: &str) -> Result<f32, String> {
    let weight = text.parse().ok().filter(|w: &f32| w.abs() <= MAX_WEIGHT);
    weight.ok_or_else(|| format!("the weight is '{text}'; a number from -{MAX_WEIGHT} to {MAX_WEIGHT} was expected"))
}

impl StyleWeights {
    /// One weight a style of the database.
    ///
    /// # Errors
    /// A sentence about the first name that is not a style.
    pub fn of(&self, db: &Catalogue) -> Result<Vec<f32>, String> {
        self.among(&db.styles, |name| db.styles.iter().position(|s| s == name).into_iter().collect())
    }

    /// One weight a style of a walk model; that of a name with several landmarks is shared out among them.
    ///
    /// # Errors
    /// A sentence about the first name that is not a style.
    pub fn of_walks(&self, styles: &[String]) -> Result<Vec<f32>, String> {
        self.among(styles, |name| styles_named(styles, name))
    }

    /// One weight for each of these styles, of which some go by a name.
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
        entry.serialize_field("parts", &format!("{:?}", self.parts))?;
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
