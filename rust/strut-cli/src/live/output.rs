//! Outgoing packets.

use super::address::Address;
use std::fmt::{self, Display};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, UdpSocket};
use strut_tasks::{Outcome, TaskError};

/// Sends packets to one or more addresses.
pub(super) struct Output {
    targets: Vec<(UdpSocket, Address)>,
}

impl Output {
    /// Opens a socket for these addresses. Whether a program listens on them is unknown.
    pub(super) fn open(targets: &[Address]) -> Outcome<Self> {
        let open = |address: &Address| {
            let from: IpAddr = match (address.0.ip(), address.0.ip().is_loopback()) {
                (IpAddr::V4(_), true) => Ipv4Addr::LOCALHOST.into(),
                (IpAddr::V4(_), false) => Ipv4Addr::UNSPECIFIED.into(),
                (IpAddr::V6(_), true) => Ipv6Addr::LOCALHOST.into(),
                (IpAddr::V6(_), false) => Ipv6Addr::UNSPECIFIED.into(),
            };
            if address.0.port() == 0 {
                return Err(TaskError::usage(format_args!("{address} has no port to send to")));
            }
            let socket = UdpSocket::bind((from, 0)).map_err(|e| TaskError::new(format_args!("{address}: {e}")))?;
            Ok((socket, *address))
        };
        Ok(Self { targets: targets.iter().map(open).collect::<Outcome<_>>()? })
    }

    /// Sends a packet to all addresses. A packet that cannot be sent now is lost, as on any network.
    pub(super) fn send(&mut self, packet: &[u8]) {
        for (socket, address) in &self.targets {
            let _ = socket.send_to(packet, address.0);
        }
    }
}

impl Display for Output {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, (_, address)) in self.targets.iter().enumerate() {
            write!(f, "{}{address}", if i > 0 { ", " } else { "" })?;
        }
        Ok(())
    }
}
