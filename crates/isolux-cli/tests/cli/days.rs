//! Accuracies that a day does not reach.

use crate::ran::Home;

/// By particles on a few elements: noise falls slowly, and is known in seconds.
const SOLVE: [&str; 10] = [
    "solve",
    "builtin:cube",
    "-o",
    "m.glb",
    "--method",
    "forward",
    "--max-memory",
    "5MB",
    "--accuracy",
    "0.001%",
];

#[test]
fn a_run_of_more_than_a_day_ends_and_says_what_is_reachable() {
    let home = Home::new();
    let ran = home.run(&SOLVE);
    assert_eq!(ran.code, 3, "{ran:?}");
    for words in ["cannot be reached in a day", "in an hour", "--resume", "--time-limit 72h"] {
        assert!(ran.err.contains(words), "{words}: {}", ran.err);
    }
    assert_eq!(home.names(), ["m.checkpoint", "m.checkpoint.pilot", "m.glb"]);
    let increments = |home: &Home| {
        home.run(&["info", "m.glb", "--json"]).json()["provenance"]["increments"].as_u64().unwrap()
    };
    let before = increments(&home);
    // Whoever gives a limit gets that time.
    let limited = home.run(&[&SOLVE[..], &["--resume", "--time-limit", "2s"]].concat());
    assert!(limited.code == 3 && !limited.err.contains("cannot be reached"), "{limited:?}");
    assert!(increments(&home) > before, "{before}");
}
