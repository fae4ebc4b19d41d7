//! What a table says twice, and whether it says the same.

use super::finding::Finding;
use super::table::Table;
use crate::ies::PhotometricType;
use crate::ldt::{LdtSymmetry, LuminaireKind};
use crate::photometric_file::PhotometricFile;
use isolux::photometry::Symmetry;

/// Readings of one direction repeat within a per cent on a good goniometer.
const REPEATABILITY: f64 = 0.01;
/// Tables made symmetric agree to their rounding, a part in a thousand of the greatest value.
const ROUNDING: f64 = 0.001;

pub(super) fn findings(file: &PhotometricFile, table: &Table) -> Vec<Finding> {
    let mut found = Vec::new();
    if table.photometric_type == PhotometricType::C {
        found.extend(poles(table));
        found.extend(closing_plane(table));
        if is_whole(file) {
            found.extend(hidden_symmetry(table));
        }
    }
    if let PhotometricFile::Ldt(file) = file {
        found.extend(kind_of_luminaire(file.kind, file.symmetry));
    }
    found
}

/// Whether all planes of the circle are given.
fn is_whole(file: &PhotometricFile) -> bool {
    match file {
        PhotometricFile::Ies(file) => file.symmetry() == Ok(Symmetry::None),
        PhotometricFile::Ldt(file) => file.symmetry == LdtSymmetry::None,
    }
}

/// Nadir and zenith are one direction each, whatever the plane.
fn poles(table: &Table) -> Vec<Finding> {
    let mut found = Vec::new();
    for (column, name) in [(0, "nadir"), (table.columns() - 1, "zenith")] {
        if ![0.0, 180.0].contains(&table.along_deg[column]) {
            continue;
        }
        let values = || (0..table.rows()).map(|row| table.at(row, column));
        let (least, most) = (values().fold(f64::INFINITY, f64::min), values().fold(0.0, f64::max));
        // Differences of what is dark beside the beam are nothing.
        if most - least > REPEATABILITY * most && most > REPEATABILITY * table.most() {
            let odd = (0..table.rows()).find(|&row| table.at(row, column) != table.at(0, column));
            found.push(Finding::warning(
                table.line(odd.unwrap_or(0), column),
                format!("the intensity at {name} is {least} to {most}, depending on the plane"),
                format!("give the {name} one value, the mean of all planes"),
            ));
        }
    }
    found
}

/// The planes at 0 and 360 degrees are one.
fn closing_plane(table: &Table) -> Option<Finding> {
    let (first, last) = (*table.across_deg.first()?, *table.across_deg.last()?);
    if (first, last) != (0.0, 360.0) {
        return None;
    }
    let most = table.most();
    let end = table.rows() - 1;
    let differs = |&column: &usize| {
        (table.at(0, column) - table.at(end, column)).abs() > REPEATABILITY * most
    };
    let column = (0..table.columns()).find(differs)?;
    Some(Finding::warning(
        table.line(end, column),
        format!(
            "{} holds {}, the same direction at C 0 holds {}",
            table.place(end, column),
            table.at(end, column),
            table.at(0, column)
        ),
        "repeat the plane at 0 there",
    ))
}

/// All planes are given where fewer would do.
fn hidden_symmetry(table: &Table) -> Option<Finding> {
    let allowed = ROUNDING * table.most();
    let row_at = |c: f64| {
        let c = if c < 0.0 { c + 360.0 } else { c };
        // Angles come as decimal fractions.
        table.across_deg.iter().position(|&plane| (plane % 360.0 - c % 360.0).abs() < 1e-9)
    };
    let agree = |one: usize, other: usize| {
        (0..table.columns()).all(|k| (table.at(one, k) - table.at(other, k)).abs() <= allowed)
    };
    let mirrors = |image: &dyn Fn(f64) -> f64| {
        let planes = table.across_deg.iter().enumerate();
        planes.clone().count() > 1
            && planes.into_iter().all(|(row, &c)| row_at(image(c)).is_some_and(|k| agree(row, k)))
    };
    let (about_0, about_90) =
        (mirrors(&|c| (360.0 - c) % 360.0), mirrors(&|c| (540.0 - c) % 360.0));
    let is_axial = table.rows() > 1 && (1..table.rows()).all(|row| agree(0, row));
    let symmetry = match (is_axial, about_0, about_90) {
        (true, _, _) => "about the vertical axis: one plane would do",
        (_, true, true) => "about C0-C180 and C90-C270: C0 to C90 would do",
        (_, true, false) => "about C0-C180: C0 to C180 would do",
        (_, false, true) => "about C90-C270",
        (_, false, false) => return None,
    };
    Some(Finding::note(
        table.across_line,
        format!("all planes are given, though the table is symmetric {symmetry}"),
        "nothing needs to be done",
    ))
}

fn kind_of_luminaire(kind: LuminaireKind, symmetry: LdtSymmetry) -> Option<Finding> {
    let is_axial = symmetry == LdtSymmetry::Axial;
    let what = match kind {
        LuminaireKind::PointAxial if !is_axial => {
            "type 1 is symmetric about the vertical axis, the symmetry in line 3 is not"
        }
        LuminaireKind::Linear | LuminaireKind::PointOther if is_axial => {
            "the symmetry in line 3 is about the vertical axis, which is type 1"
        }
        LuminaireKind::PointWithoutSymmetry => "type 0 is none of the standard's",
        _ => return None,
    };
    Some(Finding::note(2, what, "make lines 2 and 3 agree: type 1 axial, 2 linear, 3 other"))
}
