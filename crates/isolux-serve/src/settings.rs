//! Where to listen, and how much at once.

use std::net::{IpAddr, Ipv4Addr};
use std::time::Duration;

/// Where to listen, and for whom.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The address to listen at. Others than this machine reach it only if it is not a loopback
    /// address.
    pub address: IpAddr,
    /// The port to listen at; 0 for any that is free.
    pub port: u16,
    /// What everyone must know who asks for anything: at least 16 letters, digits, `-` or `_`.
    /// `None`: nothing at loopback addresses, a fresh one at all others.
    pub token: Option<String>,
    /// How much at once.
    pub limits: Limits,
}

impl Default for Settings {
    fn default() -> Self {
        let address = IpAddr::V4(Ipv4Addr::LOCALHOST);
        Self { address, port: 0, token: None, limits: Limits::default() }
    }
}

/// How much at once, and how long to wait for a client.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Connections, at least one; more wait until one is closed.
    pub connections: u16,
    /// Open streams of events; more are turned away.
    pub viewers: u16,
    /// Calls for readings and grids at once, at least one.
    pub readings: u16,
    /// Calls for containers at once, at least one.
    pub containers: u16,
    /// Requests that wait for a call of their kind; more are turned away.
    pub waiting: u16,
    /// How long a client may take for the head of a request, for its body, and for taking any part
    /// of a response. An idle connection is closed after this time.
    pub patience: Duration,
    /// After this time without an event a comment is sent on its stream.
    pub keep_alive: Duration,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            connections: 64,
            viewers: 16,
            readings: 2,
            containers: 4,
            // Below the number of connections: each carries one request at a time.
            waiting: 32,
            patience: Duration::from_secs(15),
            keep_alive: Duration::from_secs(10),
        }
    }
}
