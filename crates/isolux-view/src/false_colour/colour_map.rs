//! Colour maps.

use crate::srgb::linear_from_codes;
use colorous::Gradient;
use isolux::units::Rgb;

/// Colours of one map.
pub(super) const STEPS: usize = 256;

/// The closed set of colour maps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ColourMap {
    /// Dark violet over green to yellow: lightness rises evenly, and so for eyes that confuse red
    /// and green (van der Walt and Smith 2015, matplotlib).
    #[default]
    Viridis,
    /// Black over red to pale yellow, evenly in lightness (van der Walt and Smith 2015, matplotlib).
    Inferno,
    /// The rainbow with the fewest false edges: more steps can be told apart, but they are ordered
    /// by hue, and lightness falls again at the upper end (Mikhailov 2019, Google).
    Turbo,
}

impl ColourMap {
    /// The sRGB colours from the lowest to the highest value.
    pub fn table(self) -> [[u8; 3]; STEPS] {
        let gradient: Gradient = match self {
            Self::Viridis => colorous::VIRIDIS,
            Self::Inferno => colorous::INFERNO,
            Self::Turbo => colorous::TURBO,
        };
        std::array::from_fn(|k| gradient.eval_rational(k, STEPS).as_array())
    }

    /// The same as display-linear values.
    pub(super) fn linear_table(self) -> [Rgb; STEPS] {
        self.table().map(linear_from_codes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ordered_maps_rise_in_lightness() {
        for map in [ColourMap::Viridis, ColourMap::Inferno] {
            let light = map.linear_table().map(Rgb::luminance);
            // A colour code is a 255th: neighbours may fall back by the rounding of one.
            let falls = light.windows(2).any(|w| w[1] < w[0] - 0.005);
            assert!(!falls, "{map:?}");
            assert!(light[255] > 0.7 && light[0] < 0.02, "{map:?}");
        }
    }

    #[test]
    fn maps_end_in_their_published_colours() {
        let ends = |map: ColourMap| (map.table()[0], map.table()[255]);
        assert_eq!(ends(ColourMap::Viridis), ([68, 1, 84], [253, 231, 37]));
        assert_eq!(ends(ColourMap::Inferno), ([0, 0, 4], [252, 255, 164]));
        // The polynomial fit of turbo, cut to integers.
        assert_eq!(ends(ColourMap::Turbo), ([34, 23, 27], [144, 12, 0]));
    }
}
