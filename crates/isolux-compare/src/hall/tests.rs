//! That the hall is what its name promises, in every variant.

use super::size::{HEIGHT_M, LENGTH_M, WIDTH_M};
use super::solid::{Form, Solid};
use super::*;
use isolux::geometry::{Hit, Point, Ray, Vector};
use isolux::scene::{Body, LuminaireKind, Scene};
use std::collections::HashMap;

fn variant(triangles: u32, luminaires: u32) -> Variant {
    Variant { triangles, luminaires }
}

fn triangle_count(parts: &SceneParts) -> usize {
    parts.shapes.iter().map(|s| s.triangles.len()).sum()
}

#[test]
fn variants_have_the_size_they_say() {
    for (triangles, luminaires) in [(10_000, 2626), (100_000, 100), (300_000, 101), (10_000, 9_999)]
    {
        let parts = parts(variant(triangles, luminaires));
        let found = triangle_count(&parts);
        let most = triangles as usize;
        assert!(found <= most && found * 100 >= most * 98, "{found} triangles of {triangles}");
        assert_eq!(parts.luminaires.len(), luminaires as usize);
    }
}

/// The largest variant is counted, not built: a test has no gigabyte to spare.
#[test]
fn ten_million_triangles_can_be_had() {
    let mut solids = room::solids();
    solids.extend(furniture::solids());
    let sizes_m = division::edge_lengths_m(&solids, 10_000_000);
    let count: u64 = solids.iter().zip(&sizes_m).map(|(s, &size_m)| s.triangles(size_m)).sum();
    assert!((9_800_000..=10_000_000).contains(&count), "{count}");
}

#[test]
fn counted_triangles_are_those_made() {
    let mut solids = room::solids();
    solids.extend(furniture::solids());
    for size_m in [100.0, 0.7, 0.2] {
        let sizes_m = vec![size_m; solids.len()];
        let counted: u64 = solids.iter().map(|s| s.triangles(size_m)).sum();
        let made: usize = solid::shapes(&solids, &sizes_m).iter().map(|s| s.triangles.len()).sum();
        assert_eq!(made as u64, counted, "{size_m}");
    }
}

#[test]
fn the_same_variant_is_the_same_scene() {
    let hash = |variant| Scene::assemble(parts(variant)).unwrap().hash();
    assert_eq!(hash(Variant::STANDARD), hash(variant(10_000, 2626)));
    assert_ne!(hash(Variant::STANDARD), hash(variant(10_000, 2627)));
    assert_ne!(hash(Variant::STANDARD), hash(variant(11_000, 2626)));
}

/// Bits that must be the same on every machine. They change when the hall does.
#[test]
fn the_hall_is_the_published_one() {
    let scene = Scene::assemble(parts(Variant::STANDARD)).unwrap();
    assert_eq!(&scene.hash()[..16], "c6a65b04a1a98bea");
}

/// Edges in their direction, less those in the opposite one, of all that is no single sheet.
#[test]
fn solids_are_closed() {
    for triangles in [10_000, 150_000] {
        let mut balance = HashMap::new();
        for shape in parts(variant(triangles, 100)).shapes {
            if ["glass", "mirror"].contains(&shape.name.as_str()) {
                continue;
            }
            for triangle in &shape.triangles {
                let corner = |k: usize| {
                    Point::from(shape.positions[triangle[k % 3] as usize])
                        .to_f32()
                        .map(f32::to_bits)
                };
                for k in 0..3 {
                    let (from, to) = (corner(k), corner(k + 1));
                    let edge = (from.min(to), from.max(to));
                    *balance.entry(edge).or_insert(0) += if from < to { 1 } else { -1 };
                }
            }
        }
        assert_eq!(balance.values().filter(|&&sum| sum != 0).count(), 0, "{triangles}");
    }
}

/// Whether a ray that hit this came from inside a solid; panes of glass have no inside.
fn is_inner_side(scene: &Scene, hit: &Hit) -> bool {
    let is_pane = matches!(scene.material(hit.triangle).body, Body::Dielectric(_));
    hit.back && !is_pane
}

#[test]
fn no_luminaire_is_inside_a_solid() {
    for luminaires in [100, 2626, 100_000] {
        let scene = Scene::assemble(parts(variant(10_000, luminaires))).unwrap();
        for luminaire in scene.luminaires() {
            let LuminaireKind::Point { position, .. } = luminaire.kind else { panic!() };
            for (x, y, z) in [(0.1, 0.2, -1.0), (0.9, 0.3, -0.4), (-0.8, -0.5, 0.3)] {
                let direction = Vector::new(x, y, z).direction().unwrap();
                let hit = scene.bvh().closest_hit(&Ray::new(position, direction)).unwrap();
                assert!(
                    !is_inner_side(&scene, &hit),
                    "{} sees the inside of a solid",
                    luminaire.name
                );
                // Clear of what carries it: a centimetre, seen from the side.
                assert!(hit.t > 0.005, "{} touches a surface", luminaire.name);
            }
        }
    }
}

#[test]
fn flux_is_the_same_in_every_variant() {
    let flux_lm = |luminaires| {
        let scene = Scene::assemble(parts(variant(10_000, luminaires))).unwrap();
        scene.luminous_flux_lm()
    };
    let standard_lm = flux_lm(2626);
    for luminaires in [100, 777, 100_000] {
        // Dimming is rounded to nine decimals, at the least 2e-3 for 100,000 luminaires.
        assert!((flux_lm(luminaires) / standard_lm - 1.0).abs() < 1e-6, "{luminaires}");
    }
}

/// Whether a point lies inside a solid, by its form; bounds of lathes are their widest cylinder.
fn contains(solid: &Solid, p: Point) -> bool {
    match &solid.form {
        Form::Box { corner, edges } => edges.iter().all(|e| {
            let along = (p - *corner).dot(*e) / e.length_squared();
            // A solid that stands flush is off by the rounding of coordinates of 36 m.
            along > 1e-9 && along < 1.0 - 1e-9
        }),
        Form::Lathe { foot, rings_m, .. } => {
            let widest_m = rings_m.iter().fold(0.0_f64, |w, ring| w.max(ring[0]));
            let top_m = rings_m.iter().fold(0.0_f64, |t, ring| t.max(ring[1]));
            let d = p - *foot;
            libm::hypot(d.x, d.y) < widest_m && d.z > 0.0 && d.z < top_m
        }
        Form::Sheet { .. } => false,
    }
}

/// Middles, corners and middles of edges and faces of every box are in no other solid.
#[test]
fn no_solid_reaches_into_another() {
    let mut solids = room::solids();
    solids.extend(furniture::solids());
    for (index, solid) in solids.iter().enumerate() {
        let Form::Box { corner, edges } = &solid.form else { continue };
        for k in 0..27_u32 {
            let steps = [k % 3, k / 3 % 3, k / 9].map(|s| 0.5 * f64::from(s));
            let p = (0..3).fold(*corner, |p, axis| p + edges[axis] * steps[axis]);
            let inside = [(p.x, LENGTH_M), (p.y, WIDTH_M), (p.z, HEIGHT_M)];
            assert!(inside.iter().all(|&(c, end)| c > 0.0 && c < end), "{p:?} is outside");
            for (other, obstacle) in solids.iter().enumerate().filter(|(other, _)| *other != index)
            {
                assert!(
                    !contains(obstacle, p),
                    "solid {index} ({:?}) reaches into {other} ({:?}) at {p:?}",
                    solid.surface,
                    obstacle.surface
                );
            }
        }
    }
}

#[test]
fn variants_are_read_or_refused_with_a_remedy() {
    for (settings, expected) in [
        ("", Variant::STANDARD),
        (",triangles=100000", variant(100_000, 2626)),
        (",triangles=1e6,luminaires=100", variant(1_000_000, 100)),
        (",luminaires=1e5", variant(10_000, 100_000)),
    ] {
        assert_eq!(Variant::parse(settings), Ok(expected), "{settings}");
    }
    for (settings, named) in [
        (",", "triangles=N"),
        (",lumens=3", "lumens"),
        (",triangles", "10000 to 10000000"),
        (",triangles=", "10000 to 10000000"),
        (",triangles=9999", "10000 to 10000000"),
        (",triangles=1e8", "10000 to 10000000"),
        (",triangles=NaN", "10000 to 10000000"),
        (",luminaires=-5", "100 to 100000"),
        (",luminaires=100.5", "100 to 100000"),
        (",luminaires=200,luminaires=300", "twice"),
        (",triangles=1e5;luminaires=100", "10000 to 10000000"),
    ] {
        let error = Variant::parse(settings).unwrap_err().to_string();
        assert!(error.contains(named), "{settings}: {error}");
    }
}

#[test]
fn cameras_are_in_the_open_and_have_names() {
    let scene = Scene::assemble(parts(Variant::STANDARD)).unwrap();
    assert!(scene.cameras().len() >= 4);
    for camera in scene.cameras() {
        let hit = scene.bvh().closest_hit(&Ray::new(camera.position, camera.direction)).unwrap();
        assert!(!is_inner_side(&scene, &hit) && hit.t > 0.5, "{}", camera.name);
    }
}
