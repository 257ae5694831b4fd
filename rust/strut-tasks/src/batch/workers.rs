//! Jobs on several threads. A job that fails does not stop the others.

use crate::error::{Code, Outcome, TaskError};
use std::any::Any;
use std::io::ErrorKind;
use std::num::NonZero;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// How a job ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Ending<T> {
    /// The job is done.
    Done(T),
    /// The input cannot be styled.
    Skipped(TaskError),
    /// The system or the program failed.
    Failed(TaskError),
}

/// Performs jobs by number, in this order, and passes every ending to `conclude`, with what was known by then. An I/O
/// failure is retried once; a panic counts as a fault of the job.
///
/// # Errors
/// If a job is cancelled, the disk is full, or `conclude` fails. No further job starts then.
pub(super) fn work<K: Default, T>(
    jobs: usize,
    threads: NonZero<usize>,
    perform: impl Fn(usize, &mut K) -> Outcome<T> + Sync,
    conclude: impl Fn(usize, K, Ending<T>) -> Outcome + Sync,
) -> Outcome {
    let next = AtomicUsize::new(0);
    let stopped: Mutex<Option<TaskError>> = Mutex::new(None);
    let is_stopped = || stopped.lock().unwrap_or_else(PoisonError::into_inner).is_some();
    let worker = || {
        while !is_stopped() {
            let job = next.fetch_add(1, Ordering::Relaxed);
            if job >= jobs {
                return;
            }
            let mut known = K::default();
            let ended = ending(|| perform(job, &mut known)).and_then(|ending| conclude(job, known, ending));
            if let Err(error) = ended {
                // The first error is reported.
                stopped.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..threads.get().min(jobs) {
            scope.spawn(worker);
        }
    });
    stopped.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(()), Err)
}

/// Performs a job and returns its ending, or an error that ends the batch.
pub(super) fn ending<T>(mut perform: impl FnMut() -> Outcome<T>) -> Outcome<Ending<T>> {
    let mut contained = || catch_unwind(AssertUnwindSafe(&mut perform)).unwrap_or_else(|panic| Err(fault(&*panic)));
    let mut result = contained();
    if matches!(&result, Err(TaskError { code: Code::Io(_), .. })) && !is_full(&result) {
        result = contained();
    }
    if is_full(&result) {
        return result.map(Ending::Done);
    }
    match result {
        Ok(done) => Ok(Ending::Done(done)),
        Err(error) => match error.code {
            Code::Cancelled => Err(error),
            Code::BadFile | Code::BadInput | Code::Usage => Ok(Ending::Skipped(error)),
            Code::Io(_) | Code::Fault => Ok(Ending::Failed(error)),
        },
    }
}

/// Returns whether the disk is full, which is not the fault of a job.
fn is_full<T>(result: &Outcome<T>) -> bool {
    let full = |kind| matches!(kind, ErrorKind::StorageFull | ErrorKind::QuotaExceeded);
    matches!(result, Err(TaskError { code: Code::Io(kind), .. }) if full(*kind))
}

/// Returns the error of a panic.
fn fault(panic: &(dyn Any + Send)) -> TaskError {
    let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    TaskError::of(Code::Fault, format_args!("a bug in Strut: {}", text.unwrap_or("it panicked")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io;
    use std::path::Path;

    const TWO: NonZero<usize> = NonZero::new(2).unwrap();

    fn io_error(kind: ErrorKind) -> TaskError {
        TaskError::io(Path::new("out.bvh"), &io::Error::from(kind))
    }

    /// Runs ten jobs, of which the third ends as given. Returns all endings by number, and the outcome of the batch.
    fn run(third: impl Fn() -> Outcome<usize> + Sync) -> (Vec<(usize, Ending<usize>)>, Outcome) {
        let endings = Mutex::new(Vec::new());
        let perform = |job, known: &mut usize| {
            *known = job;
            if job == 3 { third() } else { Ok(job) }
        };
        let result = work(10, TWO, perform, |job, known, ending| {
            assert_eq!(known, job);
            endings.lock().unwrap().push((job, ending));
            Ok(())
        });
        let mut endings = endings.into_inner().unwrap();
        endings.sort_by_key(|(job, _)| *job);
        (endings, result)
    }

    #[test]
    fn a_panic_fails_its_job_and_no_other() {
        let (endings, result) = run(|| panic!("the third job"));
        result.unwrap();
        assert_eq!(endings.len(), 10);
        for (job, ending) in endings {
            match ending {
                Ending::Failed(error) if job == 3 => assert!(error.message.ends_with("the third job"), "{error}"),
                ending => assert_eq!(ending, Ending::Done(job)),
            }
        }
    }

    #[test]
    fn a_bad_file_is_skipped() {
        let (endings, result) = run(|| Err(TaskError::in_file(Path::new("in.bvh"), "it is empty")));
        result.unwrap();
        assert!(matches!(endings[3].1, Ending::Skipped(_)) && endings.len() == 10);
    }

    #[test]
    fn what_the_system_cannot_do_is_tried_twice() {
        let tries = AtomicUsize::new(0);
        let (endings, _) = run(|| match tries.fetch_add(1, Ordering::Relaxed) {
            0 => Err(io_error(ErrorKind::TimedOut)),
            _ => Ok(3),
        });
        assert_eq!(endings[3].1, Ending::Done(3));
        let (endings, result) = run(|| Err(io_error(ErrorKind::PermissionDenied)));
        result.unwrap();
        assert_eq!(endings[3].1, Ending::Failed(io_error(ErrorKind::PermissionDenied)));
    }

    #[test]
    fn a_full_disk_and_a_caller_who_cancels_end_the_batch_and_blame_no_job() {
        for error in [io_error(ErrorKind::StorageFull), TaskError::cancelled()] {
            let (endings, result) = run(|| Err(error.clone()));
            assert_eq!(result.unwrap_err(), error);
            assert!(endings.iter().all(|(job, ending)| *job != 3 && *ending == Ending::Done(*job)));
        }
    }
}
