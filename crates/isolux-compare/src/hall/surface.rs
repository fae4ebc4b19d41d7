//! What things are made of: reflectances of usual finishes, as luminous reflectance and tint.

use isolux::scene::{Body, Dielectric, Finish, Material};
use isolux::units::Rgb;

/// The surfaces of the hall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Surface {
    Floor,
    Ceiling,
    Wall,
    Column,
    Beam,
    Profile,
    Desk,
    Steel,
    Lacquer,
    Chair,
    Screen,
    Felt,
    Shelf,
    Book,
    Bench,
    Pot,
    Leaf,
    Door,
    Counter,
    Panel,
    Rail,
    Glass,
    Mirror,
}

/// How a surface meets light.
enum Look {
    /// Luminous reflectance and a tint that only its ratios matter of.
    Matt(f64, [f64; 3]),
    /// A pane.
    Clear,
    /// Reflectance.
    Mirror(f64),
}

use Look::{Clear, Matt};
use Surface as S;

const GREY: [f64; 3] = [1.0; 3];

/// Name and look, in the order of [`Surface`].
const ALL: [(Surface, &str, Look); 23] = [
    (S::Floor, "parquet", Matt(0.30, [1.0, 0.83, 0.64])),
    (S::Ceiling, "ceiling", Matt(0.80, GREY)),
    (S::Wall, "wall", Matt(0.65, [1.0, 0.97, 0.91])),
    (S::Column, "column", Matt(0.60, [1.0, 0.96, 0.88])),
    (S::Beam, "beam", Matt(0.70, GREY)),
    (S::Profile, "profile", Matt(0.55, [0.96, 0.98, 1.0])),
    (S::Desk, "beech", Matt(0.45, [1.0, 0.77, 0.52])),
    (S::Steel, "steel", Matt(0.35, [0.95, 0.98, 1.0])),
    (S::Lacquer, "lacquer", Matt(0.70, [1.0, 0.99, 0.95])),
    (S::Chair, "chair", Matt(0.20, [0.45, 0.85, 1.6])),
    (S::Screen, "screen", Matt(0.20, GREY)),
    (S::Felt, "felt", Matt(0.35, [0.72, 1.1, 0.85])),
    (S::Shelf, "oak", Matt(0.38, [1.0, 0.76, 0.50])),
    (S::Book, "book", Matt(0.30, [1.3, 0.92, 0.70])),
    (S::Bench, "bench", Matt(0.22, [2.6, 0.6, 0.45])),
    (S::Pot, "terracotta", Matt(0.30, [1.0, 0.60, 0.42])),
    (S::Leaf, "leaf", Matt(0.22, [0.55, 1.2, 0.35])),
    (S::Door, "door", Matt(0.32, [1.0, 0.72, 0.48])),
    (S::Counter, "counter", Matt(0.50, [1.0, 0.93, 0.82])),
    (S::Panel, "panel", Matt(0.40, [1.5, 0.9, 0.35])),
    (S::Rail, "rail", Matt(0.45, GREY)),
    (S::Glass, "glass", Clear),
    (S::Mirror, "mirror", Look::Mirror(0.85)),
];

impl Surface {
    /// Its index among the materials and shapes.
    pub(super) const fn index(self) -> usize {
        self as usize
    }
}

/// Names of surfaces, in their order.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    ALL.iter().map(|(_, name, _)| *name)
}

/// All materials. Solids are closed, so nobody sees a back: backs are black.
pub(super) fn materials() -> Vec<Material> {
    ALL.iter().map(|(_, name, look)| material(name, look)).collect()
}

fn material(name: &str, look: &Look) -> Material {
    match look {
        Matt(reflectance, tint) => {
            let channels = (Rgb(*tint).chromaticity() * *reflectance).map(to_three_decimals);
            Material::one_sided(name, Finish::diffuse(channels))
        }
        Clear => {
            let glass = Dielectric { ior: 1.52, transmittance: Rgb::grey(0.97), thin: true };
            Material { name: name.into(), body: Body::Dielectric(glass) }
        }
        Look::Mirror(reflectance) => {
            Material::one_sided(name, Finish::mirror(Rgb::grey(*reflectance)))
        }
    }
}

/// So that a file of the scene can be read.
fn to_three_decimals(share: f64) -> f64 {
    (1000.0 * share).round() / 1000.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surfaces_are_in_order_and_reflect_as_real_ones_do() {
        for (index, (surface, name, look)) in ALL.iter().enumerate() {
            assert_eq!(surface.index(), index, "{name}");
            let Matt(..) = look else { continue };
            let Body::Opaque { front, .. } = material(name, look).body else { panic!("{name}") };
            let reflectance = front.diffuse.colour.luminance();
            assert!((0.2 - 5e-4..=0.8 + 5e-4).contains(&reflectance), "{name}: {reflectance}");
            assert!(front.diffuse.colour.max_channel() <= 0.85, "{name}");
        }
    }
}
