//! Requests to the server of walk-throughs, sent through a real connection.

use isolux_serve::{Control, Feed, Gone, Limits, Page, Question, Server, Settings, Shown, serve};
use std::io::{Read, Write};
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, LazyLock};
use std::time::Duration;

/// An answer to a whole request comes within this time, on a busy machine too.
const PATIENCE: Duration = Duration::from_millis(200);
/// A client that waits longer than this after the end of its request has found a hang.
const MOST_TIME: Duration = Duration::from_secs(5);
/// A server that fails a whole request so often in a row is gone.
const MOST_TRIES: u32 = 10;

/// The port stands in requests, as the server is known by it.
const PORT: u16 = 47_311;

static SERVER: LazyLock<Server> = LazyLock::new(|| {
    let limits = Limits { patience: Duration::from_millis(500), ..Limits::default() };
    let settings = Settings { port: PORT, limits, ..Settings::default() };
    let page = Page { html: "<!doctype html>".into() };
    serve(settings, &page, Arc::new(Nothing), Feed::new()).expect("a free port")
});

/// One world in which every reading is the number of its rays.
struct Nothing;

impl Shown for Nothing {
    fn worlds(&self) -> usize {
        1
    }

    fn hello(&self) -> Vec<u8> {
        b"{}".to_vec()
    }

    fn scene(&self, world: usize) -> Option<Arc<[u8]>> {
        assert_eq!(world, 0);
        Some(Arc::from(*b"scene"))
    }

    fn mesh(&self, world: usize) -> Option<Arc<[u8]>> {
        assert_eq!(world, 0);
        None
    }

    fn light(&self, _: usize, mesh: u64, _: u64) -> Option<Vec<u8>> {
        (mesh == 1).then(|| b"light".to_vec())
    }

    fn read(&self, _: usize, asked: &Question, _: &Gone) -> Result<Vec<u8>, String> {
        for ray in &asked.rays {
            assert!(ray.origin.iter().all(|x| x.is_finite()));
            assert!(ray.direction.iter().map(|x| x * x).sum::<f64>().is_normal());
        }
        assert!(asked.dimming.iter().all(|by| by.is_finite() && *by >= 0.0));
        Ok(asked.rays.len().to_string().into_bytes())
    }

    fn grids(&self, _: usize) -> Result<Arc<[u8]>, String> {
        Err("no grids".to_owned())
    }

    fn control(&self, what: Control) -> Result<(), String> {
        if let Control::Target { accuracy } = what {
            assert!(accuracy > 0.0 && accuracy.is_finite());
        }
        Err("no run is under way".to_owned())
    }
}

/// Sends bytes to the server and waits for the beginning of an answer; afterwards the server must still answer others.
pub fn ask(bytes: &[u8]) {
    exchange(bytes);
    let hello =
        format!("GET /api/hello HTTP/1.1\r\nHost: 127.0.0.1:{PORT}\r\nConnection: close\r\n\r\n");
    let answers = || exchange(hello.as_bytes()).starts_with(b"HTTP/1.1 200");
    // On a machine that is busy otherwise the patience of the server may be over before it has had its turn.
    assert!((0..MOST_TRIES).any(|_| answers()), "the server is gone");
}

/// What comes back at first; a request that is not whole is ended when nothing has come for a while.
fn exchange(bytes: &[u8]) -> Vec<u8> {
    let mut stream = TcpStream::connect(SERVER.address()).expect("the server takes connections");
    stream.set_read_timeout(Some(PATIENCE)).expect("a time above zero");
    // The server may have refused before it has read all.
    let _ = stream.write_all(bytes);
    let mut answer = [0; 64];
    if let Ok(length @ 1..) = stream.read(&mut answer) {
        return answer[..length].to_vec();
    }
    let _ = stream.shutdown(Shutdown::Write);
    stream.set_read_timeout(Some(MOST_TIME)).expect("a time above zero");
    match stream.read(&mut answer) {
        Err(error) if error.kind() == std::io::ErrorKind::WouldBlock => {
            panic!("no answer: {error}")
        }
        other => answer[..other.unwrap_or(0)].to_vec(),
    }
}

/// Requests that are served.
pub(crate) fn seeds() -> Vec<Vec<u8>> {
    let get = |target: &str| {
        format!("GET {target} HTTP/1.1\r\nHost: 127.0.0.1:{PORT}\r\nConnection: close\r\n\r\n")
    };
    let post = |target: &str, body: &str| {
        let length = body.len();
        format!(
            "POST {target} HTTP/1.1\r\nHost: 127.0.0.1:{PORT}\r\nConnection: close\r\nContent-Length: {length}\r\n\r\n{body}"
        )
    };
    let targets = ["/", "/api/hello", "/api/scene?world=0", "/api/light?world=0&mesh=1&since=0"];
    let ray = r#"{"world":0,"rays":[{"origin":[0,0,1],"direction":[0,0,-1]}],"dimming":[1]}"#;
    let posts = [
        post("/api/read", ray),
        post("/api/control", r#"{"action":"target","accuracy":0.01}"#),
        post("/api/control", r#"{"action":"stop"}"#),
    ];
    targets.into_iter().map(get).chain(posts).map(String::into_bytes).collect()
}
