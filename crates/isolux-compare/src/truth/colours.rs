//! White and saturated materials, and sheets seen from both sides.

use super::stage::Stage;
use isolux::units::Rgb;

/// A room as white as snow: light is reflected tens of times.
pub(super) fn white(stage: &mut Stage) {
    let size = stage.room_size();
    let reflectance = stage.draw.pick(&[0.92, 0.95, 0.98]);
    let snow = stage.paint(Rgb::grey(reflectance));
    stage.bare_room(size, snow);
    let [x, y] = stage.place(size, 0.8);
    stage.table([x, y], [1.2, 0.8], 0.75, snow);
    stage.solid("block", [0.0, 0.0, 0.0], [0.6, 0.9, 1.9], snow);
    stage.lamp([0.5 * size[0], 0.5 * size[1], size[2] - 0.3], 30.0);
}

/// Walls of pure colours, one of them black.
pub(super) fn saturated(stage: &mut Stage) {
    let size = stage.room_size();
    let [x, y, z] = size;
    let colours = [
        Rgb::new(0.9, 0.02, 0.02),
        Rgb::new(0.02, 0.7, 0.02),
        Rgb::new(0.02, 0.02, 0.9),
        Rgb::BLACK,
    ];
    let [red, green, blue, black] = colours.map(|colour| stage.paint(colour));
    let white = stage.any_paint(0.7, 0.85);
    stage.level("floor", size, 0.0, white);
    stage.ceiling(size, white);
    stage.sheet("red", [0.0; 3], [0.0, y, 0.0], [0.0, 0.0, z], red);
    stage.sheet("green", [x, 0.0, 0.0], [0.0, 0.0, z], [0.0, y, 0.0], green);
    stage.sheet("blue", [0.0; 3], [0.0, 0.0, z], [x, 0.0, 0.0], blue);
    stage.sheet("black", [0.0, y, 0.0], [x, 0.0, 0.0], [0.0, 0.0, z], black);
    stage.turned_solid("block", [1.0, 1.0, 0.0], [1.6, 1.6, 1.2], 17.0, red);
    stage.solid("block", [x - 0.8, 0.5, 0.0], [x - 0.2, 1.1, 0.6], blue);
    let [x, y] = stage.place(size, 0.8);
    stage.lamp([x, y, z - 0.4], 200.0);
}

/// Screens without thickness, some of which touch, a few almost parallel, and a thin curtain before a wall.
pub(super) fn screens(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    let [x, y, _] = size;
    for _ in 0..stage.draw.count(3, 8) {
        let reflectance = stage.draw.between(0.1, 0.85);
        let sheet = stage.sheet_paint(reflectance);
        let [at_x, at_y] = stage.place(size, 0.7);
        let [along, across] = [stage.draw.between(-1.0, 1.0), stage.draw.between(-1.0, 1.0)];
        let foot = stage.draw.pick(&[0.0, 0.0, 0.02, 0.3]);
        let high = [0.0, 0.0, stage.draw.between(0.5, 1.8)];
        stage.sheet("screen", [at_x, at_y, foot], [along, across, 0.0], high, sheet);
    }
    let curtain = stage.sheet_paint(0.5);
    stage.sheet("curtain", [0.1, y - 0.05, 0.02], [x - 0.2, 0.0, 0.0], [0.0, 0.0, 2.2], curtain);
    let [x, y] = stage.place(size, 0.9);
    stage.lamp([x, y, size[2] - 0.2], 150.0);
}
