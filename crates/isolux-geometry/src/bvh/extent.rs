//! Boxes while the hierarchy is built: four lanes, so that plain code becomes vector instructions.

use super::bounds::Bounds;

/// A box; what the fourth lane holds is carried along.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub(super) struct Extent {
    low: [f32; 4],
    high: [f32; 4],
}

impl Extent {
    /// The box around nothing.
    pub(super) const EMPTY: Self = Self { low: [f32::INFINITY; 4], high: [f32::NEG_INFINITY; 4] };

    pub(super) fn of(bounds: &Bounds, fourth: f32) -> Self {
        let ([x, y, z], [to_x, to_y, to_z]) = (bounds.low, bounds.high);
        Self { low: [x, y, z, fourth], high: [to_x, to_y, to_z, fourth] }
    }

    pub(super) fn bounds(&self) -> Bounds {
        let ([x, y, z, _], [to_x, to_y, to_z, _]) = (self.low, self.high);
        Bounds { low: [x, y, z], high: [to_x, to_y, to_z] }
    }

    pub(super) fn low(&self) -> [f32; 4] {
        self.low
    }

    pub(super) fn fourth(&self) -> f32 {
        self.low[3]
    }

    /// The box around two boxes.
    #[inline(always)]
    pub(super) fn union(&self, other: &Self) -> Self {
        Self { low: least(self.low, other.low), high: greatest(self.high, other.high) }
    }

    /// The box around a box and a point.
    #[inline(always)]
    pub(super) fn with(&self, point: [f32; 4]) -> Self {
        Self { low: least(self.low, point), high: greatest(self.high, point) }
    }

    #[inline(always)]
    pub(super) fn centre_doubled(&self) -> [f32; 4] {
        std::array::from_fn(|k| self.low[k] + self.high[k])
    }

    /// From side to side.
    #[inline(always)]
    pub(super) fn size(&self) -> [f32; 4] {
        std::array::from_fn(|k| self.high[k] - self.low[k])
    }

    /// Half the surface, m2; zero for the empty box.
    #[inline(always)]
    pub(super) fn half_area(&self) -> f32 {
        let [x, y, z, _] = self.size();
        if x < 0.0 { 0.0 } else { x * y + y * z + z * x }
    }
}

#[inline(always)]
fn least(a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
    std::array::from_fn(|k| if b[k] < a[k] { b[k] } else { a[k] })
}

#[inline(always)]
fn greatest(a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
    std::array::from_fn(|k| if b[k] > a[k] { b[k] } else { a[k] })
}
