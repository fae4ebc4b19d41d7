//! Errors as programs and terminals get them.

use crate::ran::{Home, Ran};

/// A command with what it takes from its environment.
fn run_with(home: &Home, arguments: &[&str], environment: &[(&str, &str)]) -> Ran {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_isolux"));
    for name in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
        command.env_remove(name);
    }
    command.args(arguments).current_dir(home.path("")).envs(environment.iter().copied());
    Ran::of(&command.output().unwrap())
}

/// Arguments, words of the message, the file and the beginning of the place that it names.
type Case = (&'static [&'static str], &'static str, Option<&'static str>, Option<&'static str>);

#[test]
fn with_json_every_error_is_an_object_on_standard_output() {
    let home = Home::new();
    home.file("bad.pts", "0 0 0 0 0 1\n1 2 3\n1 2\n");
    home.file("text.toml", "name = 3\n");
    let cases: [Case; 7] = [
        (
            &["solve", "missing.glb", "-o", "m.glb", "--json"],
            "does not exist",
            Some("missing.glb"),
            None,
        ),
        (&["--json", "check", "text.toml"], "text.toml", Some("text.toml"), Some("line 1")),
        (
            &["probe", "builtin:cube", "--points", "bad.pts", "--json"],
            "bad.pts: line 2",
            Some("bad.pts"),
            Some("line 2"),
        ),
        (&["solve", "builtin:cube", "--json"], "--output", None, None),
        (&["solve", "builtin:cube", "-o", "m.glb", "--accuracy", "7", "--json"], "1%", None, None),
        (&["paint", "--json"], "paint", None, None),
        (&["--json"], "subcommand", None, None),
    ];
    for (arguments, words, file, place) in cases {
        let ran = run_with(&home, arguments, &[]);
        assert_eq!(ran.code, 2, "{arguments:?}: {ran:?}");
        let error = ran.json()["error"].clone();
        assert!(error["message"].as_str().unwrap().contains(words), "{arguments:?}: {error}");
        assert_eq!(error["file"].as_str(), file, "{arguments:?}");
        if let Some(place) = place {
            assert!(error["place"].as_str().unwrap().starts_with(place), "{error}");
        }
        assert!(!error["remedy"].as_str().unwrap().is_empty(), "{arguments:?}: {error}");
        assert_eq!(error["exit_code"], 2, "{arguments:?}");
        assert!(!ran.err.is_empty(), "people read standard error: {arguments:?}");
    }
    let points = run_with(&home, &["probe", "builtin:cube", "--points", "bad.pts", "--json"], &[]);
    assert_eq!(points.json()["error"]["problems"].as_array().map(Vec::len), Some(2));
    let refused = run_with(
        &home,
        &["solve", "builtin:cube", "-o", "m.glb", "--max-memory", "1KiB", "--json"],
        &[],
    );
    assert_eq!((refused.code, &refused.json()["error"]["exit_code"]), (4, &4.into()));
    assert_eq!(run_with(&home, &["--json", "solve", "--help"], &[]).code, 0);
}

#[test]
fn errors_have_colour_where_it_is_wanted() {
    let home = Home::new();
    let err = |environment: &[(&str, &str)]| {
        run_with(&home, &["solve", "missing.glb", "-o", "m.glb"], environment).err
    };
    let plain = err(&[]);
    assert!(plain.starts_with("error: missing.glb: does not exist"), "{plain:?}");
    assert_eq!(err(&[("NO_COLOR", "1")]), plain);
    let coloured = err(&[("CLICOLOR_FORCE", "1")]);
    assert!(coloured.starts_with("\u{1b}[") && coloured.contains("error:"), "{coloured:?}");
    // The arguments, too.
    let wrong = run_with(&home, &["solve"], &[("CLICOLOR_FORCE", "1")]).err;
    assert!(wrong.contains('\u{1b}'), "{wrong:?}");
}

#[test]
fn a_missing_view_file_is_the_file_of_the_error() {
    let home = Home::new();
    for flag in [&["--vf", "missing.vf"][..], &["--vf=missing.vf"], &["-vf", "missing.vf"]] {
        let words = [&["render", "builtin:hall", "-o", "v.png", "--json"], flag].concat();
        let ran = home.run(&words);
        let error = &ran.json()["error"];
        assert_eq!((ran.code, &error["file"]), (2, &"missing.vf".into()), "{error}");
        assert!(!ran.err.contains("solved"), "{ran:?}");
    }
    home.file("bad.vf", "rvu -vtv -vo 2\n");
    let ran = home.run(&["render", "builtin:hall", "-o", "v.png", "--vf", "bad.vf", "--json"]);
    let error = &ran.json()["error"];
    assert_eq!((&error["file"], &error["remedy"]), (&"bad.vf".into(), &"leave it out".into()));
}

#[test]
fn names_of_files_act_on_no_terminal() {
    let home = Home::new();
    let name = r"lamp\u202egpj.\u001b[31m";
    let scene = format!(
        "name = \"{name}\"\n[materials.\"{name}\"]\ndiffuse = 0.5\n\
         [[geometry]]\nname = \"{name}\"\nmaterial = \"{name}\"\nbox = {{ min = [0, 0, 0], max = [4, 4, 3], inward = true }}\n\
         [[luminaire]]\nname = \"{name}\"\nposition = [2, 2, 5]\nisotropic = {{ flux_lm = 1000 }}\n\
         [[camera]]\nname = \"{name}\"\nposition = [1, 1, 1]\ntarget = [3, 3, 1]\n"
    );
    home.file("named.toml", scene);
    for words in [
        &["info", "named.toml"][..],
        &["info", "named.toml", "--json"],
        &["check", "named.toml"],
        &["check", "named.toml", "--json"],
        &["render", "named.toml", "-o", "v.png", "--camera", "x"],
        &["solve", "named.toml", "-o", "m.glb", "--accuracy", "20%", "--progress", "json"],
    ] {
        let ran = home.run(words);
        for text in [&ran.out, &ran.err] {
            assert!(!text.contains(['\u{202e}', '\u{1b}']), "{words:?}: {text:?}");
        }
    }
    let info = home.run(&["info", "named.toml", "--json"]);
    assert_eq!(info.json()["cameras"][0], "lamp\u{202e}gpj.\u{1b}[31m");
}

#[cfg(unix)]
#[test]
fn a_file_that_may_not_grow_is_told_and_leaves_nothing() {
    let home = Home::new();
    let words = ["solve", "builtin:cube", "--accuracy", "20%", "-o", "m.glb"];
    let mut command = std::process::Command::new("sh");
    command.args(["-c", "ulimit -f 2; exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_isolux")]);
    let ran = Ran::of(&command.args(words).current_dir(home.path("")).output().unwrap());
    assert_eq!(ran.code, 4, "{ran:?}");
    assert!(ran.err.contains("m.glb: cannot be written: "), "{}", ran.err);
    assert_eq!(home.names(), Vec::<String>::new());
}
