//! The values at the points of a grid, for JSON and CSV.

use super::asked::Asked;
use super::modelling;
use super::result::GridResult;
use isolux::geometry::Point;
use isolux::map::Illuminance;
use isolux::units::Digits;
use serde::Serialize;
use std::fmt::Write;

#[derive(Serialize)]
pub(super) struct Value {
    position: [f64; 3],
    illuminance_lx: Option<f64>,
    standard_error_lx: Option<f64>,
    direct_lx: Option<f64>,
    indirect_lx: Option<f64>,
}

pub(super) fn value((&position, value): (&Point, Option<Illuminance>)) -> Value {
    Value {
        position: position.into(),
        illuminance_lx: value.map(|v| v.illuminance_lx()),
        standard_error_lx: value.map(|v| v.standard_error_lx),
        direct_lx: value.map(|v| v.direct_lx.luminance()),
        indirect_lx: value.map(|v| v.indirect_lx.luminance()),
    }
}

const HEADER: &str =
    "grid,i,j,x,y,z,illuminance_lx,standard_error_lx,direct_lx,indirect_lx,maintenance_factor";

/// All points as CSV.
pub(super) fn rows(results: &[GridResult], asked: &Asked, digits: Digits) -> String {
    let mut text = HEADER.to_owned();
    text += if asked.is_planar() { "" } else { ",quantity" };
    text +=
        if asked.is_modelling() { ",horizontal_lx,modelling,modelling_standard_error" } else { "" };
    text.push('\n');
    for result in results {
        let across = result.read.grid.counts()[0] as usize;
        let name = format!("\"{}\"", result.read.grid.name.replace('"', "\"\""));
        for (index, (&position, of)) in
            result.read.points.iter().zip(result.read.maintained()).enumerate()
        {
            let Value { illuminance_lx, standard_error_lx, direct_lx, indirect_lx, .. } =
                value((&position, of));
            let error_lx = standard_error_lx.unwrap_or(f64::NAN);
            let fields = [illuminance_lx, standard_error_lx, direct_lx, indirect_lx]
                .map(|field| number(field, digits, error_lx));
            let (i, j, Point { x, y, z }) = (index % across, index / across, position);
            let factor = result.read.grid.maintenance_factor;
            let _ = write!(text, "{name},{i},{j},{x},{y},{z},{},{factor}", fields.join(","));
            if !asked.is_planar() {
                let _ = write!(text, ",{}", asked.word());
            }
            if let Some(modelling) = &result.modelling {
                text += &of_modelling(&modelling.values[index], digits);
            }
            text.push('\n');
        }
    }
    text
}

fn number(field: Option<f64>, digits: Digits, error: f64) -> String {
    field.map_or(String::new(), |value| digits.number(value, error))
}

fn of_modelling(of: &modelling::Point, digits: Digits) -> String {
    let error = of.standard_error.unwrap_or(f64::NAN);
    let horizontal = number(of.horizontal_lx, digits, f64::NAN);
    let [ratio, own] = [of.modelling, of.standard_error].map(|field| number(field, digits, error));
    format!(",{horizontal},{ratio},{own}")
}
