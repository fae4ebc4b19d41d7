//! Places that samples serve, and places that they do not.

use super::super::layer::{Layer, Site};
use super::super::octree::Octree;
use super::super::placing::{Place, Radii, serve, typical_radius_m};
use super::{look, room, site};
use crate::engine::ray::NEVER;
use crate::engine::tests::{inward_box, isotropic, painted, rectangle, scene};
use crate::sampling::Key;
use crate::units::Rgb;
use isolux_geometry::{Normal, Point, Ray, Vector};

fn floor_site(x: f64, y: f64) -> Site {
    site([x, y, 1e-4], Normal::Z.to_vector())
}

fn place_of(site: &Site) -> Place {
    Place { origin: site.origin, normal: site.normal, triangle: site.triangle }
}

#[test]
fn an_octree_finds_all_that_reach_a_place() {
    let key = Key::new(5);
    let place = |k: u64| Point::from([0, 1, 2].map(|axis| key.with(k).with(axis).uniform()));
    let reach = |k: u64| 0.3 * key.with(k).with(3).uniform().powi(3);
    let mut tree = Octree::over((Point::ORIGIN, Point::new(1.0, 1.0, 1.0)));
    (0..500).for_each(|k| tree.insert(k as u32, place(k), reach(k)));
    for asked in 500..700 {
        let at = place(asked);
        let mut found = Vec::new();
        tree.visit(at, |sample| found.push(u64::from(sample)));
        for k in (0..500).filter(|&k| (place(k) - at).length() < reach(k)) {
            assert_eq!(found.iter().filter(|&&f| f == k).count(), 1, "{k} for {asked}");
        }
    }
}

#[test]
fn a_sample_serves_what_is_near_and_faces_its_way() {
    let scene = room();
    let mut layer = Layer::new(&scene, 0.3);
    let own = floor_site(2.0, 1.5);
    layer.insert(own);
    let covers =
        |x: f64, z: f64, normal: Normal| layer.covers(&scene, Point::new(x, 1.5, z), normal);
    assert!(covers(2.0, 1e-4, Normal::Z) && covers(2.29, 1e-4, Normal::Z));
    assert!(!covers(2.31, 1e-4, Normal::Z));
    assert!(!covers(2.0, 1e-4, -Normal::Z));
    // This is a table above the floor, near enough by distance alone.
    assert!(!covers(2.0, 0.2, Normal::Z));
}

#[test]
fn no_sample_serves_what_is_behind_a_wall() {
    let wall = rectangle([2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 2.0], 1);
    let mut shapes = inward_box([4.0, 3.0, 2.0], 0);
    shapes.push(wall);
    let grey = painted(Rgb::grey(0.6));
    let two_sided =
        crate::scene::Material::two_sided("wall", crate::scene::Finish::diffuse(Rgb::grey(0.6)));
    let scene = scene(shapes, vec![grey, two_sided], vec![isotropic([1.0, 1.5, 1.0], 100.0)]);
    let mut layer = Layer::new(&scene, 0.5);
    layer.insert(floor_site(1.9, 1.5));
    assert!(layer.covers(&scene, Point::new(1.99, 1.5, 1e-4), Normal::Z));
    assert!(!layer.covers(&scene, Point::new(2.01, 1.5, 1e-4), Normal::Z));
    let mut ties = Vec::new();
    layer.ties(&scene, (Point::new(2.1, 1.5, 1e-4), Normal::Z), 4, &mut ties);
    assert!(ties.is_empty());
}

/// In a corridor with walls that carry light on both sides, a sample on the outside of one wall sees nothing,
/// not even the other wall, which is nearly in its plane as seen from there.
#[test]
fn no_sample_on_the_outside_serves_the_inside() {
    let grey = crate::scene::Finish::diffuse(Rgb::grey(0.5));
    let material = crate::scene::Material::two_sided("wall", grey);
    let lamp = isotropic([1.5, 0.9, 2.5], 100.0);
    let scene = scene(inward_box([24.0, 1.8, 2.6], 0), vec![material], vec![lamp]);
    let out = Point::new(11.25, 1.8001, 1.06);
    let inwards = Ray::between(out, Point::new(11.25, 1.0, 1.06));
    let triangle = scene.bvh().closest_hit(&inwards).unwrap().triangle;
    let mut layer = Layer::new(&scene, 0.6);
    let y = Vector::new(0.0, 1.0, 0.0).normal().unwrap();
    layer.insert(Site {
        triangle,
        radius_m: 12.0,
        nearest_m: f64::INFINITY,
        ..site([out.x, out.y, out.z], y.to_vector())
    });
    assert!(layer.covers(&scene, Point::new(16.0, 1.8001, 2.0), y));
    assert!(!layer.covers(&scene, Point::new(18.0, 1e-4, 1.95), y));
}

/// The floor of a house, half a metre above the ground, is nearly in the plane of the ground beside it, but
/// is seen from below.
#[test]
fn no_sample_serves_a_surface_that_it_lies_below() {
    let ground = rectangle([-20.0, -20.0, 0.0], [40.0, 0.0, 0.0], [0.0, 40.0, 0.0], 0);
    let floor = rectangle([0.0, -2.0, 0.5], [5.0, 0.0, 0.0], [0.0, 4.0, 0.0], 0);
    let grey = painted(Rgb::grey(0.5));
    let scene = scene(vec![ground, floor], vec![grey], vec![isotropic([0.0, 0.0, 9.0], 100.0)]);
    let mut layer = Layer::new(&scene, 0.6);
    layer.insert(Site { radius_m: 12.0, nearest_m: 9.0, ..floor_site(-1.0, 0.0) });
    assert!(layer.covers(&scene, Point::new(-3.0, 0.0, 1e-4), Normal::Z));
    assert!(!layer.covers(&scene, Point::new(1.0, 0.0, 0.5001), Normal::Z));
}

#[test]
fn radii_differ_no_more_than_places_do() {
    let scene = room();
    let mut layer = Layer::new(&scene, 1.0);
    layer.insert(Site { radius_m: 1.0, ..floor_site(2.0, 1.5) });
    layer.insert(Site { radius_m: 0.1, ..floor_site(2.3, 1.5) });
    layer.insert(Site { radius_m: 1.0, ..floor_site(2.1, 1.5) });
    // Coordinates are sums of decimals.
    let is_near = |k: usize, expected: f64| (layer.sites[k].radius_m - expected).abs() < 1e-12;
    // The small radius of the second does not reach the third.
    assert!(is_near(0, 0.4) && is_near(1, 0.1) && is_near(2, 0.5), "{:?}", layer.sites);
}

#[test]
fn weights_sum_to_one_and_carry_light_over() {
    let scene = room();
    let mut layer = Layer::new(&scene, 0.5);
    let sites = [floor_site(2.0, 1.5), floor_site(2.2, 1.5), floor_site(2.1, 1.6)];
    sites.iter().for_each(|site| {
        layer.insert(*site);
    });
    let mut ties = Vec::new();
    let at = Point::new(2.1, 1.52, 1e-4);
    layer.ties(&scene, (at, Normal::Z), usize::MAX, &mut ties);
    let weights: f32 = ties.iter().map(|tie| tie.shares[0]).sum();
    // These are three single-precision quotients of one sum.
    assert!((weights - 1.0).abs() < 1e-6 && ties.len() == 3, "{ties:?}");
    let lights: Vec<_> = sites.iter().map(|site| look(&scene, site, 256)).collect();
    let exact = look(&scene, &floor_site(2.1, 1.52), 256).value().0[0];
    let read = super::super::hemisphere::tied(&ties, &lights).0[0];
    // The tolerance is second order of 0.1 m in a room of metres, and noise of 16 x 256 rays.
    assert!((read / exact - 1.0).abs() < 0.01, "{read} for {exact}");
}

#[test]
fn places_are_served_whatever_their_order() {
    let scene = room();
    let places: Vec<Place> = (0..400)
        .map(|k| floor_site(0.1 + 0.19 * f64::from(k % 20), 0.1 + 0.14 * f64::from(k / 20)))
        .map(|site| place_of(&site))
        .collect();
    let radii = Radii { least_m: 0.01, most_m: 2.0 };
    let served = |places: Vec<Place>| {
        let mut layer = Layer::new(&scene, 0.4);
        serve(&scene, &mut layer, places, (radii, &NEVER));
        layer
    };
    let layer = served(places.clone());
    assert!(layer.sites.len() < 200, "{} samples for 400 places", layer.sites.len());
    let backwards: Vec<Place> = places.iter().rev().chain(&places).copied().collect();
    assert_eq!(served(backwards).sites, layer.sites);
    let unserved = places.iter().filter(|p| !layer.covers(&scene, p.origin, p.normal)).count();
    // These are places whose sample has shrunk beside a later one with a smaller radius.
    assert!(unserved < 40, "{unserved}");
}

#[test]
fn a_typical_radius_is_the_size_of_the_room() {
    let radius_m = typical_radius_m(&room(), 10.0);
    assert!(radius_m > 1.0 && radius_m < 2.5, "{radius_m}");
}
