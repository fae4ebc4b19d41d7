//! Surfaces that no light comes to.

use super::*;

/// A lit floor, one that is lit in part, one that is known to be dark, and one of which nothing is known.
fn floors() -> Scene {
    let floor =
        |name: &str, z: f64| quad(name, [0.0, 0.0, z], [[4.0, 0.0, 0.0], [0.0, 4.0, 0.0]], 4);
    scene(vec![floor("lit", 0.0), floor("half", 3.0), floor("dark", 6.0), floor("hidden", 9.0)])
}

fn light(scene: &Scene) -> IlluminationMap {
    map(scene, |[x, _, z]| match z {
        z if z < 1.0 => Some(200.0),
        z if z < 4.0 => Some(if x < 1.5 { 200.0 } else { 0.0 }),
        z if z < 7.0 => Some(0.0),
        _ => None,
    })
}

#[test]
fn whole_surfaces_are_dark_and_not_parts_of_lit_ones() {
    let scene = floors();
    let dark = dark_sides(&scene, &light(&scene));
    for triangle in 0..scene.triangle_count() {
        assert_eq!(dark.contains(&(triangle, false)), scene.shape_of(triangle) >= 2, "{triangle}");
        assert!(!dark.contains(&(triangle, true)), "backs carry no map");
    }
}

#[test]
fn a_doubt_is_light() {
    let scene = floors();
    let mut map = light(&scene);
    let is_dark = |v: &&mut Option<VertexLight>| v.is_some_and(|v| v.illuminance_lx() == 0.0);
    map.values.iter_mut().filter(is_dark).flatten().for_each(|v| v.standard_error_lx = 0.1);
    let dark = dark_sides(&scene, &map);
    assert!(dark.iter().all(|&(triangle, _)| scene.shape_of(triangle) == 3) && dark.len() == 32);
}

#[test]
fn dark_surfaces_take_no_page_and_are_black() {
    let scene = floors();
    let map = light(&scene);
    let whole = plan(&scene, &settings(16.0), &UvUnwrap).unwrap();
    let dark = dark_sides(&scene, &map);
    let layout = plan_without(&scene, &settings(16.0), &UvUnwrap, &dark).unwrap();
    assert_eq!((whole.charts, layout.charts), (4, 2));
    assert_eq!(layout.sides.len(), whole.sides.len());
    // Half of the surfaces, and a square of four texels in its padding.
    assert!(layout.texel_count() < whole.texel_count() * 6 / 10, "{}", layout.texel_count());
    let lightmap = bake(&scene, &map, &layout, &mut |_| Pace::Whole).unwrap();
    for side in &lightmap.layout.sides {
        assert_eq!(side.is_point(), dark.contains(&(side.triangle, side.back)));
        for at in lightmap.layout.corners(side) {
            let lx = lightmap.lookup(side.page, at).luminance();
            match scene.shape_of(side.triangle) {
                0 => assert!((lx - 200.0).abs() < 0.1, "{lx}"),
                1 => {}
                _ => assert_eq!(lx, 0.0),
            }
        }
    }
    let black = lightmap.layout.sides.iter().find(|side| side.is_point()).unwrap();
    let [x, y] = lightmap.layout.corners(black)[0];
    for (dx, dy) in (-2..=2).flat_map(|dx| (-2..=2).map(move |dy| (f64::from(dx), f64::from(dy)))) {
        assert_eq!(lightmap.lookup(black.page, [x + dx, y + dy]).luminance(), 0.0, "{dx} {dy}");
    }
    assert_eq!(Lightmap::from_arrays(lightmap.to_arrays(), &scene), Ok(lightmap));
}

#[test]
fn where_all_is_dark_all_has_texels() {
    let scene = floors();
    let dark = dark_sides(&scene, &map(&scene, |_| None));
    assert_eq!(dark.len(), 128);
    let layout = plan_without(&scene, &settings(4.0), &UvUnwrap, &dark);
    assert_eq!(layout, plan(&scene, &settings(4.0), &UvUnwrap));
}

#[test]
fn dark_surfaces_count_for_neither_density_nor_memory() {
    let sides = [[4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let sky = [[4000.0, 0.0, 0.0], [0.0, 4000.0, 0.0]];
    let lit = || quad("lit", [0.0; 3], sides, 4);
    let scene = scene(vec![lit(), quad("sky", [0.0, 0.0, 900.0], sky, 1)]);
    let map = map(&scene, |[_, _, z]| (z < 1.0).then_some(200.0));
    let dark = dark_sides(&scene, &map);
    let usual = LightmapSettings::default();
    let alone = plan(&super::scene(vec![lit()]), &usual, &UvUnwrap).unwrap();
    let layout = plan_without(&scene, &usual, &UvUnwrap, &dark).unwrap();
    assert_eq!(layout.asked_texels_per_m, alone.asked_texels_per_m);
    assert!(layout.texel_count() < 2 * alone.texel_count(), "{}", layout.texel_count());
    assert_eq!(dark_share(&scene, &map, &layout), 0.0);
    // With the sky, 3.2 x 10^9 texels at 20 a metre squared are refused.
    let dense = settings(20.0);
    let whole = plan(&scene, &dense, &UvUnwrap);
    assert!(matches!(whole, Err(LightmapError::Memory { .. })), "{whole:?}");
    plan_without(&scene, &dense, &UvUnwrap, &dark).unwrap();
    let sparse = plan(&scene, &settings(0.5), &UvUnwrap).unwrap();
    assert!(dark_share(&scene, &map, &sparse) > 0.99);
}
