//! Owen-scrambled Sobol points, padded in pairs of dimensions.
//!
//! Each pair of dimensions is a (0, 2)-sequence in base 2 (Sobol 1967, its first two dimensions)
//! under a nested uniform scramble (Owen 1995), computed by the hash of Laine and Karras (2011).
//! Further pairs are the same sequence in an order shuffled by the same kind of scramble, so that
//! they do not depend on each other (Burley 2020, "Practical hash-based Owen scrambling"). Indices
//! have 32 bits, numbers have 32 bits: no repetition before four thousand million points.

use super::Key;

/// A randomized low-discrepancy sequence: for every index a row of numbers of [0, 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sequence {
    key: Key,
    /// Seeds of the scrambles of the first pair, which most points are asked for.
    first: [u32; 2],
}

impl Sequence {
    /// The sequence scrambled by a key. Sequences of different keys do not depend on each other.
    pub const fn new(key: Key) -> Self {
        Self { key, first: seeds(key.with(0)) }
    }

    /// Dimensions `2 pair` and `2 pair + 1` of point `index`. Of pair 0, any aligned block of 2^k
    /// indices is a (0, k, 2)-net; of the others, the first 2^k indices are.
    #[inline]
    pub const fn pair(self, index: u32, pair: u32) -> [f64; 2] {
        let (index, [first, second]) = if pair == 0 {
            (index, self.first)
        } else {
            let key = self.key.with(pair as u64);
            (scramble(index, key.with(2).bits32()), seeds(key))
        };
        let x = scramble_reversed(index, first);
        let y = scramble_reversed(sobol_second_reversed(index), second);
        [fraction(x), fraction(y)]
    }

    /// A sequence in the place of dimensions `2 pair` and `2 pair + 1` of point `index`, which does
    /// not depend on this one.
    pub const fn fork(self, index: u32, pair: u32) -> Self {
        // Above all 32-bit numbers: no pair has this key.
        Self::new(self.key.with(1 << 32 | pair as u64).with(index as u64))
    }
}

/// Seeds of the scrambles of a pair.
const fn seeds(key: Key) -> [u32; 2] {
    [key.with(0).bits32(), key.with(1).bits32()]
}

const fn fraction(bits: u32) -> f64 {
    bits as f64 * (1.0 / (1u64 << 32) as f64)
}

/// Bits of the second Sobol dimension, least significant first: the generator matrix is Pascal's
/// triangle modulo 2, applied to the index by a butterfly.
const fn sobol_second_reversed(index: u32) -> u32 {
    // In reversed order the matrix is upper triangular in Pascal's pattern, which factors into five
    // shifts (as a Reed-Muller transform).
    let mut x = index;
    x ^= (x & 0xaaaa_aaaa) >> 1;
    x ^= (x & 0xcccc_cccc) >> 2;
    x ^= (x & 0xf0f0_f0f0) >> 4;
    x ^= (x & 0xff00_ff00) >> 8;
    x ^= (x & 0xffff_0000) >> 16;
    x
}

/// Nested uniform scramble of a number given by its reversed bits; the result is in normal order.
const fn scramble_reversed(reversed: u32, seed: u32) -> u32 {
    laine_karras(reversed, seed).reverse_bits()
}

/// Nested uniform scramble of a number.
const fn scramble(x: u32, seed: u32) -> u32 {
    laine_karras(x.reverse_bits(), seed).reverse_bits()
}

/// Each output bit depends on the seed and on lower bits alone: on a reversed number, a nested
/// scramble. The constants are those of Vegdahl (2021), found by search for even flips.
const fn laine_karras(mut x: u32, seed: u32) -> u32 {
    x = x.wrapping_add(seed);
    x ^= x.wrapping_mul(0x6c50_b47c);
    x ^= x.wrapping_mul(0xb82f_1e52);
    x ^= x.wrapping_mul(0xc7af_e638);
    x ^= x.wrapping_mul(0x8d22_f6e6);
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every elementary interval of area 2^-k holds exactly one of the first 2^k points.
    fn is_net(points: &[[f64; 2]], k: u32) -> bool {
        (0..=k).all(|a| {
            let (across, down) = (1_usize << a, 1_usize << (k - a));
            let mut seen = vec![false; across * down];
            points.iter().all(|[x, y]| {
                let cell = (x * across as f64) as usize * down + (y * down as f64) as usize;
                !std::mem::replace(&mut seen[cell], true)
            })
        })
    }

    #[test]
    fn every_pair_is_a_net_and_so_is_every_block_of_the_first() {
        for seed in 0..20 {
            let sequence = Sequence::new(Key::new(seed));
            for pair in 0..4 {
                let points: Vec<_> = (0..256).map(|i| sequence.pair(i, pair)).collect();
                assert!(is_net(&points, 8), "seed {seed} pair {pair}");
            }
            let block: Vec<_> = (7 * 64..8 * 64).map(|i| sequence.pair(i, 0)).collect();
            assert!(is_net(&block, 6), "seed {seed}");
        }
    }

    #[test]
    fn the_mean_over_scrambles_is_the_integral() {
        // x y over the unit square, 16 points; the spread of the scrambles gives the tolerance.
        let estimate = |seed: u64| {
            let sequence = Sequence::new(Key::new(seed));
            (0..16).map(|i| sequence.pair(i, 1)).map(|[x, y]| x * y).sum::<f64>() / 16.0
        };
        let values: Vec<f64> = (0..4000).map(estimate).collect();
        let mean = values.iter().sum::<f64>() / 4000.0;
        let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / 3999.0;
        assert!((mean - 0.25).abs() < 5.0 * (variance / 4000.0).sqrt(), "{mean}");
        // Independent points would spread by 0.055; a net of 16 must do far better.
        assert!(variance.sqrt() < 0.02, "{}", variance.sqrt());
    }

    #[test]
    fn the_points_do_not_repeat_past_65536() {
        let sequence = Sequence::new(Key::new(1));
        assert_ne!(sequence.pair(5, 0), sequence.pair(5 + 65_536, 0));
        assert_ne!(sequence.pair(5, 1), sequence.pair(5 + 65_536, 1));
    }
}
