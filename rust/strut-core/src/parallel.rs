//! Parallel execution of offline work; the core itself creates no threads.

/// Runs independent pieces of work. The native command provides an implementation with a thread pool. Results do not depend
/// on the implementation, because every piece is a function of its index only.
pub trait ParallelMap {
    /// Returns `f(0), f(1), … f(n − 1)`, in this order, computed in any order.
    fn map<R: Send>(&self, n: usize, f: &(dyn Fn(usize) -> R + Sync)) -> Vec<R>;

    /// Number of pieces that are worth submitting together if the step size is free: all, unless they run one by one.
    fn batch_size(&self) -> usize {
        usize::MAX
    }
}

/// Runs pieces one by one on the calling thread.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sequential;

impl ParallelMap for Sequential {
    fn map<R: Send>(&self, n: usize, f: &(dyn Fn(usize) -> R + Sync)) -> Vec<R> {
        (0..n).map(f).collect()
    }

    fn batch_size(&self) -> usize {
        1
    }
}
