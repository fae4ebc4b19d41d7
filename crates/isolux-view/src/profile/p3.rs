//! Display P3 as an ICC file.

use moxcms::{
    ColorDateTime, ColorProfile, LocalizableString, Matrix3d, ProfileText, ToneReprCurve, Xyzd,
};

/// The file that pictures in Display P3 carry, the same bytes always. Empty where it cannot be written, which a test excludes.
pub(super) fn file() -> Vec<u8> {
    let primary = |[x, y, z]: [i32; 3]| Xyzd { x: fixed(x), y: fixed(y), z: fixed(z) };
    let curve = || {
        let [a, b, c] = [1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92];
        Some(ToneReprCurve::Parametric(vec![2.4, a, b, c, 0.040_45]))
    };
    let text = |text: &str| {
        let string = LocalizableString::new("en".into(), "US".into(), text.into());
        Some(ProfileText::Localizable(vec![string]))
    };
    let mut profile = ColorProfile::new_display_p3();
    profile.red_colorant = primary(RED);
    profile.green_colorant = primary(GREEN);
    profile.blue_colorant = primary(BLUE);
    profile.white_point = primary(WHITE);
    profile.media_white_point = Some(primary(WHITE));
    profile.chromatic_adaptation = Some(Matrix3d { v: ADAPTATION.map(|row| row.map(fixed)) });
    (profile.red_trc, profile.green_trc, profile.blue_trc) = (curve(), curve(), curve());
    profile.cicp = None;
    profile.description = text("Display P3");
    profile.copyright = text("CC0");
    profile.creation_date_time = DATE;
    profile.encode().unwrap_or_default()
}

fn fixed(parts: i32) -> f64 {
    f64::from(parts) / 65536.0
}

// In parts of 65536, as the file has them: worked out from the primaries of Display P3 and D65, adapted to D50 by Bradford.
const RED: [i32; 3] = [33759, 15807, -69];
const GREEN: [i32; 3] = [19135, 45367, 2745];
const BLUE: [i32; 3] = [10296, 4363, 51385];
const WHITE: [i32; 3] = [63190, 65536, 54061];
const ADAPTATION: [[i32; 3]; 3] = [[68674, 1502, -3291], [1939, 64912, -1119], [-606, 988, 49262]];

/// A date that does not depend on the clock.
const DATE: ColorDateTime =
    ColorDateTime { year: 2026, month: 1, day_of_the_month: 1, hours: 0, minutes: 0, seconds: 0 };
