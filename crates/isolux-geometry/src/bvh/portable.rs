//! The tests of many boxes and triangles in plain Rust, for every machine.
#![allow(
    unsafe_code,
    reason = "`Lanes` is for vector instructions; nothing here needs its promise"
)]

use super::slabs::Slabs;
use super::traverse::{Entry, Lanes, Met};
use super::triangle_test::{FAR, Meeting, Shear};
use super::wide::{Leaf, Node, Reference, WideTree};
use std::mem::MaybeUninit;

/// Loops over lanes that the compiler turns into whatever vectors the target has.
pub(super) struct Portable;

// SAFETY: entries are written one after the other from the first, and their number is returned; no
// special instructions are needed.
unsafe impl<const W: usize> Lanes<W> for Portable {
    type Meetings = [[f32; W]; 4];

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
    unsafe fn meet(leaf: &Leaf<'_>, first: usize, shear: &Shear, t_far: f32) -> Met<[[f32; W]; 4]> {
        let Shear { axes, origin, slope, per_depth, .. } = shear;
        // SAFETY: `W` numbers of a row can be read, and any bits are a number.
        let numbers = |row: *const f32| unsafe { *row.cast::<[f32; W]>() };
        let (mut x, mut y, mut z) = ([[0.0_f32; W]; 3], [[0.0; W]; 3], [[0.0; W]; 3]);
        for corner in 0..3 {
            let [row_x, row_y, row_z] =
                axes.map(|axis| numbers(leaf.coordinates(corner, axis, first)));
            for lane in 0..W {
                let depth = row_z[lane] - origin[2];
                x[corner][lane] = row_x[lane] - origin[0] - slope[0] * depth;
                y[corner][lane] = row_y[lane] - origin[1] - slope[1] * depth;
                z[corner][lane] = depth;
            }
        }
        let least_sums = numbers(leaf.least_sums(first));
        let [mut t, mut v, mut w, mut sum] = [[0.0_f32; W]; 4];
        let (mut surely, mut perhaps) = (0, 0);
        for lane in 0..W {
            let cross = |p: usize, q: usize| x[p][lane] * y[q][lane] - y[p][lane] * x[q][lane];
            let u = cross(2, 1);
            (v[lane], w[lane]) = (cross(0, 2), cross(1, 0));
            let is_front = (u >= 0.0) & (v[lane] >= 0.0) & (w[lane] >= 0.0);
            let is_back = (u <= 0.0) & (v[lane] <= 0.0) & (w[lane] <= 0.0);
            let is_inside = is_front | is_back;
            sum[lane] = u + (v[lane] + w[lane]);
            let distance2 = x[0][lane] * x[0][lane] + y[0][lane] * y[0][lane];
            let size = sum[lane].abs();
            let is_sure = (size >= least_sums[lane]) & (size >= distance2 * FAR);
            let depths = u * z[0][lane] + (v[lane] * z[1][lane] + w[lane] * z[2][lane]);
            t[lane] = depths / sum[lane] * per_depth;
            let is_met = (t[lane] > 0.0) & (t[lane] <= t_far);
            surely |= u32::from(is_inside & is_sure & is_met) << lane;
            perhaps |= u32::from(is_inside & !is_sure) << lane;
        }
        Met { surely, perhaps, meetings: [t, v, w, sum] }
    }

    #[inline(always)]
    unsafe fn meeting(meetings: &[[f32; W]; 4], lane: usize, shear: &Shear) -> Meeting {
        let [t, v, w, sum] = meetings.map(|numbers| numbers[lane % W]);
        shear.meeting(t, v, w, sum)
    }

    #[inline(always)]
    unsafe fn prefetch(_: &WideTree<W>, _: Reference) {}
}
