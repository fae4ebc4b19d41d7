//! The table of unified glare ratings of a file.

use crate::quantity::significant;
use isolux::geometry::Direction;
use isolux::photometry::{
    NoUgrTable, PhotometricWeb, UGR_REFLECTANCES, UGR_ROOMS, UgrLayout, UgrRoom, UgrTable,
};
use isolux_formats::photometric_file::PhotometricFile;
use serde::Serialize;

/// Below this a rating is that of no glare (CIE 117:1995).
const NO_GLARE: f64 = 10.0;
/// Smaller sources are too small for the rating (CIE 147:2002), m2.
const SMALLEST_M2: f64 = 0.005;
/// Larger ones are too large (CIE 117:1995), sr.
const LARGEST_SR: f64 = 0.1;
/// Views from opposite sides are told apart from the last digit of the table on.
const TOLD_ASYMMETRY: f64 = 0.1;
/// Less light that goes up changes no digit of the table.
const TOLD_UPWARD: f64 = 0.01;

/// A table, or why there is none.
#[derive(Serialize)]
pub(super) struct Ratings {
    /// Why there is no table; `null` with one.
    refused: Option<String>,
    /// Distance of luminaires over their height above the eye.
    spacing_to_height: f64,
    /// Where whoever looks crosswise looks along.
    crosswise_plane: &'static str,
    /// Of the lamps; of the luminaire in absolute photometry. The table is of this flux.
    flux_lm: f64,
    flux_is_of: &'static str,
    /// What the table of 1000 lm is lower by: `8 lg (F / 1000)`.
    flux_correction: f64,
    /// Ceiling, walls, plane of the eye: the columns.
    reflectances: [[f64; 3]; 5],
    rooms: Vec<Row>,
    /// What to know of the table.
    remarks: Vec<String>,
}

/// Ratings of a room; `null` where no luminaire is in view.
#[derive(Serialize)]
struct Row {
    /// Size across and along the line of sight, in heights of the luminaires above the eye.
    room: [u32; 2],
    crosswise: [Option<f64>; 5],
    endwise: [Option<f64>; 5],
}

impl Ratings {
    pub(super) fn of(file: &PhotometricFile, web: &PhotometricWeb, spacing: f64) -> Self {
        let layout =
            UgrLayout { spacing_to_height: spacing, crosswise_is_c0: crosswise_is_c0(file) };
        let lamps = file.lamp_flux_lm().filter(|lm| *lm > 0.0);
        let flux_lm = lamps.unwrap_or_else(|| web.luminous_flux_lm());
        let mut ratings = Self {
            refused: None,
            spacing_to_height: spacing,
            crosswise_plane: if layout.crosswise_is_c0 { "C0-C180" } else { "C90-C270" },
            flux_lm,
            flux_is_of: if lamps.is_some() { "lamps" } else { "luminaire" },
            flux_correction: UgrTable::flux_correction(flux_lm),
            reflectances: UGR_REFLECTANCES.map(|of| [of.ceiling, of.walls, of.floor]),
            rooms: Vec::new(),
            remarks: Vec::new(),
        };
        let opening = match file {
            PhotometricFile::Ies(file) => file.opening,
            PhotometricFile::Ldt(file) => file.opening(),
        };
        let Some(area) = opening.area() else {
            ratings.refused =
                Some("it has no luminous area; write the size of the opening into the file".into());
            return ratings;
        };
        match UgrTable::of(web, |along| area.seen_m2(along), layout) {
            Ok(table) => {
                ratings.remarks = remarks(file, web, area.seen_m2(-Direction::Z), &table);
                ratings.rooms = rows(&table);
            }
            Err(why) => ratings.refused = Some(refusal(why)),
        }
        ratings
    }

    /// The table as data sheets have it.
    pub(super) fn text(&self) -> String {
        if let Some(why) = &self.refused {
            return crate::console::wrapped(&format!("no UGR table: {why}"));
        }
        let mut text = format!(
            "UGR by CIE 190:2010, tabular method, S/H {}, for {} lm of the {}\n\
             (8 lg (F / 1000) = {:.1} is in it); crosswise is along {}\n\n",
            self.spacing_to_height,
            significant(self.flux_lm, 4),
            self.flux_is_of,
            self.flux_correction,
            self.crosswise_plane
        );
        for (name, k) in [("ceiling", 0), ("walls", 1), ("plane of the eye", 2)] {
            let both = self.reflectances.iter().chain(&self.reflectances);
            text += &line(name, both.map(|of| format!("{:.1}", of[k])));
        }
        text += &format!("{:<18}{:<31}{}\n", "room, X by Y", "crosswise", "endwise");
        for row in &self.rooms {
            let [across, along] = row.room.map(|side| format!("{side}H"));
            let values = row.crosswise.iter().chain(&row.endwise).map(|ugr| written(*ugr));
            text += &line(&format!("{across:<4}{along}"), values);
        }
        for remark in &self.remarks {
            text += &crate::console::wrapped(&format!("note: {remark}"));
        }
        text
    }
}

/// A name and ten values.
fn line(name: &str, values: impl Iterator<Item = String>) -> String {
    let mut text = format!("{name:<16}");
    for (k, value) in values.enumerate() {
        text += if k == 5 { "  " } else { "" };
        text += &format!("{value:>6}");
    }
    text + "\n"
}

fn written(ugr: Option<f64>) -> String {
    match ugr {
        None => "-".into(),
        Some(ugr) if ugr < NO_GLARE => "<10".into(),
        Some(ugr) => format!("{ugr:.1}"),
    }
}

/// EULUMDAT has C0 across the lamps. LM-63 has it along them, which are as long as the opening is.
fn crosswise_is_c0(file: &PhotometricFile) -> bool {
    match file {
        PhotometricFile::Ldt(_) => true,
        PhotometricFile::Ies(file) => file.opening.width_m > file.opening.length_m,
    }
}

fn rows(table: &UgrTable) -> Vec<Row> {
    let row = |(k, room): (usize, &UgrRoom)| Row {
        room: [room.across, room.along],
        crosswise: table.crosswise[k],
        endwise: table.endwise[k],
    };
    UGR_ROOMS.iter().enumerate().map(row).collect()
}

fn refusal(why: NoUgrTable) -> String {
    match why {
        NoUgrTable::Floodlight => {
            "types A and B are floodlights, which the method does not know; give a file of type C"
                .into()
        }
        NoUgrTable::Dark => "it sends no light down; rate a room by `isolux glare`".into(),
        NoUgrTable::Asymmetric(by) => {
            let by = if by.is_finite() { format!("by {by:.1}") } else { "as one is dark".into() };
            format!(
                "it is not symmetric, views from opposite sides differ {by}; rate a room by `isolux glare`"
            )
        }
    }
}

/// What the method does not say of a luminaire.
fn remarks(
    file: &PhotometricFile,
    web: &PhotometricWeb,
    area_m2: f64,
    table: &UgrTable,
) -> Vec<String> {
    let mut remarks = Vec::new();
    if area_m2 < SMALLEST_M2 {
        let m2 = significant(area_m2, 2);
        remarks.push(format!(
            "its luminous area is {m2} m2 from below; ratings are made for {SMALLEST_M2} m2 and more"
        ));
    }
    if table.largest_sr > LARGEST_SR {
        let sr = significant(table.largest_sr, 2);
        remarks.push(format!(
            "the largest luminaire in view fills {sr} sr, 2 m above the eye; ratings are made for {LARGEST_SR} sr at most"
        ));
    }
    if table.asymmetry >= TOLD_ASYMMETRY {
        let by = format!("{:.1}", table.asymmetry);
        remarks.push(format!(
            "it is not quite symmetric: views from opposite sides differ by up to {by}, the greater one is given"
        ));
    }
    let upward = 1.0 - web.flux_below_lm(90.0) / web.luminous_flux_lm();
    if upward >= TOLD_UPWARD {
        let percent = significant(100.0 * upward, 2);
        remarks.push(format!(
            "{percent} % of its light goes up, onto a ceiling at its own height: below a higher one ratings are others"
        ));
    }
    if let PhotometricFile::Ldt(file) = file {
        let heights = file.sizes.luminous_heights_m;
        if heights.iter().any(|height| *height != heights[0]) {
            remarks.push(
                "its luminous heights at C0 to C270 differ: the greatest is taken all around"
                    .into(),
            );
        }
    }
    remarks
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux_formats::lint::lint;
    use std::path::Path;

    fn ratings(name: &str) -> Ratings {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/photometry");
        let audit = lint(&folder.join(name));
        let (file, web) = audit.usable.as_ref().unwrap();
        Ratings::of(file, web, 0.25)
    }

    #[test]
    fn what_is_outside_of_the_method_is_said() {
        let point = ratings("photometric-viewer/point_opening.ies");
        assert!(point.refused.unwrap().contains("no luminous area"));
        assert!(point.rooms.is_empty());
        let flood = ratings("photompy/type_b_full.ies");
        assert!(flood.refused.unwrap().contains("luminous area") || flood.rooms.is_empty());
        let washer = ratings("own/wallwasher.ies");
        assert!(washer.refused.unwrap().contains("opposite sides differ"));
        let pendant = ratings("own/pendant.ies");
        assert!(
            pendant.remarks.iter().any(|said| said.contains("goes up")),
            "{:?}",
            pendant.remarks
        );
    }

    #[test]
    fn the_table_fits_a_terminal() {
        let linear = ratings("own/linear_1200.ies");
        assert_eq!(linear.rooms.len(), 19);
        let text = linear.text();
        assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
        assert!(text.contains("crosswise is along C90-C270"), "{text}");
    }
}
