//! What a display makes of its codes.

mod channels;
mod curve;
mod device;
mod error;
mod grid;
mod icc;
mod p3;
mod pcs;
mod pipeline;
mod tables;

pub use error::{MAX_ICC_BYTES, ProfileError};

use crate::colorimetry::D65_XYZ;
use channels::Channels;
use device::Device;
use isolux::units::Rgb;
use std::sync::Arc;

/// A display as its profile describes it: from colours to codes and back.
///
/// Colours are relative colorimetric (ICC.1:2022, section 6.2.2): the white of the display stands for the white of Rec. 709,
/// D65, and what it would show beyond its gamut is clipped, channel by channel. A profile with tables has its makers' idea of
/// what to show there instead.
#[derive(Clone, Debug, PartialEq)]
pub struct MonitorProfile {
    name: String,
    device: Device,
    icc: Option<Arc<[u8]>>,
}

impl MonitorProfile {
    /// sRGB (IEC 61966-2-1).
    pub fn srgb() -> Self {
        let device = Device::Channels(Channels::srgb());
        Self { name: "sRGB".to_owned(), device, icc: None }
    }

    /// Display P3: the primaries of SMPTE EG 432-1 with D65 and the transfer function of sRGB.
    pub fn display_p3() -> Self {
        let device = Device::Channels(Channels::display_p3());
        Self { name: "Display P3".to_owned(), device, icc: Some(p3::file().into()) }
    }

    /// The display that the bytes of an ICC file describe (ICC.1, versions 2 and 4): by curves and primaries, or by tables
    /// from codes to colours and back, which count where both are there. Files of more than [`MAX_ICC_BYTES`] are refused.
    pub fn from_icc(bytes: &[u8]) -> Result<Self, ProfileError> {
        let (name, device) = icc::read(bytes)?;
        Ok(Self { name, device, icc: Some(bytes.into()) })
    }

    /// The name that the profile gives itself, which may be empty.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The ICC file that says what codes mean; `None` for sRGB.
    pub fn icc(&self) -> Option<Arc<[u8]>> {
        self.icc.clone()
    }

    /// The code that shows a display-linear colour (linear Rec. 709, 1 for white) best.
    pub fn code_from_linear(&self, colour: Rgb) -> [u8; 3] {
        self.device.code_from_linear(colour)
    }

    /// The display-linear colour of a code, in linear Rec. 709: outside of 0 to 1 where Rec. 709 does not have it.
    pub fn linear_from_code(&self, code: [u8; 3]) -> Rgb {
        self.device.linear_from_code(code)
    }

    /// CIE 1931 XYZ of a code for eyes adapted to the display: [`MonitorProfile::white_xyz`] for its white.
    pub fn xyz_from_code(&self, code: [u8; 3]) -> [f64; 3] {
        self.device.xyz_from_code(code)
    }

    /// XYZ of white, Y = 1: D65, whatever the white of the display itself is.
    pub fn white_xyz(&self) -> [f64; 3] {
        D65_XYZ
    }
}
