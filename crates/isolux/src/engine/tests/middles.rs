//! Light in gaps, told by the middles of elements.

use super::*;
use crate::engine::gather::Unlit;
use crate::engine::light::Lighting;
use crate::engine::pilot::pilot;

const REFLECTANCE: f64 = 0.6;
const RADIANCE: f64 = 100.0;

/// A room with a panel 1 cm below its ceiling that shines up.
fn room() -> Scene {
    let mut shapes = inward_box([4.0, 3.0, 2.5], 0);
    shapes.push(rectangle([1.3, 0.9, 2.49], [1.4, 0.0, 0.0], [0.0, 1.2, 0.0], 1));
    let grey = Rgb::grey(REFLECTANCE);
    let glow = Finish { luminance_cd_m2: Rgb::grey(RADIANCE), ..Finish::diffuse(grey) };
    let panel = Material::one_sided("panel", glow);
    scene(shapes, vec![painted(grey), panel], vec![])
}

/// Vertices outside the gap tell nothing of the light inside, and those inside are not read with them: elements over the panel
/// are to be bisected until the ones inside are among themselves.
#[test]
fn a_panel_close_below_the_ceiling_is_seen_to_light_it() {
    let scene = room();
    let lighting = Lighting::new(&scene);
    let plan = pilot(&scene, &lighting, &usual_request(), &Unlit::default(), &mut |_| true);
    // Between two planes light goes up and down without end.
    let direct = std::f64::consts::PI * RADIANCE;
    let expected = direct / (1.0 - REFLECTANCE * REFLECTANCE) - direct;
    let key = Key::new(5);
    let (mut misread, count) = (0, 200);
    for k in 0..count {
        let [x, y] = [0, 1].map(|n| key.with(2 * k + n).uniform());
        let at = Point::new(1.4 + 1.2 * x, 1.0 + 1.0 * y, 2.5);
        let surface = front_at(&scene, at);
        let read = plan.read(plan.mesh.level, &plan.light.guess, &surface).luminance();
        // 10 cm from the border of a gap of 1 cm the rim is hardly seen: 15 % are for the noise of few rays.
        misread += u32::from((read / expected - 1.0).abs() > 0.15);
    }
    // Elements as long as the gap is wide four times over may still lie across the border.
    assert!(misread < 10, "{misread} of {count}");
}

/// What hangs close below a ceiling and shines both ways is lit from above by what it lights itself: inside, and less at the rim.
#[test]
fn the_upper_side_of_a_lamp_below_a_ceiling_is_darker_at_its_rim() {
    let mut shapes = inward_box([4.0, 3.0, 2.5], 0);
    shapes.push(rectangle([1.7, 1.2, 2.47], [0.6, 0.0, 0.0], [0.0, 0.6, 0.0], 1));
    let grey = Rgb::grey(0.75);
    let glow = Finish { luminance_cd_m2: Rgb::grey(RADIANCE), ..Finish::diffuse(grey) };
    let scene = scene(shapes, vec![painted(grey), Material::two_sided("lamp", glow)], vec![]);
    let lighting = Lighting::new(&scene);
    let plan = pilot(&scene, &lighting, &usual_request(), &Unlit::default(), &mut |_| true);
    let read_lx = |x: f64| {
        let surface = front_at(&scene, Point::new(x, 1.5, 2.47));
        plan.read(plan.mesh.level, &plan.light.guess, &surface).luminance()
    };
    let inside_lx = read_lx(2.0);
    // At the very rim half of what is seen is the dark room, and what is lit there is as far from being so by itself.
    assert!(read_lx(1.71) < 0.6 * inside_lx, "{} {inside_lx}", read_lx(1.71));
    assert!(read_lx(1.9) > 0.9 * inside_lx, "{} {inside_lx}", read_lx(1.9));
}
