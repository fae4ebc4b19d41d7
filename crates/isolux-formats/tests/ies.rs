//! LM-63 files that can be read: real ones, and the same luminaire in every spelling.

#![expect(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use isolux::geometry::{Direction, Vector};
use isolux::photometry::Symmetry;
use isolux_formats::ies::{
    self, Edition, IesFile, LampFactor, LampGeometry, LengthUnit, OpeningShape, PhotometricType,
    Tilt,
};
use isolux_formats::{Loaded, Problem};
use std::path::{Path, PathBuf};

fn collection(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/photometry").join(name)
}

fn parsed(bytes: &[u8]) -> Loaded<IesFile> {
    let refuse = &mut |name: &str| Err(Problem::new(Path::new(name), "", "not here", "none"));
    ies::parse(bytes, Path::new("lamp.ies"), refuse).unwrap_or_else(|p| panic!("{p}"))
}

fn intensity_at(record: &IesFile, x: f64, y: f64, z: f64) -> f64 {
    record.resolve().unwrap().intensity_cd(Vector::new(x, y, z).direction().unwrap())
}

/// Flux of the bilinear table by 8-point Gauss-Legendre quadrature in every cell, computed outside
/// this code base from the numbers of each file, lm; and the flux of the lamps it declares.
const FLUXES: [(&str, f64, Option<f64>); 14] = [
    ("own/downlight.ies", 1_505.631_220, None),
    ("own/linear_1200.ies", 4_448.475_643, None),
    ("own/pendant.ies", 4_973.976_116, None),
    ("own/wallwasher.ies", 959.556_563, None),
    ("renderpipeline/area_light.ies", 28_338.148_287, Some(41_000.0)),
    ("renderpipeline/bollard.ies", 2_553.470_586, Some(9000.0)),
    ("renderpipeline/comet.ies", 16_073.716_209, Some(22_000.0)),
    ("renderpipeline/cylinder_narrow.ies", 2_976.483_700, Some(5000.0)),
    ("luxcore/ASA_15M_R2.ies", 9_560.828_491, Some(13_000.0)),
    ("photometric-viewer/absolute_photometry_with_multiplier.ies", 1_356.786_788, None),
    ("photometric-viewer/relative_photometry.ies", 904.524_525, Some(500.0)),
    ("photompy/type_a_symmetric.ies", 40_006.128_891, None),
    ("photompy/type_b_full.ies", 60_462.430_871, None),
    ("photompy/type_b_symmetric.ies", 78_183.767_019, None),
];

#[test]
fn the_flux_of_real_files() {
    for (name, flux, lamps) in FLUXES {
        let record = ies::read(&collection(name)).unwrap_or_else(|p| panic!("{p}")).value;
        let found = record.resolve().unwrap().luminous_flux_lm();
        // The constants carry six decimals.
        assert!((found - flux).abs() < 1e-6, "{name}: {found} lm against {flux}");
        assert_eq!(record.lamp_lumens(), lamps, "{name}");
    }
}

#[test]
fn every_file_of_the_collection_reads() {
    let mut seen = 0;
    for directory in std::fs::read_dir(collection("")).unwrap() {
        let directory = directory.unwrap().path();
        for file in std::fs::read_dir(&directory).into_iter().flatten() {
            let path = file.unwrap().path();
            if path.extension().is_none_or(|e| e != "ies") {
                continue;
            }
            seen += 1;
            let loaded = ies::read(&path).unwrap_or_else(|p| panic!("{p}"));
            let flux = loaded.value.resolve().unwrap_or_else(|p| panic!("{p}")).luminous_flux_lm();
            let bright = loaded.value.lamp_lumens().is_some_and(|lamps| flux > lamps);
            assert!(flux > 100.0, "{}: {flux} lm", path.display());
            let across = loaded.value.photometric_type != PhotometricType::C;
            // Two synthetic files hold more light than their lamps give, and those of types A and B are
            // mirrored; nothing else is said.
            let expected = usize::from(bright) + usize::from(across);
            assert_eq!(loaded.warnings.len(), expected, "{:?}", loaded.warnings);
        }
    }
    assert!(seen >= 30, "{seen} files found");
}

#[test]
fn an_edition_of_1995_between_its_lines() {
    let record = ies::read(&collection("radiance/examp1.ies")).unwrap().value;
    assert_eq!(record.edition, Edition::E1995);
    assert_eq!(record.labels, ["SCCSid \"@(#)examp1.ies 1.2 4/27/95 LBL\""]);
    assert_eq!(record.keyword("LAMP"), Some("FO32T8 (EO)"));
    assert_eq!(record.length_unit, LengthUnit::Feet);
    assert_eq!(record.opening.shape, Some(OpeningShape::Rectangle));
    // Feet times 0.3048, one rounding.
    assert!((record.opening.length_m - 4.04 * 0.3048).abs() < 1e-15);
    assert_eq!(record.symmetry(), Ok(Symmetry::AboutBoth));
    assert_eq!((record.vertical_deg.len(), record.horizontal_deg.len()), (73, 5));
    assert_eq!(intensity_at(&record, 0.0, 0.0, 1.0), 801.4);
}

#[test]
fn shapes_of_the_opening_in_real_files() {
    use OpeningShape::*;
    for (name, shape) in [
        ("point_opening", Point),
        ("rectangular_opening_with_height", Rectangle),
        ("round_opening", Disc),
        ("round_opening_with_height", Disc),
        ("ellipse_opening_along_length", Disc),
        ("ellipse_opening_along_width", Disc),
        ("sphere_opening", Ellipsoid),
        ("ellipsoid_opening_along_width", Ellipsoid),
        ("horizontal_cylinder_opening_along_length", CylinderAlongLength),
        ("horizontal_cylinder_opening_along_width", CylinderAlongWidth),
    ] {
        let path = collection(&format!("photometric-viewer/{name}.ies"));
        assert_eq!(ies::read(&path).unwrap().value.opening.shape, Some(shape), "{name}");
    }
}

#[test]
fn a_wall_washer_throws_towards_c0() {
    let record = ies::read(&collection("own/wallwasher.ies")).unwrap().value;
    let slope = |c_deg: f64| {
        let (s, c) = c_deg.to_radians().sin_cos();
        intensity_at(&record, c, s, -1.0)
    };
    assert!(slope(0.0) > 5.0 * slope(180.0));
    // The plane C0-C180 is a mirror; the angles differ by roundings.
    assert!((slope(60.0) - slope(-60.0)).abs() < 1e-9);
}

/// A luminaire of two planes, spelt for one edition; `{}` of the sizes of its opening.
fn luminaire(first: &str, lamp: &str) -> String {
    format!(
        "{first}\n[TEST] T1\n[MORE] more\n[MANUFAC] M\nTILT=NONE\n2 1000 0.5 3 2 1 2 0.1 0.2 0\n\
         0.9 {lamp} 20\n0 45 90\n0 90\n300 200 100\n300 150 50\n"
    )
}

#[test]
fn only_editions_up_to_1995_multiply_by_the_twelfth_number() {
    for (first, lamp, expected) in [
        ("label", "0.8", 0.5 * 0.9 * 0.8),
        ("IESNA91", "0.8", 0.5 * 0.9 * 0.8),
        ("IESNA:LM-63-1995", "0.8", 0.5 * 0.9 * 0.8),
        ("IESNA:LM-63-2002", "1", 0.5 * 0.9),
        ("IESNA:LM-63-2002", "0.8", 0.5 * 0.9),
        ("IES:LM-63-2019", "1.10000", 0.5 * 0.9),
    ] {
        let loaded = parsed(luminaire(first, lamp).as_bytes());
        // Three products.
        assert!((loaded.value.intensity_factor() - expected).abs() < 1e-15, "{first} {lamp}");
        assert!((intensity_at(&loaded.value, 0.0, 0.0, -1.0) - 300.0 * expected).abs() < 1e-12);
        let warned = loaded.value.lamp_factor == LampFactor::Reserved(0.8);
        assert_eq!(loaded.warnings.len(), usize::from(warned), "{:?}", loaded.warnings);
    }
}

#[test]
fn every_spelling_is_the_same_luminaire() {
    let plain = luminaire("IESNA:LM-63-2002", "1");
    let expected = parsed(plain.as_bytes()).value;
    let spellings = [
        ("CR LF", plain.replace('\n', "\r\n").into_bytes()),
        ("CR", plain.replace('\n', "\r").into_bytes()),
        ("tabs", plain.replace("0 45 90", "\t0\t45\t\t90 ").into_bytes()),
        ("commas", plain.replace("300 200 100", "300, 200 ,100,").into_bytes()),
        ("a value a line", plain.replace("300 150 50", "300\n\n150\n50").into_bytes()),
        ("two rows a line", plain.replace("100\n300", "100 300").into_bytes()),
        ("bare points", plain.replace("0.9", ".9").replace("1000", "+1.E3").into_bytes()),
        ("BOM", [b"\xef\xbb\xbf", plain.as_bytes()].concat()),
        ("Ctrl-Z", [plain.as_bytes(), b"\x1a\0\0 rest of the sector"].concat()),
        ("no last line end", plain.trim_end().as_bytes().to_vec()),
        ("lower case", plain.replace("TILT=NONE", "  tilt = none ").into_bytes()),
    ];
    for (name, bytes) in spellings {
        let mut found = parsed(&bytes);
        assert_eq!(found.warnings, [], "{name}");
        found.value.lines = expected.lines;
        found.value.intensity_lines.clone_from(&expected.intensity_lines);
        assert_eq!(found.value, expected, "{name}");
    }
}

#[test]
fn keywords_keep_their_letters() {
    let bytes = luminaire("IESNA91", "1").replace("M\n", "Zürich & Søn\n");
    let latin: Vec<u8> = bytes.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
    for bytes in [bytes.as_bytes(), &latin] {
        let record = parsed(bytes).value;
        assert_eq!(record.keyword("manufac"), Some("Zürich & Søn"));
        assert_eq!(record.keyword("TEST"), Some("T1\nmore"));
        assert_eq!(record.keyword("LAMP"), None);
    }
}

#[test]
fn records_know_their_lines() {
    let lines = parsed(luminaire("IESNA91", "1").as_bytes()).value.lines;
    assert_eq!([lines.lamps, lines.vertical, lines.horizontal, lines.candela], [6, 8, 9, 10]);
}

#[test]
fn text_after_the_table_is_left_out_with_a_warning() {
    let loaded = parsed((luminaire("IESNA91", "1") + "\nend of test report 7").as_bytes());
    let [warning] = loaded.warnings.as_slice() else { panic!("{:?}", loaded.warnings) };
    assert_eq!(warning.place, "line 13, column 1");
}

fn with_planes(planes: &[f64]) -> IesFile {
    let angles: Vec<_> = planes.iter().map(ToString::to_string).collect();
    let rows: Vec<_> = planes.iter().map(|c| format!("0 {c}")).collect();
    let text = format!(
        "IESNA91\nTILT=NONE\n1 -1 1 2 {} 1 2 0 0 0 1 1 5\n0 90\n{}\n{}",
        planes.len(),
        angles.join(" "),
        rows.join("\n")
    );
    parsed(text.as_bytes()).value
}

#[test]
fn every_lateral_symmetry_fills_the_circle() {
    use Symmetry::*;
    for (planes, symmetry, [c0, c90, c180, c270]) in [
        (vec![0.0], Axial, [0.0, 0.0, 0.0, 0.0]),
        (vec![0.0, 45.0, 90.0], AboutBoth, [0.0, 90.0, 0.0, 90.0]),
        (vec![0.0, 90.0, 180.0], AboutC0C180, [0.0, 90.0, 180.0, 90.0]),
        (vec![90.0, 180.0, 270.0], AboutC90C270, [180.0, 90.0, 180.0, 270.0]),
        (vec![0.0, 90.0, 180.0, 270.0, 360.0], None, [0.0, 90.0, 180.0, 270.0]),
        (vec![0.0, 90.0, 180.0, 270.0], None, [0.0, 90.0, 180.0, 270.0]),
    ] {
        let record = with_planes(&planes);
        assert_eq!(record.symmetry(), Ok(symmetry));
        for (direction, expected) in [
            (Direction::X.to_vector(), c0),
            (Direction::Y.to_vector(), c90),
            (Direction::X.to_vector() * -1.0, c180),
            (Direction::Y.to_vector() * -1.0, c270),
        ] {
            let found = intensity_at(&record, direction.x, direction.y, direction.z);
            // An arc tangent in degrees, times at most one candela a degree.
            assert!((found - expected).abs() < 1e-12, "{planes:?} {direction:?}: {found}");
        }
    }
}

/// Intensities of types A and B by horizontal angle (rows) and vertical angle: 1000 + 10 h + v.
fn floodlight(kind: u8, horizontal: &[f64], vertical: &[f64]) -> IesFile {
    let list = |angles: &[f64]| angles.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let row = |h: &f64| list(&vertical.iter().map(|v| 1000.0 + 10.0 * h + v).collect::<Vec<_>>());
    let text = format!(
        "IESNA91\nTILT=NONE\n1 -1 1 {} {} {kind} 2 0 0 0 1 1 5\n{}\n{}\n{}",
        vertical.len(),
        horizontal.len(),
        list(vertical),
        list(horizontal),
        horizontal.iter().map(row).collect::<Vec<_>>().join("\n")
    );
    parsed(text.as_bytes()).value
}

#[test]
fn types_a_and_b_shine_along_their_axis_with_up_along_x() {
    let (h, v) = ([-60.0, 0.0, 30.0, 60.0], [-40.0, 0.0, 20.0]);
    for kind in [2, 3] {
        let record = floodlight(kind, &h, &v);
        for (x, y, z, expected) in [
            (0.0, 0.0, -1.0, 1000.0),
            // Up and down in the plane of the aim, then right and left of it.
            (libm::sin(0.3), 0.0, -libm::cos(0.3), 1000.0 + 0.3_f64.to_degrees()),
            (libm::sin(-0.3), 0.0, -libm::cos(0.3), 1000.0 - 0.3_f64.to_degrees()),
            (0.0, -libm::sin(0.5), -libm::cos(0.5), 1000.0 + 10.0 * 0.5_f64.to_degrees()),
            (0.0, libm::sin(0.5), -libm::cos(0.5), 1000.0 - 10.0 * 0.5_f64.to_degrees()),
            // Beyond the angles given.
            (1.0, 0.0, -1.0, 0.0),
            (0.0, 0.0, 1.0, 0.0),
        ] {
            let found = intensity_at(&record, x, y, z);
            // Arc tangents in degrees, times at most ten candela a degree.
            assert!((found - expected).abs() < 1e-10, "{kind}: {x} {y} {z}: {found}");
        }
    }
    // Away from both planes the types differ: V of type B is measured about the horizontal axis.
    let (x, y, z): (f64, f64, f64) = (0.2, -0.5, -1.0);
    let about = |opposite: f64, near: f64| libm::atan2(opposite, near).to_degrees();
    let (flat, upright) = ((z * z + y * y).sqrt(), (z * z + x * x).sqrt());
    for (kind, expected) in [
        (2, 1000.0 + 10.0 * about(-y, upright) + about(x, -z)),
        (3, 1000.0 + 10.0 * about(-y, -z) + about(x, flat)),
    ] {
        let found = intensity_at(&floodlight(kind, &h, &v), x, y, z);
        assert!((found - expected).abs() < 1e-10, "{kind}: {found} against {expected}");
    }
}

#[test]
fn types_a_and_b_from_0_on_are_mirrored() {
    for kind in [2, 3] {
        let record = floodlight(kind, &[0.0, 45.0, 90.0], &[0.0, 90.0]);
        for (x, y) in [(0.4, 0.3), (-0.4, 0.3), (0.4, -0.3), (-0.4, -0.3)] {
            let (one, other) =
                (intensity_at(&record, x, y, -1.0), intensity_at(&record, 0.4, -0.3, -1.0));
            // As above.
            assert!((one - other).abs() < 1e-10, "{kind}: {x} {y}: {one} against {other}");
        }
    }
}

#[test]
fn records_know_the_line_of_every_intensity() {
    let text = "IESNA91\nTILT=NONE\n1 -1 1 2 2 1 2 0 0 0 1 1 5\n0 90\n0 90\n1\n2 3\n\n4";
    assert_eq!(parsed(text.as_bytes()).value.intensity_lines, [6, 7, 7, 9]);
}

const TILT: &str = "1\n4\n0 30\n60 90\n0.9 0.8 0.7\n0.6";

#[test]
fn an_included_tilt_table_may_wrap_anywhere() {
    let text = luminaire("IESNA91", "1").replace("NONE", &format!("INCLUDE\n{TILT}"));
    let loaded = parsed(text.as_bytes());
    let Tilt::Included(table) = &loaded.value.tilt else { panic!("{:?}", loaded.value.tilt) };
    assert_eq!(table.geometry, LampGeometry::Vertical);
    assert_eq!(table.angles_deg, [0.0, 30.0, 60.0, 90.0]);
    assert_eq!(table.factors, [0.9, 0.8, 0.7, 0.6]);
    // Three products.
    assert!((loaded.value.intensity_factor() - 0.5 * 0.9 * 0.9).abs() < 1e-15);
    assert_eq!(loaded.warnings.len(), 1, "the factor at rest is told");
}

/// A directory of its own for a test, and a luminaire in it that names a tilt file.
fn beside(test: &str, tilt: &str) -> (PathBuf, PathBuf) {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&directory);
    std::fs::create_dir_all(directory.join("in")).unwrap();
    let lamp = directory.join("in/lamp.ies");
    let text = luminaire("IESNA91", "1").replace("TILT=NONE", &format!("TILT={tilt}"));
    std::fs::write(&lamp, text).unwrap();
    std::fs::write(directory.join("secret.tlt"), TILT).unwrap();
    (directory, lamp)
}

#[test]
fn a_tilt_file_beside_is_read() {
    let (directory, lamp) = beside("ies_tilt_beside", "my lamp.tlt");
    std::fs::write(directory.join("in/my lamp.tlt"), TILT).unwrap();
    let record = ies::read(&lamp).unwrap().value;
    let Tilt::File(name, table) = &record.tilt else { panic!("{:?}", record.tilt) };
    assert_eq!((name.as_str(), table.factors.len()), ("my lamp.tlt", 4));
}

#[test]
fn a_tilt_file_elsewhere_is_refused() {
    for name in ["../secret.tlt", "/etc/passwd", "C:\\lamp.tlt", "..\\secret.tlt", "..", ".", ""] {
        let (_, lamp) = beside("ies_tilt_elsewhere", name);
        let refusal = ies::read(&lamp).unwrap_err().to_string();
        assert!(refusal.contains("line 5: TILT="), "{name}: {refusal}");
        assert!(refusal.contains("names no file beside this one"), "{name}: {refusal}");
    }
    let (_, lamp) = beside("ies_tilt_missing", "absent.tlt");
    let refusal = ies::read(&lamp).unwrap_err().to_string();
    let told = "lamp.ies: line 5: TILT=absent.tlt names no file beside this one; write TILT=NONE, ";
    assert!(refusal.contains(told), "{refusal}");
}

#[test]
fn a_file_that_is_cut_in_its_tilt_line_was_said_to_name_a_tilt_file() {
    let (_, lamp) = beside("ies_tilt_cut", "NONE");
    let whole = std::fs::read_to_string(&lamp).unwrap();
    let value = whole.find("TILT=").unwrap() + "TILT=".len();
    for cut in 0.."NONE".len() {
        std::fs::write(&lamp, &whole[..value + cut]).unwrap();
        let refusal = ies::read(&lamp).unwrap_err().to_string();
        let told = format!(
            "lamp.ies: line 5: the file seems cut in this line: TILT={} names no file beside this one; ",
            &"NONE"[..cut]
        );
        assert!(refusal.contains(&told) && refusal.contains("TILT= is NONE, INCLUDE"), "{refusal}");
    }
}

#[cfg(unix)]
#[test]
fn a_link_out_of_the_directory_is_refused() {
    let (directory, lamp) = beside("ies_tilt_link", "link.tlt");
    std::os::unix::fs::symlink(directory.join("secret.tlt"), directory.join("in/link.tlt"))
        .unwrap();
    let refusal = ies::read(&lamp).unwrap_err().to_string();
    let told = "lamp.ies: line 5: the file of TILT=link.tlt is a link to another directory";
    assert!(refusal.contains(told), "{refusal}");
}

/// The message spoke of planes, in the order of the code, and a warning of a mirror image of one angle.
#[test]
fn one_horizontal_angle_of_type_b_is_told_in_the_words_of_the_file() {
    for (kind, name) in [(2, "B"), (3, "A")] {
        let text = format!(
            "IESNA:LM-63-2002\n[TEST] x\n[MANUFAC] y\nTILT=NONE\n1 -1 1 3 1 {kind} 2 0 0 0 1 1 10\n\
             -90 0 90\n0\n0 100 0\n"
        );
        let loaded = parsed(text.as_bytes());
        assert!(
            !loaded.warnings.iter().any(|w| w.what.contains("mirrored")),
            "{:?}",
            loaded.warnings
        );
        let problem = loaded.value.resolve().unwrap_err();
        let due = format!("1 horizontal angle beside 3 vertical in a table of type {name}");
        assert!(problem.what.contains(&due), "{problem}");
        assert_eq!(problem.place, "line 7");
    }
}
