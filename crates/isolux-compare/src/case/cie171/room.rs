//! The room of the cases, 4 m by 4 m by 3 m, black inside, with at most one opening.

use super::panel::{Panel, inside_of};
use crate::expectation::{Bound, Expectation, Quantity};
use isolux::engine::ProbePoint;
use isolux::scene::{Finish, Material, Shape};
use isolux::units::Rgb;

/// Length and width of the room, m.
pub(super) const EDGE_M: f64 = 4.0;
/// Height of the room, m.
pub(super) const HEIGHT_M: f64 = 3.0;

/// The material of the room itself.
pub(super) const BLACK: u32 = 0;

/// A room with its faces, fronts inside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    /// The wall at the lower x.
    pub(super) west: Panel,
    /// The wall at the higher x.
    pub(super) east: Panel,
    /// The wall at the lower y.
    pub(super) south: Panel,
    /// The wall at the higher y.
    pub(super) north: Panel,
    /// The floor.
    pub(super) floor: Panel,
    /// The ceiling.
    pub(super) ceiling: Panel,
}

impl Room {
    /// The room whose lower corner has the given x; its y and z begin at zero.
    pub(super) fn from_x(x: f64) -> Self {
        let low = [x, 0.0, 0.0];
        let [west, east, south, north, floor, ceiling] =
            inside_of(low, [x + EDGE_M, EDGE_M, HEIGHT_M]);
        Self { west, east, south, north, floor, ceiling }
    }

    /// Walls, floor and ceiling.
    pub(super) fn faces(&self) -> [Panel; 6] {
        [self.west, self.east, self.south, self.north, self.floor, self.ceiling]
    }

    /// The faces as shapes, but for an opening in one of them.
    pub(super) fn shapes(&self, opening: Option<Panel>) -> Vec<Shape> {
        const NAMES: [&str; 6] = ["west", "east", "south", "north", "floor", "ceiling"];
        let holds = |face: &Panel, hole: &Panel| {
            (face.axis, face.level_m, face.looks_up) == (hole.axis, hole.level_m, hole.looks_up)
        };
        NAMES
            .into_iter()
            .zip(self.faces())
            .flat_map(|(name, face)| match opening.filter(|hole| holds(&face, hole)) {
                Some(hole) => face.around(hole).map(|part| part.shape(name, BLACK)).to_vec(),
                None => vec![face.shape(name, BLACK)],
            })
            .collect()
    }
}

/// Black in front and behind.
pub(super) fn black() -> Material {
    Material::one_sided("black", Finish::BLACK)
}

/// A front that shines and reflects nothing.
pub(super) fn luminous(luminance_cd_m2: f64) -> Material {
    let finish = Finish { luminance_cd_m2: Rgb::grey(luminance_cd_m2), ..Finish::BLACK };
    Material::one_sided("luminous", finish)
}

/// A front that reflects diffusely.
pub(super) fn diffuse(reflectance: f64) -> Material {
    Material::one_sided("diffuse", Finish::diffuse(Rgb::grey(reflectance)))
}

/// Direct light alone, of exact geometry.
pub(super) fn direct(at: ProbePoint, lx: f64) -> [Expectation; 2] {
    Expectation::direct_only(at, Rgb::grey(lx), Bound::EXACT_GEOMETRY)
}

/// Direct and indirect light, of exact geometry.
pub(super) fn split(at: ProbePoint, direct_lx: f64, indirect_lx: f64) -> [Expectation; 3] {
    Quantity::split(Rgb::grey(direct_lx), Rgb::grey(indirect_lx)).map(|(quantity, expected_lx)| {
        Expectation { at, quantity, expected_lx, bound: Bound::EXACT_GEOMETRY }
    })
}
