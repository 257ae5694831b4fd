//! Ctrl-C: what was recorded is still written.

use crate::failure::{Failure, Outcome};
use std::sync::atomic::{AtomicBool, Ordering};

static STOPPED: AtomicBool = AtomicBool::new(false);

/// Whether the user, or the system, has asked to stop since this was called.
pub(super) fn on_signals() -> Outcome<fn() -> bool> {
    ctrlc::set_handler(|| STOPPED.store(true, Ordering::Relaxed)).map_err(Failure::new)?;
    Ok(|| STOPPED.load(Ordering::Relaxed))
}
