//! Bytes to an [`LdtFile`].

use super::fields::Fields;
use super::{Header, LampSet, LdtFile, LdtSymmetry, LuminaireKind, RecordLines, Sizes, audit};
use crate::plain_text::{decode, lines, read_bounded};
use crate::{Loaded, Problem, Problems, product_file};
use std::path::Path;

/// Largest file read, bytes: a million intensities of sixty characters.
const MAX_FILE: u64 = 64 << 20;

/// Planes and gamma angles a file may have: a quarter of a degree, closed.
const MAX_ANGLES: i32 = 1441;

/// Intensities a file may hold: a quarter of a degree over the whole sphere.
const MAX_INTENSITIES: usize = 1 << 20;

/// Lamp sets a file may list; the format was made for a few.
const MAX_LAMP_SETS: i32 = 100;

/// More is the power of a city, W.
const MOST_WATTS: f64 = 1e9;

/// Reads a photometric file.
pub fn read(path: &Path) -> Result<Loaded<LdtFile>, Problems> {
    parse(&read_bounded(path, MAX_FILE)?, path)
}

/// Reads a photometric file from memory. `file` is its name for messages.
pub fn parse(bytes: &[u8], file: &Path) -> Result<Loaded<LdtFile>, Problems> {
    if let Some(problem) = product_file::by_content(bytes, file) {
        return Err(problem.into());
    }
    let text = decode(bytes, file)?;
    let lines = lines(&text);
    let mut fields = Fields::new(file, &lines);
    let value = luminaire(&mut fields, file)?;
    let mut warnings = Vec::new();
    if let Some(text) = fields.rest() {
        if text.replace(',', ".").parse::<f64>().is_ok() {
            let what = "numbers follow after the last intensity";
            let remedy = "make symmetry and counts in lines 3, 4 and 6 agree with the table";
            return Err(fields.problem(what, remedy).into());
        }
        warnings.push(fields.problem("text after the table is left out", "remove it"));
    }
    warnings.extend(audit::warnings(&value));
    Ok(Loaded { value, warnings })
}

fn luminaire(fields: &mut Fields, file: &Path) -> Result<LdtFile, Problem> {
    let mut header = Header { company: fields.text("the company")?.into(), ..Header::default() };
    let kind = kind(fields)?;
    let symmetry = symmetry(fields)?;
    let planes = planes(fields, symmetry)?;
    let plane_step_deg = step(fields, "the step between planes")?;
    let gammas = fields.count("the number of gamma angles", 2, MAX_ANGLES)? as usize;
    let gamma_step_deg = step(fields, "the step between gamma angles")?;
    for (text, what) in [
        (&mut header.report, "the measurement report"),
        (&mut header.luminaire, "the luminaire's name"),
        (&mut header.number, "the luminaire's number"),
        (&mut header.file_name, "the file name"),
        (&mut header.date, "the date"),
    ] {
        *text = fields.text(what)?.into();
    }
    let sizes = sizes(fields)?;
    let percent = |v: f64| (0.0..=1000.0).contains(&v);
    let downward_flux_percent = fields.optional("the downward flux", "0 to 1000 %", percent)?;
    let light_output_ratio_percent =
        fields.optional("the light output ratio", "0 to 1000 %", percent)?;
    let conversion_factor =
        fields.optional("the conversion factor", "0 to 1e9", |v| (0.0..=1e9).contains(&v))?;
    let measured_tilt_deg =
        fields.optional("the tilt", "within -360 and 360", |v| v.abs() <= 360.0)?;
    let mut lines = RecordLines { lamps: fields.next_line(), ..RecordLines::default() };
    let lamp_sets = lamp_sets(fields)?;
    let mut direct_ratios = [0.0; 10];
    for ratio in &mut direct_ratios {
        *ratio = fields.optional("a direct ratio", "a number", |_| true)?;
    }
    lines.planes = fields.next_line();
    let planes_deg = fields.angles("plane", planes, 360.0)?;
    lines.gammas = fields.next_line();
    let gammas_deg = fields.angles("gamma angle", gammas, 180.0)?;
    lines.candela = fields.next_line();
    let candela_per_klm = intensities(fields, symmetry.given(planes).len() * gammas)?;
    Ok(LdtFile {
        file: file.to_owned(),
        lines,
        header,
        kind,
        symmetry,
        plane_step_deg,
        gamma_step_deg,
        sizes,
        downward_flux_percent,
        light_output_ratio_percent,
        conversion_factor,
        measured_tilt_deg,
        lamp_sets,
        direct_ratios,
        planes_deg,
        gammas_deg,
        candela_per_klm,
    })
}

fn kind(fields: &mut Fields) -> Result<LuminaireKind, Problem> {
    Ok(match fields.count("the type indicator", 0, 3)? {
        0 => LuminaireKind::PointWithoutSymmetry,
        1 => LuminaireKind::PointAxial,
        2 => LuminaireKind::Linear,
        _ => LuminaireKind::PointOther,
    })
}

fn symmetry(fields: &mut Fields) -> Result<LdtSymmetry, Problem> {
    Ok(match fields.count("the symmetry indicator", 0, 4)? {
        0 => LdtSymmetry::None,
        1 => LdtSymmetry::Axial,
        2 => LdtSymmetry::AboutC0C180,
        3 => LdtSymmetry::AboutC90C270,
        _ => LdtSymmetry::AboutBoth,
    })
}

/// The number of planes, which a symmetry must be able to divide.
fn planes(fields: &mut Fields, symmetry: LdtSymmetry) -> Result<usize, Problem> {
    let planes = fields.count("the number of planes", 1, MAX_ANGLES)? as usize;
    let part = symmetry.divides_into();
    if planes.is_multiple_of(part) {
        return Ok(planes);
    }
    Err(fields.problem(
        format!("{planes} planes are no multiple of {part}, as the symmetry in line 3 needs"),
        "count all planes of the circle, also those that follow from symmetry",
    ))
}

fn step(fields: &mut Fields, what: &str) -> Result<f64, Problem> {
    fields.optional(what, "0 to 360 degrees", |v| (0.0..=360.0).contains(&v))
}

fn sizes(fields: &mut Fields) -> Result<Sizes, Problem> {
    let mut size = |what: &str| {
        let millimetres = fields.optional(what, "0 to 1e8 mm", |v| (0.0..=1e8).contains(&v))?;
        Ok(millimetres / 1000.0)
    };
    let mut sizes = Sizes::default();
    for (metres, what) in sizes.luminaire_m.iter_mut().zip([
        "the luminaire's length",
        "the luminaire's width",
        "the luminaire's height",
    ]) {
        *metres = size(what)?;
    }
    for (metres, what) in
        sizes.luminous_area_m.iter_mut().zip(["the luminous length", "the luminous width"])
    {
        *metres = size(what)?;
    }
    for metres in &mut sizes.luminous_heights_m {
        *metres = size("a luminous height")?;
    }
    Ok(sizes)
}

fn lamp_sets(fields: &mut Fields) -> Result<Vec<LampSet>, Problem> {
    let sets = fields.count("the number of lamp sets", 1, MAX_LAMP_SETS)?;
    (0..sets).map(|_| lamp_set(fields)).collect()
}

fn lamp_set(fields: &mut Fields) -> Result<LampSet, Problem> {
    let lamps = fields.count("the number of lamps", -100_000, 100_000)?;
    Ok(LampSet {
        lamps: lamps.unsigned_abs(),
        absolute: lamps < 0,
        kind: fields.text("the lamp type")?.into(),
        flux_lm: fields
            .number("the flux of the lamps", "0 to 1e12 lm", |v| (0.0..=1e12).contains(&v))?,
        colour: fields.text("the colour of the light")?.into(),
        colour_rendering: fields.text("the colour rendering")?.into(),
        watts: fields
            .optional("the power", "a number of watts up to 1e9", |w| w.abs() <= MOST_WATTS)?,
    })
}

fn intensities(fields: &mut Fields, count: usize) -> Result<Vec<f64>, Problem> {
    if count > MAX_INTENSITIES {
        return Err(fields.problem(
            format!("the counts ask for {count} intensities, more than {MAX_INTENSITIES}"),
            "correct the counts in lines 4 and 6",
        ));
    }
    let mut candela = Vec::new();
    for index in 1..=count {
        let name = format!("intensity {index} of {count}");
        let possible = |v: f64| (0.0..=1e15).contains(&v);
        candela.push(fields.number(&name, "0 to 1e15 cd/klm", possible)?);
    }
    Ok(candela)
}
