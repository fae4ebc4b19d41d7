//! The tests of many boxes and triangles in plain Rust, for every machine.
#![allow(
    unsafe_code,
    reason = "`Lanes` is for vector instructions; nothing here needs its promise"
)]

use super::slabs::Slabs;
use super::traverse::{Entry, Lanes, Met};
use super::triangle_test::{Shear, is_sure};
use super::wide::{Leaf, Node, Reference, WideTree};
use std::mem::MaybeUninit;

/// Loops over lanes that the compiler turns into whatever vectors the target has.
pub(super) struct Portable;

// SAFETY: entries are written one after the other from the first, and their number is returned; no
// special instructions are needed.
unsafe impl<const W: usize> Lanes<W> for Portable {
    type Meetings = [[f32; W]; 4];

    type Distances = [f32; W];

    #[inline(always)]
    unsafe fn children_met(node: &Node<W>, slabs: &Slabs, t_far: f32) -> ([f32; W], u32) {
        let Slabs { inverse, enter, leave, .. } = slabs;
        let (near, far) = slabs.rows(node);
        let (mut t_enter, mut t_leave) = ([0.0_f32; W], [t_far; W]);
        for axis in 0..3 {
            for lane in 0..W {
                let a = near[axis][lane] * inverse[axis] - enter[axis];
                let b = far[axis][lane] * inverse[axis] - leave[axis];
                t_enter[lane] = if a > t_enter[lane] { a } else { t_enter[lane] };
                t_leave[lane] = if b < t_leave[lane] { b } else { t_leave[lane] };
            }
        }
        let met =
            (0..W).fold(0_u32, |met, lane| met | u32::from(t_enter[lane] <= t_leave[lane]) << lane);
        (t_enter, met)
    }

    #[inline(always)]
    unsafe fn push(
        node: &Node<W>,
        distances: [f32; W],
        mut met: u32,
        free: &mut [MaybeUninit<Entry>; W],
    ) {
        for entry in &mut free[..met.count_ones() as usize] {
            let lane = met.trailing_zeros();
            met &= met - 1;
            entry.write(Entry::new(distances[lane as usize % W], node.child(lane)));
        }
    }

    #[inline(always)]
    unsafe fn meet(
        leaf: &Leaf<'_>,
        first: usize,
        lanes: u32,
        shear: &Shear,
        t_far: f32,
    ) -> Option<Met<[[f32; W]; 4]>> {
        let Shear { axes, origin, slope, per_depth, .. } = shear;
        // SAFETY: `W` numbers of a row can be read, and any bits are a number.
        let numbers = |row: *const f32| unsafe { *row.cast::<[f32; W]>() };
        let (mut x, mut y, mut z) = ([[0.0_f32; W]; 3], [[0.0; W]; 3], [[0.0; W]; 3]);
        for corner in 0..3 {
            let to_corner = corner * leaf.corner_stride();
            let rows = leaf.first_corners(*axes, first);
            let [row_x, row_y, row_z] = rows.map(|row| numbers(row.wrapping_add(to_corner)));
            for lane in 0..W {
                let depth = row_z[lane] - origin[2];
                x[corner][lane] = row_x[lane] - origin[0] - slope[0] * depth;
                y[corner][lane] = row_y[lane] - origin[1] - slope[1] * depth;
                z[corner][lane] = depth;
            }
        }
        let [mut u, mut v, mut w] = [[0.0_f32; W]; 3];
        let mut inside = 0;
        for lane in 0..W {
            let cross = |p: usize, q: usize| x[p][lane] * y[q][lane] - y[p][lane] * x[q][lane];
            (u[lane], v[lane], w[lane]) = (cross(2, 1), cross(0, 2), cross(1, 0));
            let is_front = (u[lane] >= 0.0) & (v[lane] >= 0.0) & (w[lane] >= 0.0);
            let is_back = (u[lane] <= 0.0) & (v[lane] <= 0.0) & (w[lane] <= 0.0);
            inside |= u32::from(is_front | is_back) << lane;
        }
        inside &= lanes;
        if inside == 0 {
            return None;
        }
        let [mut depths, mut sum] = [[0.0_f32; W]; 2];
        let t_end = Shear::beyond(t_far);
        let (mut within, mut sure) = (0, 0);
        for lane in 0..W {
            sum[lane] = u[lane] + (v[lane] + w[lane]);
            let size = sum[lane].abs();
            depths[lane] = u[lane] * z[0][lane] + (v[lane] * z[1][lane] + w[lane] * z[2][lane]);
            // The distance times the size of the sum; dividing can wait for those that are left.
            let distance = if sum[lane] < 0.0 { -depths[lane] } else { depths[lane] } * per_depth;
            let corner = |k: usize| [x[k][lane], y[k][lane], z[k][lane]];
            let corners = [corner(0), corner(1), corner(2)];
            let is_sure = is_sure(corners, [u[lane], v[lane], w[lane]], size, depths[lane]);
            sure |= u32::from(is_sure) << lane;
            within |= u32::from((distance >= 0.0) & (distance <= size * t_end)) << lane;
        }
        let met = inside & (within | !sure);
        if met == 0 {
            return None;
        }
        Some(Met { likely: met & sure, perhaps: met & !sure, meetings: [depths, v, w, sum] })
    }

    #[inline(always)]
    unsafe fn sums(meetings: &[[f32; W]; 4], lane: usize) -> [f32; 4] {
        meetings.map(|numbers| numbers[lane % W])
    }

    #[inline(always)]
    unsafe fn prefetch(_: &WideTree<W>, _: Reference) {}
}
