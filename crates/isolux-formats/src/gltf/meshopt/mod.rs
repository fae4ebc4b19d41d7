//! EXT_meshopt_compression and KHR_meshopt_compression: views whose bytes are packed.
//!
//! The format is that of appendices A and B of KHR_meshopt_compression (Kapoulkine, Khronos registry), of
//! which EXT_meshopt_compression is the part with version 0 of the attributes. Nothing is
//! allocated that the packed bytes do not bear out.

mod attributes;
mod damage;
mod filters;
mod reader;
mod triangles;

use super::notes::Flaw;
use damage::Damage;
use serde::Deserialize;
use serde_json::{Map, Value};

/// Names of the extension, the newer first.
pub(crate) const NAMES: [&str; 2] = ["KHR_meshopt_compression", "EXT_meshopt_compression"];

/// Where the packed bytes of a view are, and how they are packed.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "camelCase")]
pub(super) struct Packed {
    pub(super) buffer: usize,
    #[serde(default)]
    pub(super) byte_offset: u64,
    pub(super) byte_length: u64,
    byte_stride: u64,
    count: u64,
    mode: Mode,
    #[serde(default)]
    filter: Filter,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "UPPERCASE")]
enum Mode {
    Attributes,
    Triangles,
    Indices,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq)]
#[serde(rename_all = "UPPERCASE")]
enum Filter {
    #[default]
    None,
    Octahedral,
    Quaternion,
    Exponential,
    Color,
}

impl Packed {
    /// The extension of a buffer view, if it has it.
    pub(super) fn read(extensions: &Map<String, Value>) -> Option<Result<Self, Flaw>> {
        let (name, value) = NAMES.iter().find_map(|name| Some((name, extensions.get(*name)?)))?;
        let packed = Self::deserialize(value)
            .map_err(|error| Flaw::new(error.to_string(), "export the file again"))
            .and_then(Self::checked);
        Some(packed.map_err(|flaw| flaw.at(format!("extensions.{name}"))))
    }

    /// The rules of the extension for strides and counts.
    fn checked(self) -> Result<Self, Flaw> {
        let stride = self.byte_stride;
        let fits = match self.mode {
            Mode::Attributes => stride.is_multiple_of(4) && (4..=256).contains(&stride),
            Mode::Triangles => (stride == 2 || stride == 4) && self.count.is_multiple_of(3),
            Mode::Indices => stride == 2 || stride == 4,
        };
        let suits = match self.filter {
            Filter::None => true,
            _ if self.mode != Mode::Attributes => false,
            Filter::Octahedral | Filter::Color => stride == 4 || stride == 8,
            Filter::Quaternion => stride == 8,
            Filter::Exponential => true,
        };
        if fits && suits {
            return Ok(self);
        }
        let what = format!(
            "{} elements of {stride} bytes do not suit the mode {:?} with the filter {:?}",
            self.count, self.mode, self.filter
        );
        Err(Flaw::new(what, "export the file again"))
    }

    /// Bytes it unpacks to.
    pub(super) fn unpacked_bytes(&self) -> Option<u64> {
        self.count.checked_mul(self.byte_stride)
    }

    /// Unpacks the bytes of which the record tells.
    pub(super) fn unpack(&self, data: &[u8]) -> Result<Vec<u8>, Flaw> {
        let remedy = "the file is damaged; export it again";
        self.decode(data).map_err(|damage| Flaw::new(damage.what(), remedy))
    }

    fn decode(&self, data: &[u8]) -> Result<Vec<u8>, Damage> {
        let count = usize::try_from(self.count).map_err(|_| Damage::CutShort)?;
        let stride = self.byte_stride as usize;
        Ok(match self.mode {
            Mode::Attributes => {
                let mut bytes = attributes::decode(data, count, stride)?;
                self.apply_filter(&mut bytes);
                bytes
            }
            Mode::Triangles => to_bytes(&triangles::decode(data, count)?, stride),
            Mode::Indices => to_bytes(&triangles::decode_sequence(data, count)?, stride),
        })
    }

    fn apply_filter(&self, bytes: &mut [u8]) {
        let stride = self.byte_stride as usize;
        match self.filter {
            Filter::None => {}
            Filter::Octahedral => filters::octahedral(bytes, stride),
            Filter::Quaternion => filters::quaternion(bytes),
            Filter::Exponential => filters::exponential(bytes),
            Filter::Color => filters::colour(bytes, stride),
        }
    }
}

/// Indices of 2 or 4 bytes; higher bits are dropped.
fn to_bytes(indices: &[u32], stride: usize) -> Vec<u8> {
    indices.iter().flat_map(|index| index.to_le_bytes().into_iter().take(stride)).collect()
}
