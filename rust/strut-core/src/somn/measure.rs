//! Measures: numbers computed from a pose that make up its style (`docs/methods/somn.md` §2).

use super::expression::{ExpressionError, Node, parse, parse_list};
use super::frame::Frame;
use super::named_measures::{NAMED, NamedMeasure, Unit};
use std::fmt::{self, Display};

/// A number that is measured on a pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    text: String,
    unit: Unit,
    node: Node,
}

impl Measure {
    /// The measures with a name.
    pub const NAMED: &[NamedMeasure] = NAMED;

    /// Parses a name or an expression: `hips_height`, `hand_l.y - shoulder_l.y`. Joints have the names of their roles
    /// (`left_hand` or `hand_l`); `x y z` are centimetres to the left, up and forward of the floor below the hips. Available
    /// are `+ - * / ( )`, `abs min max sqrt`, `atan2` in degrees, numbers, and the names of [`Measure::NAMED`].
    ///
    /// # Errors
    /// See [`ExpressionError`], which has the position.
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        parse(text).map(|node| Self { text: text.trim().to_owned(), unit: node.unit(), node })
    }

    /// Parses several measures, separated by commas.
    ///
    /// # Errors
    /// See [`ExpressionError`]; columns count from the beginning of the whole text.
    pub fn parse_list(text: &str) -> Result<Vec<Self>, ExpressionError> {
        let measure = |(text, node): (&str, Node)| Self { text: text.trim().to_owned(), unit: node.unit(), node };
        Ok(parse_list(text)?.into_iter().map(measure).collect())
    }

    /// The source text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Its unit.
    pub fn unit(&self) -> Unit {
        self.unit
    }

    /// Returns its value in [`Measure::unit`]; not finite if the expression has no value, such as after a division by zero.
    pub fn measure(&self, frame: &Frame) -> f64 {
        self.node.value(frame)
    }
}

impl Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}
