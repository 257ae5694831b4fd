//! Contents of a buffer, once the GPU has written them.

use std::future::Future;
use std::pin::Pin;
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Context, Poll, Waker};

/// Result of a mapping.
type Mapped = Result<(), wgpu::BufferAsyncError>;

/// Future that resolves when a buffer can be read.
#[derive(Clone, Debug, Default)]
pub(crate) struct Readback(Arc<Mutex<(Option<Mapped>, Option<Waker>)>>);

impl Readback {
    /// Requests the first bytes of a buffer for reading.
    pub(crate) fn of(buffer: &wgpu::Buffer, bytes: u64) -> Self {
        let readback = Self::default();
        let answered = readback.clone();
        buffer.map_async(wgpu::MapMode::Read, ..bytes, move |mapped| {
            let mut state = answered.0.lock().unwrap_or_else(PoisonError::into_inner);
            state.0 = Some(mapped);
            if let Some(waker) = state.1.take() {
                waker.wake();
            }
        });
        readback
    }
}

impl Future for Readback {
    type Output = Mapped;

    fn poll(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Mapped> {
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(mapped) = state.0.take() {
            return Poll::Ready(mapped);
        }
        state.1 = Some(context.waker().clone());
        Poll::Pending
    }
}
