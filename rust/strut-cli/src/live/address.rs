//! Addresses: `127.0.0.1:39539`, `localhost:39539`, or a port of this computer.

use std::fmt::{self, Display};
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::str::FromStr;
use strut_tasks::{Outcome, TaskError};

/// A UDP address.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Address(pub(super) SocketAddr);

impl Address {
    /// Returns the address of a port of this computer.
    pub(super) fn on_this_computer(port: u16) -> Self {
        Self(SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), port))
    }

    /// Returns whether a listener on this address receives packets that are sent to `target`.
    pub(super) fn hears(&self, target: &Self) -> bool {
        let is_all = self.0.ip().is_unspecified() && target.0.ip().is_loopback();
        self.0.port() == target.0.port() && (is_all || self.0.ip() == target.0.ip())
    }

    /// Refuses addresses other than loopback unless they are allowed.
    pub(super) fn check(&self, allow_network: bool) -> Outcome {
        if allow_network || self.0.ip().is_loopback() {
            return Ok(());
        }
        Err(TaskError::usage(format_args!("{self} is not a local address; add --allow-network to use it")))
    }
}

impl FromStr for Address {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let address = text.strip_prefix("vmc:").unwrap_or(text);
        let port = address.strip_prefix("localhost:").unwrap_or(address).parse();
        let parsed = port.map(Self::on_this_computer).or_else(|_| address.parse().map(Self));
        parsed.map_err(|_| "an address such as 127.0.0.1:39539, or a port, was expected".into())
    }
}

impl Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_may_be_short() {
        for text in ["127.0.0.1:39539", "localhost:39539", "39539", "vmc:39539", "vmc:127.0.0.1:39539"] {
            assert_eq!(text.parse(), Ok(Address::on_this_computer(39_539)), "{text}");
        }
        for text in ["", "host:1", "127.0.0.1", "127.0.0.1:70000", ":1"] {
            assert!(text.parse::<Address>().is_err(), "{text}");
        }
    }

    #[test]
    fn the_unspecified_address_includes_loopback() {
        let hears = |a: &str, b: &str| a.parse::<Address>().unwrap().hears(&b.parse().unwrap());
        assert!(hears("5000", "127.0.0.1:5000") && hears("0.0.0.0:5000", "127.0.0.1:5000"));
        assert!(!hears("5000", "5001") && !hears("0.0.0.0:5000", "192.168.0.2:5000"));
    }

    #[test]
    fn other_computers_are_refused() {
        for (text, is_here) in
            [("[::1]:1", true), ("127.8.8.8:1", true), ("0.0.0.0:1", false), ("192.168.0.2:1", false)]
        {
            let address: Address = text.parse().unwrap();
            assert_eq!(address.check(false).is_ok(), is_here, "{text}");
            assert!(address.check(true).is_ok());
        }
    }
}
