//! Samples fall where the intensity says, by Pearson's chi-square over equal solid angles.

use super::*;

const RINGS: usize = 20;
const SECTORS: usize = 24;
const SAMPLES: usize = 200_000;

/// SplitMix64 (Steele, Lea, Flood 2014): 53 bits of the next number of a seeded sequence.
fn uniform(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Bins are even in cos(gamma) and C. Beams narrower than a ring are stretched to fill the first
/// ones: bins are even in 1 - cos up to `widest`, the rest of the sphere is one bin.
struct Bins {
    widest: f64,
}

impl Bins {
    fn index(&self, direction: Direction) -> usize {
        let v = direction.to_vector();
        let ring = (1.0 + v.z) / self.widest * RINGS as f64;
        let turn = libm::atan2(v.y, v.x) / std::f64::consts::TAU;
        let sector = (turn - turn.floor()) * SECTORS as f64;
        (ring as usize).min(RINGS) * SECTORS + (sector as usize).min(SECTORS - 1)
    }

    /// Share of the flux in each bin, by the midpoint rule inside it.
    fn expected(&self, distribution: &IntensityDistribution) -> Vec<f64> {
        const FINE: usize = 48;
        let flux = distribution.luminous_flux_lm();
        let mut shares = vec![0.0; (RINGS + 1) * SECTORS];
        let rings = |k: usize, low: f64, high: f64, shares: &mut Vec<f64>| {
            let count = k * FINE;
            let step = (high - low) / count as f64;
            for i in 0..count {
                let cap = low + (i as f64 + 0.5) * step;
                let sine = (cap * (2.0 - cap)).sqrt();
                for j in 0..SECTORS * FINE {
                    let c = std::f64::consts::TAU * (j as f64 + 0.5) / (SECTORS * FINE) as f64;
                    let (s, co) = libm::sincos(c);
                    let d = Vector::new(sine * co, sine * s, cap - 1.0).direction().unwrap();
                    let solid_angle = step * std::f64::consts::TAU / (SECTORS * FINE) as f64;
                    shares[self.index(d)] += distribution.intensity_cd(d) * solid_angle / flux;
                }
            }
        };
        rings(RINGS, 0.0, self.widest, &mut shares);
        if self.widest < 2.0 {
            rings(2, self.widest, 2.0, &mut shares);
        }
        shares
    }
}

/// The value that chi-square with so many degrees of freedom exceeds once in a million trials
/// (Wilson, Hilferty 1931); the normal distribution exceeds 4.753 as rarely.
fn one_in_a_million(freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * freedom);
    freedom * (1.0 - spread + 4.753 * spread.sqrt()).powi(3)
}

fn check(name: &str, distribution: &IntensityDistribution, widest: f64) {
    let bins = Bins { widest };
    let expected = bins.expected(distribution);
    let mut counts = vec![0_usize; expected.len()];
    let mut state = 1;
    for _ in 0..SAMPLES {
        let u = [uniform(&mut state), uniform(&mut state)];
        counts[bins.index(distribution.sample(u).unwrap())] += 1;
    }
    // Bins that expect fewer than ten are joined into one, so that the approximation holds.
    let (mut chi2, mut freedom, mut rare) = (0.0, -1.0, (0.0, 0.0));
    for (&share, &count) in expected.iter().zip(&counts) {
        let (mean, count) = (share * SAMPLES as f64, count as f64);
        if mean < 10.0 {
            rare = (rare.0 + mean, rare.1 + count);
        } else {
            chi2 += (count - mean) * (count - mean) / mean;
            freedom += 1.0;
        }
    }
    if rare.0 >= 10.0 {
        chi2 += (rare.1 - rare.0) * (rare.1 - rare.0) / rare.0;
        freedom += 1.0;
    } else {
        assert!(rare.1 <= 40.0, "{name}: {} samples where {} were expected", rare.1, rare.0);
    }
    assert!(freedom > 20.0, "{name}: the bins see nothing");
    let limit = one_in_a_million(freedom);
    assert!(chi2 < limit, "{name}: chi-square {chi2} beyond {limit} at {freedom} degrees");
}

#[test]
fn samples_follow_intensity() {
    for (name, distribution) in every_kind() {
        check(name, &distribution, if name == "narrow beam" { 0.1 } else { 2.0 });
    }
}

#[test]
fn the_test_sees_a_wrong_sampler() {
    // Samples of one web held against another, up to 20 % brighter at every second angle.
    let one = every_kind().remove(6).1;
    let IntensityDistribution::Web(web) = &one else { panic!("not a web") };
    let candela: Vec<f64> =
        web.candela().iter().enumerate().map(|(k, cd)| cd * (1.0 + 0.2 * (k % 2) as f64)).collect();
    let other =
        PhotometricWeb::new(web.planes_deg().to_vec(), web.gammas_deg().to_vec(), candela).unwrap();
    let bins = Bins { widest: 2.0 };
    let expected = bins.expected(&IntensityDistribution::Web(Arc::new(other)));
    let mut counts = vec![0_usize; expected.len()];
    let mut state = 1;
    for _ in 0..SAMPLES {
        let u = [uniform(&mut state), uniform(&mut state)];
        counts[bins.index(one.sample(u).unwrap())] += 1;
    }
    let terms = expected.iter().zip(&counts).filter(|(share, _)| **share * SAMPLES as f64 >= 10.0);
    let (chi2, freedom) = terms.fold((0.0, 0.0), |(chi2, freedom), (&share, &count)| {
        let mean = share * SAMPLES as f64;
        (chi2 + (count as f64 - mean) * (count as f64 - mean) / mean, freedom + 1.0)
    });
    assert!(chi2 > one_in_a_million(freedom), "{chi2} at {freedom} degrees");
}

#[test]
fn the_corners_of_the_unit_square_are_directions_with_light() {
    for (name, distribution) in every_kind() {
        for a in [0.0, 1.0 - f64::EPSILON / 2.0] {
            for b in [0.0, 1.0 - f64::EPSILON / 2.0] {
                let d = distribution.sample([a, b]).unwrap().to_vector();
                assert!(d.x.is_finite() && d.y.is_finite() && d.z.is_finite(), "{name} {a} {b}");
            }
        }
    }
}
