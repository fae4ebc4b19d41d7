//! Luminaires as a plan shows them.

use super::frame::{Place, Plane, Window};
use isolux::geometry::{Point, Ray, Vector};
use isolux::scene::{Luminaire, LuminaireKind, Scene};
use std::collections::HashMap;

/// A luminaire is looked for from the plane up to here and from so far beside it, m: a housing hides its own light.
const BESIDE_M: f64 = 0.4;
/// Short of the luminaire itself, m.
const SHORT_M: f64 = 0.02;
/// Points along either side of the grid from which it is looked for.
const LOOKS: u32 = 4;
/// An opening smaller than this is a point, m.
const POINT_M: f64 = 0.02;

/// A luminaire on a plan.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Lamp {
    /// Its name, as written in the scene.
    pub(super) name: String,
    /// The middle of it.
    pub(super) middle: Place,
    /// The ring around its luminous opening; `None` of a point.
    pub(super) opening: Option<Vec<Place>>,
}

/// Where a luminaire gives light.
struct Source {
    name: String,
    points: Vec<Point>,
}

/// The luminaires before a plane that lie in a window and share a room with the grid: those of other storeys do not.
pub(super) fn lamps(scene: &Scene, plane: &Plane, window: &Window) -> Vec<Lamp> {
    let mut sources = point_sources(scene);
    sources.extend(area_sources(scene));
    let lamp = |source: Source| {
        let lamp = lamp(&source, plane)?;
        let in_window = window.holds(lamp.middle);
        (in_window && shares_room(scene, plane, &source.points)).then_some(lamp)
    };
    sources.into_iter().filter_map(lamp).collect()
}

fn point_sources(scene: &Scene) -> Vec<Source> {
    let source = |luminaire: &Luminaire| {
        let LuminaireKind::Point { position, world_from_luminaire, area, .. } = &luminaire.kind
        else {
            return None;
        };
        let border = area.map_or(vec![Vector::ZERO], |area| area.border());
        let place = |from_middle| *position + world_from_luminaire.vector(from_middle);
        Some(Source {
            name: luminaire.name.clone(),
            points: border.into_iter().map(place).collect(),
        })
    };
    scene.luminaires().iter().filter_map(source).collect()
}

/// Emitting triangles that touch each other are one luminaire.
fn area_sources(scene: &Scene) -> Vec<Source> {
    let mut part_of: HashMap<[u64; 3], usize> = HashMap::new();
    let mut joined: Vec<usize> = Vec::new();
    let root = |joined: &[usize], mut part: usize| {
        while joined[part] != part {
            part = joined[part];
        }
        part
    };
    let mut corners: Vec<(usize, Point, u32)> = Vec::new();
    for area in scene.area_luminaires() {
        for &triangle in &area.triangles {
            let part = joined.len();
            joined.push(part);
            for corner in scene.triangle(triangle).corners {
                let key = <[f64; 3]>::from(corner).map(|c| (c + 0.0).to_bits());
                let other = root(&joined, *part_of.entry(key).or_insert(part));
                let own = root(&joined, part);
                joined[own.max(other)] = own.min(other);
                corners.push((part, corner, area.shape));
            }
        }
    }
    let mut index_of: HashMap<usize, usize> = HashMap::new();
    let mut sources: Vec<Source> = Vec::new();
    for (part, corner, shape) in corners {
        let index = *index_of.entry(root(&joined, part)).or_insert_with(|| {
            let name = scene.shape_names().get(shape as usize).cloned().unwrap_or_default();
            sources.push(Source { name, points: Vec::new() });
            sources.len() - 1
        });
        let known = scene.shape_names().get(shape as usize).map_or("", String::as_str);
        let source = &mut sources[index];
        source.name = common(&source.name, known);
        source.points.push(corner);
    }
    sources
}

/// Sides of a box are named after it: what two names have in common before a slash, else the first.
fn common(a: &str, b: &str) -> String {
    match (a == b, b.rsplit_once('/')) {
        (false, Some((body, _))) if a == body || a.starts_with(&format!("{body}/")) => {
            body.to_owned()
        }
        _ => a.to_owned(),
    }
}

fn lamp(source: &Source, plane: &Plane) -> Option<Lamp> {
    let is_before = source.points.iter().any(|point| plane.height_m(*point) > 0.0);
    let ring = hull(source.points.iter().map(|point| plane.foot(*point)).collect());
    let span = |k: usize| {
        let (low, high) =
            ring.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| {
                (low.min(at[k]), high.max(at[k]))
            });
        (0.5 * (low + high), high - low)
    };
    let ((s, width_m), (t, height_m)) = (span(0), span(1));
    let opening = (width_m.max(height_m) > POINT_M).then_some(ring);
    is_before.then(|| Lamp { name: source.name.clone(), middle: [s, t], opening })
}

/// Whether something of the grid is seen from a luminaire or from beside it.
fn shares_room(scene: &Scene, plane: &Plane, points: &[Point]) -> bool {
    let sum: Vector = points.iter().map(|p| p.to_vector()).fold(Vector::ZERO, |a, b| a + b);
    let middle = Point::default() + sum / points.len() as f64;
    let (foot, height_m) = (plane.foot(middle), (plane.height_m(middle) - SHORT_M).max(0.0));
    let looks = || {
        let share = |k: u32, axis: usize| {
            f64::from(plane.counts[axis]) * (f64::from(k) + 0.5) / f64::from(LOOKS) - 0.5
        };
        let inner = (0..LOOKS * LOOKS)
            .map(move |k| plane.at_index([share(k % LOOKS, 0), share(k / LOOKS, 1)]));
        inner.chain([foot])
    };
    let beside = [[0.0, 0.0], [BESIDE_M, 0.0], [-BESIDE_M, 0.0], [0.0, BESIDE_M], [0.0, -BESIDE_M]];
    beside.iter().any(|[s, t]| {
        let from = plane.point([foot[0] + s, foot[1] + t], height_m);
        looks().any(|place| !scene.bvh().any_hit(&Ray::between(from, plane.point(place, SHORT_M))))
    })
}

/// The convex hull, counter-clockwise (Andrew 1979).
fn hull(mut places: Vec<Place>) -> Vec<Place> {
    places.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    places.dedup();
    if places.len() < 3 {
        return places;
    }
    /// Corners that bend by less are straight, m2.
    const STRAIGHT_M2: f64 = 1e-9;
    let turns = |a: Place, b: Place, c: Place| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > STRAIGHT_M2
    };
    let half = |order: &mut dyn Iterator<Item = &Place>| {
        let mut kept: Vec<Place> = Vec::new();
        for &place in order {
            while kept.len() > 1 && !turns(kept[kept.len() - 2], kept[kept.len() - 1], place) {
                kept.pop();
            }
            kept.push(place);
        }
        kept.pop();
        kept
    };
    let mut ring = half(&mut places.iter());
    ring.extend(half(&mut places.iter().rev()));
    ring
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hulls_have_the_outermost_corners() {
        let square = vec![[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0]];
        assert_eq!(hull(square), [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
        assert_eq!(hull(vec![[1.0, 1.0]; 3]), [[1.0, 1.0]]);
    }

    #[test]
    fn sides_of_a_box_are_named_after_it() {
        assert_eq!(common("lamp/x_min", "lamp/x_max"), "lamp");
        assert_eq!(common("lamp", "lamp/z_min"), "lamp");
        assert_eq!(common("panel 1", "panel 2"), "panel 1");
    }
}
