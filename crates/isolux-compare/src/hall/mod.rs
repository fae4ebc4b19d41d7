//! HALL, the practical scene: an open-plan office between two rows of columns, with a nave in the
//! middle, some 10,000 triangles and 2626 luminaires of three photometric types.
//!
//! Nothing about it is known in closed form; it is what engines are measured on. Variants divide
//! the same surfaces into more triangles, or share the same flux among another number of
//! luminaires, so that a cost can be followed while the lux stay.

mod cameras;
mod division;
mod furniture;
mod lamps;
mod lighting;
mod room;
mod solid;
mod surface;
#[cfg(test)]
mod tests;
mod variant;

pub use lamps::{Lamp, lamps};
pub use variant::{Variant, VariantError};

use isolux::scene::{SceneParts, UpAxis};

/// From the west wall to the east wall, m.
const LENGTH_M: f64 = 36.0;
/// From the south wall to the north wall, m.
const WIDTH_M: f64 = 24.0;
/// From the floor to the ceiling, m.
const HEIGHT_M: f64 = 4.0;
/// Columns stand this far apart along the hall, the first and last half of it from the walls, m.
const BAY_M: f64 = 6.0;
/// Number of columns in a row.
const COLUMNS: u32 = 6;
/// The rows of columns, distance from the south wall, m.
const ROWS_M: [f64; 2] = [8.0, 16.0];
/// Between solids that touch: what is coplanar is decided by rounding.
const GAP_M: f64 = 0.001;

/// The hall in one of its variants.
pub fn parts(variant: Variant) -> SceneParts {
    let mut solids = room::solids();
    solids.extend(furniture::solids());
    let sizes_m = division::edge_lengths_m(&solids, variant.triangles);
    SceneParts {
        name: variant.to_string(),
        up: UpAxis::Z,
        shapes: solid::shapes(&solids, &sizes_m),
        materials: surface::materials(),
        luminaires: lighting::luminaires(variant.luminaires),
        groups: lighting::GROUPS.map(String::from).to_vec(),
        cameras: cameras::cameras(),
        ..SceneParts::default()
    }
}
