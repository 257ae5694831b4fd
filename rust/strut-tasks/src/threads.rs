//! The core's executor on a thread pool.

use crate::error::{Code, Outcome, TaskError};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use strut_core::parallel::ParallelMap;

/// Rayon's pool: one thread a processor, or `RAYON_NUM_THREADS`.
pub struct ThreadPool;

impl ParallelMap for ThreadPool {
    fn map<R: Send>(&self, n: usize, f: &(dyn Fn(usize) -> R + Sync)) -> Vec<R> {
        (0..n).into_par_iter().map(f).collect()
    }
}

/// Runs something on a pool of its own, which ends with it: of so many threads, or of one a processor for 0.
///
/// # Errors
/// If the system gives no threads.
pub fn with_threads<T: Send>(threads: usize, run: impl FnOnce() -> T + Send) -> Outcome<T> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    Ok(pool.map_err(|error| TaskError::of(Code::Fault, error))?.install(run))
}
