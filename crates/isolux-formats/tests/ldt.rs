//! EULUMDAT files: real ones, made ones with known answers, and spoilt ones.

#![expect(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use isolux::geometry::Vector;
use isolux_formats::ldt::{self, LdtFile, LdtSymmetry};
use isolux_formats::{Loaded, Problems};
use std::path::{Path, PathBuf};

fn collection() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/photometry/photometric-viewer")
}

fn parsed(text: &str) -> Result<Loaded<LdtFile>, Problems> {
    ldt::parse(text.as_bytes(), Path::new("lamp.ldt"))
}

fn intensity_at(record: &LdtFile, [x, y, z]: [f64; 3]) -> f64 {
    record.resolve().unwrap().intensity_cd(Vector::new(x, y, z).direction().unwrap())
}

#[test]
fn every_file_of_the_collection_reads() {
    let mut seen = 0;
    for file in std::fs::read_dir(collection()).unwrap() {
        let path = file.unwrap().path();
        if path.extension().is_none_or(|e| e != "ldt") {
            continue;
        }
        seen += 1;
        let loaded = ldt::read(&path).unwrap_or_else(|p| panic!("{p}"));
        let flux = loaded.value.resolve().unwrap_or_else(|p| panic!("{p}")).luminous_flux_lm();
        assert!(flux > 100.0, "{}: {flux} lm", path.display());
    }
    assert!(seen >= 15, "{seen} files found");
}

#[test]
fn lamp_sets_are_alternatives() {
    let loaded = ldt::read(&collection().join("multiple_lamp_sets.ldt")).unwrap();
    let record = &loaded.value;
    let fluxes: Vec<_> = record.lamp_sets.iter().map(|set| (set.lamps, set.flux_lm)).collect();
    assert_eq!(fluxes, [(1, 500.0), (2, 1200.0), (1, 500.0)]);
    assert_eq!(record.lamp_sets[1].kind, "Double Lamp");
    let flux = |k: usize| record.resolve_with(&record.lamp_sets[k]).unwrap().luminous_flux_lm();
    // Products and sums of the same numbers in the same order but for the factor.
    assert!((flux(1) / flux(0) - 2.4).abs() < 1e-12);
    assert!(loaded.warnings.iter().any(|w| w.what.contains("3 lamp sets")));
}

/// A file of planes 45 degrees apart whose intensity at the horizontal is the plane's number from
/// 1, in cd/klm, before symmetry; gamma is 0, 45, 90. Lamps of 2000 lm, conversion factor 0.5: the
/// numbers are candela.
fn numbered(isym: usize, given: &[usize]) -> String {
    let mut lines: Vec<String> = ["isolux", "3"].map(String::from).to_vec();
    lines.extend([isym.to_string(), "8".into(), "45".into(), "3".into(), "45".into()]);
    lines.extend(["report", "name", "number", "file", "date"].map(String::from));
    lines.extend(["1200", "300", "80", "1180", "280", "0", "0", "0", "0"].map(String::from));
    lines.extend(
        ["100", "0", "0,5", "0", "1", "2", "LED", "2000", "4000", "80", "21.5"].map(String::from),
    );
    lines.extend(vec!["0".to_owned(); 10]);
    lines.extend((0..8).map(|k| (45 * k).to_string()));
    lines.extend(["0", "45", "90"].map(String::from));
    for k in given {
        lines.extend(["0".into(), "0".into(), (k + 1).to_string()]);
    }
    lines.join("\r\n") + "\r\n"
}

#[test]
fn every_symmetry_puts_its_planes_where_they_belong() {
    for (isym, given, expected) in [
        (0, vec![0, 1, 2, 3, 4, 5, 6, 7], [1., 2., 3., 4., 5., 6., 7., 8.]),
        (1, vec![0], [1.0; 8]),
        (2, vec![0, 1, 2, 3, 4], [1., 2., 3., 4., 5., 4., 3., 2.]),
        // C270, C315, C0, C45, C90 are given; C135, C180, C225 mirror C45, C0, C315.
        (3, vec![6, 7, 0, 1, 2], [1., 2., 3., 2., 1., 8., 7., 8.]),
        (4, vec![0, 1, 2], [1., 2., 3., 2., 1., 2., 3., 2.]),
    ] {
        let record = parsed(&numbered(isym, &given)).unwrap_or_else(|p| panic!("{p}")).value;
        for (k, cd) in expected.iter().enumerate() {
            let (s, c) = (45.0 * k as f64).to_radians().sin_cos();
            let found = intensity_at(&record, [c, s, 0.0]);
            // Sines of multiples of 45 degrees, times at most 7 candela a plane.
            assert!((found - cd).abs() < 1e-12, "Isym {isym}, C{}: {found} for {cd}", 45 * k);
        }
    }
}

#[test]
fn what_is_written_is_kept() {
    let record = parsed(&numbered(3, &[6, 7, 0, 1, 2])).unwrap().value;
    assert_eq!(record.symmetry, LdtSymmetry::AboutC90C270);
    assert_eq!(record.header.luminaire, "name");
    assert_eq!(record.sizes.luminaire_m, [1.2, 0.3, 0.08]);
    assert_eq!(record.sizes.luminous_area_m, [1.18, 0.28]);
    assert_eq!(record.conversion_factor, 0.5);
    assert_eq!(record.lamp_sets[0].watts, 21.5);
    let lines = record.lines;
    assert_eq!([lines.lamps, lines.planes, lines.gammas, lines.candela], [26, 43, 51, 54]);
}

#[test]
fn every_spelling_is_the_same_luminaire() {
    let plain = numbered(4, &[0, 1, 2]);
    let expected = parsed(&plain).unwrap();
    for (name, text) in [
        ("LF", plain.replace("\r\n", "\n")),
        ("CR", plain.replace("\r\n", "\r")),
        ("BOM", format!("\u{feff}{plain}")),
        ("blanks", plain.replace("\r\n", " \t\r\n  ")),
        ("empty optional numbers", plain.replacen("\r\n80\r\n", "\r\n 80.0 \r\n", 1)),
        ("Ctrl-Z and empty lines", plain.clone() + "\r\n\r\n\u{1a}\0\0"),
    ] {
        assert_eq!(parsed(&text).unwrap_or_else(|p| panic!("{name}: {p}")), expected, "{name}");
    }
}

#[test]
fn odd_files_are_read_with_a_warning() {
    let plain = numbered(1, &[0]);
    assert_eq!(parsed(&plain).unwrap().warnings, []);
    for (from, to, place, what) in [
        ("\r\n0,5\r\n0\r\n", "\r\n0\r\n0\r\n", "line 24", "conversion factor is 0"),
        ("\r\n0,5\r\n0\r\n", "\r\n0,5\r\n15\r\n", "line 25", "tilt of 15 degrees"),
        ("\r\n100\r\n0\r\n", "\r\n100\r\n77\r\n", "line 23", "ratio makes 1540 lm"),
        ("\r\n3\r\n45\r\n", "\r\n3\r\n30\r\n", "line 7", "not 30 degrees apart"),
    ] {
        assert!(plain.contains(from), "{from:?}");
        let warnings = parsed(&plain.replacen(from, to, 1)).unwrap().warnings;
        let [warning] = warnings.as_slice() else { panic!("{what}: {warnings:?}") };
        assert_eq!(warning.place, place, "{what}");
        assert!(warning.what.contains(what), "{}", warning.what);
    }
}

#[test]
fn every_defect_is_named_with_its_line() {
    let plain = numbered(4, &[0, 1, 2]);
    let line = |number: usize, text: &str| {
        let mut lines: Vec<_> = plain.lines().collect();
        lines[number - 1] = text;
        lines.join("\n")
    };
    let cut = |number: usize| plain.lines().take(number).collect::<Vec<_>>().join("\n");
    for (text, place, what) in [
        (String::new(), "lamp.ldt", "is empty"),
        ("maker".into(), "line 1", "the file ends where the type indicator should follow"),
        ("one\0two".into(), "lamp.ldt", "is not plain text"),
        ("IESNA91\nTILT=NONE".into(), "line 2", "\"TILT=NONE\" is not a number"),
        (line(2, "4"), "line 2", "the type indicator is 4"),
        (line(3, "5"), "line 3", "the symmetry indicator is 5"),
        (line(3, ""), "line 3", "\"\" is not a number"),
        (line(4, "0"), "line 4", "the number of planes is 0"),
        (line(4, "2000000000"), "line 4", "whole number from 1 to 1441"),
        (line(4, "7"), "line 4", "7 planes are no multiple of 4"),
        (line(6, "1"), "line 6", "the number of gamma angles is 1"),
        (line(6, "nan"), "line 6", "\"nan\" is not a number"),
        (line(13, "-5"), "line 13", "the luminaire's length is -5"),
        (line(26, "0"), "line 26", "the number of lamp sets is 0"),
        (line(26, "1e9"), "line 26", "whole number from 1 to 100"),
        (line(29, "0"), "line 26", "flux of the lamps is 0"),
        (line(29, "-1"), "line 29", "flux of the lamps is -1"),
        (line(29, "inf"), "line 29", "\"inf\" is not a number"),
        (line(44, "0"), "line 44", "plane 2 of 8 is 0, not above 0"),
        (line(44, "361"), "line 44", "within 0 and 360 degrees"),
        (line(45, "89"), "line 45", "plane 3 should lie at 90 degrees"),
        (line(53, "181"), "line 53", "within 0 and 180 degrees"),
        (line(55, "-1"), "line 55", "intensity 2 of 9 is -1"),
        (line(55, "1e400"), "line 55", "\"1e400\" is not a number"),
        (line(55, &"9 ".repeat(999)), "line 55", "\"9 9 9 9 9 9 9 9 9 9 \" is not a number"),
        (cut(60), "line 60", "the file ends where intensity 8 of 9 should follow"),
        (plain.clone() + "7\r\n", "line 63", "numbers follow after the last intensity"),
        (line(3, "2"), "line 62", "the file ends where intensity 10 of 15"),
        (line(3, "1"), "line 57", "numbers follow after the last intensity"),
    ] {
        let found = match parsed(&text) {
            Err(problems) => problems.to_string(),
            Ok(loaded) => loaded.value.resolve().expect_err(what).to_string(),
        };
        assert!(found.contains(&format!("{place}:")), "no {place:?} in {found:?}");
        assert!(found.contains(what), "no {what:?} in {found:?}");
        assert_eq!(found.lines().count(), 1, "{found}");
    }
}

/// Cut at every byte, and with every byte changed to a few others.
#[test]
fn cut_and_changed_files_are_read_or_refused() {
    let check = |bytes: &[u8]| {
        let Ok(loaded) = ldt::parse(bytes, Path::new("lamp.ldt")) else { return };
        if let Ok(distribution) = loaded.value.resolve() {
            let flux = distribution.luminous_flux_lm();
            assert!(flux >= 0.0 && flux.is_finite(), "{flux}");
            let _ = distribution.sample([0.3, 0.7]);
        }
    };
    let plain = numbered(3, &[6, 7, 0, 1, 2]);
    for at in 0..plain.len() {
        check(&plain.as_bytes()[..at]);
        for byte in [b'0', b'9', b'-', b'.', b',', b'e', b' ', b'\n', 0, 0x1a, 0xff] {
            let mut bytes = plain.as_bytes().to_vec();
            bytes[at] = byte;
            check(&bytes);
        }
    }
}
