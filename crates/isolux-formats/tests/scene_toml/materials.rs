//! Materials.

use super::{FLOOR, problems, read, read_with};
use isolux::scene::{Body, Coat, Dielectric, Finish, Gloss};
use isolux::units::Rgb;

fn body(properties: &str) -> Body {
    let text = format!(
        "[materials.m]\n{properties}\n[[geometry]]\nmaterial = 'm'\n\
         rectangle = {{ corner = [0, 0, 0], u = [1, 0, 0], v = [0, 1, 0] }}\n"
    );
    read(&text).materials.remove(0).body
}

fn two_sided(finish: Finish) -> Body {
    Body::Opaque { front: finish.clone(), back: finish }
}

#[test]
fn every_property() {
    let grey = |v: f64| Finish::diffuse(Rgb::grey(v));
    assert_eq!(body("diffuse = 0.7"), two_sided(grey(0.7)));
    assert_eq!(body("diffuse = 1"), two_sided(grey(1.0)));
    assert_eq!(
        body("diffuse = [0.1, 0.2, 1]"),
        two_sided(Finish::diffuse(Rgb::new(0.1, 0.2, 1.0)))
    );
    let one_sided = Body::Opaque { front: grey(0.7), back: Finish::BLACK };
    assert_eq!(body("diffuse = 0.7\nsided = 'one'"), one_sided);
    assert_eq!(body("diffuse = 0.7\nsided = 'two'"), two_sided(grey(0.7)));
    let differing = Body::Opaque { front: grey(0.7), back: Finish::mirror(Rgb::grey(0.9)) };
    assert_eq!(body("diffuse = 0.7\nback = { mirror = 0.9 }"), differing);
    let gloss = Some(Gloss { f0: Rgb::grey(0.04), alpha: 0.25 });
    let coat = Some(Coat { cover: 0.5, alpha: 0.0625 });
    assert_eq!(
        body(
            "diffuse = 0.5\ngloss = { f0 = 0.04, roughness = 0.5 }\ncoat = { cover = 0.5, roughness = 0.25 }"
        ),
        two_sided(Finish { gloss, coat, ..grey(0.5) })
    );
    assert_eq!(
        body("diffuse = 0.5\ngloss = { f0 = 0.04, roughness = 0.5 }"),
        two_sided(Finish { gloss, ..grey(0.5) })
    );
    let light = Finish { luminance_cd_m2: Rgb::new(100.0, 90.0, 80.0), ..Finish::BLACK };
    assert_eq!(body("luminance_cd_m2 = [100, 90, 80]"), two_sided(light));
    let glass = Dielectric { ior: 1.5, transmittance: Rgb::WHITE, thin: false };
    assert_eq!(body("glass = {}"), Body::Dielectric(glass));
    let pane = Dielectric { ior: 1.52, transmittance: Rgb::grey(0.9), thin: true };
    assert_eq!(
        body("glass = { ior = 1.52, thin = true, transmittance = 0.9 }"),
        Body::Dielectric(pane)
    );
}

/// IEC 61966-2-1: code 188 is half of white, within the step of a code.
#[test]
fn hexadecimal_colours_are_srgb() {
    let Body::Opaque { front, .. } = body("diffuse = '#ffBC00'") else { panic!("opaque") };
    let [r, g, b] = front.diffuse.colour.0;
    assert_eq!((r, b), (1.0, 0.0));
    assert!((g - 0.5).abs() < 0.006, "{g}");
}

#[test]
fn textures_are_shared_and_confined() {
    let dir = tempfile::tempdir().unwrap();
    let text = "[materials.a]\ntexture = 'p.png'\n[materials.b]\ntexture = 'p.png'\ndiffuse = 0.5\n\
                [[geometry]]\nbox = { min = [0,0,0], max = [1,1,1] }\nmaterial = 'a'\n\
                materials = { z_min = 'b' }\n";
    let path = dir.path().join("scene.toml");
    std::fs::write(&path, text).unwrap();
    let png = isolux_formats::png::encode(2, 1, &[[255, 0, 0], [0, 0, 255]]).unwrap();
    std::fs::write(dir.path().join("p.png"), png).unwrap();
    let parts = isolux_formats::load(&path).unwrap().value;
    assert_eq!(parts.textures.len(), 1);
    let colours: Vec<_> = parts
        .materials
        .iter()
        .map(|m| m.finish(false).unwrap().diffuse)
        .map(|d| (d.colour, d.texture))
        .collect();
    assert_eq!(colours, [(Rgb([0.99, 1.0, 0.99]), Some(0)), (Rgb::grey(0.5), Some(0))]);
}

#[test]
fn wrong_materials() {
    for (properties, expected) in [
        ("", "has no property"),
        ("diffuse = 1.2", "line 3, column 11: diffuse reflectance 1.2 is above 1"),
        ("diffuse = 70", "50 % is 0.5"),
        ("diffuse = -0.1", "0 or more"),
        ("diffuse = inf", "0 or more"),
        ("diffuse = 'red'", "expected \"#rrggbb\""),
        ("diffuse = '#12345'", "not a colour"),
        ("diffuse = '#12345é'", "not a colour"),
        ("diffuse = [0.1, 0.2]", "[red, green, blue]"),
        ("diffuse = [0.1, 0.2, 0.3, 0.4]", "[red, green, blue]"),
        ("diffuse = true", "expected a number, [red, green, blue], or"),
        ("diffuse = 0.6\nmirror = 0.6", "reflects 1.200"),
        ("texture = 'a.png'\nmirror = 0.1", "does not exist"),
        ("diffuse = 0.9\ngloss = { f0 = 0.2, roughness = 0.1 }", "reflects 1.100"),
        ("gloss = { f0 = 0.2, roughness = 0 }", "use `mirror`"),
        ("gloss = { f0 = 0.2, roughness = 1.5 }", "from 0 to 1"),
        ("gloss = { f0 = 0.2 }", "`roughness` is missing"),
        ("mirror = 0.5\ncoat = { roughness = 0.1 }", "coat over a mirror"),
        ("diffuse = 0.5\ncoat = { roughness = 0 }", "roughness or cover 0"),
        ("diffuse = 0.5\ncoat = { cover = 2, roughness = 0.1 }", "from 0 to 1"),
        ("diffuse = 0.97\ncoat = { roughness = 0.1 }", "reflects 1.010"),
        ("diffuse = 0.1\nback = { diffuse = 0.1 }\nsided = 'one'", "give one of them"),
        ("diffuse = 0.1\nsided = 'both'", "`one` or `two`"),
        ("diffuse = 0.1\nglass = {}", "keep `glass` alone"),
        ("glass = { ior = 0 }", "above 0"),
        ("glass = { transmittance = 2 }", "transmittance 2 is above 1"),
        ("luminance_cd_m2 = -1", "0 or more"),
        ("texture = 'scene.toml'", "not a usable picture"),
        ("texture = '/etc/hostname'", "outside"),
        ("difuse = 0.1", "line 3, column 1: unknown key `difuse`"),
    ] {
        let text = format!("[materials.grey2]\n# a comment\n{properties}\n{FLOOR}");
        let found = problems(&text);
        assert!(found.iter().any(|p| p.contains(expected)), "{properties}: {found:?}");
    }
}

#[test]
fn unused_and_unknown_materials() {
    let loaded = read_with(&format!("[materials.spare]\ndiffuse = 0.1\n{FLOOR}"), &[]).unwrap();
    assert_eq!(loaded.warnings.len(), 1);
    assert!(
        loaded.warnings[0]
            .to_string()
            .contains("line 1, column 12: nothing is made of material `spare`")
    );
    let found = problems("[[geometry]]\nmaterial = 'x'\nbox = { min = [0,0,0], max = [1,1,1] }\n");
    assert_eq!(
        found,
        ["line 2, column 12: there is no material `x`; define it: [materials.\"x\"]"]
    );
}
