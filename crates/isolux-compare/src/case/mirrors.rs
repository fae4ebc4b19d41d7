//! Planar mirrors: virtual images.
//!
//! A planar mirror of reflectance k shows every luminaire behind it, with intensity times k and its
//! distribution mirrored, to those places from which the line to the image passes through the
//! mirror, unless the way there or on is blocked. Two mirrors at right angles show three images.
//! Receivers are black; geometry is exact. Places whose lines pass a border closer than 2 % of its
//! length are left out.

use crate::expectation::{Bound, Case, Expectation};
use crate::model::{Rectangle, aimed, isotropic};
use isolux::engine::ProbePoint;
use isolux::geometry::{Direction, Normal, Point, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Finish, Material, SceneParts};
use isolux::units::Rgb;

const MIRROR: Rgb = Rgb::new(0.9, 0.8, 0.7);
const LAMP: [f64; 3] = [1.5, 0.3, 1.2];
const LAMP_CD: f64 = 500.0;
const SPOT: [f64; 3] = [1.2, -0.6, 1.6];
const SPOT_AIM: [f64; 3] = [-1.0, 0.4, -0.3];
const SPOT_CD: f64 = 2000.0;
const SPOT_EXPONENT: f64 = 6.0;
const CORNER_LAMP: [f64; 3] = [1.0, 1.5, 1.2];
/// Reflectances of the mirrors at x = 0 and y = 0.
const CORNER_MIRRORS: [f64; 2] = [0.9, 0.6];
const MARGIN: f64 = 0.02;

pub(super) fn cases() -> [Case; 3] {
    [
        Case {
            name: "mirror_image",
            notes: "a lamp and a spot before a coloured mirror of finite size",
            parts: || mirror_parts("mirror_image", false),
            expectations: || mirror_expectations(false),
        },
        Case {
            name: "mirror_image_only",
            notes: "the same with a screen that hides the lamps but not all of their images",
            parts: || mirror_parts("mirror_image_only", true),
            expectations: || mirror_expectations(true),
        },
        Case {
            name: "mirror_corner",
            notes: "two mirrors at right angles, three images",
            parts: corner_parts,
            expectations: corner_expectations,
        },
    ]
}

/// In the plane x = 0, seen from +x.
fn mirror() -> Rectangle {
    Rectangle::new([0.0, -1.5, 0.1], [0.0, 3.0, 0.0], [0.0, 0.0, 1.9])
}

/// Stands on the floor, so that it hides the lamps from the part of the floor behind it.
fn screen() -> Rectangle {
    Rectangle::new([2.0, -2.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 1.0])
}

fn floor() -> Rectangle {
    Rectangle::new([0.0, -3.0, 0.0], [6.0, 0.0, 0.0], [0.0, 6.0, 0.0])
}

fn mirror_parts(name: &str, with_screen: bool) -> SceneParts {
    let mut shapes = vec![floor().shape("floor", 0), mirror().shape("mirror", 1)];
    shapes.extend(with_screen.then(|| screen().shape("screen", 2)));
    let spot = IntensityDistribution::CosinePower { peak_cd: SPOT_CD, exponent: SPOT_EXPONENT };
    SceneParts {
        name: name.into(),
        shapes,
        materials: vec![
            Material::one_sided("black", Finish::BLACK),
            Material::one_sided("mirror", Finish::mirror(MIRROR)),
            Material::two_sided("screen", Finish::BLACK),
        ],
        luminaires: vec![
            isotropic("lamp", LAMP.into(), LAMP_CD),
            aimed("spot", SPOT.into(), spot_aim(), spot),
        ],
        ..SceneParts::default()
    }
}

fn spot_aim() -> Direction {
    Vector::from(SPOT_AIM).direction().unwrap_or(-Direction::X)
}

/// Mirrored in the plane x = 0.
fn mirrored(p: Point) -> Point {
    Point::new(-p.x, p.y, p.z)
}

fn lamp_cd(_: Vector) -> f64 {
    LAMP_CD
}

fn spot_cd(away: Vector) -> f64 {
    let cos_gamma = spot_aim().to_vector().dot(away) / away.length();
    SPOT_CD * cos_gamma.max(0.0).powf(SPOT_EXPONENT)
}

/// From a source straight to a place of the floor, lx.
fn straight_lx(source: Point, at: Point, intensity_cd: fn(Vector) -> f64) -> f64 {
    let d = source - at;
    intensity_cd(at - source) * d.z / (d.length_squared() * d.length())
}

/// By way of the mirror: the intensity is that of the direction in which light leaves the lamp.
fn reflected_lx(source: Point, at: Point, intensity_cd: fn(Vector) -> f64) -> f64 {
    let d = mirrored(source) - at;
    intensity_cd(mirrored(at) - source) * d.z / (d.length_squared() * d.length())
}

/// One lamp at one place of the floor, `None` where a border is grazed.
fn lit_by(
    source: Point,
    at: Point,
    intensity_cd: fn(Vector) -> f64,
    with_screen: bool,
) -> Option<Rgb> {
    let image = mirrored(source);
    let meeting = |t: f64| at.lerp(image, t);
    let bounce = mirror().meet(at, image).map_or(at, |[_, _, way]| meeting(way));
    let ways = [(at, source), (at, bounce), (bounce, source)];
    let grazed = mirror().is_grazed(at, image, MARGIN)
        || (with_screen && ways.iter().any(|&(a, b)| screen().is_grazed(a, b, MARGIN)));
    if grazed {
        return None;
    }
    let free = |k: usize| !(with_screen && screen().blocks(ways[k].0, ways[k].1));
    let mut sum = Rgb::BLACK;
    if free(0) {
        sum += Rgb::grey(straight_lx(source, at, intensity_cd));
    }
    if mirror().blocks(at, image) && free(1) && free(2) {
        sum += MIRROR * reflected_lx(source, at, intensity_cd);
    }
    Some(sum)
}

fn mirror_expectations(with_screen: bool) -> Vec<Expectation> {
    (0..81)
        .filter_map(|k| {
            let (i, j) = (f64::from(k / 9), f64::from(k % 9));
            let at = Point::new(0.35 + 0.65 * i, -2.6 + 0.65 * j, 0.0);
            let lamp = lit_by(LAMP.into(), at, lamp_cd, with_screen)?;
            let spot = lit_by(SPOT.into(), at, spot_cd, with_screen)?;
            Some((at, lamp + spot))
        })
        .flat_map(|(position, lx)| {
            let at = ProbePoint { position, normal: Normal::Z };
            Expectation::direct_only(at, lx, Bound::EXACT_GEOMETRY)
        })
        .collect()
}

fn corner_parts() -> SceneParts {
    let floor = Rectangle::new([0.0; 3], [6.0, 0.0, 0.0], [0.0, 6.0, 0.0]);
    let at_x = Rectangle::new([0.0; 3], [0.0, 6.0, 0.0], [0.0, 0.0, 4.0]);
    let at_y = Rectangle::new([0.0; 3], [0.0, 0.0, 4.0], [6.0, 0.0, 0.0]);
    let mirror = |k: usize| Finish::mirror(Rgb::grey(CORNER_MIRRORS[k]));
    SceneParts {
        name: "mirror_corner".into(),
        shapes: vec![floor.shape("floor", 0), at_x.shape("mirror_x", 1), at_y.shape("mirror_y", 2)],
        materials: vec![
            Material::one_sided("black", Finish::BLACK),
            Material::one_sided("mirror_x", mirror(0)),
            Material::one_sided("mirror_y", mirror(1)),
        ],
        luminaires: vec![isotropic("lamp", CORNER_LAMP.into(), LAMP_CD)],
        ..SceneParts::default()
    }
}

/// From the corner outwards all four images are seen in full: lines between places of the quadrant
/// and images meet the mirrors within it.
fn corner_expectations() -> Vec<Expectation> {
    let [x, y, z] = CORNER_LAMP;
    let [at_x, at_y] = CORNER_MIRRORS;
    let images = [(x, y, 1.0), (-x, y, at_x), (x, -y, at_y), (-x, -y, at_x * at_y)];
    (0..25)
        .flat_map(|k| {
            let position =
                Point::new(0.2 + 1.1 * f64::from(k / 5), 0.2 + 1.1 * f64::from(k % 5), 0.0);
            let lx = images
                .iter()
                .map(|&(x, y, share)| share * straight_lx(Point::new(x, y, z), position, lamp_cd));
            let at = ProbePoint { position, normal: Normal::Z };
            Expectation::direct_only(at, Rgb::grey(lx.sum()), Bound::EXACT_GEOMETRY)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn some_places_see_the_image_alone_and_some_nothing() {
        let behind = mirror_expectations(true);
        let only_image = |e: &&Expectation| {
            let [r, g, b] = e.expected_lx.0;
            g > 0.0 && (r / g - 0.9 / 0.8).abs() < 1e-12 && (b / g - 0.7 / 0.8).abs() < 1e-12
        };
        assert!(behind.iter().filter(only_image).count() >= 4);
        assert!(behind.iter().any(|e| e.expected_lx.is_black()));
        assert!(mirror_expectations(false).len() > 60);
    }

    #[test]
    fn reflecting_the_lamp_or_the_place_is_the_same_for_an_isotropic_lamp() {
        let (source, at) = (Point::from(LAMP), Point::new(2.0, 1.0, 0.0));
        let by_image = straight_lx(mirrored(source), at, lamp_cd);
        assert_eq!(by_image, reflected_lx(source, at, lamp_cd));
    }
}
