//! What is odd about a file that can be read.

use super::{IesFile, LampFactor, PhotometricType, Tilt, across};
use crate::Problem;
use isolux::photometry::Symmetry;
use std::path::Path;

/// More light than the lamps give by this share is no rounding of a rated flux any more.
const EXCESS: f64 = 0.05;

/// The version line names no edition there is.
pub(super) fn unknown_edition(file: &Path, line: &str) -> Problem {
    Problem::new(
        file,
        "line 1",
        format!("{line:?} names no edition of LM-63; read as LM-63-2002"),
        "write IESNA:LM-63-2002 or IES:LM-63-2019",
    )
}

/// All that should be shown to whoever uses the file.
pub(super) fn warnings(record: &IesFile) -> Vec<Problem> {
    [factor_ignored(record), opening_unknown(record), tilt_at_rest(record)]
        .into_iter()
        .chain([uncovered(record), unclosed(record), mirrored(record), too_bright(record)])
        .flatten()
        .collect()
}

fn factor_ignored(record: &IesFile) -> Option<Problem> {
    let LampFactor::Reserved(value) = record.lamp_factor else { return None };
    (value != 1.0).then(|| {
        record.problem(
            record.lines.lamps,
            format!("the number after the ballast factor is {value}; LM-63-2002 reserves it"),
            "write 1 there and put factors into the multiplier; it is not applied",
        )
    })
}

fn opening_unknown(record: &IesFile) -> Option<Problem> {
    record.opening.shape.is_none().then(|| {
        record.problem(
            record.lines.lamps,
            "the signs of width, length and height describe no shape",
            "correct them if the size of the luminaire matters",
        )
    })
}

fn tilt_at_rest(record: &IesFile) -> Option<Problem> {
    let factor = record.tilt.factor(0.0);
    (record.tilt != Tilt::None && factor != 1.0).then(|| {
        record.problem(
            record.lines.lamps,
            format!("the tilt factor {factor} at 0 degrees is applied"),
            "dim the luminaire accordingly if it is mounted tilted",
        )
    })
}

fn uncovered(record: &IesFile) -> Option<Problem> {
    let (first, last) = (record.vertical_deg.first()?, record.vertical_deg.last()?);
    let whole = [0.0, 90.0].contains(first) && [90.0, 180.0].contains(last);
    (record.photometric_type == PhotometricType::C && !whole).then(|| {
        record.problem(
            record.lines.vertical,
            format!("vertical angles from {first} to {last}; directions beyond are taken as dark"),
            "begin at 0 or 90 and end at 90 or 180 degrees",
        )
    })
}

fn unclosed(record: &IesFile) -> Option<Problem> {
    let last = *record.horizontal_deg.last()?;
    let open = last < 360.0 && record.symmetry() == Ok(Symmetry::None);
    (record.photometric_type == PhotometricType::C && open).then(|| {
        record.problem(
            record.lines.horizontal,
            format!("horizontal angles end at {last}; the plane at 0 closes the circle"),
            "repeat it at 360 degrees",
        )
    })
}

fn mirrored(record: &IesFile) -> Option<Problem> {
    let lists = match (record.photometric_type, across::mirrored(record)) {
        (PhotometricType::C, _) | (_, [false, false]) => return None,
        (_, [true, true]) => "horizontal and vertical angles",
        (_, [true, false]) => "horizontal angles",
        (_, [false, true]) => "vertical angles",
    };
    Some(record.problem(
        record.lines.vertical,
        format!("{lists} from 0 on are mirrored to the other side of the aim"),
        "give angles from -90 on if the beam is not symmetric",
    ))
}

pub(super) fn too_bright(record: &IesFile) -> Option<Problem> {
    let lamps = record.lamp_lumens()?;
    let flux = record.resolve().ok()?.luminous_flux_lm();
    (flux > (1.0 + EXCESS) * lamps).then(|| {
        record.problem(
            record.lines.lamps,
            format!("the table holds {flux:.0} lm, its lamps give {lamps} lm"),
            "check lamps, lumens and multiplier; -1 lumens stands for absolute photometry",
        )
    })
}
