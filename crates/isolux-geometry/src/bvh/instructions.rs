//! Which instructions the kernel uses. The answers are the same bits.

#[cfg(target_arch = "x86_64")]
use super::avx2;
use super::portable::Portable;
use super::traverse;
use super::wide::WideTree;
use crate::{Hit, Ray};

/// A set of instructions that the kernel has code for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstructionSet {
    /// What every processor of the target has.
    Portable,
    /// AVX2 and FMA of x86-64, eight lanes.
    Avx2,
}

impl InstructionSet {
    /// All of them, the fastest last.
    pub const ALL: [Self; 2] = [Self::Portable, Self::Avx2];
}

/// The code for an instruction set that this processor has.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kernel {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2(avx2::Available),
}

impl Kernel {
    /// `None` where this processor lacks the instructions.
    pub(super) fn of(set: InstructionSet) -> Option<Self> {
        match set {
            InstructionSet::Portable => Some(Self::Portable),
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => avx2::Available::detect().map(Self::Avx2),
            #[cfg(not(target_arch = "x86_64"))]
            InstructionSet::Avx2 => None,
        }
    }

    /// The fastest on this processor.
    pub(super) fn fastest() -> Self {
        InstructionSet::ALL.into_iter().rev().find_map(Self::of).unwrap_or(Self::Portable)
    }

    #[inline]
    pub(super) fn closest_hit(self, tree: &WideTree, ray: &Ray) -> Option<Hit> {
        match self {
            Self::Portable => traverse::closest_hit::<Portable>(tree, ray),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(available) => available.closest_hit(tree, ray),
        }
    }

    #[inline]
    pub(super) fn any_hit(self, tree: &WideTree, ray: &Ray) -> bool {
        match self {
            Self::Portable => traverse::any_hit::<Portable>(tree, ray),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(available) => available.any_hit(tree, ray),
        }
    }
}
