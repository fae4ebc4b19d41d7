//! Lamps on, in and through ceilings, in housings and shades.

use super::stage::Stage;
use isolux::photometry::IntensityDistribution;

/// On the ceiling, on the floor, on a wall: exactly, or a hand's breadth off.
pub(super) fn on_surfaces(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    stage.furnish(size);
    let off_m = stage.draw.pick(&[0.0, 0.0, 0.001, 0.01, 0.1]);
    let [x, y] = stage.place(size, 0.6);
    let ceiling = [0.5 * size[0], 0.5 * size[1], size[2] - off_m];
    stage.lamp(ceiling, 150.0);
    let at = stage.draw.pick(&[[x, y, off_m], [x, size[1] - off_m, 1.8]]);
    stage.lamp(at, 40.0);
}

/// In recesses of a ceiling that is pierced for each of them.
pub(super) fn recessed(stage: &mut Stage) {
    let [x, y, z] = stage.room_size();
    let [floor, wall, white] = [0.3, 0.55, 0.8].map(|r| stage.any_paint(r, r));
    stage.level("floor", [x, y, z], 0.0, floor);
    stage.walls([0.0; 2], [x, y], [0.0, z], wall);
    let (rows, side_m) = (stage.draw.count(1, 3), stage.draw.pick(&[0.08, 0.15, 0.3]));
    let (step, deep_m) = (y / f64::from(rows), stage.draw.between(0.02, 0.2));
    let sheet = stage.sheet_paint(0.6);
    for row in 0..rows {
        let y0 = step * f64::from(row);
        let [from, to] = [-0.5, 0.5].map(|d| [0.5 * step + d * side_m, 0.5 * x + d * side_m]);
        let edges = [[0.0, step, 0.0], [x, 0.0, 0.0]];
        stage.pierced([0.0, y0, z], edges, [from, to], white);
        let low = [from[1], y0 + from[0], z];
        stage.hood(low, [to[1], y0 + to[0], z + deep_m], sheet);
        let lamp_z = z + stage.draw.between(0.1, 0.9) * deep_m;
        stage.lamp([0.5 * x, y0 + 0.5 * step, lamp_z], 200.0);
    }
}

/// Poles and housings that cut through the ceiling, lamps close on either side of where they do.
pub(super) fn through_ceilings(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    let paint = stage.any_paint(0.3, 0.7);
    let sheet = stage.sheet_paint(0.7);
    for _ in 0..stage.draw.count(1, 4) {
        let [x, y] = stage.place(size, 0.7);
        let z = size[2];
        let low = z - stage.draw.between(0.02, 0.4);
        stage.solid("pole", [x + 0.12, y - 0.02, low], [x + 0.16, y + 0.02, z + 0.2], paint);
        stage.hood([x - 0.1, y - 0.1, low], [x + 0.1, y + 0.1, z + 0.05], sheet);
        stage.lamp([x, y, 0.5 * (low + z)], 130.0);
    }
    // What hangs a little too high gives its light to the space above.
    let [x, y] = stage.place(size, 0.7);
    let lamp_z = size[2] + stage.draw.pick(&[-0.005, -0.001, 0.001]);
    stage.lamp([x, y, lamp_z], 50.0);
}

/// A grid of many lamps below the ceiling of a large room.
pub(super) fn many_below_ceiling(stage: &mut Stage) {
    let size = [20.0, 14.0, 3.0].map(|side| side * stage.draw.between(0.8, 1.4));
    stage.room(size);
    stage.furnish(size);
    let counts = [stage.draw.count(16, 25), stage.draw.count(12, 20)];
    let below_m = stage.draw.pick(&[0.02, 0.1, 0.1, 0.4]);
    let cd = 60.0 * size[0] * size[1] / f64::from(counts[0] * counts[1]);
    for i in 0..counts[0] {
        for j in 0..counts[1] {
            let along =
                |k: u32, axis: usize| size[axis] * (f64::from(k) + 0.5) / f64::from(counts[axis]);
            stage.lamp([along(i, 0), along(j, 1), size[2] - below_m], cd);
        }
    }
}

/// Spots deep in housings of sheet metal, open below, on the ceiling and hanging.
pub(super) fn housings(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    let deep_m = stage.draw.between(0.05, 0.3);
    let sheet = stage.sheet_paint(0.8);
    for _ in 0..stage.draw.count(1, 6) {
        let [x, y] = stage.place(size, 0.4);
        let hanging_m = stage.draw.pick(&[0.0, 0.0, 0.4]);
        let half_m = stage.draw.pick(&[0.05, 0.1, 0.3]);
        let top = size[2] - hanging_m;
        let low = [x - half_m, y - half_m, top - deep_m];
        stage.hood(low, [x + half_m, y + half_m, top], sheet);
        let cosine = IntensityDistribution::CosinePower { peak_cd: 400.0, exponent: 1.0 };
        stage.aimed([x, y, top - 0.3 * deep_m], [0.0, 0.0, -1.0], cosine);
    }
}

/// Lamps in shades that are open above and below, one of them against a wall.
pub(super) fn shades(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    stage.furnish(size);
    let cloth = stage.draw.between(0.4, 0.85);
    let sheet = stage.sheet_paint(cloth);
    for _ in 0..stage.draw.count(1, 3) {
        let [x, y] = stage.place(size, 0.5);
        let z = stage.draw.between(1.2, size[2] - 0.4);
        let radii_m = stage.draw.pick(&[[0.15, 0.15], [0.2, 0.08], [0.05, 0.05]]);
        stage.tube([x, y], radii_m, [z - 0.12, z + 0.12], sheet);
        stage.lamp([x, y, z], 80.0);
    }
    stage.tube([0.151, 0.5 * size[1]], [0.15, 0.15], [1.5, 1.8], sheet);
    stage.lamp([0.151, 0.5 * size[1], 1.65], 60.0);
}

/// Lamps that light ceilings and walls, so that all other light is indirect.
pub(super) fn uplights(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    stage.furnish(size);
    let off_m = stage.draw.pick(&[0.1, 0.3]);
    for _ in 0..stage.draw.count(1, 3) {
        let at = [size[0] - off_m, stage.draw.between(0.7, size[1] - 0.3), 1.7];
        let cosine = IntensityDistribution::CosinePower { peak_cd: 500.0, exponent: 2.0 };
        stage.aimed(at, [0.0, 0.0, 1.0], cosine);
    }
    // A cove: a strip behind a board that hides it from the room.
    let board = stage.any_paint(0.6, 0.8);
    let z = size[2] - 0.2;
    stage.solid("cove", [0.0, 0.0, z - 0.02], [0.15, size[1], z], board);
    stage.solid("lip", [0.13, 0.0, z], [0.15, size[1], z + 0.06], board);
    let strip = stage.luminous(2500.0, 0.0);
    stage.sheet(
        "strip",
        [0.04, 0.02, z + 0.01],
        [0.03, 0.0, 0.0],
        [0.0, size[1] - 0.04, 0.0],
        strip,
    );
}

/// Spots, downlights and wall washers of photometric files, some of them close to a wall.
pub(super) fn spots_and_files(stage: &mut Stage) {
    let size = [8.0, 6.0, 3.0].map(|side| side * stage.draw.between(0.8, 1.3));
    stage.room(size);
    stage.furnish(size);
    let z = size[2] - stage.draw.pick(&[0.0, 0.001, 0.05]);
    for _ in 0..stage.draw.count(3, 20) {
        let [x, y] = stage.place(size, 0.3);
        let file = stage.draw.count(0, 1) as usize;
        stage.filed([x, y, z], [0.0, 0.0, -1.0], file);
    }
    for k in 0..stage.draw.count(2, 5) {
        let x = size[0] - stage.draw.pick(&[0.1, 0.4]);
        stage.filed([x, 0.8 + f64::from(k), z], [0.0, 0.0, -1.0], 2);
        let [x, y] = stage.place(size, 1.0);
        let [inner_rad, outer_rad] = [10.0_f64, 20.0].map(f64::to_radians);
        let spot = IntensityDistribution::Spot { peak_cd: 1500.0, inner_rad, outer_rad };
        let aim = [stage.draw.between(-1.0, 1.0), stage.draw.between(-1.0, 1.0), -1.0];
        stage.aimed([x, y, size[2] - 0.2], aim, spot);
    }
}
