//! From codes to colours and back.

use crate::made::{self, apart, codes, farthest};
use isolux_view::MonitorProfile;

fn of(bytes: &[u8]) -> MonitorProfile {
    MonitorProfile::from_icc(bytes).unwrap()
}

#[test]
fn codes_come_back() {
    for (name, profile, off) in [
        ("sRGB", MonitorProfile::srgb(), 0),
        ("Display P3", MonitorProfile::display_p3(), 0),
        ("primaries", of(&made::with_primaries()), 0),
        ("gammas", of(&made::with_gammas([1.8, 2.2, 2.5])), 0),
        ("tables of XYZ", of(&made::with_tables_of_xyz()), 0),
        ("curves in tables", of(&made::with_curves_in_tables()), 0),
    ] {
        assert!(farthest(&profile) <= off, "{name}: {}", farthest(&profile));
    }
}

#[test]
fn colours_come_back_through_grids_that_curve_between_corners() {
    let profile = of(&made::with_tables_of_lab(33));
    let off = |code: [u8; 3]| {
        let colour = profile.linear_from_code(code);
        let back = profile.linear_from_code(profile.code_from_linear(colour));
        back.0.into_iter().zip(colour.0).map(|(b, c)| (b - c).abs()).fold(0.0, f64::max)
    };
    // Measured over these colours: 0.026, beside the most saturated green. Greys lie on corners.
    let worst = codes().map(off).fold(0.0, f64::max);
    assert!(worst < 0.04, "{worst}");
    assert!((0..=255).all(|grey| off([grey; 3]) == 0.0));
}

#[test]
fn files_say_what_srgb_is() {
    let srgb = MonitorProfile::srgb();
    for (name, bytes, off) in [
        // The primaries of this file have four digits.
        ("primaries", made::with_primaries(), 1e-3),
        ("tables of XYZ", made::with_tables_of_xyz(), 1e-3),
        ("curves in tables", made::with_curves_in_tables(), 1e-3),
        ("tables of Lab", made::with_tables_of_lab(33), 1e-3),
    ] {
        let found = apart(&of(&bytes), &srgb);
        assert!(found < off, "{name}: {found}");
    }
}

#[test]
fn xyz_and_rec709_say_the_same() {
    for profile in [MonitorProfile::display_p3(), of(&made::with_tables_of_xyz())] {
        for code in codes() {
            let y = profile.xyz_from_code(code)[1];
            // Rec. 709 prints its luminance weights to four digits.
            let luminance = profile.linear_from_code(code).luminance();
            assert!((luminance - y).abs() < 1e-4, "{code:?}: {luminance} for {y}");
        }
    }
}
