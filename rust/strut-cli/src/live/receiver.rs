//! Incoming packets. A separate thread receives them, so that the arrival time is exact regardless of other work.

use super::address::Address;
use std::io::{self, ErrorKind};
use std::net::{SocketAddr, UdpSocket};
use std::sync::mpsc::{self, RecvTimeoutError, TrySendError};
use std::thread;
use std::time::{Duration, Instant};
use strut_formats::vmc::MAX_PACKET_BYTES;
use strut_tasks::{Outcome, TaskError};

/// Greatest number of waiting packets; more are dropped.
const MOST_WAITING: usize = 1024;

/// Pause after an error that may persist.
const PAUSE: Duration = Duration::from_millis(100);

/// Returns whether an error does not affect the next packet.
fn is_of_the_moment(error: ErrorKind) -> bool {
    matches!(error, ErrorKind::ConnectionRefused | ErrorKind::ConnectionReset | ErrorKind::Interrupted)
}

/// Repeats `receive` until there is a packet. After an error that may persist it calls `pause` first.
fn received<T>(mut receive: impl FnMut() -> io::Result<T>, mut pause: impl FnMut()) -> T {
    loop {
        match receive() {
            Ok(packet) => return packet,
            // A reset means that no program listens on the target port: receiving continues.
            Err(error) if is_of_the_moment(error.kind()) => {}
            Err(_) => pause(),
        }
    }
}

/// A packet with its arrival time on the receiver's clock.
pub(super) struct Packet {
    pub(super) bytes: Vec<u8>,
    pub(super) from: SocketAddr,
    pub(super) arrived_secs: f64,
}

/// Listens on an address.
pub(super) struct Receiver {
    packets: mpsc::Receiver<Packet>,
    address: SocketAddr,
    start: Instant,
}

impl Receiver {
    /// Starts to listen; port 0 is any free port.
    pub(super) fn listen(address: &Address) -> Outcome<Self> {
        let fail = |error: io::Error| match error.kind() {
            ErrorKind::AddrInUse => {
                TaskError::new(format_args!("another program listens on {address}; choose another port with --in"))
            }
            ErrorKind::AddrNotAvailable => TaskError::new(format_args!("this computer has no address {address}")),
            _ => TaskError::new(format_args!("{address}: {error}")),
        };
        let socket = UdpSocket::bind(address.0).map_err(fail)?;
        let address = socket.local_addr().map_err(fail)?;
        let (sender, packets) = mpsc::sync_channel(MOST_WAITING);
        let start = Instant::now();
        // The thread ends with the process, or with the first packet after the receiver was dropped.
        thread::spawn(move || {
            let mut bytes = vec![0; MAX_PACKET_BYTES + 1];
            loop {
                let (length, from) = received(|| socket.recv_from(&mut bytes), || thread::sleep(PAUSE));
                let arrived_secs = start.elapsed().as_secs_f64();
                let packet = Packet { bytes: bytes[..length].to_vec(), from, arrived_secs };
                if let Err(TrySendError::Disconnected(_)) = sender.try_send(packet) {
                    break;
                }
            }
        });
        Ok(Self { packets, address, start })
    }

    /// Returns the address that it listens on.
    pub(super) fn address(&self) -> SocketAddr {
        self.address
    }

    /// Returns the time on the clock of arrivals, seconds.
    pub(super) fn now_secs(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    /// Returns the next packet if one arrives within a time.
    pub(super) fn next(&self, within: Duration) -> Outcome<Option<Packet>> {
        match self.packets.recv_timeout(within) {
            Ok(packet) => Ok(Some(packet)),
            Err(RecvTimeoutError::Timeout) => Ok(None),
            Err(RecvTimeoutError::Disconnected) => Err(TaskError::new("the thread that listens has ended")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_persistent_error_is_not_retried_without_a_pause() {
        for (error, expected) in [
            (ErrorKind::ConnectionRefused, 0),
            (ErrorKind::ConnectionReset, 0),
            (ErrorKind::Interrupted, 0),
            (ErrorKind::NetworkDown, 3),
            (ErrorKind::NotConnected, 3),
        ] {
            let (mut attempts, mut pauses) = (0, 0);
            let receive = || {
                attempts += 1;
                if attempts > 3 { Ok(attempts) } else { Err(error.into()) }
            };
            assert_eq!(received(receive, || pauses += 1), 4);
            assert_eq!(pauses, expected, "{error}");
        }
    }
}
