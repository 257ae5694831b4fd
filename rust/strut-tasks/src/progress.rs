//! Progress of a task, reported to a callback that may cancel it.

use crate::error::{Outcome, TaskError};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Progress of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Name of the current work.
    pub what: &'static str,
    /// Number of finished steps.
    pub done: usize,
    /// Number of all steps.
    pub total: usize,
}

/// Callback with the progress of a task, called from any thread. On [`ControlFlow::Break`] the task ends with
/// [`crate::error::Code::Cancelled`].
pub type OnProgress<'a> = dyn Fn(Progress) -> ControlFlow<()> + Sync + 'a;

/// Callback that neither shows the progress nor cancels.
pub fn unwatched(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Counts the steps of a task. Steps may be done on any thread.
pub(crate) struct Counter<'a> {
    what: &'static str,
    total: usize,
    done: AtomicUsize,
    on_progress: &'a OnProgress<'a>,
}

impl<'a> Counter<'a> {
    /// Creates a counter at 0 of `total` steps.
    pub(crate) fn new(what: &'static str, total: usize, on_progress: &'a OnProgress<'a>) -> Self {
        Self { what, total, done: AtomicUsize::new(0), on_progress }
    }

    /// Counts one step.
    pub(crate) fn step(&self) -> Outcome {
        self.tell(self.done.fetch_add(1, Ordering::Relaxed) + 1)
    }

    /// Asks whether to continue, in the middle of a step.
    pub(crate) fn check(&self) -> Outcome {
        self.tell(self.done.load(Ordering::Relaxed))
    }

    fn tell(&self, done: usize) -> Outcome {
        match (self.on_progress)(Progress { what: self.what, done, total: self.total }) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(TaskError::cancelled()),
        }
    }
}
