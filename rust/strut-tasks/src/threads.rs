//! The core's executor on a thread pool.

use crate::error::{Code, Outcome, TaskError};
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};
use std::sync::atomic::{AtomicUsize, Ordering};
use strut_core::parallel::ParallelMap;

/// Greatest number of threads that may be requested.
pub const MAX_THREADS: usize = 1024;

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
/// If the number is above [`MAX_THREADS`], or the system cannot create the threads.
pub fn with_threads<T: Send>(threads: usize, run: impl FnOnce() -> T + Send) -> Outcome<T> {
    check_threads(threads)?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    Ok(pool.map_err(|error| TaskError::of(Code::Fault, error))?.install(run))
}

/// Checks a requested number of threads.
///
/// # Errors
/// If it is above [`MAX_THREADS`].
pub fn check_threads(threads: usize) -> Outcome {
    if threads > MAX_THREADS {
        return Err(TaskError::usage(format_args!("there are {threads} threads; at most {MAX_THREADS} were expected")));
    }
    Ok(())
}

/// Applies a function to all items on the current pool, one item at a time per thread. After a failure no item behind
/// the failed one is started.
///
/// # Errors
/// The first failure in the order of the items, not of time.
pub fn map_until_failure<T, R, E>(items: &[T], run: impl Fn(&T) -> Result<R, E> + Sync) -> Result<Vec<R>, E>
where
    T: Sync,
    R: Send,
    E: Send,
{
    let failed = AtomicUsize::new(usize::MAX);
    let one = |(at, item): (usize, &T)| {
        // An item before the failed one is still needed: its failure would be the first.
        if at > failed.load(Ordering::Relaxed) {
            return None;
        }
        let result = run(item);
        if result.is_err() {
            failed.fetch_min(at, Ordering::Relaxed);
        }
        Some(result)
    };
    let results: Vec<Option<Result<R, E>>> = items.par_iter().enumerate().with_max_len(1).map(one).collect();
    // Items that were not started come after a failure.
    results.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_threads_than_supported_are_refused() {
        for threads in [MAX_THREADS + 1, usize::MAX] {
            let refused = with_threads(threads, || ()).unwrap_err();
            assert_eq!(refused.code, Code::Usage);
            assert!(refused.message.ends_with("at most 1024 were expected"), "{refused}");
        }
        assert_eq!(with_threads(2, rayon::current_num_threads), Ok(2));
    }

    #[test]
    fn nothing_is_started_behind_a_failure() {
        let items: Vec<usize> = (0..100).collect();
        let (started, fails_at) = (AtomicUsize::new(0), 3);
        let run = |item: &usize| {
            started.fetch_add(1, Ordering::Relaxed);
            if *item >= fails_at { Err(TaskError::new(item)) } else { Ok(*item) }
        };
        let failed = with_threads(1, || map_until_failure(&items, run)).unwrap();
        assert_eq!(failed.unwrap_err().message, "3");
        assert_eq!(started.into_inner(), 4);
    }

    #[test]
    fn the_first_failure_is_that_of_the_first_item() {
        let items: Vec<usize> = (0..100).collect();
        for threads in [1, 4] {
            let run = |item: &usize| if item % 7 == 5 { Err(TaskError::new(item)) } else { Ok(2 * item) };
            let failed = with_threads(threads, || map_until_failure(&items, run)).unwrap();
            assert_eq!(failed.unwrap_err().message, "5");
            let all =
                with_threads(threads, || map_until_failure(&items, |item| Outcome::Ok(2 * item))).unwrap().unwrap();
            assert!(all.iter().enumerate().all(|(i, twice)| *twice == 2 * i) && all.len() == 100);
        }
    }
}
