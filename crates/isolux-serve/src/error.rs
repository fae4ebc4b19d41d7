//! Why there is no server.

use std::io::{self, ErrorKind};
use std::net::SocketAddr;

/// Why there is no server.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ServeError {
    /// Another program listens there: for the user to mend.
    #[error("{0} is in use by another program: choose another --port, or 0 for any that is free")]
    InUse(SocketAddr),
    /// The system keeps the port for others: for the user to mend.
    #[error("listening at {0} is not permitted: choose a --port from 1024")]
    Forbidden(SocketAddr),
    /// No network interface has the address: for the user to mend.
    #[error("{} is not an address of this machine: name one that is, or 127.0.0.1", .0.ip())]
    NotHere(SocketAddr),
    /// The system refuses for a reason of its own.
    #[error("cannot listen at {address}: {source}")]
    Listen {
        /// Where the server was to listen.
        address: SocketAddr,
        /// What the system says.
        source: io::Error,
    },
    /// The token is too easy to guess, or cannot stand in an address: for the user to mend.
    #[error("a token is at least 16 letters, digits, `-` or `_`")]
    Token,
    /// The system gives no random bits.
    #[error("the system gives no random bits for a token: {0}")]
    Random(String),
    /// The system gives no thread.
    #[error("no thread to serve from: {0}")]
    Thread(io::Error),
}

impl ServeError {
    /// Why nobody can listen at an address.
    pub(crate) fn listening(address: SocketAddr, source: io::Error) -> Self {
        match source.kind() {
            ErrorKind::AddrInUse => Self::InUse(address),
            ErrorKind::PermissionDenied => Self::Forbidden(address),
            ErrorKind::AddrNotAvailable => Self::NotHere(address),
            _ => Self::Listen { address, source },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_name_address_and_remedy() {
        let address = SocketAddr::from(([127, 0, 0, 1], 80));
        let message = |kind| ServeError::listening(address, io::Error::from(kind)).to_string();
        assert!(message(ErrorKind::AddrInUse).starts_with("127.0.0.1:80 is in use"));
        assert!(message(ErrorKind::AddrInUse).contains("another --port"));
        assert!(message(ErrorKind::PermissionDenied).contains("--port from 1024"));
        assert!(message(ErrorKind::AddrNotAvailable).starts_with("127.0.0.1 is not"));
        assert!(message(ErrorKind::OutOfMemory).starts_with("cannot listen at 127.0.0.1:80"));
    }
}
