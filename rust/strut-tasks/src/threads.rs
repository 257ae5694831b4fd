//! The core's executor on a thread pool.

use rayon::iter::{IntoParallelIterator, ParallelIterator};
use strut_core::parallel::ParallelMap;

/// Rayon's pool: one thread a processor, or `RAYON_NUM_THREADS`.
pub struct ThreadPool;

impl ParallelMap for ThreadPool {
    fn map<R: Send>(&self, n: usize, f: &(dyn Fn(usize) -> R + Sync)) -> Vec<R> {
        (0..n).into_par_iter().map(f).collect()
    }
}
