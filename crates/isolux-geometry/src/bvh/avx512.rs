//! The tests of sixteen boxes and sixteen triangles with AVX-512.
#![allow(unsafe_code, reason = "vector instructions, reached only where the processor has them")]

use super::slabs::Slabs;
use super::traverse::{Entry, Lanes, Met};
use super::triangle_test::{FAR, Meeting, Shear};
use super::wide::{Leaf, Node, Reference, WideTree};
use std::arch::x86_64::*;
use std::mem::MaybeUninit;

const WIDTH: usize = 16;

/// Needs AVX-512 F, VL, DQ and BW, and what [`Avx2`](super::avx2::Avx2) needs.
pub(super) struct Avx512;

// SAFETY: `push_met` writes the first eight entries, and the last eight where more are met.
unsafe impl Lanes<WIDTH> for Avx512 {
    type Meetings = [__m512; 4];

    #[inline(always)]
    unsafe fn push_met(
        node: &Node<WIDTH>,
        slabs: &Slabs,
        t_far: f32,
        free: &mut [MaybeUninit<Entry>; WIDTH],
    ) -> usize {
        let [x, y, z] = slabs.entry_planes;
        // SAFETY: the caller sees to the instructions. Rows of a node have sixteen lanes and lie on
        // multiples of 64 bytes; each store of 64 bytes fills eight entries.
        unsafe {
            let crossing = |axis: usize, plane: usize, offset: &[f32; 3]| {
                let planes = _mm512_load_ps(node.planes[plane].as_ptr());
                let inverse = _mm512_set1_ps(slabs.inverse[axis]);
                bits(_mm512_fmsub_ps(planes, inverse, _mm512_set1_ps(offset[axis])))
            };
            // As integers: negative numbers order the wrong way round among themselves, but none
            // of them is the greatest beside zero, and the least is one where any is.
            let enter = _mm512_max_epi32(
                _mm512_max_epi32(crossing(0, x, &slabs.enter), crossing(1, y, &slabs.enter)),
                _mm512_max_epi32(crossing(2, z, &slabs.enter), _mm512_setzero_si512()),
            );
            let leave = _mm512_min_epi32(
                _mm512_min_epi32(
                    crossing(0, x ^ 1, &slabs.leave),
                    crossing(1, y ^ 1, &slabs.leave),
                ),
                _mm512_min_epi32(crossing(2, z ^ 1, &slabs.leave), bits(_mm512_set1_ps(t_far))),
            );
            let met = _mm512_cmple_epi32_mask(enter, leave);
            let count = met.count_ones() as usize;
            // The lanes met move to the front, distance above child.
            let t = _mm512_maskz_compress_epi32(met, enter);
            let children = _mm512_load_si512(node.children.as_ptr().cast());
            let child = _mm512_maskz_compress_epi32(met, children);
            let to: *mut __m512i = free.as_mut_ptr().cast();
            let first = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
            _mm512_storeu_si512(to, _mm512_permutex2var_epi32(child, first, t));
            if count > WIDTH / 2 {
                let last = _mm512_add_epi32(first, _mm512_set1_epi32(8));
                _mm512_storeu_si512(to.add(1), _mm512_permutex2var_epi32(child, last, t));
            }
            count
        }
    }

    #[inline(always)]
    unsafe fn meet(leaf: &Leaf<'_>, first: usize, shear: &Shear, t_far: f32) -> Met<[__m512; 4]> {
        // SAFETY: the caller sees to the instructions. A row of a leaf is followed by as many words
        // as there are lanes, and more.
        unsafe {
            let a = sheared(leaf, 0, first, shear);
            let b = sheared(leaf, 1, first, shear);
            let c = sheared(leaf, 2, first, shear);
            let (u, v, w) = (cross(&c, &b), cross(&a, &c), cross(&b, &a));
            let zero = _mm512_setzero_ps();
            let least = _mm512_min_ps(u, _mm512_min_ps(v, w));
            let most = _mm512_max_ps(u, _mm512_max_ps(v, w));
            let front = _mm512_cmp_ps_mask::<_CMP_GE_OQ>(least, zero);
            let back = _mm512_cmp_ps_mask::<_CMP_LE_OQ>(most, zero);
            let inside = front | back;
            let sum = _mm512_add_ps(u, _mm512_add_ps(v, w));
            let least = _mm512_loadu_ps(leaf.least_sums(first));
            let distance2 = _mm512_add_ps(_mm512_mul_ps(a[0], a[0]), _mm512_mul_ps(a[1], a[1]));
            let far = _mm512_mul_ps(distance2, _mm512_set1_ps(FAR));
            let least = _mm512_max_ps(least, far);
            let sure = _mm512_cmp_ps_mask::<_CMP_GE_OQ>(_mm512_abs_ps(sum), least);
            let depths = _mm512_add_ps(
                _mm512_mul_ps(u, a[2]),
                _mm512_add_ps(_mm512_mul_ps(v, b[2]), _mm512_mul_ps(w, c[2])),
            );
            let t = _mm512_mul_ps(_mm512_div_ps(depths, sum), _mm512_set1_ps(shear.per_depth));
            let ahead = _mm512_cmp_ps_mask::<_CMP_GT_OQ>(t, zero);
            let near = _mm512_cmp_ps_mask::<_CMP_LE_OQ>(t, _mm512_set1_ps(t_far));
            Met {
                surely: u32::from(inside & sure & ahead & near),
                perhaps: u32::from(inside & !sure),
                meetings: [t, v, w, sum],
            }
        }
    }

    #[inline(always)]
    unsafe fn meeting(meetings: &[__m512; 4], lane: usize, shear: &Shear) -> Meeting {
        let [t, v, w, sum] = meetings.map(|lanes| {
            let mut numbers = [0.0_f32; WIDTH];
            // SAFETY: the caller sees to the instructions; as many numbers as lanes are written.
            unsafe { _mm512_storeu_ps(numbers.as_mut_ptr(), lanes) };
            numbers[lane % WIDTH]
        });
        shear.meeting(t, v, w, sum)
    }

    #[inline(always)]
    unsafe fn prefetch(tree: &WideTree<WIDTH>, reference: Reference) {
        let (start, lines) = tree.lines_of(reference);
        for line in 0..lines {
            // SAFETY: prefetching reads nothing and may be given any address.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(start.wrapping_add(line).cast()) };
        }
    }
}

/// Sixteen corners in the sheared space, to the bits of [`Shear`].
///
/// # Safety
/// Needs the instructions of [`Avx512`].
#[inline(always)]
unsafe fn sheared(leaf: &Leaf<'_>, corner: usize, first: usize, shear: &Shear) -> [__m512; 3] {
    let [x, y, z] = shear.axes;
    // SAFETY: a row of a leaf is followed by sixteen words and more.
    unsafe {
        let from_origin = |axis: usize, k: usize| {
            let row = leaf.coordinates(corner, axis, first);
            _mm512_sub_ps(_mm512_loadu_ps(row), _mm512_set1_ps(shear.origin[k]))
        };
        let depth = from_origin(z, 2);
        let moved = |k: usize| _mm512_mul_ps(_mm512_set1_ps(shear.slope[k]), depth);
        [
            _mm512_sub_ps(from_origin(x, 0), moved(0)),
            _mm512_sub_ps(from_origin(y, 1), moved(1)),
            depth,
        ]
    }
}

/// The edge functions. Not fused: rounded products order as the exact ones do, so that the sign of
/// their difference is never the wrong one.
///
/// # Safety
/// Needs the instructions of [`Avx512`].
#[inline(always)]
unsafe fn cross(p: &[__m512; 3], q: &[__m512; 3]) -> __m512 {
    // SAFETY: the caller sees to the instructions.
    unsafe { _mm512_sub_ps(_mm512_mul_ps(p[0], q[1]), _mm512_mul_ps(p[1], q[0])) }
}

/// # Safety
/// Needs the instructions of [`Avx512`].
#[inline(always)]
unsafe fn bits(x: __m512) -> __m512i {
    // SAFETY: the caller sees to the instructions.
    unsafe { _mm512_castps_si512(x) }
}
