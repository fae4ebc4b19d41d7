//! Texels against what the map says.

use super::*;
use crate::engine::{MapReader, SolveRequest, Watch, solve};
use crate::lightmap::cover::{self, Fragment};
use crate::photometry::IntensityDistribution;
use crate::scene::{Luminaire, LuminaireKind};
use isolux_geometry::{Point, Transform};

fn floor() -> Scene {
    scene(vec![quad("floor", [0.0; 3], [[4.0, 0.0, 0.0], [0.0, 3.0, 0.0]], 2)])
}

#[test]
fn texels_are_means_over_what_they_cover() {
    let scene = floor();
    let map = map(&scene, |[x, y, _]| Some(100.0 + 30.0 * x + 10.0 * y));
    let lightmap = baked(&scene, &map, 4.0);
    let fragments = cover::fragments(&scene, &lightmap.layout);
    assert!(lightmap.count(Cover::Known) >= 192);
    for of_texel in fragments.chunk_by(|a, b| a.texel == b.texel) {
        // A linear map has its mean in the middle of what is covered.
        let (mut area, mut mean) = (0.0, 0.0);
        for fragment in of_texel {
            let polygon = cover::polygon(&lightmap.layout, fragment);
            let [u, v] = cover::weights(&lightmap.layout, fragment.side, polygon.centroid());
            let triangle = lightmap.layout.sides[fragment.side as usize].triangle;
            let at = scene.triangle(triangle).point(u, v);
            area += f64::from(fragment.area_m2);
            mean += f64::from(fragment.area_m2) * (100.0 + 30.0 * at.x + 10.0 * at.y);
        }
        let texel = lightmap.texel(of_texel[0].texel as usize).unwrap();
        let off = texel.illuminance_lx.luminance() / (mean / area) - 1.0;
        // Parts smaller than a tenth are left out: of a texel of 0.25 m, 32 lx/m over 120 lx.
        assert!(off.abs() < 0.1 * 0.25 * 32.0 / 120.0, "{off}");
        assert!((texel.standard_error_lx / texel.illuminance_lx.luminance() - 0.01).abs() < 0.005);
    }
}

#[test]
fn lookups_agree_with_readings_everywhere() {
    let scene = floor();
    let map = map(&scene, |[x, y, _]| Some(100.0 + 30.0 * x + 10.0 * y));
    let lightmap = baked(&scene, &map, 16.0);
    let reader = MapReader::new(&scene, &map);
    for (index, side) in lightmap.layout.sides.iter().enumerate() {
        for [u, v] in [[1.0 / 3.0, 1.0 / 3.0], [0.1, 0.2], [0.0, 0.5], [0.0, 0.0]] {
            let [a, b, c] = lightmap.layout.corners(side);
            let at = [0, 1].map(|k| a[k] * (1.0 - u - v) + b[k] * u + c[k] * v);
            let looked_up = lightmap.lookup(side.page, at).luminance();
            let read = reader.at(side.triangle, side.back, u, v).unwrap().illuminance_lx();
            // On the border of a chart the texels beside it continue it as a constant: half a texel of
            // 1/16 m, at 32 lx/m, and as much again where the border cuts a texel.
            assert!((looked_up - read).abs() < 32.0 / 16.0, "{index} {u} {v}: {looked_up} {read}");
        }
    }
}

#[test]
fn unknown_stays_unknown() {
    let scene = scene(vec![
        quad("floor", [0.0; 3], [[4.0, 0.0, 0.0], [0.0, 3.0, 0.0]], 1),
        quad("hidden", [0.0, 0.0, -1.0], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], 1),
    ]);
    let map = map(&scene, |[_, _, z]| (z > -0.5).then_some(200.0));
    let lightmap = baked(&scene, &map, 8.0);
    // One square metre: 8 x 8 texels, one more each way where it is not aligned with them.
    assert!((64..=81).contains(&lightmap.count(Cover::Unknown)));
    for (texel, cover) in lightmap.covers.iter().enumerate() {
        assert_eq!(lightmap.texel(texel).is_some(), *cover == Cover::Known);
        assert_eq!(lightmap.place(texel).is_some(), *cover != Cover::Empty);
    }
    let hidden = lightmap.layout.sides.iter().filter(|s| scene.shape_of(s.triangle) == 1);
    for side in hidden {
        let [a, b, c] = lightmap.layout.corners(side);
        let at = [0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0);
        let texel = lightmap.layout.index(side.page, at[0] as u32, at[1] as u32);
        assert_eq!(lightmap.covers[texel], Cover::Unknown);
    }
}

#[test]
fn a_lightmap_does_not_depend_on_the_number_of_threads() {
    let scene = floor();
    let map = map(&scene, |[x, y, _]| Some(100.0 + 30.0 * x * y));
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| baked(&scene, &map, 8.0))
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn who_has_no_time_gets_all_texels_coarsely() {
    let scene = floor();
    let map = map(&scene, |[x, y, _]| Some(100.0 + 30.0 * x * y));
    let layout = plan(&scene, &settings(8.0), &UvUnwrap).unwrap();
    let whole = baked(&scene, &map, 8.0);
    assert_eq!(whole.coarse, 0);
    let coarse = bake(&scene, &map, &layout, &mut |_| Pace::Coarse).unwrap();
    assert_eq!(coarse.covers, whole.covers);
    assert_eq!(coarse.coarse, whole.count(Cover::Known) as u64);
    for texel in 0..whole.covers.len() {
        let (Some(whole), Some(coarse)) = (whole.texel(texel), coarse.texel(texel)) else {
            continue;
        };
        let off = (whole.illuminance_lx - coarse.illuminance_lx).luminance().abs();
        assert!(off < 2.0 * coarse.standard_error_lx, "{texel}: {off} {coarse:?}");
        assert!(coarse.standard_error_lx > whole.standard_error_lx);
    }
    // Time that ends on the way leaves what was read before.
    let mut looks = 0;
    let mut later = |_| {
        looks += 1;
        if looks > 1 { Pace::Coarse } else { Pace::Whole }
    };
    let part = bake(&scene, &map, &layout, &mut later).unwrap();
    assert!(part.coarse > 0 && part.covers == whole.covers);
    // Once it is over, texels have the light that the map has between its vertices.
    let late = bake(&scene, &map, &layout, &mut |_| Pace::Late).unwrap();
    assert!(late.coarse > 0 && late.covers == whole.covers && late.readings < coarse.readings);
    for texel in 0..late.covers.len() {
        let (Some(whole), Some(late)) = (whole.texel(texel), late.texel(texel)) else { continue };
        let off = (whole.illuminance_lx - late.illuminance_lx).luminance().abs();
        assert!(off < 2.0 * late.standard_error_lx, "{texel}: {off} {late:?}");
    }
}

/// Regression: they counted as unknown, so that the lightmap of a run that ended early was empty.
#[test]
fn texels_of_a_map_whose_error_is_not_known_have_values() {
    let scene = floor();
    let mut map = map(&scene, |[x, y, _]| Some(100.0 + 30.0 * x * y));
    let whole = baked(&scene, &map, 8.0);
    for value in map.values.iter_mut().flatten() {
        value.standard_error_lx = f64::INFINITY;
        value.indirect_standard_error_lx = f64::INFINITY;
    }
    let baked = baked(&scene, &map, 8.0);
    assert_eq!(baked.covers, whole.covers);
    for texel in (0..baked.covers.len()).filter_map(|texel| baked.texel(texel)) {
        assert!(texel.standard_error_lx == f64::INFINITY && texel.illuminance_lx.is_finite());
    }
    let back = Lightmap::from_arrays(baked.to_arrays(), &scene).unwrap();
    assert_eq!(back, baked);
}

#[test]
fn whoever_watches_can_stop_it() {
    let scene = floor();
    let map = map(&scene, |_| Some(1.0));
    let layout = plan(&scene, &settings(8.0), &UvUnwrap).unwrap();
    let stopped = bake(&scene, &map, &layout, &mut |_| Pace::Stop);
    assert_eq!(stopped, Err(LightmapError::Stopped));
}

#[test]
fn what_is_far_from_all_that_is_known_is_black() {
    // A floor that goes on below a wall, into a room of which nothing is known.
    let scene = scene(vec![quad("floor", [0.0; 3], [[8.0, 0.0, 0.0], [0.0, 2.0, 0.0]], 4)]);
    let map = map(&scene, |[x, ..]| (x < 3.0).then_some(200.0));
    let lightmap = baked(&scene, &map, 8.0);
    let Layout { width, padding, .. } = lightmap.layout;
    let at = |texel: usize| [texel % width as usize, texel / width as usize];
    let known: Vec<[usize; 2]> =
        (0..lightmap.covers.len()).filter(|&t| lightmap.texel(t).is_some()).map(at).collect();
    let (mut near, mut far) = (0, 0);
    for texel in (0..lightmap.covers.len()).filter(|&t| lightmap.covers[t] == Cover::Unknown) {
        let [x, y] = at(texel);
        let distance = known.iter().map(|k| x.abs_diff(k[0]).max(y.abs_diff(k[1]))).min();
        let shown = lightmap.shown_lx[texel][1];
        if distance <= Some(padding as usize) {
            near += 1;
            assert!((shown - 200.0).abs() < 0.1, "{shown} beside what is known");
        } else {
            far += 1;
            assert_eq!(shown, 0.0, "{distance:?} texels from all that is known");
        }
    }
    // Elements reach 2 m: the map knows up to x = 4; of 16 texels across, two rows are near.
    assert!((28..=38).contains(&near) && far > 400, "{near} {far}");
}

#[test]
fn charts_of_which_nothing_is_known_take_no_light_from_those_beside_them() {
    // Two surfaces whose places the file has, two texels apart on the page.
    let placed = |name: &str, [x, z]: [f64; 2], u: f32| {
        let quad = quad(name, [x, 0.0, z], [[4.0, 0.0, 0.0], [0.0, 4.0, 0.0]], 2);
        let place = |p: &[f64; 3]| [u + 0.099 * (p[0] - x) as f32, 0.1 + 0.1 * p[1] as f32];
        Shape { lightmap_uvs: Some(quad.positions.iter().map(place).collect()), ..quad }
    };
    let scene = scene(vec![placed("lit", [0.0; 2], 0.0), placed("dark", [9.0, 0.0], 0.425)]);
    let map = map(&scene, |[x, ..]| (x < 8.0).then_some(200.0));
    let lightmap = baked(&scene, &map, 10.0);
    assert_eq!(lightmap.layout.own_places, OwnPlaces::Kept);
    let dark = lightmap.layout.sides.iter().filter(|s| scene.shape_of(s.triangle) == 1);
    for side in dark {
        for at in lightmap.layout.corners(side) {
            assert_eq!(lightmap.lookup(side.page, at).luminance(), 0.0, "{at:?}");
        }
    }
    let lit = lightmap.layout.sides.iter().filter(|s| scene.shape_of(s.triangle) == 0);
    for at in lit.flat_map(|side| lightmap.layout.corners(side)) {
        let lx = lightmap.lookup(0, at).luminance();
        assert!((lx - 200.0).abs() < 0.1, "{lx} at {at:?}");
    }
}

/// Two closed rooms that share floor, ceiling and walls, parted by a sheet. A lamp of 300 cd in one, of 0.3 cd in the other.
fn two_rooms(sheet_x: f64) -> Scene {
    let (u, v, w) = ([3.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.5]);
    let shapes = vec![
        quad("floor", [0.0; 3], [u, v], 1),
        quad("ceiling", [0.0, 0.0, 2.5], [v, u], 1),
        quad("left", [0.0; 3], [v, w], 1),
        quad("right", [3.0, 0.0, 0.0], [w, v], 1),
        quad("front", [0.0; 3], [w, u], 1),
        quad("rear", [0.0, 2.0, 0.0], [u, w], 1),
        quad("sheet", [sheet_x, 0.0, 0.0], [v, w], 1),
    ];
    let lamp = |position: [f64; 3], intensity_cd| Luminaire {
        name: "lamp".into(),
        group: 0,
        colour: Rgb::WHITE,
        kind: LuminaireKind::Point {
            position: Point::from(position),
            world_from_luminaire: Transform::IDENTITY,
            intensity: IntensityDistribution::Isotropic { intensity_cd },
            area: None,
        },
    };
    Scene::assemble(SceneParts {
        shapes,
        materials: vec![Material::two_sided("white", Finish::diffuse(Rgb::grey(0.7)))],
        luminaires: vec![lamp([0.7, 1.0, 1.5], 300.0), lamp([2.4, 1.0, 1.5], 0.3)],
        ..SceneParts::default()
    })
    .unwrap()
}

#[test]
fn floors_below_a_wall_carry_no_light_into_the_room_beyond() {
    let sheet_x = 1.37;
    let scene = two_rooms(sheet_x);
    let request = SolveRequest { accuracy: Some(0.05), ..SolveRequest::default() };
    let map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
    let texels_per_m = 15.0;
    let lightmap = baked(&scene, &map, texels_per_m);
    let fragments = cover::fragments(&scene, &lightmap.layout);
    let (mut lit, mut dark) = (0, 0);
    for of_texel in fragments.chunk_by(|a, b| a.texel == b.texel) {
        let side = &lightmap.layout.sides[of_texel[0].side as usize];
        let Some(texel) = lightmap.texel(of_texel[0].texel as usize) else { continue };
        if side.back || scene.shape_of(side.triangle) > 1 {
            continue;
        }
        let x_of = |fragment: &Fragment, of: [f64; 2]| {
            let place = cover::polygon(&lightmap.layout, fragment).point(of);
            let [u, v] = cover::weights(&lightmap.layout, fragment.side, place);
            let triangle = lightmap.layout.sides[fragment.side as usize].triangle;
            scene.triangle(triangle).point(u, v).x
        };
        // What it covers, but for less than a fifth of its width each way.
        let x_of = &x_of;
        let all = of_texel.iter().flat_map(|fragment| {
            (0..36)
                .map(move |k| x_of(fragment, [f64::from(k % 6), f64::from(k / 6)].map(|c| c / 5.0)))
        });
        let (least, most) = all.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
        let lx = texel.illuminance_lx.luminance();
        if least > sheet_x + 0.2 / texels_per_m {
            dark += 1;
            // By that lamp alone it is 0.3 to 1.2 lx: beyond the sheet it is hundreds.
            assert!(lx < 2.0, "{lx} lx {} m behind the sheet", least - sheet_x);
        } else if most < sheet_x - 0.2 / texels_per_m {
            lit += 1;
            assert!(lx > 50.0, "{lx} lx {} m before the sheet", sheet_x - most);
        }
    }
    assert!(lit > 1000 && dark > 1000, "{lit} {dark}");
}
