//! What of the light of luminaires comes to the scene.

use super::*;
use crate::engine::light::{Arrival, arrivals};

/// Particles that tell of a luminaire among few.
const PARTICLES: f64 = 4096.0;

const SIDE: f64 = 2.0;

fn named(name: &str, luminaire: Luminaire) -> Luminaire {
    Luminaire { name: name.into(), ..luminaire }
}

fn mirror(reflectance: f64) -> Material {
    Material::one_sided("mirror", Finish::mirror(Rgb::grey(reflectance)))
}

/// Fronts inside.
fn room(material: u32) -> Vec<Shape> {
    inward_box([SIDE; 3], material)
}

fn of(shapes: Vec<Shape>, luminaires: Vec<Luminaire>) -> Vec<Arrival> {
    let materials = vec![painted(Rgb::grey(0.5)), mirror(0.5), glowing(10.0)];
    arrivals(&scene(shapes, materials, luminaires))
}

#[test]
fn what_shines_on_backs_and_past_everything_is_lost() {
    let within = named("within", isotropic([1.0, 1.0, 1.0], 10.0));
    let above = named("above", isotropic([1.0, 1.0, SIDE + 0.1], 10.0));
    let found = of(room(0), vec![within, above]);
    let told: Vec<_> = found.iter().map(|a| (a.name.as_str(), a.arrives, a.lost)).collect();
    assert_eq!(told, [("within", 1.0, 0.0), ("above", 0.0, 1.0)]);
    let lm = found[0].luminous_flux_lm.unwrap();
    assert!((lm - 40.0 * std::f64::consts::PI).abs() < 1e-9, "{lm}");
    // An emitting sheet on the roof that faces up.
    let sheet = rectangle([0.5, 0.5, SIDE + 0.1], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 2);
    let found = of([room(0), vec![sheet]].concat(), vec![isotropic([1.0; 3], 10.0)]);
    assert_eq!((found[1].name.as_str(), found[1].arrives, found[1].lost), ("rectangle", 0.0, 1.0));
}

#[test]
fn of_a_lamp_over_a_floor_alone_the_rest_is_lost() {
    // Half as high as the floor is wide: it is one side of a cube around the lamp.
    let floor = rectangle([0.0; 3], [SIDE, 0.0, 0.0], [0.0, SIDE, 0.0], 0);
    let found = of(vec![floor], vec![isotropic([1.0, 1.0, 1.0], 10.0)]);
    let sigma = (5.0 / 36.0 / PARTICLES).sqrt();
    assert!((found[0].arrives - 1.0 / 6.0).abs() < SIGMAS * sigma, "{found:?}");
    assert!((found[0].arrives + found[0].lost - 1.0).abs() < 1e-12, "{found:?}");
}

#[test]
fn mirrors_hand_light_on_and_what_they_keep_is_not_lost() {
    let mut shapes = room(1);
    shapes[0] = Shape { material: 0, ..shapes[0].clone() };
    let found = of(shapes, vec![isotropic([1.0, 1.0, 1.0], 10.0)]);
    // A sixth comes straight to the floor, and more over walls.
    assert!(found[0].arrives > 0.25 && found[0].arrives < 0.9, "{found:?}");
    assert_eq!(found[0].lost, 0.0, "{found:?}");
    // Nothing but mirrors.
    let found = of(room(1), vec![isotropic([1.0, 1.0, 1.0], 10.0)]);
    assert_eq!((found[0].arrives, found[0].lost), (0.0, 0.0));
}

#[test]
fn of_parallel_light_what_passes_by_is_not_counted() {
    let sun = || {
        let kind = LuminaireKind::Directional {
            direction: direction([0.0, 0.6, -0.8]),
            illuminance_lx: 5.0,
            half_angle_rad: 0.0,
        };
        luminaire(kind)
    };
    let floor = rectangle([0.0; 3], [SIDE, 0.0, 0.0], [0.0, SIDE, 0.0], 0);
    let found = of(vec![floor], vec![sun()]);
    assert_eq!((found[0].arrives, found[0].lost, found[0].luminous_flux_lm), (1.0, 0.0, None));
    let found = of(room(0), vec![sun()]);
    assert_eq!((found[0].arrives, found[0].lost), (0.0, 1.0));
}
