//! Pictures of surroundings (`.hdr`, `.exr`) in equidistant cylindrical projection, as light.

mod exr;
mod pixels;
mod radiance;
mod reduce;

use crate::source::read_bytes;
use crate::{Loaded, Problem, Problems};
use isolux::photometry::SkyPicture;
use pixels::Pixels;
use std::path::Path;

/// Largest file, bytes.
const MOST_BYTES: u64 = 512 << 20;
/// Width and height that are kept: a pixel is a third of a degree, less than the sun.
const KEPT: [u32; 2] = [1024, 512];

/// What a file holds.
pub(crate) struct Surroundings {
    /// The picture, in the unit of the file, reduced to what is kept.
    pub(crate) picture: SkyPicture,
    /// Luminance of a value of 1, cd/m2, where the file says so.
    pub(crate) unit_cd_m2: Option<f64>,
}

/// Reads a picture. It is reduced to 1024 by 512 pixels, each with the mean of its solid angle, which keeps all light.
pub(crate) fn read(path: &Path) -> Result<Loaded<Surroundings>, Problems> {
    let bytes = read_bytes(path, MOST_BYTES)?;
    let refused = |what: String| {
        let remedy = "save it again as OpenEXR or Radiance HDR, red, green and blue, all around in equidistant cylindrical \
                      projection";
        Problem::new(path, "", what, remedy)
    };
    let is_exr = bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]);
    let (pixels, unit_cd_m2) =
        if is_exr { exr::decode(&bytes) } else { radiance::decode(&bytes) }.map_err(refused)?;
    let mut warnings = Vec::new();
    if pixels.width != 2 * pixels.height {
        let what = format!(
            "has {} x {} pixels; twice as wide as high is usual, and it is stretched to all directions",
            pixels.width, pixels.height
        );
        warnings.push(Problem::new(path, "", what, "check that it shows everything around"));
    }
    let is_light = |value: &f32| value.is_finite() && *value >= 0.0;
    let odd = pixels.rgb.iter().filter(|rgb| !rgb.iter().all(is_light)).count();
    if odd > 0 {
        let what = format!("{odd} pixels are below zero or no number, and count as black");
        warnings.push(Problem::new(path, "", what, "nothing needs to be done if they are few"));
    }
    let Pixels { width, height, mut rgb } = pixels;
    for value in rgb.iter_mut().flatten().filter(|value| !is_light(value)) {
        *value = 0.0;
    }
    let picture = reduce::reduced(SkyPicture { width, height, rgb_cd_m2: rgb }, KEPT);
    Ok(Loaded { value: Surroundings { picture, unit_cd_m2 }, warnings })
}
