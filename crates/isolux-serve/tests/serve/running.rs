//! Starting and stopping.

use crate::client::{connect, get, question, read, request};
use crate::fake::{Fake, LONG, PAGE, SOON, served, server, until};
use crate::viewer::Viewer;
use isolux_serve::{Feed, Limits, Page, ServeError, Server, Settings, serve};
use std::io::{Read, Write};
use std::net::{IpAddr, Ipv4Addr, TcpStream};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread;
use std::time::{Duration, Instant};

/// A second, and what a busy machine adds.
const BOUND: Duration = Duration::from_millis(1500);

/// With it a stream ends that is not cut off.
const LAST_CHUNK: &str = "\r\n0\r\n\r\n";

/// Less than a server waits for what it has open.
const AT_ONCE: Duration = Duration::from_millis(500);

fn stop_in_time(server: Server) {
    stop_within(server, BOUND);
}

fn stop_at_once(server: Server) {
    stop_within(server, AT_ONCE);
}

fn stop_within(server: Server, bound: Duration) {
    let begun = Instant::now();
    server.stop();
    assert!(begun.elapsed() < bound, "{:?}", begun.elapsed());
}

#[test]
fn nobody_listens_after_the_end() {
    let server = server();
    let address = server.address();
    assert!(address.ip().is_loopback() && address.port() > 0);
    assert_eq!(server.url(), format!("http://{address}/"));
    stop_at_once(server);
    assert!(TcpStream::connect(address).is_err());
}

#[test]
fn connections_kept_after_a_response_do_not_hold_up_the_end() {
    let server = server();
    let request = format!("GET /nothing HTTP/1.1\r\nHost: {}\r\n\r\n", server.address());
    let mut kept = connect(server.address());
    kept.write_all(request.as_bytes()).unwrap();
    kept.read_exact(&mut [0; 15]).unwrap();
    stop_at_once(server);
}

#[test]
fn streams_end_with_the_server() {
    let server = server();
    let mut viewer = connect(server.address());
    viewer.write_all(&request(server.address(), "GET /api/events", "", "")).unwrap();
    assert!(until(|| server.viewers() == 1));
    let _idle = connect(server.address());
    stop_in_time(server);
    let stream = read(&mut viewer).unwrap().body;
    assert!(stream.contains("data: []") && stream.ends_with(LAST_CHUNK), "{stream}");
}

#[test]
fn the_last_state_is_told_before_the_end() {
    let feed = Feed::new();
    let server = served(Arc::default(), feed.clone(), Limits::default());
    let mut viewer = Viewer::join(server.address());
    viewer.data("history");
    feed.publish("\"done\"".to_owned(), None);
    stop_in_time(server);
    assert_eq!(viewer.data("state"), "\"done\"");
    assert_eq!(viewer.next(), None);
}

#[test]
fn calls_that_take_long_do_not_hold_up_the_end() {
    let fake = Arc::new(Fake::default());
    let server = served(fake.clone(), Feed::new(), Limits::default());
    let mut asker = connect(server.address());
    asker.write_all(&request(server.address(), "POST /api/read", "", &question(LONG))).unwrap();
    assert!(until(|| fake.begun.load(Ordering::SeqCst) == 1));
    stop_in_time(server);
    assert!(until(|| fake.left.load(Ordering::SeqCst) == 1));
}

#[test]
fn waiting_ends_when_a_stopper_says_so() {
    let server = server();
    let (address, stopper) = (server.address(), server.stopper());
    let waiting = thread::spawn(move || server.wait());
    assert_eq!(get(address, "/api/hello").status, 200);
    assert!(!waiting.is_finished());
    stopper.stop();
    let begun = Instant::now();
    waiting.join().unwrap();
    assert!(begun.elapsed() < SOON);
}

#[test]
fn a_port_in_use_is_named_with_a_remedy() {
    let server = server();
    let settings = Settings { port: server.address().port(), ..Settings::default() };
    let again = serve(settings, &Page { html: PAGE.into() }, Arc::<Fake>::default(), Feed::new());
    let error = again.unwrap_err();
    assert!(matches!(error, ServeError::InUse(_)), "{error}");
    let message = error.to_string();
    assert!(message.starts_with(&server.address().to_string()), "{message}");
    assert!(message.contains("another --port"), "{message}");
}

/// 192.0.2.0/24 is set aside for examples (RFC 5737).
#[test]
fn an_address_of_another_machine_is_refused() {
    let address = IpAddr::V4(Ipv4Addr::new(192, 0, 2, 1));
    let settings = Settings { address, ..Settings::default() };
    let error = serve(settings, &Page { html: PAGE.into() }, Arc::<Fake>::default(), Feed::new());
    assert!(matches!(error.unwrap_err(), ServeError::NotHere(_)));
}

#[test]
fn poor_tokens_are_refused() {
    let settings = Settings { token: Some("secret".to_owned()), ..Settings::default() };
    let error = serve(settings, &Page { html: PAGE.into() }, Arc::<Fake>::default(), Feed::new());
    assert!(matches!(error.unwrap_err(), ServeError::Token));
}
