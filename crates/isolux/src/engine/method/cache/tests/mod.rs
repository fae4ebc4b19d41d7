//! Tests of the parts of the cache.

mod gradients;
mod layers;
mod repeat;

use super::hemisphere::{Hemisphere, Light, Surroundings};
use super::layer::{Layer, Site};
use crate::engine::light::Lighting;
use crate::engine::tests::{inward_box, isotropic, painted, scene};
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::{Point, Vector};

/// A room of 4 by 3 by 2 metres, lit from a place off its middle.
fn room() -> Scene {
    let lamp = isotropic([1.5, 1.2, 1.4], 100.0);
    scene(inward_box([4.0, 3.0, 2.0], 0), vec![painted(Rgb::grey(0.6))], vec![lamp])
}

fn site(point: [f64; 3], normal: Vector) -> Site {
    Site {
        origin: Point::from(point),
        normal: normal.normal().unwrap(),
        triangle: u32::MAX,
        radius_m: 1.0,
        nearest_m: 0.0,
    }
}

/// The mean of some replicates of light after one reflection.
fn look(scene: &Scene, from: &Site, rays: u32) -> Light {
    let lighting = Lighting::new(scene);
    let far = Layer::new(scene, 0.3);
    let of = Surroundings {
        scene,
        far: &far,
        lighting: Some(&lighting),
        bright: None,
        caustic: &|_| Rgb::BLACK,
    };
    let replicates = 16;
    let mut mean = Light::default();
    for replicate in 0..replicates {
        let sequence = Sequence::new(Key::new(replicate));
        let seen = Hemisphere::look(&of, from, rays, sequence).light(&[]);
        for (mean, seen) in mean.0.iter_mut().flatten().zip(seen.0.iter().flatten()) {
            *mean += seen / replicates as f64;
        }
    }
    mean
}
