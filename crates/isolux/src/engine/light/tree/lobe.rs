//! Tables of intensity distributions for fast weights: they tell how likely a luminaire is drawn, never its light.
//!
//! A table is an octahedral map of all directions (Meyer et al. 2010, "On floating-point normal
//! vectors"), with one level for each angular spread under which a cluster of luminaires may be seen.
//! Its values are means over the spread, but at least a share of the highest intensity there, so that
//! no bright direction is unlikely to be drawn. They are zero only where all of the spread is dark.

use crate::photometry::{IntensityDistribution, PhotometricWeb};
use isolux_geometry::{Direction, Vector};
use std::collections::HashMap;

/// Texels across of the plain table, for single luminaires.
const PLAIN_SIZE: usize = 64;

/// Number of angular spreads of every table: the texel alone, then neighbourhoods of doubling size,
/// then the whole sphere.
const SPREADS: usize = 6;

/// Texels across of the table of one distribution.
const TABLE_SIZE: usize = 32;
/// Texels across of the table of a mixture.
const MIXED_SIZE: usize = 16;

/// Samples of a texel along each side, its border included.
const SIDE_SAMPLES: usize = 5;

/// The smallest value, as a share of the highest intensity over the spread.
const LEAST_VALUE_SHARE: f64 = 0.125;

/// The smallest value of a texel beside a lit one, as a share of that.
const BORDER_VALUE_SHARE: f64 = 0.02;

/// Largest distance on the map for every radian of direction: the square root of two, at the
/// corners of the octahedron, rounded up.
const MOST_STRETCH: f64 = 1.5;

/// Tables of several distributions.
#[derive(Debug, Default)]
pub(crate) struct Lobes {
    values: Vec<f32>,
    /// Plain tables, for single luminaires.
    plain: Vec<f32>,
    /// Neighbours of each texel, by size of the table and step.
    around: HashMap<(usize, i32), Vec<[u16; 9]>>,
}

/// The position of one table in [`Lobes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Lobe {
    first: u32,
    size: u32,
    /// Start of its plain table; mixtures have none.
    plain: u32,
}

impl Lobe {
    /// A number that identifies the table.
    pub(crate) const fn number(self) -> usize {
        self.first as usize
    }
}

/// A table as part of a mixture.
pub(crate) struct PartOfMixture<'a> {
    pub(crate) lobe: Lobe,
    /// Axes of the frame of the table; `None` if these are the axes of the world.
    pub(crate) frame: Option<&'a [Vector; 3]>,
    pub(crate) weight: f64,
}

/// Mean and highest value of every texel.
struct Texels {
    size: usize,
    means: Vec<f64>,
    highest: Vec<f64>,
}

impl Lobes {
    /// Adds the table of a distribution, relative to its highest intensity.
    pub(crate) fn add(&mut self, intensity: &IntensityDistribution) -> Lobe {
        let most_cd = intensity.max_intensity_cd().max(f64::MIN_POSITIVE);
        let mut texels = Texels::dark(TABLE_SIZE);
        for j in 0..TABLE_SIZE {
            for i in 0..TABLE_SIZE {
                let (mean, highest) = sampled(intensity, i, j);
                texels.means[j * TABLE_SIZE + i] = mean / most_cd;
                texels.highest[j * TABLE_SIZE + i] = highest / most_cd;
            }
        }
        if let IntensityDistribution::Web(web) = intensity {
            texels.include_nodes(web, most_cd);
        }
        let plain = self.plain.len() as u32;
        let lobe = Lobe { plain, ..self.push(texels) };
        for texel in 0..PLAIN_SIZE * PLAIN_SIZE {
            let (i, j) = (texel % PLAIN_SIZE, texel / PLAIN_SIZE);
            let place = |k: usize| (k as f64 + 0.5) / PLAIN_SIZE as f64;
            let around = self.read(lobe, 0, direction_at(place(i), place(j)));
            let mean = mean_of_corners(intensity, i, j) / most_cd;
            self.plain.push(mean.max(LEAST_VALUE_SHARE * around) as f32);
        }
        lobe
    }

    /// Adds the table of a mixture, in the axes of the world.
    pub(crate) fn mix<'a>(&mut self, parts: impl Iterator<Item = PartOfMixture<'a>>) -> Lobe {
        let mut texels = Texels::dark(MIXED_SIZE);
        for PartOfMixture { lobe, frame, weight } in parts {
            for j in 0..MIXED_SIZE {
                for i in 0..MIXED_SIZE {
                    let place = |k: usize| (k as f64 + 0.5) / MIXED_SIZE as f64;
                    let world = direction_at(place(i), place(j));
                    let local = frame.map_or(world, |frame| turned(frame, world));
                    texels.means[j * MIXED_SIZE + i] += weight * self.wide_texel(lobe, local);
                }
            }
        }
        texels.highest.clone_from(&texels.means);
        self.push(texels)
    }

    /// The value of a distribution in a direction (of any length), for a single luminaire: the mean
    /// over a texel, but at least a share of the highest value nearby.
    pub(crate) fn plain(&self, lobe: Lobe, local: Vector) -> f64 {
        f64::from(self.plain[lobe.plain as usize + texel_of(local, PLAIN_SIZE)])
    }

    /// The value for directions that spread about `local` (of any length) by an angle whose sine is `spread`.
    pub(crate) fn towards(&self, lobe: Lobe, spread: f64, local: Vector) -> f64 {
        let size = lobe.size as usize;
        let texels = spread * (MOST_STRETCH * 0.5 * size as f64);
        let level = match texels {
            t if t <= 0.0 => 0,
            t if t <= 1.0 => 1,
            t if t <= 3.0 => 2,
            t if t <= 7.0 => 3,
            t if t <= 15.0 && size == TABLE_SIZE => 4,
            _ => SPREADS - 1,
        };
        self.read(lobe, level, local)
    }

    /// The neighbours of all texels at a distance of `step`.
    fn around(&mut self, size: usize, step: i32) -> &[[u16; 9]] {
        self.around.entry((size, step)).or_insert_with(|| {
            let near = |texel: usize, k: i32| {
                let (i, j) = ((texel % size) as i32, (texel / size) as i32);
                folded(i + (k % 3 - 1) * step, j + (k / 3 - 1) * step, size as i32) as u16
            };
            (0..size * size).map(|texel| std::array::from_fn(|k| near(texel, k as i32))).collect()
        })
    }

    /// The value of a table over one texel of a mixture, which may be wider.
    fn wide_texel(&self, lobe: Lobe, local: Vector) -> f64 {
        self.read(lobe, if lobe.size as usize > MIXED_SIZE { 1 } else { 0 }, local)
    }

    fn read(&self, lobe: Lobe, level: usize, local: Vector) -> f64 {
        let size = lobe.size as usize;
        let texel = texel_of(local, size);
        f64::from(self.values[lobe.first as usize + level * size * size + texel])
    }

    /// Appends the tables of all spreads.
    fn push(&mut self, mut texels: Texels) -> Lobe {
        let first = self.values.len() as u32;
        texels.blur_borders(self.around(texels.size, 1));
        for level in 0..SPREADS {
            match level {
                0 => {}
                last if last == SPREADS - 1 => texels.spread_everywhere(),
                _ => texels.spread(self.around(texels.size, 1 << (level - 1))),
            }
            // A single direction takes the highest value, so that no sample gets a large weight.
            let share = if level == 0 { 1.0 } else { LEAST_VALUE_SHARE };
            let value = |(&mean, &highest): (&f64, &f64)| mean.max(share * highest) as f32;
            self.values.extend(texels.means.iter().zip(&texels.highest).map(value));
        }
        Lobe { first, size: texels.size as u32, plain: u32::MAX }
    }
}

impl Texels {
    fn dark(size: usize) -> Self {
        Self { size, means: vec![0.0; size * size], highest: vec![0.0; size * size] }
    }

    /// Includes the peaks of a measured table, which samples may miss.
    fn include_nodes(&mut self, web: &PhotometricWeb, most_cd: f64) {
        for (at, cd) in web.nodes() {
            let highest = &mut self.highest[texel_of(at, self.size)];
            *highest = highest.max(cd / most_cd);
        }
    }

    /// Makes no texel beside a lit one wholly dark, because an edge of the beam may pass between samples.
    fn blur_borders(&mut self, around: &[[u16; 9]]) {
        let sharp = std::mem::take(&mut self.highest);
        self.highest.clone_from(&sharp);
        let means = self.means.clone();
        self.spread(around);
        self.means = means;
        for (blurred, sharp) in self.highest.iter_mut().zip(sharp) {
            *blurred = sharp.max(BORDER_VALUE_SHARE * *blurred);
        }
    }

    /// Spreads every texel over its neighbours: their mean, and their highest value.
    fn spread(&mut self, around: &[[u16; 9]]) {
        let mean = |near: &[u16; 9]| near.iter().map(|&k| self.means[k as usize]).sum::<f64>();
        let most =
            |near: &[u16; 9]| near.iter().map(|&k| self.highest[k as usize]).fold(0.0, f64::max);
        let means = around.iter().map(|near| mean(near) / 9.0).collect();
        let highest = around.iter().map(most).collect();
        (self.means, self.highest) = (means, highest);
    }

    fn spread_everywhere(&mut self) {
        let mean = self.means.iter().sum::<f64>() / self.means.len() as f64;
        let most = self.highest.iter().copied().fold(0.0, f64::max);
        self.means.fill(mean);
        self.highest.fill(most);
    }
}

/// Mean and highest intensity over a texel, cd.
fn sampled(intensity: &IntensityDistribution, i: usize, j: usize) -> (f64, f64) {
    let (mut sum, mut highest) = (0.0, 0.0_f64);
    let place = |texel: usize, k: usize| {
        (texel as f64 + k as f64 / (SIDE_SAMPLES - 1) as f64) / TABLE_SIZE as f64
    };
    for (a, b) in (0..SIDE_SAMPLES).flat_map(|a| (0..SIDE_SAMPLES).map(move |b| (a, b))) {
        let local = direction_at(place(i, a), place(j, b)).direction().unwrap_or(Direction::Z);
        let cd = intensity.intensity_cd(local);
        sum += cd;
        highest = highest.max(cd);
    }
    (sum / (SIDE_SAMPLES * SIDE_SAMPLES) as f64, highest)
}

/// Mean intensity over a texel of a plain table, cd, from its corners and its middle (exact for linear functions).
fn mean_of_corners(intensity: &IntensityDistribution, i: usize, j: usize) -> f64 {
    let at = |x: f64, y: f64| {
        let place = |texel: usize, inside: f64| (texel as f64 + inside) / PLAIN_SIZE as f64;
        let local = direction_at(place(i, x), place(j, y)).direction().unwrap_or(Direction::Z);
        intensity.intensity_cd(local)
    };
    let corners = [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)];
    0.5 * at(0.5, 0.5) + 0.125 * corners.iter().map(|&(x, y)| at(x, y)).sum::<f64>()
}

/// A vector in the coordinates of a frame given by its axes.
pub(crate) fn turned([x, y, z]: &[Vector; 3], v: Vector) -> Vector {
    Vector::new(x.dot(v), y.dot(v), z.dot(v))
}

/// Index of the texel of a direction (of any length): nadir in the middle, zenith in the corners.
fn texel_of(v: Vector, size: usize) -> usize {
    let scale = 1.0 / (v.x.abs() + v.y.abs() + v.z.abs());
    let (x, y) = (v.x * scale, v.y * scale);
    let (x, y) =
        if v.z > 0.0 { ((1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y)) } else { (x, y) };
    // The cast of NaN gives zero.
    let index = |c: f64| ((((c + 1.0) * 0.5) * size as f64) as usize).min(size - 1);
    index(y) * size + index(x)
}

/// The direction, of any length, at a place of the map from 0 to 1 along both sides.
fn direction_at(u: f64, v: f64) -> Vector {
    let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    let down = 1.0 - x.abs() - y.abs();
    if down >= 0.0 {
        Vector::new(x, y, -down)
    } else {
        Vector::new((1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y), -down)
    }
}

/// Index of the texel at a place that may lie beyond the border, where the map folds over.
fn folded(mut i: i32, mut j: i32, size: i32) -> usize {
    if i < 0 || i >= size {
        (i, j) = (if i < 0 { -1 - i } else { 2 * size - 1 - i }, size - 1 - j);
    }
    if j < 0 || j >= size {
        (i, j) = (size - 1 - i, if j < 0 { -1 - j } else { 2 * size - 1 - j });
    }
    (j * size + i) as usize
}
