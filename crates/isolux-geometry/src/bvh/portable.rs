//! The tests of many boxes and triangles in plain Rust, for every machine.
#![allow(unsafe_code, reason = "`Lanes` is for vector instructions; nothing here needs its promise")]

use super::slabs::Slabs;
use super::traverse::{Entry, Lanes};
use super::triangle_test::Shear;
use super::wide::{Leaf, Node, Reference, WideTree};
use std::mem::MaybeUninit;

/// Loops over lanes that the compiler turns into whatever vectors the target has.
pub(super) struct Portable;

// SAFETY: entries are written one after the other from the first, and their number is returned; no
// special instructions are needed.
unsafe impl<const W: usize> Lanes<W> for Portable {
    #[inline(always)]
    unsafe fn push_met(
        node: &Node<W>,
        slabs: &Slabs,
        t_far: f32,
        free: &mut [MaybeUninit<Entry>; W],
    ) -> usize {
        let Slabs { inverse, enter, leave, entry_planes } = slabs;
        let (mut t_enter, mut t_leave) = ([0.0_f32; W], [t_far; W]);
        for axis in 0..3 {
            let near = &node.planes[entry_planes[axis]];
            let far = &node.planes[entry_planes[axis] ^ 1];
            for lane in 0..W {
                let a = near[lane] * inverse[axis] - enter[axis];
                let b = far[lane] * inverse[axis] - leave[axis];
                t_enter[lane] = if a > t_enter[lane] { a } else { t_enter[lane] };
                t_leave[lane] = if b < t_leave[lane] { b } else { t_leave[lane] };
            }
        }
        let mut met =
            (0..W).fold(0_u32, |met, lane| met | u32::from(t_enter[lane] <= t_leave[lane]) << lane);
        let count = met.count_ones() as usize;
        for entry in &mut free[..count] {
            let lane = met.trailing_zeros() as usize;
            met &= met - 1;
            entry.write(Entry::new(t_enter[lane], node.children[lane]));
        }
        count
    }

    #[inline(always)]
    unsafe fn candidates(leaf: &Leaf<'_>, first: usize, shear: &Shear, t_far: f32) -> u32 {
        let Shear { axes, origin, slope, per_depth, .. } = shear;
        let (mut x, mut y, mut t) = ([[0.0_f32; W]; 3], [[0.0; W]; 3], [[0.0; W]; 3]);
        for corner in 0..3 {
            // SAFETY: `W` numbers can be read, and any bits are a number.
            let row = |axis: usize| unsafe { *leaf.row(corner, axis, first).cast::<[f32; W]>() };
            let [row_x, row_y, row_z] = axes.map(row);
            for lane in 0..W {
                let depth = row_z[lane] - origin[2];
                x[corner][lane] = row_x[lane] - origin[0] - slope[0] * depth;
                y[corner][lane] = row_y[lane] - origin[1] - slope[1] * depth;
                t[corner][lane] = depth * per_depth;
            }
        }
        let t_end = Shear::beyond(t_far);
        (0..W).fold(0, |bits, lane| {
            let cross = |p: usize, q: usize| x[p][lane] * y[q][lane] - y[p][lane] * x[q][lane];
            let (u, v, w) = (cross(2, 1), cross(0, 2), cross(1, 0));
            let is_inside = (u >= 0.0) & (v >= 0.0) & (w >= 0.0) | (u <= 0.0) & (v <= 0.0) & (w <= 0.0);
            let [a, b, c] = [t[0][lane], t[1][lane], t[2][lane]];
            let is_ahead = (a > 0.0) | (b > 0.0) | (c > 0.0);
            let is_near = (a <= t_end) | (b <= t_end) | (c <= t_end);
            bits | u32::from(is_inside & is_ahead & is_near) << lane
        })
    }

    #[inline(always)]
    unsafe fn prefetch(_: &WideTree<W>, _: Reference) {}
}
