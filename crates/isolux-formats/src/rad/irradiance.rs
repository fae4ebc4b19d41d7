//! Irradiance as Radiance's `rtrace -I -h` writes it: a line a point, three numbers in W/m2.

use super::light::luminance_cd_m2;
use isolux::units::Rgb;
use std::fmt::Write;

/// The lines of illuminances, in their order. Of the three numbers of a line 179 (0.265 red + 0.670
/// green + 0.065 blue) is the illuminance in lx, and their ratio is that of the channels of linear
/// Rec. 709: what the reader of `.rad` does, backwards.
pub fn irradiance_lines(illuminances_lx: impl Iterator<Item = Rgb>) -> String {
    let mut text = String::new();
    for illuminance_lx in illuminances_lx {
        let [r, g, b] = irradiance_w_m2(illuminance_lx);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{r:e}\t{g:e}\t{b:e}");
    }
    text
}

fn irradiance_w_m2(illuminance_lx: Rgb) -> [f64; 3] {
    // What Radiance would make of the same numbers in watts says by how much they are too large.
    let read = luminance_cd_m2(illuminance_lx.0).luminance();
    let scale = if read > 0.0 { illuminance_lx.luminance() / read } else { 0.0 };
    illuminance_lx.0.map(|c| c * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radiance_reports_the_same_lux() {
        for rgb in [[179.0; 3], [500.0, 300.0, 20.0], [0.0, 0.0, 7.0]] {
            let watts = irradiance_w_m2(Rgb(rgb));
            let lux = 179.0 * (0.265 * watts[0] + 0.67 * watts[1] + 0.065 * watts[2]);
            // A few roundings.
            assert!((lux / Rgb(rgb).luminance() - 1.0).abs() < 1e-14, "{rgb:?}");
            assert!((watts[0] * rgb[2] - watts[2] * rgb[0]).abs() < 1e-12 * lux);
        }
        let ones = irradiance_w_m2(Rgb::grey(179.0));
        assert!(ones.iter().all(|w| (w - 1.0).abs() < 1e-14), "{ones:?}");
        assert_eq!(irradiance_w_m2(Rgb::BLACK), [0.0; 3]);
    }

    #[test]
    fn a_line_a_point() {
        let lines = irradiance_lines([Rgb::grey(196.9); 2].into_iter());
        let [first, second] = lines.lines().collect::<Vec<_>>()[..] else { panic!("{lines}") };
        assert_eq!(first, second);
        let numbers: Vec<f64> = first.split('\t').map(|n| n.parse().unwrap_or(f64::NAN)).collect();
        assert!(numbers.len() == 3 && numbers.iter().all(|n| (n - 1.1).abs() < 1e-14), "{first}");
    }
}
