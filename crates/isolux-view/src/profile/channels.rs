//! Displays of three channels that add up.

use super::curve::{CodeCurve, Curve};
use super::error::ProfileError;
use crate::colorimetry::{D65_XYZ, REC709_FROM_XYZ, adaptation};
use crate::matrix::Matrix3;
use isolux::units::Rgb;

/// Primaries that mix, each with a tone curve.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Channels {
    device_from_rec709: Matrix3,
    rec709_from_device: Matrix3,
    curves: [CodeCurve; 3],
}

/// From linear Rec. 709 to linear Display P3: primaries (0.680, 0.320), (0.265, 0.690), (0.150, 0.060) and D65.
const P3_FROM_REC709: Matrix3 = Matrix3([
    [0.822_461_968_714_362_3, 0.177_538_031_285_637_7, 0.0],
    [0.033_194_198_850_961_62, 0.966_805_801_149_038_4, 0.0],
    [0.017_082_630_721_120_03, 0.072_397_440_663_963_47, 0.910_519_928_614_916_5],
]);

/// From linear Display P3 to linear Rec. 709.
const REC709_FROM_P3: Matrix3 = Matrix3([
    [1.224_940_176_280_56, -0.224_940_176_280_56, 0.0],
    [-0.042_056_954_709_688_16, 1.042_056_954_709_688, 0.0],
    [-0.019_637_554_590_334_43, -0.078_636_045_550_631_89, 1.098_273_600_140_966],
]);

impl Channels {
    pub(super) fn srgb() -> Self {
        Self::with_srgb_curves(Matrix3::IDENTITY, Matrix3::IDENTITY)
    }

    pub(super) fn display_p3() -> Self {
        Self::with_srgb_curves(P3_FROM_REC709, REC709_FROM_P3)
    }

    fn with_srgb_curves(device_from_rec709: Matrix3, rec709_from_device: Matrix3) -> Self {
        let curve = CodeCurve::srgb();
        Self { device_from_rec709, rec709_from_device, curves: [(); 3].map(|()| curve.clone()) }
    }

    /// Primaries in XYZ under any white, of which they mix that of the display: it is seen as D65.
    pub(super) fn new(
        primaries_xyz: [[f64; 3]; 3],
        curves: &[Curve; 3],
    ) -> Result<Self, ProfileError> {
        let xyz_from_device = Matrix3::of_columns(primaries_xyz);
        let white = xyz_from_device.apply([1.0; 3]);
        let seen = adaptation(white, D65_XYZ).after(&xyz_from_device);
        let rec709_from_device = REC709_FROM_XYZ.after(&seen);
        let device_from_rec709 = rec709_from_device.inverse().ok_or(ProfileError::Primaries)?;
        let [red, green, blue] = curves.each_ref().map(CodeCurve::of);
        Ok(Self { device_from_rec709, rec709_from_device, curves: [red?, green?, blue?] })
    }

    pub(super) fn code_from_linear(&self, colour: Rgb) -> [u8; 3] {
        let device = self.device_from_rec709.apply(colour.0);
        [0, 1, 2].map(|channel| self.curves[channel].code(device[channel]))
    }

    pub(super) fn linear_from_code(&self, code: [u8; 3]) -> Rgb {
        let device = [0, 1, 2].map(|channel| self.curves[channel].value(code[channel]));
        Rgb(self.rec709_from_device.apply(device))
    }
}
