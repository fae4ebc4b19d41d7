//! Where charts lie.

use super::*;
use crate::lightmap::cover::fragments;

fn room() -> Scene {
    scene(vec![
        quad("floor", [0.0; 3], [[4.0, 0.0, 0.0], [0.0, 3.0, 0.0]], 2),
        quad("wall", [0.0, 0.0, 0.0], [[0.0, 3.0, 0.0], [0.0, 0.0, 2.5]], 3),
        quad("tile", [1.0, 1.0, 0.8], [[1.0, 0.0, 0.0], [0.0, 0.8, 0.0]], 1),
    ])
}

#[test]
fn no_two_sides_share_a_place_and_every_square_metre_has_its_texels() {
    let scene = room();
    let layout = plan(&scene, &settings(20.0), &UvUnwrap).unwrap();
    assert_eq!(layout.sides.len(), scene.triangle_count() as usize);
    let found = fragments(&scene, &layout);
    let mut shares = vec![0.0; layout.texel_count()];
    for fragment in &found {
        shares[fragment.texel as usize] += f64::from(fragment.share);
    }
    // Sums of a few f32 near one.
    assert!(shares.iter().all(|share| *share <= 1.0 + 1e-5));
    let area_m2: f64 = found.iter().map(|f| f64::from(f.area_m2)).sum();
    assert!((area_m2 / lit_area_m2(&scene) - 1.0).abs() < 1e-5, "{area_m2}");
    let texels: f64 = shares.iter().sum();
    // Flat charts are not distorted, but for the rounding of coordinates.
    assert!((texels / (400.0 * area_m2) - 1.0).abs() < 1e-3, "{texels}");
}

#[test]
fn charts_end_at_creases() {
    let scene = room();
    let layout = plan(&scene, &settings(10.0), &UvUnwrap).unwrap();
    // Floor, wall and tile; floor and wall meet at a right angle.
    assert_eq!(layout.charts, 3);
    let corner = |triangle: usize| layout.corners(&layout.sides[triangle]);
    let texels_apart = |a: [[f64; 2]; 3], b: [[f64; 2]; 3]| {
        let all = a.into_iter().flat_map(|p| b.map(|q| (p[0] - q[0]).hypot(p[1] - q[1])));
        all.fold(f64::INFINITY, f64::min)
    };
    // The first of the floor and of the wall: both in the corner of the room.
    assert!(texels_apart(corner(0), corner(8)) >= 2.0 * f64::from(layout.padding));
}

#[test]
fn a_density_is_chosen_by_the_size_of_the_scene() {
    let density = |size: f64| {
        let floor = quad("floor", [0.0; 3], [[size, 0.0, 0.0], [0.0, size, 0.0]], 1);
        plan(&scene(vec![floor]), &LightmapSettings::default(), &UvUnwrap).unwrap()
    };
    let (small, large) = (density(0.1), density(100.0));
    for layout in [&small, &large] {
        let texels = layout.texel_count() as f64;
        assert!((100_000.0..200_000.0).contains(&texels), "{texels}");
    }
    assert_eq!((small.texels_per_m, large.texels_per_m), (3600.0, 3.6));
}

#[test]
fn what_does_not_fit_is_refused_before_it_is_tried() {
    let scene = room();
    for texels_per_m in [1e5, 1e30, f64::MAX] {
        let refused = plan(&scene, &settings(texels_per_m), &UvUnwrap);
        assert!(matches!(refused, Err(LightmapError::Memory { .. })), "{refused:?}");
    }
    for texels_per_m in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = plan(&scene, &settings(texels_per_m), &UvUnwrap);
        assert!(matches!(refused, Err(LightmapError::Density(_))), "{refused:?}");
    }
}

#[test]
fn large_surfaces_take_several_pages_and_charts_no_more_than_one() {
    let scene = room();
    let small = LightmapSettings { page: 64, ..settings(30.0) };
    let layout = plan(&scene, &small, &UvUnwrap).unwrap();
    assert!(layout.pages > 1 && layout.width <= 64 && layout.height <= 64);
    for side in &layout.sides {
        assert!(side.page < layout.pages);
        assert!(side.uvs.iter().flatten().all(|c| (0.0..=1.0).contains(c)));
    }
}
