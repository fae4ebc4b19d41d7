//! Fields of EULUMDAT that contradict each other.

use super::finding::Finding;
use crate::ldt::{LdtFile, LdtSymmetry};
use crate::photometric_file::{ROOM_INDICES, direct_ratios};
use isolux::photometry::PhotometricWeb;

/// Direct ratios of real luminaires rise with the room index, but for rounding.
const RATIO_ROUNDING: f64 = 0.01;
/// Ratios of luminaires in few rows differ from those of an evenly filled ceiling by less: 0.22 were found, of a downlight in a
/// room of index 1.
const ARRANGEMENT: f64 = 0.25;

pub(super) fn findings(file: &LdtFile, web: &PhotometricWeb) -> Vec<Finding> {
    let mut found = Vec::new();
    found.extend(stated_ratios(file, direct_ratios(web)));
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

/// They lie between 0 and 1, grow with the room, and are those of the table.
fn stated_ratios(file: &LdtFile, computed: Option<[f64; 10]>) -> Option<Finding> {
    let ratios = &file.direct_ratios;
    let line = file.lines.planes.saturating_sub(ratios.len());
    let list = computed.map(|computed| computed.map(|ratio| format!("{ratio:.3}")).join(" "));
    let remedy = match list {
        Some(list) => {
            format!("of an evenly filled ceiling they are {list}; isolux does not use them")
        }
        None => "compute them anew; isolux does not use them".to_owned(),
    };
    if ratios.iter().all(|r| *r == 0.0) {
        return Some(Finding::note(line, "the direct ratios are all 0", remedy));
    }
    let outside = ratios.iter().position(|r| !(0.0..=1.0 + RATIO_ROUNDING).contains(r));
    if let Some(at) = outside {
        let what = format!("the direct ratio {} is not from 0 to 1", ratios[at]);
        return Some(Finding::note(line + at, what, remedy));
    }
    if let Some(falls) = ratios.windows(2).position(|pair| pair[1] < pair[0] - RATIO_ROUNDING) {
        let [before, after] = [ratios[falls], ratios[falls + 1]];
        let what = format!("the direct ratio falls from {before} to {after} with a larger room");
        return Some(Finding::note(line + falls + 1, what, remedy));
    }
    let computed = computed?;
    let apart = |at: usize| (ratios[at] - computed[at]).abs();
    let worst = (0..ratios.len()).max_by(|a, b| apart(*a).total_cmp(&apart(*b)))?;
    (apart(worst) > ARRANGEMENT).then(|| {
        let k = ROOM_INDICES[worst];
        let (stated, due) = (ratios[worst], computed[worst]);
        let what = format!(
            "the direct ratio {stated} of room index {k} is not that of the table: {due:.3}"
        );
        Finding::warning(line + worst, what, remedy)
    })
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
