//! Long jobs in steps, between which the caller may do other work, show progress, or cancel.

use crate::parallel::ParallelMap;
use std::ops::ControlFlow;

/// A job that runs step by step. The result depends neither on the executor nor on the times of the steps.
pub trait IncrementalJob: Sized {
    /// Progress after a step.
    type Progress;
    /// The job's output.
    type Output;
    /// The job's error; [`Infallible`](std::convert::Infallible) if it always succeeds.
    type Error;

    /// Does a part of the work; returns `None` if only [`IncrementalJob::conclude`] is left.
    ///
    /// # Errors
    /// If the job cannot be completed.
    fn step(&mut self, executor: &impl ParallelMap) -> Result<Option<Self::Progress>, Self::Error>;

    /// Returns the output, once [`IncrementalJob::step`] has returned `None`.
    ///
    /// # Errors
    /// If the steps gave no output.
    fn conclude(self, executor: &impl ParallelMap) -> Result<Self::Output, Self::Error>;

    /// Runs the remaining steps and returns the output.
    ///
    /// # Errors
    /// See [`IncrementalJob::step`] and [`IncrementalJob::conclude`].
    fn finish(mut self, executor: &impl ParallelMap) -> Result<Self::Output, Self::Error> {
        while self.step(executor)?.is_some() {}
        self.conclude(executor)
    }

    /// [`IncrementalJob::finish`] with an observer of the progress, which may cancel; the result is then `None`.
    ///
    /// # Errors
    /// See [`IncrementalJob::finish`].
    fn run(
        mut self,
        executor: &impl ParallelMap,
        observe: &mut dyn FnMut(Self::Progress) -> ControlFlow<()>,
    ) -> Result<Option<Self::Output>, Self::Error> {
        while let Some(progress) = self.step(executor)? {
            if observe(progress).is_break() {
                return Ok(None);
            }
        }
        self.conclude(executor).map(Some)
    }
}
