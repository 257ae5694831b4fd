//! Offline form of a database.

use super::parts::{Class, DatabaseParts};
use super::statistics::{RowSquares, RowSums};
use super::validation::{DatabaseError, validate_tensors, validated_classes};
use crate::pose_vector::PoseRow;

/// A database in the form that is built, stored and edited: validated data. It is converted to a
/// [`Catalogue`](crate::catalogue::Catalogue) for use.
#[derive(Clone, Debug)]
pub struct Database {
    parts: DatabaseParts,
    classes: Vec<Class>,
    sigma: PoseRow,
    limits: Box<[PoseRow; 2]>,
}

impl Database {
    /// Creates a database from its parts. Every shape, index and value is checked.
    ///
    /// # Errors
    /// See [`DatabaseError`].
    pub fn new(parts: DatabaseParts) -> Result<Self, DatabaseError> {
        let classes = validated_classes(&parts)?;
        validate_tensors(&parts)?;
        let mut sums = RowSums::default();
        sums.add(&parts.pose);
        let mut squares = RowSquares::around(sums.mean());
        squares.add(&parts.pose);
        let (sigma, limits) = (squares.deviation(), Box::new(sums.range()));
        Ok(Self { parts, classes, sigma, limits })
    }

    /// Number of rows.
    pub fn frames(&self) -> usize {
        self.parts.time_step.len()
    }

    /// Classes in order of their rows.
    pub fn classes(&self) -> &[Class] {
        &self.classes
    }

    /// Index of the class of a row.
    ///
    /// # Panics
    /// If `row` is not below [`Database::frames`].
    pub fn class_of_row(&self, row: usize) -> usize {
        assert!(row < self.frames(), "row {row} of {}", self.frames());
        self.classes.partition_point(|c| c.rows.end <= row)
    }

    /// Index of the clip of a row.
    ///
    /// # Panics
    /// If `row` is not below [`Database::frames`].
    pub fn clip_of_row(&self, row: usize) -> usize {
        assert!(row < self.frames(), "row {row} of {}", self.frames());
        self.parts.clips.partition_point(|c| c.first_frame + c.frames <= row)
    }

    /// Standard deviation of each degree of freedom over all rows, floored at 1e-4; padding is 1.
    pub fn sigma(&self) -> &PoseRow {
        &self.sigma
    }

    /// Least and greatest value of each degree of freedom over all rows.
    pub fn observed_range(&self) -> &[PoseRow; 2] {
        &self.limits
    }

    /// Index of the style of this name.
    pub fn style_index(&self, name: &str) -> Option<u16> {
        self.styles.iter().position(|s| s == name).map(|i| i as u16)
    }

    /// Index of the action of this name.
    pub fn action_index(&self, name: &str) -> Option<u16> {
        self.actions.iter().position(|s| s == name).map(|i| i as u16)
    }

    /// Counterparts of a row in a style: at most M fractional row indices, none if the style is missing for the row's
    /// action.
    pub fn counterparts(&self, row: usize, style: u16) -> impl Iterator<Item = f32> + '_ {
        let m = self.parts.counterparts_per_style;
        let first = (row * self.parts.styles.len() + usize::from(style)) * m;
        self.parts.counterpart[first..first + m].iter().copied().take_while(|&c| c >= 0.0)
    }

    /// Returns the data, and the classes of their rows.
    pub(crate) fn into_parts(self) -> (DatabaseParts, Vec<Class>) {
        (self.parts, self.classes)
    }
}

impl std::ops::Deref for Database {
    type Target = DatabaseParts;
    fn deref(&self) -> &DatabaseParts {
        &self.parts
    }
}
