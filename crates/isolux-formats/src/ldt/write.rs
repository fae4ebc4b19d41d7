//! EULUMDAT files written.

use super::{LampSet, LdtFile, LdtSymmetry, LuminaireKind};

/// The text of a file, one value a line; numbers come back to the last bit, but for lengths, which are
/// rounded to a tenth of a millimetre.
pub fn write(file: &LdtFile) -> String {
    let mut lines = Lines::default();
    let header = &file.header;
    lines.text(&header.company);
    lines.number(match file.kind {
        LuminaireKind::PointWithoutSymmetry => 0.0,
        LuminaireKind::PointAxial => 1.0,
        LuminaireKind::Linear => 2.0,
        LuminaireKind::PointOther => 3.0,
    });
    lines.number(match file.symmetry {
        LdtSymmetry::None => 0.0,
        LdtSymmetry::Axial => 1.0,
        LdtSymmetry::AboutC0C180 => 2.0,
        LdtSymmetry::AboutC90C270 => 3.0,
        LdtSymmetry::AboutBoth => 4.0,
    });
    lines.numbers(&[file.planes_deg.len() as f64, file.plane_step_deg]);
    lines.numbers(&[file.gammas_deg.len() as f64, file.gamma_step_deg]);
    let names = [&header.report, &header.luminaire, &header.number, &header.file_name];
    names.iter().for_each(|name| lines.text(name));
    lines.text(&header.date);
    lines.millimetres(&file.sizes.luminaire_m);
    lines.millimetres(&file.sizes.luminous_area_m);
    lines.millimetres(&file.sizes.luminous_heights_m);
    lines.numbers(&[file.downward_flux_percent, file.light_output_ratio_percent]);
    lines.numbers(&[file.conversion_factor, file.measured_tilt_deg]);
    lines.number(file.lamp_sets.len() as f64);
    file.lamp_sets.iter().for_each(|set| lines.lamps(set));
    lines.numbers(&file.direct_ratios);
    lines.numbers(&file.planes_deg);
    lines.numbers(&file.gammas_deg);
    lines.numbers(&file.candela_per_klm);
    lines.0
}

/// Lines that end in CR LF, as the format grew up with.
#[derive(Default)]
struct Lines(String);

impl Lines {
    fn text(&mut self, text: &str) {
        self.0.push_str(&text.replace(['\r', '\n'], " "));
        self.0.push_str("\r\n");
    }

    fn number(&mut self, number: f64) {
        self.text(&number.to_string());
    }

    fn numbers(&mut self, numbers: &[f64]) {
        numbers.iter().for_each(|&number| self.number(number));
    }

    fn millimetres(&mut self, metres: &[f64]) {
        metres.iter().for_each(|m| self.number((m * 1e4).round() / 10.0));
    }

    fn lamps(&mut self, set: &LampSet) {
        let lamps = f64::from(set.lamps);
        self.number(if set.absolute { -lamps } else { lamps });
        self.text(&set.kind);
        self.number(set.flux_lm);
        self.text(&set.colour);
        self.text(&set.colour_rendering);
        self.number(set.watts);
    }
}
