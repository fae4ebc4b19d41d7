//! KTX2 (Khronos, "KTX File Format Specification", version 2.0): one page, uncompressed, four bytes a texel.

use super::error::LightmapFileError;
use super::shared_exponent::{self, LARGEST};
use super::target::Convention;
use isolux::lightmap::Lightmap;
use ktx2::{Format, Header, Index, LevelIndex, dfd};

/// A file, and what its texels have to be multiplied by.
#[derive(Clone, Debug, PartialEq)]
pub struct Ktx2 {
    /// The bytes.
    pub bytes: Vec<u8>,
    /// 1, or the power of two that brings the largest texel into range.
    pub scale: f64,
}

/// One page of a lightmap in shared exponents. The same lightmap gives the same bytes.
pub fn write_ktx2(
    lightmap: &Lightmap,
    page: u32,
    convention: &Convention,
) -> Result<Ktx2, LightmapFileError> {
    let format = Format::E5B9G9R9_UFLOAT_PACK32;
    let (basic, type_size) =
        dfd::Basic::from_format(format).map_err(|e| LightmapFileError::Ktx2(e.to_string()))?;
    let block = dfd::Block::Basic(basic).to_vec();
    let mut descriptor = (block.len() as u32 + 4).to_le_bytes().to_vec();
    descriptor.extend(block);
    let texels = lightmap.page(page);
    let largest = texels.iter().flatten().fold(0.0, |most, &c| f64::max(most, f64::from(c)));
    let scale = scale(largest * convention.from_lux);
    let notes = notes(lightmap, convention, scale);
    let descriptor_at = Header::LENGTH + LevelIndex::LENGTH;
    let notes_at = descriptor_at + descriptor.len();
    // Texels of four bytes begin at a multiple of four; so do the descriptor and the notes.
    let texels_at = (notes_at + notes.len()).next_multiple_of(4);
    let length = 4 * texels.len();
    let header = Header {
        format: Some(format),
        type_size,
        pixel_width: lightmap.layout.width,
        pixel_height: lightmap.layout.height,
        pixel_depth: 0,
        layer_count: 0,
        face_count: 1,
        level_count: 1,
        supercompression_scheme: None,
        index: Index {
            dfd_byte_offset: descriptor_at as u32,
            dfd_byte_length: descriptor.len() as u32,
            kvd_byte_offset: notes_at as u32,
            kvd_byte_length: notes.len() as u32,
            sgd_byte_offset: 0,
            sgd_byte_length: 0,
        },
    };
    let level = LevelIndex {
        byte_offset: texels_at as u64,
        byte_length: length as u64,
        uncompressed_byte_length: length as u64,
    };
    let mut bytes = Vec::with_capacity(texels_at + length);
    bytes.extend(header.as_bytes());
    bytes.extend(level.as_bytes());
    bytes.extend(descriptor);
    bytes.extend(notes);
    bytes.resize(texels_at, 0);
    let factor = convention.from_lux / scale;
    for rgb in texels {
        let texel = rgb.map(|c| f64::from(c) * factor);
        bytes.extend(shared_exponent::encode(texel).to_le_bytes());
    }
    Ok(Ktx2 { bytes, scale })
}

fn scale(largest: f64) -> f64 {
    let mut scale = 1.0;
    while largest / scale > LARGEST {
        scale *= 2.0;
    }
    scale
}

/// Keys and values, in the order of the keys: each with its length, ended by zero bytes.
fn notes(lightmap: &Lightmap, convention: &Convention, scale: f64) -> Vec<u8> {
    let Convention { quantity, unit, formula, .. } = convention;
    let pairs = [
        ("KTXorientation", "rd".to_owned()),
        ("KTXwriter", format!("isolux {}", env!("CARGO_PKG_VERSION"))),
        (
            "isolux",
            format!(
                "{quantity}, {unit}, times {scale}; {formula}; {} texels a metre",
                lightmap.layout.texels_per_m
            ),
        ),
    ];
    let mut bytes = Vec::new();
    for (key, value) in pairs {
        let length = key.len() + value.len() + 2;
        bytes.extend((length as u32).to_le_bytes());
        bytes.extend(key.bytes().chain([0]).chain(value.bytes()).chain([0]));
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    bytes
}
