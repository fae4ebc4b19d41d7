//! Clients who are slow, idle, or leave; and too many at once.

use crate::client::{connect, get, post, question, read, request};
use crate::fake::{Fake, LONG, SOON, served, until};
use isolux_serve::{Feed, Limits, Server};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread;
use std::time::{Duration, Instant};

/// Long enough for an honest request on a busy machine.
const PATIENCE: Duration = Duration::from_millis(500);

/// A server with few places and little patience.
fn impatient(fake: Fake, connections: u16) -> Server {
    let limits = Limits { connections, patience: PATIENCE, ..Limits::default() };
    served(Arc::new(fake), Feed::new(), limits)
}

/// Sends the beginning of something and nothing more.
fn begin(server: &Server, bytes: &[u8]) -> TcpStream {
    let mut stream = connect(server.address());
    stream.write_all(bytes).unwrap();
    stream
}

/// A new client is served, after those before have been waited for.
fn is_served_in_time(server: &Server) {
    let begun = Instant::now();
    assert_eq!(get(server.address(), "/api/hello").status, 200);
    assert!(begun.elapsed() < PATIENCE + SOON / 2, "{:?}", begun.elapsed());
}

#[test]
fn idle_connections_starve_nobody() {
    let server = impatient(Fake::default(), 8);
    let _idle: Vec<TcpStream> = (0..8).map(|_| begin(&server, b"")).collect();
    is_served_in_time(&server);
}

#[test]
fn more_connections_than_there_are_places_wait() {
    let server =
        served(Arc::default(), Feed::new(), Limits { connections: 1, ..Limits::default() });
    let first = begin(&server, b"");
    let mut second = begin(&server, &request(server.address(), "GET /api/hello", "", ""));
    second.set_read_timeout(Some(Duration::from_millis(100))).unwrap();
    assert!(read(&mut second).is_none());
    drop(first);
    second.set_read_timeout(Some(SOON)).unwrap();
    assert_eq!(read(&mut second).unwrap().status, 200);
}

#[test]
fn heads_that_never_end_starve_nobody() {
    let server = impatient(Fake::default(), 2);
    let _slow: Vec<TcpStream> =
        (0..2).map(|_| begin(&server, b"GET / HTTP/1.1\r\nHost: ")).collect();
    is_served_in_time(&server);
}

#[test]
fn connections_kept_after_a_response_starve_nobody() {
    let server = impatient(Fake::default(), 1);
    let request = format!("GET /api/hello HTTP/1.1\r\nHost: {}\r\n\r\n", server.address());
    let mut kept = begin(&server, request.as_bytes());
    kept.read_exact(&mut [0; 15]).unwrap();
    is_served_in_time(&server);
}

#[test]
fn responses_that_nobody_takes_starve_nobody() {
    let scene = Some(Arc::from(vec![0; 64 << 20]));
    let server = impatient(Fake { scene, ..Fake::default() }, 1);
    let request = request(server.address(), "GET /api/scene?world=0", "", "");
    let _deaf = begin(&server, &request);
    is_served_in_time(&server);
}

#[test]
fn bodies_that_do_not_come_are_not_waited_for() {
    let server = impatient(Fake::default(), 1);
    let head = format!(
        "POST /api/read HTTP/1.1\r\nHost: {}\r\nContent-Length: 9\r\nConnection: close\r\n\r\n{{",
        server.address()
    );
    let mut slow = begin(&server, head.as_bytes());
    assert_eq!(read(&mut slow).unwrap().status, 408);
    is_served_in_time(&server);
}

#[test]
fn large_containers_come_whole() {
    let scene: Arc<[u8]> = (0..8 << 20).map(|k: u32| (k % 127) as u8).collect();
    let fake = Fake { scene: Some(scene.clone()), ..Fake::default() };
    let server = served(Arc::new(fake), Feed::new(), Limits::default());
    let answer = get(server.address(), "/api/scene?world=0");
    assert_eq!(answer.header("content-length"), scene.len().to_string());
    assert!(answer.body.as_bytes() == &*scene);
}

#[test]
fn connections_are_used_again() {
    let server = served(Arc::default(), Feed::new(), Limits::default());
    let request = format!("GET /nothing HTTP/1.1\r\nHost: {}\r\n\r\n", server.address());
    let last = crate::client::request(server.address(), "GET /api/hello", "", "");
    let mut stream = begin(&server, &[request.repeat(3).as_bytes(), &last].concat());
    let mut text = String::new();
    stream.read_to_string(&mut text).unwrap();
    assert_eq!((text.matches(" 404 ").count(), text.matches(" 200 ").count()), (3, 1));
}

#[test]
fn who_leaves_is_known_to_be_gone() {
    let fake = Arc::new(Fake::default());
    let server = served(fake.clone(), Feed::new(), Limits::default());
    let asked = request(server.address(), "POST /api/read", "", &question(LONG));
    let asker = begin(&server, &asked);
    assert!(until(|| fake.begun.load(Ordering::SeqCst) == 1));
    assert_eq!(fake.left.load(Ordering::SeqCst), 0);
    drop(asker);
    assert!(until(|| fake.left.load(Ordering::SeqCst) == 1));
}

#[test]
fn readings_wait_for_each_other_and_too_many_are_turned_away() {
    let fake = Arc::new(Fake::default());
    let limits = Limits { readings: 2, waiting: 1, ..Limits::default() };
    let server = served(fake.clone(), Feed::new(), limits);
    let address = server.address();
    let ask = || thread::spawn(move || post(address, "/api/read", &question(LONG)).status);
    let mut askers = vec![ask(), ask()];
    assert!(until(|| fake.begun.load(Ordering::SeqCst) == 2));
    // One of these waits, the others are turned away.
    askers.extend([ask(), ask(), ask()]);
    assert!(until(|| askers.iter().filter(|asker| asker.is_finished()).count() == 2));
    // What is not a reading does not wait for readings.
    assert_eq!(get(address, "/api/scene?world=0").status, 200);
    assert_eq!(post(address, "/api/control", r#"{"action":"stop"}"#).status, 409);
    assert_eq!(fake.begun.load(Ordering::SeqCst), 2);
    fake.go.store(true, Ordering::SeqCst);
    let mut statuses: Vec<u16> = askers.into_iter().map(|asker| asker.join().unwrap()).collect();
    statuses.sort_unstable();
    assert_eq!(statuses, [200, 200, 200, 503, 503]);
}
