//! Surfaces as triangles, in the coordinates of their file.

use super::record::Object;
use super::seams::with_holes;
use crate::polygon::{self, MOST_CORNERS};
use crate::round::{inside_out, sincos_of_turn, turn_inside_out, unit_sphere};
use isolux::geometry::{Direction, Point, Vector};
use isolux::scene::Shape;
use std::f64::consts::PI;

/// Segments of a turn.
const SEGMENTS: u32 = 32;

/// A surface as triangles, its front where Radiance has it.
pub(super) struct Tessellated {
    pub(super) shape: Shape,
    /// What is odd about it.
    pub(super) oddity: Option<(&'static str, &'static str)>,
}

/// Triangles of a surface. `keeps_area` makes the mesh of a round one as large as the surface
/// itself, by a slightly larger radius: of one that emits the flux is to be right.
pub(super) fn tessellate(object: &Object, keeps_area: bool) -> Result<Tessellated, String> {
    let shape = match object.type_.as_str() {
        "polygon" => return face(&object.numbers),
        "sphere" => ball(&object.numbers, keeps_area)?,
        "bubble" => inside_out(ball(&object.numbers, keeps_area)?),
        "ring" => ring(&object.numbers, keeps_area)?,
        "cylinder" => cylinder(&object.numbers, keeps_area)?,
        "tube" => inside_out(cylinder(&object.numbers, keeps_area)?),
        "cone" => cone(&object.numbers, keeps_area)?,
        "cup" => inside_out(cone(&object.numbers, keeps_area)?),
        other => return Err(format!("{other} is not read")),
    };
    Ok(Tessellated { shape, oddity: None })
}

fn exactly<const N: usize>(numbers: &[f64]) -> Result<[f64; N], String> {
    numbers.try_into().map_err(|_| format!("{} real arguments where {N} are due", numbers.len()))
}

fn positive(radius: f64) -> Result<f64, String> {
    (radius > 0.0).then_some(radius).ok_or_else(|| format!("a radius of {radius}"))
}

fn face(numbers: &[f64]) -> Result<Tessellated, String> {
    if numbers.len() < 9 || !numbers.len().is_multiple_of(3) {
        return Err(format!("{} real arguments, not three for each corner", numbers.len()));
    }
    if numbers.len() > 3 * MOST_CORNERS {
        return Err(format!("more than {MOST_CORNERS} corners; cut it into smaller polygons"));
    }
    let mut positions: Vec<[f64; 3]> =
        numbers.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect();
    if positions.first() == positions.last() {
        positions.pop();
    }
    let corners = with_holes(positions.into_iter().map(Point::from).collect());
    let cut = polygon::triangulate(&corners);
    let oddity = if cut.triangles.is_empty() {
        Some(("the polygon has no area and is left out", "remove it"))
    } else if cut.crosses_itself {
        Some(("the polygon crosses itself", "cut it into polygons that do not"))
    } else {
        None
    };
    let triangles = cut.triangles.iter().map(|t| t.map(|k| k as u32)).collect();
    let positions = corners.into_iter().map(Into::into).collect();
    Ok(Tessellated { shape: Shape { positions, triangles, ..Shape::default() }, oddity })
}

fn ball(numbers: &[f64], keeps_area: bool) -> Result<Shape, String> {
    let [x, y, z, radius] = exactly(numbers)?;
    let mut shape = unit_sphere(SEGMENTS, false, false);
    let grown = if keeps_area { (4.0 * PI / area(&shape)).sqrt() } else { 1.0 };
    let radius = positive(radius)? * grown;
    for p in &mut shape.positions {
        *p = [x + radius * p[0], y + radius * p[1], z + radius * p[2]];
    }
    Ok(shape)
}

/// Area of all triangles.
pub(super) fn area(shape: &Shape) -> f64 {
    let corner = |k: u32| Point::from(shape.positions[k as usize]);
    let twice = |t: &[u32; 3]| {
        let [a, b, c] = t.map(corner);
        (b - a).cross(c - a).length()
    };
    0.5 * shape.triangles.iter().map(twice).sum::<f64>()
}

fn ring(numbers: &[f64], keeps_area: bool) -> Result<Shape, String> {
    let [x, y, z, nx, ny, nz, r0, r1] = exactly(numbers)?;
    let normal = Vector::new(nx, ny, nz).direction().ok_or("a normal of length zero")?;
    let (inner, outer) = (r0.min(r1), positive(r0.max(r1))?);
    if inner < 0.0 || inner == outer {
        return Err(format!("radii {r0} and {r1}"));
    }
    // A polygon of n corners has n sin(2 pi / n) / 2 of the squared radius.
    let share = f64::from(SEGMENTS) * libm::sin(2.0 * PI / f64::from(SEGMENTS)) / (2.0 * PI);
    let grown = if keeps_area { (1.0 / share).sqrt() } else { 1.0 };
    let centre = Point::new(x, y, z);
    let mut shape = band(normal, [(centre, inner * grown), (centre, outer * grown)]);
    shape.normals = None;
    // The band runs outwards, and so faces against its axis.
    turn_inside_out(&mut shape);
    Ok(shape)
}

fn cylinder(numbers: &[f64], keeps_area: bool) -> Result<Shape, String> {
    let [x0, y0, z0, x1, y1, z1, radius] = exactly(numbers)?;
    positive(radius)?;
    cone(&[x0, y0, z0, x1, y1, z1, radius, radius], keeps_area)
}

fn cone(numbers: &[f64], keeps_area: bool) -> Result<Shape, String> {
    let [x0, y0, z0, x1, y1, z1, r0, r1] = exactly(numbers)?;
    let (from, to) = (Point::new(x0, y0, z0), Point::new(x1, y1, z1));
    let axis = (to - from).direction().ok_or("an axis of length zero")?;
    positive(r0.max(r1))?;
    if r0.min(r1) < 0.0 {
        return Err(format!("radii {r0} and {r1}"));
    }
    let ends = |grown: f64| [(from, r0 * grown), (to, r1 * grown)];
    if !keeps_area {
        return Ok(band(axis, ends(1.0)));
    }
    let slant = libm::hypot((to - from).length(), r1 - r0);
    let due = PI * (r0 + r1) * slant;
    let mut grown = 1.0;
    // The area grows at least as fast as the radius, so each turn leaves a small part of the error.
    for _ in 0..40 {
        grown *= due / area(&band(axis, ends(grown)));
    }
    Ok(band(axis, ends(grown)))
}

/// The band between two circles about an axis, facing away from it, with smooth normals.
fn band(axis: Direction, [(from, r0), (to, r1)]: [(Point, f64); 2]) -> Shape {
    let (u, v) = axis.frame();
    let length = (to - from).dot(axis.to_vector());
    let mut shape = Shape { normals: Some(Vec::new()), ..Shape::default() };
    for k in 0..SEGMENTS {
        let (s, c) = sincos_of_turn(k, SEGMENTS);
        let out = u * c + v * s;
        let normal = (out * length + axis * (r0 - r1)).direction().map_or(out, |d| d.to_vector());
        for (centre, radius) in [(from, r0), (to, r1)] {
            shape.positions.push((centre + out * radius).into());
            shape.normals.iter_mut().for_each(|list| list.push(normal.into()));
        }
        let next = (k + 1) % SEGMENTS;
        let [a, b, c, d] = [2 * k, 2 * next, 2 * next + 1, 2 * k + 1];
        if r0 > 0.0 {
            shape.triangles.push([a, b, if r1 > 0.0 { c } else { d }]);
        }
        if r1 > 0.0 {
            shape.triangles.push([a, c, d]);
        }
    }
    shape
}

#[cfg(test)]
mod tests {
    use super::*;

    fn object(type_: &str, numbers: &[f64]) -> Object {
        Object { type_: type_.into(), numbers: numbers.to_vec(), ..Object::default() }
    }

    fn shape(type_: &str, numbers: &[f64], keeps_area: bool) -> Shape {
        tessellate(&object(type_, numbers), keeps_area).unwrap_or_else(|e| panic!("{e}")).shape
    }

    /// Every triangle faces the way its normals do; the area is as large as that of the surface.
    #[track_caller]
    fn check(type_: &str, numbers: &[f64], due: f64) {
        let exact = area(&shape(type_, numbers, true));
        // Sums of some thousand rounded terms.
        assert!((exact / due - 1.0).abs() < 1e-11, "{type_}: {exact} {due}");
        let inscribed = shape(type_, numbers, false);
        let missing = 1.0 - area(&inscribed) / due;
        // Of a sphere in 32 parts a sixtieth is missing.
        assert!(missing > 0.0 && missing < 0.017, "{type_}: {missing}");
        let corner = |k: u32| Point::from(inscribed.positions[k as usize]);
        for t in &inscribed.triangles {
            let [a, b, c] = t.map(corner);
            let facing = (b - a).cross(c - a);
            assert!(facing.length() > 0.0, "{type_}: {t:?}");
            for k in t {
                let normals = inscribed.normals.as_ref();
                let normal =
                    normals.map_or(Vector::from([1.0, 2.0, 2.0]), |n| n[*k as usize].into());
                assert!(facing.dot(normal) > 0.0, "{type_}: {t:?}");
            }
        }
    }

    #[test]
    fn round_surfaces() {
        let tall = [1.0, 2.0, 3.0, 1.0, 4.0, 4.0];
        let with = |rest: &[f64]| [&tall[..], rest].concat();
        let slant = |r: f64| libm::sqrt(5.0 + r * r);
        for type_ in ["sphere", "bubble"] {
            check(type_, &[5.0, -1.0, 2.0, 0.5], PI);
        }
        for type_ in ["cylinder", "tube"] {
            check(type_, &with(&[0.5]), PI * libm::sqrt(5.0));
        }
        for type_ in ["cone", "cup"] {
            check(type_, &with(&[0.5, 0.25]), PI * 0.75 * slant(0.25));
            check(type_, &with(&[0.5, 0.0]), PI * 0.5 * slant(0.5));
            check(type_, &with(&[0.0, 0.5]), PI * 0.5 * slant(0.5));
        }
        check("ring", &[1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 0.0, 2.0], 4.0 * PI);
        check("ring", &[1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 3.0, 1.0], 8.0 * PI);
    }

    #[test]
    fn sides_are_those_of_radiance() {
        let out = |type_: &str, numbers: &[f64], from: Point| {
            let shape = shape(type_, numbers, false);
            let [a, b, c] = shape.triangles[0].map(|k| Point::from(shape.positions[k as usize]));
            (b - a).cross(c - a).dot(a - from) > 0.0
        };
        let axis = [0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.5];
        assert!(out("cylinder", &axis, Point::ORIGIN) && !out("tube", &axis, Point::ORIGIN));
        let ball = [0.0, 0.0, 0.0, 1.0];
        assert!(out("sphere", &ball, Point::ORIGIN) && !out("bubble", &ball, Point::ORIGIN));
        let ring = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.5, 1.0];
        assert!(out("ring", &ring, Point::ORIGIN));
        let face = [0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0];
        assert!(out("polygon", &face, Point::ORIGIN));
    }

    #[test]
    fn wrong_arguments() {
        for (type_, numbers) in [
            ("sphere", &[0.0, 0.0, 0.0, 0.0][..]),
            ("sphere", &[0.0, 0.0, 0.0, -1.0]),
            ("sphere", &[0.0; 3]),
            ("ring", &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
            ("ring", &[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0]),
            ("cylinder", &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
            ("cone", &[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, -1.0]),
            ("cone", &[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]),
            ("polygon", &[0.0; 8]),
            ("polygon", &[]),
            ("mesh", &[]),
        ] {
            assert!(tessellate(&object(type_, numbers), false).is_err(), "{type_} {numbers:?}");
        }
        let flat = tessellate(&object("polygon", &[1.0; 12]), false);
        assert!(flat.is_ok_and(|t| t.oddity.is_some() && t.shape.triangles.is_empty()));
    }
}
