//! Progress on stderr, shown only if that is a terminal.

use indicatif::{ProgressBar, ProgressStyle};
use std::ops::ControlFlow;
use strut_tasks::{OnProgress, Progress};

/// A progress bar that disappears when dropped.
pub(crate) struct Bar(ProgressBar);

impl Bar {
    /// Creates a bar of `total` steps.
    pub(crate) fn new(what: &'static str, total: usize) -> Self {
        // indicatif draws nothing if stderr is not a terminal.
        let bar = ProgressBar::new(total as u64).with_message(what);
        let style = ProgressStyle::with_template("{msg:12} {wide_bar} {pos}/{len} {eta:>4}");
        Self(bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar())))
    }

    /// Runs a task and shows its progress.
    pub(crate) fn watching<T>(task: impl FnOnce(&OnProgress<'_>) -> T) -> T {
        let bar = Self::new("", 0);
        task(&|Progress { what, done, total }| {
            bar.show(what, done, total);
            ControlFlow::Continue(())
        })
    }

    /// Counts one step.
    pub(crate) fn step(&self) {
        self.0.inc(1);
    }

    /// Shows a stage and its progress.
    pub(crate) fn show(&self, what: &'static str, done: usize, total: usize) {
        self.0.set_message(what);
        self.0.set_length(total as u64);
        self.0.set_position(done as u64);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
