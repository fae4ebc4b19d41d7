//! The two ways in which profiles describe displays.

use super::channels::Channels;
use super::tables::Tables;
use crate::colorimetry::{REC709_FROM_XYZ, XYZ_FROM_REC709};
use isolux::units::Rgb;

/// From colours to codes and back; colours are linear Rec. 709, or XYZ under D65.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Device {
    Channels(Channels),
    Tables(Tables),
}

impl Device {
    pub(super) fn code_from_linear(&self, colour: Rgb) -> [u8; 3] {
        match self {
            Self::Channels(channels) => channels.code_from_linear(colour),
            Self::Tables(tables) => tables.code_from_xyz(XYZ_FROM_REC709.apply(colour.0)),
        }
    }

    pub(super) fn linear_from_code(&self, code: [u8; 3]) -> Rgb {
        match self {
            Self::Channels(channels) => channels.linear_from_code(code),
            Self::Tables(tables) => Rgb(REC709_FROM_XYZ.apply(tables.xyz_from_code(code))),
        }
    }

    pub(super) fn xyz_from_code(&self, code: [u8; 3]) -> [f64; 3] {
        match self {
            Self::Channels(channels) => XYZ_FROM_REC709.apply(channels.linear_from_code(code).0),
            Self::Tables(tables) => tables.xyz_from_code(code),
        }
    }
}
