//! The tests of eight boxes and eight triangles with AVX2 and FMA.
#![allow(unsafe_code, reason = "vector instructions, reached only where the processor has them")]

use super::slabs::Slabs;
use super::traverse::{Entry, Lanes, Met};
use super::triangle_test::{FAR, Meeting, Shear};
use super::wide::{Leaf, Node, Reference, WideTree};
use std::arch::x86_64::*;
use std::mem::MaybeUninit;

const WIDTH: usize = 8;

/// Needs AVX2, FMA, BMI1, BMI2, LZCNT and POPCNT.
pub(super) struct Avx2;

// SAFETY: `push_met` writes the first `count_ones` of eight entries, which it was given.
unsafe impl Lanes<WIDTH> for Avx2 {
    type Meetings = [__m256; 4];

    #[inline(always)]
    unsafe fn push_met(
        node: &Node<WIDTH>,
        slabs: &Slabs,
        t_far: f32,
        free: &mut [MaybeUninit<Entry>; WIDTH],
    ) -> usize {
        let [x, y, z] = slabs.entry_planes;
        // SAFETY: the caller sees to the instructions. Rows of a node have eight lanes and lie on
        // multiples of 32 bytes; the two stores of 32 bytes fill the eight entries.
        unsafe {
            let crossing = |axis: usize, plane: usize, offset: &[f32; 3]| {
                let planes = _mm256_load_ps(node.planes[plane].as_ptr());
                let inverse = _mm256_set1_ps(slabs.inverse[axis]);
                bits(_mm256_fmsub_ps(planes, inverse, _mm256_set1_ps(offset[axis])))
            };
            // As integers: negative numbers order the wrong way round among themselves, but none
            // of them is the greatest beside zero, and the least is one where any is.
            let enter = _mm256_max_epi32(
                _mm256_max_epi32(crossing(0, x, &slabs.enter), crossing(1, y, &slabs.enter)),
                _mm256_max_epi32(crossing(2, z, &slabs.enter), _mm256_setzero_si256()),
            );
            let leave = _mm256_min_epi32(
                _mm256_min_epi32(
                    crossing(0, x ^ 1, &slabs.leave),
                    crossing(1, y ^ 1, &slabs.leave),
                ),
                _mm256_min_epi32(crossing(2, z ^ 1, &slabs.leave), bits(_mm256_set1_ps(t_far))),
            );
            let missed = _mm256_castsi256_ps(_mm256_cmpgt_epi32(enter, leave));
            let met = !_mm256_movemask_ps(missed) as u32 & 0xff;
            // The lanes met move to the front, distance above child.
            let order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(ORDER[met as usize] as i64));
            let t = _mm256_permutevar8x32_epi32(enter, order);
            let children = _mm256_load_si256(node.children.as_ptr().cast());
            let child = _mm256_permutevar8x32_epi32(children, order);
            let low = _mm256_unpacklo_epi32(child, t);
            let high = _mm256_unpackhi_epi32(child, t);
            let to: *mut __m256i = free.as_mut_ptr().cast();
            _mm256_storeu_si256(to, _mm256_permute2x128_si256::<0x20>(low, high));
            _mm256_storeu_si256(to.add(1), _mm256_permute2x128_si256::<0x31>(low, high));
            met.count_ones() as usize
        }
    }

    #[inline(always)]
    unsafe fn meet(leaf: &Leaf<'_>, first: usize, shear: &Shear, t_far: f32) -> Met<[__m256; 4]> {
        // SAFETY: the caller sees to the instructions. A row of a leaf is followed by as many words
        // as there are lanes, and more.
        unsafe {
            let a = sheared(leaf, 0, first, shear);
            let b = sheared(leaf, 1, first, shear);
            let c = sheared(leaf, 2, first, shear);
            let (u, v, w) = (cross(&c, &b), cross(&a, &c), cross(&b, &a));
            let zero = _mm256_setzero_ps();
            let front = _mm256_cmp_ps::<_CMP_GE_OQ>(_mm256_min_ps(u, _mm256_min_ps(v, w)), zero);
            let back = _mm256_cmp_ps::<_CMP_LE_OQ>(_mm256_max_ps(u, _mm256_max_ps(v, w)), zero);
            let inside = _mm256_or_ps(front, back);
            let sum = _mm256_add_ps(u, _mm256_add_ps(v, w));
            let size = _mm256_andnot_ps(_mm256_set1_ps(-0.0), sum);
            let least = _mm256_loadu_ps(leaf.least_sums(first));
            let distance2 = _mm256_add_ps(_mm256_mul_ps(a[0], a[0]), _mm256_mul_ps(a[1], a[1]));
            let far = _mm256_mul_ps(distance2, _mm256_set1_ps(FAR));
            let sure = _mm256_cmp_ps::<_CMP_GE_OQ>(size, _mm256_max_ps(least, far));
            let depths = _mm256_add_ps(
                _mm256_mul_ps(u, a[2]),
                _mm256_add_ps(_mm256_mul_ps(v, b[2]), _mm256_mul_ps(w, c[2])),
            );
            let t = _mm256_mul_ps(_mm256_div_ps(depths, sum), _mm256_set1_ps(shear.per_depth));
            let ahead = _mm256_cmp_ps::<_CMP_GT_OQ>(t, zero);
            let near = _mm256_cmp_ps::<_CMP_LE_OQ>(t, _mm256_set1_ps(t_far));
            let met = _mm256_and_ps(inside, _mm256_and_ps(ahead, near));
            Met {
                surely: _mm256_movemask_ps(_mm256_and_ps(met, sure)) as u32,
                perhaps: _mm256_movemask_ps(_mm256_andnot_ps(sure, inside)) as u32,
                meetings: [t, v, w, sum],
            }
        }
    }

    #[inline(always)]
    unsafe fn meeting(meetings: &[__m256; 4], lane: usize, shear: &Shear) -> Meeting {
        let [t, v, w, sum] = meetings.map(|lanes| {
            let mut numbers = [0.0_f32; WIDTH];
            // SAFETY: the caller sees to the instructions; as many numbers as lanes are written.
            unsafe { _mm256_storeu_ps(numbers.as_mut_ptr(), lanes) };
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

/// Eight corners in the sheared space, to the bits of [`Shear`].
///
/// # Safety
/// Needs the instructions of [`Avx2`].
#[inline(always)]
unsafe fn sheared(leaf: &Leaf<'_>, corner: usize, first: usize, shear: &Shear) -> [__m256; 3] {
    let [x, y, z] = shear.axes;
    // SAFETY: a row of a leaf is followed by eight words and more.
    unsafe {
        let from_origin = |axis: usize, k: usize| {
            let row = leaf.coordinates(corner, axis, first);
            _mm256_sub_ps(_mm256_loadu_ps(row), _mm256_set1_ps(shear.origin[k]))
        };
        let depth = from_origin(z, 2);
        let moved = |k: usize| _mm256_mul_ps(_mm256_set1_ps(shear.slope[k]), depth);
        [
            _mm256_sub_ps(from_origin(x, 0), moved(0)),
            _mm256_sub_ps(from_origin(y, 1), moved(1)),
            depth,
        ]
    }
}

/// The edge functions. Not fused: rounded products order as the exact ones do, so that the sign of
/// their difference is never the wrong one.
///
/// # Safety
/// Needs the instructions of [`Avx2`].
#[inline(always)]
unsafe fn cross(p: &[__m256; 3], q: &[__m256; 3]) -> __m256 {
    // SAFETY: the caller sees to the instructions.
    unsafe { _mm256_sub_ps(_mm256_mul_ps(p[0], q[1]), _mm256_mul_ps(p[1], q[0])) }
}

/// # Safety
/// Needs the instructions of [`Avx2`].
#[inline(always)]
unsafe fn bits(x: __m256) -> __m256i {
    // SAFETY: the caller sees to the instructions.
    unsafe { _mm256_castps_si256(x) }
}

/// For every set of lanes, those in it from the lowest up, a byte each.
static ORDER: [u64; 256] = {
    let mut table = [0; 256];
    let mut set = 0;
    while set < 256 {
        let (mut lane, mut count) = (0, 0);
        while lane < WIDTH {
            if set >> lane & 1 == 1 {
                table[set] |= (lane as u64) << (8 * count);
                count += 1;
            }
            lane += 1;
        }
        set += 1;
    }
    table
};
