//! The outside of a room with a window: a street under a uniform sky.
//!
//! The street is a box. Its near side is the facade, black and as high as the room, with the sky above
//! it; its floor is the ground; all else is sky, but for what masks it. A box is convex, so every place of
//! ground and facing wall sees all the sky there is, and its illuminance is a sum of Lambert's formula over
//! rectangles.

use super::panel::{Panel, inside_of};
use super::room::{EDGE_M, HEIGHT_M, Room};
use super::visible::{lambert_lx, within};
use isolux::engine::ProbePoint;
use isolux::geometry::Point;
use isolux::scene::Shape;

/// Where the facing side of the street is, m from the facade.
const WIDTH_M: f64 = 6.0;
/// How high the sky is, m.
const SKY_M: f64 = 5.0;
/// How far the street reaches along the facade beyond the room, m.
const BEYOND_M: f64 = 3.0;

/// The window: two metres by one, in the facade at x = 0, seen from inside.
pub(super) fn window() -> Panel {
    Panel { axis: 0, level_m: 0.0, looks_up: false, b: [1.0, 3.0], c: [1.5, 2.5] }
}

/// The room behind the facade.
pub(super) fn room() -> Room {
    Room::from_x(-EDGE_M)
}

/// What stands between window and sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Mask {
    /// Nothing.
    None,
    /// A black slab from the top of the facade so far into the street, all along it, m.
    Slab(f64),
    /// A wall so high all along the facing side, m.
    Wall(f64),
}

fn lengthwise() -> [f64; 2] {
    [-BEYOND_M, EDGE_M + BEYOND_M]
}

fn sides() -> [Panel; 6] {
    let [from, to] = lengthwise();
    inside_of([0.0, from, 0.0], [WIDTH_M, to, SKY_M])
}

/// The ground of the street.
pub(super) fn ground() -> Panel {
    sides()[4]
}

/// The facade beside the room: what is left of the near side, below the sky, around the room's own wall.
pub(super) fn facade() -> [Panel; 2] {
    let near = Panel { c: [0.0, HEIGHT_M], ..sides()[0] };
    let [from, to] = near.b;
    [Panel { b: [from, 0.0], ..near }, Panel { b: [EDGE_M, to], ..near }]
}

impl Mask {
    /// The luminous rectangles that are left.
    pub(super) fn sky(self) -> Vec<Panel> {
        let [near, far, left, right, _, top] = sides();
        let above = |side: Panel, from: f64| Panel { c: [from, SKY_M], ..side };
        let far = match self {
            Self::Wall(height_m) => above(far, height_m),
            Self::None | Self::Slab(_) => far,
        };
        vec![above(near, HEIGHT_M), far, left, right, top]
    }

    /// The facing wall.
    pub(super) fn wall(self) -> Option<Panel> {
        match self {
            Self::Wall(height_m) => Some(Panel { c: [0.0, height_m], ..sides()[1] }),
            Self::None | Self::Slab(_) => None,
        }
    }

    /// The slab, front below.
    pub(super) fn slab(self) -> Option<Panel> {
        match self {
            Self::Slab(depth_m) => Some(Panel {
                axis: 2,
                level_m: HEIGHT_M,
                looks_up: false,
                b: [0.0, depth_m],
                c: lengthwise(),
            }),
            Self::None | Self::Wall(_) => None,
        }
    }

    /// Illuminance from the sky at a place, through an outline if one is given, less what the slab hides.
    pub(super) fn sky_lx(
        self,
        luminance_cd_m2: f64,
        at: ProbePoint,
        outline: Option<&[Point]>,
    ) -> f64 {
        let slab = self.slab().map(|slab| slab.corners());
        let seen = |panel: &Panel| {
            let whole = panel.corners();
            let open = outline.map_or(whole.clone(), |o| within(&whole, o, at.position));
            let hidden = slab.as_ref().map_or(0.0, |slab| {
                lambert_lx(luminance_cd_m2, &within(&open, slab, at.position), at)
            });
            lambert_lx(luminance_cd_m2, &open, at) - hidden
        };
        self.sky().iter().map(seen).sum::<f64>().max(0.0)
    }

    /// All of the street as shapes, with the materials of facade and slab, ground, wall and sky.
    pub(super) fn shapes(self, [black, ground_of, wall_of, sky]: [u32; 4]) -> Vec<Shape> {
        let mut shapes: Vec<Shape> = facade().iter().map(|p| p.shape("facade", black)).collect();
        shapes.push(ground().shape("ground", ground_of));
        shapes.extend(self.wall().iter().map(|p| p.shape("wall", wall_of)));
        shapes.extend(self.slab().iter().map(|p| p.shape("slab", black)));
        shapes.extend(self.sky().iter().map(|p| p.shape("sky", sky)));
        shapes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::QUADRATURE;
    use std::f64::consts::PI;

    /// Sky and all that masks it fill the hemisphere.
    #[test]
    fn ground_sees_sky_facade_and_masks_and_nothing_else() {
        let near = Panel { c: [0.0, HEIGHT_M], ..sides()[0] };
        for mask in [Mask::None, Mask::Slab(1.5), Mask::Wall(3.0)] {
            for (x, y) in [(0.4, 2.0), (2.0, -1.0), (5.0, 6.0)] {
                let at = ground().place(x, y);
                let black = [Some(near), mask.slab(), mask.wall()];
                let hidden: f64 =
                    black.iter().flatten().map(|panel| lambert_lx(1.0, &panel.corners(), at)).sum();
                let found = mask.sky_lx(1.0, at, None) + hidden;
                assert!((found / PI - 1.0).abs() < QUADRATURE, "{mask:?} {x} {y}: {found}");
            }
        }
    }

    /// The window is open to sky, ground and masks, and they fill it.
    #[test]
    fn all_that_is_outside_fills_the_window() {
        let outline = window().corners();
        for mask in [Mask::None, Mask::Slab(1.5), Mask::Wall(3.0)] {
            for (x, y, looks) in [(-1.0, 2.0, room().floor), (-2.5, 1.0, room().ceiling)] {
                let at = looks.place(x, y);
                let outside = [Some(ground()), mask.wall(), mask.slab()];
                let dark: f64 = outside
                    .iter()
                    .flatten()
                    .map(|p| lambert_lx(1.0, &within(&p.corners(), &outline, at.position), at))
                    .sum();
                let (found, whole) =
                    (mask.sky_lx(1.0, at, Some(&outline)) + dark, lambert_lx(1.0, &outline, at));
                assert!((found / whole - 1.0).abs() < QUADRATURE, "{mask:?}: {found} {whole}");
            }
        }
    }
}
