//! What stands in the hall.

use super::room::column_x_m;
use super::size::{BAY_M, COLUMNS, GAP_M, LENGTH_M, WIDTH_M};
use super::solid::{Form, Solid};
use super::surface::Surface;
use isolux::geometry::{Point, Vector};
use isolux::sampling::Key;
use isolux::units::sincos_deg;

/// Chairs stand askew by up to this, degrees.
const ASKEW_DEG: f64 = 25.0;
/// Leaves are divided more than furniture.
const FOLIAGE: f64 = 0.5;

/// Where a thing stands: its origin in the hall and its turn about the vertical.
#[derive(Clone, Copy)]
struct Place {
    x: f64,
    y: f64,
    turn_deg: f64,
}

impl Place {
    const fn at(x: f64, y: f64, turn_deg: f64) -> Self {
        Self { x, y, turn_deg }
    }

    /// A place given in the axes of this one.
    fn within(self, x: f64, y: f64, turn_deg: f64) -> Self {
        let moved = self.point([x, y, 0.0]);
        Self { x: moved.x, y: moved.y, turn_deg: self.turn_deg + turn_deg }
    }

    /// The other side of the hall: half a turn about its middle.
    fn across(self) -> Self {
        Self::at(LENGTH_M - self.x, WIDTH_M - self.y, self.turn_deg + 180.0)
    }

    fn point(self, [x, y, z]: [f64; 3]) -> Point {
        let (sin, cos) = sincos_deg(self.turn_deg);
        Point::new(self.x + x * cos - y * sin, self.y + x * sin + y * cos, z)
    }

    /// A box by its lowest corner and its size in the axes of this place.
    fn cuboid(self, surface: Surface, low: [f64; 3], size: [f64; 3]) -> Solid {
        let (sin, cos) = sincos_deg(self.turn_deg);
        let edges = [
            Vector::new(size[0] * cos, size[0] * sin, 0.0),
            Vector::new(-size[1] * sin, size[1] * cos, 0.0),
            Vector::new(0.0, 0.0, size[2]),
        ];
        Solid { surface, form: Form::Box { corner: self.point(low), edges }, coarseness: 1.0 }
    }
}

pub(super) fn solids() -> Vec<Solid> {
    let mut solids = Vec::new();
    let random = Key::new(2626);
    for bay in 0..COLUMNS - 1 {
        let middle = Place::at(column_x_m(bay) + 0.5 * BAY_M, 3.7, 0.0);
        for (side, place) in [middle, middle.across()].into_iter().enumerate() {
            add_island(&mut solids, place, random.with(u64::from(bay)).with(side as u64));
        }
        add_cabinets(&mut solids, Place::at(column_x_m(bay), 0.0, 0.0));
        add_cabinets(&mut solids, Place::at(column_x_m(bay), 0.0, 0.0).across());
    }
    add_nave(&mut solids);
    add_meeting_corner(&mut solids, Place::at(LENGTH_M - 2.7, 0.0, 0.0));
    for y in [1.2, 3.2, 5.2] {
        add_shelf(&mut solids, Place::at(0.03, y, -90.0), random.with(99).with(y.to_bits()));
    }
    solids
}

/// Four workplaces, two facing two, with a screen of felt between them.
fn add_island(solids: &mut Vec<Solid>, place: Place, random: Key) {
    let desks = [(-0.8, -0.42, 0.0), (0.8, -0.42, 0.0), (0.8, 0.42, 180.0), (-0.8, 0.42, 180.0)];
    for (k, (x, y, turn_deg)) in desks.into_iter().enumerate() {
        add_workplace(solids, place.within(x, y, turn_deg), random.with(k as u64));
    }
    solids.push(place.cuboid(Surface::Felt, [-1.58, -0.0125, 0.6], [3.16, 0.025, 0.6]));
}

/// A desk whose user looks along +y, with its screen, its pedestal and its chair.
fn add_workplace(solids: &mut Vec<Solid>, place: Place, random: Key) {
    let parts = [
        (Surface::Desk, [-0.79, -0.4, 0.72], [1.58, 0.8, 0.03]),
        (Surface::Steel, [-0.77, -0.38, GAP_M], [0.03, 0.74, 0.718]),
        (Surface::Steel, [0.74, -0.38, GAP_M], [0.03, 0.74, 0.718]),
        (Surface::Lacquer, [0.3, -0.34, GAP_M], [0.42, 0.6, 0.58]),
        (Surface::Screen, [-0.3, 0.12, 0.87], [0.6, 0.03, 0.36]),
        (Surface::Steel, [-0.03, 0.153, 0.765], [0.06, 0.02, 0.25]),
        (Surface::Steel, [-0.12, 0.06, 0.751], [0.24, 0.2, 0.012]),
    ];
    solids.extend(parts.map(|(surface, low, size)| place.cuboid(surface, low, size)));
    let chair_y = -0.72 - 0.25 * random.with(0).uniform();
    let askew_deg = ASKEW_DEG * (2.0 * random.with(1).uniform() - 1.0);
    add_chair(solids, place.within(0.0, chair_y, askew_deg));
}

fn add_chair(solids: &mut Vec<Solid>, place: Place) {
    let parts = [
        (Surface::Chair, [-0.23, -0.22, 0.44], [0.46, 0.46, 0.06]),
        (Surface::Chair, [-0.21, -0.27, 0.56], [0.42, 0.04, 0.44]),
        (Surface::Steel, [-0.03, -0.3, 0.4], [0.06, 0.025, 0.4]),
        (Surface::Steel, [-0.03, -0.03, 0.091], [0.06, 0.06, 0.348]),
        (Surface::Steel, [-0.25, -0.25, 0.05], [0.5, 0.5, 0.04]),
    ];
    solids.extend(parts.map(|(surface, low, size)| place.cuboid(surface, low, size)));
}

/// Two low cabinets at a wall.
fn add_cabinets(solids: &mut Vec<Solid>, place: Place) {
    for x in [0.5, 1.301] {
        solids.push(place.cuboid(Surface::Lacquer, [x, 0.02, GAP_M], [0.8, 0.45, 1.1]));
    }
}

/// An open shelf, 1.2 m wide along +x, with its back at y = 0 and some books on its boards.
fn add_shelf(solids: &mut Vec<Solid>, place: Place, random: Key) {
    let (height_m, depth_m) = (2.0, 0.32);
    let side = [0.025, depth_m, height_m];
    solids.push(place.cuboid(Surface::Shelf, [-0.6, GAP_M, GAP_M], side));
    solids.push(place.cuboid(Surface::Shelf, [0.575, GAP_M, GAP_M], side));
    for board in 0..6 {
        let z = 0.05 + 0.38 * f64::from(board);
        solids.push(place.cuboid(Surface::Shelf, [-0.573, GAP_M, z], [1.146, depth_m, 0.025]));
        if board == 5 {
            break;
        }
        let random = random.with(u64::from(board as u32));
        let (width_m, tall_m) =
            (0.3 + 0.7 * random.with(0).uniform(), 0.22 + 0.08 * random.with(1).uniform());
        let low = [-0.55, 0.03, z + 0.025 + GAP_M];
        solids.push(place.cuboid(Surface::Book, low, [width_m, 0.22, tall_m]));
    }
}

/// Benches and plants in the middle, a counter before the doors in the east.
fn add_nave(solids: &mut Vec<Solid>) {
    let middle_y = 0.5 * WIDTH_M;
    for bay in 0..COLUMNS - 2 {
        let place = Place::at(column_x_m(bay) + 0.5 * BAY_M, middle_y, 0.0);
        for (low, size) in [
            ([-0.9, -0.25, 0.4], [1.8, 0.5, 0.08]),
            ([-0.75, -0.2, GAP_M], [0.06, 0.4, 0.398]),
            ([0.69, -0.2, GAP_M], [0.06, 0.4, 0.398]),
        ] {
            solids.push(place.cuboid(Surface::Bench, low, size));
        }
        add_plant(solids, place.within(0.5 * BAY_M, 0.0, 0.0));
    }
    let counter = Place::at(LENGTH_M - 5.5, middle_y, 90.0);
    solids.push(counter.cuboid(Surface::Counter, [-1.6, -0.3, GAP_M], [3.2, 0.6, 1.05]));
    solids.push(counter.cuboid(Surface::Desk, [-1.7, -0.4, 1.053], [3.4, 0.8, 0.04]));
    solids.push(counter.cuboid(Surface::Screen, [-0.3, 0.1, 1.12], [0.5, 0.03, 0.34]));
    solids.push(counter.cuboid(Surface::Steel, [-0.15, 0.02, 1.094], [0.2, 0.16, 0.024]));
}

/// A pot and a crown of leaves on a stem.
fn add_plant(solids: &mut Vec<Solid>, place: Place) {
    let pot = [[0.0, 0.0], [0.22, 0.0], [0.3, 0.5], [0.26, 0.5], [0.25, 0.44], [0.0, 0.44]];
    let stem = [[0.0, 0.0], [0.04, 0.0], [0.03, 0.5], [0.0, 0.5]];
    let crown = [[0.0, 0.0], [0.3, 0.1], [0.5, 0.4], [0.45, 0.75], [0.25, 1.0], [0.0, 1.1]];
    let lathe = |surface, z: f64, rings: &[[f64; 2]], sides, coarseness| Solid {
        surface,
        form: Form::Lathe { foot: place.point([0.0, 0.0, z]), rings_m: rings.to_vec(), sides },
        coarseness,
    };
    solids.push(lathe(Surface::Pot, GAP_M, &pot, 8, 1.0));
    solids.push(lathe(Surface::Shelf, 0.442, &stem, 5, 1.0));
    solids.push(lathe(Surface::Leaf, 0.944, &crown, 8, FOLIAGE));
}

/// A table behind panes of glass.
fn add_meeting_corner(solids: &mut Vec<Solid>, place: Place) {
    for k in 0..4 {
        let y = 0.12 + 1.8 * f64::from(k);
        solids.push(place.cuboid(Surface::Rail, [-0.02, y - 0.01, GAP_M], [0.04, 1.78, 0.06]));
        solids.push(Solid {
            surface: Surface::Glass,
            form: Form::Sheet {
                corner: place.point([0.0, y, 0.063]),
                edges: [Vector::new(0.0, 1.76, 0.0), Vector::new(0.0, 0.0, 2.4)],
                is_turned: false,
            },
            coarseness: 6.0,
        });
    }
    let table = place.within(1.35, 3.6, 0.0);
    solids.push(table.cuboid(Surface::Desk, [-0.5, -1.6, 0.71], [1.0, 3.2, 0.04]));
    for y in [-1.2, 1.1] {
        solids.push(table.cuboid(Surface::Steel, [-0.3, y, GAP_M], [0.6, 0.1, 0.707]));
    }
    for (x, y, turn_deg) in [(0.75, -0.7, 90.0), (0.8, 0.8, 75.0), (-0.75, 0.1, 275.0)] {
        add_chair(solids, table.within(x, y, turn_deg));
    }
}
