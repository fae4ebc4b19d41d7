//! Axis-parallel boxes in the coordinates of the ray kernel.

/// A box; empty where `low > high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
}

impl Bounds {
    /// The box around nothing.
    pub(super) const EMPTY: Self = Self { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    /// The box around some points.
    pub(super) fn around(points: &[[f32; 3]]) -> Self {
        points.iter().fold(Self::EMPTY, |bounds, &p| bounds.union(Self { low: p, high: p }))
    }

    /// The box around two boxes.
    #[inline(always)]
    pub(super) fn union(self, other: Self) -> Self {
        let least = |a: f32, b: f32| if b < a { b } else { a };
        let most = |a: f32, b: f32| if b > a { b } else { a };
        Self {
            low: std::array::from_fn(|axis| least(self.low[axis], other.low[axis])),
            high: std::array::from_fn(|axis| most(self.high[axis], other.high[axis])),
        }
    }

    /// The box larger by so much on all sides, and by a rounding.
    pub(super) fn widened(self, by: f32) -> Self {
        Self {
            low: self.low.map(|x| (x - by).next_down()),
            high: self.high.map(|x| (x + by).next_up()),
        }
    }

    /// Half the surface, m2: in proportion to it random lines meet the box. Zero for the empty box.
    #[inline(always)]
    pub(super) fn half_area(&self) -> f32 {
        let [x, y, z]: [f32; 3] = std::array::from_fn(|axis| self.high[axis] - self.low[axis]);
        if x < 0.0 { 0.0 } else { x * y + y * z + z * x }
    }

    /// The largest coordinate without its sign; zero for the empty box.
    pub(super) fn reach(&self) -> f32 {
        let corners = self.low.iter().chain(&self.high);
        corners.map(|x| x.abs()).filter(|x| x.is_finite()).fold(0.0, f32::max)
    }
}
