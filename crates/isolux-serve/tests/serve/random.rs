//! Whatever is sent, the server lives on, and serves nothing but what it has.

use crate::client::{connect, get};
use crate::fake::server;
use proptest::prelude::*;
use proptest::sample::select;
use std::cell::Cell;
use std::io::{Read, Write};
use std::net::{Shutdown, SocketAddr};
use std::time::Duration;

const CASES: u32 = 300;
/// An answer to a whole request comes within this time; what is cut short is then ended.
const ANSWER: Duration = Duration::from_millis(50);

const PATHS: [&str; 12] = [
    "/",
    "/index.html",
    "/favicon.ico",
    "/api/hello",
    "/api/scene",
    "/api/mesh",
    "/api/light",
    "/api/grids",
    "/api/events",
    "/api/read",
    "/api/control",
    "/etc/passwd",
];

fn bytes(most: usize) -> impl Strategy<Value = Vec<u8>> {
    prop::collection::vec(any::<u8>(), 0..most)
}

fn text(choices: &'static [&'static str]) -> impl Strategy<Value = Vec<u8>> {
    select(choices).prop_map(|text| text.as_bytes().to_vec())
}

fn method() -> impl Strategy<Value = Vec<u8>> {
    prop_oneof![14 => text(&["GET"]), 3 => text(&["POST"]), 2 => text(&["HEAD", "X"]), 1 => bytes(8)]
}

fn target() -> impl Strategy<Value = Vec<u8>> {
    let after = prop_oneof![
        8 => text(&["", "", "", "", "?world=0", "?world=0&mesh=1&since=0", "?", "#", "/", "/..", "%00", "\\"]),
        1 => bytes(12)
    ];
    let path = prop_oneof![6 => text(&PATHS), 1 => text(&["*", "http://a/", ".."]), 1 => bytes(20)];
    (path, after).prop_map(|(path, after)| [path, after].concat())
}

fn header() -> impl Strategy<Value = Vec<u8>> {
    let known = [
        "Host: evil",
        "Origin: null",
        "Content-Length: 5",
        "Content-Length: 99999999999999999999",
        "Transfer-Encoding: chunked",
        "Expect: 100-continue",
        "Connection: upgrade",
        "Upgrade: websocket",
        "Accept: */*",
        "Cookie: a=b",
        "Range: bytes=0-1",
        "Sec-Fetch-Site: none",
        "If-None-Match: *",
        "Authorization: Bearer a",
        "Connection: close",
        "X-Http-Method: PUT",
    ];
    let known = select(known.to_vec()).prop_map(|text| text.as_bytes().to_vec());
    prop_oneof![9 => known, 1 => bytes(30)]
}

fn request(address: SocketAddr) -> impl Strategy<Value = (Vec<u8>, Vec<u8>)> {
    let host = prop::bool::weighted(0.9);
    let end = prop::bool::weighted(0.95);
    let headers = prop::collection::vec(header(), 0..3);
    let parts = (method(), target(), host, headers, end, bytes(200));
    parts.prop_map(move |(method, target, host, headers, end, body)| {
        let mut all = [&*method, b" ", &target, b" HTTP/1.1\r\n"].concat();
        let host = host.then(|| format!("Host: {address}").into_bytes());
        for header in host.into_iter().chain(headers) {
            all.extend([&*header, b"\r\n"].concat());
        }
        if end {
            all.extend([b"\r\n", &*body].concat());
        }
        (target, all)
    })
}

/// The beginning of what comes back; empty if nothing does.
fn beginning(address: SocketAddr, bytes: &[u8]) -> Vec<u8> {
    let mut stream = connect(address);
    stream.set_read_timeout(Some(ANSWER)).unwrap();
    let _ = stream.write_all(bytes);
    let mut buffer = [0; 64];
    let mut length = stream.read(&mut buffer).unwrap_or(0);
    if length == 0 {
        let _ = stream.shutdown(Shutdown::Write);
        length = stream.read(&mut buffer).unwrap_or(0);
    }
    buffer[..length].to_vec()
}

#[test]
fn random_requests_do_no_harm() {
    let server = server();
    let address = server.address();
    let is_known = |target: &[u8]| {
        let path = target.split(|b| b"?#".contains(b)).next().unwrap();
        PATHS.iter().any(|known| known.as_bytes() == path && *known != "/etc/passwd")
    };
    let answered = Cell::new(0);
    proptest!(ProptestConfig::with_cases(CASES), |((target, bytes) in request(address))| {
        let answer = beginning(address, &bytes);
        let is_success = answer.starts_with(b"HTTP/1.1 200") || answer.starts_with(b"HTTP/1.1 204");
        prop_assert!(!is_success || is_known(&target));
        prop_assert_eq!(get(address, "/api/hello").status, 200);
        answered.set(answered.get() + u32::from(is_success));
    });
    // Otherwise the requests are so random that nothing is tested.
    let answered = answered.get();
    assert!(answered > CASES / 20, "{answered} of {CASES} were served");
}
