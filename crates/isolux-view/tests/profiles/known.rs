//! Values that are known from elsewhere.

use crate::made;
use isolux::units::Rgb;
use isolux_view::MonitorProfile;

#[track_caller]
fn check(got: [f64; 3], expected: [f64; 3], tolerance: f64) {
    let off = got.into_iter().zip(expected).map(|(g, e)| (g - e).abs()).fold(0.0, f64::max);
    assert!(off <= tolerance, "{got:?} for {expected:?}");
}

#[test]
fn primaries_of_srgb() {
    let srgb = MonitorProfile::srgb();
    // IEC 61966-2-1, to its four digits.
    check(srgb.xyz_from_code([255, 0, 0]), [0.4124, 0.2126, 0.0193], 5e-5);
    check(srgb.xyz_from_code([0, 255, 0]), [0.3576, 0.7152, 0.1192], 5e-5);
    check(srgb.xyz_from_code([0, 0, 255]), [0.1805, 0.0722, 0.9505], 5e-5);
    // Its sums, which are off by three roundings.
    check(srgb.white_xyz(), [0.9505, 1.0, 1.0890], 15e-5);
    assert_eq!(srgb.xyz_from_code([0; 3]), [0.0; 3]);
}

#[test]
fn red_of_display_p3_lies_outside_of_srgb() {
    let red = MonitorProfile::display_p3().linear_from_code([255, 0, 0]);
    check(red.0, [1.2249, -0.0421, -0.0196], 5e-5);
    assert_eq!(MonitorProfile::srgb().code_from_linear(red), [255, 0, 0]);
    // Red of sRGB in Display P3, as CSS Color 4 gives it: 0.9175, 0.2003, 0.1387.
    let inside = MonitorProfile::display_p3().code_from_linear(Rgb::new(1.0, 0.0, 0.0));
    assert_eq!(inside, [234, 51, 35]);
}

#[test]
fn white_is_white_whatever_the_display() {
    for profile in [
        MonitorProfile::srgb(),
        MonitorProfile::display_p3(),
        MonitorProfile::from_icc(&made::with_primaries()).unwrap(),
        MonitorProfile::from_icc(&made::with_tables_of_xyz()).unwrap(),
        MonitorProfile::from_icc(&made::with_curves_in_tables()).unwrap(),
    ] {
        assert_eq!(profile.code_from_linear(Rgb::WHITE), [255; 3], "{}", profile.name());
        // D50 of files has 16 bits after the point, of tables 15.
        check(profile.xyz_from_code([255; 3]), profile.white_xyz(), 3e-4);
    }
}

#[test]
fn the_file_of_display_p3_says_what_it_is() {
    let p3 = MonitorProfile::display_p3();
    let file = p3.icc().unwrap();
    let read = MonitorProfile::from_icc(&file).unwrap();
    assert_eq!(read.name(), "Display P3");
    assert!(made::apart(&read, &p3) < 1e-4, "{}", made::apart(&read, &p3));
    assert_eq!(MonitorProfile::display_p3().icc().unwrap(), file, "bytes depend on something");
    assert_eq!(read.icc().unwrap(), file);
}

#[test]
fn out_of_gamut_is_clipped_by_channel() {
    let p3 = MonitorProfile::display_p3();
    assert_eq!(p3.code_from_linear(Rgb::new(-9.0, f64::NAN, 9.0)), [0, 0, 0]);
    let srgb = MonitorProfile::srgb();
    assert_eq!(srgb.code_from_linear(Rgb::new(-0.2, 0.18, 9.0)), [0, 118, 255]);
}
