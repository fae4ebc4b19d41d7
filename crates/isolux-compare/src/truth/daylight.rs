//! Sun and sky through a window.

use super::stage::Stage;

/// A window in a deep wall, the sky before it as a luminous surface, and at times the sun.
pub(super) fn window(stage: &mut Stage) {
    let size = stage.room_size();
    let [x, y, z] = size;
    let [floor, wall, white] = [0.3, 0.6, 0.8].map(|r| stage.any_paint(r, r));
    stage.level("floor", size, 0.0, floor);
    stage.ceiling(size, white);
    let up = [0.0, 0.0, z];
    stage.sheet("wall", [0.0; 3], [0.0, y, 0.0], up, wall);
    stage.sheet("wall", [x, 0.0, 0.0], up, [0.0, y, 0.0], wall);
    stage.sheet("wall", [0.0, y, 0.0], [x, 0.0, 0.0], up, wall);
    let [from, to] = [[0.2 * x, 0.8], [0.2 * x + stage.draw.between(0.5, 0.6 * x), 2.1]];
    let opening = [from, to].map(|[x, z]| [z, x]);
    stage.pierced([0.0; 3], [up, [x, 0.0, 0.0]], opening, wall);
    // Reveals of a deep wall.
    let deep_m = stage.draw.between(0.1, 0.5);
    let out = [0.0, -deep_m, 0.0];
    let [wide, tall] = [[to[0] - from[0], 0.0, 0.0], [0.0, 0.0, to[1] - from[1]]];
    let reveal = stage.sheet_paint(0.7);
    stage.sheet("sill", [from[0], 0.0, from[1]], out, wide, reveal);
    stage.sheet("lintel", [from[0], 0.0, to[1]], wide, out, reveal);
    stage.sheet("jamb", [from[0], 0.0, from[1]], tall, out, reveal);
    stage.sheet("jamb", [to[0], 0.0, from[1]], out, tall, reveal);
    let sky = stage.luminous(5000.0, 0.0);
    // So low that the sun comes in above it: at the window its light has fallen by 2.4 m at least.
    stage.sheet("sky", [-8.0, -6.0, 0.0], [0.0, 0.0, 3.0], [x + 16.0, 0.0, 0.0], sky);
    stage.furnish(size);
    if stage.draw.chance(0.5) {
        let steep = stage.draw.between(0.4, 1.2);
        stage.sun([0.3, 1.0, -steep], 60_000.0);
    }
}
