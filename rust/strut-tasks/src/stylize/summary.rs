//! Summary that `strut stylize` prints for a styled clip.

use std::path::Path;
use strut_formats::bvh;
use strut_formats::corpus::Clip;
use strut_formats::counted;

/// Collects the summary frame by frame.
pub struct Summary {
    weights: Vec<f64>,
    frames: usize,
}

impl Summary {
    /// Creates an empty summary for a database with this number of classes.
    pub fn new(classes: usize) -> Self {
        Self { weights: vec![0.0; classes], frames: 0 }
    }

    /// Adds a frame with its class weights.
    pub fn add(&mut self, class_weights: &[f32]) {
        self.frames += 1;
        for (sum, w) in self.weights.iter_mut().zip(class_weights) {
            *sum += f64::from(*w);
        }
    }

    /// Returns the mean weight of each class.
    pub fn mean_weights(&self) -> impl Iterator<Item = f64> {
        self.weights.iter().map(|w| w / self.frames.max(1) as f64)
    }

    /// Returns the text for a clip that is written to a path.
    pub fn text(&self, path: &Path, clip: &Clip, output: &bvh::Bvh, classes: &[String]) -> String {
        let seconds = |file: &bvh::Bvh| file.frames as f64 * file.frame_time_secs;
        let (out, before) = (seconds(output), seconds(&clip.file));
        let mut ranked: Vec<(&String, f64)> = classes.iter().zip(self.mean_weights()).collect();
        ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
        let reads_as: Vec<String> = ranked.iter().take(3).map(|(name, w)| format!("{name} {w:.2}")).collect();
        format!(
            "{}: {}, {out:.2} s ({:.2} of the input's); recognised as {}\n",
            path.display(),
            counted(output.frames, "frame"),
            out / before,
            reads_as.join(", ")
        )
    }
}
