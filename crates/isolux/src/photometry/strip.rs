//! A strip of the sphere between two polar angles over which intensity is linear in the angle:
//! its flux per radian of azimuth, and the angle below which lies a given part of it.

/// Polar angles in radians, 0 at the axis, and the intensities at them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip {
    /// Bounds, rad, increasing, within 0 to pi.
    pub(super) angles_rad: [f64; 2],
    /// Intensity at the bounds, cd.
    pub(super) intensities_cd: [f64; 2],
}

impl Strip {
    /// The integral of intensity times sin(angle), lm per radian of azimuth.
    pub(super) fn flux(&self) -> f64 {
        let [low, high] = weights(self.angles_rad);
        low * self.intensities_cd[0] + high * self.intensities_cd[1]
    }

    fn intensity_at(&self, angle: f64) -> f64 {
        let [low, high] = self.angles_rad;
        let weight = (angle - low) / (high - low);
        self.intensities_cd[0] * (1.0 - weight) + self.intensities_cd[1] * weight
    }

    /// The part of the strip below an angle inside it.
    pub(super) fn below(&self, angle: f64) -> Self {
        Self {
            angles_rad: [self.angles_rad[0], angle],
            intensities_cd: [self.intensities_cd[0], self.intensity_at(angle)],
        }
    }

    /// The angle below which the strip holds `flux`; the inverse of [`Self::flux`] of a part.
    ///
    /// Newton's method on the closed form, inside a bracket that every step shrinks; where the step
    /// leaves the bracket (no intensity, the pole) it is halved instead. A Newton step squares the
    /// error, in widths of the strip, so that one below 1e-9 was the last; halving alone would
    /// take 64. Strips of tables are narrow: their sines and cosines are those of their middle and polynomials.
    pub(super) fn angle_below_which(&self, flux: f64) -> f64 {
        let [low, high] = self.angles_rad;
        match Narrow::of(self) {
            Some(narrow) => {
                let half = narrow.half_rad;
                let from_middle = newton([-half, half], narrow.first_guess(flux), |t| {
                    (narrow.flux_below(t) - flux, narrow.density(t))
                });
                (narrow.middle_rad + from_middle).clamp(low, high)
            }
            None => newton(self.angles_rad, self.first_guess(flux), |angle| {
                let excess = self.below(angle).flux() - flux;
                (excess, self.intensity_at(angle) * libm::sin(angle))
            }),
        }
    }

    /// The answer if intensity were linear in the cosine of the angle.
    fn first_guess(&self, flux: f64) -> f64 {
        let [low, high] = self.angles_rad;
        let share = share_below(self.intensities_cd, flux / self.flux());
        // cos(low) - cos(angle) is a share of the whole; half angles avoid cancellation.
        let square = |angle: f64| {
            let sine = libm::sin(0.5 * angle);
            sine * sine
        };
        let sine = (square(low) + share * (square(high) - square(low))).clamp(0.0, 1.0).sqrt();
        let guess = 2.0 * libm::asin(sine);
        if guess > low && guess < high { guess } else { 0.5 * (low + high) }
    }
}

/// Where in a bracket an increasing function is zero, which is given with its slope.
fn newton([mut low, mut high]: [f64; 2], guess: f64, f: impl Fn(f64) -> (f64, f64)) -> f64 {
    let width = high - low;
    let mut at = guess;
    for _ in 0..64 {
        let (excess, slope) = f(at);
        if excess > 0.0 {
            high = at;
        } else {
            low = at;
        }
        let newton = at - excess / slope;
        let inside = newton > low && newton < high;
        let next = if inside { newton } else { 0.5 * (low + high) };
        let step = (next - at).abs();
        at = next;
        let enough = if inside { 1e-9 * width } else { 0.0 };
        if step <= enough.max(f64::EPSILON * at.abs()) {
            break;
        }
    }
    at
}

/// A strip about its middle, over which `sin(middle + t) = sin(middle) cos(t) + cos(middle) sin(t)`.
struct Narrow {
    middle_rad: f64,
    half_rad: f64,
    sin_middle: f64,
    cos_middle: f64,
    /// Intensity in the middle, cd, and its slope, cd/rad.
    intensity_cd: f64,
    slope: f64,
    /// The integral from the middle to the lower bound.
    at_low: f64,
}

impl Narrow {
    /// `None` for a strip so wide that the polynomials do not hold.
    fn of(strip: &Strip) -> Option<Self> {
        let [low, high] = strip.angles_rad;
        let (middle_rad, half_rad) = (0.5 * (low + high), 0.5 * (high - low));
        if !(half_rad > 0.0 && half_rad < SERIES_UP_TO) {
            return None;
        }
        let (sin_middle, cos_middle) = libm::sincos(middle_rad);
        let [of_low, of_high] = strip.intensities_cd;
        let (intensity_cd, slope) = (0.5 * (of_low + of_high), (of_high - of_low) / (high - low));
        let narrow =
            Self { middle_rad, half_rad, sin_middle, cos_middle, intensity_cd, slope, at_low: 0.0 };
        Some(Self { at_low: narrow.integral(-half_rad), ..narrow })
    }

    /// Flux below an angle from the middle.
    fn flux_below(&self, t: f64) -> f64 {
        self.integral(t) - self.at_low
    }

    /// Flux between the middle and an angle from it.
    fn integral(&self, t: f64) -> f64 {
        let (sine, versine) = small_sine(t);
        let even = self.sin_middle * sine + self.cos_middle * versine;
        let odd =
            self.sin_middle * (t * sine - versine) + self.cos_middle * t * first_moment(t.abs());
        self.intensity_cd * even + self.slope * odd
    }

    /// Flux per angle.
    fn density(&self, t: f64) -> f64 {
        let (sine, versine) = small_sine(t);
        let sine = self.sin_middle * (1.0 - versine) + self.cos_middle * sine;
        (self.intensity_cd + self.slope * t) * sine
    }

    /// The answer if the density were linear.
    fn first_guess(&self, flux: f64) -> f64 {
        let half = self.half_rad;
        let ends = [-half, half].map(|t| self.density(t).max(0.0));
        (2.0 * share_below(ends, flux / self.flux_below(half)) - 1.0) * half
    }
}

/// Largest angle for which the series are taken, rad.
const SERIES_UP_TO: f64 = 0.5;

/// Sine and one minus cosine of an angle no greater than that: terms left out are below 1e-16 of them.
fn small_sine(t: f64) -> (f64, f64) {
    const SINE: [f64; 7] = [
        1.0,
        -1.0 / 6.0,
        1.0 / 120.0,
        -1.0 / 5040.0,
        1.0 / 362_880.0,
        -1.0 / 39_916_800.0,
        1.0 / 6_227_020_800.0,
    ];
    const VERSINE: [f64; 7] = [
        0.5,
        -1.0 / 24.0,
        1.0 / 720.0,
        -1.0 / 40_320.0,
        1.0 / 3_628_800.0,
        -1.0 / 479_001_600.0,
        1.0 / 87_178_291_200.0,
    ];
    let x = t * t;
    let series = |terms: &[f64; 7]| terms.iter().rev().fold(0.0, |sum, term| sum * x + term);
    (t * series(&SINE), x * series(&VERSINE))
}

/// What each end contributes to the integral of a linear function times the sine:
/// `[w0, w1]` with `integral = w0 f(low) + w1 f(high)`. Neither is negative.
///
/// With m the middle and h the half width, the integral of sin is `2 sin m sin h` and that of
/// `(angle - m) sin` is `2 cos m (sin h - h cos h)`: no difference of nearly equal numbers is left.
pub(super) fn weights([low, high]: [f64; 2]) -> [f64; 2] {
    let (m, h) = (0.5 * (low + high), 0.5 * (high - low));
    let (sin_m, cos_m) = libm::sincos(m);
    let (even, odd) = (sin_m * libm::sin(h), cos_m * first_moment(h));
    [(even - odd).max(0.0), (even + odd).max(0.0)]
}

/// `(sin h - h cos h) / h` for h >= 0.
fn first_moment(h: f64) -> f64 {
    // The series' first term left out, h^12 / 2 / 11!! of the sum, is below one rounding there.
    if h < SERIES_UP_TO {
        const TERMS: [f64; 6] = [
            1.0 / 3.0,
            -1.0 / 30.0,
            1.0 / 840.0,
            -1.0 / 45_360.0,
            1.0 / 3_991_680.0,
            -1.0 / 518_918_400.0,
        ];
        let x = h * h;
        x * TERMS.iter().rev().fold(0.0, |sum, term| sum * x + term)
    } else {
        libm::sin(h) / h - libm::cos(h)
    }
}

/// Where, from 0 to 1, a linear density with the given values at the ends has `share` of its
/// integral behind it. The quadratic is solved in the form without cancellation.
pub(super) fn share_below([low, high]: [f64; 2], share: f64) -> f64 {
    let mean = 0.5 * (low + high);
    if mean <= 0.0 {
        return 0.5;
    }
    let root = (low * low + share * (high * high - low * low)).max(0.0).sqrt();
    let at = 2.0 * share * mean / (low + root);
    if at.is_finite() { at.clamp(0.0, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Simpson's rule with so many panels that its error, (h/n)^4, is below the tolerance used.
    fn simpson(strip: &Strip) -> f64 {
        let [low, high] = strip.angles_rad;
        let n = 20_000;
        let h = (high - low) / f64::from(n);
        let f = |k: i32| {
            let angle = low + h * f64::from(k);
            strip.intensity_at(angle) * libm::sin(angle)
        };
        let inner: f64 = (1..n).map(|k| f(k) * if k % 2 == 1 { 4.0 } else { 2.0 }).sum();
        (f(0) + inner + f(n)) * h / 3.0
    }

    fn strips() -> Vec<Strip> {
        let bounds = [
            [0.0, PI],
            [0.0, 1e-3],
            [0.0, 0.4],
            [0.3, 1.9],
            [1.5, 1.6],
            [3.0, PI],
            [PI - 1e-4, PI],
        ];
        let ends = [[1.0, 1.0], [0.0, 1.0], [1.0, 0.0], [3.0, 0.1], [1e-9, 7.0]];
        bounds
            .iter()
            .flat_map(|&angles_rad| ends.map(|intensities_cd| Strip { angles_rad, intensities_cd }))
            .collect()
    }

    #[test]
    fn flux_is_the_integral() {
        for strip in strips() {
            let (exact, sum) = (strip.flux(), simpson(&strip));
            // 20,000 additions, each rounded; and near the upper pole the strip itself is known
            // only to the rounding of its angles.
            let angles = 8.0 * f64::EPSILON * (strip.angles_rad[1] - strip.angles_rad[0]);
            let peak = strip.intensities_cd[0].max(strip.intensities_cd[1]);
            assert!(
                (exact - sum).abs() <= 1e-12 * sum + angles * peak,
                "{strip:?}: {exact} against {sum}"
            );
        }
    }

    #[test]
    fn the_moment_is_smooth_where_the_series_ends() {
        let (below, above) = (first_moment(0.5 - 1e-12), first_moment(0.5 + 1e-12));
        // The closed form loses two digits to cancellation there: sin(h)/h - cos(h) = 0.08.
        assert!((above - below).abs() < 1e-12, "{below} {above}");
    }

    #[test]
    fn the_inverse_inverts() {
        for strip in strips() {
            let whole = strip.flux();
            for k in 0..=100 {
                let flux = whole * f64::from(k) / 100.0;
                let angle = strip.angle_below_which(flux);
                let [low, high] = strip.angles_rad;
                assert!(angle >= low && angle <= high);
                let back = strip.below(angle).flux();
                // Angles are known to a rounding of their own size; the flux is this steep.
                let peak = strip.intensities_cd[0].max(strip.intensities_cd[1]);
                let steep = peak * (libm::sin(angle) * angle + (high - low) * low);
                let allowed = 8.0 * f64::EPSILON * (whole + steep);
                assert!((back - flux).abs() <= allowed, "{strip:?} {k}: {back} against {flux}");
            }
        }
    }

    #[test]
    fn a_linear_density_is_halved_where_its_triangle_is() {
        // Tolerance: a square root and a division.
        let near = |a: f64, b: f64| assert!((a - b).abs() < 4.0 * f64::EPSILON, "{a} {b}");
        near(share_below([0.0, 1.0], 0.25), 0.5);
        near(share_below([1.0, 0.0], 0.75), 0.5);
        near(share_below([2.0, 2.0], 0.3), 0.3);
        near(share_below([0.0, 1.0], 0.0), 0.0);
        near(share_below([1.0, 0.0], 1.0), 1.0);
        near(share_below([0.0, 0.0], 0.7), 0.5);
    }
}
