//! Table 1: right values of CUBE.

use crate::case::cube::reference::cube_reference;
use crate::case::cube::{REFLECTANCE, TABLE_1, TablePoint};
use crate::report::document::{Block, Section, Table, numbers, words};
use crate::report::quantity::{list, percent};
use std::f64::consts::PI;

/// Luminance of a diffuse wall, `E rho / pi`, by our solution, cd/m2.
fn luminance_cd_m2(point: &TablePoint) -> f64 {
    REFLECTANCE * cube_reference().at(point.x, point.y).total_lx() / PI
}

/// The study's values beside ours.
pub(super) fn section() -> Section {
    let columns = vec![
        words("Point"),
        words("Place (x, y)"),
        numbers("Weight"),
        numbers("As printed, cd/m²"),
        numbers("Our solution, cd/m²"),
        numbers("Difference, %"),
    ];
    let table = Table::plain(
        "Table 1. Luminance of CUBE’s walls; (0, 0) is the middle of a face, edges are at ±1",
        columns,
        TABLE_1.iter().map(row).collect(),
    );
    Section {
        id: "table-1".to_owned(),
        title: "Table 1: right values of CUBE".to_owned(),
        blocks: vec![Block::Text(how().to_owned()), Block::Table(table), Block::Text(differs())],
    }
}

fn how() -> &'static str {
    "The study has its values from a Monte Carlo run and one step of numerical integration [1, 2.1]. Ours solve the integral equation of CUBE without \
     random numbers: direct light in closed form, indirect light by collocation. Luminance is illuminance × reflectance / π."
}

fn row(point: &TablePoint) -> Vec<String> {
    let ours = luminance_cd_m2(point);
    vec![
        point.name.to_string(),
        format!("({}, {})", point.x, point.y),
        format!("{}/25", point.weight),
        tenths(point.luminance_cd_m2),
        format!("{ours:.3}"),
        percent(point.luminance_cd_m2 / ours - 1.0),
    ]
}

/// As the study prints luminances, cd/m2.
fn tenths(luminance_cd_m2: f64) -> String {
    format!("{luminance_cd_m2:.1}")
}

/// Where the printed digits are not ours.
fn differs() -> String {
    let digits = |point: &TablePoint| [luminance_cd_m2(point), point.luminance_cd_m2].map(tenths);
    let differs = TABLE_1.iter().filter(|point| {
        let [ours, printed] = digits(point);
        ours != printed
    });
    let said: Vec<String> = differs
        .map(|point| {
            let [ours, printed] = digits(point);
            format!("{} ({ours}, where {printed} is printed)", point.name)
        })
        .collect();
    match said.as_slice() {
        [] => "Rounded to a tenth, all values are those printed.".to_owned(),
        [one] => format!(
            "Rounded to a tenth, all values are those printed but one: {one}. We take it for a misprint."
        ),
        several => {
            format!("Rounded to a tenth, these values are not those printed: {}.", list(several))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_misprint_is_said() {
        let said = differs();
        assert!(said.contains("but one: C (686.7, where 686.6 is printed)"), "{said}");
    }
}
