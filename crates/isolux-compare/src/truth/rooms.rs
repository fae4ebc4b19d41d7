//! Rooms with furniture.

use super::stage::Stage;

/// A table, stools, cupboards, a bookcase; a lamp or two at a usual height.
pub(super) fn furnished(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    stage.furnish(size);
    for _ in 0..stage.draw.count(1, 3) {
        let [x, y] = stage.place(size, 0.8);
        stage.lamp([x, y, size[2] - 0.5], 120.0);
    }
}

/// Blocks that touch walls and floor or cut through each other, askew.
pub(super) fn blocks(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    for _ in 0..stage.draw.count(6, 12) {
        let [x, y] = stage.place(size, 0.5);
        let [a, b, h] = [0.8, 0.8, 1.6].map(|most| stage.draw.between(0.1, most));
        let turn_deg = stage.draw.pick(&[0.0, 0.0, 20.0, 45.0]);
        let paint = stage.any_paint(0.1, 0.8);
        let low_z = stage.draw.pick(&[0.0, 0.0, 0.3]);
        let high = [x + 0.5 * a, y + 0.5 * b, low_z + h];
        stage.turned_solid("block", [x - 0.5 * a, y - 0.5 * b, low_z], high, turn_deg, paint);
    }
    let depth_m = stage.draw.between(0.3, 0.6);
    let paint = stage.any_paint(0.3, 0.6);
    stage.solid("wardrobe", [0.0; 3], [depth_m, 0.5 * size[1], 2.0], paint);
    let [x, y] = stage.place(size, 0.6);
    stage.lamp([x, y, size[2] - 0.25], 250.0);
}

/// Rugs and pictures a millimetre, or a centimetre, from what they lie and hang on.
pub(super) fn rugs_and_pictures(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    let gap_m = stage.draw.pick(&[0.001, 0.01]);
    let rug = stage.sheet_paint(0.2);
    let [x, y] = stage.place(size, 1.3);
    stage.sheet("rug", [x - 1.2, y - 1.0, gap_m], [2.4, 0.0, 0.0], [0.0, 2.0, 0.0], rug);
    stage.sheet("rug", [x - 1.0, y - 0.8, 2.0 * gap_m], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], rug);
    let picture = stage.any_paint(0.05, 0.9);
    for _ in 0..stage.draw.count(2, 5) {
        let (at, z) = (stage.draw.between(0.2, size[1] - 1.0), stage.draw.between(1.0, 1.5));
        let [wide, high] = [0.7, 0.9].map(|most| stage.draw.between(0.2, most));
        stage.solid("picture", [gap_m, at, z], [gap_m + 0.02, at + wide, z + high], picture);
    }
    let canvas = stage.sheet_paint(0.6);
    let corner = [0.5, size[1] - gap_m, 1.2];
    stage.sheet("canvas", corner, [1.0, 0.0, 0.0], [0.0, 0.0, 0.7], canvas);
    let lamp_z = size[2] - stage.draw.pick(&[0.001, 0.3, 0.8]);
    stage.lamp([0.5 * size[0], 0.5 * size[1], lamp_z], 150.0);
}

/// Bookcases and a kitchen, lit from strips beneath its cupboards.
pub(super) fn shelves(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    let wood = stage.any_paint(0.25, 0.6);
    let mut y = 0.7;
    while y + 0.9 < size[1] {
        let boards = stage.draw.count(4, 8);
        stage.bookcase(y, [0.3, 0.9, 2.0], boards, wood);
        y += 0.9;
    }
    let front = stage.any_paint(0.6, 0.85);
    stage.cupboards(1.0, size[0] - 1.0, front);
    let strip = stage.luminous(3000.0, 0.0);
    let corner = [1.2, 0.2, 1.449];
    stage.sheet("strip", corner, [0.0, 0.02, 0.0], [size[0] - 1.4, 0.0, 0.0], strip);
    let [x, y] = stage.place(size, 1.0);
    stage.lamp([x, y, size[2] - 0.4], 100.0);
}

/// A pendant low above a table, in a shade or bare.
pub(super) fn low_pendant(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    let wood = stage.any_paint(0.3, 0.7);
    let at = stage.place(size, 1.0);
    stage.table(at, [1.6, 0.9], 0.75, wood);
    let above_m = stage.draw.pick(&[0.05, 0.15, 0.4]);
    let z = 0.75 + above_m;
    if stage.draw.chance(0.5) {
        let shade = stage.sheet_paint(0.7);
        stage.tube(at, [0.2, 0.1], [z - 0.02, z + 0.2], shade);
    }
    stage.lamp([at[0], at[1], z], 60.0);
}
