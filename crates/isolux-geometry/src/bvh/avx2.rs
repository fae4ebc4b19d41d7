//! The tests of eight boxes and eight triangles with AVX2 and FMA.
#![allow(unsafe_code, reason = "vector instructions, reached only where the processor has them")]

use super::slabs::Slabs;
use super::traverse::{Entry, Lanes, Met};
use super::triangle_test::{NEAR, Shear, TRUSTED, TRUSTED_M2};
use super::wide::{Leaf, Node, Reference, WideTree};
use std::arch::x86_64::*;
use std::mem::MaybeUninit;

const WIDTH: usize = 8;

/// Needs AVX2, FMA, BMI1, BMI2, LZCNT and POPCNT.
pub(super) struct Avx2;

// SAFETY: `push` writes all of the eight entries, which it was given.
unsafe impl Lanes<WIDTH> for Avx2 {
    type Meetings = [__m256; 4];

    type Distances = __m256i;

    #[inline(always)]
    unsafe fn children_met(node: &Node<WIDTH>, slabs: &Slabs, t_far: f32) -> (__m256i, u32) {
        let (near, far) = slabs.rows(node);
        // SAFETY: the caller sees to the instructions. Rows of a node have eight lanes and lie on
        // multiples of 32 bytes.
        unsafe {
            let crossing = |axis: usize, planes: &[f32; WIDTH], offset: &[f32; 3]| {
                let planes = _mm256_load_ps(planes.as_ptr());
                let inverse = _mm256_set1_ps(slabs.inverse[axis]);
                bits(_mm256_fmsub_ps(planes, inverse, _mm256_set1_ps(offset[axis])))
            };
            // As integers: negative numbers order the wrong way round among themselves, but none
            // of them is the greatest beside zero, and the least is one where any is.
            let enter = _mm256_max_epi32(
                _mm256_max_epi32(
                    crossing(0, near[0], &slabs.enter),
                    crossing(1, near[1], &slabs.enter),
                ),
                _mm256_max_epi32(crossing(2, near[2], &slabs.enter), _mm256_setzero_si256()),
            );
            let leave = _mm256_min_epi32(
                _mm256_min_epi32(
                    crossing(0, far[0], &slabs.leave),
                    crossing(1, far[1], &slabs.leave),
                ),
                _mm256_min_epi32(crossing(2, far[2], &slabs.leave), bits(_mm256_set1_ps(t_far))),
            );
            let missed = _mm256_castsi256_ps(_mm256_cmpgt_epi32(enter, leave));
            (enter, !_mm256_movemask_ps(missed) as u32 & 0xff)
        }
    }

    #[inline(always)]
    unsafe fn push(
        node: &Node<WIDTH>,
        distances: __m256i,
        met: u32,
        free: &mut [MaybeUninit<Entry>; WIDTH],
    ) {
        // SAFETY: the caller sees to the instructions; two stores of 32 bytes fill eight entries.
        unsafe {
            // The lanes met move to the front, distance above child.
            let order = ORDER[met as usize & 0xff] as i64;
            let order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(order));
            let t = _mm256_permutevar8x32_epi32(distances, order);
            let children = _mm256_load_si256(node.children.as_ptr().cast());
            let child = _mm256_permutevar8x32_epi32(children, order);
            let low = _mm256_unpacklo_epi32(child, t);
            let high = _mm256_unpackhi_epi32(child, t);
            let to: *mut __m256i = free.as_mut_ptr().cast();
            _mm256_storeu_si256(to, _mm256_permute2x128_si256::<0x20>(low, high));
            _mm256_storeu_si256(to.add(1), _mm256_permute2x128_si256::<0x31>(low, high));
        }
    }

    #[inline(always)]
    unsafe fn meet(
        leaf: &Leaf<'_>,
        first: usize,
        lanes: u32,
        shear: &Shear,
        t_far: f32,
    ) -> Option<Met<[__m256; 4]>> {
        // SAFETY: the caller sees to the instructions. A row of a leaf is followed by as many words
        // as there are lanes, and more.
        unsafe {
            let rows = leaf.first_corners(shear.axes, first);
            let corner = |k: usize| rows.map(|row| row.wrapping_add(k * leaf.corner_stride()));
            let a = sheared(corner(0), shear);
            let b = sheared(corner(1), shear);
            let c = sheared(corner(2), shear);
            let (u, v, w) = (cross(&c, &b), cross(&a, &c), cross(&b, &a));
            let zero = _mm256_setzero_ps();
            let least = _mm256_min_ps(u, _mm256_min_ps(v, w));
            let most = _mm256_max_ps(u, _mm256_max_ps(v, w));
            let front = _mm256_cmp_ps::<_CMP_GE_OQ>(least, zero);
            let back = _mm256_cmp_ps::<_CMP_LE_OQ>(most, zero);
            let inside = _mm256_movemask_ps(_mm256_or_ps(front, back)) as u32 & lanes;
            if inside == 0 {
                return None;
            }
            let sum = _mm256_add_ps(u, _mm256_add_ps(v, w));
            let size = size_of(sum);
            let depths = _mm256_add_ps(
                _mm256_mul_ps(u, a[2]),
                _mm256_add_ps(_mm256_mul_ps(v, b[2]), _mm256_mul_ps(w, c[2])),
            );
            // The distance times the size of the sum; dividing can wait for those that are left.
            let signed = _mm256_xor_ps(depths, _mm256_and_ps(sum, _mm256_set1_ps(-0.0)));
            let distance = _mm256_mul_ps(signed, _mm256_set1_ps(shear.per_depth));
            let sure = sure([&a, &b, &c], [least, most], size, depths);
            let end = _mm256_mul_ps(size, _mm256_set1_ps(Shear::beyond(t_far)));
            let ahead = _mm256_cmp_ps::<_CMP_GE_OQ>(distance, zero);
            let near = _mm256_cmp_ps::<_CMP_LE_OQ>(distance, end);
            let within = _mm256_movemask_ps(_mm256_and_ps(ahead, near)) as u32;
            let met = inside & (within | !sure);
            if met == 0 {
                return None;
            }
            Some(Met { likely: met & sure, perhaps: met & !sure, meetings: [depths, v, w, sum] })
        }
    }

    #[inline(always)]
    unsafe fn sums(meetings: &[__m256; 4], lane: usize) -> [f32; 4] {
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

/// Eight corners in the sheared space, to the bits of [`Shear`].
///
/// # Safety
/// Needs the instructions of [`Avx2`].
#[inline(always)]
unsafe fn sheared([x, y, z]: [*const f32; 3], shear: &Shear) -> [__m256; 3] {
    // SAFETY: a row of a leaf is followed by eight words and more.
    unsafe {
        let from_origin = |row: *const f32, k: usize| {
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

/// A bit for each triangle that `f32` decides, from its corners, the least and the greatest edge
/// function, the size of their sum, and the weighted sum of depths, to the bits of [`Shear`]. None
/// where anything is NaN.
///
/// # Safety
/// Needs the instructions of [`Avx2`].
#[inline(always)]
unsafe fn sure(
    [a, b, c]: [&[__m256; 3]; 3],
    [least, most]: [__m256; 2],
    size: __m256,
    depths: __m256,
) -> u32 {
    // SAFETY: the caller sees to the instructions.
    unsafe {
        let larger = |x: __m256, y: __m256| _mm256_max_ps(size_of(x), size_of(y));
        let across = larger(larger(larger(a[0], a[1]), larger(b[0], b[1])), larger(c[0], c[1]));
        let all = larger(across, larger(a[2], larger(b[2], c[2])));
        let square = _mm256_mul_ps(across, across);
        let enough = _mm256_add_ps(
            _mm256_mul_ps(square, _mm256_set1_ps(TRUSTED)),
            _mm256_set1_ps(TRUSTED_M2),
        );
        let range = _mm256_sub_ps(
            _mm256_max_ps(a[2], _mm256_max_ps(b[2], c[2])),
            _mm256_min_ps(a[2], _mm256_min_ps(b[2], c[2])),
        );
        let of_range = _mm256_mul_ps(_mm256_mul_ps(across, range), _mm256_set1_ps(NEAR[0]));
        let of_size = _mm256_mul_ps(size, _mm256_set1_ps(NEAR[1]));
        let near = _mm256_mul_ps(all, _mm256_add_ps(of_range, of_size));
        let trusted = _mm256_cmp_ps::<_CMP_GE_OQ>(size, enough);
        let away = _mm256_cmp_ps::<_CMP_GT_OQ>(size_of(depths), near);
        let zero = _mm256_setzero_ps();
        let front = _mm256_cmp_ps::<_CMP_GT_OQ>(least, zero);
        let back = _mm256_cmp_ps::<_CMP_LT_OQ>(most, zero);
        let sure = _mm256_and_ps(_mm256_and_ps(trusted, away), _mm256_or_ps(front, back));
        _mm256_movemask_ps(sure) as u32
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

/// Numbers without their signs.
///
/// # Safety
/// Needs the instructions of [`Avx2`].
#[inline(always)]
unsafe fn size_of(x: __m256) -> __m256 {
    // SAFETY: the caller sees to the instructions.
    unsafe { _mm256_andnot_ps(_mm256_set1_ps(-0.0), x) }
}

/// The number in a lane.
///
/// # Safety
/// Needs the instructions of [`Avx2`].
#[inline(always)]
unsafe fn one(lanes: __m256, lane: usize) -> f32 {
    let mut numbers = [0.0_f32; WIDTH];
    // SAFETY: the caller sees to the instructions; as many numbers as lanes are written.
    unsafe { _mm256_storeu_ps(numbers.as_mut_ptr(), lanes) };
    numbers[lane % WIDTH]
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
