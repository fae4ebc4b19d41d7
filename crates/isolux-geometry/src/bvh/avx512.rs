//! The tests of sixteen boxes and sixteen triangles with AVX-512.
#![allow(unsafe_code, reason = "vector instructions, reached only where the processor has them")]

use super::slabs::Slabs;
use super::traverse::{Entry, Lanes, Met};
use super::triangle_test::{NEAR, Shear, TRUSTED, TRUSTED_M2};
use super::wide::{Leaf, Node, Reference, WideTree};
use std::arch::x86_64::*;
use std::mem::MaybeUninit;

const WIDTH: usize = 16;

/// Needs AVX-512 F, VL, DQ and BW, and what [`Avx2`](super::avx2::Avx2) needs.
pub(super) struct Avx512;

// SAFETY: `push` writes the first eight entries, and the last eight where more are met.
unsafe impl Lanes<WIDTH> for Avx512 {
    type Meetings = [__m512; 4];

    type Distances = __m512i;

    #[inline(always)]
    unsafe fn children_met(node: &Node<WIDTH>, slabs: &Slabs, t_far: f32) -> (__m512i, u32) {
        let (near, far) = slabs.rows(node);
        // SAFETY: the caller sees to the instructions. Rows of a node have sixteen lanes and lie on
        // multiples of 64 bytes.
        unsafe {
            let crossing = |axis: usize, planes: &[f32; WIDTH], offset: &[f32; 3]| {
                let planes = _mm512_load_ps(planes.as_ptr());
                let inverse = _mm512_set1_ps(slabs.inverse[axis]);
                bits(_mm512_fmsub_ps(planes, inverse, _mm512_set1_ps(offset[axis])))
            };
            // As integers: negative numbers order the wrong way round among themselves, but none
            // of them is the greatest beside zero, and the least is one where any is.
            let enter = _mm512_max_epi32(
                _mm512_max_epi32(
                    crossing(0, near[0], &slabs.enter),
                    crossing(1, near[1], &slabs.enter),
                ),
                _mm512_max_epi32(crossing(2, near[2], &slabs.enter), _mm512_setzero_si512()),
            );
            let leave = _mm512_min_epi32(
                _mm512_min_epi32(
                    crossing(0, far[0], &slabs.leave),
                    crossing(1, far[1], &slabs.leave),
                ),
                _mm512_min_epi32(crossing(2, far[2], &slabs.leave), bits(_mm512_set1_ps(t_far))),
            );
            (enter, u32::from(_mm512_cmple_epi32_mask(enter, leave)))
        }
    }

    #[inline(always)]
    unsafe fn push(
        node: &Node<WIDTH>,
        distances: __m512i,
        met: u32,
        free: &mut [MaybeUninit<Entry>; WIDTH],
    ) {
        // SAFETY: the caller sees to the instructions; each store of 64 bytes fills eight entries.
        unsafe {
            // The lanes met move to the front, distance above child.
            let t = _mm512_maskz_compress_epi32(met as u16, distances);
            let children = _mm512_load_si512(node.children.as_ptr().cast());
            let child = _mm512_maskz_compress_epi32(met as u16, children);
            let to: *mut __m512i = free.as_mut_ptr().cast();
            let first = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
            _mm512_storeu_si512(to, _mm512_permutex2var_epi32(child, first, t));
            if met.count_ones() as usize > WIDTH / 2 {
                let last = _mm512_add_epi32(first, _mm512_set1_epi32(8));
                _mm512_storeu_si512(to.add(1), _mm512_permutex2var_epi32(child, last, t));
            }
        }
    }

    #[inline(always)]
    unsafe fn meet(
        leaf: &Leaf<'_>,
        first: usize,
        lanes: u32,
        shear: &Shear,
        t_far: f32,
    ) -> Option<Met<[__m512; 4]>> {
        // SAFETY: the caller sees to the instructions. A row of a leaf is followed by as many words
        // as there are lanes, and more.
        unsafe {
            let rows = leaf.first_corners(shear.axes, first);
            let corner = |k: usize| rows.map(|row| row.wrapping_add(k * leaf.corner_stride()));
            let a = sheared(corner(0), shear);
            let b = sheared(corner(1), shear);
            let c = sheared(corner(2), shear);
            let (u, v, w) = (cross(&c, &b), cross(&a, &c), cross(&b, &a));
            let zero = _mm512_setzero_ps();
            let least = _mm512_min_ps(u, _mm512_min_ps(v, w));
            let most = _mm512_max_ps(u, _mm512_max_ps(v, w));
            let front = _mm512_cmp_ps_mask::<_CMP_GE_OQ>(least, zero);
            let back = _mm512_cmp_ps_mask::<_CMP_LE_OQ>(most, zero);
            let inside = u32::from(front | back) & lanes;
            if inside == 0 {
                return None;
            }
            let sum = _mm512_add_ps(u, _mm512_add_ps(v, w));
            let size = _mm512_abs_ps(sum);
            let depths = _mm512_add_ps(
                _mm512_mul_ps(u, a[2]),
                _mm512_add_ps(_mm512_mul_ps(v, b[2]), _mm512_mul_ps(w, c[2])),
            );
            // The distance times the size of the sum; dividing can wait for those that are left.
            let signed = _mm512_xor_ps(depths, _mm512_and_ps(sum, _mm512_set1_ps(-0.0)));
            let distance = _mm512_mul_ps(signed, _mm512_set1_ps(shear.per_depth));
            let sure = sure([&a, &b, &c], [least, most], size, depths);
            let end = _mm512_mul_ps(size, _mm512_set1_ps(Shear::beyond(t_far)));
            let ahead = _mm512_cmp_ps_mask::<_CMP_GE_OQ>(distance, zero);
            let near = _mm512_cmp_ps_mask::<_CMP_LE_OQ>(distance, end);
            let met = inside & (u32::from(ahead & near) | !sure);
            if met == 0 {
                return None;
            }
            Some(Met { likely: met & sure, perhaps: met & !sure, meetings: [depths, v, w, sum] })
        }
    }

    #[inline(always)]
    unsafe fn sums(meetings: &[__m512; 4], lane: usize) -> [f32; 4] {
        // SAFETY: the caller sees to the instructions.
        meetings.map(|numbers| unsafe { one(numbers, lane) })
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
unsafe fn sheared([x, y, z]: [*const f32; 3], shear: &Shear) -> [__m512; 3] {
    // SAFETY: a row of a leaf is followed by sixteen words and more.
    unsafe {
        let from_origin = |row: *const f32, k: usize| {
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

/// A bit for each triangle that `f32` decides, from its corners, the least and the greatest edge
/// function, the size of their sum, and the weighted sum of depths, to the bits of [`Shear`]. None
/// where anything is NaN.
///
/// # Safety
/// Needs the instructions of [`Avx512`].
#[inline(always)]
unsafe fn sure(
    [a, b, c]: [&[__m512; 3]; 3],
    [least, most]: [__m512; 2],
    size: __m512,
    depths: __m512,
) -> u32 {
    // SAFETY: the caller sees to the instructions.
    unsafe {
        let larger = |x: __m512, y: __m512| _mm512_range_ps::<0b1011>(x, y);
        let across = larger(larger(larger(a[0], a[1]), larger(b[0], b[1])), larger(c[0], c[1]));
        let all = larger(across, larger(a[2], larger(b[2], c[2])));
        let square = _mm512_mul_ps(across, across);
        let enough = _mm512_add_ps(
            _mm512_mul_ps(square, _mm512_set1_ps(TRUSTED)),
            _mm512_set1_ps(TRUSTED_M2),
        );
        let range = _mm512_sub_ps(
            _mm512_max_ps(a[2], _mm512_max_ps(b[2], c[2])),
            _mm512_min_ps(a[2], _mm512_min_ps(b[2], c[2])),
        );
        let of_range = _mm512_mul_ps(_mm512_mul_ps(across, range), _mm512_set1_ps(NEAR[0]));
        let of_size = _mm512_mul_ps(size, _mm512_set1_ps(NEAR[1]));
        let near = _mm512_mul_ps(all, _mm512_add_ps(of_range, of_size));
        let trusted = _mm512_cmp_ps_mask::<_CMP_GE_OQ>(size, enough);
        let away = _mm512_cmp_ps_mask::<_CMP_GT_OQ>(_mm512_abs_ps(depths), near);
        let zero = _mm512_setzero_ps();
        let front = _mm512_cmp_ps_mask::<_CMP_GT_OQ>(least, zero);
        let back = _mm512_cmp_ps_mask::<_CMP_LT_OQ>(most, zero);
        u32::from(trusted & away & (front | back))
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

/// The number in a lane.
///
/// # Safety
/// Needs the instructions of [`Avx512`].
#[inline(always)]
unsafe fn one(lanes: __m512, lane: usize) -> f32 {
    let mut numbers = [0.0_f32; WIDTH];
    // SAFETY: the caller sees to the instructions; as many numbers as lanes are written.
    unsafe { _mm512_storeu_ps(numbers.as_mut_ptr(), lanes) };
    numbers[lane % WIDTH]
}

/// # Safety
/// Needs the instructions of [`Avx512`].
#[inline(always)]
unsafe fn bits(x: __m512) -> __m512i {
    // SAFETY: the caller sees to the instructions.
    unsafe { _mm512_castps_si512(x) }
}
