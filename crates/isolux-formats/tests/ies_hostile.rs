//! Files that are not what they say: each is refused with one message and its place.

use isolux_formats::{Problem, ies};
use std::path::Path;

const GOOD: &str = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 2 1 2 0.1 0.1 0\n1 1 20\n0 45 90\n0 90\n\
                    300 200 100\n300 150 50\n";

fn refusal(bytes: &[u8]) -> Option<String> {
    let refuse = &mut |name: &str| Err(Problem::new(Path::new(name), "", "not here", "none"));
    match ies::parse(bytes, Path::new("lamp.ies"), refuse) {
        Err(problems) => Some(problems.to_string()),
        Ok(loaded) => loaded.value.resolve().err().map(|problem| problem.to_string()),
    }
}

#[test]
fn the_file_all_others_are_spoilt_from_is_good() {
    assert_eq!(refusal(GOOD.as_bytes()), None);
}

/// The good file with one thing changed.
fn spoilt(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from}");
    GOOD.replacen(from, to, 1)
}

/// Each text must be refused in one line that names the place and says what is wrong.
fn check<const N: usize>(table: [(String, &str, &str); N]) {
    for (text, place, what) in table {
        let Some(found) = refusal(text.as_bytes()) else { panic!("accepted: {text}") };
        assert!(found.contains(place), "no {place:?} in {found:?}");
        assert!(found.contains(what), "no {what:?} in {found:?}");
        assert_eq!(found.lines().count(), 1, "{found}");
    }
}

#[test]
fn what_is_no_photometric_file_is_refused() {
    check([
        (String::new(), "lamp.ies", "is empty"),
        ("\n\n\n".into(), "lamp.ies", "is empty"),
        ("IESNA91\n[TEST] 1\nTIL".into(), "line 3", "the file ends before its TILT= line"),
        ("PNG\0\u{1}\u{2}".into(), "lamp.ies", "is not plain text"),
        ("<html>not found</html>".into(), "line 1", "there is no TILT= line"),
    ]);
}

#[test]
fn what_is_cut_short_or_too_long_is_refused() {
    check([
        ("IESNA91\nTILT=NONE".into(), "line 1", "the number of lamps should follow"),
        (spoilt("300 150 50\n", ""), "line 7", "the intensity at 0 degrees vertically, 90 horiz"),
        (spoilt(" 50\n", ""), "line 8", "the intensity at 90 degrees vertically, 90 horiz"),
        (spoilt(" 50\n", " 50 7\n"), "line 8, column 12", "numbers follow after the last"),
        (spoilt("300 150 50\n", "300,0 150,0 50,0\n"), "line 8, column 11", "numbers follow"),
    ]);
}

/// The first seven numbers of the lamp record.
const COUNTS: &str = "1 -1 1 3 2 1 2";

#[test]
fn counts_are_not_believed() {
    check([
        (spoilt(COUNTS, "1 -1 1 4000000000 2 1 2"), "line 3, column 8", "vertical angles is 40000"),
        (spoilt(COUNTS, "1 -1 1 1000000 1000000 1 2"), "line 3, column 16", "horizontal angles is"),
        (spoilt(COUNTS, "1 -1 1 1e300 2 1 2"), "line 3, column 8", "must be a whole number"),
        (spoilt(COUNTS, "1 -1 1 2.5 2 1 2"), "line 3, column 8", "is 2.5, but must be a whole"),
        (spoilt(COUNTS, "1 -1 1 -3 2 1 2"), "line 3, column 8", "is -3, but must be a whole"),
        (spoilt(COUNTS, "1 -1 1 1 2 1 2"), "line 3, column 8", "must be a whole number from 2"),
        (spoilt(COUNTS, "1 -1 1 3 0 1 2"), "line 3, column 10", "must be a whole number from 1"),
        (spoilt(COUNTS, "1 -1 1 3 1000 1 2"), "line 7, column 5", "horizontal angle 4 of 1000"),
        (spoilt(COUNTS, "x -1 1 3 2 1 2"), "line 3, column 1", "\"x\" is not a number"),
    ]);
}

#[test]
fn types_units_and_factors_are_checked() {
    check([
        (spoilt(COUNTS, "1 -1 1 3 2 4 2"), "line 3, column 12", "photometric type is 4"),
        (spoilt(COUNTS, "1 -1 1 3 1 2 2"), "line 7", "numbers follow after the last intensity"),
        (spoilt(COUNTS, "1 -1 1 3 2 1 3"), "line 3, column 14", "unit of length is 3"),
        (spoilt(COUNTS, "1 -5 1 3 2 1 2"), "line 3, column 3", "flux of a lamp is -5"),
        (
            spoilt(COUNTS, "1 -1 0 3 2 1 2"),
            "line 3, column 6",
            "multiplier of the intensities is 0",
        ),
        (spoilt(COUNTS, "1 -1 -1 3 2 1 2"), "line 3, column 6", "multiplier"),
        (spoilt(COUNTS, "1 -1 nan 3 2 1 2"), "line 3, column 6", "\"nan\" is not a number"),
        (spoilt(COUNTS, "1 -1 inf 3 2 1 2"), "line 3, column 6", "\"inf\" is not a number"),
        (spoilt(COUNTS, "1 -1 1e999 3 2 1 2"), "line 3, column 6", "\"1e999\" is not a number"),
        (spoilt("\n1 1 20", "\n-1 1 20"), "line 4, column 1", "the ballast factor is -1"),
        (spoilt("0.1 0.1 0", "1e30 0.1 0"), "line 3, column 16", "the width of the luminous"),
    ]);
}

#[test]
fn angles_must_increase_within_their_range() {
    check([
        (spoilt("0 45 90", "0 45 45"), "line 5, column 6", "is 45, not above 45 before it"),
        (spoilt("0 45 90", "90 45 0"), "line 5, column 4", "is 45, not above 90"),
        (spoilt("0 45 90", "0 45 181"), "line 5, column 6", "within 0 and 180 degrees"),
        (spoilt("0 45 90", "-90 0 90"), "line 5, column 1", "within 0 and 180 degrees"),
        (spoilt("0 45 90", "0 45 1e9"), "line 5, column 6", "within 0 and 180 degrees"),
        (spoilt("0 45 90", "0 45 45.0000001"), "line 5", "not larger than the one before"),
        (spoilt("\n0 90\n", "\n0 361\n"), "line 6, column 3", "within 0 and 360 degrees"),
        (spoilt("\n0 90\n", "\n0 75\n"), "line 6", "from 0 to 75 degrees cover no known part"),
        (spoilt("\n0 90\n", "\n10 90\n"), "line 6", "from 10 to 90 degrees cover no known part"),
    ]);
}

#[test]
fn intensities_are_numbers_of_zero_or_more() {
    let endless = format!(" {}", "x9".repeat(1000));
    check([
        (
            spoilt(" 200", " -200"),
            "line 7, column 5",
            "intensity at 45 degrees vertically, 0 horiz",
        ),
        (spoilt(" 200", " 1e16"), "line 7, column 5", "from 0 to 1e15"),
        (spoilt(" 200", " 2OO"), "line 7, column 5", "\"2OO\" is not a number"),
        (spoilt(" 200", &endless), "line 7, column 5", "x9x9x9x9x…\" is not a number"),
    ]);
}

#[test]
fn tilt_tables_are_checked() {
    check([
        (spoilt("NONE", "INCLUDE\n4 2 0 90 1 1"), "line 3, column 1", "geometry is 4"),
        (spoilt("NONE", "INCLUDE\n1 9999999 0"), "line 3, column 3", "number of tilt angles"),
        (spoilt("NONE", "INCLUDE\n1 2 90 0 1 1"), "line 3, column 8", "tilt angle 2 of 2 is 0"),
        (spoilt("NONE", "INCLUDE\n1 2 0 90 1 -1"), "line 3, column 12", "tilt factor 2 of 2 is -1"),
        (spoilt("NONE", ""), "line 2", "TILT= names no file"),
        (spoilt("NONE", "other.tlt"), "other.tlt", "not here"),
    ]);
}

#[test]
fn a_directory_and_an_absent_file_are_told_apart_from_bad_ones() {
    for (path, what) in [
        (env!("CARGO_TARGET_TMPDIR"), "not a regular file"),
        ("/no/such/lamp.ies", "does not exist"),
    ] {
        let found = ies::read(Path::new(path)).unwrap_err().to_string();
        assert!(found.contains(what), "{found}");
    }
}

/// Every file cut at every byte, and with every byte changed to a few others, is read or refused;
/// none panics, and none that is read has a flux that is not a number.
#[test]
fn cut_and_changed_files_are_read_or_refused() {
    let tilted = GOOD.replace("NONE", "INCLUDE\n1 2\n0 90 1 0.5");
    let check = |bytes: &[u8]| {
        let refuse = &mut |name: &str| Err(Problem::new(Path::new(name), "", "no", "none"));
        let Ok(loaded) = ies::parse(bytes, Path::new("lamp.ies"), refuse) else { return };
        if let Ok(distribution) = loaded.value.resolve() {
            let flux = distribution.luminous_flux_lm();
            assert!(flux >= 0.0 && flux.is_finite(), "{flux}");
            let _ = distribution.sample([0.3, 0.7]);
        }
    };
    for text in [GOOD, &tilted] {
        for at in 0..text.len() {
            check(&text.as_bytes()[..at]);
            for byte in [b'0', b'9', b'-', b'.', b'e', b' ', b'\n', b'[', 0, 0x1a, 0xff, b'='] {
                let mut bytes = text.as_bytes().to_vec();
                bytes[at] = byte;
                check(&bytes);
            }
        }
    }
}
