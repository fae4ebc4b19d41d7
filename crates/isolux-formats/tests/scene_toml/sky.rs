//! `[sky]`, suns with a disc, and skies of `--sky`.

use super::{FLOOR, near, problems, read, read_with};
use isolux::geometry::{Direction, Vector};
use isolux::photometry::{GeneralSky, Sky};
use isolux::scene::{LuminaireKind, Scene, SceneParts};
use isolux::units::Rgb;
use isolux_formats::luminance::{Luminances, encode_exr, encode_radiance};
use isolux_formats::scene_toml::{self, SkyAsked, put_sky};
use isolux_formats::{Loaded, Reach};
use std::f64::consts::PI;

fn parts(sky: &str) -> SceneParts {
    let parts = read(&format!("{FLOOR}[sky]\n{sky}\n"));
    Scene::assemble(parts.clone()).unwrap();
    parts
}

fn warnings(sky: &str) -> String {
    let loaded = read_with(&format!("{FLOOR}[sky]\n{sky}\n"), &[]).unwrap();
    loaded.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

fn sky(parts: &SceneParts) -> (&Sky, [Vector; 3]) {
    let found = parts.luminaires.iter().find_map(|l| match &l.kind {
        LuminaireKind::Sky { world_from_sky, sky } => Some((sky, world_from_sky.columns)),
        _ => None,
    });
    found.unwrap()
}

/// Towards the sun, its illuminance and its half angle.
fn sun(parts: &SceneParts) -> Option<(Vector, f64, f64)> {
    parts.luminaires.iter().find_map(|l| match l.kind {
        LuminaireKind::Directional { direction, illuminance_lx, half_angle_rad } => {
            Some((-direction.to_vector(), illuminance_lx, half_angle_rad))
        }
        _ => None,
    })
}

fn names(parts: &SceneParts) -> Vec<&str> {
    parts.luminaires.iter().map(|l| l.name.as_str()).collect()
}

#[test]
fn skies_by_name_are_as_bright_as_is_said() {
    for (kind, number) in [
        ("overcast", 1),
        ("uniform", 5),
        ("intermediate", 7),
        ("clear", 12),
        ("cie 12", 12),
        ("cie3", 3),
    ] {
        let keys = "horizontal_lx = 12000\nsun = { azimuth_deg = 180, elevation_deg = 40 }\nground_reflectance = 0";
        let parts = parts(&format!("type = '{kind}'\n{keys}"));
        assert_eq!(names(&parts), ["sky"]);
        let (Sky::General { sky, ground_cd_m2 }, _) = sky(&parts) else { panic!() };
        let towards =
            Vector::new(0.0, -libm::cos(40_f64.to_radians()), libm::sin(40_f64.to_radians()));
        let expected = GeneralSky::cie(number, towards.direction().unwrap()).unwrap();
        assert_eq!(
            (sky.gradation, sky.indicatrix),
            (expected.gradation, expected.indicatrix),
            "{kind}"
        );
        assert!((sky.sun.to_vector() - towards).length() < 1e-15);
        assert!((sky.horizontal_lx() / 12_000.0 - 1.0).abs() < 1e-12, "{kind}");
        assert_eq!(*ground_cd_m2, 0.0);
    }
    let zenith = parts("type = 'overcast'\nzenith_cd_m2 = 5000");
    assert!((sky(&zenith).0.luminance_cd_m2(Direction::Z).0[0] / 5000.0 - 1.0).abs() < 1e-12);
    let usual = warnings("type = 'overcast'");
    assert!(usual.contains("nothing says how bright the sky is: 10000 lx are taken"), "{usual}");
    let own = parts(
        "type = 'formula'\ngradation = [0, -1]\nindicatrix = [1, 0, -1, 0]\nhorizontal_lx = 3141.592653589793",
    );
    assert!((sky(&own).0.luminance_cd_m2(Direction::X).0[0] / 1000.0 - 1.0).abs() < 1e-12);
    assert_eq!(own.luminaires[0].colour, Rgb::WHITE);
}

/// Three times as bright in the zenith as at the horizon. A picture of half a degree is as precise as that.
#[test]
fn the_traditional_overcast_sky_is_type_16() {
    let parts = parts("type = 'cie 16'\nhorizontal_lx = 7000\nground_reflectance = 0.5");
    let (sky, _) = sky(&parts);
    let seen = |x, z| sky.luminance_cd_m2(Vector::new(x, 0.0, z).direction().unwrap()).0[0];
    let zenith = 7000.0 * 9.0 / (7.0 * PI);
    assert!((seen(0.0, 1.0) / zenith - 1.0).abs() < 1e-4);
    assert!((seen(1.0, 0.001) / zenith - 1.0 / 3.0).abs() < 5e-3);
    assert!((seen(0.0, -1.0) / (0.5 * 7000.0 / PI) - 1.0).abs() < 1e-6);
}

#[test]
fn the_sun_is_a_disc_that_lights_the_ground() {
    let keys = "horizontal_lx = 10000\nsun = { azimuth_deg = 90, elevation_deg = 30 }\nsun_normal_lx = 80000";
    let parts = parts(&format!("type = 'clear'\n{keys}\nsun_cct_k = 5000"));
    assert_eq!(names(&parts), ["sun", "sky"]);
    let (towards, lx, half_rad) = sun(&parts).unwrap();
    assert!(near(towards, [libm::sqrt(0.75), 0.0, 0.5]));
    assert_eq!((lx, half_rad), (80_000.0, 0.2665_f64.to_radians()));
    let Sky::General { ground_cd_m2, .. } = sky(&parts).0 else { panic!() };
    assert!((ground_cd_m2 / (0.2 * 50_000.0 / PI) - 1.0).abs() < 1e-12, "a fifth of all light");
    assert!(parts.luminaires[0].colour.0[0] > parts.luminaires[0].colour.0[2], "warm");
    let night = warnings(
        "type = 'uniform'\nhorizontal_lx = 1\nsun_normal_lx = 5\nsun = { azimuth_deg = 0, elevation_deg = -3 }",
    );
    assert!(night.contains("the sun is 3.0 degrees below the horizon"), "{night}");
}

#[test]
fn the_sun_follows_place_and_time() {
    // As pvlib has it: azimuth 149.339, elevation 58.172.
    let place =
        "place = { latitude_deg = 52.5, longitude_deg = 13.4 }\ntime = 2026-06-21T12:00:00+02:00";
    let found =
        parts(&format!("type = 'clear'\nhorizontal_lx = 1e4\nsun_normal_lx = 1e5\n{place}"));
    let towards = sun(&found).unwrap().0;
    let azimuth_deg = libm::atan2(towards.x, towards.y).to_degrees();
    assert!((azimuth_deg - 149.339).abs() < 2e-3, "{azimuth_deg}");
    assert!((libm::asin(towards.z).to_degrees() - 58.172).abs() < 2e-3);
    let turned = parts(&format!(
        "type = 'clear'\nhorizontal_lx = 1e4\nsun_normal_lx = 1e5\n{place}\nnorth_deg = 90"
    ));
    // North is +x, and the sun goes with it.
    let [x, y, z] = <[f64; 3]>::from(towards);
    assert!(near(sun(&turned).unwrap().0, [y, -x, z]));
    assert!(near(sky(&turned).1[1], [1.0, 0.0, 0.0]));
}

#[test]
fn north_where_y_is_up() {
    let text = format!(
        "up = 'y'\n{}[sky]\ntype = 'clear'\nhorizontal_lx = 1e4\nsun_normal_lx = 1e5\nsun = {{ azimuth_deg = 0, elevation_deg = 0.001 }}\n",
        FLOOR.replace("v = [0, 1, 0]", "v = [0, 0, -1]")
    );
    let towards = sun(&read(&text)).unwrap().0;
    assert!(near(towards, [0.0, libm::sin(0.001_f64.to_radians()), -1.0]), "{towards:?}");
}

#[test]
fn skies_by_irradiance() {
    let keys = "direct_normal_w_m2 = 700\ndiffuse_horizontal_w_m2 = 110\nsun = { azimuth_deg = 180, elevation_deg = 60 }";
    let parts =
        parts(&format!("type = 'perez'\n{keys}\ntime = 2026-05-30T12:00:00Z\ndew_point_c = 10.97"));
    // gendaylit: 72412.6 lx with four digits of the sun, and the sky by efficacies.
    assert!((sun(&parts).unwrap().1 / 72_412.6 - 1.0).abs() < 1e-3);
    let lx = sky(&parts).0.horizontal_lx();
    assert!((110.0 * 110.0..110.0 * 150.0).contains(&lx), "{lx}");
    let dark = read(&format!("{FLOOR}[sky]\n{keys}\nsun_normal_lx = 0\n"));
    assert_eq!(names(&dark), ["sky"], "the type follows from the keys");
}

/// A week of hours, each as bright as it is late.
fn weather() -> String {
    let mut text = String::from(
        "LOCATION,Berlin,-,DEU,Test,103840,52.47,13.40,1.0,49.0\nDESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\n\
         GROUND TEMPERATURES,0\nHOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,none\nCOMMENTS 2,none\n\
         DATA PERIODS,1,1,Data,Sunday,6/18,6/24\n",
    );
    for day in 18..25 {
        for hour in 1..25 {
            let (direct, diffuse) = (10 * hour, hour);
            text += &format!(
                "2001,6,{day},{hour},0,?9,20,11,50,101325,0,0,300,{},{direct},{diffuse},0,0,999999,0\n",
                direct + diffuse
            );
        }
    }
    text
}

#[test]
fn skies_by_weather_files() {
    let read = |keys: &str| {
        let text = format!("{FLOOR}[sky]\nweather = 'berlin.epw'\n{keys}\n");
        read_with(&text, &[("berlin.epw", &weather())])
    };
    // Between the hours that end at 12 and at 13.
    let loaded = read("time = 2026-06-21T12:00:00").unwrap();
    assert!(
        loaded.warnings.iter().any(|w| w.what.contains("has 168 hours")),
        "{:?}",
        loaded.warnings
    );
    let by_hand = parts(
        "type = 'perez'\ndirect_normal_w_m2 = 125\ndiffuse_horizontal_w_m2 = 12.5\ndew_point_c = 11\n\
         place = { latitude_deg = 52.47, longitude_deg = 13.40 }\ntime = 2026-06-21T12:00:00+01:00",
    );
    let [a, b] =
        [&loaded.value, &by_hand].map(|parts| (sun(parts).unwrap(), sky(parts).0.horizontal_lx()));
    // Fifty metres above the sea change nothing that could be seen.
    assert!((a.0.0 - b.0.0).length() < 1e-6 && (a.1 / b.1 - 1.0).abs() < 1e-6, "{a:?} {b:?}");
    let gone = read("time = 2026-07-01T12:00:00").unwrap_err().to_string();
    assert!(gone.contains("`berlin.epw` has no light of that hour"), "{gone}");
    let summer = read("time = 2026-06-21T12:00:00+02:00").unwrap_err().to_string();
    assert!(summer.contains("the file's is 1 h ahead"), "{summer}");
    let untimed = read("").unwrap_err().to_string();
    assert!(untimed.contains("without its file or its time"), "{untimed}");
}

#[test]
fn skies_by_pictures() {
    let rgb = vec![[2.0_f32, 1.0, 0.5]; 32];
    let picture = Luminances { width: 8, height: 4, rgb_cd_m2: &rgb };
    let (exr, hdr) = (encode_exr(&picture).unwrap(), encode_radiance(&picture).unwrap());
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("sky.exr"), exr).unwrap();
    std::fs::write(home.path().join("sky.hdr"), hdr).unwrap();
    let read = |keys: &str| {
        let path = home.path().join("scene.toml");
        std::fs::write(&path, format!("{FLOOR}[sky]\n{keys}\n")).unwrap();
        scene_toml::read(&path)
    };
    let seen = |keys: &str| {
        let parts = read(keys).unwrap().value;
        sky(&parts).0.luminance_cd_m2(Direction::X).0
    };
    assert_eq!(seen("picture = 'sky.exr'"), [2.0, 1.0, 0.5], "the file says cd/m2");
    assert_eq!(seen("picture = 'sky.exr'\nluminance_factor = 3"), [6.0, 3.0, 1.5]);
    for (found, due) in
        seen("picture = 'sky.hdr'\nluminance_factor = 179").into_iter().zip([2.0, 1.0, 0.5])
    {
        // Eight bits of a mantissa.
        assert!((found - due).abs() < 0.01, "{found} {due}");
    }
    let level = seen("picture = 'sky.hdr'\nhorizontal_lx = 10000");
    assert!((PI * Rgb(level).luminance() / 10_000.0 - 1.0).abs() < 1e-5);
    let unknown = read("picture = 'sky.hdr'").unwrap_err().to_string();
    assert!(unknown.contains("does not say how bright it is"), "{unknown}");
    let broken = read("picture = 'scene.toml'\nluminance_factor = 1").unwrap_err().to_string();
    assert!(
        broken.contains("`scene.toml` cannot be used") && broken.contains("neither OpenEXR nor"),
        "{broken}"
    );
}

#[test]
fn skies_have_groups() {
    let lamp = "[[luminaire]]\nposition = [0, 0, 1]\nisotropic = { intensity_cd = 1 }\n";
    let keys = "type = 'uniform'\nsun_normal_lx = 1\nsun = { azimuth_deg = 0, elevation_deg = 9 }\nhorizontal_lx = 1";
    let of = |text: &str| {
        let parts = read(text);
        let groups = parts.luminaires.iter().map(|l| parts.groups.get(l.group as usize).cloned());
        groups.map(Option::unwrap_or_default).collect::<Vec<_>>()
    };
    assert_eq!(of(&format!("{FLOOR}{lamp}[sky]\n{keys}")), ["", "", ""]);
    let day = of(&format!("{FLOOR}{lamp}[sky]\n{keys}\ngroup = 'day'"));
    assert_eq!(day, ["ungrouped", "day", "day"]);
    let two = of(&format!("{FLOOR}{lamp}[sky]\n{keys}\ngroup = 'day'\nsun_group = 'sun'"));
    assert_eq!(two, ["ungrouped", "sun", "day"]);
    let alone = of(&format!("{FLOOR}[sky]\n{keys}\ngroup = 'day'"));
    assert_eq!(alone, ["day", "day"]);
}

#[test]
fn what_is_wrong_has_its_place() {
    let told = |sky: &str| problems(&format!("[sky]\n{sky}\n{FLOOR}")).join("\n");
    for (sky, expected) in [
        ("type = 'blue'", "line 2, column 8: there is no sky `blue`"),
        ("horizontal_lx = 5", "the sky has no `type`"),
        ("type = 'cie 17'", "there is no sky `cie 17`"),
        ("type = 'overcast'\nhorizontal_lux = 5", "line 3, column 1: unknown key `horizontal_lux`"),
        ("type = 'overcast'\nhorizontal_lx = -5", "out of range"),
        (
            "type = 'overcast'\nhorizontal_lx = 5\nzenith_cd_m2 = 5",
            "`horizontal_lx` and `zenith_cd_m2`",
        ),
        ("type = 'overcast'\nweather = 'a.epw'", "`weather` of a sky of this type"),
        ("type = 'clear'\nhorizontal_lx = 5", "brighter about the sun, which is not given"),
        ("type = 'perez'\ndirect_normal_w_m2 = 5", "not all given"),
        ("type = 'uniform'\nhorizontal_lx = 5\nsun_normal_lx = 5", "a sun that stands nowhere"),
        (
            "type = 'uniform'\nhorizontal_lx = 5\ntime = 2026-06-21T12:00:00Z",
            "`time` without `place`",
        ),
        (
            "type = 'uniform'\nhorizontal_lx = 5\nplace = { latitude_deg = 0, longitude_deg = 0 }\ntime = 2026-06-21T12:00:00",
            "line 5, column 8: a time whose clock is not known",
        ),
        (
            "type = 'uniform'\nhorizontal_lx = 5\nplace = { latitude_deg = 95, longitude_deg = 0 }\ntime = 2026-06-21T12:00:00Z",
            "latitude 95",
        ),
        (
            "type = 'uniform'\nhorizontal_lx = 5\nsun = { azimuth_deg = 0, elevation_deg = 91 }",
            "elevation 91",
        ),
        (
            "type = 'weather'\nweather = 'gone.epw'\ntime = 2026-06-21T12:00:00",
            "`gone.epw` does not exist",
        ),
        ("type = 'formula'\nhorizontal_lx = 5", "a formula without its parameters"),
    ] {
        let found = told(sky);
        assert!(found.contains(expected), "{sky}: {found}");
    }
    let list = problems(&format!("{FLOOR}[[sky]]\ntype = 'uniform'\n")).join("\n");
    assert!(list.contains("write `[sky]`"), "{list}");
    let wide = "[[luminaire]]\ndirection = [0, 0, -1]\ndirectional = { illuminance_lx = 1, angle_deg = 200 }\n";
    assert!(problems(&format!("{wide}{FLOOR}")).join("").contains("an `angle_deg` of 200"));
    for (sky, expected) in [
        ("{ gradation = [0, -1] }", "neither a formula nor a picture"),
        (
            "{ gradation = [0, -1], indicatrix = [1, 0, 0, 0], scale_cd_m2 = 1, axes = [[1, 0, 0], [1, 0, 0], [0, 0, 1]] }",
            "`axes` that are no turn",
        ),
    ] {
        let found = problems(&format!("[[luminaire]]\nsky = {sky}\n{FLOOR}")).join("\n");
        assert!(found.contains(expected), "{found}");
    }
}

fn written_again(parts: &SceneParts) -> SceneParts {
    let home = tempfile::tempdir().unwrap();
    for file in scene_toml::write(parts, &[]).unwrap() {
        std::fs::write(home.path().join(&file.name), &file.bytes).unwrap();
    }
    let Loaded { value, warnings } = scene_toml::read(&home.path().join("scene.toml")).unwrap();
    assert_eq!(warnings, []);
    value
}

/// Bit by bit: formulas, pictures, turned and tilted ones, discs; among luminaires in any order.
#[test]
fn skies_are_written_and_read_again() {
    let clear = "type = 'clear'\nhorizontal_lx = 12345.6\nsun_normal_lx = 80000\nsun_cct_k = 5000\n\
                 place = { latitude_deg = 52.5, longitude_deg = 13.4 }\ntime = 2026-06-21T12:00:00+02:00\ngroup = 'day'";
    for sky in [
        clear.to_owned(),
        format!("{clear}\nnorth_deg = 33.3"),
        format!("{clear}\nnorth_deg = -120"),
        "type = 'cie 16'\nhorizontal_lx = 7000".to_owned(),
    ] {
        for up in ["y", "z"] {
            let text = format!(
                "up = '{up}'\n[[luminaire]]\ndirection = [0.1, 0.2, -0.3]\ndirectional = {{ illuminance_lx = 5, angle_deg = 0.53 }}\n\
                 {FLOOR}[sky]\n{sky}\n"
            );
            let mut parts = read(&text);
            parts.luminaires.rotate_left(1);
            let again = written_again(&parts);
            assert_eq!(again.luminaires, parts.luminaires, "{text}");
            assert_eq!(again.groups, parts.groups);
        }
    }
    let mut tilted = parts("type = 'uniform'\nhorizontal_lx = 5");
    let LuminaireKind::Sky { world_from_sky, .. } = &mut tilted.luminaires[0].kind else {
        panic!()
    };
    world_from_sky.columns = [[0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [-0.8, 0.0, 0.6]].map(Vector::from);
    assert_eq!(written_again(&tilted).luminaires, tilted.luminaires);
}

fn asked(parts: &mut SceneParts, words: &str) -> Result<String, String> {
    let told = put_sky(parts, &SkyAsked::parse(words), Reach::Inside);
    let told = told.map_err(|problems| problems.to_string())?;
    Ok(told.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
}

#[test]
fn a_sky_is_asked_for_beside_any_scene() {
    let lamp = "[[luminaire]]\nname = 'lamp'\nposition = [0, 0, 1]\nisotropic = { intensity_cd = 1 }\n\
                [[luminaire]]\nname = 'old sun'\ndirection = [0, 0, -1]\ndirectional = { illuminance_lx = 5 }\n";
    let mut scene = read(&format!("{FLOOR}{lamp}"));
    let words = "clear, horizontal_lx=1e4, sun={azimuth_deg=180, elevation_deg=40}, sun_normal_lx=9e4, group=day";
    let told = asked(&mut scene, words).unwrap();
    assert!(told.contains("--sky: stands in place of") && told.contains("`old sun`"), "{told}");
    assert_eq!(names(&scene), ["lamp", "sun", "sky"]);
    assert_eq!(scene.groups, ["ungrouped", "day"]);
    assert_eq!(scene.luminaires.iter().map(|l| l.group).collect::<Vec<_>>(), [0, 1, 1]);
    Scene::assemble(scene.clone()).unwrap();
    let before = scene.clone();
    let wrong = asked(&mut scene, "cloudy, horizontal_lx=3").unwrap_err();
    assert!(wrong.contains("--sky: there is no sky `cloudy`"), "{wrong}");
    assert_eq!(scene, before, "a wrong sky changes nothing");
    let bright = asked(&mut scene, "uniform, horizontal_lx=1e15").unwrap_err();
    assert!(bright.contains("luminaire `sky`"), "{bright}");
    let home = tempfile::tempdir().unwrap();
    let file = home.path().join("day.toml");
    for text in [
        "type = 'uniform'\nhorizontal_lx = 3",
        "name = 'other'\n[sky]\ntype = 'uniform'\nhorizontal_lx = 3",
    ] {
        std::fs::write(&file, text).unwrap();
        let mut scene = before.clone();
        asked(&mut scene, file.to_str().unwrap()).unwrap();
        assert_eq!(names(&scene), ["lamp", "sky"]);
    }
    std::fs::write(&file, "type = 'uniform'\nhorizon = 3").unwrap();
    let wrong = asked(&mut scene, file.to_str().unwrap()).unwrap_err();
    assert!(wrong.contains("day.toml: line 2, column 1: unknown key `horizon`"), "{wrong}");
}
