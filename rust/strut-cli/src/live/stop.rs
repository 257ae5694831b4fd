//! Stopping by Ctrl-C, after which recordings are still written.

use std::sync::atomic::{AtomicBool, Ordering};
use strut_tasks::{Outcome, TaskError};

static STOPPED: AtomicBool = AtomicBool::new(false);

/// Returns a function that tells whether the user or the system has requested a stop since this call.
pub(super) fn on_signals() -> Outcome<fn() -> bool> {
    ctrlc::set_handler(|| STOPPED.store(true, Ordering::Relaxed)).map_err(TaskError::new)?;
    Ok(|| STOPPED.load(Ordering::Relaxed))
}
