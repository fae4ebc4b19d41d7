//! Conversions between IES and EULUMDAT: what comes back is what was, but for what is said to be lost.

#![expect(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use isolux::photometry::IntensityDistribution;
use isolux_formats::photometric_file::{Conversion, PhotometricFile, Target, convert};
use std::path::{Path, PathBuf};

fn collection() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/photometry");
    let folders = std::fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path());
    let files = folders
        .filter(|path| path.is_dir())
        .flat_map(|folder| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()));
    let is_lamp = |path: &PathBuf| path.extension().is_some_and(|e| e == "ies" || e == "ldt");
    let mut files: Vec<PathBuf> = files.filter(is_lamp).collect();
    files.sort();
    files
}

fn other(file: &PhotometricFile) -> (Target, &'static str) {
    match file {
        PhotometricFile::Ies(_) => (Target::Ldt, "back.ldt"),
        PhotometricFile::Ldt(_) => (Target::Ies, "back.ies"),
    }
}

fn parsed(text: &str, name: &str) -> PhotometricFile {
    PhotometricFile::parse(text.as_bytes(), Path::new(name)).unwrap_or_else(|p| panic!("{p}")).value
}

/// Bound of the difference, as a share of the greatest intensity: six digits are written into EULUMDAT,
/// half a unit of the last is 5e-6, and into LM-63 all.
fn bound(target: Target) -> f64 {
    match target {
        Target::Ldt => 5.1e-6,
        Target::Ies => 1e-12,
    }
}

fn is_across(file: &PhotometricFile) -> bool {
    matches!(file.resolve().unwrap(), IntensityDistribution::Web(web) if !web.system().is_c())
}

#[test]
fn every_file_of_the_collection_converts_and_comes_back() {
    let mut seen = 0;
    for path in collection() {
        let file = PhotometricFile::read(&path).unwrap_or_else(|p| panic!("{p}")).value;
        if is_across(&file) {
            continue;
        }
        let most = file.resolve().unwrap().max_intensity_cd();
        let (target, name) = other(&file);
        let Conversion { text, difference, .. } = convert(&file, target).unwrap();
        let allowed = bound(target) * most;
        assert!(difference.largest_cd <= allowed, "{}: {difference:?}", path.display());
        assert!(difference.rms_cd <= difference.largest_cd);
        // And back again, against the file in between.
        let between = parsed(&text, name);
        let (target, _) = other(&between);
        let back = convert(&between, target).unwrap();
        assert!(back.difference.largest_cd <= bound(target) * most, "{}", path.display());
        seen += 1;
    }
    assert!(seen > 40, "{seen}");
}

#[test]
fn symmetries_lamps_and_sizes_are_carried_over() {
    let ldt = |isym: u32, given: usize, sets: &str| {
        let row = "100\n90\n80\n";
        let rows: String = (0..given).map(|k| format!("{}{row}", "0".repeat(k % 2))).collect();
        format!(
            "maker\n3\n{isym}\n8\n45\n3\n45\nreport\nlamp\nnumber\nfile\ndate\n0\n0\n0\n400\n0\n\
             20\n20\n20\n20\n100\n70\n1\n0\n{sets}0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n\
             0\n45\n90\n135\n180\n225\n270\n315\n0\n45\n90\n{rows}"
        )
    };
    let relative = "1\n2\nT5\n1000\n830\n1B\n55\n";
    for (isym, given, planes) in [
        (0, 8, vec![0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0, 360.0]),
        (1, 1, vec![0.0]),
        (2, 5, vec![0.0, 45.0, 90.0, 135.0, 180.0]),
        (4, 3, vec![0.0, 45.0, 90.0]),
    ] {
        let conversion =
            convert(&parsed(&ldt(isym, given, relative), "a.ldt"), Target::Ies).unwrap();
        let PhotometricFile::Ies(ies) = parsed(&conversion.text, "a.ies") else { panic!() };
        assert_eq!(ies.horizontal_deg, planes, "Isym {isym}");
        assert_eq!((ies.lamps, ies.lumens_per_lamp, ies.input_watts), (2, Some(500.0), 55.0));
        assert_eq!(ies.keyword("MANUFAC"), Some("maker"));
        assert_eq!(ies.keyword("LAMP"), Some("T5, 830, 1B"));
        let sizes = [ies.opening.width_m, ies.opening.length_m, ies.opening.height_m];
        assert_eq!(sizes, [0.4, 0.4, 0.02]);
        let back = convert(&PhotometricFile::Ies(ies), Target::Ldt).unwrap();
        let PhotometricFile::Ldt(back) = parsed(&back.text, "a.ldt") else { panic!() };
        assert_eq!(back.symmetry as u32, isym);
        assert_eq!(back.sizes.luminous_area_m, [0.4, 0.0]);
        let set = &back.lamp_sets[0];
        assert_eq!((set.lamps, set.flux_lm, set.absolute), (2, 1000.0, false));
    }
    let absolute = "2\n-1\nLED\n1000\n4000\n80\n20\n1\nspare\n900\n3000\n80\n20\n";
    let conversion = convert(&parsed(&ldt(1, 1, absolute), "a.ldt"), Target::Ies).unwrap();
    let PhotometricFile::Ies(ies) = parsed(&conversion.text, "a.ies") else { panic!() };
    assert_eq!(ies.lumens_per_lamp, None);
    assert!(conversion.losses.iter().any(|l| l.contains("1 further lamp set")));
}

#[test]
fn planes_that_do_not_begin_at_0_are_closed_there() {
    let text = "m\n0\n0\n4\n90\n2\n90\nr\nl\nn\nf\nd\n0\n0\n0\n0\n0\n0\n0\n0\n0\n100\n0\n1\n0\n\
                1\n1\nLED\n1000\n\n\n\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n30\n120\n210\n300\n0\n90\n\
                100\n10\n100\n20\n100\n30\n100\n40\n";
    let conversion = convert(&parsed(text, "a.ldt"), Target::Ies).unwrap();
    let PhotometricFile::Ies(ies) = parsed(&conversion.text, "a.ies") else { panic!() };
    assert_eq!(ies.horizontal_deg, [0.0, 30.0, 120.0, 210.0, 300.0, 360.0]);
    // Between 40 at 300 and 10 at 390 degrees: 20 at 360. One rounding of a quotient of 60 by 90.
    assert!((ies.candela[1] - 20.0).abs() < 1e-13);
    assert!(conversion.difference.largest_cd < 1e-11, "{:?}", conversion.difference);
}

#[test]
fn floodlights_are_sampled_and_the_loss_is_stated() {
    let angles: Vec<String> = (-18..=18).map(|k| (5 * k).to_string()).collect();
    let beam = |k: i32| (1.0 - f64::from(k * k) / 256.0).max(0.0);
    let rows: Vec<String> = (-18..=18)
        .map(|h| {
            let row: Vec<String> =
                (-18..=18).map(|v| (1000.0 * beam(h) * beam(v)).to_string()).collect();
            row.join(" ")
        })
        .collect();
    let angles = angles.join(" ");
    let text = format!(
        "IESNA91\nTILT=NONE\n1 -1 1 37 37 2 2 0 0 0\n1 1 20\n{angles}\n{angles}\n{}\n",
        rows.join("\n")
    );
    let conversion = convert(&parsed(&text, "a.ies"), Target::Ldt).unwrap();
    assert!(conversion.losses.iter().any(|l| l.contains("type B")), "{:?}", conversion.losses);
    // Of second order in steps of 2.5 degrees: within a per cent of the greatest intensity, and not nothing.
    let largest = conversion.difference.largest_cd;
    assert!(largest > 0.01 && largest < 10.0, "{largest}");
}

#[test]
fn a_file_is_not_converted_into_what_it_is() {
    let path = &collection()[0];
    let file = PhotometricFile::read(path).unwrap().value;
    let same = if other(&file).0 == Target::Ldt { Target::Ies } else { Target::Ldt };
    assert!(convert(&file, same).unwrap_err().to_string().contains("has that format already"));
}
