//! Requests of those who should not be served.

use crate::client::{Answer, get, post, request, send};
use crate::fake::{PAGE, server};
use isolux_serve::{Feed, Page, Settings, serve};
use std::net::SocketAddr;
use std::sync::Arc;

const TOKEN: &str = "0123456789abcdef";

fn with(address: SocketAddr, line: &str, headers: &str) -> Answer {
    send(address, &request(address, line, headers, "")).unwrap()
}

#[test]
fn no_path_leads_to_a_file() {
    let server = server();
    for path in [
        "/../../etc/passwd",
        "/../../../../../../../../etc/passwd",
        "/%2e%2e/%2e%2e/etc/passwd",
        "/..%2f..%2fetc%2fpasswd",
        "/..%5c..%5cetc%5cpasswd",
        "/..\\..\\etc\\passwd",
        "//etc/passwd",
        "/etc/passwd",
        "/./etc/passwd",
        "/index.html/../../etc/passwd",
        "/api/../../etc/passwd",
        "/api/scene/../../../etc/passwd",
        "/%00",
        "/index.html%00.png",
        "/Cargo.toml",
        "/src/lib.rs",
        "/file:///etc/passwd",
        "/~",
        "/api//hello",
        "//api/hello",
        "/api/%68ello",
        "/;/api/hello",
        "/index.html.",
        "/..;/",
        "/%c0%ae%c0%ae/etc/passwd",
    ] {
        let answer = get(server.address(), path);
        assert!([400, 404].contains(&answer.status), "{path}: {answer:?}");
        assert!(!answer.body.contains("root:"), "{path}");
    }
    for target in ["*", "../../etc/passwd", "file:///etc/passwd", "http://evil.example/", "\\etc"] {
        assert_eq!(get(server.address(), target).status, 400, "{target}");
    }
    let answer = get(server.address(), "/api/scene?world=../../etc/passwd");
    assert_eq!(answer.status, 400);
}

#[test]
fn foreign_names_and_pages_are_refused() {
    let server = server();
    let address = server.address();
    let by_name = |host: &str| {
        let text = format!("GET /api/hello HTTP/1.1\r\n{host}Connection: close\r\n\r\n");
        send(address, text.as_bytes()).unwrap().status
    };
    assert_eq!(by_name(&format!("Host: localhost:{}\r\n", address.port())), 200);
    assert_eq!(by_name(&format!("Host: evil.example:{}\r\n", address.port())), 403);
    assert_eq!(by_name("Host: 127.0.0.1\r\n"), 403);
    assert_eq!(by_name(""), 403);
    let line = "GET /api/hello";
    assert_eq!(with(address, line, &format!("Origin: http://{address}\r\n")).status, 200);
    for foreign in ["Origin: http://evil.example", "Origin: null", "Sec-Fetch-Site: cross-site"] {
        let answer = with(address, line, &format!("{foreign}\r\n"));
        assert_eq!(answer.status, 403, "{foreign}");
        assert!(answer.body.starts_with("{\"error\":"), "{answer:?}");
    }
    let stop = request(address, "POST /api/control", "Origin: http://evil.example\r\n", "{}");
    assert_eq!(send(address, &stop).unwrap().status, 403);
}

#[test]
fn every_response_is_protected() {
    let server = server();
    let address = server.address();
    let foreign = with(address, "GET /", "Origin: null\r\n");
    let ours = ["/", "/api/hello", "/api/scene?world=0", "/nothing", "/favicon.ico"];
    for answer in ours.map(|target| get(address, target)).into_iter().chain([foreign]) {
        for (name, value) in [
            ("x-content-type-options", "nosniff"),
            ("referrer-policy", "no-referrer"),
            ("cross-origin-resource-policy", "same-origin"),
            ("cache-control", "no-store"),
        ] {
            assert_eq!(answer.header(name), value, "{name}: {answer:?}");
        }
        let policy = answer.header("content-security-policy");
        assert!(policy.starts_with("default-src 'none'"), "{answer:?}");
        assert!(policy.contains("frame-ancestors 'none'"), "{answer:?}");
    }
}

#[test]
fn the_token_is_asked_for_everywhere() {
    let settings = Settings { token: Some(TOKEN.to_owned()), ..Settings::default() };
    let fake = Arc::<crate::fake::Fake>::default();
    let server = serve(settings, &Page { html: PAGE.into() }, fake, Feed::new()).unwrap();
    let address = server.address();
    assert_eq!(server.url(), format!("http://{address}/?token={TOKEN}"));
    for path in ["/", "/api/hello", "/api/events", "/nothing", "/favicon.ico"] {
        let answer = get(address, path);
        assert_eq!((answer.status, answer.header("www-authenticate")), (401, "Bearer"), "{path}");
    }
    for wrong in ["", "0123456789abcdeX", "0123456789abcdef0", "%30123456789abcdef"] {
        assert_eq!(get(address, &format!("/?token={wrong}")).status, 401, "{wrong}");
    }
    assert_eq!(get(address, &format!("/?token={TOKEN}")).status, 200);
    assert_eq!(get(address, &format!("/api/scene?world=1&token={TOKEN}")).status, 200);
    let bearer = format!("Authorization: Bearer {TOKEN}\r\n");
    assert_eq!(with(address, "GET /api/hello", &bearer).status, 200);
}

#[test]
fn large_requests_are_refused() {
    let server = server();
    let address = server.address();
    assert_eq!(post(address, "/api/read", &" ".repeat(64 * 1024)).status, 400);
    assert_eq!(post(address, "/api/read", &" ".repeat(64 * 1024 + 1)).status, 413);
    let chunk = format!("{:x}\r\n{}\r\n", 8000, " ".repeat(8000)).repeat(9);
    let chunked = format!(
        "POST /api/control HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\
         Transfer-Encoding: chunked\r\n\r\n{chunk}0\r\n\r\n"
    );
    assert_eq!(send(address, chunked.as_bytes()).unwrap().status, 413);
    let promised = format!(
        "POST /api/read HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\
         Content-Length: 999999999999\r\n\r\n"
    );
    assert_eq!(send(address, promised.as_bytes()).unwrap().status, 413);
    let long = format!("X: {}\r\n", "x".repeat(20_000));
    assert_eq!(with(address, "GET /", &long).status, 431);
    let many = "X: x\r\n".repeat(100);
    assert_eq!(with(address, "GET /", &many).status, 431);
    let target = format!("/{}", "a".repeat(20_000));
    assert!([414, 431].contains(&get(address, &target).status));
    assert_eq!(get(address, "/api/hello").status, 200);
}
