//! Surfaces that shine.

use super::stage::Stage;

/// Panels flush with the ceiling, a millimetre below it, or hanging.
pub(super) fn panels(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    stage.furnish(size);
    let below_m = stage.draw.pick(&[0.001, 0.01, 0.5]);
    let reflectance = stage.draw.pick(&[0.0, 0.5]);
    let panel = stage.luminous(1500.0, reflectance);
    for _ in 0..stage.draw.count(1, 6) {
        let [x, y] = stage.place(size, 0.7);
        let corner = [x - 0.3, y - 0.3, size[2] - below_m];
        stage.sheet("panel", corner, [0.0, 0.6, 0.0], [0.6, 0.0, 0.0], panel);
    }
}

/// Thin strips along edges, and globes.
pub(super) fn strips_and_globes(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    stage.furnish(size);
    let strip = stage.luminous(6000.0, 0.0);
    let [x, y, z] = size;
    let wide_m = stage.draw.pick(&[0.003, 0.02]);
    stage.sheet("strip", [x - 0.001, 0.05, 0.1], [0.0, 0.0, wide_m], [0.0, y - 0.1, 0.0], strip);
    stage.sheet(
        "strip",
        [0.05, y - 0.001, z - 0.1],
        [x - 0.1, 0.0, 0.0],
        [0.0, 0.0, wide_m],
        strip,
    );
    let globe = stage.luminous(2000.0, 0.3);
    for _ in 0..stage.draw.count(1, 3) {
        let [x, y] = stage.place(size, 0.6);
        stage.ball([x, y, z - 0.4], stage.half as f64 * 0.05 + 0.08, 4, globe);
    }
}
