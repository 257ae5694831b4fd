//! Work without the interpreter lock, with checks for signals and progress.

use crate::error::exception;
use pyo3::prelude::*;
use std::any::Any;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError, mpsc};
use std::thread;
use std::time::Duration;
use strut_tasks::{Code, OnProgress, Outcome, Progress, TaskError};

/// Longest time between two checks for signals.
const BETWEEN_LOOKS: Duration = Duration::from_millis(50);

/// Runs a task on another thread while this one checks for signals and calls `progress` as `progress(what, done,
/// total)`. An exception of either cancels the task. A panic is raised as an exception.
///
/// # Errors
/// Error of the task, or the exception that cancelled it.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    progress: Option<&Py<PyAny>>,
    task: impl FnOnce(&OnProgress<'_>) -> Outcome<T> + Send,
) -> PyResult<T> {
    let latest: Mutex<Option<Progress>> = Mutex::new(None);
    let is_stopped = AtomicBool::new(false);
    let on_progress = |progress: Progress| {
        *latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(progress);
        if is_stopped.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    // An exception of a signal handler or of `progress` cancels the task.
    let look = || {
        Python::attach(|py| {
            py.check_signals()?;
            let news = latest.lock().unwrap_or_else(PoisonError::into_inner).take();
            if let (Some(Progress { what, done, total }), Some(progress)) = (news, progress) {
                progress.call1(py, (what, done, total))?;
            }
            Ok(())
        })
    };
    let mut stopped_by: Option<PyErr> = None;
    let result = py.detach(|| {
        thread::scope(|scope| {
            let (ended, end) = mpsc::channel();
            let on_progress = &on_progress;
            scope.spawn(move || {
                let result = catch_unwind(AssertUnwindSafe(|| task(on_progress)));
                // The receiver exists until this has arrived.
                let _ = ended.send(result.unwrap_or_else(|panic| Err(fault(&*panic))));
            });
            loop {
                if let Ok(result) = end.recv_timeout(BETWEEN_LOOKS) {
                    return result;
                }
                if stopped_by.is_none()
                    && let Err(exception) = look()
                {
                    stopped_by = Some(exception);
                    is_stopped.store(true, Ordering::Relaxed);
                }
            }
        })
    });
    if let Some(exception) = stopped_by {
        return Err(exception);
    }
    let result = result.map_err(|error| exception(py, &error))?;
    // Reports the last step if it was done within the last wait.
    look()?;
    Ok(result)
}

/// Returns the error of a panic.
fn fault(panic: &(dyn Any + Send)) -> TaskError {
    let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    TaskError::of(Code::Fault, format_args!("a bug in Strut: {}", text.unwrap_or("it panicked")))
}
