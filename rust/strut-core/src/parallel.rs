//! How offline work is spread over threads, without core knowing of threads.

/// Runs independent pieces of work. The native command brings one with a thread pool; results never
/// depend on which is used, since every piece is a function of its number alone.
pub trait ParallelMap {
    /// `f(0), f(1), … f(n − 1)`, in this order, computed in any order.
    fn map<R: Send>(&self, n: usize, f: &(dyn Fn(usize) -> R + Sync)) -> Vec<R>;

    /// Pieces worth handing over together where steps may be of any size: all, unless they are run one by one anyway.
    fn batch_size(&self) -> usize {
        usize::MAX
    }
}

/// One after the other, on the calling thread.
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
