//! The audit of photometric files: every rule by a file that breaks it, with its line.

use isolux_formats::lint::{Audit, Severity, audit, lint};
use isolux_formats::photometric_file::PhotometricFile;
use std::path::Path;

const IES: &str = "IES:LM-63-2019\n[TEST] 1\n[TESTLAB] lab\n[ISSUEDATE] today\n[MANUFAC] m\n\
                   [LUMCAT] c\n[LUMINAIRE] l\nTILT=NONE\n1 -1 1 7 3 1 2 0.1 0.1 0\n1 1.10000 20\n\
                   0 15 30 45 60 75 90\n0 45 90\n\
                   1000 966 866 707 500 259 0\n1000 900 800 600 400 200 0\n\
                   1000 850 700 500 300 150 0\n";

/// Symmetric about both planes, 682 lm out of 1000.
const LDT: &str = "m\n3\n4\n8\n45\n7\n15\nr\nl\nn\nf\nd\n600\n600\n80\n500\n500\n0\n0\n0\n0\n\
                   100\n68\n1\n0\n1\n1\nLED\n1000\n4000\n80\n20\n\
                   0.27\n0.36\n0.44\n0.51\n0.57\n0.65\n0.71\n0.75\n0.8\n0.84\n\
                   0\n45\n90\n135\n180\n225\n270\n315\n0\n15\n30\n45\n60\n75\n90\n\
                   250\n240\n215\n170\n120\n60\n0\n250\n235\n200\n150\n100\n50\n0\n\
                   250\n230\n190\n140\n90\n40\n0\n";

fn audited(text: &str, name: &str) -> Audit {
    let path = Path::new(name);
    audit(path, text.as_bytes(), PhotometricFile::parse(text.as_bytes(), path))
}

#[test]
fn good_files_have_no_findings() {
    for (text, name) in [(IES, "lamp.ies"), (LDT, "lamp.ldt")] {
        assert_eq!(audited(text, name).findings, [], "{name}");
    }
}

/// A good file with one thing changed has a finding of that severity and line that says so.
fn check(good: &str, name: &str, table: &[(&str, &str, Severity, usize, &str)]) {
    for (from, to, severity, line, what) in table {
        assert_eq!(good.matches(from).count(), 1, "{from:?} must be there once");
        let found = audited(&good.replace(from, to), name).findings;
        let line = Some(*line).filter(|line| *line > 0);
        let is_it = |f: &&isolux_formats::lint::Finding| {
            f.severity == *severity && f.line == line && f.what.contains(what)
        };
        let finding = found.iter().find(is_it);
        let finding = finding.unwrap_or_else(|| panic!("no {what:?} on {line:?} in {found:#?}"));
        assert!(!finding.remedy.is_empty());
    }
}

#[test]
fn every_rule_for_lm_63() {
    use Severity::{Error, Note, Warning};
    check(
        IES,
        "lamp.ies",
        &[
            // Lumens.
            ("1 -1 1 7", "1 1000 1 7", Warning, 9, "its lamps give 1000 lm"),
            ("1 -1 1 7", "1 20000 1 7", Warning, 9, "% of the lamps' 20000 lm"),
            ("1 -1 1 7", "1 0 1 7", Warning, 9, "declared with 0 lm"),
            ("[TEST] 1", "[TEST] 1\n[_TOTALLUMINAIRELUMENS] 500", Warning, 3, "states 500 lm"),
            ("1.10000 20", "1.10000 2", Warning, 9, "lm/W, more than"),
            ("1.10000 20", "1.10000 0", Note, 9, "input power is 0"),
            ("1.10000 20", "1.10000 -20", Warning, 9, "input power is -20"),
            // Multipliers.
            ("1 -1 1 7", "1 -1 0.5 7", Note, 9, "multiplied by 0.5"),
            ("\n1 1.10000", "\n0.9 1.10000", Note, 9, "ballast factor 0.9"),
            ("\n1 1.10000", "\n9 1.10000", Warning, 9, "no ballast has it"),
            // Symmetry.
            ("1000 900 800", "1100 900 800", Warning, 14, "the intensity at nadir is 1000 to 1100"),
            // Coverage.
            ("300 150 0", "300 150 90", Warning, 11, "ends at 90 degrees with 9 %"),
            ("0 15 30 45 60 75 90", "1 15 30 45 60 75 90", Warning, 11, "ends at 1 degrees"),
            // Spikes and holes.
            ("800 600 400", "800 6000 400", Warning, 14, "spike at C 45, gamma 45: 6000"),
            ("800 600 400", "800 6 400", Warning, 14, "hole at C 45, gamma 45: 6"),
            // Fields.
            ("1.10000", "1.70000", Note, 9, "file generation type 1.7"),
            ("[LUMCAT] c\n", "", Note, 1, "keywords are missing: LUMCAT"),
            ("[TEST] 1", "[TEST] 1\n[FOO] x", Note, 3, "outside the standard: FOO"),
            ("[TEST] 1", "[TEST] 1\nfree text", Note, 0, "1 line before TILT="),
            ("[TEST] 1", "[_INTENSITYUNITS] mW/sr", Warning, 2, "are not candela"),
            ("[TEST] 1", "[TEST] Größe", Note, 2, "beyond ASCII, read as UTF-8"),
            ("\n1 -1 1 7", "\n0 -1 1 7", Note, 9, "number of lamps is 0"),
            // What readers say.
            ("IES:LM-63-2019", "IES:LM-63-2099", Warning, 1, "no edition"),
            ("1.10000 20", "1.10000 x", Error, 10, "\"x\" is not a number"),
            ("0 45 90\n", "0 45 91\n", Error, 12, "cover no known part"),
        ],
    );
    let long = format!("[TEST] {}", "x".repeat(300));
    check(IES, "lamp.ies", &[("[TEST] 1", &long, Note, 2, "a line of 307 characters")]);
}

#[test]
fn every_rule_for_eulumdat() {
    use Severity::{Error, Note, Warning};
    check(
        LDT,
        "lamp.ldt",
        &[
            ("m\n3\n4\n", "m\n1\n4\n", Note, 2, "type 1 is symmetric about the vertical"),
            ("m\n3\n4\n", "m\n0\n4\n", Note, 2, "type 0 is none"),
            ("n\nf\nd\n600", "n\nf\nd\n400", Note, 16, "luminous area is larger"),
            ("\n100\n68\n", "\n60\n68\n", Warning, 22, "states 60 % downward flux"),
            ("\n100\n68\n", "\n100\n90\n", Warning, 23, "the light output ratio makes 900"),
            ("\n100\n68\n", "\n100\n163\n", Warning, 23, "more than the lamps give"),
            ("68\n1\n0", "63\n0.97\n0", Note, 24, "conversion factor 0.97"),
            ("68\n1\n0", "68\n1,0\n0", Note, 24, "a decimal comma: 1,0"),
            ("1\n1\nLED", "1\n0\nLED", Note, 26, "number of lamps is 0"),
            ("0.71\n", "1.92\n", Note, 39, "direct ratio 1.92"),
            ("0.71\n", "0.12\n", Note, 39, "direct ratio falls from 0.65 to 0.12"),
            (
                "0.27\n0.36\n0.44\n0.51\n0.57\n",
                "0.55\n0.6\n0.6\n0.62\n0.64\n",
                Warning,
                33,
                "0.55 of room index 0.6 is not",
            ),
            ("250\n235\n200\n150", "250\n235\n200\n1500", Warning, 68, "spike at C 45, gamma 45"),
            ("m\n3\n4\n8\n", "m\n3\n4\n7\n", Error, 4, "no multiple of 4"),
        ],
    );
}

#[test]
fn stray_light_and_hidden_symmetry_are_told() {
    let up = IES
        .replace("1 -1 1 7 3", "1 -1 1 8 3")
        .replace("75 90\n0 45 90", "75 90 180\n0 45 90")
        .replace("259 0\n", "259 0 20\n")
        .replace("200 0\n", "200 0 20\n")
        .replace("150 0\n", "150 0 20\n");
    let found = audited(&up, "lamp.ies").findings;
    assert!(
        found.iter().any(|f| f.what.contains("above the horizontal: stray light")),
        "{found:?}"
    );
    let whole = "IESNA91\n[TEST] 1\n[MANUFAC] m\nTILT=NONE\n1 -1 1 2 5 1 2 0 0 0\n1 1 20\n0 90\n\
                 0 90 180 270 360\n100 0\n100 0\n100 0\n100 0\n100 0\n";
    let found = audited(whole, "lamp.ies").findings;
    assert!(
        found.iter().any(|f| f.what.contains("about the vertical axis: one plane")),
        "{found:?}"
    );
    let open =
        whole.replace("100 0\n100 0\n100 0\n100 0\n100 0\n", "90 0\n90 0\n90 5\n90 0\n90 7\n");
    let found = audited(&open, "lamp.ies").findings;
    let closing = "C 360, gamma 90 holds 7, the same direction at C 0 holds 0";
    assert!(found.iter().any(|f| f.line == Some(13) && f.what.contains(closing)), "{found:?}");
}

#[test]
fn other_formats_and_absent_files_are_named() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    for (name, what) in [
        ("lamp.gldf", "GLDF"),
        ("lamp.txt", "by its extension"),
        ("gone.ies", "does not exist"),
        ("gone.txt", "does not exist"),
    ] {
        if !name.starts_with("gone") {
            std::fs::write(folder.join(name), "lamp").unwrap();
        }
        let audit = lint(&folder.join(name));
        assert!(!audit.is_usable());
        let [finding] = audit.findings.as_slice() else { panic!("{:?}", audit.findings) };
        assert_eq!((finding.severity, finding.line), (Severity::Error, None));
        assert!(finding.what.contains(what), "{finding:?}");
    }
    let text = audited("", "lamp.xml").findings[0].remedy.clone();
    assert!(text.contains("TM-33"), "{text}");
}
