//! Which instructions the kernel uses, each with the tree that suits it. The answers are the same
//! bits.
#![allow(unsafe_code, reason = "vector instructions, reached only where the processor has them")]

use super::batch::trace_many;
use super::bounds::Bounds;
use super::build::{BinaryNode, Preset};
use super::collapse::collapse;
use super::local::Local;
use super::portable::Portable;
use super::traverse::{Query, trace};
use super::wide::{Labelled, TooLarge, WideTree};
#[cfg(target_arch = "x86_64")]
use super::{avx2::Avx2, avx512::Avx512};
use crate::{Point, Ray};

/// A set of instructions that the kernel has code for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstructionSet {
    /// What every processor of the target has.
    Portable,
    /// AVX2 and FMA of x86-64, eight lanes.
    Avx2,
    /// AVX-512 (F, VL, DQ, BW) of x86-64, sixteen lanes.
    Avx512,
}

impl InstructionSet {
    /// All of them, the fastest last.
    pub const ALL: [Self; 3] = [Self::Portable, Self::Avx2, Self::Avx512];

    /// Whether this processor has them.
    pub fn is_available(self) -> bool {
        match self {
            Self::Portable => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => has_avx2(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => has_avx2() && has_avx512(),
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 | Self::Avx512 => false,
        }
    }

    /// The fastest on this processor.
    pub fn fastest() -> Self {
        let available = |set: &Self| set.is_available();
        Self::ALL.into_iter().rev().find(available).unwrap_or(Self::Portable)
    }
}

#[cfg(target_arch = "x86_64")]
fn has_avx2() -> bool {
    is_x86_feature_detected!("avx2")
        && is_x86_feature_detected!("fma")
        && is_x86_feature_detected!("bmi1")
        && is_x86_feature_detected!("bmi2")
        && is_x86_feature_detected!("lzcnt")
        && is_x86_feature_detected!("popcnt")
}

#[cfg(target_arch = "x86_64")]
fn has_avx512() -> bool {
    is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512bw")
}

/// A tree, and the code that walks it. Those of vector instructions exist only where the processor
/// has them: [`Kernel::collapse`] alone makes them.
#[derive(Clone, Debug)]
pub(super) enum Kernel {
    Portable(WideTree<8>),
    #[cfg(target_arch = "x86_64")]
    Avx2(WideTree<8>),
    #[cfg(target_arch = "x86_64")]
    Avx512(WideTree<16>),
}

impl Kernel {
    /// From the binary hierarchy, for a set of instructions that is available.
    pub(super) fn collapse(
        preset: Preset,
        set: InstructionSet,
        binary: &[BinaryNode],
        triangle: impl Fn(u32) -> Labelled + Sync,
    ) -> Result<Self, TooLarge> {
        assert!(set.is_available(), "this processor has no {set:?}");
        Ok(match set {
            InstructionSet::Portable => Self::Portable(collapse(preset, binary, triangle)?),
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => Self::Avx2(collapse(preset, binary, triangle)?),
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => Self::Avx512(collapse(preset, binary, triangle)?),
            #[cfg(not(target_arch = "x86_64"))]
            InstructionSet::Avx2 | InstructionSet::Avx512 => unreachable!("not available"),
        })
    }

    /// Bytes of the tree.
    pub(super) fn bytes(&self) -> usize {
        match self {
            Self::Portable(tree) => tree.bytes(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(tree) => tree.bytes(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(tree) => tree.bytes(),
        }
    }

    /// The box around everything.
    pub(super) fn bounds(&self) -> Bounds {
        match self {
            Self::Portable(tree) => tree.bounds,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(tree) => tree.bounds,
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(tree) => tree.bounds,
        }
    }

    /// The answer about one ray.
    #[inline]
    pub(super) fn trace<Q: Query>(&self, ray: &Local) -> Q::Answer {
        match self {
            // SAFETY: no special instructions are needed.
            Self::Portable(tree) => unsafe { trace::<_, Portable, Q>(tree, ray) },
            // SAFETY: the kernel exists, so the processor has the instructions.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(tree) => unsafe { trace_with_avx2::<Q>(tree, ray) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(tree) => unsafe { trace_with_avx512::<Q>(tree, ray) },
        }
    }

    /// The answers about many rays, by their place, in any order; with the rays comes the origin of the kernel.
    pub(super) fn trace_many<Q: Query>(
        &self,
        rays: (&[Ray], Point),
        tell: impl FnMut(usize, Q::Answer),
    ) {
        match self {
            // SAFETY: no special instructions are needed.
            Self::Portable(tree) => unsafe { trace_many::<_, Portable, Q>(tree, rays, tell) },
            // SAFETY: the kernel exists, so the processor has the instructions.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(tree) => unsafe { trace_many_with_avx2::<Q>(tree, rays, tell) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(tree) => unsafe { trace_many_with_avx512::<Q>(tree, rays, tell) },
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
fn trace_with_avx2<Q: Query>(tree: &WideTree<8>, ray: &Local) -> Q::Answer {
    // SAFETY: this function has the instructions.
    unsafe { trace::<_, Avx2, Q>(tree, ray) }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
fn trace_many_with_avx2<Q: Query>(
    tree: &WideTree<8>,
    rays: (&[Ray], Point),
    tell: impl FnMut(usize, Q::Answer),
) {
    // SAFETY: this function has the instructions.
    unsafe { trace_many::<_, Avx2, Q>(tree, rays, tell) }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
fn trace_with_avx512<Q: Query>(tree: &WideTree<16>, ray: &Local) -> Q::Answer {
    // SAFETY: this function has the instructions.
    unsafe { trace::<_, Avx512, Q>(tree, ray) }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
fn trace_many_with_avx512<Q: Query>(
    tree: &WideTree<16>,
    rays: (&[Ray], Point),
    tell: impl FnMut(usize, Q::Answer),
) {
    // SAFETY: this function has the instructions.
    unsafe { trace_many::<_, Avx512, Q>(tree, rays, tell) }
}
