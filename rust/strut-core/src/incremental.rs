//! Long work in steps, between which whoever runs it may do other things, show progress, or give up.

use crate::parallel::ParallelMap;
use std::ops::ControlFlow;

/// Work that is done step by step. The result depends neither on the executor nor on when the steps are taken.
pub trait IncrementalJob: Sized {
    /// What is known after a step.
    type Progress;
    /// What the work is for.
    type Output;
    /// Why there is none; [`Infallible`](std::convert::Infallible) if there always is.
    type Error;

    /// Does a piece of the work; `None` when nothing was left to do but to conclude.
    ///
    /// # Errors
    /// If the work cannot go on, now or later.
    fn step(&mut self, executor: &impl ParallelMap) -> Result<Option<Self::Progress>, Self::Error>;

    /// The result, once [`IncrementalJob::step`] has returned `None`.
    ///
    /// # Errors
    /// If the steps have led to no result.
    fn conclude(self, executor: &impl ParallelMap) -> Result<Self::Output, Self::Error>;

    /// Takes the steps that are left, and gives the result.
    ///
    /// # Errors
    /// As the steps and the conclusion.
    fn finish(mut self, executor: &impl ParallelMap) -> Result<Self::Output, Self::Error> {
        while self.step(executor)?.is_some() {}
        self.conclude(executor)
    }

    /// [`IncrementalJob::finish`] with an observer of the progress, which may cancel: then there is `None`.
    ///
    /// # Errors
    /// As [`IncrementalJob::finish`].
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
