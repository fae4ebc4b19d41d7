use super::*;
use isolux_geometry::Vector;
use std::f64::consts::PI;

fn sun(elevation_deg: f64) -> Direction {
    let (sin, cos) = libm::sincos(elevation_deg.to_radians());
    Vector::new(cos, 0.0, sin).direction().unwrap()
}

/// Directions that fill the hemisphere evenly: a lattice of equal solid angles.
fn hemisphere(count: u32) -> impl Iterator<Item = Direction> {
    let golden = 0.618_033_988_749_894_9;
    (0..count).map(move |k| {
        let up = (f64::from(k) + 0.5) / f64::from(count);
        let (sin, cos) = libm::sincos(2.0 * PI * f64::from(k) * golden);
        let flat = (1.0 - up * up).sqrt();
        Vector::new(flat * cos, flat * sin, up).direction().unwrap()
    })
}

/// The quadrature agrees with a plain sum over the hemisphere. A lattice of n directions errs by about 1/n times the variation.
#[test]
fn horizontal_illuminance_is_the_integral_of_luminance() {
    let count = 400_000;
    for number in 1..=CIE_TYPES {
        for elevation in [0.0, 3.0, 40.0, 90.0] {
            let sky = GeneralSky::cie(number, sun(elevation)).unwrap();
            let sum: f64 = hemisphere(count)
                .map(|towards| sky.luminance_cd_m2(towards) * towards.to_vector().z)
                .sum();
            let expected = sum * 2.0 * PI / f64::from(count);
            let found = sky.horizontal_lx();
            assert!(
                (found / expected - 1.0).abs() < 2e-4,
                "{number} {elevation}: {found} {expected}"
            );
        }
    }
}

/// ISO 15469 normalizes with the zenith: the ratios of its formula, worked by hand for the extreme types.
#[test]
fn the_skies_of_the_standard() {
    // Type 1: (1 + 4 exp(-0.7 / cos Z)) / (1 + 4 exp(-0.7)); at 60 degrees from the zenith.
    let overcast = GeneralSky::cie(1, Direction::Z).unwrap();
    let low = sun(30.0);
    let ratio = overcast.luminance_cd_m2(low) / overcast.luminance_cd_m2(Direction::Z);
    let expected = (1.0 + 4.0 * libm::exp(-1.4)) / (1.0 + 4.0 * libm::exp(-0.7));
    assert!((ratio - expected).abs() < 1e-12);
    // A quarter circle from the sun the indicatrix is one: only the gradation is left.
    let clear = GeneralSky::cie(12, sun(0.0)).unwrap();
    let zenith = clear.luminance_cd_m2(Direction::Z);
    assert!((zenith - (1.0 - libm::exp(-0.32))).abs() < 1e-12, "{zenith}");
    assert!(clear.luminance_cd_m2(sun(5.0)) > 5.0 * zenith);
    assert_eq!(GeneralSky::cie(0, low), None);
    assert_eq!(GeneralSky::cie(16, low), None);
}

#[test]
fn a_uniform_sky_gives_pi_times_its_luminance() {
    let sky = GeneralSky::uniform(3000.0);
    assert!((sky.horizontal_lx() / (PI * 3000.0) - 1.0).abs() < 1e-12);
    let brighter = sky.with_horizontal_lx(10_000.0).unwrap();
    assert!((brighter.luminance_cd_m2(Direction::Z) - 10_000.0 / PI).abs() < 1e-9);
    let sky = Sky::General { sky: brighter, ground_cd_m2: 200.0 };
    assert_eq!(sky.luminance_cd_m2(-Direction::Z), Rgb::grey(200.0));
    assert_eq!(sky.scaled(2.0).luminance_cd_m2(-Direction::Z), Rgb::grey(400.0));
}

#[test]
fn pictures_have_north_at_their_left_border() {
    let mut rgb_cd_m2 = vec![[0.0; 3]; 8];
    // Second row (below the horizon), third column: from south to west.
    rgb_cd_m2[6] = [1.0, 2.0, 3.0];
    let picture = SkyPicture { width: 4, height: 2, rgb_cd_m2 };
    let south_west = Vector::new(-0.5, -0.6, -0.1).direction().unwrap();
    assert_eq!(picture.luminance_cd_m2(south_west), Rgb::new(1.0, 2.0, 3.0));
    let south_east = Vector::new(0.5, -0.6, -0.1).direction().unwrap();
    assert_eq!(picture.luminance_cd_m2(south_east), Rgb::BLACK);
    assert!(picture.is_sound());
    assert!(!SkyPicture { width: 3, ..picture }.is_sound());
}

/// What a sky was computed from, and what came of it.
struct ByGendaylit {
    elevation_deg: f64,
    direct_normal_w_m2: f64,
    diffuse_horizontal_w_m2: f64,
    clearness: f64,
    brightness: f64,
    sun_normal_lx: f64,
    parameters: [f64; 5],
    scale_cd_m2: f64,
}

/// A row of a table, in the order of [`ByGendaylit`].
type Row = (f64, f64, f64, f64, f64, f64, [f64; 5], f64);

/// `gendaylit -ang ELEVATION 0 -W DIRECT DIFFUSE` of Radiance 6.1 (pyradiance 1.3.1): elevation, irradiances, epsilon, delta, radiance of
/// the sun times its solid angle and 179 lm/W, the arguments A3 to A7, and A1 times 179. Without a date it takes the distance of the sun of the first days of January, and two centimetres of water.
const GENDAYLIT: [Row; 12] = [
    (
        10.0,
        0.0,
        20.0,
        1.0,
        0.0789,
        0.0,
        [0.813378, -0.679155, 0.237834, -0.246548, -0.074023],
        521.606,
    ),
    (
        10.0,
        30.0,
        40.0,
        1.1956,
        0.1578,
        2091.35,
        [-1.710627, -0.681033, 8.477638, -2.615322, 0.192769],
        2042.39,
    ),
    (
        35.0,
        0.0,
        150.0,
        1.0,
        0.1843,
        0.0,
        [0.801417, -0.553404, 0.743889, -0.553397, -0.013555],
        2992.88,
    ),
    (
        35.0,
        20.0,
        180.0,
        1.0578,
        0.2212,
        1382.07,
        [0.740656, -0.510819, 1.007464, -0.694084, 0.000535],
        3363.41,
    ),
    (
        35.0,
        60.0,
        170.0,
        1.1837,
        0.2089,
        5559.91,
        [-1.447416, -0.804018, 8.467513, -2.418014, 0.195217],
        4911.76,
    ),
    (
        35.0,
        120.0,
        160.0,
        1.3905,
        0.1966,
        11456.8,
        [-1.159388, -0.569849, 11.31438, -3.257678, 0.114898],
        5813.92,
    ),
    (
        35.0,
        250.0,
        200.0,
        1.6508,
        0.2458,
        23565.7,
        [-1.084893, -0.649512, 12.759105, -3.191313, 0.120213],
        6034.09,
    ),
    (
        35.0,
        450.0,
        150.0,
        2.5618,
        0.1843,
        42484.0,
        [-0.995943, -0.441385, 13.498979, -3.291369, 0.038768],
        6044.83,
    ),
    (
        60.0,
        700.0,
        110.0,
        6.5363,
        0.0897,
        72412.6,
        [-0.979802, -0.194568, 21.934815, -5.792534, 1.356499],
        6692.81,
    ),
    (
        60.0,
        850.0,
        90.0,
        9.2166,
        0.0734,
        88046.0,
        [-0.989814, -0.207278, 22.213997, -6.015554, 1.321415],
        5565.11,
    ),
    (
        80.0,
        900.0,
        100.0,
        9.9505,
        0.0717,
        93350.5,
        [-1.009907, -0.248983, 25.917371, -6.195173, 1.528052],
        4879.54,
    ),
    (
        15.0,
        600.0,
        60.0,
        3.9986,
        0.1615,
        49175.4,
        [-1.036228, -0.318229, 13.133338, -3.382787, 0.404817],
        4065.09,
    ),
];

fn by_gendaylit() -> impl Iterator<Item = ByGendaylit> {
    GENDAYLIT.into_iter().map(
        |(elevation_deg, direct, diffuse, clearness, brightness, lx, parameters, scale)| {
            ByGendaylit {
                elevation_deg,
                direct_normal_w_m2: direct,
                diffuse_horizontal_w_m2: diffuse,
                clearness,
                brightness,
                sun_normal_lx: lx,
                parameters,
                scale_cd_m2: scale,
            }
        },
    )
}

/// What is printed has four decimals, six decimals, or four digits. The scale of gendaylit is that of a sum over 145 parts of the sky, ours of
/// an integral.
#[test]
fn skies_by_weather_are_those_of_gendaylit() {
    for row in by_gendaylit() {
        let weather = SkyWeather {
            direct_normal_w_m2: row.direct_normal_w_m2,
            diffuse_horizontal_w_m2: row.diffuse_horizontal_w_m2,
            day: 1,
            // exp(0.07 t - 0.075) = 2 cm.
            dew_point_c: (libm::log(2.0) + 0.075) / 0.07,
        };
        let found = weather.light(sun(row.elevation_deg));
        let place = format!(
            "{} {} {}",
            row.elevation_deg, row.direct_normal_w_m2, row.diffuse_horizontal_w_m2
        );
        assert!((found.clearness - row.clearness).abs() < 1e-4, "{place}: {found:?}");
        assert!((found.brightness - row.brightness).abs() < 1e-4, "{place}: {found:?}");
        assert!(
            (found.sun_normal_lx - row.sun_normal_lx).abs() <= 5e-4 * row.sun_normal_lx,
            "{place}: {found:?}"
        );
        let ([a, b], [f, c, d, e]) = (found.sky.gradation, found.sky.indicatrix);
        assert_eq!(f, 1.0);
        for (found, expected) in [a, b, c, d, e].into_iter().zip(row.parameters) {
            // Days of early January differ by so much.
            assert!((found - expected).abs() < 1e-4, "{place}: {found} {expected}");
        }
        let ratio = found.sky.scale_cd_m2 / row.scale_cd_m2;
        println!("{place}: scale {ratio}");
        assert!((ratio - 1.0).abs() < 0.05, "{place}: {ratio}");
    }
}

#[test]
fn weather_at_its_ends() {
    let weather = SkyWeather {
        direct_normal_w_m2: 500.0,
        diffuse_horizontal_w_m2: 0.0,
        day: 1,
        dew_point_c: 11.0,
    };
    let clear = weather.light(sun(30.0));
    assert_eq!(clear.sky.horizontal_lx(), 0.0);
    assert!(clear.sun_normal_lx > 40_000.0);
    assert_eq!(weather.light(sun(-5.0)).sun_normal_lx, 0.0);
    let dawn = SkyWeather { diffuse_horizontal_w_m2: 10.0, ..weather }.light(sun(-1.0));
    assert!(dawn.sky.is_sound() && dawn.sky.horizontal_lx() > 500.0, "{dawn:?}");
}

/// A picture of a sky by formula gives its illuminance; pixels of half a degree err by the square of their size.
#[test]
fn pictures_have_an_illuminance() {
    let sky = GeneralSky::cie(7, sun(40.0)).unwrap();
    let (width, height) = (720, 360);
    let mut picture = SkyPicture { width, height, rgb_cd_m2: Vec::new() };
    let mut rgb_cd_m2 = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let middle = picture.direction([f64::from(x) + 0.5, f64::from(y) + 0.5]);
            rgb_cd_m2.push([sky.luminance_cd_m2(middle) as f32; 3]);
        }
    }
    picture.rgb_cd_m2 = rgb_cd_m2;
    let at = picture.direction([100.25, 30.75]);
    assert_eq!(picture.luminance_cd_m2(at).0[0] as f32, picture.rgb_cd_m2[30 * 720 + 100][0]);
    assert!((picture.horizontal_lx() / sky.horizontal_lx() - 1.0).abs() < 1e-4);
    assert_eq!(Sky::Picture(picture.clone().into()).horizontal_lx(), picture.horizontal_lx());
}
