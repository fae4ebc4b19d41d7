//! Scenes of several files, and messages about where files are.

use crate::ran::Home;

const MATERIALS: &str = "void plastic paint 0 0 5 .5 .5 .5 0 0\nvoid light lamp 0 0 3 20 20 20\n";
const ROOM: &str = "!genbox paint walls 4 3 2.5 -i\n\
                    lamp polygon panel 0 0 12  1 1 2.4  1 2 2.4  2 2 2.4  2 1 2.4\n";

#[test]
fn radiance_files_are_read_together_as_oconv_reads_them() {
    let home = Home::new();
    home.file("materials.rad", MATERIALS);
    home.file("room.rad", ROOM);
    let both = ["materials.rad", "room.rad"];
    let run = |before: &[&str], after: &[&str]| home.run(&[before, &both, after].concat());
    let solved = run(&["solve"], &["-o", "map.glb", "--accuracy", "10%"]);
    assert_eq!(solved.code, 0, "{solved:?}");
    for (before, after) in [
        (&["check"][..], &[][..]),
        (&["info"], &[]),
        (&["render"], &["-o", "room.png", "--size", "32x18", "--accuracy", "20%"]),
    ] {
        let ran = run(before, after);
        assert_eq!(ran.code, 0, "{ran:?}");
    }
    for (words, told) in [
        (&["solve", "room.rad", "-o", "m.glb"][..], "`paint` is not defined before it is used"),
        (&["solve", "room.rad", "materials.rad", "-o", "m.glb"], "is not defined before"),
        (&["check", "materials.rad", "gone.rad"], "gone.rad: does not exist"),
        (&["info", "map.glb", "room.rad"], "map.glb: is no Radiance file"),
        (&["render", "builtin:cube", "room.rad", "-o", "v.png"], "is no Radiance file"),
    ] {
        let ran = home.run(words);
        assert!(ran.code == 2 && ran.err.contains(told), "{words:?}: {ran:?}");
        assert!(!ran.err.contains("materials.rad: is no"), "{ran:?}");
    }
}

/// Regression: the message said that there is no directory, and left out why.
#[test]
fn a_file_where_a_directory_is_to_be_is_named() {
    let home = Home::new();
    home.file("file", "");
    let ran = home.run(&["render", "builtin:cube", "-o", "file/x.png"]);
    assert!(ran.code == 2 && ran.err.contains("`file` is a file, not a directory"), "{ran:?}");
}
