//! Geometry written in the scene file itself.

use super::context::Context;
use super::quantity::{Positive, Triple, plain};
use super::record::{BoxRecord, DiscRecord, RectangleRecord, SphereRecord};
use super::shapes::Piece;
use super::spans::{At, Span};
use crate::polygon::{MOST_CORNERS, area_vector, triangulate};
use crate::round;
use isolux::geometry::{Point, Vector};
use isolux::scene::Shape;

/// Corners of a polygon may lie off its plane by this share of its size: a millimetre in a metre,
/// as in surveyed plans.
const FLATNESS: f64 = 1e-3;
const USUAL_SEGMENTS: u32 = 32;
const MOST_SEGMENTS: u32 = 2048;

/// A flat polygon; its front is where its corners turn counter-clockwise.
pub(super) fn polygon(record: &At<Vec<Triple>>, context: &mut Context) -> Option<Vec<Piece>> {
    let corners: Vec<Point> = record.get_ref().iter().map(|&c| Point::from(plain(c))).collect();
    match cut(&corners) {
        Ok(shape) => Some(vec![Piece::whole(shape)]),
        Err((what, remedy)) => {
            context.problem(&record.span(), what, remedy);
            None
        }
    }
}

fn cut(corners: &[Point]) -> Result<Shape, (String, &'static str)> {
    let count = corners.len();
    if !(3..=MOST_CORNERS).contains(&count) {
        let what = format!("a polygon of {count} corners");
        return Err((what, "give 3 to 4096 corners"));
    }
    let Some(normal) = area_vector(corners).normal() else {
        return Err(("a polygon without area".into(), "give corners that are not on one line"));
    };
    let size = corners.iter().map(|&p| (p - corners[0]).length()).fold(0.0, f64::max);
    let centre = corners.iter().map(|&p| p - corners[0]).fold(Vector::ZERO, |a, b| a + b);
    let middle = corners[0] + centre / count as f64;
    for (k, &corner) in corners.iter().enumerate() {
        let off = (corner - middle).dot(normal.to_vector()).abs();
        if off > FLATNESS * size {
            let what = format!("corner {} of the polygon is {off:.3} off its plane", k + 1);
            return Err((what, "move it into the plane, or write triangles"));
        }
    }
    let cut = triangulate(corners);
    if cut.crosses_itself {
        return Err(("the polygon crosses itself".into(), "order its corners along the outline"));
    }
    Ok(Shape {
        positions: corners.iter().map(|&p| p.into()).collect(),
        triangles: cut.triangles.iter().map(|t| t.map(|k| k as u32)).collect(),
        ..Shape::default()
    })
}

/// A parallelogram, in front where u x v points.
pub(super) fn rectangle(record: &At<RectangleRecord>, context: &mut Context) -> Option<Vec<Piece>> {
    let RectangleRecord { corner, u, v } = record.get_ref();
    let [corner, u, v] = [corner, u, v].map(|&t| Vector::from(plain(t)));
    if u.cross(v).normal().is_none() {
        context.problem(&record.span(), "a rectangle without area", "give two different edges");
        return None;
    }
    Some(vec![Piece::whole(quad(corner, u, v))])
}

fn quad(corner: Vector, u: Vector, v: Vector) -> Shape {
    Shape {
        positions: [corner, corner + u, corner + u + v, corner + v].map(Into::into).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Shape::default()
    }
}

/// Six faces with names of their own.
pub(super) fn cuboid(record: &At<BoxRecord>, context: &mut Context) -> Option<Vec<Piece>> {
    let BoxRecord { min, max, inward } = record.get_ref();
    let (low, high) = (plain(*min), plain(*max));
    if !(0..3).all(|k| low[k] < high[k]) {
        let what = "`max` of the box is not above `min` in every axis";
        context.problem(&record.span(), what, "give the lowest corner first");
        return None;
    }
    let names = [("x_min", "x_max"), ("y_min", "y_max"), ("z_min", "z_max")];
    let mut pieces = Vec::with_capacity(6);
    for (axis, (low_name, high_name)) in names.into_iter().enumerate() {
        pieces.push(face(low_name, low, high, axis, *inward));
        pieces.push(face(high_name, high, low, axis, *inward));
    }
    Some(pieces)
}

/// The face at corner `at` perpendicular to an axis; `across` is the opposite corner of the box.
fn face(name: &str, at: [f64; 3], across: [f64; 3], axis: usize, inward: bool) -> Piece {
    let edge = |k: usize| {
        let mut along = [0.0; 3];
        along[k] = across[k] - at[k];
        Vector::from(along)
    };
    let (u, v) = (edge((axis + 1) % 3), edge((axis + 2) % 3));
    // Both edges turn round between the two faces, so u x v points along +axis on both.
    let outward = at[axis] > across[axis];
    let (u, v) = if outward == inward { (v, u) } else { (u, v) };
    Piece { slot: name.to_owned(), shape: quad(Vector::from(at), u, v) }
}

/// A flat disc.
pub(super) fn disc(record: &At<DiscRecord>, context: &mut Context) -> Option<Vec<Piece>> {
    let DiscRecord { centre, normal, radius, segments } = record.get_ref();
    let count = segments.unwrap_or(USUAL_SEGMENTS);
    let Some(normal) = Vector::from(plain(*normal)).direction() else {
        context.problem(&record.span(), "the normal of the disc is zero", "give its direction");
        return None;
    };
    if !(3..=MOST_SEGMENTS).contains(&count) {
        let what = format!("a disc of {count} segments");
        context.problem(&record.span(), what, format!("give 3 to {MOST_SEGMENTS}"));
        return None;
    }
    let shape = round::unit_disc(count, normal);
    Some(vec![Piece::whole(scaled(shape, *centre, *radius))])
}

/// A sphere, or the octant of it towards +x, +y, +z, with smooth normals.
pub(super) fn ball(record: &At<SphereRecord>, context: &mut Context) -> Option<Vec<Piece>> {
    let SphereRecord { centre, radius, segments, inward, octant } = record.get_ref();
    let count = sphere_segments(*segments, &record.span(), context)?;
    let shape = round::unit_sphere(count, *octant, *inward);
    Some(vec![Piece::whole(scaled(shape, *centre, *radius))])
}

fn sphere_segments(segments: Option<u32>, at: &Span, context: &mut Context) -> Option<u32> {
    let count = segments.unwrap_or(USUAL_SEGMENTS);
    if (4..=MOST_SEGMENTS).contains(&count) && count.is_multiple_of(4) {
        return Some(count);
    }
    let what = format!("a sphere of {count} segments");
    context.problem(at, what, format!("give a multiple of 4, from 4 to {MOST_SEGMENTS}"));
    None
}

fn scaled(mut shape: Shape, centre: Triple, radius: Positive) -> Shape {
    let centre = plain(centre);
    for p in &mut shape.positions {
        *p = std::array::from_fn(|k| centre[k] + radius.0 * p[k]);
    }
    shape
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every face of a box looks away from its middle, or towards it.
    #[test]
    fn faces_of_a_box_look_one_way() {
        for inward in [false, true] {
            for axis in 0..3 {
                for (name, at, across) in [
                    ("low", [0.0, 0.0, 0.0], [1.0, 2.0, 3.0]),
                    ("high", [1.0, 2.0, 3.0], [0.0, 0.0, 0.0]),
                ] {
                    let shape = face(name, at, across, axis, inward).shape;
                    let corners: Vec<Point> =
                        shape.positions.iter().map(|&p| Point::from(p)).collect();
                    let away = (corners[0].lerp(corners[2], 0.5) - Point::new(0.5, 1.0, 1.5))
                        .dot(area_vector(&corners));
                    assert_eq!(away > 0.0, !inward, "{name} {axis} {inward}");
                }
            }
        }
    }
}
