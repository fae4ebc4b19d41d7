//! Radiance scenes: materials, surfaces, commands, light, and hostile files.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

use isolux::geometry::{Point, Vector};
use isolux::photometry::Sky;
use isolux::scene::{Body, Luminaire, LuminaireKind, Scene, SceneParts, UpAxis};
use isolux::units::Rgb;
use isolux_formats::{Loaded, Problems, Reach, load, rad};

const FACE: &str = "polygon f 0 0 9  0 0 0  1 0 0  0 1 0\n";

/// Reads `scene.rad` beside other files.
fn read_with(text: &str, files: &[(&str, &str)]) -> Result<Loaded<SceneParts>, Problems> {
    let dir = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::create_dir_all(dir.path().join(name).parent().unwrap()).unwrap();
        std::fs::write(dir.path().join(name), text).unwrap();
    }
    let path = dir.path().join("scene.rad");
    std::fs::write(&path, text).unwrap();
    rad::read(&path)
}

fn read(text: &str) -> SceneParts {
    read_with(text, &[]).unwrap_or_else(|p| panic!("{p}")).value
}

#[track_caller]
fn refused(text: &str, expected: &str) {
    refused_with(text, &[], expected);
}

#[track_caller]
fn refused_with(text: &str, files: &[(&str, &str)], expected: &str) {
    let message = read_with(text, files).unwrap_err().to_string();
    assert!(message.contains(expected), "{message}");
}

/// The body of a material on a triangle, and the warnings.
fn material(type_: &str, arguments: &str) -> (Body, String) {
    let count = arguments.split_whitespace().count();
    let text = format!("void {type_} m 0 0 {count} {arguments}\nm {FACE}");
    let loaded = read_with(&text, &[]).unwrap_or_else(|p| panic!("{p}"));
    let warnings: Vec<_> = loaded.warnings.iter().map(ToString::to_string).collect();
    (loaded.value.materials[0].body.clone(), warnings.join("\n"))
}

#[track_caller]
fn near(a: f64, b: f64) {
    // A few dozen roundings.
    assert!((a - b).abs() <= 1e-12 * b.abs().max(1.0), "{a} {b}");
}

/// As `oconv materials.rad room/room.rad` reads them: with the materials of the first, and data beside either.
#[test]
fn several_files_are_one_scene() {
    let dir = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = dir.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
        path
    };
    let materials = file("library/materials.rad", "void plastic paint 0 0 5 .5 .5 .5 0 0\n");
    let room = file("project/room.rad", &format!("paint {FACE}!xform -t 0 0 1 parts/more.rad\n"));
    file("project/parts/more.rad", &format!("paint {FACE}"));
    let parts = rad::read_several(&[&materials, &room], Reach::Inside).unwrap().value;
    assert_eq!((parts.name.as_str(), parts.materials.len()), ("materials", 1));
    assert_eq!(parts.shapes.iter().map(|shape| shape.triangles.len()).sum::<usize>(), 2);
    let turned = rad::read_several(&[&room, &materials], Reach::Inside).unwrap_err().to_string();
    assert!(turned.contains("`paint` is not defined before it is used"), "{turned}");
    let gone = dir.path().join("gone.rad");
    let wrong = isolux_formats::load_several(&[&materials, &gone], Reach::Inside).unwrap_err();
    assert!(wrong.to_string().contains("gone.rad: does not exist"), "{wrong}");
    let other = dir.path().join("room.obj");
    let wrong = isolux_formats::load_several(&[&materials, &other], Reach::Inside).unwrap_err();
    assert!(wrong.to_string().contains("room.obj: is no Radiance file"), "{wrong}");
}

#[test]
fn plastic_and_metal_share_out_their_light() {
    let (Body::Opaque { front, back }, _) = material("plastic", ".5 .4 .2 .1 0") else { panic!() };
    assert_eq!(front, back);
    assert_eq!(front.diffuse.colour, Rgb::new(0.5, 0.4, 0.2) * 0.9);
    assert_eq!((front.mirror, front.gloss), (Rgb::grey(0.1), None));
    let (Body::Opaque { front, .. }, _) = material("metal", ".5 .4 .2 .9 .2") else { panic!() };
    let gloss = front.gloss.unwrap();
    assert_eq!((gloss.f0, gloss.alpha), (Rgb::new(0.5, 0.4, 0.2) * 0.9, 0.2));
    assert!(front.mirror.is_black());
    let (Body::Opaque { front, back }, _) = material("mirror", ".8 .7 .6") else { panic!() };
    assert_eq!((front.mirror, back.mirror), (Rgb::new(0.8, 0.7, 0.6), Rgb::new(0.8, 0.7, 0.6)));
}

#[test]
fn glass_and_what_passes_light() {
    let (Body::Dielectric(glass), told) = material("glass", ".9 .8 .7") else { panic!() };
    assert_eq!((glass.ior, glass.thin), (1.52, true));
    assert_eq!((glass.transmittance, told.as_str()), (Rgb::new(0.9, 0.8, 0.7), ""));
    let (Body::Dielectric(body), told) = material("dielectric", "1 1 1 1.5 0") else { panic!() };
    assert_eq!((body.ior, body.thin, told.as_str()), (1.5, false, ""));
    let (_, told) = material("dielectric", ".9 .9 .9 1.5 3");
    assert!(told.contains("absorption is left out") && told.contains("dispersion"), "{told}");
    let (Body::Dielectric(film), _) = material("trans", ".5 .5 .5 0 0 1 1") else { panic!() };
    assert_eq!((film.ior, film.transmittance), (1.0, Rgb::grey(0.5)));
    let (Body::Opaque { front, .. }, told) = material("trans", ".8 .8 .8 .1 0 .5 0") else {
        panic!()
    };
    near(front.diffuse.colour.0[0], 0.8 * 0.9 * 0.5);
    assert!(told.contains("trans `m` transmits a share of 0.3600"), "{told}");
}

#[test]
fn lights_shine_to_the_front_with_179_lumens_a_watt() {
    let (Body::Opaque { front, back }, told) = material("light", "10 5 1") else { panic!() };
    near(front.luminance_cd_m2.luminance(), 179.0 * (2.65 + 3.35 + 0.065));
    near(front.luminance_cd_m2.0[0] / front.luminance_cd_m2.0[2], 10.0);
    assert!(!back.is_emitter() && front.diffuse.colour.is_black());
    assert!(told.contains("line 2: radiances are read as luminances of 179 lm/W"), "{told}");
    let (Body::Opaque { front, .. }, told) = material("glow", "1 1 1 -1") else { panic!() };
    assert!(!front.is_emitter() && told.contains("lights nothing"), "{told}");
}

#[test]
fn round_lights_keep_their_flux() {
    let text = "void light l 0 0 3 1 1 1\nl sphere s 0 0 4 1 1 1 .2\nl ring r 0 0 8 0 0 3 0 0 -1 0 .5\n\
                l cylinder c 0 0 7 0 0 1 0 0 2 .01\n";
    let scene = Scene::assemble(read(text)).unwrap();
    let areas: Vec<f64> = scene.area_luminaires().iter().map(|l| l.area_m2).collect();
    let due = [0.16, 0.25, 0.02].map(|area| area * std::f64::consts::PI);
    assert_eq!(areas.len(), 3);
    // The kernel keeps coordinates in single precision.
    areas.iter().zip(due).for_each(|(a, b)| assert!((a / b - 1.0).abs() < 1e-5, "{a} {b}"));
}

#[test]
fn names_stand_for_what_was_defined_last() {
    let text = format!(
        "void plastic a 0 0 5 .1 .1 .1 0 0\nvoid alias b a\nvoid plastic a 0 0 5 .2 .2 .2 0 0\n\
         a {FACE}b {FACE}inherit alias c b\nc {FACE}"
    );
    let parts = read(&text);
    let of = |k: usize| parts.materials[parts.shapes[k].material as usize].finish(false).unwrap();
    let colours: Vec<f64> = (0..3).map(|k| of(k).diffuse.colour.0[0]).collect();
    assert_eq!((colours, parts.up), (vec![0.2, 0.1, 0.1], UpAxis::Z));
}

/// Positions are those that Radiance's `xform` prints for these arguments.
#[test]
fn arrays_stand_where_xform_puts_them() {
    let chair = "void plastic m 0 0 5 .5 .5 .5 0 0\n!genbox m box .4 .5 .6\n";
    let text = "!xform -n c -rz 30 -t 1 .6 0.002 -a 2 -t 1.4 0.3 0 chair.rad\n";
    let parts = read_with(text, &[("chair.rad", chair)]).unwrap().value;
    let names: Vec<_> = parts.shapes.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["c.0.box", "c.1.box"]);
    for corner in [
        [2.74641016151, 1.1, 0.602],
        [2.49641016151, 1.53301270189, 0.002],
        [2.15, 1.33301270189, 0.602],
    ] {
        let distance = |p: &[f64; 3]| (Point::from(*p) - Point::from(corner)).length();
        let nearest = parts.shapes[1].positions.iter().map(distance).fold(f64::MAX, f64::min);
        // Printed in twelve digits.
        assert!(nearest < 1e-10, "{corner:?} {nearest}");
    }
    Scene::assemble(parts).unwrap();
}

/// A box turned, mirrored and nested faces outwards; `-I` turns it inside out.
#[test]
fn fronts_survive_mirrors() {
    let inner = "void plastic m 0 0 5 .5 .5 .5 0 0\n!genbox m b 1 2 3 | xform -mx -rz 20\n\
                 m sphere s 0 0 4 9 0 0 1\nm cone k 0 0 8 0 9 0 0 9 1 .5 0\n";
    for (arguments, outwards) in [("", true), ("-s 2 -my", true), ("-I", false), ("-mz -I", false)]
    {
        let text = format!("!xform {arguments} sub/inner.rad");
        let parts = read_with(&text, &[("sub/inner.rad", inner)]).unwrap().value;
        for shape in &parts.shapes {
            let corner = |k: u32| Vector::from(shape.positions[k as usize]);
            let volume: f64 = (shape.triangles.iter())
                .map(|t| corner(t[0]).dot(corner(t[1]).cross(corner(t[2]))) / 6.0)
                .sum();
            // The cone is open: its volume is that over the origin, of the same sign here.
            assert_eq!(volume > 0.0, outwards, "{arguments} {} {volume}", shape.name);
        }
    }
}

#[test]
fn boxes_with_broken_edges_are_closed() {
    for (option, volume) in [("", 6.0), ("-b .1", 6.0 - 0.02 * 5.4 - 8.0 * 1e-3 * 5.0 / 6.0)] {
        let text = format!("void plastic m 0 0 5 .5 .5 .5 0 0\n!genbox m b 1 2 3 {option}\n");
        let shape = &read(&text).shapes[0];
        let corner = |k: u32| Vector::from(shape.positions[k as usize]);
        let sum: f64 = (shape.triangles.iter())
            .map(|t| corner(t[0]).dot(corner(t[1]).cross(corner(t[2]))) / 6.0)
            .sum();
        assert!((sum - volume).abs() < 1e-9, "{option}: {sum} {volume}");
    }
    let text = "void plastic m 0 0 5 .5 .5 .5 0 0\n!genbox m b 1 2 3 -r .1\n";
    assert_eq!(read(text).shapes.len(), 1 + 12 + 8);
}

#[test]
fn suns_are_discs() {
    let sun = "void light solar 0 0 3 1e6 1e6 1e6\nsolar source sun 0 0 4 0 1 1 .5\n";
    let parts = read(sun);
    let LuminaireKind::Directional { direction, illuminance_lx, half_angle_rad } =
        parts.luminaires[0].kind
    else {
        panic!("a sun is a disc")
    };
    assert_eq!(half_angle_rad, 0.25_f64.to_radians());
    let sin = libm::sin(0.25_f64.to_radians());
    assert!((illuminance_lx / (179e6 * std::f64::consts::PI * sin * sin) - 1.0).abs() < 1e-12);
    near(direction.to_vector().z, -std::f64::consts::FRAC_1_SQRT_2);
}

/// The sky of a scene and the colour of its light.
fn sky_of(text: &str) -> (Sky, Rgb) {
    let mut parts = read(text);
    assert_eq!(parts.luminaires.len(), 1);
    let Luminaire { kind, colour, name, .. } = parts.luminaires.remove(0);
    let LuminaireKind::Sky { sky, .. } = kind else { panic!("a wide source is a sky") };
    assert_eq!(name, "sky");
    (sky, colour)
}

fn seen(sky: &Sky, towards: [f64; 3]) -> f64 {
    sky.luminance_cd_m2(Vector::from(towards).direction().unwrap()).luminance()
}

#[test]
fn wide_sources_are_a_sky() {
    let glow = "void glow g 0 0 4 10 10 10 0\nvoid glow h 0 0 4 2 2 2 0\n";
    let (even, colour) =
        sky_of(&format!("{glow}g source sky 0 0 4 0 0 1 180\nh source ground 0 0 4 0 0 -1 180\n"));
    assert!(matches!(even, Sky::General { .. }));
    near(seen(&even, [1.0, 0.0, 0.1]), 1790.0);
    near(seen(&even, [1.0, 0.0, -0.1]), 358.0);
    near(even.horizontal_lx() / 1790.0, std::f64::consts::PI);
    near(colour.luminance(), 1.0);
    let (half, _) = sky_of(&format!("{glow}g source sky 0 0 4 1 0 0 90\n"));
    // Pixels are in single precision, and half a degree wide.
    assert!((seen(&half, [1.0, 0.6, 0.0]) / 1790.0 - 1.0).abs() < 1e-6);
    assert_eq!(seen(&half, [1.0, 1.2, 0.0]), 0.0);
    let blue = "void glow g 0 0 4 .9 .9 1.15 0\nvoid glow h 0 0 4 1.4 .9 .6 0\n";
    let (two, white) =
        sky_of(&format!("{blue}g source sky 0 0 4 0 0 1 180\nh source ground 0 0 4 0 0 -1 180\n"));
    assert_eq!(white, Rgb::WHITE);
    assert!((seen(&two, [0.0, 0.0, 1.0]) / (179.0 * 0.91625) - 1.0).abs() < 1e-6);
}

/// A sky as gensky writes it, with the sources that its manual names; `rtrace` sees 4566 cd/m2 in the zenith and 785.1 below.
#[test]
fn skies_of_gensky_are_read() {
    let text = "void brightfunc skyfunc 2 skybr skybright.cal 0 3 2 2.784e+01 4.330e+00\n\
                skyfunc glow sky_glow 0 0 4 .9 .9 1.15 0\nsky_glow source sky 0 0 4 0 0 1 180\n\
                skyfunc glow ground_glow 0 0 4 1.4 .9 .6 0\nground_glow source ground 0 0 4 0 0 -1 180\n";
    let (sky, _) = sky_of(text);
    assert!((seen(&sky, [0.0, 0.0, 1.0]) / 4566.0 - 1.0).abs() < 2e-3);
    assert!((seen(&sky, [0.0, 0.0, -1.0]) / 785.1 - 1.0).abs() < 2e-3);
    // `rtrace -I -ab 1` of the same sky.
    assert!((sky.horizontal_lx() / 11_141.0 - 1.0).abs() < 2e-3, "{}", sky.horizontal_lx());
    let glow = text.split_once('\n').unwrap().1;
    let (same, _) = sky_of(&format!("!gensky -ang 40 20 -c\n{glow}"));
    assert!((same.horizontal_lx() / sky.horizontal_lx() - 1.0).abs() < 1e-3);
    refused(&format!("{text}sky_glow {FACE}"), "varies as a sky does, and is no source");
    let other = text.replace("2 skybr skybright.cal", "2 f mine.cal");
    refused(&other, "patterns of lights are not read");
    refused(&text.replace("3 2 2.784e+01 4.330e+00", "1 2"), "does not have the real arguments");
}

#[test]
fn spotlights_keep_the_flux_of_their_cone() {
    let text = "void spotlight s 0 0 7 1 1 1 60 0 0 -1\ns ring r 0 0 8 1 2 3 0 0 -1 0 .1\n";
    let loaded = read_with(text, &[]).unwrap();
    let LuminaireKind::Point { position, intensity, .. } = &loaded.value.luminaires[0].kind else {
        panic!("a spotlight is a point")
    };
    let due = 179.0 * std::f64::consts::PI * 0.01 * std::f64::consts::PI * 0.25;
    near(intensity.luminous_flux_lm(), due);
    near((*position - Point::new(1.0, 2.0, 3.0)).length(), 0.0);
    assert!(loaded.warnings.iter().any(|w| w.what.contains("flux of its cone")));
    let aside = "void spotlight s 0 0 7 1 1 1 60 1 0 -1\ns ring r 0 0 8 1 2 3 0 0 -1 0 .1\n";
    assert!(read_with(aside, &[]).is_ok());
    refused(&aside.replace("60 1 0 -1", "60 1 0 0"), "its cone reaches behind");
}

const TABLE: &str = "2\n0 90 2\n0 180 3\n10 4 2\n10 6 2\n";

/// What `ies2rad` writes for a flat opening: 2 x 1 m, down and up.
const LAMP: &str = "void brightdata d\n5 flatcorr lamp.dat source.cal src_phi4 src_theta\n0\n1 2\n\
    d light l\n0\n0\n3 0.5 0.5 0.5\n\
    l polygon lamp.d\n0\n0\n12 -1 -.5 0 -1 .5 0 1 .5 0 1 -.5 0\n\
    l polygon lamp.u\n0\n0\n12 -1 -.5 .1 1 -.5 .1 1 .5 .1 -1 .5 .1\n";

#[test]
fn tables_of_ies2rad_are_intensities() {
    let files = [("lamp.rad", LAMP), ("lamp.dat", TABLE)];
    let text = "!xform -rz 90 -t 0 0 3 lamp.rad\n";
    let parts = read_with(text, &files).unwrap_or_else(|p| panic!("{p}")).value;
    assert!(parts.shapes.is_empty() && parts.luminaires.len() == 2);
    let towards = |k: usize, v: [f64; 3]| {
        let LuminaireKind::Point { world_from_luminaire, intensity, .. } =
            &parts.luminaires[k].kind
        else {
            panic!("a table is a point")
        };
        let local = world_from_luminaire.inverse().unwrap().vector(Vector::from(v));
        intensity.intensity_cd(local.direction().unwrap())
    };
    // Twice the table, times the luminance of half a watt, times 2 m2.
    let unit = 2.0 * 0.5 * 179.0 * 2.0;
    near(towards(0, [0.0, 0.0, -1.0]), 10.0 * unit);
    near(towards(0, [0.0, 0.0, 1.0]), 0.0);
    near(towards(1, [0.0, 0.0, 1.0]), 2.0 * unit);
    near(towards(1, [0.0, 0.0, -1.0]), 0.0);
    // Turned by 90 degrees, C0 points along +y and C90 along -x. At the horizon both halves shine.
    assert!((towards(0, [0.0, 1.0, -1e-9]) / (4.0 * unit) - 1.0).abs() < 1e-6);
    assert!((towards(0, [-1.0, 0.0, -1e-9]) / (6.0 * unit) - 1.0).abs() < 1e-6);
    let func = LAMP.replace("brightdata d\n5 flatcorr", "brightdata d\n5 myfunc");
    refused_with("!cat lamp.rad", &[("lamp.rad", &func), files[1]], "uses the function `myfunc`");
    refused_with("!cat lamp.rad", &files[..1], "file `lamp.dat` does not exist");
}

const IES: &str =
    "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n300 200 0\n";

#[test]
fn ies2rad_is_resolved_here() {
    let text = "!ies2rad -t default -m .5 lamps/a.ies | xform -n p -t 0 0 3 -a 4 -t 1 0 0\n";
    let loaded = read_with(text, &[("lamps/a.ies", IES)]).unwrap();
    assert_eq!((loaded.value.luminaires.len(), loaded.warnings.len()), (4, 0));
    let LuminaireKind::Point { position, intensity, .. } = &loaded.value.luminaires[3].kind else {
        panic!("a file is a point")
    };
    near(intensity.max_intensity_cd(), 150.0);
    near((*position - Point::new(3.0, 0.0, 3.0)).length(), 0.0);
    assert_eq!(loaded.value.luminaires[3].name, "p.3.a");
}

#[test]
fn what_is_not_read_is_named_with_its_line() {
    for (text, expected) in [
        (
            "void mixfunc x 4 a b c d 0 0\nx polygon f 0 0 9 0 0 0 1 0 0 0 1 0\n",
            "line 1: modifier `a` is not defined",
        ),
        ("void antimatter x 1 void 0 0\nx sphere s 0 0 4 0 0 0 1\n", "line 1: antimatter `x`"),
        ("void plastic m 0 0 5 .5 .5 .5 0 0\nm mesh a 1 a.rtm 0 0\n", "line 2: mesh `a`"),
        ("void instance a 1 a.oct 0 0\n", "line 1: instance `a`"),
        ("nothing sphere s 0 0 4 0 0 0 1\n", "line 1: modifier `nothing` is not defined"),
        ("\nvoid plastick m 0 0 0\n", "line 2: `plastick` is not a type"),
        ("void plastic m 0 0 5 1 1 x 0 0\n", "`x` is not a finite number"),
        ("void plastic m 0 0 5 1 1\n", "ends after 2 of 5 real"),
        ("void plastic m 0 0 99999999999 1 1\n", "99999999999 real arguments"),
        ("void plastic m 0 0 3 1 1 1\nm sphere s 0 0 4 0 0 0 1\n", "3 real arguments where 5"),
        ("!gensky 6 21 12EST\n", "time zones are given by -m"),
        ("!rm -rf x\n", "`!rm` is not run"),
        ("!xform a.rad; rm x\n", "shell syntax `;`"),
        ("!xform ../../../../../../../../etc/passwd\n", "lies outside"),
        ("!xform /etc/passwd\n", "lies outside"),
        ("!xform gone.rad\n", "does not exist"),
        ("!xform -a 0 x.rad\n", "-a 0"),
        ("!xform -s 0 x.rad\n", "-s 0"),
        ("!xform -t 1 2\n", "-t without its numbers"),
        ("", "there are no surfaces"),
    ] {
        refused(text, expected);
    }
    let text = format!(
        "void colorpict p 7 red green blue a.hdr picture.cal u v 0 0\np texfunc t 4 x y z c 0 0\n\
         t plastic m 0 0 5 .5 .5 .5 0 0\nm {FACE}void {FACE}"
    );
    let told: Vec<_> =
        read_with(&text, &[]).unwrap().warnings.iter().map(ToString::to_string).collect();
    for expected in ["line 1: colorpict `p`", "line 2: texfunc `t`", "line 5: surfaces of `void`"] {
        assert!(told.iter().any(|w| w.contains(expected)), "{expected}: {told:?}");
    }
    let pattern = format!("void brightfunc p 2 f c.cal 0 0\np light l 0 0 3 1 1 1\nl {FACE}");
    refused(&pattern, "patterns of lights are not read");
}

/// From the museum of `radiance_taj`: its lamps hang where the lines of a file say.
#[test]
fn places_from_the_lines_of_a_file() {
    let patch = format!("void plastic m 0 0 5 .5 .5 .5 0 0\nm {FACE}");
    let places = "-t 0 0 2\n# second\n\nxform -rz 90 -t 2 2 2\n";
    let files = [("patch.rad", patch.as_str()), ("pos.txt", places)];
    let loaded = read_with("!xform -f pos.txt patch.rad\n", &files).unwrap();
    let parts = loaded.value;
    let positions: Vec<_> = parts.shapes.iter().flat_map(|s| &s.positions).copied().collect();
    let due = [
        [0.0, 0.0, 2.0],
        [1.0, 0.0, 2.0],
        [0.0, 1.0, 2.0],
        [2.0, 2.0, 2.0],
        [2.0, 3.0, 2.0],
        [1.0, 2.0, 2.0],
    ];
    assert_eq!(positions, due);
    refused("!xform -f gone.txt patch.rad\n", "gone.txt");
    refused("!xform -f ../../../../etc/passwd patch.rad\n", "lies outside");
    refused_with("!xform -f a patch.rad\n", &[("a", "-f a")], "nested more than");
}

#[test]
fn mixtures_count_by_their_mean() {
    let made = |kind: &str, names: &str, more: &str| {
        let text = format!(
            "void plastic a 0 0 5 .8 .8 .8 0 0\nvoid plastic b 0 0 5 .2 .4 .6 0 0\n\
             void glass g 0 0 3 .9 .9 .9\n{more}void {kind} x 4 {names} f f.cal 0 0\nx {FACE}"
        );
        read_with(&text, &[])
    };
    for kind in ["mixfunc", "mixdata", "mixpict", "mixtext"] {
        let loaded = made(kind, "a b", "").unwrap();
        let front = loaded.value.materials[0].finish(true).unwrap();
        for (found, due) in front.diffuse.colour.0.iter().zip([0.5, 0.6, 0.7]) {
            near(*found, due);
        }
        let told = loaded.warnings[0].to_string();
        assert!(
            told.contains(&format!("line 4: {kind} `x` is read as half `a`, half `b`")),
            "{told}"
        );
    }
    // A number is a share, and needs no warning.
    let text = format!(
        "void plastic a 0 0 5 .8 .8 .8 0 0\nvoid plastic b 0 0 5 .2 .4 .6 0 0\n\
         void mixfunc x 4 a b 0.25 . 0 0\nx {FACE}"
    );
    let quarter = read_with(&text, &[]).unwrap();
    assert_eq!(quarter.warnings, []);
    let front = quarter.value.materials[0].finish(true).unwrap();
    for (found, due) in front.diffuse.colour.0.iter().zip([0.35, 0.5, 0.65]) {
        near(*found, due);
    }
    let holed = made("mixfunc", "a void", "").unwrap();
    near(holed.value.materials[0].finish(true).unwrap().diffuse.colour.0[0], 0.8);
    assert!(holed.warnings[0].what.contains("has holes"));
    let nested = made("mixfunc", "a y", "void mixfunc y 4 b void f f.cal 0 0\n").unwrap();
    near(nested.value.materials[0].finish(true).unwrap().diffuse.colour.0[0], 0.5);
    let refused = made("mixfunc", "a g", "").unwrap_err().to_string();
    assert!(refused.contains("mixes what light passes"), "{refused}");
    let deep: String =
        (0..20).map(|k| format!("void mixfunc m{} 4 m{k} m{k} f f.cal 0 0\n", k + 1)).collect();
    let text = format!("void plastic m0 0 0 5 .8 .8 .8 0 0\n{deep}m20 {FACE}");
    self::refused(&text, "lies in more than 8 others");
}

#[test]
fn hostile_files_end() {
    refused("!xform scene.rad\n!xform scene.rad\n", "is read inside itself");
    refused(
        "!genbox m b 1 1 1 | xform -a 1000000 -a 1000000 -t 1 0 0\n",
        "more than 1048576 copies",
    );
    refused("!genbox m b 1 1 1 | xform -a 99999999999999999999\n", "-a 9");
    let nested = [
        ("a.rad", "!xform -a 1000 -t 1 0 0 b.rad\n"),
        ("b.rad", "!xform -a 1000 -t 0 1 0 c.rad\n"),
    ];
    let last = [("c.rad", "!xform -a 1000 -t 0 0 1 d.rad\n"), ("d.rad", "# nothing\n")];
    let text = "!xform -a 1000 -t 1 1 1 a.rad\n";
    refused_with(text, &[nested, last].concat(), "more than 4194304 statements");
    let names: Vec<String> = (0..70).map(|k| format!("f{k}.rad")).collect();
    let texts: Vec<String> = (0..70).map(|k| format!("!xform f{}.rad\n", k + 1)).collect();
    let chain: Vec<_> =
        names.iter().map(String::as_str).zip(texts.iter().map(String::as_str)).collect();
    refused_with("!xform f0.rad\n", &chain, "nested more than 64 deep");
    let stack: String = (1..400).map(|k| format!("m{} texfunc m{k} 0 0 0\n", k - 1)).collect();
    let text = format!("void texfunc m0 0 0 0\n{stack}m399 {FACE}");
    refused(&text, "more than 256 modifiers");
    for junk in ["\u{0}\u{1}", "\"", "!", "!|", "!xform", "# only\\", "a b", "void alias x", "!'"] {
        assert!(read_with(junk, &[]).is_err(), "{junk:?}");
    }
}

#[test]
fn a_scene_toml_names_a_file_and_replaces_its_materials() {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("a.rad"), format!("unknown {FACE}")).unwrap();
    let toml = "[materials.paint]\ndiffuse = 0.7\n[[geometry]]\nfile = \"a.rad\"\n\
                materials = { unknown = \"paint\" }\n";
    std::fs::write(dir.path().join("scene.toml"), toml).unwrap();
    let parts = load(&dir.path().join("scene.toml")).unwrap_or_else(|p| panic!("{p}")).value;
    let material = &parts.materials[parts.shapes[0].material as usize];
    assert_eq!(material.finish(false).unwrap().diffuse.colour, Rgb::grey(0.7));
}
