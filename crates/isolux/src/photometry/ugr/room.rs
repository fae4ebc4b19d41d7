//! The rooms of the table, and how light gets about in them.

use std::f64::consts::PI;

/// How high the luminaires are above the eye, m.
pub(super) const HEIGHT_M: f64 = 2.0;

/// A room in heights of the luminaires above the eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UgrRoom {
    /// Size across the line of sight.
    pub across: u32,
    /// Size along it.
    pub along: u32,
}

/// Reflectances of ceiling, walls and the plane at the height of the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UgrReflectances {
    /// Of the plane of the luminaires.
    pub ceiling: f64,
    /// Of the walls between both planes.
    pub walls: f64,
    /// Of the plane of the eye.
    pub floor: f64,
}

/// Light on each kind of surface, of any unit of flux.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arriving {
    pub(super) ceiling: f64,
    pub(super) walls: f64,
    pub(super) floor: f64,
}

const fn room([across, along]: [u32; 2]) -> UgrRoom {
    UgrRoom { across, along }
}

/// The standard rooms, in the order of the table.
pub const UGR_ROOMS: [UgrRoom; 19] = [
    room([2, 2]),
    room([2, 3]),
    room([2, 4]),
    room([2, 6]),
    room([2, 8]),
    room([2, 12]),
    room([4, 2]),
    room([4, 3]),
    room([4, 4]),
    room([4, 6]),
    room([4, 8]),
    room([4, 12]),
    room([8, 4]),
    room([8, 6]),
    room([8, 8]),
    room([8, 12]),
    room([12, 4]),
    room([12, 6]),
    room([12, 8]),
];

const fn reflectances([ceiling, walls, floor]: [f64; 3]) -> UgrReflectances {
    UgrReflectances { ceiling, walls, floor }
}

/// The standard reflectances, in the order of the table.
pub const UGR_REFLECTANCES: [UgrReflectances; 5] = [
    reflectances([0.7, 0.5, 0.2]),
    reflectances([0.7, 0.3, 0.2]),
    reflectances([0.5, 0.5, 0.2]),
    reflectances([0.5, 0.3, 0.2]),
    reflectances([0.3, 0.3, 0.2]),
];

impl UgrRoom {
    /// Area of all walls, squares of the height.
    pub(super) fn wall_area(self) -> f64 {
        2.0 * f64::from(self.across + self.along)
    }

    /// The flux that walls receive by reflection, of what arrives from luminaires: each kind of surface has one exitance, and the light
    /// goes back and forth by form factors. These are the transfer factors of CIE 190:2010, table 5, to the three digits printed there,
    /// but for one of them that is 0.0013 off.
    pub(super) fn reflected_onto_walls(self, of: UgrReflectances, direct: Arriving) -> f64 {
        let facing = self.ceiling_sees_floor();
        let ceiling_sees_walls = 1.0 - facing;
        let area = f64::from(self.across * self.along);
        let walls_see_ceiling = area * ceiling_sees_walls / self.wall_area();
        let walls_see_walls = 1.0 - 2.0 * walls_see_ceiling;
        // What a ceiling or floor receives is a constant and a multiple of what the walls receive.
        let both = 1.0 - of.ceiling * of.floor * facing * facing;
        let onto_ceiling = (direct.ceiling + of.floor * facing * direct.floor) / both;
        let onto_floor = (direct.floor + of.ceiling * facing * direct.ceiling) / both;
        let from_walls = of.walls * walls_see_ceiling / both;
        let ceiling_by_walls = from_walls * (1.0 + of.floor * facing);
        let floor_by_walls = from_walls * (1.0 + of.ceiling * facing);
        let back = |onto_ceiling: f64, onto_floor: f64| {
            ceiling_sees_walls * (of.ceiling * onto_ceiling + of.floor * onto_floor)
        };
        let again = of.walls * walls_see_walls + back(ceiling_by_walls, floor_by_walls);
        (direct.walls + back(onto_ceiling, onto_floor)) / (1.0 - again) - direct.walls
    }

    /// The form factor of two parallel rectangles, 1 apart (Howell, configuration C-11).
    fn ceiling_sees_floor(self) -> f64 {
        let [x, y] = [self.across, self.along].map(f64::from);
        let [one_x, one_y] = [x, y].map(|side| 1.0 + side * side);
        let logarithm = 0.5 * libm::log(one_x * one_y / (one_x + y * y));
        let side = |x: f64, one_y: f64| x * one_y.sqrt() * libm::atan(x / one_y.sqrt());
        let sum =
            logarithm + side(x, one_y) + side(y, one_x) - x * libm::atan(x) - y * libm::atan(y);
        2.0 * sum / (PI * x * y)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::by_bounces;
    use super::*;

    #[test]
    fn it_is_the_sum_of_all_bounces() {
        let room = UgrRoom { across: 2, along: 4 };
        for of in UGR_REFLECTANCES {
            for direct in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.2, 0.3, 0.5]] {
                let [ceiling, walls, floor] = direct;
                let direct = Arriving { ceiling, walls, floor };
                let (found, due) = (
                    room.reflected_onto_walls(of, direct),
                    by_bounces(room, of, [ceiling, walls, floor]),
                );
                // The midpoint rule with 28 places a side leaves less than with 24, which leave 1.2e-3.
                assert!((found / due - 1.0).abs() < 2e-3, "{of:?} {direct:?}: {found}, not {due}");
            }
        }
    }

    /// CIE 190:2010, table 5, reflectances 0.7, 0.5, 0.2: from the plane of the eye, the walls and the ceiling.
    #[test]
    fn the_transfer_factors_of_the_standard() {
        for (room, factors) in [
            ([2, 2], [0.220, 0.422, 0.646]),
            ([4, 8], [0.115, 0.211, 0.307]),
            ([8, 12], [0.071, 0.133, 0.183]),
        ] {
            let [across, along] = room;
            let room = UgrRoom { across, along };
            for (k, factor) in factors.into_iter().enumerate() {
                let on = |surface: usize| if surface == k { 1.0 } else { 0.0 };
                let direct = Arriving { floor: on(0), walls: on(1), ceiling: on(2) };
                let found = room.reflected_onto_walls(UGR_REFLECTANCES[0], direct);
                // Half of the last digit printed, and a little for how it was computed.
                assert!((found - factor).abs() < 0.0006, "{room:?} {k}: {found}");
            }
        }
    }
}
