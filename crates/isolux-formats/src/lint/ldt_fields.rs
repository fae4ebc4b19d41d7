//! Fields of EULUMDAT that contradict each other.

use super::finding::Finding;
use crate::ldt::{LdtFile, LdtSymmetry};

/// Direct ratios of real luminaires rise with the room index, but for rounding.
const RATIO_ROUNDING: f64 = 0.01;

pub(super) fn findings(file: &LdtFile) -> Vec<Finding> {
    let mut found = Vec::new();
    found.extend(direct_ratios(file));
    found.extend(first_plane(file));
    found.extend(first_gamma(file));
    found.extend(luminous_area(file));
    let nowhere = file.lamp_sets.first().is_some_and(|set| set.lamps == 0);
    if nowhere {
        let what = "the number of lamps is 0";
        found.push(Finding::note(file.lines.lamps, what, "write 1, or -1 for absolute photometry"));
    }
    found
}

/// They lie between 0 and 1 and grow with the room.
fn direct_ratios(file: &LdtFile) -> Option<Finding> {
    let ratios = &file.direct_ratios;
    let line = file.lines.planes.saturating_sub(ratios.len());
    let remedy = "compute them anew; isolux does not use them";
    if ratios.iter().all(|r| *r == 0.0) {
        return Some(Finding::note(line, "the direct ratios are all 0", remedy));
    }
    let outside = ratios.iter().position(|r| !(0.0..=1.0 + RATIO_ROUNDING).contains(r));
    if let Some(at) = outside {
        let what = format!("the direct ratio {} is not from 0 to 1", ratios[at]);
        return Some(Finding::note(line + at, what, remedy));
    }
    let falls = ratios.windows(2).position(|pair| pair[1] < pair[0] - RATIO_ROUNDING)?;
    let what = format!(
        "the direct ratio falls from {} to {} with a larger room",
        ratios[falls],
        ratios[falls + 1]
    );
    Some(Finding::note(line + falls + 1, what, remedy))
}

fn first_plane(file: &LdtFile) -> Option<Finding> {
    let first = *file.planes_deg.first()?;
    (first != 0.0 && file.symmetry == LdtSymmetry::None).then(|| {
        let what = format!("the planes begin at {first} degrees, not at 0");
        Finding::note(file.lines.planes, what, "begin at 0; some programs take the first as C0")
    })
}

fn first_gamma(file: &LdtFile) -> Option<Finding> {
    let first = *file.gammas_deg.first()?;
    (first != 0.0).then(|| {
        let what = format!("the gamma angles begin at {first} degrees; below is dark");
        Finding::note(file.lines.gammas, what, "begin at 0; some programs take the first as nadir")
    })
}

fn luminous_area(file: &LdtFile) -> Option<Finding> {
    let ([length, width, _], [lit_length, lit_width]) =
        (file.sizes.luminaire_m, file.sizes.luminous_area_m);
    // A tenth of a millimetre is rounding.
    let beyond = |lit: f64, whole: f64| whole > 0.0 && lit > whole + 1e-4;
    (beyond(lit_length, length) || beyond(lit_width, width)).then(|| {
        Finding::note(
            16,
            "the luminous area is larger than the luminaire",
            "correct lines 13 to 17",
        )
    })
}
