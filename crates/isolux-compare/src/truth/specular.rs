//! Mirrors, glass and gloss.

use super::stage::Stage;
use isolux::scene::{Finish, Gloss, Material};
use isolux::units::Rgb;

/// Mirrors opposite each other, on the walls or a millimetre before them.
pub(super) fn opposite_mirrors(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    stage.furnish(size);
    let [_, y, z] = size;
    let off_m = stage.draw.pick(&[0.001, 0.02]);
    let reflectance = stage.draw.pick(&[0.8, 0.9, 0.95]);
    let mirror = stage.mirror_paint(Rgb::grey(reflectance));
    let (at, wide) = (stage.draw.between(0.2, 0.4) * y, 0.5 * y);
    stage.sheet("mirror", [0.35, at, 0.3], [0.0, wide, 0.0], [0.0, 0.0, z - 0.8], mirror);
    let corner = [size[0] - off_m, at, 0.3];
    stage.sheet("mirror", corner, [0.0, 0.0, z - 0.8], [0.0, wide, 0.0], mirror);
    let [x, y] = stage.place(size, 0.9);
    stage.lamp([x, y, z - 0.6], 120.0);
}

/// Walls that are mirrors and meet in a corner, where symmetric light falls on their edges.
pub(super) fn mirror_corner(stage: &mut Stage) {
    let side = stage.draw.between(3.0, 5.0);
    let size = [side, side, stage.draw.pick(&[side, 2.7])];
    let [x, y, z] = size;
    let paint = stage.any_paint(0.5, 0.8);
    stage.level("floor", size, 0.0, paint);
    stage.ceiling(size, paint);
    let colours = [Rgb::grey(0.9), Rgb::new(0.9, 0.7, 0.5)];
    let mirrors = colours.map(|colour| stage.mirror_paint(colour));
    let glossy = Finish { mirror: Rgb::grey(0.3), ..Finish::diffuse(Rgb::grey(0.4)) };
    let half_mirror = stage.material(Material::one_sided("half mirror", glossy));
    stage.sheet("mirror x", [0.0; 3], [0.0, y, 0.0], [0.0, 0.0, z], mirrors[0]);
    stage.sheet("mirror y", [0.0; 3], [0.0, 0.0, z], [x, 0.0, 0.0], mirrors[1]);
    stage.sheet("wall", [x, 0.0, 0.0], [0.0, 0.0, z], [0.0, y, 0.0], half_mirror);
    stage.sheet("wall", [0.0, y, 0.0], [x, 0.0, 0.0], [0.0, 0.0, z], paint);
    let share = stage.draw.pick(&[0.25, 0.5]);
    stage.lamp([share * x, share * y, 0.7 * z], 150.0);
    let wood = stage.any_paint(0.2, 0.5);
    stage.turned_solid("block", [2.0, 1.2, 0.0], [2.6, 1.8, 0.8], 45.0, wood);
}

/// A pane from wall to wall, and a screen of glass.
pub(super) fn panes(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    stage.furnish(size);
    let [x, y, z] = size;
    let transmittance = stage.draw.pick(&[0.97, 0.6]);
    let glass = stage.glass(true, transmittance);
    stage.sheet("pane", [0.6 * x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z], glass);
    stage.sheet("screen", [0.2 * x, 0.6 * y, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.4], glass);
    stage.lamp([0.3 * x, 0.4 * y, z - 0.4], 150.0);
}

/// A slab of glass, a glass ball, a floor with gloss: caustics.
pub(super) fn glass_and_gloss(stage: &mut Stage) {
    let size = stage.room_size();
    stage.room(size);
    let [x, y, z] = size;
    let glass = stage.glass(false, 1.0);
    stage.solid("slab", [0.3 * x, 0.3 * y, 0.7], [0.3 * x + 1.0, 0.3 * y + 0.7, 0.72], glass);
    stage.ball([0.7 * x, 0.6 * y, 0.9], 0.15, 6, glass);
    let wood = stage.any_paint(0.2, 0.5);
    stage.table([0.7 * x, 0.6 * y], [0.8, 0.8], 0.74, wood);
    let gloss = Gloss { f0: Rgb::grey(0.04), alpha: 0.09 };
    let lacquer = Finish { gloss: Some(gloss), ..Finish::diffuse(Rgb::grey(0.3)) };
    let lacquer = stage.material(Material::one_sided("lacquer", lacquer));
    stage.solid("chest", [0.0, 0.0, 0.0], [1.0, 0.5, 0.9], lacquer);
    let height = stage.draw.between(0.4, 0.8);
    stage.lamp([0.5 * x, 0.5 * y, z - height], 150.0);
}
