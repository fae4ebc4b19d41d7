//! Charts: a quantity in colours that can be read back through a legend.

mod colour_map;
mod contour;
mod field;
mod legend;
mod scale;
mod smooth;

pub use colour_map::ColourMap;
pub use field::Quantity;
pub use scale::{Scale, round_limits};

use crate::error::ViewError;
use crate::image::{LuminanceImage, Seen, Sight};
use crate::picture::{Picture, UNKNOWN};
use crate::srgb::{codes_from_linear, linear_from_codes};
use isolux::units::Rgb;
use legend::Legend;
use rayon::prelude::*;
use scale::Axis;

/// Lines of equal value.
#[derive(Clone, Debug, PartialEq)]
pub enum Contours {
    /// At the numbers of the legend.
    AtTicks,
    /// At these values, in the unit of the quantity.
    At(Vec<f64>),
}

/// What a chart shows, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct FalseColour {
    /// What is shown.
    pub quantity: Quantity,
    /// From values to colours.
    pub colours: ColourMap,
    /// Even steps of value or of its logarithm.
    pub scale: Scale,
    /// Values of the first and the last colour; `None` chooses round ones that hold all but the
    /// outermost half per cent of the pixels at either end.
    pub limits: Option<(f64, f64)>,
    /// Isolux lines.
    pub contours: Option<Contours>,
    /// The legend, to the right of the view, with a title (may be empty); `None` for none.
    pub legend: Option<String>,
}

impl Default for FalseColour {
    /// Lux on a linear scale with a legend.
    fn default() -> Self {
        Self {
            quantity: Quantity::Illuminance,
            colours: ColourMap::Viridis,
            scale: Scale::Linear,
            limits: None,
            contours: None,
            legend: Some(String::new()),
        }
    }
}

/// Draws a view as a chart. Values beyond the limits get the outermost colours; of what a map holds,
/// luminaires are white, surfaces without a value [`UNKNOWN`], and the background is black. A legend
/// makes the picture wider than the view by [`FalseColour::legend_width`].
pub fn false_colour(image: &LuminanceImage, how: &FalseColour) -> Result<Picture, ViewError> {
    let values = field::values(image, how.quantity);
    let axis = Axis::new(how.scale, how.limits, &values)?;
    let mut view = coloured(image, how, &axis);
    if let Some(contours) = &how.contours {
        let levels = match contours {
            Contours::AtTicks => axis.ticks(),
            Contours::At(levels) => levels.clone(),
        };
        contour::draw(&mut view, image, &values, &axis, &levels);
    }
    let Some(title) = &how.legend else { return Ok(view) };
    let marks = field::marks(image, how.quantity);
    let legend = Legend { title, quantity: how.quantity, colours: how.colours, axis: &axis, marks };
    let strip = legend.draw(view.height, axis.overflow(&values))?;
    view.beside(&strip)
}

impl FalseColour {
    /// Pixels that the legend adds to the width of a view of some height.
    pub fn legend_width(&self, height: u32) -> u32 {
        if self.legend.is_some() { legend::width(height) } else { 0 }
    }
}

fn coloured(image: &LuminanceImage, how: &FalseColour, axis: &Axis) -> Picture {
    let colours = how.colours.linear_table();
    let unknown = linear_from_codes(UNKNOWN);
    let colour = |seen: &Seen| match (how.quantity.of(seen), seen.sight) {
        (_, Sight::Background) => Rgb::BLACK,
        (_, Sight::Emitter) if how.quantity.is_of_the_map() => Rgb::WHITE,
        (Some(value), _) => colours[axis.step(value)],
        (None, _) => unknown,
    };
    let rgb = (0..image.size().pixels())
        .into_par_iter()
        .map(|pixel| {
            let sum: Rgb = image.samples(pixel).iter().map(colour).sum();
            codes_from_linear(sum / f64::from(image.samples_per_pixel()))
        })
        .collect();
    Picture { width: image.size().width(), height: image.size().height(), rgb, icc: None }
}
