//! Incomplete beta and gamma functions.

/// Continued fractions and series stop here; far more than their arguments need.
const MOST_TERMS: usize = 10_000;
const SMALLEST: f64 = 1e-300;

/// Regularized incomplete beta function I_x(a, b), by the continued fraction of DiDonato and
/// Morris (NIST Handbook of Mathematical Functions, 8.17.22), evaluated by Lentz's method.
pub(super) fn incomplete_beta(x: f64, a: f64, b: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    if x >= 1.0 {
        return 1.0;
    }
    // The fraction converges fast below the mean; above it, the other tail.
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - incomplete_beta(1.0 - x, b, a);
    }
    let log_front = libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b)
        + a * libm::log(x)
        + b * libm::log1p(-x);
    libm::exp(log_front) / (a * beta_fraction(x, a, b))
}

fn beta_fraction(x: f64, a: f64, b: f64) -> f64 {
    let term = |n: usize| {
        let m = (n / 2) as f64;
        let d = a + n as f64;
        if n.is_multiple_of(2) {
            m * (b - m) * x / ((d - 1.0) * d)
        } else {
            -(a + m) * (a + b + m) * x / ((d - 1.0) * d)
        }
    };
    lentz((1..).map(|n| (term(n), 1.0)))
}

/// `1 + n1 / (d1 + n2 / (d2 + ...))`.
fn lentz(terms: impl Iterator<Item = (f64, f64)>) -> f64 {
    let (mut value, mut c, mut d) = (1.0, 1.0, 0.0);
    for (numerator, denominator) in terms.take(MOST_TERMS) {
        d = 1.0 / away_from_zero(denominator + numerator * d);
        c = away_from_zero(denominator + numerator / c);
        value *= c * d;
        if (c * d - 1.0).abs() < f64::EPSILON {
            break;
        }
    }
    value
}

fn away_from_zero(x: f64) -> f64 {
    if x.abs() < SMALLEST { SMALLEST } else { x }
}

/// Regularized lower incomplete gamma function P(a, x) (NIST Handbook, 8.11.4 and 8.9.2).
pub(super) fn incomplete_gamma(a: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let front = libm::exp(a * libm::log(x) - x - libm::lgamma(a));
    if x < a + 1.0 {
        let (mut term, mut sum) = (1.0 / a, 1.0 / a);
        for n in 1..MOST_TERMS {
            term *= x / (a + n as f64);
            sum += term;
            if term < sum * f64::EPSILON {
                break;
            }
        }
        return front * sum;
    }
    // Q(a, x) = front / (x + 1 - a + 1 (a - 1) / (x + 3 - a + ...)).
    let step = |n: usize| {
        let n = n as f64;
        (n * (a - n), x + 2.0 * n + 1.0 - a)
    };
    let first = x + 1.0 - a;
    let scaled = (1..).map(|n| {
        let (numerator, denominator) = step(n);
        let before = if n == 1 { first } else { step(n - 1).1 };
        (numerator / (before * denominator), 1.0)
    });
    1.0 - front / (first * lentz(scaled))
}
