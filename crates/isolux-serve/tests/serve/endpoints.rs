//! What is found where.

use crate::client::{get, post, question, request, send};
use crate::fake::{FAILING, Fake, PANICKING, served, server};
use isolux_serve::{Control, Feed, Limits};
use std::sync::Arc;
use std::sync::atomic::Ordering;

#[test]
fn the_page_may_run_its_own_scripts_only() {
    let server = server();
    for target in ["/", "/index.html", "/?world=1"] {
        let answer = get(server.address(), target);
        assert_eq!(
            (answer.status, answer.header("content-type")),
            (200, "text/html; charset=utf-8")
        );
        let policy = answer.header("content-security-policy");
        let word = policy.split("'nonce-").nth(1).unwrap().split('\'').next().unwrap();
        assert_eq!(answer.body, format!("<!doctype html><script nonce=\"{word}\">walk()</script>"));
        assert!(policy.starts_with("default-src 'none'; ") && policy.contains("worker-src blob:"));
    }
}

#[test]
fn what_is_fetched() {
    let server = server();
    for (target, status, kind, body) in [
        ("/favicon.ico", 204, "", ""),
        ("/api/hello", 200, "application/json", r#"{"live":true}"#),
        ("/api/scene?world=0", 200, "application/octet-stream", "scene 0"),
        ("/api/scene?world=1", 200, "application/octet-stream", "scene 1"),
        ("/api/mesh?world=0", 200, "application/octet-stream", "mesh 0"),
        ("/api/light?world=1&mesh=1&since=5", 200, "application/octet-stream", "light 1 since 5"),
        ("/api/grids?world=0", 200, "application/json", "[]"),
    ] {
        let answer = get(server.address(), target);
        assert_eq!((answer.status, answer.header("content-type")), (status, kind), "{target}");
        assert_eq!(answer.body, body, "{target}");
    }
}

#[test]
fn what_is_not_there() {
    let server = server();
    for (target, status, word) in [
        ("/api/scene?world=2", 404, "world"),
        ("/api/scene?world=18446744073709551615", 404, "world"),
        ("/api/grids?world=2", 404, "world"),
        ("/api/light?world=2&mesh=1&since=0", 404, "world"),
        ("/api/mesh?world=1", 409, "not there"),
        ("/api/light?world=0&mesh=2&since=0", 409, "not there"),
        ("/api/grids?world=1", 409, "no grids"),
        ("/api/scene", 400, "`world`"),
        ("/api/scene?world=-1", 400, "`world`"),
        ("/api/light?world=0&mesh=1", 400, "`since`"),
        ("/api/light?world=0&since=1", 400, "`mesh`"),
        ("/api", 404, "nothing"),
        ("/api/hello/", 404, "nothing"),
        ("/API/hello", 404, "nothing"),
    ] {
        let answer = get(server.address(), target);
        assert_eq!(answer.status, status, "{target}");
        assert_eq!(answer.header("content-type"), "application/json", "{target}");
        assert!(
            answer.body.starts_with("{\"error\":\"") && answer.body.contains(word),
            "{answer:?}"
        );
    }
}

#[test]
fn other_methods_are_not_allowed() {
    let server = server();
    for line in ["POST /", "HEAD /api/hello", "PUT /api/read", "GET /api/read", "GET /api/control"]
    {
        let answer = send(server.address(), &request(server.address(), line, "", "")).unwrap();
        assert_eq!(answer.status, 405, "{line}");
    }
    for line in ["OPTIONS /api/read", "DELETE /api/scene", "TRACE /", "BREW /api/hello"] {
        let answer = send(server.address(), &request(server.address(), line, "", "")).unwrap();
        assert_eq!(answer.status, 405, "{line}");
    }
}

#[test]
fn readings_are_answered() {
    let server = server();
    let answer = post(server.address(), "/api/read", &question(1.0));
    assert_eq!((answer.status, &*answer.body), (200, r#"{"readings":[1]}"#));
    let ray = r#"{"origin":[0,0,0],"direction":[0,1,0]}"#;
    let many = |n| format!("{{\"world\":1,\"rays\":[{}]}}", vec![ray; n].join(","));
    assert_eq!(post(server.address(), "/api/read", &many(256)).body, r#"{"readings":[256]}"#);
    assert_eq!(post(server.address(), "/api/read", &many(257)).status, 400);
    assert_eq!(post(server.address(), "/api/read", &many(0)).status, 400);
}

#[test]
fn readings_that_fail_say_why() {
    let server = server();
    let answer = post(server.address(), "/api/read", &question(FAILING));
    assert_eq!((answer.status, &*answer.body), (409, r#"{"error":"no surface has light yet"}"#));
    assert_eq!(post(server.address(), "/api/read", &question(PANICKING)).status, 500);
    assert_eq!(post(server.address(), "/api/read", &question(1.0)).status, 200);
    let unknown = question(1.0).replace("\"world\":0", "\"world\":9");
    assert_eq!(post(server.address(), "/api/read", &unknown).status, 404);
}

#[test]
fn malformed_questions_are_refused_with_a_message() {
    let server = server();
    let ray = |direction| question(0.0).replace("[0,0,-1]", direction);
    for body in [
        "",
        "{",
        "null",
        "[]",
        "\u{fffd}",
        "{\"world\":0}",
        "{\"world\":-1,\"rays\":[]}",
        "{\"world\":0,\"rays\":[{}]}",
        "{\"world\":0,\"rays\":[],\"more\":1}",
        &ray("[0,0,0]"),
        &ray("[0,0]"),
        &ray("[0,0,1,0]"),
        &ray("[0,0,NaN]"),
        &ray("[0,0,null]"),
        &ray("[0,0,1e999]"),
        &ray("[0,0,1e200]"),
        &ray("[0,0,1e-200]"),
        &ray("\"up\""),
        &"[".repeat(10_000),
    ] {
        let answer = post(server.address(), "/api/read", body);
        assert_eq!(answer.status, 400, "{body}");
        assert!(answer.body.starts_with("{\"error\":\"") && answer.body.len() > 30, "{answer:?}");
    }
    let answer = post(server.address(), "/api/read", &ray("[0,0,0]"));
    assert!(answer.body.contains("rays[0]"), "{answer:?}");
}

#[test]
fn runs_are_controlled() {
    let fake = Arc::new(Fake::default());
    let server = served(fake.clone(), Feed::new(), Limits::default());
    let control = |body| post(server.address(), "/api/control", body);
    let answer = control(r#"{"action":"pause"}"#);
    assert_eq!((answer.status, &*answer.body), (409, r#"{"error":"no run is under way"}"#));
    fake.live.store(true, Ordering::SeqCst);
    assert_eq!(control(r#"{"action":"resume"}"#).status, 204);
    assert_eq!(control(r#"{"action":"target","accuracy":0.02}"#).status, 204);
    for body in
        [r#"{"action":"target","accuracy":0}"#, r#"{"action":"target"}"#, r#"{"action":"a"}"#]
    {
        assert_eq!(control(body).status, 400, "{body}");
    }
    let asked = fake.asked.lock().unwrap().clone();
    assert_eq!(asked, [Control::Pause, Control::Resume, Control::Target { accuracy: 0.02 }]);
}
