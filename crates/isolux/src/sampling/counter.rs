//! Counter-based random numbers.

/// Names one random number, or a family of them: a hash of everything it is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key(u64);

impl Key {
    /// The family of a seed.
    pub const fn new(seed: u64) -> Self {
        Self(mix(seed ^ 0x6a09_e667_f3bc_c908))
    }

    /// The member of the family for `index` (an increment, a receiver, a dimension, ...).
    pub const fn with(self, index: u64) -> Self {
        Self(mix(self.0 ^ mix(index.wrapping_add(0x9e37_79b9_7f4a_7c15))))
    }

    /// 64 random bits.
    pub const fn bits(self) -> u64 {
        mix(self.0)
    }

    /// 32 random bits.
    pub const fn bits32(self) -> u32 {
        (self.bits() >> 32) as u32
    }

    /// A number of [0, 1).
    pub const fn uniform(self) -> f64 {
        // 53 bits fill the significand exactly.
        (self.bits() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }
}

/// A bijection of 64 bits in which every input bit changes every output bit with probability one
/// half: the finalizer of SplitMix64 with the constants of Stafford's variant 13 (Steele, Lea,
/// Flood 2014, "Fast splittable pseudorandom number generators").
const fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::Key;

    #[test]
    fn families_do_not_depend_on_each_other() {
        // Correlation of n pairs of independent numbers has standard deviation 1 / sqrt(n); five of
        // them is a chance of 6e-7.
        let n = 100_000_u64;
        for (a, b) in [(1, 2), (0, u64::MAX), (7, 8)] {
            let product = |k| {
                let x = Key::new(a).with(k).uniform() - 0.5;
                let y = Key::new(b).with(k).uniform() - 0.5;
                12.0 * x * y
            };
            let correlation = (0..n).map(product).sum::<f64>() / n as f64;
            assert!(correlation.abs() < 5.0 / (n as f64).sqrt(), "{a} {b}: {correlation}");
        }
    }

    #[test]
    fn numbers_are_uniform() {
        let n = 1_000_000_u64;
        let mut cells = [0_u32; 64];
        for k in 0..n {
            cells[(Key::new(3).with(k).uniform() * 64.0) as usize] += 1;
        }
        let expected = n as f64 / 64.0;
        let chi2: f64 = cells.iter().map(|&c| (f64::from(c) - expected).powi(2) / expected).sum();
        // 63 degrees of freedom: mean 63, standard deviation 11.2; five of them on either side.
        assert!((chi2 - 63.0).abs() < 56.0, "{chi2}");
    }
}
