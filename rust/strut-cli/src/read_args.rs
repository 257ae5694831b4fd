//! Reading options, which several commands share.

use clap::Args;
use std::path::PathBuf;
use strut_core::retarget::{ReadAs, UpAxis};
use strut_formats::joints::{self, JointAssignment, Reading};
use strut_tasks::{Outcome, TaskError, files};

/// How files are read where the guess is wrong.
#[derive(Args)]
pub(crate) struct ReadArgs {
    /// The joint of each role, as JSON: {"joints": {"hips": "Bip01", …}}
    #[arg(long, value_name = "FILE")]
    joints: Option<PathBuf>,
    /// Up axis of the files: x, -x, y, -y, z or -z [default: detected from the body]
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true, value_parser = up_axis)]
    up: Option<UpAxis>,
    /// Height of the ground along the up axis, metres [default: measured at the feet]
    #[arg(long, value_name = "METRES", allow_hyphen_values = true, value_parser = metres)]
    floor: Option<f32>,
    /// Swap the detected left and right sides
    #[arg(long)]
    swap_sides: bool,
}

impl ReadArgs {
    /// Returns the reading options.
    pub(crate) fn reading(&self) -> Outcome<Reading> {
        let parse = |path: &PathBuf| {
            let bytes = files::read(path, joints::MAX_BYTES)?;
            JointAssignment::parse(&bytes).map_err(|reason| TaskError::in_file(path, reason))
        };
        let read_as =
            ReadAs { up: self.up, floor_metres: self.floor, swap_sides: self.swap_sides, ..ReadAs::default() };
        Ok(Reading { joints: self.joints.as_ref().map(parse).transpose()?, read_as })
    }
}

fn up_axis(text: &str) -> Result<UpAxis, String> {
    UpAxis::from_name(text).ok_or_else(|| String::from("x, -x, y, -y, z or -z was expected"))
}

fn metres(text: &str) -> Result<f32, String> {
    let height = text.parse().ok().filter(|height: &f32| height.abs() <= 1e6);
    height.ok_or_else(|| String::from("a number of metres was expected"))
}
