//! 5.11 to 5.14 under a uniform sky: sky component and externally reflected component at a window in the
//! facade, unglazed and glazed, with a continuous horizontal and a continuous vertical mask.
//!
//! The sky component is Lambert's formula for the rectangles of sky that are seen through the window. What
//! the ground, or in 5.14 the facing wall, reflects has the luminance `rho E(x) / pi`, with the exact
//! illuminance E(x) from the sky ([`super::street`]), and is integrated over the part seen through the window.
//! Everything else is black, so one reflection is all there is. Behind a pane both integrals weigh every direction with the
//! transmittance at its incidence, and the pane shows the ground the sky once more: a place of the ground
//! has `L Int R(theta) cos dw` over the pane besides, R its reflectance, for a ray that comes from below goes on
//! upwards and meets the sky.

use super::super::glass::{pane, pane_material};
use super::panel::Panel;
use super::roof::through_glass;
use super::room::{BLACK, black, diffuse, luminous, split};
use super::street::{Mask, ground, room, window};
use super::visible::{gathered_lx, within};
use crate::expectation::{Case, Expectation};
use isolux::engine::ProbePoint;
use isolux::geometry::{Point, Vector};
use isolux::scene::SceneParts;
use isolux::units::Rgb;
use std::f64::consts::PI;

const LUMINANCE_CD_M2: f64 = 4000.0;
const REFLECTANCE: f64 = 0.3;
/// Nodes each way over a triangle of what is seen through the window, and over the pane as the ground
/// sees it: more change no value here by more than 1e-9 of it.
const NODES: usize = 24;
const PANE_NODES: usize = 10;
/// Numbers of the materials after that of the room.
const DIFFUSE: u32 = 1;
const SKY: u32 = 2;
const PANE: u32 = 3;

/// A window, its mask and its outside.
#[derive(Clone, Copy, Debug)]
struct Facade {
    name: &'static str,
    mask: Mask,
    is_glazed: bool,
}

const UNGLAZED: Facade = Facade { name: "cie171_5_11_uniform", mask: Mask::None, is_glazed: false };
const GLAZED: Facade = Facade { name: "cie171_5_12_uniform", mask: Mask::None, is_glazed: true };
const HORIZONTAL: Facade =
    Facade { name: "cie171_5_13_uniform", mask: Mask::Slab(1.5), is_glazed: false };
const VERTICAL: Facade =
    Facade { name: "cie171_5_14_uniform", mask: Mask::Wall(3.0), is_glazed: false };

pub(super) fn cases() -> [Case; 4] {
    [
        Case {
            name: UNGLAZED.name,
            notes: "CIE 171 5.11: a uniform sky and bright ground through an unglazed window",
            parts: || UNGLAZED.parts(),
            expectations: || UNGLAZED.expectations(),
        },
        Case {
            name: GLAZED.name,
            notes: "CIE 171 5.12: a uniform sky and bright ground through a clear pane",
            parts: || GLAZED.parts(),
            expectations: || GLAZED.expectations(),
        },
        Case {
            name: HORIZONTAL.name,
            notes: "CIE 171 5.13: a window below a continuous black slab, over bright ground",
            parts: || HORIZONTAL.parts(),
            expectations: || HORIZONTAL.expectations(),
        },
        Case {
            name: VERTICAL.name,
            notes: "CIE 171 5.14: a window before a continuous bright wall, over black ground",
            parts: || VERTICAL.parts(),
            expectations: || VERTICAL.expectations(),
        },
    ]
}

impl Facade {
    /// The one surface that reflects.
    fn bright(&self) -> Panel {
        self.mask.wall().unwrap_or_else(ground)
    }

    fn parts(&self) -> SceneParts {
        let ground_of = if self.mask.wall().is_some() { BLACK } else { DIFFUSE };
        let mut shapes = room().shapes(Some(window()));
        shapes.extend(self.mask.shapes([BLACK, ground_of, DIFFUSE, SKY]));
        let mut materials = vec![black(), diffuse(REFLECTANCE), luminous(LUMINANCE_CD_M2)];
        if self.is_glazed {
            shapes.push(window().shape("pane", PANE));
            materials.push(pane_material(Rgb::WHITE));
        }
        SceneParts { name: self.name.into(), shapes, materials, ..SceneParts::default() }
    }

    fn transmitted(&self, way: Vector) -> f64 {
        if self.is_glazed { through_glass(way.x.abs() / way.length()) } else { 1.0 }
    }

    fn sky_lx(&self, at: ProbePoint) -> f64 {
        let outline = window().corners();
        if !self.is_glazed {
            return self.mask.sky_lx(LUMINANCE_CD_M2, at, Some(&outline));
        }
        let seen = |panel: &Panel| {
            gathered_lx(&within(&panel.corners(), &outline, at.position), at, NODES, |p| {
                LUMINANCE_CD_M2 * self.transmitted(p - at.position)
            })
        };
        self.mask.sky().iter().map(seen).sum()
    }

    /// By way of the bright surface.
    fn reflected_lx(&self, at: ProbePoint) -> f64 {
        let bright = self.bright();
        let seen = within(&bright.corners(), &window().corners(), at.position);
        gathered_lx(&seen, at, NODES, |p| {
            let outside = ProbePoint { position: p, normal: bright.normal() };
            REFLECTANCE / PI * self.outside_lx(outside) * self.transmitted(p - at.position)
        })
    }

    /// At a place of the bright surface.
    fn outside_lx(&self, at: ProbePoint) -> f64 {
        let sky = self.mask.sky_lx(LUMINANCE_CD_M2, at, None);
        if !self.is_glazed {
            return sky;
        }
        let mirrored = |p: Point| {
            let way = p - at.position;
            LUMINANCE_CD_M2 * pane(way.x.abs() / way.length(), 1.0).reflected
        };
        sky + gathered_lx(&window().corners(), at, PANE_NODES, mirrored)
    }

    fn expectations(&self) -> Vec<Expectation> {
        let one = |at| split(at, self.sky_lx(at), self.reflected_lx(at));
        places().into_iter().flat_map(one).collect()
    }
}

/// Into the depth of the room on the floor, up the back wall, on a side wall and on the ceiling.
fn places() -> Vec<ProbePoint> {
    let room = room();
    let floor = [-0.6, -1.3, -2.0, -2.8, -3.6].map(|x| room.floor.place(x, 2.0));
    let back = [0.3, 0.9, 1.6, 2.3].map(|z| room.west.place(2.0, z));
    let side = [(0.7, -1.5), (1.7, -3.0)].map(|(z, x)| room.south.place(z, x));
    let ceiling = [-1.0, -2.5].map(|x| room.ceiling.place(x, 1.5));
    [floor.as_slice(), &back, &side, &ceiling].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::RAYS_PAST_EDGES;
    use isolux::geometry::Normal;
    use isolux::quadrature::GaussRule;

    /// The light that the window lets through, gathered over the window itself: what lies behind it is found by
    /// following every ray to the first thing that it meets.
    fn over_window(facade: &Facade, at: ProbePoint, steps: usize) -> [f64; 2] {
        let ([b, c], rule) = ([window().b, window().c], GaussRule::new(4));
        let cells = |range: [f64; 2]| -> Vec<(f64, f64)> {
            let edge = |k: usize| range[0] + (range[1] - range[0]) * k as f64 / steps as f64;
            (0..steps).flat_map(|k| rule.over(edge(k), edge(k + 1)).collect::<Vec<_>>()).collect()
        };
        let (mut sky, mut reflected) = (0.0, 0.0);
        for (y, w) in cells(b) {
            for (z, v) in cells(c) {
                let way = window().point(y, z) - at.position;
                let (r2, cos) = (way.length_squared(), way.dot(at.normal.to_vector()));
                let share = w * v * cos.max(0.0) * way.x / (r2 * r2) * facade.transmitted(way);
                match met(facade, at.position, way) {
                    Met::Sky => sky += share * LUMINANCE_CD_M2,
                    Met::Bright(p) => {
                        let normal = facade.bright().normal();
                        let lx = facade.outside_lx(ProbePoint { position: p, normal });
                        reflected += share * REFLECTANCE / PI * lx;
                    }
                    Met::Dark => {}
                }
            }
        }
        [sky, reflected]
    }

    enum Met {
        Sky,
        Bright(Point),
        Dark,
    }

    fn met(facade: &Facade, from: Point, way: Vector) -> Met {
        let to_level = |axis: usize, level: f64| {
            (level - from.to_vector().component(axis)) / way.component(axis)
        };
        if let Some(slab) = facade.mask.slab() {
            let p = from + way * to_level(2, slab.level_m);
            if way.z > 0.0 && p.x > 0.0 && p.x < slab.b[1] {
                return Met::Dark;
            }
        }
        let bright = facade.bright();
        let at_ground = from + way * to_level(2, 0.0);
        if way.z < 0.0 && at_ground.x < 6.0 && (-3.0..7.0).contains(&at_ground.y) {
            return if bright.axis == 2 { Met::Bright(at_ground) } else { Met::Dark };
        }
        let at_wall = from + way * to_level(0, 6.0);
        let is_wall =
            bright.axis == 0 && at_wall.z < bright.c[1] && (-3.0..7.0).contains(&at_wall.y);
        if is_wall { Met::Bright(at_wall) } else { Met::Sky }
    }

    #[test]
    fn both_components_agree_with_rays_through_the_window() {
        for facade in [UNGLAZED, HORIZONTAL, VERTICAL] {
            for at in places() {
                let [sky, reflected] = over_window(&facade, at, 40);
                let off = (facade.sky_lx(at) - sky)
                    .abs()
                    .max((facade.reflected_lx(at) - reflected).abs());
                let allowed = RAYS_PAST_EDGES * (sky + reflected);
                assert!(off <= allowed, "{} {at:?}: {off} of {sky}, {reflected}", facade.name);
            }
        }
    }

    #[test]
    fn glass_lets_through_less_and_shows_the_ground_the_sky() {
        let below = ProbePoint { position: Point::new(1.0, 2.0, 0.0), normal: Normal::Z };
        assert!(GLAZED.outside_lx(below) > UNGLAZED.outside_lx(below));
        for at in places() {
            let [sky, reflected] = over_window(&GLAZED, at, 40);
            let off =
                (GLAZED.sky_lx(at) - sky).abs().max((GLAZED.reflected_lx(at) - reflected).abs());
            assert!(off <= RAYS_PAST_EDGES * (sky + reflected), "{at:?}: {off}");
            assert!(GLAZED.sky_lx(at) <= UNGLAZED.sky_lx(at));
        }
    }

    #[test]
    fn every_component_is_seen_somewhere_and_missing_somewhere() {
        for facade in [UNGLAZED, HORIZONTAL, VERTICAL] {
            let sky: Vec<f64> = places().into_iter().map(|at| facade.sky_lx(at)).collect();
            let reflected: Vec<f64> =
                places().into_iter().map(|at| facade.reflected_lx(at)).collect();
            assert!(sky.iter().any(|&lx| lx > 10.0), "{sky:?}");
            assert!(reflected.iter().any(|&lx| lx > 10.0), "{reflected:?}");
        }
    }
}
