//! The building: shell, columns, beams, and what is fixed to them.

use super::size::{BAY_M, COLUMNS, GAP_M, HEIGHT_M, LENGTH_M, ROWS_M, WIDTH_M};
use super::solid::{Form, Solid};
use super::surface::Surface;
use isolux::geometry::{Point, Vector};

/// Large plain surfaces are divided less than what stands between them.
const PLAIN: f64 = 6.0;
const COLUMN_SIDES: u32 = 12;
/// Half the width of beams along and across the hall, m.
pub(super) const HALF_BEAM_M: [f64; 2] = [0.2, 0.12];
/// Where beams end below, along and across the hall, m.
pub(super) const BEAM_BOTTOM_M: [f64; 2] = [3.6, 3.7];
/// Height of the underside of the profiles that carry the linear luminaires, m.
pub(super) const PROFILE_BOTTOM_M: f64 = 2.9;
const PROFILE_M: f64 = 0.06;
/// Profiles over an aisle: the first from the wall, how far apart, and how many.
pub(super) const PROFILES: (f64, f64, u32) = (0.95, 0.9, 8);

pub(super) fn solids() -> Vec<Solid> {
    let mut solids = shell();
    solids.extend(columns());
    solids.extend(beams());
    solids.extend(profiles());
    solids.extend(mirrors());
    solids.extend(panels());
    solids
}

/// Axis of a column, by its number in a row.
pub(super) fn column_x_m(k: u32) -> f64 {
    BAY_M * (f64::from(k) + 0.5)
}

fn shell() -> Vec<Solid> {
    let x = Vector::new(LENGTH_M, 0.0, 0.0);
    let y = Vector::new(0.0, WIDTH_M, 0.0);
    let z = Vector::new(0.0, 0.0, HEIGHT_M);
    let (near, far) = (Point::ORIGIN, Point::ORIGIN + x + y + z);
    [
        (Surface::Floor, near, [x, y], false),
        (Surface::Ceiling, Point::new(0.0, 0.0, far.z), [x, y], true),
        (Surface::Wall, near, [x, z], true),
        (Surface::Wall, Point::new(0.0, far.y, 0.0), [x, z], false),
        (Surface::Wall, near, [y, z], false),
        (Surface::Wall, Point::new(far.x, 0.0, 0.0), [y, z], true),
    ]
    .map(|(surface, corner, edges, is_turned)| Solid {
        surface,
        form: Form::Sheet { corner, edges, is_turned },
        coarseness: PLAIN,
    })
    .into()
}

fn columns() -> Vec<Solid> {
    let top_m = BEAM_BOTTOM_M[0] - GAP_M;
    let rings_m = vec![
        [0.0, 0.0],
        [0.4, 0.0],
        [0.4, 0.12],
        [0.3, 0.2],
        [0.27, top_m - 0.35],
        [0.4, top_m - 0.2],
        [0.4, top_m - GAP_M],
        [0.0, top_m - GAP_M],
    ];
    let places = ROWS_M.into_iter().flat_map(|y| (0..COLUMNS).map(move |k| (column_x_m(k), y)));
    places
        .map(|(x, y)| Solid {
            surface: Surface::Column,
            form: Form::Lathe {
                foot: Point::new(x, y, GAP_M),
                rings_m: rings_m.clone(),
                sides: COLUMN_SIDES,
            },
            coarseness: 1.0,
        })
        .collect()
}

/// A box between two corners that is divided like a wall.
fn plain(surface: Surface, low: [f64; 3], high: [f64; 3]) -> Solid {
    let size = Point::from(high) - Point::from(low);
    let edges = [
        Vector::new(size.x, 0.0, 0.0),
        Vector::new(0.0, size.y, 0.0),
        Vector::new(0.0, 0.0, size.z),
    ];
    Solid { surface, form: Form::Box { corner: low.into(), edges }, coarseness: PLAIN }
}

/// Two beams along the hall on the columns, and beams across it between them.
fn beams() -> Vec<Solid> {
    let [along_m, across_m] = HALF_BEAM_M;
    let top_m = HEIGHT_M - GAP_M;
    let mut solids: Vec<Solid> = ROWS_M
        .map(|y| {
            let low = [GAP_M, y - along_m, BEAM_BOTTOM_M[0]];
            plain(Surface::Beam, low, [LENGTH_M - GAP_M, y + along_m, top_m])
        })
        .into();
    let spans_m = [
        [GAP_M, ROWS_M[0] - along_m - GAP_M],
        [ROWS_M[0] + along_m + GAP_M, ROWS_M[1] - along_m - GAP_M],
        [ROWS_M[1] + along_m + GAP_M, WIDTH_M - GAP_M],
    ];
    for x in (0..COLUMNS).map(column_x_m) {
        solids.extend(spans_m.map(|[from, to]| {
            let low = [x - across_m, from, BEAM_BOTTOM_M[1]];
            plain(Surface::Beam, low, [x + across_m, to, top_m])
        }));
    }
    solids
}

/// Distances of the profiles from the south wall, m.
pub(super) fn profile_y_m() -> Vec<f64> {
    let (first_m, step_m, count) = PROFILES;
    let south = (0..count).map(move |k| first_m + step_m * f64::from(k));
    let north = south.clone().map(|y| WIDTH_M - y);
    south.chain(north).collect()
}

fn profiles() -> Vec<Solid> {
    let profile = |y: f64| {
        let low = [0.2, y - 0.5 * PROFILE_M, PROFILE_BOTTOM_M];
        let high = [LENGTH_M - 0.2, y + 0.5 * PROFILE_M, PROFILE_BOTTOM_M + PROFILE_M];
        plain(Surface::Profile, low, high)
    };
    profile_y_m().into_iter().map(profile).collect()
}

/// Mirrors in front of their backing: one closes the nave in the west, two hang on the south wall.
fn mirrors() -> Vec<Solid> {
    let (thick_m, border_m) = (0.02, 0.05);
    let (x, y, z) =
        (Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 1.0, 0.0), Vector::new(0.0, 0.0, 1.0));
    let mut solids = Vec::new();
    let mut hang =
        |corner: [f64; 3], along: Vector, width_m: f64, height_m: f64, inward: Vector| {
            let corner = Point::from(corner);
            let back = corner + inward * GAP_M - (along + z) * border_m;
            let size = along * (width_m + 2.0 * border_m) + z * (height_m + 2.0 * border_m);
            let far = back + size + inward * thick_m;
            solids.push(plain(Surface::Rail, back.into(), far.into()));
            solids.push(Solid {
                surface: Surface::Mirror,
                form: Form::Sheet {
                    corner: corner + inward * (thick_m + 2.0 * GAP_M),
                    edges: [along * width_m, z * height_m],
                    is_turned: (along.cross(z)).dot(inward) < 0.0,
                },
                coarseness: PLAIN,
            });
        };
    hang([0.0, 9.4, 0.3], y, 5.2, 2.4, x);
    for bay in [1, 3] {
        hang([column_x_m(bay) + 2.3, 0.0, 0.4], x, 1.8, 2.0, y);
    }
    solids
}

/// Coloured panels and doors on the walls.
fn panels() -> Vec<Solid> {
    let on_north = |surface, x: f64, width_m: f64, low_m: f64, high_m: f64| {
        let (back, front) = (WIDTH_M - GAP_M, WIDTH_M - 0.04);
        plain(surface, [x, front, low_m], [x + width_m, back, high_m])
    };
    let on_east = |surface, y: f64, width_m: f64, low_m: f64, high_m: f64| {
        let (back, front) = (LENGTH_M - GAP_M, LENGTH_M - 0.04);
        plain(surface, [front, y, low_m], [back, y + width_m, high_m])
    };
    let mut solids: Vec<Solid> = (0..COLUMNS - 1)
        .map(|k| on_north(Surface::Panel, column_x_m(k) + 2.0, 2.0, 1.4, 2.6))
        .collect();
    solids.push(on_north(Surface::Door, 0.9, 1.0, 2.0 * GAP_M, 2.1));
    solids.extend([10.9, 12.01].map(|y| on_east(Surface::Door, y, 1.1, 2.0 * GAP_M, 2.4)));
    solids
}
