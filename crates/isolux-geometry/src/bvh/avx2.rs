//! The tests of eight boxes and eight triangles with AVX2 and FMA.
#![allow(unsafe_code, reason = "vector instructions, reached only where the processor has them")]

use super::slabs::Slabs;
use super::traverse::{self, Entry, Lanes};
use super::triangle_test::Shear;
use super::wide::{Block, Node, WIDTH, WideTree};
use crate::{Hit, Ray};
use std::arch::x86_64::*;

/// Proof that this processor has the instructions used here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Available(());

impl Available {
    /// Asks the processor.
    pub(super) fn detect() -> Option<Self> {
        let all = is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("fma")
            && is_x86_feature_detected!("bmi1")
            && is_x86_feature_detected!("bmi2")
            && is_x86_feature_detected!("lzcnt")
            && is_x86_feature_detected!("popcnt");
        all.then_some(Self(()))
    }

    /// See [`Bvh::closest_hit`](super::Bvh::closest_hit).
    #[inline]
    pub(super) fn closest_hit(self, tree: &WideTree, ray: &Ray) -> Option<Hit> {
        // SAFETY: `self` exists only where `detect` found all features of the function.
        unsafe { closest_hit(tree, ray) }
    }

    /// See [`Bvh::any_hit`](super::Bvh::any_hit).
    #[inline]
    pub(super) fn any_hit(self, tree: &WideTree, ray: &Ray) -> bool {
        // SAFETY: `self` exists only where `detect` found all features of the function.
        unsafe { any_hit(tree, ray) }
    }
}

#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
fn closest_hit(tree: &WideTree, ray: &Ray) -> Option<Hit> {
    traverse::closest_hit::<Avx2>(tree, ray)
}

#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
fn any_hit(tree: &WideTree, ray: &Ray) -> bool {
    traverse::any_hit::<Avx2>(tree, ray)
}

/// Constants of the ray in every lane. Private, and used by nothing but the two functions above.
struct Avx2 {
    inverse: [__m256; 3],
    enter: [__m256; 3],
    leave: [__m256; 3],
    entry_planes: [usize; 3],
    axes: [usize; 3],
    origin: [__m256; 3],
    slope: [__m256; 2],
}

impl Lanes for Avx2 {
    type Distances = __m256;

    #[inline(always)]
    fn new(shear: &Shear, slabs: &Slabs) -> Self {
        Self {
            inverse: all_three(slabs.inverse),
            enter: all_three(slabs.enter),
            leave: all_three(slabs.leave),
            entry_planes: slabs.entry_planes,
            axes: shear.axes,
            origin: all_three(shear.origin),
            slope: [all(shear.slope[0]), all(shear.slope[1])],
        }
    }

    #[inline(always)]
    fn children_met(&self, node: &Node, t_far: f32) -> (__m256, u32) {
        let [x, y, z] = self.entry_planes;
        let enter_x = self.crossing::<0>(node, x, &self.enter);
        let enter_y = self.crossing::<1>(node, y, &self.enter);
        let enter_z = self.crossing::<2>(node, z, &self.enter);
        let leave_x = self.crossing::<0>(node, x ^ 1, &self.leave);
        let leave_y = self.crossing::<1>(node, y ^ 1, &self.leave);
        let leave_z = self.crossing::<2>(node, z ^ 1, &self.leave);
        // SAFETY: only called within `closest_hit` and `any_hit`, which have the feature.
        unsafe {
            // Zero comes last: of equal zeros that one is taken, whose sign is positive.
            let enter = _mm256_max_ps(
                _mm256_max_ps(enter_x, enter_y),
                _mm256_max_ps(enter_z, _mm256_setzero_ps()),
            );
            let leave =
                _mm256_min_ps(_mm256_min_ps(leave_x, leave_y), _mm256_min_ps(leave_z, all(t_far)));
            (enter, _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(enter, leave)) as u32)
        }
    }

    #[inline(always)]
    fn write_met(node: &Node, t: __m256, met: u32, entries: &mut [Entry; WIDTH]) {
        // SAFETY: only called within `closest_hit` and `any_hit`, which have the features. The load
        // reads the eight children, the two stores of 32 bytes fill the eight entries.
        unsafe {
            // The lanes met move to the front, distance above child.
            let order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(ORDER[met as usize & 0xff] as i64));
            let t = _mm256_permutevar8x32_epi32(_mm256_castps_si256(t), order);
            let children = _mm256_loadu_si256(node.children.as_ptr().cast());
            let child = _mm256_permutevar8x32_epi32(children, order);
            let low = _mm256_unpacklo_epi32(child, t);
            let high = _mm256_unpackhi_epi32(child, t);
            let to: *mut __m256i = entries.as_mut_ptr().cast();
            _mm256_storeu_si256(to, _mm256_permute2x128_si256::<0x20>(low, high));
            _mm256_storeu_si256(to.add(1), _mm256_permute2x128_si256::<0x31>(low, high));
        }
    }

    #[inline(always)]
    fn candidates(&self, block: &Block) -> u32 {
        let a = self.sheared(&block.corners[0]);
        let b = self.sheared(&block.corners[1]);
        let c = self.sheared(&block.corners[2]);
        let (u, v, w) = (cross(c, b), cross(a, c), cross(b, a));
        // SAFETY: only called within `closest_hit` and `any_hit`, which have the feature.
        unsafe {
            let least = _mm256_min_ps(u, _mm256_min_ps(v, w));
            let most = _mm256_max_ps(u, _mm256_max_ps(v, w));
            let zero = _mm256_setzero_ps();
            let front = _mm256_cmp_ps::<_CMP_GE_OQ>(least, zero);
            let back = _mm256_cmp_ps::<_CMP_LE_OQ>(most, zero);
            _mm256_movemask_ps(_mm256_or_ps(front, back)) as u32
        }
    }
}

impl Avx2 {
    /// Where the ray crosses eight planes of one axis.
    #[inline(always)]
    fn crossing<const AXIS: usize>(
        &self,
        node: &Node,
        plane: usize,
        offset: &[__m256; 3],
    ) -> __m256 {
        let planes = load(&node.planes[plane]);
        // SAFETY: only called within `closest_hit` and `any_hit`, which have the feature.
        unsafe { _mm256_fmsub_ps(planes, self.inverse[AXIS], offset[AXIS]) }
    }

    /// Eight corners in the sheared space, to the bits of [`Shear`].
    #[inline(always)]
    fn sheared(&self, corners: &[[f32; WIDTH]; 3]) -> [__m256; 2] {
        let [x, y, z] = self.axes;
        // SAFETY: only called within `closest_hit` and `any_hit`, which have the feature.
        unsafe {
            let depth = _mm256_sub_ps(load(&corners[z]), self.origin[2]);
            let across = _mm256_sub_ps(load(&corners[x]), self.origin[0]);
            let up = _mm256_sub_ps(load(&corners[y]), self.origin[1]);
            [
                _mm256_sub_ps(across, _mm256_mul_ps(self.slope[0], depth)),
                _mm256_sub_ps(up, _mm256_mul_ps(self.slope[1], depth)),
            ]
        }
    }
}

#[inline(always)]
fn all(x: f32) -> __m256 {
    // SAFETY: only called within `closest_hit` and `any_hit`, which have the feature.
    unsafe { _mm256_set1_ps(x) }
}

#[inline(always)]
fn all_three([x, y, z]: [f32; 3]) -> [__m256; 3] {
    [all(x), all(y), all(z)]
}

#[inline(always)]
fn load(lanes: &[f32; WIDTH]) -> __m256 {
    // SAFETY: only called within `closest_hit` and `any_hit`, which have the feature; eight lanes
    // are read from an array of eight, wherever it lies.
    unsafe { _mm256_loadu_ps(lanes.as_ptr()) }
}

/// The edge functions. Not fused: rounded products order as the exact ones do, so that the sign of
/// their difference is never the wrong one.
#[inline(always)]
fn cross(p: [__m256; 2], q: [__m256; 2]) -> __m256 {
    // SAFETY: only called within `closest_hit` and `any_hit`, which have the feature.
    unsafe { _mm256_sub_ps(_mm256_mul_ps(p[0], q[1]), _mm256_mul_ps(p[1], q[0])) }
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
