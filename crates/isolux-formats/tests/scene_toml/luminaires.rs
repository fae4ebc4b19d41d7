//! Luminaires and groups.

use super::{FLOOR, problems, read, read_with};
use isolux::geometry::{Direction, Point, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Luminaire, LuminaireKind, Scene, SceneParts};
use isolux::units::Rgb;
use std::f64::consts::PI;

fn parts(luminaire: &str) -> SceneParts {
    let parts = read(&format!("[[luminaire]]\n{luminaire}\n{FLOOR}"));
    Scene::assemble(parts.clone()).unwrap();
    parts
}

fn intensity(luminaire: &str) -> IntensityDistribution {
    match parts(&format!("position = [0, 0, 1]\n{luminaire}")).luminaires.remove(0).kind {
        LuminaireKind::Point { intensity, .. } => intensity,
        other => panic!("{other:?}"),
    }
}

/// Where a luminaire is, its nadir and its C0 direction.
fn pose(luminaire: &Luminaire) -> (Point, Vector, Vector) {
    let LuminaireKind::Point { position, world_from_luminaire, .. } = &luminaire.kind else {
        panic!("a point")
    };
    (*position, -world_from_luminaire.columns[2], world_from_luminaire.columns[0])
}

#[test]
fn candelas_and_lumens() {
    let isotropic = IntensityDistribution::Isotropic { intensity_cd: 100.0 };
    assert_eq!(intensity("isotropic = { intensity_cd = 100 }"), isotropic);
    assert_eq!(intensity("isotropic = { intensity_cd = 200 }\ndimming = 0.5"), isotropic);
    for (text, flux) in [
        ("isotropic = { flux_lm = 1000 }", 1000.0),
        ("cosine = { flux_lm = 500, exponent = 3 }", 500.0),
        ("cosine = { peak_cd = 100 }", 100.0 * PI),
        ("spot = { flux_lm = 300, inner_deg = 10, outer_deg = 20 }", 300.0),
        ("isotropic = { flux_lm = 0 }", 0.0),
    ] {
        let found = intensity(text).luminous_flux_lm();
        // A few roundings.
        assert!((found - flux).abs() <= 1e-12 * flux, "{text}: {found}");
    }
    let spot = IntensityDistribution::Spot {
        peak_cd: 5.0,
        inner_rad: 10.0_f64.to_radians(),
        outer_rad: 20.0_f64.to_radians(),
    };
    assert_eq!(intensity("spot = { peak_cd = 5, inner_deg = 10, outer_deg = 20 }"), spot);
}

#[test]
fn photometric_files() {
    let ies = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 20\n0 45 90\n0\n300 200 0\n";
    let scene = |keys: &str| {
        let text = format!("[[luminaire]]\nposition = [0,0,1]\n{keys}\n{FLOOR}");
        read_with(&text, &[("lamp.ies", ies)])
    };
    let flux = |keys: &str| Scene::assemble(scene(keys).unwrap().value).unwrap().luminous_flux_lm();
    let own = flux("ies = 'lamp.ies'");
    assert!(own > 0.0);
    assert!((flux("ies = 'lamp.ies'\ndimming = 0.25") / own - 0.25).abs() < 1e-12);
    assert!((flux("ies = 'lamp.ies'\nflux_lm = 1234") - 1234.0).abs() < 1e-9);
    let problem = scene("ies = 'gone.ies'").unwrap_err().to_string();
    assert!(problem.contains("line 3, column 7: file `gone.ies` does not exist"), "{problem}");
    assert!(scene("ies = 'scene.toml'").is_err());
    assert!(scene("ldt = 'lamp.ies'").is_err());
}

#[test]
fn aim_and_rotation() {
    let near = |a: Vector, b: [f64; 3]| (a - Vector::from(b)).length() < 1e-14;
    let lamp = |keys: &str| {
        let keys = format!("position = [1, 2, 3]\nisotropic = {{ intensity_cd = 1 }}\n{keys}");
        pose(&parts(&keys).luminaires[0])
    };
    let (position, nadir, c0) = lamp("");
    assert_eq!(position, Point::new(1.0, 2.0, 3.0));
    assert!(near(nadir, [0.0, 0.0, -1.0]) && near(c0, [1.0, 0.0, 0.0]));
    let (_, nadir, c0) = lamp("rotate_deg = 90");
    assert!(near(nadir, [0.0, 0.0, -1.0]) && near(c0, [0.0, 1.0, 0.0]));
    let (_, nadir, c0) = lamp("target = [1, 5, 3]");
    assert!(near(nadir, [0.0, 1.0, 0.0]) && near(c0, [1.0, 0.0, 0.0]));
    let (_, nadir, c0) = lamp("direction = [2, 0, 0]\nrotate_deg = -90");
    assert!(near(nadir, [1.0, 0.0, 0.0]) && near(c0, [0.0, -1.0, 0.0]));
}

#[test]
fn y_up_scenes_hang_their_luminaires_along_y() {
    let text = format!(
        "up = 'y'\n[[luminaire]]\nposition = [0,1,0]\nisotropic = {{ intensity_cd = 1 }}\n{FLOOR}"
    );
    let (_, nadir, c0) = pose(&read(&text).luminaires[0]);
    assert_eq!((nadir, c0), (-Direction::Y.to_vector(), Direction::X.to_vector()));
}

#[test]
fn arrays_count_x_first() {
    let parts = parts(
        "name = 'lamp'\nposition = [1,0,3]\ncosine = { peak_cd = 1 }\n\
         array = { count = [2, 3, 1], step = [0.5, 1, 0] }",
    );
    let found: Vec<_> =
        parts.luminaires.iter().map(|l| (l.name.as_str(), <[f64; 3]>::from(pose(l).0))).collect();
    assert_eq!(found.len(), 6);
    assert_eq!(found[0], ("lamp[0,0,0]", [1.0, 0.0, 3.0]));
    assert_eq!(found[1], ("lamp[1,0,0]", [1.5, 0.0, 3.0]));
    assert_eq!(found[5], ("lamp[1,2,0]", [1.5, 2.0, 3.0]));
}

#[test]
fn directional_light() {
    let sun =
        parts("directional = { illuminance_lx = 1000 }\ndirection = [0, 0, -3]\ndimming = 0.5");
    let LuminaireKind::Directional { direction, illuminance_lx } = sun.luminaires[0].kind else {
        panic!("directional")
    };
    assert_eq!((direction, illuminance_lx), (-Direction::Z, 500.0));
}

#[test]
fn colours_have_luminance_one() {
    let colour = |key: &str| {
        let keys = format!("position = [0,0,1]\nisotropic = {{ intensity_cd = 1 }}\n{key}");
        parts(&keys).luminaires[0].colour
    };
    assert_eq!(colour(""), Rgb::WHITE);
    for key in [
        "colour = 5",
        "colour = [1, 0.5, 0.2]",
        "colour = '#ff8000'",
        "cct_k = 2700",
        "cct_k = 6500",
    ] {
        assert!((colour(key).luminance() - 1.0).abs() < 1e-12, "{key}");
    }
    let warm = colour("cct_k = 2700");
    assert!(warm.0[0] > 1.5 && warm.0[2] < 0.3, "{warm:?}");
}

#[test]
fn groups_in_order_of_declaration_then_of_use() {
    let lamp = |group: &str| {
        format!("[[luminaire]]\nposition = [0,0,1]\nisotropic = {{ intensity_cd = 1 }}\n{group}\n")
    };
    let groups = |text: String| {
        let parts = read(&format!("{text}{FLOOR}"));
        let indices: Vec<_> = parts.luminaires.iter().map(|l| l.group).collect();
        (parts.groups, indices)
    };
    let names = |list: &[&str]| list.iter().map(ToString::to_string).collect::<Vec<_>>();
    assert_eq!(groups(lamp("")), (vec![], vec![0]));
    let two = lamp("group = 'b'") + &lamp("group = 'a'") + &lamp("group = 'b'");
    assert_eq!(groups(two.clone()), (names(&["b", "a"]), vec![0, 1, 0]));
    let declared = format!("[[group]]\nname = 'a'\n{two}");
    assert_eq!(groups(declared), (names(&["a", "b"]), vec![1, 0, 1]));
    assert_eq!(groups(two + &lamp("")), (names(&["ungrouped", "b", "a"]), vec![1, 2, 1, 0]));
}

#[test]
fn wrong_luminaires() {
    let at = "position = [0,0,1]\n";
    for (keys, expected) in [
        ("position = [0,0,1]", "line 2, column 1: luminaire `luminaire 1` has nothing to say"),
        ("isotropic = { intensity_cd = 1 }", "has no position"),
        (
            "AT isotropic = { intensity_cd = 1 }\ncosine = { peak_cd = 1 }",
            "both `isotropic` and `cosine`",
        ),
        ("AT isotropic = {}", "neither of `intensity_cd` and `flux_lm`"),
        ("AT isotropic = { intensity_cd = 1, flux_lm = 1 }", "both of"),
        ("AT isotropic = { intensity_cd = -1 }", "0 or more"),
        ("AT isotropic = { intensity_cd = nan }", "0 or more"),
        ("AT isotropic = { intensity_cd = 1 }\nflux_lm = 2", "without a photometric file"),
        ("AT cosine = { peak_cd = 1, exponent = -1 }", "0 or more"),
        ("AT spot = { peak_cd = 1, inner_deg = 20, outer_deg = 10 }", "half angles"),
        ("AT spot = { peak_cd = 1, inner_deg = 20, outer_deg = 200 }", "at most 180"),
        ("AT isotropic = { intensity_cd = 1 }\ntarget = [0,0,1]", "the target is where"),
        ("AT isotropic = { intensity_cd = 1 }\ndirection = [0,0,0]", "length zero"),
        (
            "AT isotropic = { intensity_cd = 1 }\ndirection = [0,0,1]\ntarget = [1,1,1]",
            "give one of them",
        ),
        ("AT isotropic = { intensity_cd = 1 }\ndimming = -1", "0 or more"),
        ("AT isotropic = { intensity_cd = 1 }\ncct_k = 500", "1000 to 25000"),
        ("AT isotropic = { intensity_cd = 1 }\ncct_k = 3000\ncolour = 1", "give one of them"),
        ("AT isotropic = { intensity_cd = 1 }\ncolour = 0", "black has no colour"),
        (
            "AT isotropic = { intensity_cd = 1 }\narray = { count = [0,1,1], step = [0,0,0] }",
            "count of 0",
        ),
        ("AT isotropic = { intensity_cd = 1 }\narray = { count = [-1,1,1], step = [0,0,0] }", "-1"),
        (
            "AT isotropic = { intensity_cd = 1 }\n\
             array = { count = [4294967295,4294967295,4294967295], step = [0,0,0] }",
            "more than 1000000 luminaires",
        ),
        (
            "AT isotropic = { intensity_cd = 1 }\narray = { count = [1001,1000,1], step = [0,0,0] }",
            "more than 1000000 luminaires",
        ),
        ("directional = { illuminance_lx = 1 }", "without `direction`"),
        (
            "AT directional = { illuminance_lx = 1 }\ndirection = [0,0,-1]",
            "`position` of a directional",
        ),
    ] {
        let keys = keys.replace("AT ", at);
        let found = problems(&format!("# first line\n[[luminaire]]\n{keys}\n{FLOOR}"));
        assert!(found.iter().any(|p| p.contains(expected)), "{keys}: {found:?}");
    }
}
