//! Both sides of seams.

use super::*;

/// Two halves of a floor, as objects of their own.
fn halves() -> Scene {
    scene(vec![
        quad("left", [0.0; 3], [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0]], 2),
        quad("right", [2.0, 0.0, 0.0], [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0]], 2),
    ])
}

#[test]
fn objects_that_continue_each_other_agree_on_their_edge() {
    let scene = halves();
    let map = map(&scene, |[x, y, _]| Some(100.0 + 40.0 * x + 10.0 * y * y));
    let seams = baked(&scene, &map, 8.0).seams;
    assert_eq!(seams.edges, 2);
    // Lengths of f32 coordinates.
    assert!((seams.length_m - 3.0).abs() < 1e-6);
    assert!(seams.before.largest_lx > 1.0, "{seams:?}");
    assert!(seams.after.largest_lx < 0.2 * seams.before.largest_lx, "{seams:?}");
    assert!(seams.after.rms_lx < 0.2 * seams.before.rms_lx, "{seams:?}");
    assert!(seams.rms_change_errors < 2.0 && seams.stopped < 0.1, "{seams:?}");
}

#[test]
fn texels_move_by_no_more_than_twice_their_standard_error() {
    let scene = halves();
    // A step of light at the seam, forty errors high: no noise, so it stays.
    let map = map(&scene, |[x, ..]| Some(if x < 1.9 { 100.0 } else { 140.0 }));
    let lightmap = baked(&scene, &map, 8.0);
    for texel in 0..lightmap.covers.len() {
        let Some(known) = lightmap.texel(texel) else { continue };
        let (side, [u, v]) = lightmap.place(texel).unwrap();
        let read = map.interpolate(side.triangle, side.back, u, v).unwrap().illuminance_lx();
        let moved = (known.illuminance_lx.luminance() - read).abs();
        // The light rises by 40 lx within a metre: a texel of 1/8 m may differ from its centre by half of 5 lx.
        assert!(moved <= 2.0 * known.standard_error_lx + 2.5 + 1e-3, "{moved} {known:?}");
    }
}

/// A ball of flat quadrangles with smooth normals, its poles left open.
fn ball(rings: u32, sectors: u32) -> Shape {
    let at = |ring: u32, sector: u32| {
        let turn = std::f64::consts::PI;
        let down = turn * f64::from(ring + 1) / f64::from(rings + 2);
        let round = 2.0 * turn * f64::from(sector % sectors) / f64::from(sectors);
        [down.sin() * round.cos(), down.sin() * round.sin(), down.cos()]
    };
    let number = |ring: u32, sector: u32| ring * sectors + sector % sectors;
    let each = |rings: u32| (0..rings).flat_map(move |r| (0..sectors).map(move |s| (r, s)));
    let positions: Vec<[f64; 3]> = each(rings + 1).map(|(r, s)| at(r, s)).collect();
    let triangles = each(rings).flat_map(|(r, s)| {
        let [a, b, c, d] =
            [(r, s), (r + 1, s), (r + 1, s + 1), (r, s + 1)].map(|(r, s)| number(r, s));
        [[a, b, c], [a, c, d]]
    });
    Shape {
        name: "ball".into(),
        triangles: triangles.collect(),
        normals: Some(positions.clone()),
        positions,
        ..Shape::default()
    }
}

#[test]
fn texels_beside_charts_are_no_brighter_than_what_is_known() {
    // Facets of three texels, known to a hundredth: charts disagree by more than that all along their borders.
    let scene = scene(vec![ball(4, 12)]);
    let map = map(&scene, |[x, y, z]| Some(5.0 + 1000.0 * (0.6 * x + 0.3 * y + 0.7 * z).max(0.0)));
    for texels_per_m in [3.0, 6.0, 12.0] {
        let lightmap = baked(&scene, &map, texels_per_m);
        let most = |cover: Cover| {
            let of = |&texel: &usize| lightmap.covers[texel] == cover;
            let lx = |texel: usize| Rgb(lightmap.shown_lx[texel].map(f64::from)).luminance();
            (0..lightmap.covers.len()).filter(of).map(lx).fold(0.0, f64::max)
        };
        let (filled, known) = (most(Cover::Filled), most(Cover::Known));
        // Known ones move by two hundredths.
        assert!(filled <= 1.02 * known, "{filled} {known}");
        let seams = lightmap.seams;
        assert!(seams.before.largest_lx > 1.0, "{seams:?}");
        assert!(seams.after.largest_lx <= seams.before.largest_lx, "{seams:?}");
        assert!(seams.after.rms_lx < 0.8 * seams.before.rms_lx, "{seams:?}");
    }
}

#[test]
fn creases_are_no_seams() {
    let scene = scene(vec![
        quad("floor", [0.0; 3], [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0]], 1),
        quad("wall", [0.0; 3], [[0.0, 2.0, 0.0], [0.0, 0.0, 2.0]], 1),
    ]);
    let map = map(&scene, |[_, _, z]| Some(if z > 0.0 { 10.0 } else { 100.0 }));
    assert_eq!(baked(&scene, &map, 8.0).seams, SeamReport::default());
}

#[test]
fn edges_that_end_within_others_are_stitched() {
    // Two edges of 1.5 m beside three of 1 m.
    let scene = scene(vec![
        quad("left", [0.0; 3], [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0]], 2),
        quad("right", [2.0, 0.0, 0.0], [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0]], 3),
    ]);
    let map = map(&scene, |[x, y, _]| Some(100.0 + 40.0 * x + 10.0 * y * y));
    let seams = baked(&scene, &map, 8.0).seams;
    assert_eq!((seams.edges, seams.t_junctions), (4, 4));
    // Lengths of f32 coordinates.
    assert!((seams.length_m - 3.0).abs() < 1e-6);
    assert!(seams.before.largest_lx > 1.0, "{seams:?}");
    assert!(seams.after.largest_lx < 0.2 * seams.before.largest_lx, "{seams:?}");
    assert!(seams.rms_change_errors < 2.0 && seams.stopped < 0.1, "{seams:?}");
}

#[test]
fn parallel_edges_and_those_that_meet_at_a_corner_are_no_t_junctions() {
    let step =
        |name: &str, corner: [f64; 3]| quad(name, corner, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], 1);
    // A millimetre apart, and corner to corner.
    let scene = scene(vec![
        step("first", [0.0; 3]),
        step("apart", [1.001, 0.25, 0.0]),
        step("corner", [-1.0, -1.0, 0.0]),
        step("further", [0.0, 1.0 + 1e-4, 0.0]),
    ]);
    let map = map(&scene, |_| Some(100.0));
    assert_eq!(baked(&scene, &map, 8.0).seams, SeamReport::default());
}
