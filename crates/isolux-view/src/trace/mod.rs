//! Views by ray casting over an illumination map.

mod dielectric;
mod lamps;
mod lobes;
mod look;
mod pixel;
mod settings;

pub use settings::{SurfacePoint, TraceSettings, Window};

use crate::camera::{View, ViewRays};
use crate::error::ViewError;
use crate::image::{LuminanceImage, Middle, Reading, Size};
use isolux::engine::Highlights;
use isolux::map::Illuminance;
use isolux::scene::Scene;
use lamps::Lamps;
use look::{Look, Looker};
use pixel::Pixels;
use rayon::prelude::*;

/// Rows of pixels that are glimpsed before they are looked at.
const BAND_ROWS: usize = 32;

/// The illuminance of a place of a surface, `None` where it is not known.
pub type Read<'a> = dyn Fn(SurfacePoint) -> Option<Illuminance> + Sync + 'a;

/// Looks at a scene. `read` gives the illuminance of a place of a surface, `None` where it is not
/// known: the bare map, or direct light evaluated afresh with the indirect part interpolated.
///
/// Diffuse surfaces show L = Le + rho E / pi. Mirrors and smooth glass are followed; gloss is
/// averaged over a few GGX facets and looks at luminaires: those without surface show only on rough surfaces, and where they are
/// many not at all. Luminous areas are seen with their luminance. The same arguments give the same bits on any number of threads.
pub fn trace(
    scene: &Scene,
    view: impl Into<View>,
    size: Size,
    settings: &TraceSettings,
    read: &Read<'_>,
) -> Result<LuminanceImage, ViewError> {
    trace_watched(scene, view, size, settings, (read, &mut |_| {}))
}

/// The same; `watch` is told the share of the rows that are done.
pub fn trace_watched(
    scene: &Scene,
    view: impl Into<View>,
    size: Size,
    settings: &TraceSettings,
    (read, watch): (&Read<'_>, &mut dyn FnMut(f64)),
) -> Result<LuminanceImage, ViewError> {
    let per_side = settings.samples_per_side.max(1);
    size.check_samples(per_side.saturating_mul(per_side))?;
    let highlights = if settings.highlights { Highlights::new(scene) } else { None };
    let lamps = Lamps::of(scene);
    let lamps = lamps.as_ref();
    let looker = Looker { scene, settings, highlights: highlights.as_ref(), lamps, read };
    let (of, before) =
        settings.window.map_or((size, [0; 2]), |within| (within.of, [within.left, within.top]));
    let pixels = Pixels { looker, rays: ViewRays::new(view, of), size, before, per_side };
    let count = (per_side * per_side) as usize;
    let mut samples = vec![Look::NOTHING.seen(); size.pixels() * count];
    let mut middles = vec![None; size.pixels()];
    let band = size.width() as usize * BAND_ROWS;
    let bands = samples.chunks_mut(band * count).zip(middles.chunks_mut(band));
    let band_count = size.pixels().div_ceil(band) as f64;
    for (index, (samples, middles)) in bands.enumerate() {
        watch(index as f64 / band_count);
        let glimpses = pixels.glimpses(index * BAND_ROWS, BAND_ROWS);
        let all = samples.par_chunks_mut(count).zip(middles.par_iter_mut());
        all.enumerate().for_each(|(pixel, (samples, centre))| {
            let looks = pixels.looks(index * band + pixel, &glimpses);
            for (sample, look) in samples.iter_mut().zip(&looks) {
                *sample = look.seen();
            }
            *centre = middle(&looks, per_side);
        });
    }
    let far = || scene.luminaires().iter().any(|luminaire| luminaire.kind.is_far_extent());
    let has_shadow_noise = !scene.area_luminaires().is_empty() || lamps.is_some() || far();
    Ok(LuminanceImage::new(size, samples, middles, has_shadow_noise))
}

/// The surface in the cell nearest the middle, and the mean reading of the cells on it.
fn middle(looks: &[Look], per_side: u32) -> Option<Middle> {
    let central = (per_side / 2) * per_side + per_side / 2;
    let surface = looks[central as usize].surface?;
    let same = |look: &&Look| look.surface.is_some_and(|other| surface.continues(&other));
    let reading = Reading::mean(looks.iter().filter(same).filter_map(|look| look.reading));
    let (reading, noise_lx) = reading.map_or((None, 0.0), |(mean, noise)| (Some(mean), noise));
    Some(Middle { surface, reading, noise_lx })
}
