//! Where a case is read.

use crate::case::{cube, sphere};
use crate::expectation::{Bound, Case, Expectation, Quantity};
use crate::measure::{cube_grid, sphere_grid};
use isolux::engine::ProbePoint;
use isolux::geometry::Point;

/// A reading with its answer. Places of a case stand for equal areas, as nearly as it has them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Where.
    pub at: ProbePoint,
    /// Which part of the light: what replicates estimate, without the direct light that is exact.
    pub quantity: Quantity,
    /// Its photometric value, lx.
    pub expected_lx: f64,
    /// Photometric value of all light there, lx.
    pub total_lx: f64,
    /// How far the exact answer of the scene as tessellated may be from it, lx.
    pub bound_lx: f64,
}

/// The places of a case. CUBE and SPHERE have grids; other cases are read where they are validated.
pub(super) fn places(case: &Case) -> Vec<Place> {
    let expected = (case.expectations)();
    match case.name {
        // One of four quadrants: the rest is its mirror image.
        "cube" => on_grid(cube_grid().iter().step_by(4).copied(), 0.0, |at| {
            let scaled = |c: f64| c / cube::HALF_EDGE_M;
            let Point { x, y, .. } = at.position;
            cube::reference::cube_reference().at(scaled(x), scaled(y)).indirect_lx
        }),
        "sphere" => {
            let bounds = expected.iter().filter(|e| e.quantity == Quantity::Indirect);
            let bound_lx = bounds.map(|e| e.bound.lx).fold(0.0, f64::max);
            on_grid(sphere_grid().into_iter(), bound_lx, |_| sphere::ambient_lx())
        }
        _ => where_validated(&expected),
    }
}

fn on_grid(
    grid: impl Iterator<Item = (ProbePoint, f64)>,
    bound_lx: f64,
    indirect_lx: impl Fn(ProbePoint) -> f64,
) -> Vec<Place> {
    let place = |(at, total_lx)| {
        let expected_lx = indirect_lx(at);
        Place { at, quantity: Quantity::Indirect, expected_lx, total_lx, bound_lx }
    };
    grid.map(place).collect()
}

/// The indirect light; all of it where nothing reflects diffusely.
fn where_validated(expected: &[Expectation]) -> Vec<Place> {
    let lx = |e: &Expectation| e.expected_lx.luminance();
    let of = |quantity: Quantity| expected.iter().filter(move |e| e.quantity == quantity);
    let is_reflected = of(Quantity::Indirect).any(|e| lx(e) > 0.0);
    let quantity = if is_reflected { Quantity::Indirect } else { Quantity::Total };
    let place = |e: &Expectation| {
        let total = of(Quantity::Total).find(|total| total.at == e.at).unwrap_or(e);
        let Bound { lx: bound_lx, .. } = e.bound;
        Place { at: e.at, quantity, expected_lx: lx(e), total_lx: lx(total), bound_lx }
    };
    of(quantity).map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{cases, find};

    #[test]
    fn every_case_has_places_with_light() {
        for case in cases() {
            let places = places(&case);
            assert!(!places.is_empty(), "{}", case.name);
            assert!(places.iter().any(|p| p.expected_lx > 0.0), "{}", case.name);
            assert!(places.iter().all(|p| p.total_lx >= p.expected_lx), "{}", case.name);
        }
    }

    #[test]
    fn reflected_light_is_read_without_what_is_exact() {
        let quantity = |name: &str| places(&find(name).unwrap())[0].quantity;
        assert_eq!(quantity("coloured_cube"), Quantity::Indirect);
        assert_eq!(quantity("mirror_image"), Quantity::Total);
    }
}
