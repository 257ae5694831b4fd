//! Clips whose labels are in their file names.

use std::path::PathBuf;
use strut_core::database::build::SourceClip;
use strut_core::humanoid::Proportions;
use strut_core::retarget::{Binding, to_humanoid};
use strut_formats::bvh;

/// A clip named `{set}_{action}_{style}_{take}.bvh` or `{style}_{action}_{take}.bvh`.
pub(crate) fn load(path: &PathBuf) -> SourceClip {
    let name = path.file_stem().unwrap().to_string_lossy().into_owned();
    let mut labels: Vec<&str> = name.split('_').collect();
    if labels.len() == 3 {
        labels = vec!["", labels[1], labels[0], labels[2]];
    }
    let motion = bvh::parse(&std::fs::read(path).unwrap()).unwrap().to_motion().unwrap();
    let binding = Binding::detect(&motion).unwrap();
    SourceClip {
        action: labels[1].into(),
        style: labels[2].into(),
        take: labels[3].parse().unwrap(),
        motion: to_humanoid(&motion, &binding, &Proportions::default()),
        source: String::new(),
        licence: String::new(),
        script: None,
        name,
    }
}
