//! The Python package `strut-motion`: numpy arrays and Python objects for `strut-tasks`; no algorithms.
//!
//! Work is done with the interpreter lock released, on threads that end with the call. Returned arrays are moved to
//! numpy without a copy. Arguments are copied first, as other threads may write to them.
#![forbid(unsafe_op_in_unsafe_fn)]

mod arrays;
mod call;
mod clip;
mod corpus;
mod database;
mod error;
mod evaluate;
mod key_style;
mod many;
mod metrics;
mod model_file;
mod motion;
mod options;
mod plan;
mod styled;
mod stylizer;
mod walk;

use pyo3::prelude::*;

/// The compiled part of `strut`.
#[pymodule]
mod _strut {
    #[pymodule_export]
    use super::clip::Motion;
    #[pymodule_export]
    use super::database::Database;
    #[pymodule_export]
    use super::evaluate::evaluate;
    #[pymodule_export]
    use super::key_style::KeyStyleModel;
    #[pymodule_export]
    use super::many::StyledMotions;
    #[pymodule_export]
    use super::metrics::{foot_skate, mean_acceleration, mean_jerk, pose_error, positions};
    #[pymodule_export]
    use super::plan::Plan;
    #[pymodule_export]
    use super::styled::{StyledMotion, stylize};
    #[pymodule_export]
    use super::stylizer::Stylizer;
    #[pymodule_export]
    use super::walk::{WalkModel, Walker};
}
