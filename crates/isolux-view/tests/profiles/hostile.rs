//! Files that are none: an error, no panic, no memory for what is not there.

use crate::made;
use isolux_view::{MAX_ICC_BYTES, MonitorProfile, ProfileError};

fn samples() -> Vec<Vec<u8>> {
    vec![
        made::with_primaries(),
        made::with_gammas([1.8, 2.2, 2.5]),
        made::with_tables_of_xyz(),
        made::with_curves_in_tables(),
        made::with_tables_of_lab(5),
    ]
}

fn put(bytes: &mut [u8], at: usize, value: u32) {
    bytes[at..at + 4].copy_from_slice(&value.to_be_bytes());
}

#[test]
fn cut_files_are_refused() {
    for whole in samples() {
        assert!(MonitorProfile::from_icc(&whole).is_ok());
        for length in (0..whole.len()).step_by(1 + whole.len() / 997) {
            let cut = MonitorProfile::from_icc(&whole[..length]);
            // The signature ends after 40 bytes.
            let is_refused = match cut {
                Err(ProfileError::NoProfile) => length < 40,
                Err(ProfileError::Malformed(_)) => length >= 40,
                _ => false,
            };
            assert!(is_refused, "{length} bytes: {cut:?}");
            // One that does not admit it.
            let mut lies = whole[..length].to_vec();
            if length >= 4 {
                put(&mut lies, 0, length as u32);
                let _ = MonitorProfile::from_icc(&lies);
            }
        }
    }
}

#[test]
fn spoilt_files_make_no_panic() {
    let mut state = 1_u64;
    let mut draw = |below: usize| {
        // Knuth's multiplier; the upper half is random enough.
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as usize % below
    };
    for whole in samples() {
        // Headers and tables of tags stand in the first few hundred bytes, and matter most.
        for run in 0..4000 {
            let mut spoilt = whole.clone();
            for _ in 0..=draw(4) {
                let at = draw(if run % 2 == 0 { 600 } else { whole.len() }.min(whole.len()));
                spoilt[at] = [0, 1, 0x7f, 0x80, 0xff, draw(256) as u8][draw(6)];
            }
            if let Ok(profile) = MonitorProfile::from_icc(&spoilt) {
                for code in [[0; 3], [255; 3], [12, 200, 99]] {
                    let _ = profile.code_from_linear(profile.linear_from_code(code));
                }
            }
        }
    }
}

#[test]
fn huge_files_and_numbers_are_refused() {
    let whole = made::with_tables_of_xyz();
    let mut huge = whole.clone();
    huge.resize(MAX_ICC_BYTES + 1, 0);
    assert_eq!(MonitorProfile::from_icc(&huge), Err(ProfileError::Size { bytes: huge.len() }));
    // The size of the file, the number of tags, and the place of the first tag.
    for (at, value) in
        [(0, u32::MAX), (128, u32::MAX), (128, 201), (136, u32::MAX), (140, u32::MAX)]
    {
        let mut lies = whole.clone();
        put(&mut lies, at, value);
        let refused = MonitorProfile::from_icc(&lies);
        assert!(matches!(refused, Err(ProfileError::Malformed(_))), "{at}: {refused:?}");
    }
}

#[test]
fn what_is_no_display_is_refused() {
    let spoil = |at: usize, text: &[u8; 4]| {
        let mut bytes = made::with_primaries();
        bytes[at..at + 4].copy_from_slice(text);
        MonitorProfile::from_icc(&bytes)
    };
    assert!(matches!(spoil(12, b"prtr"), Err(ProfileError::Kind(_))), "a printer");
    assert!(matches!(spoil(16, b"CMYK"), Err(ProfileError::Kind(_))), "inks");
    assert!(matches!(spoil(36, b"ascp"), Err(ProfileError::NoProfile)), "no profile");
    assert!(matches!(spoil(8, b"\x05\0\0\0"), Err(ProfileError::Malformed(_))), "version 5");
    // The first tag is that of red.
    assert_eq!(spoil(132, b"none"), Err(ProfileError::Incomplete));
}

#[test]
fn displays_that_mix_no_colours_are_refused() {
    let mut flat = moxcms::ColorProfile::new_srgb();
    flat.green_colorant = flat.red_colorant;
    let refused = MonitorProfile::from_icc(&flat.encode().unwrap());
    assert_eq!(refused, Err(ProfileError::Primaries));
    let mut falling = moxcms::ColorProfile::new_srgb();
    falling.blue_trc = Some(moxcms::ToneReprCurve::Lut(vec![65535, 0]));
    let refused = MonitorProfile::from_icc(&falling.encode().unwrap());
    assert_eq!(refused, Err(ProfileError::Curve));
}
