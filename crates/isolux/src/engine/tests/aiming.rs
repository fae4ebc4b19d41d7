//! Particles aimed at specular surfaces bring what those let go bring.

use super::*;
use crate::engine::light::{Emission, Lighting, Particle};
use crate::engine::particle::{Aim, Flights};
use crate::sampling::Sequence;
use crate::scene::{Body, Dielectric, Gloss};
use std::cell::Cell;

/// A room without a ceiling with a pane, a polished plate that lies half behind it and a small mirror that hangs askew, lit by one luminaire; what
/// glows hangs in it and faces down.
fn room(lamp: Option<Luminaire>) -> Scene {
    let polished = Finish {
        gloss: Some(Gloss { f0: Rgb::grey(0.8), alpha: 0.1 }),
        ..Finish::diffuse(Rgb::grey(0.1))
    };
    let pane = Dielectric { ior: 1.5, transmittance: Rgb::grey(0.9), thin: true };
    let materials = vec![
        painted(Rgb::grey(0.5)),
        Material { name: "pane".into(), body: Body::Dielectric(pane) },
        Material::two_sided("polished", polished),
        Material::one_sided("mirror", Finish::mirror(Rgb::grey(0.9))),
        glowing(100.0),
    ];
    let mut shapes = inward_box([4.0, 3.0, 2.5], 0);
    shapes.pop();
    shapes.push(rectangle([1.0, 1.0, 0.2], [0.4, 0.0, 0.0], [0.0, 0.1, 0.3], 1));
    shapes.push(rectangle([1.2, 1.3, 0.1], [0.5, 0.0, 0.0], [0.0, 0.4, 0.1], 2));
    shapes.push(rectangle([3.0, 1.0, 0.5], [0.1, 0.4, 0.0], [0.0, 0.1, 0.4], 3));
    if lamp.is_none() {
        shapes.push(rectangle([0.5, 2.0, 2.4], [0.0, 0.5, 0.0], [0.8, 0.0, 0.0], 4));
    }
    scene(shapes, materials, lamp.into_iter().collect())
}

/// Flux that so many particles bring to the walls, and a sum that tells where, lm.
fn brought(flights: &Flights, count: u32) -> [f64; 2] {
    let sums = Cell::new([0.0; 2]);
    for index in 0..count {
        flights.fly(index, |at, flux_lm| {
            let [all, where_to] = sums.get();
            let (lm, place) = (flux_lm.luminance(), at.point.x + 0.3 * at.point.z);
            sums.set([all + lm, where_to + lm * place]);
        });
    }
    sums.get()
}

#[test]
fn aimed_particles_bring_as_much_to_the_same_places_with_less_noise() {
    let spot = IntensityDistribution::CosinePower { peak_cd: 200.0, exponent: 3.0 };
    let towards = direction([0.3, 0.2, -0.8]);
    let sun =
        LuminaireKind::Directional { direction: towards, illuminance_lx: 5.0, half_angle_rad: 0.0 };
    let lamps = [Some(isotropic([2.0, 1.5, 2.0], 50.0)), Some(point([1.5, 0.7, 2.2], spot)), None];
    for lamp in lamps.into_iter().chain([Some(luminaire(sun))]) {
        let scene = room(lamp);
        let lighting = Lighting::new(&scene);
        let emission = Emission::new(&scene).unwrap();
        let aim = Aim::new(&scene, &emission).unwrap();
        // More to the first group, as if that had brought more.
        let learned: Vec<f64> =
            (0..aim.groups()).map(|group| if group == 0 { 3.0 } else { 1.0 }).collect();
        let aim = aim.learned(&learned);
        let count = 1 << 13;
        let of = |aim: Option<&Aim>, which: u64| -> Vec<[f64; 2]> {
            let one = |k: u64| {
                let key = Key::new(5).with(which).with(k);
                brought(&Flights::new((&scene, &lighting), aim, count, key).unwrap(), count)
            };
            (0..32).map(one).collect()
        };
        let (let_go, aimed) = (of(None, 0), of(Some(&aim), 1));
        for part in 0..2 {
            let (expected, error) = mean_and_error(let_go.iter().map(|sums| sums[part]));
            let (found, own) = mean_and_error(aimed.iter().map(|sums| sums[part]));
            assert!(expected > 0.0);
            // From 32 replicates errors are known to an eighth.
            assert!(
                (found - expected).abs() < SIGMAS * error.hypot(own),
                "{found} {expected} {own} {error}"
            );

            assert!(own < 0.7 * error, "{own} {error}");
        }
    }
}

#[test]
fn where_nothing_is_specular_nothing_is_aimed_at() {
    let scene = scene(
        inward_box([1.0; 3], 0),
        vec![painted(Rgb::grey(0.5))],
        vec![isotropic([0.5; 3], 1.0)],
    );
    assert!(Aim::new(&scene, &Emission::new(&scene).unwrap()).is_none());
}

/// Flux that so many particles bring with roulette at every reflection, lm.
fn brought_by_roulette((scene, lighting): (&Scene, &Lighting), count: u32, key: Key) -> f64 {
    let emission = Emission::new(scene).unwrap();
    let mut all_lm = 0.0;
    for index in 0..count {
        let sent = Particle::emit(&emission, Sequence::new(key), index, count, 64);
        let mut particle = sent.unwrap();
        while particle.advance(scene).is_some() {
            if !particle.is_covered(lighting) {
                all_lm += particle.flux_lm.luminance();
            }
            if !particle.scatter_specular(scene, lighting) {
                break;
            }
        }
    }
    all_lm
}

#[test]
fn weak_gloss_ends_no_particle_before_it_brings_light() {
    let gloss = Some(Gloss { f0: Rgb::grey(0.04), alpha: 0.25 });
    let finish = Finish { gloss, ..Finish::diffuse(Rgb::grey(0.5)) };
    let materials = vec![Material::one_sided("plastic", finish)];
    let scene = scene(inward_box([2.0; 3], 0), materials, vec![isotropic([1.0; 3], 1.0)]);
    let lighting = Lighting::new(&scene);
    let count = 1 << 12;
    let flights =
        |k: u64| Flights::new((&scene, &lighting), None, count, Key::new(7).with(k)).unwrap();
    let brings = |index: &u32| {
        let brings = Cell::new(false);
        flights(0).fly(*index, |_, _| brings.set(true));
        brings.get()
    };
    // Facets send few below the surface.
    assert!((0..count).filter(brings).count() > count as usize / 10 * 9);
    let spared = (0..32).map(|k| brought(&flights(k), count)[0]);
    let (found, own) = mean_and_error(spared);
    let by_roulette = |k: u64| brought_by_roulette((&scene, &lighting), count, Key::new(8).with(k));
    let (expected, error) = mean_and_error((0..32).map(by_roulette));
    assert!((found - expected).abs() < SIGMAS * error.hypot(own), "{found} {expected}");
    assert!(own < 0.5 * error, "{own} {error}");
}
