//! ICC files.

use super::channels::Channels;
use super::curve::Curve;
use super::device::Device;
use super::error::{MAX_ICC_BYTES, ProfileError};
use super::tables::Tables;
use moxcms::{ColorProfile, DataColorSpace, ParsingOptions, ProfileClass, ProfileText, Xyzd};

/// Tags at most, where profiles have some twenty: each may point to the same large table.
const MAX_TAGS: u32 = 200;
/// Where the number of tags stands.
const TAG_COUNT_AT: usize = 128;

/// What every profile has there (ICC.1:2022, 7.2.9).
const SIGNATURE: &[u8] = b"acsp";
const SIGNATURE_AT: usize = 36;

/// The name and the display that a file describes.
pub(super) fn read(bytes: &[u8]) -> Result<(String, Device), ProfileError> {
    let profile = parse(bytes)?;
    check_kind(&profile)?;
    let device = match tables(&profile)? {
        Some(tables) => Device::Tables(tables),
        None => Device::Channels(channels(&profile)?),
    };
    Ok((name(&profile), device))
}

fn parse(bytes: &[u8]) -> Result<ColorProfile, ProfileError> {
    if bytes.len() > MAX_ICC_BYTES {
        return Err(ProfileError::Size { bytes: bytes.len() });
    }
    if !bytes.get(SIGNATURE_AT..).is_some_and(|rest| rest.starts_with(SIGNATURE)) {
        return Err(ProfileError::NoProfile);
    }
    let malformed = |why: &str| ProfileError::Malformed(why.to_owned());
    let (size, tags) = word(bytes, 0)
        .zip(word(bytes, TAG_COUNT_AT))
        .ok_or_else(|| malformed("it ends within its header"))?;
    if bytes.len() < size as usize {
        return Err(ProfileError::Malformed(format!(
            "{} of its {size} bytes are there",
            bytes.len()
        )));
    }
    if tags > MAX_TAGS {
        return Err(ProfileError::Malformed(format!("{tags} tags")));
    }
    let options =
        ParsingOptions { max_profile_size: MAX_ICC_BYTES + 1, ..ParsingOptions::default() };
    ColorProfile::new_from_slice_with_options(bytes, options)
        .map_err(|problem| malformed(&problem.to_string()))
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..at + 4)?.try_into().ok().map(u32::from_be_bytes)
}

fn check_kind(profile: &ColorProfile) -> Result<(), ProfileError> {
    use ProfileClass::{ColorSpace, DisplayDevice};
    if !matches!(profile.profile_class, DisplayDevice | ColorSpace) {
        return Err(ProfileError::Kind(format!("class {:?}", profile.profile_class)));
    }
    if profile.color_space != DataColorSpace::Rgb {
        return Err(ProfileError::Kind(format!("colours in {:?}", profile.color_space)));
    }
    Ok(())
}

/// Tables both ways: colorimetric, or else those that stand for all intents (ICC.1:2022, section 8.10.2).
fn tables(profile: &ColorProfile) -> Result<Option<Tables>, ProfileError> {
    let to_pcs = [&profile.lut_a_to_b_colorimetric, &profile.lut_a_to_b_perceptual];
    let from_pcs = [&profile.lut_b_to_a_colorimetric, &profile.lut_b_to_a_perceptual];
    let first =
        |[colorimetric, any]: [_; 2]| Option::or(Option::as_ref(colorimetric), any.as_ref());
    match first(to_pcs).zip(first(from_pcs)) {
        Some((to_pcs, from_pcs)) => Tables::new(profile.pcs, to_pcs, from_pcs).map(Some),
        None => Ok(None),
    }
}

fn channels(profile: &ColorProfile) -> Result<Channels, ProfileError> {
    let curves = [&profile.red_trc, &profile.green_trc, &profile.blue_trc];
    let [Some(red), Some(green), Some(blue)] = curves else { return Err(ProfileError::Incomplete) };
    let primaries = [profile.red_colorant, profile.green_colorant, profile.blue_colorant];
    if profile.pcs != DataColorSpace::Xyz || primaries.iter().any(|p| *p == Xyzd::default()) {
        return Err(ProfileError::Incomplete);
    }
    let curves = [Curve::of(red)?, Curve::of(green)?, Curve::of(blue)?];
    Channels::new(primaries.map(|p| [p.x, p.y, p.z]), &curves)
}

fn name(profile: &ColorProfile) -> String {
    match &profile.description {
        Some(ProfileText::PlainString(text)) => text.clone(),
        Some(ProfileText::Localizable(texts)) => {
            texts.first().map(|text| text.value.clone()).unwrap_or_default()
        }
        Some(ProfileText::Description(text)) => text.ascii_string.clone(),
        None => String::new(),
    }
}
