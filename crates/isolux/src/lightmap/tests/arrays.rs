//! Lightmaps as arrays, and what is no lightmap.

use super::*;

/// A wide quad and a long one, of which a part is unknown.
fn baked_quads() -> (Scene, Lightmap) {
    let wide = quad("wide", [0.0; 3], [[4.0, 0.0, 0.0], [0.0, 1.0, 0.0]], 2);
    let long = quad("long", [0.0, 0.0, 1.0], [[0.4, 0.0, 0.0], [0.0, 6.0, 0.0]], 3);
    let scene = scene(vec![wide, long]);
    let map = map(&scene, |[x, y, z]| (z < 0.5 || y < 3.0).then_some(100.0 + 30.0 * x + y));
    let lightmap = baked(&scene, &map, 8.0);
    (scene, lightmap)
}

fn refused(
    spoil: impl Fn(&mut LightmapArrays),
    scene: &Scene,
    lightmap: &Lightmap,
) -> LightmapArraysError {
    let mut arrays = lightmap.to_arrays();
    spoil(&mut arrays);
    Lightmap::from_arrays(arrays, scene).unwrap_err()
}

#[test]
fn nothing_is_lost() {
    let (scene, lightmap) = baked_quads();
    for cover in [Cover::Empty, Cover::Filled, Cover::Unknown, Cover::Known] {
        assert!(lightmap.count(cover) > 0, "{cover:?}");
    }
    let arrays = lightmap.to_arrays();
    assert!(arrays.shown_lx.len() < lightmap.shown_lx.len());
    assert_eq!(Lightmap::from_arrays(arrays, &scene), Ok(lightmap));
}

#[test]
fn what_does_not_fit_together_is_refused() {
    use LightmapArraysError as Why;
    let (scene, lightmap) = baked_quads();
    let refused = |spoil: &dyn Fn(&mut LightmapArrays)| refused(spoil, &scene, &lightmap);
    assert_eq!(refused(&|a| a.layout.width = 0), Why::Size);
    assert_eq!(refused(&|a| a.layout.pages = u32::MAX), Why::Size);
    assert_eq!(
        refused(&|a| {
            a.covers.pop();
        }),
        Why::Size
    );
    assert_eq!(
        refused(&|a| {
            a.shown_lx.pop();
        }),
        Why::Length
    );
    assert_eq!(refused(&|a| a.coverage.push(0.5)), Why::Length);
    assert_eq!(refused(&|a| a.owners[3] = 1_000_000), Why::Side);
    assert_eq!(refused(&|a| a.layout.sides[0].triangle = 1_000_000), Why::Side);
    assert_eq!(refused(&|a| a.layout.sides[0].page = a.layout.pages), Why::Side);
    let nowhere = |side: &mut Side| side.uvs[1][0] = f32::NAN;
    assert_eq!(refused(&|a| nowhere(&mut a.layout.sides[0])), Why::Side);
    assert_eq!(refused(&|a| a.shown_lx[0][1] = f32::INFINITY), Why::Value);
    assert_eq!(refused(&|a| a.standard_errors_lx[0] = -1.0), Why::Value);
    assert_eq!(refused(&|a| a.layout.texels_per_m = 0.0), Why::Value);
}
