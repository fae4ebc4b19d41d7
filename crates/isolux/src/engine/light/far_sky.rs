//! A sky as a source of light: its luminance in directions of the world, and directions in proportion to it.

use crate::photometry::Sky;
use crate::units::Rgb;
use isolux_geometry::{Direction, Transform, Vector};
use std::f64::consts::PI;
use std::sync::Arc;

/// Cells of equal solid angle from which directions are drawn, from the nadir up and around. One is 2.8 degrees wide, which
/// resolves the glow about the sun: its exponential falls by a factor e within 20 degrees (CIE S 011).
const CELLS: [usize; 2] = [64, 128];

/// Share of the rays that go to bright parts of the sky.
pub(crate) const BRIGHT_SHARE: f64 = 0.25;

/// The luminances of a sky, prepared for drawing directions in proportion to them.
#[derive(Debug)]
struct Table {
    sky: Sky,
    cells_cd_m2: Vec<f64>,
    /// Running sums of the cells.
    sums: Vec<f64>,
    has_bright_parts: bool,
}

/// A sky, or its image in mirrors.
#[derive(Clone, Debug)]
pub(crate) struct FarSky {
    table: Arc<Table>,
    /// Linear and orthogonal (a mirror image is left-handed).
    local_from_world: Transform,
}

impl FarSky {
    /// A sky as it stands in the world.
    pub(crate) fn new(sky: &Sky, local_from_world: Transform) -> Self {
        Self { table: Arc::new(Table::of(sky)), local_from_world }
    }

    /// Its image, with each axis of the world replaced by its mirror image.
    pub(crate) fn image(&self, mirrored: impl Fn(Vector) -> Vector) -> Self {
        let of = |axis: Vector| self.local_from_world.vector(mirrored(axis));
        let columns = Transform::IDENTITY.columns.map(of);
        let local_from_world = Transform { columns, translation: Vector::ZERO };
        Self { table: Arc::clone(&self.table), local_from_world }
    }

    /// Luminance in a direction of the world, cd/m2.
    pub(crate) fn luminance_cd_m2(&self, towards: Direction) -> Rgb {
        self.local(towards).map_or(Rgb::BLACK, |local| self.table.sky.luminance_cd_m2(local))
    }

    /// A direction of the world in the frame of the sky.
    pub(crate) fn local(&self, towards: Direction) -> Option<Direction> {
        self.local_from_world.vector(towards.to_vector()).direction()
    }

    /// A direction of the frame of the sky in the world.
    pub(crate) fn world(&self, local: Vector) -> Option<Direction> {
        let [x, y, z] = self.local_from_world.columns;
        Vector::new(local.dot(x), local.dot(y), local.dot(z)).direction()
    }

    /// Mean luminance of all directions, photometric, cd/m2.
    pub(crate) fn mean_cd_m2(&self) -> f64 {
        self.table.total() / self.table.cells_cd_m2.len() as f64
    }

    /// Whether rays to bright parts save more noise than they cost.
    pub(crate) fn has_bright_parts(&self) -> bool {
        self.table.has_bright_parts
    }

    /// A direction in proportion to luminance.
    pub(crate) fn draw(&self, pick: f64, within: [f64; 2]) -> Option<Direction> {
        self.world(self.table.draw(pick, within)?)
    }

    /// Density of the directions drawn, 1/sr.
    pub(crate) fn density(&self, towards: Direction) -> f64 {
        self.table.density(self.local_from_world.vector(towards.to_vector()))
    }
}

/// A direction to a place of a disc that is seen under twice an angle, even over its solid angle.
pub(crate) fn on_disc(middle: Direction, half_angle_rad: f64, [a, b]: [f64; 2]) -> Direction {
    if half_angle_rad == 0.0 {
        return middle;
    }
    // One less the cosine, without loss of digits for a narrow disc.
    let half = libm::sin(0.5 * half_angle_rad);
    let below = a * 2.0 * half * half;
    let (sin, cos) = libm::sincos(2.0 * PI * b);
    let flat = (below * (2.0 - below)).sqrt();
    middle.from_local(Vector::new(flat * cos, flat * sin, 1.0 - below))
}

impl Table {
    fn of(sky: &Sky) -> Self {
        let cells_cd_m2 = sky.cells_cd_m2(CELLS);
        let mut sum = 0.0;
        let sums = cells_cd_m2.iter().map(|cell| {
            sum += cell;
            sum
        });
        let sums = sums.collect();
        let has_bright_parts = has_bright_parts(&cells_cd_m2);
        Self { sky: sky.clone(), cells_cd_m2, sums, has_bright_parts }
    }

    fn total(&self) -> f64 {
        self.sums.last().copied().unwrap_or(0.0)
    }

    fn draw(&self, pick: f64, [a, b]: [f64; 2]) -> Option<Vector> {
        let total = self.total();
        if total <= 0.0 {
            return None;
        }
        let cell = self.sums.partition_point(|&sum| sum <= pick * total).min(self.sums.len() - 1);
        let [rows, columns] = CELLS;
        let (row, column) = (cell / columns, cell % columns);
        let up = 2.0 * (row as f64 + a) / rows as f64 - 1.0;
        let (sin, cos) = libm::sincos(2.0 * PI * (column as f64 + b) / columns as f64);
        let flat = (1.0 - up * up).max(0.0).sqrt();
        Some(Vector::new(flat * cos, flat * sin, up))
    }

    fn density(&self, local: Vector) -> f64 {
        let [rows, columns] = CELLS;
        let turn = libm::atan2(local.y, local.x) / (2.0 * PI);
        let turn = if turn < 0.0 { turn + 1.0 } else { turn };
        let of =
            |share: f64, count: usize| ((share.max(0.0) * count as f64) as usize).min(count - 1);
        let cell = of(0.5 * (local.z + 1.0), rows) * columns + of(turn, columns);
        let sr = 4.0 * PI / (rows * columns) as f64;
        self.cells_cd_m2[cell] / (self.total().max(f64::MIN_POSITIVE) * sr)
    }
}

/// Whether the noise of even directions above the horizon, the relative mean square of luminance, is more than what rays to
/// bright parts cost: the noise of the others grows by the inverse of the share that is left to them.
fn has_bright_parts(cells_cd_m2: &[f64]) -> bool {
    let above = &cells_cd_m2[cells_cd_m2.len() / 2..];
    let mean = |power: i32| above.iter().map(|c| c.powi(power)).sum::<f64>() / above.len() as f64;
    mean(2) * (1.0 - BRIGHT_SHARE) > mean(1).powi(2)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]
mod tests {
    use super::*;
    use crate::photometry::GeneralSky;
    use crate::sampling::{Key, Sequence};

    fn clear() -> FarSky {
        let sun = Vector::new(0.6, 0.3, 0.5).direction().unwrap();
        let sky = GeneralSky::cie(12, sun).unwrap();
        let turned =
            Transform::rotation_about(Vector::new(1.0, 2.0, 3.0).direction().unwrap(), 0.7);
        FarSky::new(&Sky::General { sky, ground_cd_m2: 0.1 }, turned)
    }

    /// Of n directions drawn, every twelfth part of the sphere gets as many as the integral of the density over it says:
    /// chi-square of 12 parts, exceeded once in ten million by 57 (11 degrees of freedom).
    #[test]
    fn directions_follow_their_density() {
        let sky = clear();
        let part = |d: Direction| {
            let v = d.to_vector();
            usize::from(v.x > 0.0) + 2 * usize::from(v.y > 0.0) + 4 * ((v.z + 1.0) * 1.499) as usize
        };
        let count = 40_000;
        let sequence = Sequence::new(Key::new(5));
        let mut found = [0.0; 12];
        for k in 0..count {
            let [a, b] = sequence.pair(k, 0);
            let drawn = sky.draw(sequence.pair(k, 2)[0], [a, b]).unwrap();
            found[part(drawn)] += 1.0;
        }
        let mut expected = [0.0; 12];
        let even = 400_000;
        for k in 0..even {
            let up = 2.0 * (f64::from(k) + 0.5) / f64::from(even) - 1.0;
            let (sin, cos) = libm::sincos(2.0 * PI * f64::from(k) * 0.618_033_988_749_894_9);
            let flat = (1.0 - up * up).sqrt();
            let d = Vector::new(flat * cos, flat * sin, up).direction().unwrap();
            expected[part(d)] += sky.density(d) * 4.0 * PI / f64::from(even) * f64::from(count);
        }
        let chi2: f64 = found.iter().zip(expected).map(|(f, e)| (f - e).powi(2) / e).sum();
        assert!(chi2 < 57.0, "{found:?} {expected:?}");
        assert!((expected.iter().sum::<f64>() / f64::from(count) - 1.0).abs() < 1e-3);
    }

    #[test]
    fn bright_parts_are_those_of_clear_skies() {
        let of = |number: u8| {
            let sun = Vector::new(0.6, 0.3, 0.5).direction().unwrap();
            let sky = GeneralSky::cie(number, sun).unwrap();
            FarSky::new(&Sky::General { sky, ground_cd_m2: 0.0 }, Transform::IDENTITY)
        };
        assert!(!of(1).has_bright_parts());
        assert!(of(12).has_bright_parts());
    }
}
