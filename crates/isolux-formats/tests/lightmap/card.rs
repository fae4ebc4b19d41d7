//! A grey card on a table, both white-lit by a known illuminance.

use isolux::geometry::Direction;
use isolux::lightmap::{Lightmap, LightmapSettings, Pace, UvUnwrap, bake, plan};
use isolux::map::{IlluminationMap, Standing, VertexLight};
use isolux::scene::{Finish, Luminaire, LuminaireKind, Material, Scene, SceneParts, Shape};
use isolux::units::Rgb;

/// Reflectance of the card.
pub(crate) const REFLECTANCE: f64 = 0.8;
/// Illuminance on it, lx, red, green and blue.
pub(crate) const ILLUMINANCE_LX: [f64; 3] = [520.0, 500.0, 430.0];

fn quad(name: &str, size: f64, z: f64, material: u32) -> Shape {
    Shape {
        name: name.into(),
        positions: vec![[0.0, 0.0, z], [size, 0.0, z], [size, size, z], [0.0, size, z]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        material,
        ..Shape::default()
    }
}

/// The card, on a table of which nothing is known, under a mirror without a map.
pub(crate) fn scene() -> Scene {
    let materials = vec![
        Material::one_sided("card", Finish::diffuse(Rgb::grey(REFLECTANCE))),
        Material::two_sided("table", Finish::diffuse(Rgb::grey(0.3))),
        Material::one_sided("mirror", Finish::mirror(Rgb::grey(0.9))),
    ];
    let shapes =
        vec![quad("card", 1.0, 0.0, 0), quad("table", 2.0, -1.0, 1), quad("mirror", 1.0, 2.0, 2)];
    // Its light is in the map already: a file with the light beside the lightmap would show it twice.
    let sun = LuminaireKind::Directional {
        direction: Direction::Z,
        illuminance_lx: 500.0,
        half_angle_rad: 0.0,
    };
    let luminaires =
        vec![Luminaire { name: "sun".into(), group: 0, colour: Rgb::WHITE, kind: sun }];
    let groups = vec!["general".into()];
    let name = "card".into();
    let parts = SceneParts { name, shapes, materials, luminaires, groups, ..SceneParts::default() };
    Scene::assemble(parts).unwrap()
}

/// The same illuminance everywhere on the card.
pub(crate) fn map(scene: &Scene) -> IlluminationMap {
    let lit = VertexLight {
        indirect_lx: Rgb(ILLUMINANCE_LX),
        standard_error_lx: 5.0,
        indirect_standard_error_lx: 5.0,
        standing: Standing::Open,
        ..VertexLight::NOTHING
    };
    crate::lit::map(scene, |at, _| (at.z > -0.5).then_some(lit))
}

pub(crate) fn lightmap(scene: &Scene, map: &IlluminationMap) -> Lightmap {
    let settings = LightmapSettings { texels_per_m: Some(10.0), ..LightmapSettings::default() };
    let layout = plan(scene, &settings, &UvUnwrap).unwrap();
    bake(scene, map, &layout, &mut |_| Pace::Whole).unwrap()
}

/// The texel in the middle of the card.
pub(crate) fn middle(lightmap: &Lightmap) -> (u32, u32) {
    let corners = lightmap.layout.sides[..2].iter().flat_map(|side| lightmap.layout.corners(side));
    let (mut x, mut y) = (0.0, 0.0);
    for [cx, cy] in corners {
        x += cx / 6.0;
        y += cy / 6.0;
    }
    (x as u32, y as u32)
}
