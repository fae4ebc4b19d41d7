//! Luminaires with a luminous area, against emitting surfaces and against all places of the area.

use super::direct_light::facing;
use super::faces::deviation;
use super::many::{hall, receivers};
use super::*;
use crate::engine::light::{Emission, Lighting, ShadowRays};
use crate::scene::{AreaShape, LuminousArea};
use std::f64::consts::PI;

/// Side of the panel, and its luminance, of which either kind of source makes the same light.
const SIDE_M: f64 = 0.6;
const LUMINANCE_CD_M2: f64 = 2000.0;

/// A floor with a wall of mirrors beside it and a screen above that hides part of the light.
fn stage() -> Vec<Shape> {
    vec![
        rectangle([-3.0, -3.0, 0.0], [6.0, 0.0, 0.0], [0.0, 6.0, 0.0], 0),
        rectangle([2.0, -2.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 3.0], 2),
        rectangle([0.1, -0.4, 1.2], [0.5, 0.0, 0.0], [0.0, 0.6, 0.0], 0),
    ]
}

fn materials() -> Vec<Material> {
    let mirror = Finish { mirror: Rgb::grey(0.8), ..Finish::BLACK };
    vec![
        Material::two_sided("grey", Finish::diffuse(Rgb::grey(0.5))),
        glowing(LUMINANCE_CD_M2),
        Material::two_sided("mirror", mirror),
    ]
}

/// Shines down from 2.5 m as an emitting surface.
fn of_surface() -> Scene {
    let mut shapes = stage();
    let h = 0.5 * SIDE_M;
    shapes.push(rectangle([-h, -h, 2.5], [0.0, SIDE_M, 0.0], [SIDE_M, 0.0, 0.0], 1));
    scene(shapes, materials(), vec![])
}

/// The same light from the luminous area of a luminaire.
fn of_luminaire() -> Scene {
    let peak_cd = LUMINANCE_CD_M2 * SIDE_M * SIDE_M;
    let mut lamp =
        point([0.0, 0.0, 2.5], IntensityDistribution::CosinePower { peak_cd, exponent: 1.0 });
    let h = 0.5 * SIDE_M;
    if let LuminaireKind::Point { area, .. } = &mut lamp.kind {
        *area =
            Some(LuminousArea { shape: AreaShape::Box, half_m: [h, h, 0.0], middle_m: [0.0; 3] });
    }
    scene(stage(), materials(), vec![lamp])
}

/// Close below, beside, behind the screen, and before the mirror.
const PLACES: [[f64; 3]; 5] =
    [[0.0, 0.0, 2.2], [0.5, 0.1, 2.4], [0.2, -0.2, 0.0], [0.9, 0.3, 0.0], [1.9, 0.0, 0.0]];

#[test]
fn an_area_of_a_cosine_lights_as_an_emitting_surface_does() {
    let scenes = [of_surface(), of_luminaire()];
    for place in PLACES {
        let at = facing(place, [0.0, 0.0, 1.0]);
        let [right, found] = scenes.each_ref().map(|scene| {
            let lighting = Lighting::new(scene);
            let one = |seed: u64| lighting.illuminance(&at, &mut dice(seed)).luminance();
            mean_and_error((0..200).map(one))
        });
        let error = right.1.hypot(found.1) + RAY_ROUNDING * right.0;
        assert!((found.0 - right.0).abs() < SIGMAS * error, "{place:?}: {found:?} {right:?}");
        assert!(right.0 > 1.0, "{place:?}");
    }
}

#[test]
fn pictures_show_the_light_of_an_area() {
    let scenes = [of_surface(), of_luminaire()];
    for place in PLACES {
        let at = facing(place, [0.0, 0.0, 1.0]);
        let [right, found] = scenes.each_ref().map(|scene| {
            let lighting = Lighting::new(scene);
            let rays = ShadowRays { fewest: 64, most: 64 };
            let patches = crate::engine::light::Patches::new();
            let one = |seed: u64| {
                lighting.pictured(&patches, &at, rays, Sequence::new(Key::new(seed))).lx.luminance()
            };
            mean_and_error((0..200).map(one))
        });
        // A hundredth is the bias of few places for the light without obstacles a tenth of a metre from a lamp.
        let error = SIGMAS * right.1.hypot(found.1) + 1e-2 * right.0;
        assert!((found.0 - right.0).abs() < error, "{place:?}: {found:?} {right:?}");
    }
}

#[test]
fn particles_leave_from_the_whole_area() {
    let scene = of_luminaire();
    let emission = Emission::new(&scene).unwrap();
    let sequence = Sequence::new(Key::new(1));
    const COUNT: u32 = 1 << 12;
    let mut squares = [0.0; 2];
    for k in 0..COUNT {
        let emitted = emission.emit(&mut Dice::new(sequence, k)).unwrap();
        let from = emitted.ray.origin;
        assert!((from.z - 2.5).abs() < 1e-6 && emitted.direction.to_vector().z < 0.0);
        squares[0] += from.x * from.x / f64::from(COUNT);
        squares[1] += from.y * from.y / f64::from(COUNT);
    }
    // A twelfth of the square of the side; a net of points errs by less than independent ones.
    for square in squares {
        assert!((square / (SIDE_M * SIDE_M / 12.0) - 1.0).abs() < 0.05, "{square}");
    }
    let flux_lm = PI * LUMINANCE_CD_M2 * SIDE_M * SIDE_M;
    assert!((emission.flux_lm() / flux_lm - 1.0).abs() < 1e-9);
}

/// A hall whose luminaires have areas of all shapes, so many that the light tree draws them.
fn hall_of_areas(count: u64) -> Scene {
    let mut parts = hall(count).to_parts();
    let shapes = [
        AreaShape::Box,
        AreaShape::CylinderX,
        AreaShape::CylinderY,
        AreaShape::CylinderZ,
        AreaShape::Ellipsoid,
    ];
    for (k, luminaire) in parts.luminaires.iter_mut().enumerate() {
        if let LuminaireKind::Point { area, .. } = &mut luminaire.kind {
            let half_m = [0.4, 0.1, if k % 2 == 0 { 0.0 } else { 0.05 }];
            *area = (k % 6 > 0)
                .then(|| LuminousArea { shape: shapes[k % 5], half_m, middle_m: [0.0; 3] })
                .filter(|a| a.shape != AreaShape::Ellipsoid || half_m[2] > 0.0);
        }
    }
    Scene::assemble(parts).unwrap()
}

#[test]
fn many_areas_by_few_rays_are_unbiased() {
    let scene = hall_of_areas(60);
    let all = |lighting: &Lighting, at: &SurfacePoint, seed: u64| {
        lighting.illuminance(at, &mut dice(seed))
    };
    let largest = deviation(&scene, all, receivers(8));
    assert!(largest < SIGMAS, "{largest} standard errors");
    let one =
        |lighting: &Lighting, at: &SurfacePoint, seed: u64| lighting.estimate(at, &mut dice(seed));
    let largest = deviation(&scene, one, receivers(8));
    assert!(largest < SIGMAS, "one of them: {largest} standard errors");
    let from = Point::new(1.0, -2.0, 1.0);
    let from_afar = |lighting: &Lighting, at: &SurfacePoint, seed: u64| {
        let about = lighting.about(from, 0.5).expect("there are many");
        lighting.estimate_by(&about, at, &mut dice(seed))
    };
    let largest = deviation(&scene, from_afar, receivers(8));
    assert!(largest < SIGMAS, "from afar {largest} standard errors");
}

/// Few areas, of which one is drawn.
#[test]
fn one_of_few_areas_is_unbiased() {
    let scene = hall_of_areas(12);
    let lighting = Lighting::new(&scene);
    for (k, at) in receivers(8).enumerate() {
        let one = |seed: u64| lighting.estimate(&at, &mut dice(seed)).luminance();
        let (mean, error) = mean_and_error((0..4000).map(one));
        let all = |seed: u64| lighting.by_all(&at, 16, &mut dice(5000 + seed)).luminance();
        let (right, of_right) = mean_and_error((0..200).map(all));
        let error = error.hypot(of_right) + RAY_ROUNDING * right;
        assert!((mean - right).abs() < SIGMAS * error, "{k}: {mean} +- {error} for {right}");
    }
}

#[test]
fn areas_end_at_surfaces() {
    let h = 0.5 * SIDE_M;
    let lamp = |z: f64| {
        let mut lamp = isotropic([1.9, 0.0, z], 100.0);
        if let LuminaireKind::Point { area, .. } = &mut lamp.kind {
            *area = Some(LuminousArea {
                shape: AreaShape::Box,
                half_m: [h, h, 0.1],
                middle_m: [0.0; 3],
            });
        }
        lamp
    };
    let scene = scene(stage(), materials(), vec![lamp(1.0), lamp(0.0)]);
    let area = |k: usize| *scene.luminaires()[k].kind.area().unwrap();
    // The mirror at 2 m is 0.1 m away and cuts off one side; the floor is far from the first and touched by the second.
    let LuminousArea { half_m, middle_m, .. } = area(0);
    let ends = [middle_m[0] - half_m[0], middle_m[0] + half_m[0]];
    assert!(ends[0] == -h && (ends[1] - 0.1).abs() < 1e-3, "{ends:?}");
    assert!(half_m[1..] == [h, 0.1] && middle_m[1..] == [0.0, 0.0], "{half_m:?} {middle_m:?}");
    let LuminousArea { half_m, middle_m, .. } = area(1);
    assert!((half_m[2] - 0.05).abs() < 1e-3 && (middle_m[2] - 0.05).abs() < 1e-3, "{half_m:?}");
    let again = Scene::assemble(scene.to_parts()).unwrap();
    assert_eq!(again.luminaires(), scene.luminaires(), "it ends where it ended");
}
