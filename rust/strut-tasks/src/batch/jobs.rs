//! The jobs of a batch: every input in every variant, each with its own output path.

use super::shard::Shard;
use super::variants::Variant;
use crate::error::{Outcome, TaskError};
use crate::gather::Source;
use std::collections::HashMap;
use std::path::{Component, Path};

/// An input in a variant.
#[derive(Clone, Debug)]
pub(super) struct Job {
    /// Path of the output, relative to the output folder, with `/`. It names the job.
    pub(super) output: String,
    /// Index of the input.
    pub(super) source: usize,
    /// Index of the variant.
    pub(super) variant: usize,
}

/// Returns the jobs of a shard, in the order of the inputs.
///
/// # Errors
/// If two outputs have the same name, or one lies outside its folder.
pub(super) fn jobs(sources: &[Source], variants: &[Variant], shard: Shard) -> Outcome<Vec<Job>> {
    let mut jobs = Vec::new();
    // Checking one variant is enough, since all variants have the same files.
    let mut places: HashMap<String, &Source> = HashMap::new();
    for (source, of) in sources.iter().enumerate() {
        let place = place(&of.below).ok_or_else(|| {
            let expected = "a path in the archive without '..' was expected";
            TaskError::in_file(Path::new(&of.path), expected)
        })?;
        // Some file systems ignore the case of names.
        if let Some(other) = places.insert(place.to_lowercase(), of) {
            let reason = format_args!("its output would have the same name as that of {}", other.path);
            return Err(TaskError::in_file(Path::new(&of.path), reason).with_hint("give the folder that contains both"));
        }
        for (variant, Variant { name, .. }) in variants.iter().enumerate() {
            let output = format!("{name}/{place}");
            if shard.holds(&output) {
                jobs.push(Job { output, source, variant });
            }
        }
    }
    Ok(jobs)
}

/// Returns the path of an output below its variant's folder, or `None` if the path leaves the folder.
pub(super) fn place(below: &str) -> Option<String> {
    let is_below = Path::new(below).components().all(|part| matches!(part, Component::Normal(_)));
    let stem = below.get(..below.len().checked_sub(".bvh".len())?)?;
    (is_below && !below.contains(['\\', ':']) && !stem.is_empty()).then(|| format!("{stem}.bvh"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gather::gather;
    use crate::stylize::StyleSettings;

    #[test]
    fn outputs_lie_below_their_variant_as_inputs_do_below_theirs() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir_all(folder.path().join("in/deep")).unwrap();
        for name in ["in/a.bvh", "in/deep/b.BVH"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        let sources = gather(&[folder.path().join("in")]).unwrap();
        let settings = StyleSettings::new("old".parse().unwrap());
        let variants = ["x", "y"].map(|name| Variant::new(name, settings.clone()).unwrap());
        let all = jobs(&sources, &variants, Shard::WHOLE).unwrap();
        let outputs: Vec<&str> = all.iter().map(|job| job.output.as_str()).collect();
        assert_eq!(outputs, ["x/a.bvh", "y/a.bvh", "x/deep/b.bvh", "y/deep/b.bvh"]);

        let twice = gather(&[folder.path().join("in/a.bvh"), folder.path().to_owned()]).unwrap();
        assert!(jobs(&twice, &variants, Shard::WHOLE).is_ok(), "one file is one job, however it is given");
        std::fs::write(folder.path().join("in/a.BVH"), "").unwrap();
        let sources = gather(&[folder.path().join("in")]).unwrap();
        let refused = jobs(&sources, &variants, Shard::WHOLE).unwrap_err().to_string();
        assert!(refused.contains("its output would have the same name as that of "), "{refused}");

        // On a case-sensitive file system.
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("walk.bvh"), "").unwrap();
        std::fs::write(folder.path().join("Walk.bvh"), "").unwrap();
        let sources = gather(&[folder.path().to_owned()]).unwrap();
        assert_eq!(jobs(&sources, &variants, Shard::WHOLE).is_err(), sources.len() == 2);
    }

    #[test]
    fn no_output_lies_outside() {
        assert_eq!(place("a/b.BVH").as_deref(), Some("a/b.bvh"));
        for bad in ["../a.bvh", "/a.bvh", "a/../b.bvh", "c:\\a.bvh", ".bvh"] {
            assert_eq!(place(bad), None, "{bad}");
        }
    }
}
