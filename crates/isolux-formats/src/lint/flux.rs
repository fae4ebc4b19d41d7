//! Lumens: declared against integrated, up against down, against the power.

use super::finding::Finding;
use crate::photometric_file::PhotometricFile;
use isolux::photometry::PhotometricWeb;

/// Flux and what is said of it agree in real files to rounding and quadrature; this share apart, one of
/// them is wrong.
const DISAGREEMENT: f64 = 0.05;
/// Luminaires that let less of their lamps' light out are rare.
const LEAST_OUTPUT_RATIO: f64 = 0.15;
/// White light has at most about 350 lm/W, and drivers and optics take their share.
const MOST_EFFICACY: f64 = 250.0;
/// Less upward light than this share is stray light, or the goniometer's.
const STRAY_SHARE: f64 = 0.02;
/// Upward light of at least this share of the flux is worth a word.
const TRACE_SHARE: f64 = 1e-4;
/// Lines of EULUMDAT.
const DOWNWARD_LINE: usize = 22;
const OUTPUT_RATIO_LINE: usize = 23;
/// Stated and integrated downward flux differ by quadrature alone by less, percent.
const DOWNWARD_PERCENT: f64 = 2.0;
/// Keywords in which files state the flux of the luminaire.
const TOTAL_KEYWORDS: [&str; 4] =
    ["_TOTALLUMINAIRELUMENS", "TOTALLUMINAIRELUMENS", "LUMINAIRELUMENS", "_ABSOLUTELUMENS"];

pub(super) fn findings(file: &PhotometricFile, web: &PhotometricWeb) -> Vec<Finding> {
    let flux_lm = web.luminous_flux_lm();
    let lamps = lamps_line(file);
    if flux_lm <= 0.0 {
        let remedy = "get the file again from its maker";
        return vec![Finding::warning(lamps, "every intensity is 0: it gives no light", remedy)];
    }
    let mut found = Vec::new();
    found.extend(output_ratio(file, flux_lm, lamps));
    found.extend(efficacy(file, flux_lm, lamps));
    if let PhotometricFile::Ies(file) = file {
        let totals = file
            .keywords
            .iter()
            .filter(|k| TOTAL_KEYWORDS.iter().any(|name| k.name.eq_ignore_ascii_case(name)));
        found.extend(totals.filter_map(|k| stated_total(&k.value, flux_lm, k.line)));
    }
    if web.system().is_c() {
        let upward = (1.0 - web.flux_below_lm(90.0) / flux_lm).max(0.0);
        found.extend(up_and_down(file, upward));
    }
    found
}

fn lamps_line(file: &PhotometricFile) -> usize {
    match file {
        PhotometricFile::Ies(file) => file.lines.lamps,
        PhotometricFile::Ldt(file) => file.lines.lamps,
    }
}

fn output_ratio(file: &PhotometricFile, flux_lm: f64, line: usize) -> Option<Finding> {
    let Some(lamps_lm) = file.lamp_flux_lm() else {
        return absolute(file, flux_lm);
    };
    if lamps_lm <= 0.0 {
        return Some(Finding::warning(
            line,
            "the lamps are declared with 0 lm",
            "give their flux, or -1 lumens for absolute photometry",
        ));
    }
    let ratio = flux_lm / lamps_lm;
    let percent = 100.0 * ratio;
    let what =
        format!("the table holds {flux_lm:.0} lm, {percent:.1} % of the lamps' {lamps_lm:.0} lm");
    if ratio < LEAST_OUTPUT_RATIO {
        let remedy = "check the multiplier, the number of lamps and their flux";
        return Some(Finding::warning(line, what, remedy));
    }
    // More than the lamps give is told by the reader.
    let is_told = ratio > 1.0 + DISAGREEMENT;
    (!is_told && ratio > 1.0)
        .then(|| Finding::note(line, what, "if it is no rounding, check the flux of the lamps"))
}

/// In absolute photometry EULUMDAT states the flux of the luminaire itself.
fn absolute(file: &PhotometricFile, flux_lm: f64) -> Option<Finding> {
    let PhotometricFile::Ldt(file) = file else { return None };
    let stated = file.lamp_sets.first()?.flux_lm;
    // With a light output ratio the reader tells.
    let is_told = file.light_output_ratio_percent > 0.0;
    let is_apart = (flux_lm - stated).abs() > DISAGREEMENT * stated;
    (is_apart && !is_told).then(|| {
        Finding::warning(
            file.lines.lamps,
            format!("the table holds {flux_lm:.0} lm, absolute photometry states {stated:.0} lm"),
            "make intensities and flux agree: cd per 1000 lm of this flux",
        )
    })
}

fn stated_total(value: &str, flux_lm: f64, line: usize) -> Option<Finding> {
    let stated: f64 = value.split_whitespace().next()?.replace(',', "").parse().ok()?;
    let is_apart = stated > 0.0 && (flux_lm - stated).abs() > DISAGREEMENT * stated;
    is_apart.then(|| {
        Finding::warning(
            line,
            format!("states {stated} lm of the luminaire, the table holds {flux_lm:.0} lm"),
            "check the multiplier; a table in other units than candela is no light",
        )
    })
}

fn efficacy(file: &PhotometricFile, flux_lm: f64, line: usize) -> Option<Finding> {
    let Some(watts) = file.input_watts() else {
        let what = "the input power is 0 or missing";
        return Some(Finding::note(line, what, "give it, if efficacy matters"));
    };
    let efficacy = flux_lm / watts;
    (efficacy > MOST_EFFICACY).then(|| {
        Finding::warning(
            line,
            format!("{flux_lm:.0} lm from {watts} W are {efficacy:.0} lm/W, more than light sources have"),
            "check the multiplier and the power",
        )
    })
}

fn up_and_down(file: &PhotometricFile, upward: f64) -> Vec<Finding> {
    let percent = 100.0 * upward;
    let stated = match file {
        PhotometricFile::Ldt(file) => {
            Some(file.downward_flux_percent).filter(|percent| *percent > 0.0)
        }
        PhotometricFile::Ies(_) => None,
    };
    let mut found = Vec::new();
    if let Some(stated) = stated.filter(|s| (100.0 - percent - s).abs() > DOWNWARD_PERCENT) {
        found.push(Finding::warning(
            DOWNWARD_LINE,
            format!("states {stated} % downward flux, the table holds {:.1} %", 100.0 - percent),
            "correct it, or check whether the table is upside down",
        ));
    }
    if upward > TRACE_SHARE && upward < STRAY_SHARE {
        found.push(Finding::note(
            0,
            format!("{percent:.2} % of the flux goes above the horizontal: stray light"),
            "check it where light to the sky or the ceiling counts",
        ));
    }
    if let PhotometricFile::Ldt(file) = file
        && file.light_output_ratio_percent > 100.0
        && !file.lamp_sets.first().is_some_and(|set| set.absolute)
    {
        found.push(Finding::warning(
            OUTPUT_RATIO_LINE,
            format!(
                "light output ratio {} %: more than the lamps give",
                file.light_output_ratio_percent
            ),
            "correct it, or mark absolute photometry by a negative number of lamps",
        ));
    }
    found
}
