//! The all-weather sky: luminance from measured irradiances.
//!
//! R. Perez, R. Seals and J. Michalsky, "All-weather model for sky luminance distribution: preliminary configuration and
//! validation", Solar Energy 50 (1993) 235-245, erratum 51 (1993) 423, gives the form of the sky. Its illuminance and that of the
//! sun follow from irradiances by the luminous efficacies of R. Perez, P. Ineichen, R. Seals, J. Michalsky and R. Stewart, "Modeling
//! daylight availability and irradiance components from direct and global irradiance", Solar Energy 44 (1990) 271-289.

use super::GeneralSky;
use isolux_geometry::Direction;
use std::f64::consts::{FRAC_PI_2, PI};

/// Irradiance of a surface that faces the sun outside of the atmosphere, at the mean distance, W/m2 (Perez 1990).
const SOLAR_CONSTANT_W_M2: f64 = 1367.0;

/// Upper ends of the bins of clearness but for the last (1990, table 1).
const CLEARNESS_BINS: [f64; 7] = [1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2];

/// The weight of the third power of the zenith angle in clearness (1990, equation 1).
const KAPPA: f64 = 1.041;

/// Clearness and brightness that the model was fitted to; measurements beyond are taken as these.
const MOST_CLEARNESS: f64 = 11.9;
const BRIGHTNESS: [f64; 2] = [0.01, 0.6];

/// Between these clearnesses a lower brightness than this gives skies that are nowhere measured; `gendaylit` and `gendaymtx` of
/// Radiance have the same limit.
const DIM_CLEARNESS: [f64; 2] = [1.065, 2.8];
const DIM_BRIGHTNESS: f64 = 0.2;

/// By bin of clearness: four coefficients for each of a, b, c, d, e (1993, table 1).
const COEFFICIENTS: [[[f64; 4]; 5]; 8] = [
    [
        [1.3525, -0.2576, -0.2690, -1.4366],
        [-0.7670, 0.0007, 1.2734, -0.1233],
        [2.8000, 0.6004, 1.2375, 1.0000],
        [1.8734, 0.6297, 0.9738, 0.2809],
        [0.0356, -0.1246, -0.5718, 0.9938],
    ],
    [
        [-1.2219, -0.7730, 1.4148, 1.1016],
        [-0.2054, 0.0367, -3.9128, 0.9156],
        [6.9750, 0.1774, 6.4477, -0.1239],
        [-1.5798, -0.5081, -1.7812, 0.1080],
        [0.2624, 0.0672, -0.2190, -0.4285],
    ],
    [
        [-1.1000, -0.2515, 0.8952, 0.0156],
        [0.2782, -0.1812, -4.5000, 1.1766],
        [24.7219, -13.0812, -37.7000, 34.8438],
        [-5.0000, 1.5218, 3.9229, -2.6204],
        [-0.0156, 0.1597, 0.4199, -0.5562],
    ],
    [
        [-0.5484, -0.6654, -0.2672, 0.7117],
        [0.7234, -0.6219, -5.6812, 2.6297],
        [33.3389, -18.3000, -62.2500, 52.0781],
        [-3.5000, 0.0016, 1.1477, 0.1062],
        [0.4659, -0.3296, -0.0876, -0.0329],
    ],
    [
        [-0.6000, -0.3566, -2.5000, 2.3250],
        [0.2937, 0.0496, -5.6812, 1.8415],
        [21.0000, -4.7656, -21.5906, 7.2492],
        [-3.5000, -0.1554, 1.4062, 0.3988],
        [0.0032, 0.0766, -0.0656, -0.1294],
    ],
    [
        [-1.0156, -0.3670, 1.0078, 1.4051],
        [0.2875, -0.5328, -3.8500, 3.3750],
        [14.0000, -0.9999, -7.1406, 7.5469],
        [-3.4000, -0.1078, -1.0750, 1.5702],
        [-0.0672, 0.4016, 0.3017, -0.4844],
    ],
    [
        [-1.0000, 0.0211, 0.5025, -0.5119],
        [-0.3000, 0.1922, 0.7023, -1.6317],
        [19.0000, -5.0000, 1.2438, -1.9094],
        [-4.0000, 0.0250, 0.3844, 0.2656],
        [1.0468, -0.3788, -2.4517, 1.4656],
    ],
    [
        [-1.0500, 0.0289, 0.4260, 0.3590],
        [-0.3250, 0.1156, 0.7781, 0.0025],
        [31.0625, -14.5000, -46.1148, 55.3750],
        [-7.2312, 0.4050, 13.3500, 0.6234],
        [1.5000, -0.6426, 1.8564, 0.5636],
    ],
];

/// By bin of clearness: a, b, c, d of the luminous efficacy of diffuse light (1990, equation 7 and table 4).
const DIFFUSE_EFFICACY: [[f64; 4]; 8] = [
    [97.24, -0.46, 12.00, -8.91],
    [107.22, 1.15, 0.59, -3.95],
    [104.97, 2.96, -5.53, -8.77],
    [102.39, 5.59, -13.95, -13.90],
    [100.71, 5.94, -22.75, -23.74],
    [106.42, 3.83, -36.15, -28.83],
    [141.88, 1.90, -53.24, -14.03],
    [152.23, 0.35, -45.27, -7.98],
];

/// The same of direct light (1990, equation 8 and table 4).
const DIRECT_EFFICACY: [[f64; 4]; 8] = [
    [57.20, -4.55, -2.98, 117.12],
    [98.99, -3.46, -1.21, 12.38],
    [109.83, -4.90, -1.71, -8.81],
    [110.34, -5.84, -1.99, -4.56],
    [106.36, -3.97, -1.75, -6.16],
    [107.19, -1.25, -1.51, -26.73],
    [105.75, 0.77, -1.26, -34.44],
    [101.18, 1.58, -1.10, -8.29],
];

/// What was measured of a sky, and when.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyWeather {
    /// Irradiance of a surface that faces the sun, by the sun alone, W/m2.
    pub direct_normal_w_m2: f64,
    /// Irradiance of a horizontal surface by the sky alone, W/m2.
    pub diffuse_horizontal_w_m2: f64,
    /// The day of the year from 1, for the distance of the sun.
    pub day: u16,
    /// Dew point at the ground, degrees Celsius, for the water in the air.
    pub dew_point_c: f64,
}

/// The light of a sky and of the sun by weather.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AllWeather {
    /// The sky.
    pub sky: GeneralSky,
    /// Illuminance of a surface that faces the sun, by the sun alone, lx.
    pub sun_normal_lx: f64,
    /// How clear the sky is, from 1 (overcast) on: epsilon of Perez.
    pub clearness: f64,
    /// How bright the sky is for the height of the sun: delta of Perez.
    pub brightness: f64,
}

impl SkyWeather {
    /// Sky and sun; the sky is black without diffuse light, and the sun is dark below the horizon.
    pub fn light(&self, sun: Direction) -> AllWeather {
        let up = sun.to_vector().z.clamp(-1.0, 1.0);
        // The model knows no sun below the horizon.
        let zenith_rad = libm::acos(up).min(FRAC_PI_2);
        let (clearness, brightness) = (self.clearness(zenith_rad), self.brightness(zenith_rad));
        let bin = CLEARNESS_BINS.iter().take_while(|end| clearness >= **end).count();
        let sky = relative(bin, clearness, brightness, zenith_rad, sun);
        let diffuse_lx =
            self.diffuse_horizontal_w_m2 * self.diffuse_lm_w(bin, brightness, zenith_rad);
        let sun_normal_lx = match up > 0.0 {
            true => self.direct_normal_w_m2 * self.direct_lm_w(bin, brightness, zenith_rad),
            false => 0.0,
        };
        // A form that is nowhere above zero says nothing of where its light is.
        let uniform = GeneralSky::uniform(1.0);
        let sky = sky.with_horizontal_lx(diffuse_lx).or(uniform.with_horizontal_lx(diffuse_lx));
        AllWeather { sky: sky.unwrap_or(uniform.scaled(0.0)), sun_normal_lx, clearness, brightness }
    }

    /// 1990, equation 1.
    fn clearness(&self, zenith_rad: f64) -> f64 {
        if self.diffuse_horizontal_w_m2 <= 0.0 {
            return if self.direct_normal_w_m2 > 0.0 { MOST_CLEARNESS } else { 1.0 };
        }
        let cube = KAPPA * zenith_rad * zenith_rad * zenith_rad;
        let ratio = 1.0 + self.direct_normal_w_m2 / self.diffuse_horizontal_w_m2;
        ((ratio + cube) / (1.0 + cube)).clamp(1.0, MOST_CLEARNESS)
    }

    /// 1990, equation 2.
    fn brightness(&self, zenith_rad: f64) -> f64 {
        let outside_w_m2 = SOLAR_CONSTANT_W_M2 * nearness(self.day);
        let brightness = self.diffuse_horizontal_w_m2 * air_mass(zenith_rad) / outside_w_m2;
        brightness.clamp(BRIGHTNESS[0], BRIGHTNESS[1])
    }

    fn diffuse_lm_w(&self, bin: usize, brightness: f64, zenith_rad: f64) -> f64 {
        let [a, b, c, d] = DIFFUSE_EFFICACY[bin];
        let efficacy = a + b * self.water_cm() + c * libm::cos(zenith_rad);
        (efficacy + d * libm::log(brightness)).max(0.0)
    }

    fn direct_lm_w(&self, bin: usize, brightness: f64, zenith_rad: f64) -> f64 {
        let [a, b, c, d] = DIRECT_EFFICACY[bin];
        let efficacy = a + b * self.water_cm() + c * libm::exp(5.73 * zenith_rad - 5.0);
        (efficacy + d * brightness).max(0.0)
    }

    /// Precipitable water, cm (1990, equation 3).
    fn water_cm(&self) -> f64 {
        libm::exp(0.07 * self.dew_point_c - 0.075)
    }
}

/// The form of a sky, with a factor of 1 cd/m2 (1993, equations 1 and 6 to 8).
fn relative(
    bin: usize,
    clearness: f64,
    brightness: f64,
    zenith_rad: f64,
    sun: Direction,
) -> GeneralSky {
    let is_dim = clearness > DIM_CLEARNESS[0] && clearness < DIM_CLEARNESS[1];
    let delta = if is_dim { brightness.max(DIM_BRIGHTNESS) } else { brightness };
    let [a, b, c, d, e] = COEFFICIENTS[bin]
        .map(|[x1, x2, x3, x4]| x1 + x2 * zenith_rad + delta * (x3 + x4 * zenith_rad));
    let (c, d) = if bin == 0 { overcast(delta, zenith_rad) } else { (c, d) };
    GeneralSky { gradation: [a, b], indicatrix: [1.0, c, d, e], sun, scale_cd_m2: 1.0 }
}

/// c and d of the first bin (1993, equations 7 and 8).
fn overcast(delta: f64, zenith_rad: f64) -> (f64, f64) {
    let [_, _, [c1, c2, c3, c4], [d1, d2, d3, d4], _] = COEFFICIENTS[0];
    let c = libm::exp(libm::pow(delta * (c1 + c2 * zenith_rad), c3)) - c4;
    let d = -libm::exp(delta * (d1 + d2 * zenith_rad)) + d3 + delta * d4;
    (c, d)
}

/// The square of the mean distance of the sun over the present one: J. W. Spencer, "Fourier series representation of the position of
/// the sun", Search 2 (1971) 172.
fn nearness(day: u16) -> f64 {
    let angle = 2.0 * PI * (f64::from(day) - 1.0) / 365.0;
    let (sin, cos) = libm::sincos(angle);
    let (sin_twice, cos_twice) = libm::sincos(2.0 * angle);
    1.00011 + 0.034_221 * cos + 0.00128 * sin + 0.000_719 * cos_twice + 0.000_077 * sin_twice
}

/// Relative optical air mass: F. Kasten, "A new table and approximation formula for the relative optical air mass", Archiv für
/// Meteorologie, Geophysik und Bioklimatologie B 14 (1966) 206-223.
fn air_mass(zenith_rad: f64) -> f64 {
    let zenith_deg = zenith_rad.to_degrees();
    1.0 / (libm::cos(zenith_rad) + 0.15 * libm::pow(93.885 - zenith_deg, -1.253))
}
