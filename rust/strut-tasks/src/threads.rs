//! The core's executor on a thread pool.

use crate::error::{Code, Outcome, TaskError};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use strut_core::parallel::ParallelMap;

/// Rayon's pool: one thread per processor, or `RAYON_NUM_THREADS`.
pub struct ThreadPool;

impl ParallelMap for ThreadPool {
    fn map<R: Send>(&self, n: usize, f: &(dyn Fn(usize) -> R + Sync)) -> Vec<R> {
        (0..n).into_par_iter().map(f).collect()
    }
}

/// Runs a closure on its own pool, which ends with it. The pool has `threads` threads, or one per processor for 0.
///
/// # Errors
/// If the system cannot create the threads.
pub fn with_threads<T: Send>(threads: usize, run: impl FnOnce() -> T + Send) -> Outcome<T> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    Ok(pool.map_err(|error| TaskError::of(Code::Fault, error))?.install(run))
}
