//! The mean of several views of the same, each with random numbers of its own, and how much noise is left in it.

use crate::develop::{Development, Shown};
use crate::error::ViewError;
use crate::image::{LuminanceImage, Size};
use crate::lab::{cie94, lab};
use crate::trace::Window;
use isolux::sampling::{Key, Sequence};
use isolux::units::Rgb;
use rayon::prelude::*;

/// Pixels across a window that is judged. Where light is gathered and interpolated depends on pixels about: those within
/// `MARGIN` of the edge are not judged.
const WINDOW: u32 = 64;
const MARGIN: u32 = 16;
/// The side of the part of a picture that a window tells of: with it windows are a twentieth of the pixels.
const PART: f64 = 286.0;
/// The fewest windows.
const FEWEST: u32 = 12;
/// The share of pixels that [`Noise::few`] leaves out.
const FEW: f64 = 0.01;

/// The noise of a picture in just noticeable differences: CIE94 between its colours and those without noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// The mean over the pixels.
    pub mean: f64,
    /// What one pixel of a hundred exceeds.
    pub few: f64,
}

/// The mean over rounds.
pub struct Rounds {
    mean: LuminanceImage,
    /// Sums over the even and over the odd rounds, pixel by pixel, and how many they are.
    halves: [(Vec<Rgb>, u32); 2],
}

impl Rounds {
    /// Begins with the first round.
    pub fn new(first: LuminanceImage) -> Self {
        let even = pixels(&first);
        let odd = vec![Rgb::BLACK; even.len()];
        Self { mean: first, halves: [(even, 1), (odd, 0)] }
    }

    /// Adds a view of the same that was traced with the number [`Self::count`] as its round.
    pub fn add(&mut self, round: &LuminanceImage) {
        let half = &mut self.halves[(self.count() % 2) as usize];
        half.1 += 1;
        half.0.iter_mut().zip(pixels(round)).for_each(|(sum, more)| *sum += more);
        let count = self.count();
        self.mean.take_up(round, count);
    }

    /// Rounds so far.
    pub fn count(&self) -> u32 {
        self.halves.iter().map(|(_, count)| count).sum()
    }

    /// The mean.
    pub fn mean(&self) -> &LuminanceImage {
        &self.mean
    }

    /// The mean, when there is nothing to be added any more.
    pub fn into_mean(self) -> LuminanceImage {
        self.mean
    }

    /// The noise of the mean, from the difference of the even and the odd rounds; `None` after the first round.
    pub fn noise(&self, how: &Development) -> Result<Option<Noise>, ViewError> {
        let [(even, evens), (odd, odds)] = &self.halves;
        if *odds == 0 {
            return Ok(None);
        }
        let shown = Shown::of(&self.mean, how)?;
        let [evens, odds] = [evens, odds].map(|&count| f64::from(count));
        // The difference of two means has the variance of a round times 1 / evens + 1 / odds, the mean of all its 1 / (evens + odds).
        let share = (evens * odds).sqrt() / (evens + odds);
        let differences = even.par_iter().zip(odd).map(|(even, odd)| {
            let [even, odd] = [*even / evens, *odd / odds].map(|mean| lab(shown.linear(mean)));
            share * cie94(even, odd)
        });
        Ok(Some(Noise::of(differences.collect())))
    }

    /// The noise of the first round, from windows of [`judged_windows`] that were traced as round 1.
    pub fn noise_by_windows(
        &self,
        windows: &[(Window, LuminanceImage)],
        how: &Development,
    ) -> Result<Noise, ViewError> {
        let shown = Shown::of(&self.mean, how)?;
        let width = self.mean.size().width();
        let mut differences = Vec::new();
        for (window, image) in windows {
            let own = image.size();
            for y in MARGIN..own.height().saturating_sub(MARGIN) {
                for x in MARGIN..own.width().saturating_sub(MARGIN) {
                    let pixel = (window.top + y) * width + window.left + x;
                    let within = y * own.width() + x;
                    let one = self.mean.luminance_cd_m2(pixel as usize);
                    let other = image.luminance_cd_m2(within as usize);
                    let [one, other] = [one, other].map(|mean| lab(shown.linear(mean)));
                    // Both have noise.
                    differences.push(cie94(one, other) / 2f64.sqrt());
                }
            }
        }
        Ok(Noise::of(differences))
    }
}

/// How many windows there are across and down a picture.
fn windows(size: Size) -> [u32; 2] {
    let sides = [size.width(), size.height()].map(f64::from);
    let mut counts = sides.map(|side| libm::round(side / PART).max(1.0) as u32);
    while counts[0] * counts[1] < FEWEST {
        let [across, down] = [0, 1].map(|k| sides[k] / f64::from(counts[k]));
        counts[usize::from(down > across)] += 1;
    }
    counts
}

/// Windows by which the noise of one round is judged, and the size of each: one at a place of its own in every part of a
/// picture. `None` for a picture so small that a second round costs little more.
pub fn judged_windows(size: Size) -> Option<(Vec<Window>, Size)> {
    let counts = windows(size);
    let parts = [size.width() / counts[0], size.height() / counts[1]];
    // Half of its pixels or more.
    if parts[0].min(parts[1]) < WINDOW || 2 * WINDOW * WINDOW > parts[0] * parts[1] {
        return None;
    }
    let own = Size::new(WINDOW, WINDOW).ok()?;
    let places = Sequence::new(Key::new(0));
    let part = |index: u32| {
        let [column, row] = [index % counts[0], index / counts[0]];
        let [across, down] = places.pair(index, 0);
        let free = |side: u32, share: f64| (f64::from(side - WINDOW + 1) * share) as u32;
        let left = column * parts[0] + free(parts[0], across);
        let top = row * parts[1] + free(parts[1], down);
        Window { of: size, left, top }
    };
    Some(((0..counts[0] * counts[1]).map(part).collect(), own))
}

impl Noise {
    fn of(mut differences: Vec<f64>) -> Self {
        let count = differences.len();
        let mean = differences.iter().sum::<f64>() / count.max(1) as f64;
        let beyond = ((1.0 - FEW) * count as f64) as usize;
        let few = match beyond < count {
            true => *differences.select_nth_unstable_by(beyond, f64::total_cmp).1,
            false => 0.0,
        };
        Self { mean, few }
    }

    /// How many rounds as many as `rounds` have to become for the mean to fall to a goal.
    pub fn rounds_for(&self, goal: f64, rounds: u32) -> u32 {
        let factor = self.mean / goal;
        (f64::from(rounds) * factor * factor).ceil().clamp(1.0, f64::from(u32::MAX)) as u32
    }
}

fn pixels(image: &LuminanceImage) -> Vec<Rgb> {
    (0..image.size().pixels()).into_par_iter().map(|pixel| image.luminance_cd_m2(pixel)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::{Seen, Sight};

    /// A grey picture whose samples have relative noise, a number of them a pixel.
    fn noisy(size: Size, round: u64, noise: f64) -> LuminanceImage {
        const SAMPLES: usize = 4;
        let sample = |index: usize| {
            let [a, b] = Sequence::new(Key::new(round).with(index as u64)).pair(0, 0);
            // The sum of two uniform numbers has the variance 1/6.
            let off = (a + b - 1.0) * 6f64.sqrt() * noise * (SAMPLES as f64).sqrt();
            let luminance_cd_m2 = [(50.0 * (1.0 + off)) as f32; 3];
            Seen { luminance_cd_m2, reading: None, sight: Sight::Surface }
        };
        let samples = (0..size.pixels() * SAMPLES).map(sample).collect();
        LuminanceImage::new(size, samples, vec![None; size.pixels()], false)
    }

    /// The mean difference of the colours of a picture from those of the same without noise.
    fn true_noise(mean: &LuminanceImage, how: &Development) -> f64 {
        let still = noisy(mean.size(), 0, 0.0);
        let shown = Shown::of(mean, how).unwrap();
        let colours = |image: &LuminanceImage| -> Vec<[f64; 3]> {
            pixels(image).into_iter().map(|pixel| lab(shown.linear(pixel))).collect()
        };
        let all = colours(mean).into_iter().zip(colours(&still));
        all.map(|(one, other)| cie94(one, other)).sum::<f64>() / mean.size().pixels() as f64
    }

    #[test]
    fn the_noise_told_is_the_noise_there_is_and_falls_with_the_rounds() {
        let (size, how) = (Size::new(100, 100).unwrap(), Development::default());
        let mut rounds = Rounds::new(noisy(size, 0, 0.02));
        assert_eq!(rounds.noise(&how), Ok(None));
        let mut told = Vec::new();
        for round in 1..9 {
            rounds.add(&noisy(size, round, 0.02));
            let noise = rounds.noise(&how).unwrap().unwrap();
            let truth = true_noise(rounds.mean(), &how);
            // Means over 10,000 pixels err by about a hundredth, and so does the curve of tones between them.
            assert!((noise.mean / truth - 1.0).abs() < 0.05, "{noise:?} for {truth} of {round}");
            assert!(noise.few > 2.0 * noise.mean, "{noise:?}");
            told.push(noise.mean);
        }
        assert_eq!(rounds.count(), 9);
        // Of two rounds and of eight.
        assert!((told[0] / told[6] / 2.0 - 1.0).abs() < 0.05, "{told:?}");
        let noise = rounds.noise(&how).unwrap().unwrap();
        assert_eq!(noise.rounds_for(0.5 * noise.mean, 9), 36);
        assert_eq!(noise.rounds_for(2.0 * noise.mean, 9), 3);
    }

    #[test]
    fn windows_tell_the_noise_of_the_first_round() {
        let (size, how) = (Size::new(640, 360).unwrap(), Development::default());
        let rounds = Rounds::new(noisy(size, 0, 0.02));
        let (windows, own) = judged_windows(size).unwrap();
        let judged: Vec<(Window, LuminanceImage)> =
            windows.into_iter().map(|window| (window, noisy(own, 1, 0.02))).collect();
        let noise = rounds.noise_by_windows(&judged, &how).unwrap();
        let truth = true_noise(rounds.mean(), &how);
        assert!((noise.mean / truth - 1.0).abs() < 0.05, "{noise:?} for {truth}");
    }

    #[test]
    fn windows_lie_within_the_picture_and_small_pictures_have_none() {
        for (width, height) in [(1280, 720), (400, 400), (640, 360), (5200, 288), (7680, 4320)] {
            let size = Size::new(width, height).unwrap();
            let (windows, own) = judged_windows(size).unwrap();
            let share = windows.len() as f64 * own.pixels() as f64 / size.pixels() as f64;
            assert!(windows.len() >= 12 && share > 0.04, "{share}");
            for window in &windows {
                assert!(window.left + own.width() <= width && window.top + own.height() <= height);
            }
        }
        for (width, height) in [(320, 180), (1300, 72), (5000, 60), (1, 1)] {
            assert!(judged_windows(Size::new(width, height).unwrap()).is_none());
        }
    }
}
