//! Tone operators and colour maps as tables: whoever else shows a map shows it as [`crate::develop()`] and
//! [`crate::false_colour()`] do.

use crate::error::ViewError;
use crate::tone::{Levels, ToneOperator};
use isolux::units::Rgb;

/// Evenly spaced numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spaced {
    /// The first one.
    pub first: f64,
    /// From one to the next.
    pub step: f64,
    /// How many.
    pub count: usize,
}

impl Spaced {
    /// One after another.
    pub fn values(self) -> impl Iterator<Item = f64> {
        (0..self.count).map(move |k| self.first + k as f64 * self.step)
    }
}

/// Base-2 logarithms of exposed luminances: from a thousandth of the least code of a display to far above white, in steps over
/// which the curves err by less than a tenth of a code of eight bits when they are taken for straight.
const EXPOSED: Spaced = Spaced { first: -18.0, step: 0.0625, count: 449 };
/// Base-2 logarithms of luminances of white, cd/m2: from starlight to the sun on snow, and beyond.
const WHITES: Spaced = Spaced { first: -12.0, step: 0.25, count: 129 };
/// A tone operator shows nothing darker: the logarithm of zero.
const DARKEST: f64 = -40.0;

/// A tone operator for a display as a table.
#[derive(Clone, Debug, PartialEq)]
pub struct ToneTable {
    /// Whether it acts on luminance and keeps colours, not on each channel.
    pub on_luminance: bool,
    /// Base-2 logarithms of the luminance of white, cd/m2, of the rows; one row where it does not matter.
    pub whites: Spaced,
    /// Base-2 logarithms of the exposed luminance, of the columns.
    pub exposed: Spaced,
    /// Base-2 logarithms of what the display emits, row after row, which are linear between: 0 is the white of the display, where
    /// curves are cut.
    pub values: Vec<f32>,
}

/// The table of an operator, for a display with this luminance of white, cd/m2.
pub fn tone_table(
    operator: ToneOperator,
    display_white_cd_m2: f64,
) -> Result<ToneTable, ViewError> {
    let depends_on_white = matches!(operator, ToneOperator::Ward | ToneOperator::TumblinRushmeier);
    let whites = if depends_on_white { WHITES } else { Spaced { count: 1, ..WHITES } };
    let mut values = Vec::with_capacity(whites.count * EXPOSED.count);
    for white in whites.values() {
        let white_cd_m2 = libm::exp2(white);
        let map = operator.at(Levels { white_cd_m2, display_white_cd_m2 })?;
        let shown = |exposed: f64| map.uncut(Rgb::grey(libm::exp2(exposed))).0[1];
        values.extend(EXPOSED.values().map(|exposed| logarithm(shown(exposed))));
    }
    let on_luminance = matches!(
        operator,
        ToneOperator::Reinhard { .. } | ToneOperator::TumblinRushmeier | ToneOperator::Ward
    );
    Ok(ToneTable { on_luminance, whites, exposed: EXPOSED, values })
}

fn logarithm(value: f64) -> f32 {
    if value > 0.0 { libm::log2(value).max(DARKEST) as f32 } else { DARKEST as f32 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half a code of eight bits at the steepest place of sRGB: what a picture can differ by and still round alike.
    const HALF_A_CODE: f64 = 0.5 / 255.0;

    fn code(linear: f64) -> f64 {
        let linear = linear.clamp(0.0, 1.0);
        if linear <= 0.003_130_8 {
            12.92 * linear
        } else {
            1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
        }
    }

    /// What a page reads of a table.
    fn read(table: &ToneTable, white_cd_m2: f64, exposed: f64) -> f64 {
        let within = |steps: Spaced, value: f64| {
            let at = (libm::log2(value) - steps.first) / steps.step;
            let low = at.floor().clamp(0.0, steps.count.saturating_sub(2) as f64);
            (low as usize, at - low)
        };
        let (column, u) = within(table.exposed, exposed);
        let (row, v) =
            if table.whites.count == 1 { (0, 0.0) } else { within(table.whites, white_cd_m2) };
        let at = |r: usize, c: usize| f64::from(table.values[r * table.exposed.count + c]);
        let along = |r: usize| at(r, column) + u * (at(r, column + 1) - at(r, column));
        let low = along(row);
        libm::exp2(if v > 0.0 { low + v * (along(row + 1) - low) } else { low })
    }

    #[test]
    fn tables_show_what_operators_show() {
        let operators = [
            ToneOperator::LINEAR,
            ToneOperator::Filmic,
            ToneOperator::REINHARD,
            ToneOperator::Hable,
            ToneOperator::Ward,
            ToneOperator::TumblinRushmeier,
        ];
        for operator in operators {
            let table = tone_table(operator, 100.0).unwrap();
            for white_cd_m2 in [0.37, 17.0, 523.0, 41_000.0] {
                let map = operator.at(Levels { white_cd_m2, display_white_cd_m2: 100.0 }).unwrap();
                for step in 0..3000 {
                    let exposed = libm::exp2(-14.0 + 0.00713 * f64::from(step));
                    let shown = map.apply(Rgb::grey(exposed)).0[1];
                    let error = code(read(&table, white_cd_m2, exposed)) - code(shown);
                    assert!(
                        error.abs() < HALF_A_CODE,
                        "{operator:?} {white_cd_m2} {exposed}: {error}"
                    );
                }
            }
        }
    }
}
