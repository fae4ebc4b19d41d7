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
pub mod places;
mod room;
mod size;
mod solid;
mod surface;
#[cfg(test)]
mod tests;
mod variant;

pub use lamps::{Lamp, lamps};
pub use variant::{Variant, VariantError};

use isolux::scene::{SceneParts, UpAxis};

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
