//! Light exactly through the edges and corners where mirrors meet: once, neither never nor twice.

use super::direct_light::lux;
use super::*;

/// Coordinates of places that lie symmetrically: many pairs of them are in one plane with an axis, and some in line with the corner.
const STEPS: [f64; 3] = [0.125, 0.25, 0.5];

/// Planes through corners in single precision are off by a rounding of these or two; images by twice that for every mirror.
const TURNED: f64 = 1e-5;

fn mirror(reflectance: f64) -> Material {
    Material::one_sided("mirror", Finish::mirror(Rgb::grey(reflectance)))
}

fn materials(reflectances: &[f64]) -> Vec<Material> {
    let mirrors = reflectances.iter().map(|&r| mirror(r));
    mirrors.chain([painted(Rgb::grey(0.5))]).collect()
}

/// A rectangle in several by several parts, whose edges are met where they are shared, too.
fn parted(corner: [f64; 3], u: [f64; 3], v: [f64; 3], material: u32, parts: usize) -> Vec<Shape> {
    let along = |w: [f64; 3], k: usize| w.map(|x| x * k as f64 / parts as f64);
    let add = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| a[k] + b[k]);
    let part = |k: usize| {
        let at = add(corner, add(along(u, k / parts), along(v, k % parts)));
        rectangle(at, along(u, 1), along(v, 1), material)
    };
    (0..parts * parts).map(part).collect()
}

/// Where a scene stands in space: turned, enlarged, moved.
#[derive(Clone, Copy, Debug)]
struct Stand {
    turned: bool,
    scale: f64,
    moved_m: f64,
}

impl Stand {
    const ALL: [Self; 6] = [
        Self { turned: false, scale: 1.0, moved_m: 0.0 },
        Self { turned: false, scale: 1.0, moved_m: 1.0 },
        Self { turned: false, scale: 1.0, moved_m: 1024.0 },
        Self { turned: false, scale: 1e-3, moved_m: 0.0 },
        Self { turned: false, scale: 1e3, moved_m: 0.0 },
        Self { turned: true, scale: 1.0, moved_m: 0.0 },
    ];

    fn vector(self, v: [f64; 3]) -> [f64; 3] {
        let scaled = Vector::from(v) * self.scale;
        let placed = if self.turned {
            // A right-handed frame about any direction.
            let axis = direction([0.48, 0.6, 0.64]);
            let (u, v) = axis.frame();
            u * scaled.x + v * scaled.y + axis * scaled.z
        } else {
            scaled
        };
        [placed.x, placed.y, placed.z]
    }

    fn point(self, p: [f64; 3]) -> [f64; 3] {
        self.vector(p).map(|x| x + self.moved_m)
    }

    fn shapes(self, shapes: Vec<Shape>) -> Vec<Shape> {
        let placed = |shape: Shape| Shape {
            positions: shape.positions.iter().map(|&p| self.point(p)).collect(),
            ..shape
        };
        shapes.into_iter().map(placed).collect()
    }

    fn tolerance(self) -> f64 {
        // Of a metre at a kilometre, in single precision.
        if self.turned || self.moved_m > 1.0 { TURNED } else { RAY_ROUNDING }
    }
}

/// Illuminance at a place that faces a way, from a lamp of one candela.
fn from_lamp(lamp: [f64; 3], at: [f64; 3], normal: [f64; 3]) -> f64 {
    let way = Vector::from(lamp) - Vector::from(at);
    let facing = way.dot(Vector::from(normal));
    facing.max(0.0) / way.length().powi(3)
}

/// All pairs of places of a grid: lamp and receiver, which faces the corner.
fn pairs() -> impl Iterator<Item = ([f64; 3], [f64; 3])> {
    let count = STEPS.len().pow(3);
    let place = |k: usize, scale: f64| [k / 9, k / 3 % 3, k % 3].map(|k| scale * STEPS[k]);
    (0..count * count).map(move |k| (place(k / count, 1.0), place(k % count, 3.0)))
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let Vector { x, y, z } = direction(v).to_vector();
    [x, y, z]
}

/// Direct light in a scene at a stand, against a sum of images, each with its share.
fn check(
    stand: Stand,
    (shapes, reflectances): (&[Shape], &[f64]),
    (lamp, at): ([f64; 3], [f64; 3]),
    images: &[([f64; 3], f64)],
) {
    let normal = unit(at.map(|x| -x));
    let lamps = vec![isotropic(stand.point(lamp), 100.0)];
    let scene = scene(stand.shapes(shapes.to_vec()), materials(reflectances), lamps);
    let found = lux(&scene, stand.point(at), stand.vector(normal));
    let sum: f64 = images.iter().map(|&(image, share)| share * from_lamp(image, at, normal)).sum();
    let expected = 100.0 * sum / (stand.scale * stand.scale);
    let off = (found - expected).abs();
    assert!(off <= stand.tolerance() * expected, "{stand:?} {lamp:?} {at:?}: {found} {expected}");
}

const OCTANT: [f64; 3] = [0.6, 0.8, 1.0];

/// Three mirrors that meet at the origin, across the axes in turn.
fn octant(parts: usize) -> Vec<Shape> {
    let [x, y, z] = [[4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
    let walls = [(y, z, 0), (z, x, 1), (x, y, 2)];
    walls.into_iter().flat_map(|(u, v, material)| parted([0.0; 3], u, v, material, parts)).collect()
}

fn images_in_octant(lamp: [f64; 3]) -> Vec<([f64; 3], f64)> {
    let image = |k: usize| {
        let is_turned = |axis: usize| k >> axis & 1 == 1;
        let turned = [0, 1, 2].map(|axis| if is_turned(axis) { -lamp[axis] } else { lamp[axis] });
        let share = (0..3).filter(|&axis| is_turned(axis)).map(|axis| OCTANT[axis]).product();
        (turned, share)
    };
    (0..8).map(image).collect()
}

#[test]
fn all_symmetric_pairs_in_an_octant_of_mirrors_see_all_eight_images() {
    for (stand, parts) in Stand::ALL.into_iter().zip([1, 3, 1, 1, 2, 1]) {
        let shapes = octant(parts);
        for pair in pairs() {
            check(stand, (&shapes, &OCTANT), pair, &images_in_octant(pair.0));
        }
        // A lamp and a place in one plane with the axis, as it was found.
        let place = unit([1.0, 2.0, 9.0]);
        let lamp = [0.2, 0.4, 0.6];
        check(stand, (&shapes, &OCTANT), (lamp, place), &images_in_octant(lamp));
    }
}

/// Two mirrors of the same reflectance that meet along the z axis at an angle of a half turn over `n`.
fn wedge(n: usize) -> Vec<Shape> {
    let (s, c) = libm::sincos(std::f64::consts::PI / n as f64);
    let (low, up) = ([0.0, 0.0, -9.0], [0.0, 0.0, 18.0]);
    vec![
        rectangle(low, up, [9.0, 0.0, 0.0], 0),
        rectangle(low, [9.0 * c, 9.0 * s, 0.0], up, 0),
        rectangle([-9.0, -9.0, -9.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], 1),
    ]
}

#[test]
fn a_wedge_of_two_mirrors_is_a_kaleidoscope_from_everywhere() {
    let reflectance: f64 = 0.7;
    for n in [2, 3, 4] {
        let shapes = wedge(n);
        let turn = std::f64::consts::PI / n as f64;
        let at = |angle: f64, radius: f64, z: f64| {
            let (s, c) = libm::sincos(angle);
            [radius * c, radius * s, z]
        };
        // Half way and elsewhere, also mirrored at the bisector: pairs of them lie in one plane with the edge.
        for (k, l) in (1..8).flat_map(|k| (1..8).map(move |l| (k, l))) {
            let [lamp_at, place_at] = [k, l].map(|k| turn * f64::from(k) / 8.0);
            let lamp = at(lamp_at, 0.75, 0.5);
            // Turned about the edge by twice the angle of the wedge, with and without a reflection first.
            let images: Vec<_> = (0..2 * n)
                .map(|m| {
                    let (pairs, odd) = (m / 2, m % 2 == 1);
                    let start = if odd { -lamp_at } else { lamp_at };
                    let angle = start + 2.0 * turn * pairs as f64;
                    let reflections = crossed(angle, place_at, turn);
                    (at(angle, 0.75, 0.5), reflectance.powi(reflections))
                })
                .collect();
            let pair = (lamp, at(place_at, 1.5, 0.25));
            for stand in [Stand::ALL[0], Stand::ALL[5]] {
                check(stand, (&shapes, &[reflectance]), pair, &images);
            }
        }
    }
}

/// How many reflections show an image at such an angle to a place: the wedges that a straight way to it crosses, the shorter way about
/// the edge.
fn crossed(angle: f64, place: f64, turn: f64) -> i32 {
    let whole = std::f64::consts::TAU;
    let away = libm::remainder(angle - place, whole);
    // By symmetry of the wedge; exactly behind the edge either way has as many.
    let to = (place + away) / turn;
    libm::floor(to).abs() as i32
}

/// So dim that three reflections leave less than any chain is followed for.
const DIM: f64 = 0.05;

#[test]
fn a_box_of_six_mirrors_shows_every_image_once() {
    let side = 1.0;
    let mut shapes = inward_box([side; 3], 0);
    // Something that carries a map, out of the way of all images.
    shapes.push(rectangle([0.0, 0.0, -1.0], [0.01, 0.0, 0.0], [0.0, 0.01, 0.0], 1));
    let lamps = [[0.5; 3], [0.25, 0.25, 0.5], [0.25, 0.5, 0.75]];
    let steps = [0.125, 0.25, 0.5, 0.75, 0.875];
    for (lamp, k) in lamps.into_iter().flat_map(|lamp| (0..125).map(move |k| (lamp, k))) {
        let at = [k / 25, k / 5 % 5, k % 5].map(|k| steps[k]);
        if at == lamp {
            continue;
        }
        let cell = |k: i32, x: f64| {
            if k % 2 == 0 { f64::from(k) * side + x } else { f64::from(k + 1) * side - x }
        };
        let mut images = Vec::new();
        for m in 0..125_i32 {
            let cells = [m / 25 - 2, m / 5 % 5 - 2, m % 5 - 2];
            let count: i32 = cells.iter().map(|c| c.abs()).sum();
            if count <= 2 {
                let image = [0, 1, 2].map(|axis| cell(cells[axis], lamp[axis]));
                images.push((image, DIM.powi(count)));
            }
        }
        for stand in [Stand::ALL[0], Stand::ALL[1], Stand::ALL[5]] {
            check(stand, (&shapes, &[DIM]), (lamp, at), &images);
        }
    }
}

#[test]
fn what_lies_along_a_mirror_hides_it_however_near() {
    // A sheet before half of a mirror, nearer than anything that ties are decided by, though clear of rounding itself.
    let wall = rectangle([0.0, -1.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0], 0);
    for gap_m in [8e-6, 3e-5, 1e-3] {
        let sheet = rectangle([gap_m, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.0], 1);
        for (y, share) in [(-0.5, 0.8), (0.5, 0.0)] {
            let (lamp, at) = ([1.0, y, 1.5], [0.75, y, 0.25]);
            let images = [(lamp, 1.0), ([-1.0, y, 1.5], share)];
            check(Stand::ALL[0], (&[wall.clone(), sheet.clone()], &[0.8]), (lamp, at), &images);
        }
    }
}
