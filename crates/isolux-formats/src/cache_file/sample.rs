//! One sample as bytes.
//!
//! Kind (0 near, 1 far) and triangle as `u32`; position, normal, radius and nearest distance as `f64`;
//! replicates, translational and rotational gradient as `f32`, channels of one value together.

use isolux::engine::{CACHE_REPLICATES, CacheSample, SampleKind};
use isolux::geometry::{Point, Vector};
use isolux::units::Rgb;

const COLOURS: usize = CACHE_REPLICATES + 6;

pub(super) const SAMPLE_BYTES: usize = 2 * 4 + 8 * 8 + 3 * COLOURS * 4;

pub(super) fn append(sample: &CacheSample, bytes: &mut Vec<u8>) {
    let kind: u32 = match sample.kind {
        SampleKind::Near => 0,
        SampleKind::Far => 1,
    };
    let (p, n) = (sample.position, sample.normal.to_vector());
    bytes.extend(kind.to_le_bytes());
    bytes.extend(sample.triangle.to_le_bytes());
    for value in [p.x, p.y, p.z, n.x, n.y, n.z, sample.radius_m, sample.nearest_m] {
        bytes.extend(value.to_le_bytes());
    }
    let colours = sample.replicates_lx.iter().chain(&sample.along).chain(&sample.turning);
    for channel in colours.flat_map(|colour| colour.0) {
        bytes.extend((channel as f32).to_le_bytes());
    }
}

/// `None` for bytes that no sample has; whether its numbers are possible in a scene is for
/// [`isolux::engine::IrradianceCache::check`].
pub(super) fn read(bytes: &[u8]) -> Option<CacheSample> {
    let mut rest = bytes;
    let kind = match u32::from_le_bytes(take(&mut rest)?) {
        0 => SampleKind::Near,
        1 => SampleKind::Far,
        _ => return None,
    };
    let triangle = u32::from_le_bytes(take(&mut rest)?);
    let mut number = || Some(f64::from_le_bytes(take(&mut rest)?));
    let position = Point::new(number()?, number()?, number()?);
    let normal = Vector::new(number()?, number()?, number()?).normal()?;
    let (radius_m, nearest_m) = (number()?, number()?);
    let mut colours = [Rgb::BLACK; COLOURS];
    for channel in colours.iter_mut().flat_map(|colour| &mut colour.0) {
        *channel = f64::from(f32::from_le_bytes(take(&mut rest)?));
    }
    let (replicates, gradients) = colours.split_first_chunk()?;
    let (along, turning) = gradients.split_first_chunk()?;
    Some(CacheSample {
        kind,
        position,
        normal,
        triangle,
        radius_m,
        nearest_m,
        replicates_lx: *replicates,
        along: *along,
        turning: *turning.first_chunk()?,
    })
}

fn take<const N: usize>(rest: &mut &[u8]) -> Option<[u8; N]> {
    let (first, after) = rest.split_first_chunk()?;
    *rest = after;
    Some(*first)
}
