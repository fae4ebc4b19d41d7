//! Luminous rectangle, disc and polygon over black receivers, and a rectangle of many tiles that shine each for itself.
//!
//! Nothing reflects, so the answer is the luminance times the projected solid angle: Lambert's
//! formula for polygons, and the factors of Siegel and Howell where they are known
//! ([`crate::lambert`], which tests one against the other). The disc is a polygon of 256 corners of its
//! area, expected to light like a disc.

use crate::expectation::{Bound, Case, Expectation};
use crate::lambert::{
    disc_factor_parallel, disc_factor_perpendicular, disc_polygon, polygon_illuminance_lx,
    rectangle_factor_parallel, rectangle_factor_perpendicular,
};
use crate::model::{Rectangle, polygon};
use crate::tolerance::DISC_POLYGON;
use isolux::engine::ProbePoint;
use isolux::geometry::{Direction, Normal, Point};
use isolux::scene::{Finish, Material, SceneParts};
use isolux::units::Rgb;
use std::f64::consts::PI;

const LUMINANCE_CD_M2: f64 = 3000.0;
const HEIGHT_M: f64 = 2.0;
/// Edges of the rectangle, from the origin along x and y, m.
const EDGES_M: [f64; 2] = [1.2, 0.6];
const TILES: [u32; 2] = [12, 6];
const RADIUS_M: f64 = 0.5;
const DISC_CORNERS: u32 = 256;
/// Where the wall is that faces +x; luminous surfaces begin beyond it.
const WALL_X_M: f64 = -1.0;

pub(super) fn cases() -> [Case; 4] {
    [
        Case {
            name: "emitter_rectangle",
            notes: "a luminous rectangle over a black floor and before a black wall",
            parts: || parts("emitter_rectangle", &[rectangle_corners()]),
            expectations: rectangle_expectations,
        },
        Case {
            name: "emitter_tiles",
            notes: "the same rectangle, of 72 luminous tiles",
            parts: || parts("emitter_tiles", &tiles()),
            expectations: rectangle_expectations,
        },
        Case {
            name: "emitter_disc",
            notes: "a luminous disc over a black floor and before a black wall",
            parts: || parts("emitter_disc", &[disc_corners()]),
            expectations: disc_expectations,
        },
        Case {
            name: "emitter_polygon",
            notes: "a luminous pentagon over a black floor and before a black wall",
            parts: || parts("emitter_polygon", &[pentagon_corners()]),
            expectations: pentagon_expectations,
        },
    ]
}

fn parts(name: &str, luminous: &[Vec<Point>]) -> SceneParts {
    let floor = Rectangle::new([WALL_X_M, -3.0, 0.0], [6.0, 0.0, 0.0], [0.0, 6.0, 0.0]);
    let wall = Rectangle::new([WALL_X_M, -3.0, 0.0], [0.0, 6.0, 0.0], [0.0, 0.0, 1.9]);
    let light = Finish { luminance_cd_m2: Rgb::grey(LUMINANCE_CD_M2), ..Finish::BLACK };
    let mut shapes = vec![floor.shape("floor", 0), wall.shape("wall", 0)];
    shapes.extend(luminous.iter().map(|corners| polygon("luminous", corners, 1)));
    SceneParts {
        name: name.into(),
        shapes,
        materials: vec![
            Material::one_sided("black", Finish::BLACK),
            Material::one_sided("luminous", light),
        ],
        ..SceneParts::default()
    }
}

/// Seen counter-clockwise from below, as every luminous surface here.
fn rectangle_corners() -> Vec<Point> {
    tile([0.0; 2], EDGES_M)
}

fn tile([x, y]: [f64; 2], [a, b]: [f64; 2]) -> Vec<Point> {
    [(0.0, 0.0), (0.0, b), (a, b), (a, 0.0)]
        .map(|(u, v)| Point::new(x + u, y + v, HEIGHT_M))
        .to_vec()
}

/// The rectangle in [`TILES`] along its edges.
fn tiles() -> Vec<Vec<Point>> {
    let edges_m = [0, 1].map(|k| EDGES_M[k] / f64::from(TILES[k]));
    let at = |i: u32, j: u32| tile([f64::from(i) * edges_m[0], f64::from(j) * edges_m[1]], edges_m);
    (0..TILES[0]).flat_map(|i| (0..TILES[1]).map(move |j| at(i, j))).collect()
}

fn disc_corners() -> Vec<Point> {
    disc_polygon(Point::new(0.0, 0.0, HEIGHT_M), RADIUS_M, DISC_CORNERS)
}

fn pentagon_corners() -> Vec<Point> {
    [(-0.2, -0.6), (-0.5, 0.3), (0.1, 0.9), (1.1, 0.6), (0.8, -0.4)]
        .map(|(x, y)| Point::new(x, y, HEIGHT_M))
        .to_vec()
}

fn on_floor(x: f64, y: f64) -> ProbePoint {
    ProbePoint { position: Point::new(x, y, 0.0), normal: Normal::Z }
}

fn on_wall(y: f64, z: f64) -> ProbePoint {
    ProbePoint { position: Point::new(WALL_X_M, y, z), normal: Direction::X.to_normal() }
}

fn expect(at: ProbePoint, lx: f64, bound: Bound) -> [Expectation; 2] {
    Expectation::direct_only(at, Rgb::grey(lx), bound)
}

fn rectangle_expectations() -> Vec<Expectation> {
    let [a, b] = EDGES_M;
    let exitance = PI * LUMINANCE_CD_M2;
    let c = HEIGHT_M;
    // Below the middle four quarters meet; below a corner there is one rectangle.
    let middle = 4.0 * rectangle_factor_parallel(0.5 * a, 0.5 * b, c);
    let corner = rectangle_factor_parallel(a, b, c);
    let mut found = Vec::new();
    found.extend(expect(on_floor(0.5 * a, 0.5 * b), exitance * middle, Bound::EXACT_GEOMETRY));
    found.extend(expect(on_floor(a, b), exitance * corner, Bound::EXACT_GEOMETRY));
    // The wall is before the edge: a rectangle that begins at the wall, less what is missing.
    let z = 0.4;
    let to = |reach: f64| rectangle_factor_perpendicular(reach, b, c - z);
    let wall = to(a - WALL_X_M) - to(-WALL_X_M);
    found.extend(expect(on_wall(0.0, z), exitance * wall, Bound::EXACT_GEOMETRY));
    found.extend(by_lambert(&rectangle_corners()));
    found
}

fn disc_expectations() -> Vec<Expectation> {
    let exitance = PI * LUMINANCE_CD_M2;
    let reason = "a polygon of 256 corners and the area of the disc";
    let bounded = |at: ProbePoint, lx: f64| expect(at, lx, Bound { lx: DISC_POLYGON * lx, reason });
    let floor = [0.0, 0.3, 1.0, 2.5]
        .map(|a| bounded(on_floor(a, 0.0), exitance * disc_factor_parallel(RADIUS_M, HEIGHT_M, a)));
    let wall = [0.2, 1.0, 1.5].map(|z| {
        let factor = disc_factor_perpendicular(RADIUS_M, HEIGHT_M - z, -WALL_X_M);
        bounded(on_wall(0.0, z), exitance * factor)
    });
    floor.into_iter().chain(wall).flatten().collect()
}

fn pentagon_expectations() -> Vec<Expectation> {
    by_lambert(&pentagon_corners())
}

fn by_lambert(luminous: &[Point]) -> Vec<Expectation> {
    [(-0.5, -1.0), (0.2, 0.1), (2.0, 1.0), (4.0, -2.0)]
        .map(|(x, y)| on_floor(x, y))
        .into_iter()
        .chain([(0.0, 0.3), (-1.5, 1.2), (0.7, 1.6)].map(|(y, z)| on_wall(y, z)))
        .flat_map(|at| {
            let lx = polygon_illuminance_lx(LUMINANCE_CD_M2, luminous, at.position, at.normal);
            expect(at, lx, Bound::EXACT_GEOMETRY)
        })
        .collect()
}
