//! `strut key-style`: makes a BVH file from a few styles over time.

use crate::print::print;
use std::path::PathBuf;
use std::sync::Arc;
use strut_core::somn::{Interpolation, KeyStyling, Method, Mode, Synthesis};
use strut_formats::bvh::{self, Bvh};
use strut_formats::{key_style_model, style_keys};
use strut_tasks::counted;
use strut_tasks::files::{self, Outputs};
use strut_tasks::{Outcome, TaskError};

/// Greatest size of a table of keys, bytes.
const MAX_TABLE_BYTES: usize = 16 << 20;

/// Synthesise a motion from style values over time
///
/// Styles that are more than half a standard deviation away from all recorded styles are moved back to that distance.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// A model that train-key-style wrote
    #[arg(long, value_name = "M")]
    model: PathBuf,
    /// A table with the column time, in seconds, and one column for every axis of the model, in its unit
    #[arg(long, value_name = "CSV")]
    keys: PathBuf,
    /// Curves through the keys: catmull-rom, or monotone, which never overshoots them
    #[arg(long, value_name = "CURVE", default_value = "catmull-rom", value_parser = ["catmull-rom", "monotone"])]
    interpolation: String,
    /// How the components of the model are combined: smooth, a weighted mean, or hard, the likeliest alone
    #[arg(long, value_name = "MODE", default_value = "smooth", value_parser = ["smooth", "hard"])]
    mode: String,
    /// The BVH file to write
    #[arg(short, long, value_name = "OUT.bvh")]
    output: PathBuf,
}

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check([args.output.as_path()])?;
    let file = files::read(&args.model, key_style_model::KIND.max_bytes)?;
    let model = key_style_model::read(&file).map_err(|e| TaskError::in_file(&args.model, e))?;
    let in_keys = |e: &dyn std::fmt::Display| TaskError::in_file(&args.keys, e);
    let keys = style_keys::parse(&files::read(&args.keys, MAX_TABLE_BYTES)?, &model.axes).map_err(|e| in_keys(&e))?;
    let interpolation =
        if args.interpolation == "monotone" { Interpolation::Monotone } else { Interpolation::CatmullRom };
    let mode = if args.mode == "hard" { Mode::Hard } else { Mode::KEYED };
    let mut synthesis = Synthesis::new(Arc::new(model));
    let styling = KeyStyling::new(&keys, interpolation, &mut synthesis, mode).map_err(|e| in_keys(&e))?;
    let motion = styling.motion(&mut synthesis, Method::KeyStyle);
    let bvh = Bvh::from_humanoid(&motion).map_err(TaskError::new)?;
    let mut outputs = Outputs::default();
    outputs.stage(&args.output, &bvh::write(&bvh))?;
    outputs.commit()?;
    let model = synthesis.model();
    let guesses = keys.iter().filter(|key| synthesis.support(&key.style) < model.least_support).count();
    let remark = match guesses {
        0 => String::new(),
        n => format!("; {n} of the keys are far from all recorded styles"),
    };
    let (output, frames) = (args.output.display(), motion.poses.len());
    let secs = frames as f32 / motion.rate_hz;
    let made = format!("{}, {}", counted(keys.len(), "key"), counted(frames, "frame"));
    print(&format!("{output}: {made}, {secs:.1} s{remark}\n"));
    Ok(())
}
