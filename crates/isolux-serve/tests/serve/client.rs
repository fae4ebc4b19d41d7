//! A client that writes bytes and reads one response.

use crate::fake::SOON;
use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};

/// What came back.
#[derive(Debug)]
pub(crate) struct Answer {
    pub(crate) status: u16,
    head: String,
    pub(crate) body: String,
}

impl Answer {
    fn parse(bytes: &[u8]) -> Option<Self> {
        let text = String::from_utf8_lossy(bytes);
        let (head, body) = text.split_once("\r\n\r\n")?;
        let status = head.split(' ').nth(1)?.parse().ok()?;
        Some(Self { status, head: head.to_owned(), body: body.to_owned() })
    }

    /// A header of the response; empty if it has none of that name.
    pub(crate) fn header(&self, name: &str) -> &str {
        let lines = self.head.lines().skip(1).filter_map(|line| line.split_once(": "));
        let mut values = lines.filter(|(n, _)| n.eq_ignore_ascii_case(name)).map(|(_, v)| v);
        values.next().unwrap_or_default()
    }
}

/// A connection that gives up waiting after some time.
pub(crate) fn connect(address: SocketAddr) -> TcpStream {
    let stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(SOON)).unwrap();
    stream
}

/// Sends bytes and reads until the server closes; `None`: no response.
pub(crate) fn send(address: SocketAddr, bytes: &[u8]) -> Option<Answer> {
    let mut stream = connect(address);
    // The server may have refused before it has read all.
    let _ = stream.write_all(bytes);
    read(&mut stream)
}

/// Reads until the server closes.
pub(crate) fn read(stream: &mut TcpStream) -> Option<Answer> {
    let mut bytes = Vec::new();
    let _ = stream.read_to_end(&mut bytes);
    Answer::parse(&bytes)
}

/// The bytes of a request for the server itself, with further headers, each ended by a line end.
pub(crate) fn request(address: SocketAddr, line: &str, headers: &str, body: &str) -> Vec<u8> {
    let length = body.len();
    format!(
        "{line} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\
         Content-Length: {length}\r\n{headers}\r\n{body}"
    )
    .into_bytes()
}

pub(crate) fn get(address: SocketAddr, target: &str) -> Answer {
    send(address, &request(address, &format!("GET {target}"), "", "")).unwrap()
}

pub(crate) fn post(address: SocketAddr, target: &str, body: &str) -> Answer {
    send(address, &request(address, &format!("POST {target}"), "", body)).unwrap()
}

/// A question for a reading along one ray from a place on the x axis.
pub(crate) fn question(x: f64) -> String {
    format!("{{\"world\":0,\"rays\":[{{\"origin\":[{x:?},0,0],\"direction\":[0,0,-1]}}]}}")
}
