//! The tests of eight boxes and eight triangles in plain Rust, for every machine.

use super::slabs::Slabs;
use super::traverse::{Entry, Lanes};
use super::triangle_test::Shear;
use super::wide::{Block, Node, WIDTH};

/// Eight lanes as loops that the compiler turns into whatever vectors the target has.
pub(super) struct Portable {
    shear: Shear,
    slabs: Slabs,
}

impl Lanes for Portable {
    type Distances = [f32; WIDTH];

    #[inline(always)]
    fn new(shear: &Shear, slabs: &Slabs) -> Self {
        Self { shear: *shear, slabs: *slabs }
    }

    #[inline(always)]
    fn children_met(&self, node: &Node, t_far: f32) -> ([f32; WIDTH], u32) {
        let Slabs { inverse, enter, leave, entry_planes } = &self.slabs;
        let (mut t_enter, mut t_leave) = ([0.0_f32; WIDTH], [t_far; WIDTH]);
        for axis in 0..3 {
            let near = &node.planes[entry_planes[axis]];
            let far = &node.planes[entry_planes[axis] ^ 1];
            for lane in 0..WIDTH {
                let a = near[lane] * inverse[axis] - enter[axis];
                let b = far[lane] * inverse[axis] - leave[axis];
                t_enter[lane] = if a > t_enter[lane] { a } else { t_enter[lane] };
                t_leave[lane] = if b < t_leave[lane] { b } else { t_leave[lane] };
            }
        }
        let met =
            (0..WIDTH).fold(0, |met, lane| met | u32::from(t_enter[lane] <= t_leave[lane]) << lane);
        (t_enter, met)
    }

    #[inline(always)]
    fn write_met(node: &Node, t: [f32; WIDTH], met: u32, entries: &mut [Entry; WIDTH]) {
        let lanes = (0..WIDTH).filter(|lane| met >> lane & 1 == 1);
        for (entry, lane) in entries.iter_mut().zip(lanes) {
            *entry = Entry::new(t[lane], node.children[lane]);
        }
    }

    #[inline(always)]
    fn candidates(&self, block: &Block) -> u32 {
        let Shear { axes: [x, y, z], origin, slope, .. } = self.shear;
        let mut sheared = [[[0.0_f32; WIDTH]; 2]; 3];
        for (out, corner) in sheared.iter_mut().zip(&block.corners) {
            for lane in 0..WIDTH {
                let depth = corner[z][lane] - origin[2];
                out[0][lane] = corner[x][lane] - origin[0] - slope[0] * depth;
                out[1][lane] = corner[y][lane] - origin[1] - slope[1] * depth;
            }
        }
        let cross = |p: &[[f32; WIDTH]; 2], q: &[[f32; WIDTH]; 2], lane: usize| {
            p[0][lane] * q[1][lane] - p[1][lane] * q[0][lane]
        };
        let [a, b, c] = &sheared;
        (0..WIDTH).fold(0, |bits, lane| {
            let sides = [cross(c, b, lane), cross(a, c, lane), cross(b, a, lane)];
            let inside = sides.iter().all(|&s| s >= 0.0) || sides.iter().all(|&s| s <= 0.0);
            bits | u32::from(inside) << lane
        })
    }
}
