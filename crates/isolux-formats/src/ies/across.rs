//! Tables of types A and B, whose polar axis lies across the beam.

use super::{IesFile, PhotometricType};
use isolux::photometry::{AngleSystem, PhotometricWeb, WebError};

/// The horizontal and vertical angles of the aim are 0 in a file, and 90 from the pole in a web.
const AIM_DEG: f64 = 90.0;

/// Angles with what they index; given from 0 on, they are mirrored at it.
fn both_sides(angles_deg: &[f64]) -> Vec<(f64, usize)> {
    let given = || angles_deg.iter().copied().enumerate().map(|(index, angle)| (angle, index));
    if angles_deg.first() != Some(&0.0) {
        return given().collect();
    }
    let mirrored = given().skip(1).map(|(angle, index)| (-angle, index));
    mirrored.rev().chain(given()).collect()
}

/// Which of the lists are mirrored at the aim: horizontal, vertical.
pub(super) fn mirrored(record: &IesFile) -> [bool; 2] {
    let is_mirrored = |angles: &Vec<f64>| angles.len() > 1 && angles[0] == 0.0;
    [&record.horizontal_deg, &record.vertical_deg].map(is_mirrored)
}

/// The table as a web, every intensity times a factor.
pub(super) fn web(record: &IesFile, factor: f64) -> Result<PhotometricWeb, WebError> {
    let horizontal = both_sides(&record.horizontal_deg);
    let vertical = both_sides(&record.vertical_deg);
    let (system, planes, poles) = match record.photometric_type {
        PhotometricType::B => (AngleSystem::B, &vertical, &horizontal),
        PhotometricType::A | PhotometricType::C => (AngleSystem::A, &horizontal, &vertical),
    };
    let verticals = record.vertical_deg.len();
    let intensity = |plane: usize, pole: usize| {
        let (h, v) = if system == AngleSystem::B { (pole, plane) } else { (plane, pole) };
        record.candela[h * verticals + v] * factor
    };
    let intensity = &intensity;
    let candela = planes
        .iter()
        .flat_map(|&(_, plane)| poles.iter().map(move |&(_, pole)| intensity(plane, pole)))
        .collect();
    let from_pole = |list: &[(f64, usize)]| list.iter().map(|(angle, _)| angle + AIM_DEG).collect();
    PhotometricWeb::in_system(system, from_pole(planes), from_pole(poles), candela)
}

/// The horizontal and vertical angles, degrees, and the intensities of a web of the systems A or B in the
/// order of a file.
pub(super) fn table(web: &PhotometricWeb) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let from_aim = |angles: &[f64]| angles.iter().map(|&angle| from_aim(angle)).collect();
    let (planes, poles) = (from_aim(web.planes_deg()), from_aim(web.gammas_deg()));
    if web.system() != AngleSystem::B {
        return (planes, poles, web.candela().to_vec());
    }
    let count = poles.len();
    let column = |pole: usize| web.candela().iter().skip(pole).step_by(count).copied();
    let candela = (0..count).flat_map(column).collect();
    (poles, planes, candela)
}

/// The angle from the aim that reading turns back into an angle from the pole, to the last bit where
/// there is one.
fn from_aim(from_pole: f64) -> f64 {
    let angle = from_pole - AIM_DEG;
    let near = [angle, angle.next_up(), angle.next_down()];
    near.into_iter().find(|a| a + AIM_DEG == from_pole).unwrap_or(angle)
}
