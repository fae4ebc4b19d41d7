//! Views by ray casting over an illumination map.

mod dielectric;
mod lobes;
mod look;
mod settings;

pub use settings::{SurfacePoint, TraceSettings};

use crate::camera::ViewRays;
use crate::error::ViewError;
use crate::image::{LuminanceImage, Middle, Reading, Size};
use isolux::map::Illuminance;
use isolux::sampling::Key;
use isolux::scene::{Camera, Scene};
use look::{Look, Looker};
use rayon::prelude::*;

/// Cells along the side of a pixel from which on some of them can stand for the others.
const FEWEST_TO_COMPARE: u32 = 3;

/// Looks at a scene. `read` gives the illuminance of a place of a surface, `None` where it is not
/// known: the bare map, or direct light evaluated afresh with the indirect part interpolated.
///
/// Diffuse surfaces show L = Le + rho E / pi. Mirrors and smooth glass are followed; gloss is
/// averaged over a few GGX facets, so it shows surfaces and emitters but not the highlights of
/// luminaires without surface. The same arguments give the same bits on any number of threads.
pub fn trace(
    scene: &Scene,
    camera: &Camera,
    size: Size,
    settings: &TraceSettings,
    read: &(dyn Fn(SurfacePoint) -> Option<Illuminance> + Sync),
) -> Result<LuminanceImage, ViewError> {
    let per_side = settings.samples_per_side.max(1);
    size.check_samples(per_side.saturating_mul(per_side))?;
    let rays = ViewRays::new(camera, size);
    let looker = Looker { scene, settings, read };
    let count = (per_side * per_side) as usize;
    let mut samples = vec![Look::NOTHING.seen(); size.pixels() * count];
    let mut middles = vec![None; size.pixels()];
    let pixels = samples.par_chunks_mut(count).zip(middles.par_iter_mut());
    pixels.enumerate().for_each(|(pixel, (samples, centre))| {
        let looks = pixel_looks(&looker, &rays, size, pixel, per_side);
        for (sample, look) in samples.iter_mut().zip(&looks) {
            *sample = look.seen();
        }
        *centre = middle(&looks, per_side);
    });
    Ok(LuminanceImage::new(size, samples, middles))
}

/// One look through each cell of a pixel, at a random place of the cell, rows from the top. Where
/// the cells on the diagonal look alike they stand for their columns.
fn pixel_looks(
    looker: &Looker,
    rays: &ViewRays,
    size: Size,
    pixel: usize,
    per_side: u32,
) -> Vec<Look> {
    let (left, top) = (pixel % size.width() as usize, pixel / size.width() as usize);
    let key = Key::new(looker.settings.seed).with(pixel as u64);
    let cell = |cell: u32| {
        let key = key.with(u64::from(cell));
        let within = |index: u32, axis: u64| {
            // A single sample stays in the middle, where contour lines are drawn through.
            let jitter = if per_side == 1 { 0.5 } else { key.with(axis).uniform() };
            (f64::from(index) + jitter) / f64::from(per_side)
        };
        let x = left as f64 + within(cell % per_side, 0);
        let y = top as f64 + within(cell / per_side, 1);
        let (ray, direction) = rays.through(x, y);
        looker.look(&ray, direction, key.with(2))
    };
    let diagonal: Vec<Look> = (0..per_side).map(|k| cell(k * (per_side + 1))).collect();
    let alike = per_side >= FEWEST_TO_COMPARE && diagonal.iter().all(|l| l.is_like(&diagonal[0]));
    let look = |k: u32| {
        let (row, column) = (k / per_side, k % per_side);
        if alike || row == column { diagonal[column as usize] } else { cell(k) }
    };
    (0..per_side * per_side).map(look).collect()
}

/// The surface in the cell nearest the middle, and the mean reading of the cells on it.
fn middle(looks: &[Look], per_side: u32) -> Option<Middle> {
    let central = (per_side / 2) * per_side + per_side / 2;
    let surface = looks[central as usize].surface?;
    let same = |look: &&Look| look.surface.is_some_and(|other| surface.continues(&other));
    let reading = Reading::mean(looks.iter().filter(same).filter_map(|look| look.reading));
    Some(Middle { surface, reading })
}
