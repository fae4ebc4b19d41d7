//! Points that lie on a surface which runs past them, as the height of a desk does on a wall. Half of what a luxmeter sees there is
//! that surface, and rays that start on a surface do not meet it: light is read just beside it.

use isolux::engine::ProbePoint;
use isolux::geometry::{Direction, Point, Ray, Vector};
use isolux::map::Illuminance;
use isolux::scene::Scene;

/// A reader finds by itself the surface that a luxmeter faces the way of, up to this cosine of the angle between them.
const FOUND: f64 = 0.5;
/// Cosines that differ by less are one but for rounding.
const ROUNDING: f64 = 1e-6;

/// Reads at a point or, if surfaces run past it, just before them; where no light is, just behind them.
pub(crate) fn read(
    scene: &Scene,
    at: ProbePoint,
    read: impl Fn(ProbePoint) -> Option<Illuminance>,
) -> Option<Illuminance> {
    let surfaces = surfaces(scene, at);
    if surfaces.is_empty() {
        return read(at);
    }
    let beside = |behind: f64| {
        let ways = surfaces.iter().map(|surface| surface.way(at, behind));
        let way = ways.fold(Vector::ZERO, |sum, way| sum + way);
        // Of two bounds of rounding one is for the place, and one for the surface.
        let position = at.position + way * (2.0 * scene.bvh().offset_m(at.position));
        read(ProbePoint { position, ..at })
    };
    let is_lit = |found: &Illuminance| found.illuminance_lx() > 0.0;
    let before = beside(1.0);
    if before.is_some_and(|found| is_lit(&found)) {
        return before;
    }
    beside(-1.0).filter(is_lit).or(before)
}

/// The front of a surface.
struct Surface(Vector);

impl Surface {
    /// Off the surface, to the side that the luxmeter faces; if it faces neither, to the front, or the other way.
    fn way(&self, at: ProbePoint, behind: f64) -> Vector {
        let facing = self.0.dot(at.normal.to_vector());
        self.0 * if facing.abs() > ROUNDING { facing.signum() } else { behind }
    }
}

/// The surfaces that a point lies on to rounding, but for those that a reader finds.
fn surfaces(scene: &Scene, at: ProbePoint) -> Vec<Surface> {
    let mut found: Vec<Surface> = Vec::new();
    // One of three ways at right angles crosses a plane at an angle whose sine is at least a root of a third.
    let reach_m = 3_f64.sqrt() * scene.bvh().offset_m(at.position);
    let up = at.normal.to_direction();
    let (u, v) = up.frame();
    let ways = [up, u, v].into_iter().flat_map(|way| [way, -way]);
    for front in ways.filter_map(|way| front(scene, at.position, way, reach_m)) {
        let is_known = found.iter().any(|known| known.0.dot(front).abs() > 1.0 - ROUNDING);
        if !is_known && front.dot(at.normal.to_vector()).abs() <= FOUND {
            found.push(Surface(front));
        }
    }
    found
}

/// The front of the first surface that a way through a point meets near it.
fn front(scene: &Scene, point: Point, way: Direction, reach_m: f64) -> Option<Vector> {
    let ray = Ray::new(point - way * reach_m, way).up_to(2.0 * reach_m as f32);
    let hit = scene.bvh().closest_hit(&ray)?;
    Some(scene.triangle(hit.triangle).normal()?.to_vector())
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux_compare::builtin;

    /// How far light is read beside a point of the cube, in bounds of rounding.
    fn shift(position: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
        let scene = Scene::assemble(builtin("cube").unwrap()).unwrap();
        let [x, y, z] = normal;
        let normal = Vector::new(x, y, z).normal().unwrap();
        let at = ProbePoint { position: Point::from(position), normal };
        let places = std::cell::RefCell::new(Vec::new());
        read(&scene, at, |at| {
            places.borrow_mut().push(at.position);
            Some(Illuminance::NOTHING)
        });
        let step_m = 2.0 * scene.bvh().offset_m(at.position);
        <[f64; 3]>::from(places.borrow()[0] - at.position).map(|m| (m / step_m).round())
    }

    #[test]
    fn points_on_walls_are_read_before_them() {
        let scene = Scene::assemble(builtin("cube").unwrap()).unwrap();
        let (low, high) = scene.bvh().mesh().bounds().unwrap();
        let middle = <[f64; 3]>::from(low.lerp(high, 0.5));
        let low = <[f64; 3]>::from(low);
        let up = [0.0, 1.0, 0.0];
        assert_eq!(shift(middle, up), [0.0; 3]);
        assert_eq!(shift([low[0], middle[1], middle[2]], up), [1.0, 0.0, 0.0]);
        assert_eq!(shift([low[0], middle[1], low[2]], up), [1.0, 0.0, 1.0]);
        // The floor itself is found by readers.
        assert_eq!(shift([middle[0], low[1], middle[2]], up), [0.0; 3]);
    }
}
