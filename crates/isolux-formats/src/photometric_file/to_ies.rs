//! EULUMDAT to LM-63.

use crate::ies::{LuminousOpening, OpeningShape, Photometry, UNDEFINED};
use crate::ldt::{LdtFile, LdtSymmetry};
use isolux::photometry::PhotometricWeb;

/// What to write, and what is lost.
pub(super) fn photometry(file: &LdtFile, web: &PhotometricWeb) -> (Photometry, Vec<String>) {
    let mut losses = Vec::new();
    let (planes_deg, candela) = part_of_circle(file.symmetry, web);
    let lamps = file.lamp_sets.first();
    let rated_lamps = lamps.filter(|set| !set.absolute).map(|set| {
        let count = set.lamps.max(1);
        (count, set.flux_lm / f64::from(count))
    });
    let photometry = Photometry {
        keywords: keywords(file),
        rated_lamps,
        generation_type: UNDEFINED,
        input_watts: lamps.map_or(0.0, |set| set.watts),
        opening_m: opening_m(file, &mut losses),
        planes_deg,
        gammas_deg: web.gammas_deg().to_vec(),
        candela,
        ..Photometry::default()
    };
    what_is_lost(file, &mut losses);
    (photometry, losses)
}

/// The planes that LM-63 wants, and their intensities: up to 90, 180 or 360 degrees from 0 on.
fn part_of_circle(symmetry: LdtSymmetry, web: &PhotometricWeb) -> (Vec<f64>, Vec<f64>) {
    let row = |k: usize| web.candela().chunks(web.gammas_deg().len()).nth(k).unwrap_or_default();
    let last_deg = match symmetry {
        LdtSymmetry::Axial => 0.0,
        LdtSymmetry::AboutBoth => 90.0,
        LdtSymmetry::AboutC0C180 => 180.0,
        LdtSymmetry::AboutC90C270 | LdtSymmetry::None => 360.0,
    };
    let all = web.planes_deg();
    let kept = all.partition_point(|&c| c <= last_deg);
    let mut planes = all[..kept].to_vec();
    let mut candela: Vec<f64> = (0..kept).flat_map(row).copied().collect();
    if last_deg < 360.0 {
        return (planes, candela);
    }
    let (Some(&first), Some(&last)) = (all.first(), all.last()) else { return (planes, candela) };
    if last < 360.0 {
        // The plane at 0 closes the circle; where there is none it lies between the last and the first.
        let share = (360.0 - last) / (first + 360.0 - last);
        let mixed = row(all.len() - 1).iter().zip(row(0)).map(|(a, b)| a + (b - a) * share);
        let closing: Vec<f64> = if first > 0.0 { mixed.collect() } else { row(0).to_vec() };
        if first > 0.0 {
            planes.insert(0, 0.0);
            candela.splice(0..0, closing.iter().copied());
        }
        planes.push(360.0);
        candela.extend(closing);
    } else if first > 0.0 {
        planes.insert(0, 0.0);
        candela.splice(0..0, row(all.len() - 1).iter().copied());
    }
    (planes, candela)
}

fn keywords(file: &LdtFile) -> Vec<(String, String)> {
    let header = &file.header;
    let lamp = file.lamp_sets.first().map(|set| {
        let parts = [&set.kind, &set.colour, &set.colour_rendering];
        parts.into_iter().filter(|p| !p.is_empty()).cloned().collect::<Vec<_>>().join(", ")
    });
    let said = |text: &String| if text.is_empty() { "not stated".into() } else { text.clone() };
    [
        ("TEST", said(&header.report)),
        ("TESTLAB", "not stated".into()),
        ("ISSUEDATE", said(&header.date)),
        ("MANUFAC", said(&header.company)),
        ("LUMCAT", said(&header.number)),
        ("LUMINAIRE", said(&header.luminaire)),
        ("LAMP", said(&lamp.unwrap_or_default())),
        ("FILEGENINFO", "converted from EULUMDAT by isolux".into()),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .to_vec()
}

/// Width along C90-C270, length along C0-C180, height; negative sizes are round.
fn opening_m(file: &LdtFile, losses: &mut Vec<String>) -> [f64; 3] {
    let heights = file.sizes.luminous_heights_m;
    if heights.iter().any(|h| *h != heights[0]) {
        losses.push("the luminous heights at C0 to C270 differ: the greatest is kept".into());
    }
    let LuminousOpening { shape, length_m, width_m, height_m } = file.opening();
    let sign = if shape == Some(OpeningShape::Disc) { -1.0 } else { 1.0 };
    [sign * width_m, sign * length_m, height_m]
}

fn what_is_lost(file: &LdtFile, losses: &mut Vec<String>) {
    let mut lost = |when: bool, what: String| {
        if when {
            losses.push(what);
        }
    };
    let further = file.lamp_sets.len().saturating_sub(1);
    lost(further > 0, format!("{further} further lamp sets: the first is applied"));
    let housing = file.sizes.luminaire_m;
    let [length, width, height] = housing.map(|m| m * 1000.0);
    lost(
        housing.iter().any(|m| *m > 0.0),
        format!("the size of the luminaire, {length} x {width} x {height} mm"),
    );
    lost(file.direct_ratios.iter().any(|r| *r != 0.0), "the direct ratios".into());
    lost(
        file.light_output_ratio_percent + file.downward_flux_percent > 0.0,
        "light output ratio and downward flux as stated: they follow from the table".into(),
    );
    let tilt = file.measured_tilt_deg;
    lost(tilt != 0.0, format!("the tilt in measurement, {tilt} degrees"));
    lost(
        ![0.0, 1.0].contains(&file.conversion_factor),
        format!("the conversion factor {}: it is applied", file.conversion_factor),
    );
    lost(
        file.symmetry == LdtSymmetry::AboutC90C270,
        "the symmetry about C90-C270: all planes are written".into(),
    );
}
