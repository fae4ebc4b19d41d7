//! Rooms that are more than one box.

use super::stage::Stage;

/// An L, lit in one arm.
pub(super) fn l_shaped(stage: &mut Stage) {
    let [a, b] = [0, 0].map(|_| stage.draw.between(4.0, 8.0));
    let [c, d] = [stage.draw.between(1.2, 0.6 * a), stage.draw.between(2.3, 0.6 * b)];
    let z = stage.draw.between(2.4, 3.0);
    let [floor, wall, white] = [0.3, 0.6, 0.8].map(|r| stage.any_paint(r, r));
    let plan = [[0.0, 0.0], [a, 0.0], [a, d], [c, d], [c, b], [0.0, b]];
    stage.walls_along(&plan, [0.0, z], wall);
    for ([x0, y0], [x1, y1]) in [([0.0, 0.0], [a, d]), ([0.0, d], [c, b])] {
        let [u, v] = [[x1 - x0, 0.0, 0.0], [0.0, y1 - y0, 0.0]];
        stage.sheet("floor", [x0, y0, 0.0], u, v, floor);
        stage.sheet("ceiling", [x0, y0, z], v, u, white);
    }
    stage.furnish([a, d, z]);
    stage.lamp([a - 0.5, 0.5 * d, z - 0.5], 200.0);
}

/// A cabin in a hall, closed or with a door; a box in the cabin.
pub(super) fn nested(stage: &mut Stage) {
    let size = [8.0, 7.0, 3.5].map(|side| side * stage.draw.between(0.8, 1.2));
    stage.room(size);
    let paint = stage.any_paint(0.5, 0.8);
    let (door_m, thick_m) = (stage.draw.pick(&[0.0, 0.02, 0.8]), 0.1);
    let [low, high] = [[2.0, 2.0], [4.5, 4.6]];
    let z = 2.3;
    stage.solid("roof", [low[0], low[1], z], [high[0], high[1], z + thick_m], paint);
    let mut wall = |from: [f64; 2], to: [f64; 2]| {
        stage.solid("cabin", [from[0], from[1], 0.0], [to[0], to[1], z], paint);
    };
    wall(low, [low[0] + thick_m, high[1]]);
    wall([high[0] - thick_m, low[1]], high);
    wall([low[0] + thick_m, high[1] - thick_m], [high[0] - thick_m, high[1]]);
    wall([low[0] + thick_m, low[1]], [3.2 - 0.5 * door_m, low[1] + thick_m]);
    wall([3.2 + 0.5 * door_m, low[1]], [high[0] - thick_m, low[1] + thick_m]);
    let wood = stage.any_paint(0.3, 0.6);
    stage.solid("chest", [2.4, 3.6, 0.0], [3.0, 4.2, 0.6], wood);
    stage.lamp([1.2, 1.2, size[2] - 0.6], 300.0);
    if stage.draw.chance(0.5) {
        stage.lamp([3.2, 3.2, 2.0], 20.0);
    }
}

/// A long corridor with niches and a row of lamps.
pub(super) fn corridor(stage: &mut Stage) {
    let size = [stage.draw.between(15.0, 40.0), stage.draw.between(1.2, 2.0), 2.5];
    stage.room(size);
    let wood = stage.any_paint(0.2, 0.5);
    let doors = (size[0] / 3.0) as u32;
    for door in 0..doors {
        let x = 1.0 + 3.0 * f64::from(door);
        stage.solid("door", [x, size[1] - 0.02, 0.005], [x + 0.9, size[1], 2.0], wood);
    }
    let lamps = stage.draw.pick(&[1, 5, 20]);
    let below_m = stage.draw.pick(&[0.0, 0.05, 0.3]);
    for lamp in 0..lamps {
        let x = size[0] * (f64::from(lamp) + 0.5) / f64::from(lamps);
        stage.lamp([x, 0.5 * size[1], size[2] - below_m], 400.0 / f64::from(lamps));
    }
    stage.solid("bench", [2.0, 0.0, 0.4], [4.0, 0.4, 0.45], wood);
}

/// A room with a candle beside a bright one, closed or with a gap between them.
pub(super) fn dim_beside_bright(stage: &mut Stage) {
    let [x, y, z] = stage.room_size();
    let gap_m = stage.draw.pick(&[0.0, 0.01, 0.1, 0.8]);
    let paint = stage.any_paint(0.5, 0.8);
    stage.bare_room([2.0 * x, y, z], paint);
    let from = stage.draw.between(0.3, y - 1.0);
    stage.solid("partition", [x - 0.05, 0.0, 0.0], [x + 0.05, from, z], paint);
    stage.solid("partition", [x - 0.05, from + gap_m, 0.0], [x + 0.05, y, z], paint);
    let wood = stage.any_paint(0.3, 0.6);
    stage.table([1.5 * x, 0.5 * y], [1.2, 0.8], 0.75, wood);
    let bright_cd = stage.draw.pick(&[1e3, 1e5]);
    stage.lamp([0.4 * x, 0.4 * y, 0.7 * z], bright_cd);
    stage.lamp([1.5 * x, 0.5 * y, 0.95], 1.0);
}
