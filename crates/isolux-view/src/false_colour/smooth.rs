//! Taking the noise of shadow rays out of values before lines are drawn through them.

use crate::image::LuminanceImage;
use rayon::prelude::*;

/// How far pixels are mixed, pixels.
const REACH: usize = 8;
/// Standard deviation of the weight by distance, pixels.
const SPREAD: f64 = 4.0;
/// A spread of readings below this share of their mean is no noise that a line would show.
const EVEN: f32 = 1e-3;

/// Illuminance in the middle of every pixel. Where readings are noisy it is a weighted mean over
/// pixels around on the same smooth piece of surface: lines may move by a few pixels there, but
/// stay lines. Where they are not, nothing changes.
pub(super) fn illuminances_lx(image: &LuminanceImage) -> Vec<Option<f64>> {
    let fall = |distance2: usize| libm::exp(-0.5 * distance2 as f64 / (SPREAD * SPREAD));
    let weights: Vec<f64> = (0..=2 * REACH * REACH).map(fall).collect();
    let noisy: Vec<bool> = (0..image.size().pixels()).map(|k| is_noisy(image, k)).collect();
    let pixels = (0..image.size().pixels()).into_par_iter();
    pixels.map(|pixel| smoothed(image, pixel, &noisy, &weights)).collect()
}

fn is_noisy(image: &LuminanceImage, pixel: usize) -> bool {
    let Some(middle) = image.middle(pixel).filter(|_| image.has_shadow_noise()) else {
        return false;
    };
    middle.reading.is_some_and(|reading| middle.noise_lx > EVEN * reading.illuminance_lx)
}

fn smoothed(image: &LuminanceImage, pixel: usize, noisy: &[bool], weights: &[f64]) -> Option<f64> {
    let (width, height) = (image.size().width() as usize, image.size().height() as usize);
    let (x, y) = (pixel % width, pixel / width);
    let middle = image.middle(pixel)?;
    let here = f64::from(middle.reading?.illuminance_lx);
    let rows = y.saturating_sub(REACH)..=(y + REACH).min(height - 1);
    let columns = x.saturating_sub(REACH)..=(x + REACH).min(width - 1);
    if !rows.clone().any(|row| columns.clone().any(|column| noisy[row * width + column])) {
        return Some(here);
    }
    let (mut sum, mut total) = (here, 1.0);
    for (row, column) in rows.flat_map(|row| columns.clone().map(move |column| (row, column))) {
        let other = image.middle(row * width + column);
        let other = other.filter(|other| middle.surface.continues(&other.surface));
        let Some(reading) = other.and_then(|other| other.reading) else { continue };
        let distance2 = row.abs_diff(y).pow(2) + column.abs_diff(x).pow(2);
        if distance2 > 0 {
            sum += f64::from(reading.illuminance_lx) * weights[distance2];
            total += weights[distance2];
        }
    }
    Some(sum / total)
}
