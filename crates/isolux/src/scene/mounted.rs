//! Luminaires that lie on a surface.
//!
//! The ray kernel keeps surfaces to seven digits: a lamp that is written to hang at the height of a ceiling lies a little below it or
//! above. Above it would light the upper side at no distance at all, and illuminance there would be without bound. It is taken to
//! hang close before the side that it shines away from.

use super::{Luminaire, LuminaireKind, LuminousArea};
use crate::photometry::IntensityDistribution;
use isolux_geometry::{Bvh, Direction, Normal, Point, Ray, Transform, Vector};
use rayon::prelude::*;

/// What is closer to a surface than so many bounds of rounding lies on it, and is taken to be twice as far from it: a tenth of a
/// millimetre, and two, in a room.
const ON_IT: f64 = 16.0;
const BEFORE_IT: f64 = 2.0 * ON_IT;

/// A distribution faces the side to which this share of its flux goes more than to the other.
const FACES: f64 = 0.1;

/// Directions each way that tell where the light of a luminaire goes in the mean.
const STEPS: usize = 16;

/// Along these, both ways, a surface is looked for: across their diagonals lie few edges.
const AXES: [[f64; 3]; 3] = [[1.0, 0.013, 0.007], [-0.011, 1.0, 0.017], [0.019, -0.005, 1.0]];

/// Luminaires with those that lie on a surface before it; what is the front of a triangle is told by `normals`.
pub(super) fn before_surfaces(
    bvh: &Bvh,
    normals: &[Normal],
    luminaires: Vec<Luminaire>,
) -> Vec<Luminaire> {
    let before = |luminaire: Luminaire| match luminaire.kind {
        LuminaireKind::Point { position, world_from_luminaire, intensity, area } => {
            let aim = || world_from_luminaire.vector(mean_direction(&intensity));
            let position = before_what_it_lies_on(bvh, normals, position, aim);
            let area = area.map(|area| up_to_surfaces(bvh, position, &world_from_luminaire, area));
            let kind = LuminaireKind::Point { position, world_from_luminaire, intensity, area };
            Luminaire { kind, ..luminaire }
        }
        LuminaireKind::Directional { .. } | LuminaireKind::Sky { .. } => luminaire,
    };
    luminaires.into_par_iter().map(before).collect()
}

fn before_what_it_lies_on(
    bvh: &Bvh,
    normals: &[Normal],
    mut position: Point,
    aim: impl Fn() -> Vector,
) -> Point {
    let rounding_m = bvh.offset_m(position);
    let (on_it_m, before_it_m) = (ON_IT * rounding_m, BEFORE_IT * rounding_m);
    let axes = AXES.into_iter().filter_map(|[x, y, z]| Vector::new(x, y, z).direction());
    for axis in axes.flat_map(|axis| [axis, -axis]) {
        let start = position - axis.to_vector() * before_it_m;
        let segment = Ray::new(start, axis).up_to((2.0 * before_it_m) as f32);
        let Some(hit) = bvh.closest_hit(&segment) else { continue };
        let normal = normals[hit.triangle as usize].to_vector();
        let above_m = (position - bvh.mesh().triangle(hit.triangle).corners[0]).dot(normal);
        if above_m.abs() >= on_it_m {
            continue;
        }
        let facing = aim().dot(normal);
        let is_before = match facing.abs() > FACES {
            true => facing > 0.0,
            // Neither side is meant: where it lies, or in front if rounding alone tells.
            false => above_m > -rounding_m,
        };
        let wanted_m = if is_before { before_it_m } else { -before_it_m };
        position = position + normal * (wanted_m - above_m);
    }
    position
}

/// A luminous area as far as no surface cuts it: what is written to reach into a ceiling or a wall ends there, and none
/// of its light is lost. Each of its six sides ends where the way from the position is no longer free; where corners are
/// hidden all the same, it becomes smaller as a whole.
fn up_to_surfaces(
    bvh: &Bvh,
    position: Point,
    world_from_luminaire: &Transform,
    mut area: LuminousArea,
) -> LuminousArea {
    let margin_m = BEFORE_IT * bvh.offset_m(position);
    // The share of a way from the position that is free. What ends a margin away from a surface stays as it is.
    let free = |way: [f64; 3]| {
        let way = world_from_luminaire.vector(Vector::from(way));
        let Some(direction) = way.direction() else { return 1.0 };
        let length_m = way.length();
        let segment = Ray::new(position, direction).up_to((length_m + 0.5 * margin_m) as f32);
        let free_m = bvh.closest_hit(&segment).map(|hit| f64::from(hit.t) - margin_m);
        free_m.map_or(1.0, |free_m| (free_m / length_m).clamp(0.0, 1.0))
    };
    for axis in 0..3 {
        let ends = [-1.0, 1.0].map(|sign| area.middle_m[axis] + sign * area.half_m[axis]);
        let shares = ends.map(|end| {
            let mut way = [0.0; 3];
            way[axis] = end;
            free(way)
        });
        // Without rounding where nothing is cut: a scene that is read again is the same.
        if shares != [1.0; 2] {
            let [low, high] = [ends[0] * shares[0], ends[1] * shares[1]];
            area.half_m[axis] = 0.5 * (high - low);
            area.middle_m[axis] = 0.5 * (high + low);
        }
    }
    let corner = |k: usize| {
        let sign = |axis: usize| if k >> axis & 1 == 0 { -1.0 } else { 1.0 };
        std::array::from_fn(|axis| area.middle_m[axis] + sign(axis) * area.half_m[axis])
    };
    let share = (0..8).map(|k| free(corner(k))).fold(1.0, f64::min);
    if share < 1.0 {
        area.half_m = area.half_m.map(|half| half * share);
        area.middle_m = area.middle_m.map(|middle| middle * share);
    }
    area
}

/// The mean of the directions that light goes, in the luminaire's frame: the shorter, the less it faces anywhere.
fn mean_direction(intensity: &IntensityDistribution) -> Vector {
    let at = |k: usize| (k as f64 + 0.5) / STEPS as f64;
    let all = (0..STEPS * STEPS)
        .filter_map(|k| intensity.sample([at(k % STEPS), at(k / STEPS)]))
        .map(Direction::to_vector);
    all.fold(Vector::ZERO, |sum, way| sum + way) / (STEPS * STEPS) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Finish, Material, Scene, SceneParts, Shape};
    use crate::units::Rgb;
    use isolux_geometry::Transform;

    /// Where a lamp comes to hang that is written to hang at a height below a ceiling at 2.8 m, which rounds to less.
    fn height_m(written_m: f64, intensity: IntensityDistribution, turned: bool) -> f64 {
        let corner = |x: f64, y: f64| [x, y, 2.8];
        let ceiling = Shape {
            positions: vec![corner(0.0, 0.0), corner(0.0, 6.0), corner(8.0, 6.0), corner(8.0, 0.0)],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Shape::default()
        };
        let kind = LuminaireKind::Point {
            position: Point::new(4.0, 3.0, written_m),
            world_from_luminaire: Transform::scale(1.0, 1.0, if turned { -1.0 } else { 1.0 }),
            intensity,
            area: None,
        };
        let luminaires =
            vec![Luminaire { name: "lamp".into(), group: 0, colour: Rgb::WHITE, kind }];
        let materials = vec![Material::two_sided("white", Finish::diffuse(Rgb::grey(0.7)))];
        let parts =
            SceneParts { shapes: vec![ceiling], materials, luminaires, ..SceneParts::default() };
        let scene = Scene::assemble(parts).unwrap();
        let again = Scene::assemble(scene.to_parts()).unwrap();
        assert_eq!(again.luminaires(), scene.luminaires(), "it hangs where it hung");
        let LuminaireKind::Point { position, .. } = scene.luminaires()[0].kind else { panic!() };
        assert_eq!([position.x, position.y], [4.0, 3.0]);
        position.z
    }

    #[test]
    fn what_lies_on_a_surface_hangs_before_the_side_it_shines_from() {
        let down = || IntensityDistribution::CosinePower { peak_cd: 100.0, exponent: 1.0 };
        for written_m in [2.8, 2.8 + 2e-5, 2.8 - 2e-5] {
            let below_m = 2.8 - height_m(written_m, down(), false);
            assert!((5e-5..5e-4).contains(&below_m), "{written_m}: {below_m}");
            // An uplight on the roof.
            let above_m = height_m(written_m, down(), true) - 2.8;
            assert!((5e-5..5e-4).contains(&above_m), "{written_m}: {above_m}");
        }
        // What is clear of it stays where it is.
        for written_m in [2.799, 2.801, 1.0] {
            assert_eq!(height_m(written_m, down(), false), written_m);
        }
    }

    #[test]
    fn what_shines_all_around_stays_on_its_side() {
        let bare = || IntensityDistribution::Isotropic { intensity_cd: 100.0 };
        assert!(height_m(2.8, bare(), false) < 2.7999, "the front faces down");
        assert!(height_m(2.8 - 2e-5, bare(), false) < 2.7999);
        assert!(height_m(2.8 + 3e-5, bare(), false) > 2.8001);
        assert_eq!(height_m(2.799, bare(), false), 2.799);
    }
}
