//! Arithmetic with the vector instructions of the processor at hand.
#![allow(unsafe_code, reason = "vector instructions, reached only where the processor has them")]

use crate::bvh::InstructionSet;

/// Work that is compiled once for each set of vector instructions: as far as it is always inlined.
pub trait Vectorized {
    /// What comes of it.
    type Output;

    /// Does it. Implementations are marked `#[inline(always)]`, as is what they call, or it runs as ever.
    fn run(self) -> Self::Output;
}

/// Does some work with the widest vector instructions that there are. The results are the same bits, as no products and sums are
/// fused.
#[inline]
pub fn with_vectors<W: Vectorized>(work: W) -> W::Output {
    match InstructionSet::fastest() {
        InstructionSet::Portable => work.run(),
        // SAFETY: the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => unsafe { with_avx2(work) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => unsafe { with_avx512(work) },
        #[cfg(not(target_arch = "x86_64"))]
        InstructionSet::Avx2 | InstructionSet::Avx512 => unreachable!("not available"),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn with_avx2<W: Vectorized>(work: W) -> W::Output {
    work.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,avx2")]
fn with_avx512<W: Vectorized>(work: W) -> W::Output {
    work.run()
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Sum([f64; 64]);

    impl Vectorized for Sum {
        type Output = f64;

        #[inline(always)]
        fn run(self) -> f64 {
            self.0.iter().map(|x| (x * x + 0.3) / (x + 1.7)).sum()
        }
    }

    #[test]
    fn the_bits_are_the_same() {
        let numbers = || Sum(std::array::from_fn(|k| 0.1 + k as f64 / 7.0));
        assert_eq!(with_vectors(numbers()).to_bits(), numbers().run().to_bits());
    }
}
