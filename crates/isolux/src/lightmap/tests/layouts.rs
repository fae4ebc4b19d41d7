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

#[test]
fn the_density_told_is_that_of_charts_cut_down_to_a_page() {
    let strip = |length: f64| quad("strip", [0.0; 3], [[length, 0.0, 0.0], [0.0, 0.3, 0.0]], 1);
    let tile = quad("tile", [0.0, 0.0, 1.0], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], 1);
    let small = LightmapSettings { page: 256, ..settings(60.0) };
    let density = |shapes: Vec<Shape>| {
        let scene = scene(shapes);
        let layout = plan(&scene, &small, &UvUnwrap).unwrap();
        let texels: f64 = fragments(&scene, &layout).iter().map(|f| f64::from(f.share)).sum();
        // Coordinates are f32.
        let off = layout.texels_per_m / (texels / lit_area_m2(&scene)).sqrt() - 1.0;
        assert!(off.abs() < 1e-3, "{off}");
        assert_eq!(layout.asked_texels_per_m, 60.0);
        (layout.texels_per_m, layout.least_texels_per_m, layout.is_short())
    };
    assert_eq!(density(vec![strip(4.0), tile.clone()]), (60.0, 60.0, false));
    // Of 256 texels, two of padding on either side: 252 for 6 m.
    let (mean, least, is_short) = density(vec![strip(6.0)]);
    assert!(
        (mean - 42.0).abs() < 0.05 && (least - 42.0).abs() < 0.05 && is_short,
        "{mean} {least}"
    );
    let (mean, least, is_short) = density(vec![strip(6.0), tile]);
    // The strip has 1.8 m2, the tile 1 m2: the root of the mean of squares.
    assert!(
        (mean - 49.19).abs() < 0.05 && (least - 42.0).abs() < 0.05 && is_short,
        "{mean} {least}"
    );
}

#[test]
fn a_density_at_which_nothing_covers_a_texel_is_refused() {
    let refused = plan(&room(), &settings(1e-9), &UvUnwrap);
    assert_eq!(refused, Err(LightmapError::Sparse(1e-9)));
}

/// The floor with places of its own on a page.
fn placed(places: impl Fn([f64; 3]) -> [f32; 2]) -> Shape {
    let floor = quad("floor", [0.0; 3], [[4.0, 0.0, 0.0], [0.0, 4.0, 0.0]], 2);
    let lightmap_uvs = Some(floor.positions.iter().map(|&p| places(p)).collect());
    Shape { lightmap_uvs, ..floor }
}

fn left_half([x, y, _]: [f64; 3]) -> [f32; 2] {
    [0.05 + 0.1 * x as f32, 0.05 + 0.1 * y as f32]
}

#[test]
fn places_of_the_file_are_kept_where_they_serve() {
    let wall = quad("wall", [0.0; 3], [[0.0, 3.0, 0.0], [0.0, 0.0, 2.5]], 1);
    let scene = scene(vec![placed(left_half), wall]);
    let layout = plan(&scene, &settings(10.0), &UvUnwrap).unwrap();
    assert_eq!(layout.own_places, OwnPlaces::Kept);
    // 0.1 of the page a metre: ten texels a metre on a page of a hundred.
    assert_eq!((layout.width, layout.height, layout.pages), (100, 100, 2));
    for side in &layout.sides {
        match scene.shape_of(side.triangle) {
            0 => assert_eq!(Some(side.uvs), scene.corner_lightmap_uvs(side.triangle)),
            _ => assert_eq!(side.page, 1),
        }
    }
    let rest: f64 = fragments(&scene, &layout)
        .iter()
        .filter(|f| scene.shape_of(layout.sides[f.side as usize].triangle) == 1)
        .map(|f| f64::from(f.share))
        .sum();
    // Of the wall, 7.5 m2 at a hundred texels each; coordinates of f32.
    assert!((rest - 750.0).abs() < 1.0, "{rest}");
}

#[test]
fn charts_that_touch_on_the_page_alone_are_two() {
    // A floor, and beside it on the page, without a margin, another that lies a metre away.
    let beside = |[x, y, z]: [f64; 3]| left_half([x - 1.0, y, z]);
    let far = quad("far", [5.0, 0.0, 0.0], [[4.0, 0.0, 0.0], [0.0, 4.0, 0.0]], 2);
    let lightmap_uvs = Some(far.positions.iter().map(|&p| beside(p)).collect());
    let scene = scene(vec![placed(left_half), Shape { lightmap_uvs, ..far }]);
    let edge = |triangle: u32| scene.corner_lightmap_uvs(triangle).unwrap();
    let shared =
        (0..8).flat_map(edge).filter(|uv| (8..16).flat_map(edge).any(|other| other == *uv));
    assert!(shared.count() > 2, "they have edges in common on the page, bit for bit");
    let layout = plan(&scene, &settings(10.0), &UvUnwrap).unwrap();
    let OwnPlaces::Refused(why) = &layout.own_places else { panic!("{:?}", layout.own_places) };
    assert!(why.contains("nearer than a texel"), "{why}");
    assert_eq!(layout.charts, 2);
}

#[test]
fn pieces_that_share_an_edge_in_space_too_are_one_chart() {
    let half = |name: &str, x: f64| {
        let floor = quad(name, [x, 0.0, 0.0], [[2.0, 0.0, 0.0], [0.0, 4.0, 0.0]], 1);
        let lightmap_uvs = Some(floor.positions.iter().map(|&p| left_half(p)).collect());
        Shape { lightmap_uvs, ..floor }
    };
    let scene = scene(vec![half("left", 0.0), half("right", 2.0)]);
    let layout = plan(&scene, &settings(10.0), &UvUnwrap).unwrap();
    assert_eq!((layout.own_places, layout.charts), (OwnPlaces::Kept, 1));
}

#[test]
fn places_of_the_file_are_refused_with_a_reason() {
    let apart = |shift: f32| move |[x, y, _]: [f64; 3]| [shift + 0.1 * x as f32, 0.1 * y as f32];
    let refused = |shapes: Vec<Shape>| {
        let layout = plan(&scene(shapes), &settings(10.0), &UvUnwrap).unwrap();
        match layout.own_places {
            OwnPlaces::Refused(why) => why,
            other => panic!("{other:?}"),
        }
    };
    let beyond = refused(vec![placed(apart(0.7))]);
    assert!(beyond.contains("leave 0 to 1"), "{beyond}");
    let twice = refused(vec![placed(apart(0.1)), placed(apart(0.2))]);
    assert!(twice.contains("overlap"), "{twice}");
    // Charts beside each other in a texel are met first, but more density would not help.
    let overlapping = |name: &str, shift: f32| Shape { name: name.into(), ..placed(apart(shift)) };
    let both = refused(vec![overlapping("a", 0.0), overlapping("b", 0.405), overlapping("c", 0.5)]);
    assert!(both.contains("`b` and `c` overlap"), "{both}");
    let fold = |[x, y, _]: [f64; 3]| [0.1 * (x - 2.0).abs() as f32, 0.1 * y as f32];
    let itself = refused(vec![placed(fold)]);
    assert!(itself.contains("overlap themselves"), "{itself}");
    let near = refused(vec![placed(apart(0.0)), placed(apart(0.405))]);
    assert!(near.contains("nearer than a texel"), "{near}");
    let flat = refused(vec![placed(|_| [0.5, 0.5])]);
    assert!(flat.contains("no area"), "{flat}");
    let wide = quad("wide", [0.0, 0.0, 3.0], [[30.0, 0.0, 0.0], [0.0, 30.0, 0.0]], 1);
    let small = refused(vec![placed(apart(0.1)), wide]);
    assert!(small.contains("too small for the rest"), "{small}");
    let nan = refused(vec![placed(|_| [f32::NAN, 0.5])]);
    assert!(nan.contains("leave 0 to 1"), "{nan}");
}
