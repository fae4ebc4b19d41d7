//! Luminaires and groups.

use super::{FLOOR, problems, read, read_with};
use isolux::geometry::{Direction, Point, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{AreaShape, Luminaire, LuminaireKind, Scene, SceneParts};
use isolux::units::Rgb;
use isolux_formats::Problems;
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
    // Regression: the line that names a broken file was not told.
    let Problems(broken) = scene("ies = 'scene.toml'").unwrap_err();
    assert_eq!(broken[0].place, "line 3, column 7");
    assert!(broken[0].what.contains("`scene.toml` cannot be used"), "{}", broken[0]);
    assert!(broken.len() > 1 && broken[1].place != broken[0].place, "{broken:?}");
    assert!(scene("ldt = 'lamp.ies'").is_err());
}

/// A table that holds more than the lamps give, which is of no concern where the flux is given.
#[test]
fn doubts_of_a_flux_that_is_replaced_are_not_told() {
    let ies = "IESNA:LM-63-2002\nTILT=NONE\n1 100 1 3 1 1 2 0 0 0\n1 1 20\n0 45 90\n0\n300 200 0\n";
    let own = "[[luminaire]]\nposition = [0,0,1]\nies = 'lamp.ies'\n";
    let given = format!("{own}flux_lm = 500\n");
    for (text, expected) in [
        (given.clone(), 0),
        (own.to_owned(), 1),
        (format!("{own}maintenance_factor = 0.8\n"), 1),
        (format!("{given}{own}{own}"), 1),
    ] {
        let loaded = read_with(&format!("{text}{FLOOR}"), &[("lamp.ies", ies)]).unwrap();
        assert_eq!(loaded.warnings.len(), expected, "{text}: {:?}", loaded.warnings);
    }
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
    let LuminaireKind::Directional { direction, illuminance_lx, .. } = sun.luminaires[0].kind
    else {
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

const LAMP: &str =
    "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0.2 0.4 0\n1 1 20\n0 45 90\n0\n300 200 0\n";

fn with_library(scene: &str, library: &str) -> Result<SceneParts, String> {
    let text = format!("libraries = ['lamps.toml']\n{scene}\n{FLOOR}");
    let read = read_with(&text, &[("lamps.toml", library), ("lamp.ies", LAMP)]);
    read.map(|loaded| loaded.value).map_err(|problems| problems.to_string())
}

#[test]
fn luminaires_of_a_library_are_hung_by_name() {
    let library = "[luminaires.panel]\nies = 'lamp.ies'\ncct_k = 4000\nmaintenance_factor = 0.8\n\
                   [luminaires.bulb]\nisotropic = { flux_lm = 800 }\n[luminaires.unused]\nies = 'gone.ies'\n";
    let scene = "[[luminaire]]\ntype = 'panel'\nposition = [0,0,3]\n\
                 [[luminaire]]\ntype = 'panel'\nposition = [1,0,3]\ndimming = 0.5\nmaintenance_factor = 0.9\n\
                 cct_k = 3000\ngroup = 'desk'\n\
                 [[luminaire]]\ntype = 'bulb'\nposition = [2,0,3]\n\
                 [[luminaire]]\ntype = 'panel'\nposition = [3,0,3]\nflux_lm = 1000\n";
    let parts = with_library(scene, library).unwrap();
    let flux = |k: usize| match &parts.luminaires[k].kind {
        LuminaireKind::Point { intensity, .. } => intensity.luminous_flux_lm(),
        other => panic!("{other:?}"),
    };
    let bare = read_with(
        &format!("[[luminaire]]\nies = 'lamp.ies'\nposition = [0,0,1]\n{FLOOR}"),
        &[("lamp.ies", LAMP)],
    );
    let bare = Scene::assemble(bare.unwrap().value).unwrap().luminous_flux_lm();
    // Products of a few factors.
    for (found, expected) in
        [(flux(0), 0.8 * bare), (flux(1), 0.45 * bare), (flux(2), 800.0), (flux(3), 800.0)]
    {
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} against {expected}");
    }
    assert_eq!(parts.groups, ["ungrouped", "desk"]);
    let scene = Scene::assemble(parts.clone()).unwrap();
    assert_eq!(scene.groups(), parts.groups);
    assert_eq!(scene.luminaires().iter().map(|l| l.group).collect::<Vec<_>>(), [0, 1, 0, 0]);
    let colours: Vec<Rgb> = parts.luminaires.iter().map(|l| l.colour).collect();
    assert_eq!((colours[0], colours[2]), (colours[3], Rgb::WHITE));
    assert!(colours[1].0[0] > colours[0].0[0], "3000 K is redder than 4000 K: {colours:?}");
}

#[test]
fn problems_of_libraries_have_their_place() {
    let hung = "[[luminaire]]\ntype = 'panel'\nposition = [0,0,3]\n";
    for (scene, library, expected) in [
        (
            hung,
            "[luminaires.panel]\nies = 'lamp.ies'\nwattage = 5\n",
            "lamps.toml: line 3, column 1: unknown key `wattage`",
        ),
        (hung, "[lamps.panel]\n", "lamps.toml: line 1, column 2: unknown key `lamps`"),
        (hung, "[luminaires.panel\n", "lamps.toml: line 1"),
        (
            hung,
            "[luminaires.panel]\nies = 'gone.ies'\n",
            "lamps.toml: line 2, column 7: file `gone.ies` does not exist",
        ),
        (
            hung,
            "[luminaires.panel]\nmaintenance_factor = 1.2\n",
            "line 2, column 22: 1.2 is out of range",
        ),
        (
            hung,
            "[luminaires.panel]\ncct_k = 3000\n",
            "lamps.toml: line 1, column 1: luminaire `panel` has nothing to say",
        ),
        (
            hung,
            "[luminaires.spot]\nies = 'lamp.ies'\n",
            "scene.toml: line 3, column 8: no luminaire `panel`; the libraries have `spot`",
        ),
        ("libraries = 3\n", "", "duplicate key"),
    ] {
        let found = with_library(scene, library).unwrap_err();
        assert!(found.contains(expected), "no {expected:?} in {found:?}");
    }
    let twice = format!("libraries = ['a.toml', 'b.toml', 'c.toml']\n{FLOOR}");
    let entry = "[luminaires.x]\nisotropic = { flux_lm = 1 }\n";
    let found = read_with(&twice, &[("a.toml", entry), ("b.toml", entry)]).unwrap_err().to_string();
    assert!(found.contains("line 1, column 34: file `c.toml` does not exist"), "{found}");
    assert!(
        found.contains("b.toml: line 1, column 13: another library has a luminaire `x`"),
        "{found}"
    );
    let outside = read_with(&format!("libraries = ['../x.toml']\n{FLOOR}"), &[]).unwrap_err();
    assert!(outside.to_string().contains("line 1, column 14"), "{outside}");
}

#[test]
fn luminaires_of_files_shine_from_their_opening() {
    let scene = |keys: &str| {
        let text = format!("[[luminaire]]\nname = 'l'\nposition = [1,2,3]\n{keys}\n{FLOOR}");
        let ldt = "m\n3\n1\n1\n0\n2\n90\nr\nl\nn\nf\nd\n0\n0\n0\n600\n0\n0\n0\n0\n0\n100\n0\n1\n0\n\
                   1\n1\nLED\n1000\n\n\n\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n90\n100\n0\n";
        read_with(&text, &[("lamp.ies", LAMP), ("lamp.ldt", ldt)])
    };
    let area = |keys: &str| {
        let parts = scene(keys).unwrap_or_else(|p| panic!("{p}")).value;
        let [luminaire] = &parts.luminaires[..] else { panic!("one luminaire") };
        luminaire.kind.area().map(|area| (area.shape, area.half_m))
    };
    // Length 0.4 m along C0, width 0.2 m; a disc of 0.6 m.
    assert_eq!(area("ies = 'lamp.ies'"), Some((AreaShape::Box, [0.2, 0.1, 0.0])));
    assert_eq!(area("ldt = 'lamp.ldt'"), Some((AreaShape::CylinderZ, [0.3, 0.3, 0.0])));
    assert_eq!(area("ies = 'lamp.ies'\nluminous_area = 'point'"), None);
    let given = "luminous_area = { shape = 'ellipsoid', size_m = [0.2, 0.2, 0.4] }";
    for light in ["ies = 'lamp.ies'", "isotropic = { flux_lm = 1 }"] {
        let found = area(&format!("{light}\n{given}"));
        assert_eq!(found, Some((AreaShape::Ellipsoid, [0.1, 0.1, 0.2])));
    }
    for (keys, expected) in [
        ("ies = 'lamp.ies'\nluminous_area = 'wide'", "line 5, column 17: "),
        ("ies = 'lamp.ies'\nluminous_area = { shape = 'box', size_m = [1, -1, 0] }", "line 5"),
        ("directional = { illuminance_lx = 1 }\nluminous_area = 'point'", "`luminous_area` of a"),
    ] {
        let found = scene(keys).unwrap_err().to_string();
        assert!(found.contains(expected), "no {expected:?} in {found:?}");
    }
}

#[test]
fn lamp_sets_are_chosen_by_number() {
    let ldt = "m\n3\n1\n1\n0\n2\n90\nr\nl\nn\nf\nd\n0\n0\n0\n0\n0\n0\n0\n0\n0\n100\n0\n1\n0\n\
               2\n1\nLED\n1000\n\n\n\n1\nLED\n3000\n\n\n\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n90\n100\n0\n";
    let scene = |keys: &str| {
        let text = format!("[[luminaire]]\nposition = [0,0,1]\n{keys}\n{FLOOR}");
        read_with(&text, &[("lamp.ldt", ldt), ("lamp.ies", LAMP)])
    };
    let flux = |keys: &str| Scene::assemble(scene(keys).unwrap().value).unwrap().luminous_flux_lm();
    let (first, second) = (flux("ldt = 'lamp.ldt'"), flux("ldt = 'lamp.ldt'\nlamp_set = 2"));
    // Products with 1 and 3.
    assert!((second / first - 3.0).abs() < 1e-14, "{first} {second}");
    for (keys, expected) in [
        ("ldt = 'lamp.ldt'\nlamp_set = 3", "line 4, column 12: lamp.ldt has no lamp set 3"),
        ("ldt = 'lamp.ldt'\nlamp_set = 0", "line 4, column 12: lamp.ldt has no lamp set 0"),
        ("ies = 'lamp.ies'\nlamp_set = 1", "line 4, column 12: `lamp_set` of a luminaire without"),
        ("isotropic = { flux_lm = 1 }\nlamp_set = 1", "line 4, column 12: `lamp_set` of a"),
    ] {
        let found = scene(keys).unwrap_err().to_string();
        assert!(found.contains(expected), "no {expected:?} in {found:?}");
    }
}

/// The file's power is that of its own flux; what an entry says comes first.
#[test]
fn powers_are_those_of_files_unless_given() {
    let ies = |watts: u32| {
        format!(
            "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 {watts}\n0 45 90\n0\n300 200 0\n"
        )
    };
    let (with, without) = (ies(20), ies(0));
    let powers = |keys: &str| -> Vec<Option<f64>> {
        let text = format!("[[luminaire]]\nposition = [0,0,1]\n{keys}\n{FLOOR}");
        let files = [("lamp.ies", with.as_str()), ("none.ies", without.as_str())];
        let parts = read_with(&text, &files).unwrap().value;
        let scene = Scene::assemble(parts).unwrap();
        assert_eq!(scene.to_parts().fittings, scene.fittings());
        scene.fittings().iter().map(|fitting| fitting.power_w).collect()
    };
    for (keys, expected) in [
        ("ies = 'lamp.ies'", Some(20.0)),
        ("ies = 'lamp.ies'\ndimming = 0.5", Some(20.0)),
        ("ies = 'lamp.ies'\nflux_lm = 900", None),
        ("ies = 'lamp.ies'\nflux_lm = 900\npower_w = 12.5", Some(12.5)),
        ("ies = 'none.ies'", None),
        ("isotropic = { flux_lm = 900 }", None),
        ("isotropic = { flux_lm = 900 }\npower_w = 8", Some(8.0)),
    ] {
        assert_eq!(powers(keys), [expected], "{keys}");
    }
    let array = "isotropic = { flux_lm = 900 }\npower_w = 8\narray = { count = [2, 1, 1], step = [1, 0, 0] }";
    assert_eq!(powers(array), [Some(8.0); 2]);
    for (keys, told) in [
        ("isotropic = { flux_lm = 1 }\npower_w = 0", "power_w = 0"),
        ("directional = { illuminance_lx = 1 }\ndirection = [0,0,-1]\npower_w = 3", "`power_w` of"),
    ] {
        let position = if keys.starts_with("dir") { "" } else { "position = [0,0,1]\n" };
        let found = problems(&format!("[[luminaire]]\n{position}{keys}\n{FLOOR}"));
        assert_eq!(found.len(), 1, "{told}: {found:?}");
    }
}

/// What is known of luminaires stays with them where light is taken apart and put together.
#[test]
fn powers_and_marks_follow_their_luminaires() {
    let lamp = |group: &str, more: &str| {
        format!(
            "[[luminaire]]\nposition = [0,0,1]\nisotropic = {{ intensity_cd = 100 }}\ngroup = '{group}'\n{more}\n"
        )
    };
    let text = lamp("a", "power_w = 5")
        + &lamp("b", "power_w = 7\nemergency = true")
        + &lamp("b", "emergency_flux_share = 0.25");
    let scene = Scene::assemble(read(&format!("{text}{FLOOR}"))).unwrap();
    let powers = |scene: &Scene| -> Vec<Option<f64>> {
        scene.fittings().iter().map(|fitting| fitting.power_w).collect()
    };
    assert_eq!(powers(&scene), [Some(5.0), Some(7.0), None]);
    let [a, b] = [0, 1].map(|group| scene.lit_by(group).unwrap());
    assert_eq!((powers(&a), powers(&b)), (vec![Some(5.0)], vec![Some(7.0), None]));
    assert_eq!(powers(&Scene::mixed(&[(&b, 1.0), (&a, 0.5)])), [Some(7.0), None, Some(5.0)]);
    let emergency = scene.in_emergency().unwrap();
    let candela = |luminaire: &Luminaire| match &luminaire.kind {
        LuminaireKind::Point { intensity, .. } => intensity.max_intensity_cd(),
        other => panic!("{other:?}"),
    };
    assert_eq!(emergency.luminaires().iter().map(candela).collect::<Vec<_>>(), [100.0, 25.0]);
    assert!(a.in_emergency().is_none());
    let reflects = |scene: &Scene| {
        scene.material(0).finish(false).is_some_and(|f| !f.diffuse.colour.is_black())
    };
    assert!(reflects(&scene) && !reflects(&emergency));
    // What hashes stand for is light.
    let bare = Scene::assemble(SceneParts { fittings: Vec::new(), ..scene.to_parts() }).unwrap();
    assert_eq!((bare.hash(), powers(&bare)), (scene.hash(), vec![None; 3]));
}
