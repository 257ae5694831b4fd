//! How far a task has come, told to a caller who may cancel it.

use crate::error::{Outcome, TaskError};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

/// How far a task has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// What is being done.
    pub what: &'static str,
    /// Steps that are done.
    pub done: usize,
    /// All steps.
    pub total: usize,
}

/// Called from any thread with the progress of a task; on [`ControlFlow::Break`] the task ends with
/// [`crate::error::Code::Cancelled`].
pub type OnProgress<'a> = dyn Fn(Progress) -> ControlFlow<()> + Sync + 'a;

/// For callers who neither watch nor cancel.
pub fn unwatched(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Counts the steps of a task that are done on any thread.
pub(crate) struct Counter<'a> {
    what: &'static str,
    total: usize,
    done: AtomicUsize,
    on_progress: &'a OnProgress<'a>,
}

impl<'a> Counter<'a> {
    /// None of `total` steps is done.
    pub(crate) fn new(what: &'static str, total: usize, on_progress: &'a OnProgress<'a>) -> Self {
        Self { what, total, done: AtomicUsize::new(0), on_progress }
    }

    /// One step more is done.
    pub(crate) fn step(&self) -> Outcome {
        self.tell(self.done.fetch_add(1, Ordering::Relaxed) + 1)
    }

    /// Asks whether to go on, in the middle of a step.
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
