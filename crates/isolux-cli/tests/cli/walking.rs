//! Walk-throughs: what is served of a map and of a run, and the file that opens from a disk.

use crate::ran::Home;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command};

/// A command that serves a page.
struct Serving {
    child: Child,
    /// `127.0.0.1:PORT`.
    host: String,
}

impl Serving {
    /// Starts a command and waits until it tells its address, on standard output or in a note.
    fn start(home: &Home, arguments: &[&str]) -> Self {
        let mut child = home.start(arguments);
        let out: Box<dyn Read + Send> = match arguments[0] {
            "view" => Box::new(child.stdout.take().unwrap()),
            _ => Box::new(child.stderr.take().unwrap()),
        };
        let mut lines = BufReader::new(out).lines().map(Result::unwrap);
        let address = lines.find_map(|line| line.split_once("http://").map(|(_, a)| a.to_owned()));
        let address = address.unwrap();
        let host = address.split('/').next().unwrap().to_owned();
        // Who closes the pipe ends a command that still writes to it.
        std::thread::spawn(move || lines.for_each(drop));
        Self { child, host }
    }

    /// Status and body of an answer.
    fn ask(&self, method: &str, target: &str, body: &str) -> (u16, Vec<u8>) {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        let (host, length) = (&self.host, body.len());
        let head = format!(
            "{method} {target} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\
             Content-Type: application/json\r\nContent-Length: {length}\r\n\r\n{body}"
        );
        stream.write_all(head.as_bytes()).unwrap();
        let mut all = Vec::new();
        stream.read_to_end(&mut all).unwrap();
        let end = all.windows(4).position(|four| four == b"\r\n\r\n").unwrap();
        let status = std::str::from_utf8(&all[9..12]).unwrap().parse().unwrap();
        (status, all[end + 4..].to_vec())
    }

    fn json(&self, method: &str, target: &str, body: &Value) -> Value {
        let (status, answer) = self.ask(method, target, &body.to_string());
        assert_eq!(status, 200, "{}", String::from_utf8_lossy(&answer));
        serde_json::from_slice(&answer).unwrap()
    }

    /// States as they come, for as long as somebody looks at them.
    fn states(&self) -> impl Iterator<Item = Value> + use<> {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        let head = format!("GET /api/events HTTP/1.1\r\nHost: {}\r\n\r\n", self.host);
        stream.write_all(head.as_bytes()).unwrap();
        let lines = BufReader::new(stream).lines().map(Result::unwrap);
        let state = |line: String| serde_json::from_str(line.strip_prefix("data: ")?).ok();
        lines.filter_map(state).filter(Value::is_object)
    }

    /// Interrupts it; its exit code.
    fn end(mut self) -> i32 {
        let id = self.child.id().to_string();
        assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
        self.child.wait().unwrap().code().unwrap()
    }
}

fn solved(home: &Home) {
    let ran = home.run(&["solve", "builtin:cube", "-o", "cube.glb", "--accuracy", "2%"]);
    assert_eq!(ran.code, 0, "{ran:?}");
}

#[test]
fn what_is_under_the_pointer_is_what_probe_says() {
    let home = Home::new();
    solved(&home);
    let serving = Serving::start(&home, &["view", "cube.glb", "--no-open"]);
    let hello = serving.json("GET", "/api/hello", &json!({}));
    assert_eq!((&hello["live"], &hello["readings"]), (&json!(false), &json!("probe")));
    let rays = json!([
        { "origin": [0.0, 0.0, 0.0], "direction": [0.3, -0.2, -1.0] },
        { "origin": [0.0, 0.0, 0.0], "direction": [1.0, 0.7, 0.999] },
        { "origin": [0.0, 20.0, 0.0], "direction": [0.0, 1.0, 0.0] },
    ]);
    let answer = serving.json("POST", "/api/read", &json!({ "world": 0, "rays": rays }));
    let readings = answer["readings"].as_array().unwrap();
    assert!(readings[2]["position"].is_null() && readings[2]["illuminance_lx"].is_null());
    for reading in &readings[..2] {
        let numbers = |name: &str| {
            let all = reading[name].as_array().unwrap().iter();
            all.map(|n| n.to_string()).collect::<Vec<_>>().join(" ")
        };
        let line = format!("{} {}\n", numbers("position"), numbers("normal"));
        home.file("p.pts", line);
        let said = home.run(&["probe", "cube.glb", "--points", "p.pts", "--json"]).json();
        for name in ["illuminance_lx", "standard_error_lx", "direct_lx", "indirect_lx", "rgb_lx"] {
            assert_eq!(reading[name], said["points"][0][name], "{name}");
        }
        assert_eq!(reading["found"], "probe");
    }
    assert_eq!(serving.ask("GET", "/../cube.glb", "").0, 404);
    assert_eq!(serving.ask("POST", "/api/control", r#"{"action":"stop"}"#).0, 409);
    assert_eq!(serving.end(), 0);
}

const ROOM: &str = r#"
name = "room"
[materials.paint]
diffuse = 0.6
[[geometry]]
name = "room"
box = { min = [0, 0, 0], max = [4, 5, 2.8], inward = true }
material = "paint"
[[luminaire]]
position = [1, 2.5, 2.5]
spot = { peak_cd = 900, inner_deg = 30, outer_deg = 60 }
group = "left"
[[luminaire]]
position = [3, 2.5, 2.5]
spot = { peak_cd = 400, inner_deg = 30, outer_deg = 60 }
group = "right"
"#;

#[test]
fn what_is_read_in_dimmed_light_is_what_mix_makes() {
    let home = Home::new();
    home.file("room.toml", ROOM);
    let ran = home.run(&["solve", "room.toml", "-o", "room.glb", "--accuracy", "4%", "--group"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let serving = Serving::start(&home, &["view", "room.glb", "--no-open"]);
    let ray = json!({ "origin": [2.0, 2.0, 1.0], "direction": [0.1, 0.2, -1.0] });
    let asked = json!({ "world": 0, "rays": [ray], "dimming": [0.3, 1.0] });
    let reading = &serving.json("POST", "/api/read", &asked)["readings"][0];
    let mixed = home.run(&["mix", "room.glb", "--dim", "left=30%", "-o", "evening.glb"]);
    assert_eq!(mixed.code, 0, "{mixed:?}");
    let place = reading["position"].as_array().unwrap().iter().map(Value::to_string);
    home.file("p.pts", format!("{} 0 0 1\n", place.collect::<Vec<_>>().join(" ")));
    let said = home.run(&["probe", "evening.glb", "--points", "p.pts", "--json"]).json();
    for name in ["illuminance_lx", "standard_error_lx"] {
        assert_eq!(reading[name], said["points"][0][name], "{name}");
    }
    let dark = json!({ "world": 0, "rays": [ray], "dimming": [0.0, 0.0] });
    assert_eq!(serving.ask("POST", "/api/read", &dark.to_string()).0, 409);
    let wrong = json!({ "world": 0, "rays": [ray], "dimming": [-1.0, 0.0] });
    assert_eq!(serving.ask("POST", "/api/read", &wrong.to_string()).0, 400);
    assert_eq!(serving.end(), 0);
}

#[test]
fn a_run_that_is_watched_paused_and_aimed_anew_has_the_bits_of_one_that_is_not() {
    let home = Home::new();
    let alone = home.run(&["solve", "builtin:cube", "-o", "alone.glb", "--accuracy", "0.2%"]);
    assert_eq!(alone.code, 0, "{alone:?}");
    let asked = [
        "solve",
        "builtin:cube",
        "-o",
        "watched.glb",
        "--accuracy",
        "0.01%",
        "--live",
        "--no-open",
    ];
    let mut serving = Serving::start(&home, &asked);
    let mut states = serving.states();
    let control = |what: Value| serving.ask("POST", "/api/control", &what.to_string()).0;
    assert_eq!(control(json!({ "action": "pause" })), 204);
    let paused = states.find(|state| state["paused"] == true).unwrap();
    assert_ne!(paused["phase"], "done");
    assert_eq!(control(json!({ "action": "target", "accuracy": "fine" })), 400);
    assert_eq!(control(json!({ "action": "target", "accuracy": 0.002 })), 204);
    let done = states.find(|state| state["phase"] == "done").unwrap();
    assert_eq!((&done["target"], &done["saved"]), (&json!(0.002), &json!("watched.glb")));
    assert!(done["error"].as_f64().unwrap() <= 0.002, "{done}");
    let (mesh, light) = (done["mesh"].as_u64().unwrap(), done["light"].as_u64().unwrap());
    let light_of = |since: u64| {
        serving.ask("GET", &format!("/api/light?world=0&mesh={mesh}&since={since}"), "").1.len()
    };
    assert!(mesh > 0 && light > 0 && light_of(light) < light_of(0));
    // Nobody looks any more.
    drop(states);
    assert_eq!(serving.child.wait().unwrap().code(), Some(0));
    let bytes = |name: &str| std::fs::read(home.path(name)).unwrap();
    assert!(bytes("alone.glb") == bytes("watched.glb"));
}

#[test]
fn a_viewer_can_stop_a_run_and_its_map_is_saved() {
    let home = Home::new();
    let asked =
        ["solve", "builtin:cube", "-o", "m.glb", "--accuracy", "0.01%", "--live", "--no-open"];
    let mut serving = Serving::start(&home, &asked);
    serving.states().find(|state| state["increments"].as_u64() > Some(0)).unwrap();
    assert_eq!(serving.ask("POST", "/api/control", r#"{"action":"stop"}"#).0, 204);
    assert_eq!(serving.child.wait().unwrap().code(), Some(130));
    assert_eq!(home.run(&["info", "m.glb"]).code, 0);
}

#[test]
fn a_walk_through_is_one_file() {
    let home = Home::new();
    solved(&home);
    let ran = home.run(&["export", "cube.glb", "-o", "cube.html", "--finer", "1s", "--json"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let page = std::fs::read_to_string(home.path("cube.html")).unwrap();
    assert_eq!(ran.json()["bytes"], page.len());
    for name in ["hello", "scene-0", "mesh-0", "light-0", "grids-0"] {
        assert!(page.contains(&format!("<script id=\"isolux-{name}\"")), "{name}");
    }
    let two = home.run(&["export", "cube.glb", "-o", "two.html", "--beside", "cube.glb"]);
    assert_eq!(two.code, 0, "{two:?}");
    assert!(std::fs::read_to_string(home.path("two.html")).unwrap().contains("isolux-light-1"));
}

#[test]
fn what_cannot_be_shown_is_refused_with_a_reason() {
    let home = Home::new();
    solved(&home);
    home.file("text.glb", "no map");
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let cases: [(&[&str], &str); 9] = [
        (&["view", "none.glb", "--no-open"], "none.glb"),
        (&["view", "text.glb", "--no-open"], "text.glb"),
        (&["view", "builtin:cube", "--no-open"], "solve it first"),
        (&["view", "cube.glb", "none.glb", "--no-open"], "none.glb"),
        (&["view", "cube.glb", "--no-open", "--port", &port], "--port"),
        (&["view", "cube.glb", "--no-open", "--address", "203.0.113.7"], "203.0.113.7"),
        (&["export", "cube.glb", "-o", "cube.wrl", "--beside", "cube.glb"], "--beside"),
        (&["export", "cube.glb", "-o", "no/cube.html"], "no/cube.html"),
        (&["solve", "builtin:cube", "-o", "x.glb", "--live", "--dry-run"], "--dry-run"),
    ];
    for (arguments, said) in cases {
        let ran = home.run(arguments);
        assert!(ran.code == 2 && ran.err.contains(said), "{arguments:?}: {ran:?}");
    }
    assert_eq!(home.names(), ["cube.glb", "text.glb"]);
}
