//! LM-63 to EULUMDAT.

use super::direct_ratios;
use crate::Problem;
use crate::ies::{IesFile, OpeningShape, PhotometricType, Tilt};
use crate::ldt::{Header, LampSet, LdtFile, LdtSymmetry, LuminaireKind, RecordLines, Sizes};
use isolux::geometry::{Direction, Vector};
use isolux::photometry::{PhotometricWeb, Symmetry};

/// Keywords that have a line of their own in EULUMDAT.
const KEPT: [&str; 6] = ["TEST", "ISSUEDATE", "MANUFAC", "LUMCAT", "LUMINAIRE", "LAMP"];

/// Planes listed of an axial table: EULUMDAT wants the circle, even if one plane stands for all.
const AXIAL_PLANES: u32 = 24;

/// Tables of types A and B are sampled at these steps, degrees.
const SAMPLED_PLANE_DEG: f64 = 2.5;
const SAMPLED_GAMMA_DEG: f64 = 1.0;

/// A table of type C over the circle, in cd.
struct Table {
    symmetry: LdtSymmetry,
    /// All planes of the circle.
    planes_deg: Vec<f64>,
    gammas_deg: Vec<f64>,
    /// Of the planes that the symmetry leaves to be given, in the order of the format.
    candela: Vec<f64>,
}

/// The record to write, and what is lost.
pub(super) fn record(
    file: &IesFile,
    web: &PhotometricWeb,
) -> Result<(LdtFile, Vec<String>), Problem> {
    let mut losses = Vec::new();
    let table = if file.photometric_type == PhotometricType::C {
        table_of_c(file.symmetry()?, web)
    } else {
        let steps = format!("{SAMPLED_PLANE_DEG} and {SAMPLED_GAMMA_DEG} degrees");
        let kind = file.photometric_type;
        losses.push(format!("the angles of type {kind:?}: sampled in C and gamma every {steps}"));
        sampled(web)
    };
    let flux_lm = web.luminous_flux_lm();
    let lamps = lamps(file, flux_lm);
    let per_klm = 1000.0 / lamps.flux_lm;
    let percent = |part: f64, whole: f64| if whole > 0.0 { 100.0 * part / whole } else { 0.0 };
    let downward_lm = if web.system().is_c() { web.flux_below_lm(90.0) } else { flux_lm };
    let record = LdtFile {
        file: file.file.clone(),
        lines: RecordLines::default(),
        header: header(file),
        kind: match table.symmetry {
            LdtSymmetry::Axial => LuminaireKind::PointAxial,
            _ => LuminaireKind::PointOther,
        },
        plane_step_deg: even_step(&table.planes_deg),
        gamma_step_deg: even_step(&table.gammas_deg),
        sizes: sizes(file, &mut losses),
        downward_flux_percent: tenth(percent(downward_lm, flux_lm)),
        light_output_ratio_percent: tenth(percent(flux_lm, lamps.flux_lm)),
        conversion_factor: 1.0,
        measured_tilt_deg: 0.0,
        lamp_sets: vec![lamps],
        direct_ratios: direct_ratios(web).unwrap_or_default().map(thousandth),
        candela_per_klm: table.candela.iter().map(|cd| six_digits(cd * per_klm)).collect(),
        symmetry: table.symmetry,
        planes_deg: table.planes_deg,
        gammas_deg: table.gammas_deg,
    };
    what_is_lost(file, &mut losses);
    Ok((record, losses))
}

/// The largest symmetry that both formats can say.
fn table_of_c(symmetry: Symmetry, web: &PhotometricWeb) -> Table {
    let gammas_deg = web.gammas_deg().to_vec();
    // A plane at 360 repeats the first.
    let open = web.planes_deg().partition_point(|&c| c < web.planes_deg()[0] + 360.0);
    let planes_deg = web.planes_deg()[..open].to_vec();
    if symmetry == Symmetry::Axial {
        let step = 360.0 / f64::from(AXIAL_PLANES);
        let planes_deg = (0..AXIAL_PLANES).map(|k| f64::from(k) * step).collect();
        let candela = web.candela().to_vec();
        return Table { symmetry: LdtSymmetry::Axial, planes_deg, gammas_deg, candela };
    }
    let wanted = match symmetry {
        Symmetry::AboutBoth => LdtSymmetry::AboutBoth,
        Symmetry::AboutC0C180 => LdtSymmetry::AboutC0C180,
        Symmetry::AboutC90C270 => LdtSymmetry::AboutC90C270,
        Symmetry::None | Symmetry::Axial => LdtSymmetry::None,
    };
    let symmetry = if wanted.fits(&planes_deg) { wanted } else { LdtSymmetry::None };
    let rows: Vec<&[f64]> = web.candela().chunks(gammas_deg.len()).collect();
    let given = symmetry.given(planes_deg.len());
    let candela = given.iter().flat_map(|&k| rows[k]).copied().collect();
    Table { symmetry, planes_deg, gammas_deg, candela }
}

/// A table of another type, at even steps.
fn sampled(web: &PhotometricWeb) -> Table {
    let steps = |end: f64, step: f64| (0..(end / step) as u32).map(move |k| f64::from(k) * step);
    let planes_deg: Vec<f64> = steps(360.0, SAMPLED_PLANE_DEG).collect();
    // Nothing shines backwards: a table that ends at the horizontal keeps the border sharp.
    let gammas_deg: Vec<f64> = steps(90.0, SAMPLED_GAMMA_DEG).chain([90.0]).collect();
    let at = |c: f64, gamma: f64| {
        let (sin_c, cos_c) = libm::sincos(c.to_radians());
        let (sin_gamma, cos_gamma) = libm::sincos(gamma.to_radians());
        let at = Vector::new(sin_gamma * cos_c, sin_gamma * sin_c, -cos_gamma).direction();
        web.intensity_cd(at.unwrap_or(-Direction::Z))
    };
    let candela = planes_deg.iter().flat_map(|&c| gammas_deg.iter().map(move |&g| at(c, g)));
    let candela = candela.collect();
    Table { symmetry: LdtSymmetry::None, planes_deg, gammas_deg, candela }
}

/// The lamps as declared, or the flux of the luminaire in absolute photometry.
fn lamps(file: &IesFile, flux_lm: f64) -> LampSet {
    let declared = file.lamp_lumens().filter(|lm| *lm > 0.0);
    // A dark luminaire has no flux to refer to.
    let flux_lm = declared.unwrap_or(if flux_lm > 0.0 { flux_lm } else { 1000.0 });
    LampSet {
        lamps: file.lamps.max(1),
        absolute: declared.is_none(),
        kind: file.keyword("LAMP").unwrap_or_default().into(),
        flux_lm: six_digits(flux_lm),
        colour: String::new(),
        colour_rendering: String::new(),
        watts: file.input_watts.max(0.0),
    }
}

fn header(file: &IesFile) -> Header {
    let said = |name: &str| file.keyword(name).unwrap_or_default().replace('\n', " ");
    let stem = file.file.file_stem().map(|s| s.to_string_lossy().into_owned());
    Header {
        company: said("MANUFAC"),
        report: said("TEST"),
        luminaire: said("LUMINAIRE"),
        number: said("LUMCAT"),
        file_name: stem.unwrap_or_default(),
        date: said("ISSUEDATE"),
    }
}

fn sizes(file: &IesFile, losses: &mut Vec<String>) -> Sizes {
    let opening = &file.opening;
    let (along_c0, along_c90) = (opening.length_m, opening.width_m);
    let shape = match opening.shape {
        Some(OpeningShape::Point | OpeningShape::Rectangle) => None,
        Some(OpeningShape::Disc) if along_c0 == along_c90 => None,
        Some(OpeningShape::Disc) => Some("ellipse"),
        Some(OpeningShape::Ellipsoid) => Some("sphere or ellipsoid"),
        Some(OpeningShape::CylinderAlongLength | OpeningShape::CylinderAlongWidth) => {
            Some("lying cylinder")
        }
        Some(OpeningShape::UprightDisc) => Some("upright disc"),
        None => Some("unknown shape"),
    };
    if let Some(shape) = shape {
        losses.push(format!("the luminous opening, a {shape}: written as the box around it"));
    }
    let is_round = opening.shape == Some(OpeningShape::Disc) && along_c0 == along_c90;
    // EULUMDAT calls length what lies along C90-C270, and a width of 0 means round.
    let area = if is_round { [along_c90, 0.0] } else { [along_c90, along_c0] };
    let [length, width] = area;
    Sizes {
        luminaire_m: [length, width, opening.height_m],
        luminous_area_m: area,
        luminous_heights_m: [opening.height_m; 4],
    }
}

fn what_is_lost(file: &IesFile, losses: &mut Vec<String>) {
    let mut lost = |when: bool, what: String| {
        if when {
            losses.push(what);
        }
    };
    let is_kept = |name: &str| KEPT.iter().any(|kept| kept.eq_ignore_ascii_case(name));
    let names: Vec<&str> =
        file.keywords.iter().map(|k| k.name.as_str()).filter(|n| !is_kept(n)).collect();
    lost(!names.is_empty(), format!("the keywords {}", names.join(", ")));
    lost(!file.labels.is_empty(), format!("{} label lines", file.labels.len()));
    lost(file.tilt != Tilt::None, "the tilt table: its factor at 0 degrees is applied".into());
    let factor = file.intensity_factor();
    lost(factor != 1.0, format!("the factors on intensities, {factor} in all: they are applied"));
    lost(true, "intensities beyond six digits".into());
    let sizes = "the size of the luminaire is written as its opening's";
    lost(true, format!("{sizes}; direct ratios are those of an evenly filled ceiling"));
    if file.photometric_type == PhotometricType::C && file.vertical_deg.first() != Some(&0.0) {
        lost(true, "gamma angles begin above 0, which some programs refuse".into());
    }
}

/// The step of an even list, degrees; 0 of an uneven one.
fn even_step(angles_deg: &[f64]) -> f64 {
    let mut steps = angles_deg.windows(2).map(|pair| pair[1] - pair[0]);
    let first = steps.next().unwrap_or(0.0);
    // Sums of decimal fractions.
    if steps.all(|step| (step - first).abs() < 1e-9) { six_digits(first) } else { 0.0 }
}

/// Rounded to as many digits as any goniometer measures.
fn six_digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

fn thousandth(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

fn tenth(value: f64) -> f64 {
    (value * 10.0).round() / 10.0
}
