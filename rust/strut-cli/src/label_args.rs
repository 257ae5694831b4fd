//! Labels of clips, which several commands need.

use std::path::PathBuf;
use strut_formats::corpus::Pattern;

/// Where the labels of clips come from.
#[derive(clap::Args)]
pub(crate) struct LabelArgs {
    /// Pattern of the labels in file names: {action}, {style}, {take}; any other {name} is ignored [default:
    /// {action}_{style}_{take}.bvh]
    #[arg(long, value_name = "P")]
    pub(crate) pattern: Option<Pattern>,
    /// A table of labels with the columns file,action,style[,take]; it replaces the labels in file names
    #[arg(long, value_name = "CSV")]
    pub(crate) labels: Option<PathBuf>,
}
