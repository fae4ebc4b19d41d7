//! Which triangle of the scene of a map each triangle of a file is.

use super::placing::Frame;
use crate::Problem;
use crate::counted;
use crate::gltf::{Opened, Origin};
use isolux::geometry::{Point, Transform, Triangle};
use isolux::scene::{Scene, Shape};
use std::ops::Range;

/// Places that were turned, scaled and moved may be off by so many roundings of the largest coordinate.
const ROUNDINGS: f64 = 8.0;
const REMEDY: &str = "give the file that was solved, as it was then, or solve this one";

/// The triangles of the scene that a file's are.
pub(super) struct Matched {
    /// Of each shape of the file, for each of its triangles: without area they are in no scene.
    pub(super) triangles: Triangles,
    /// Triangles of the scene that are of other files.
    pub(super) others: usize,
}

/// Finds the shapes of the file among those of the scene, where they stand in a row: as written, or turned, scaled and moved by
/// what named the file.
pub(super) fn find(opened: &Opened, scene: &Scene) -> Result<Matched, Problem> {
    let shapes: Vec<&Shape> = opened.shapes.iter().map(|(_, shape)| shape).collect();
    if shapes.is_empty() {
        return Err(opened.problem("", "has no surface that could carry light", REMEDY));
    }
    let runs = Runs { scene, shapes, ranges: ranges(scene) };
    let starts = || 0..(runs.ranges.len() + 1).saturating_sub(runs.shapes.len());
    let mut found: Vec<Triangles> = Vec::new();
    let mut nearest: Option<Difference> = None;
    let mut keep = |tried: Result<_, Difference>| match tried {
        Ok(triangles) => found.push(triangles),
        Err(difference) => {
            let is_farther = |old: &Difference| old.shape < difference.shape;
            if nearest.as_ref().is_none_or(is_farther) {
                nearest = Some(difference);
            }
        }
    };
    for start in starts() {
        keep(runs.align(start, &Transform::IDENTITY, 0.0));
    }
    if found.is_empty()
        && let Some((frame, corners)) = runs.frame()
    {
        let placed = starts().filter_map(|start| runs.placed(start, &frame, &corners));
        found.extend(placed.take(2));
    }
    let of_scene = scene.triangle_count() as usize;
    match (found.pop(), found.is_empty()) {
        (Some(triangles), true) => {
            let own = triangles.iter().flatten().flatten().count();
            Ok(Matched { triangles, others: of_scene - own })
        }
        (Some(_), false) => {
            let what =
                "stands more than once in the scene of the map, and each copy has light of its own";
            Err(opened.problem("", what, "put the copies into one file, solve that, and give it"))
        }
        (None, _) => Err(runs.refusal(opened, nearest)),
    }
}

/// The scene's triangle of each of the file's, shape by shape.
type Triangles = Vec<Vec<Option<u32>>>;

/// A corner of the file: shape, triangle of those with an area, corner.
type Corner = (usize, u32, usize);

/// Where a file and a scene differ.
struct Difference {
    start: usize,
    /// Number of the shape in the file.
    shape: usize,
    /// The triangle that lies elsewhere; without one their numbers differ.
    triangle: Option<usize>,
}

struct Runs<'a> {
    scene: &'a Scene,
    shapes: Vec<&'a Shape>,
    /// Triangles of the shapes of the scene.
    ranges: Vec<Range<u32>>,
}

impl Runs<'_> {
    /// Follows the shapes of the scene from one on, all of whose corners must lie where the map takes those of the file.
    fn align(
        &self,
        start: usize,
        scene_from_file: &Transform,
        tolerance_m: f64,
    ) -> Result<Triangles, Difference> {
        let mesh = self.scene.bvh().mesh();
        let mut all = Vec::with_capacity(self.shapes.len());
        for (index, shape) in self.shapes.iter().enumerate() {
            let Range { start: mut next, end } = self.ranges[start + index].clone();
            let mut triangles = Vec::with_capacity(shape.triangles.len());
            for (number, &corners) in shape.triangles.iter().enumerate() {
                let own = corners.map(|v| Point::from(shape.positions[v as usize]));
                let placed = own.map(|p| mesh.local_from_world(scene_from_file.point(p)));
                let is_there = next < end && {
                    let there = self.scene.triangle(next).corners;
                    placed
                        .iter()
                        .zip(there)
                        .all(|(&p, q)| is_near(p, mesh.local_from_world(q), tolerance_m))
                };
                if is_there {
                    triangles.push(Some(next));
                    next += 1;
                } else if has_no_area(placed) || has_no_area(own.map(Point::to_f32)) {
                    triangles.push(None);
                } else {
                    return Err(Difference { start, shape: index, triangle: Some(number) });
                }
            }
            if next < end {
                return Err(Difference { start, shape: index, triangle: None });
            }
            all.push(triangles);
        }
        Ok(all)
    }

    /// Points that hold the file, and which they are.
    fn frame(&self) -> Option<(Frame, Vec<Corner>)> {
        let (mut points, mut corners) = (Vec::new(), Vec::new());
        for (index, shape) in self.shapes.iter().enumerate() {
            let placed =
                shape.triangles.iter().map(|t| t.map(|v| Point::from(shape.positions[v as usize])));
            let solid = placed.filter(|t| !has_no_area(t.map(Point::to_f32)));
            for (number, triangle) in solid.enumerate() {
                points.extend(triangle);
                corners.extend([0, 1, 2].map(|k| (index, number as u32, k)));
            }
        }
        Some((Frame::of(&points)?, corners))
    }

    /// The same from a shape of the scene on, wherever it was placed.
    fn placed(&self, start: usize, frame: &Frame, corners: &[Corner]) -> Option<Triangles> {
        let of_run = &self.ranges[start..start + self.shapes.len()];
        let counts = corners.chunk_by(|a, b| a.0 == b.0).map(|c| (c[0].0, c.len() / 3));
        if counts.into_iter().any(|(shape, count)| of_run[shape].len() != count) {
            return None;
        }
        let at = |k: usize| {
            let (shape, triangle, corner) = corners[k];
            self.scene.triangle(of_run[shape].start + triangle).corners[corner]
        };
        let map = frame.similarity(&at)?;
        let all = of_run.iter().cloned().flatten().flat_map(|t| self.scene.triangle(t).corners);
        let largest =
            all.flat_map(|p| [p.x, p.y, p.z]).fold(0.0, |most, c| f64::max(most, c.abs()));
        self.align(start, &map, ROUNDINGS * f64::from(f32::EPSILON) * largest).ok()
    }

    fn refusal(&self, opened: &Opened, nearest: Option<Difference>) -> Problem {
        let Some(Difference { start, shape, triangle }) = nearest else {
            let what = format!(
                "is not what the map was made of: it has {}, the scene of the map {}",
                counted(self.shapes.len(), "surface", "surfaces"),
                self.ranges.len()
            );
            return opened.problem("", what, REMEDY);
        };
        let (Origin { node, mesh, primitive, .. }, own) = &opened.shapes[shape];
        let place = format!("nodes[{node}], meshes[{mesh}].primitives[{primitive}]");
        let how = match triangle {
            Some(triangle) => format!(
                "triangle {triangle} of {} lies elsewhere in the map, or is not there",
                own.triangles.len()
            ),
            None => format!(
                "it has {}, in the map {}",
                counted(own.triangles.len(), "triangle", "triangles"),
                self.ranges[start + shape].len()
            ),
        };
        let what = format!("`{}` is not what the map was made of: {how}", own.name);
        opened.problem(place, what, REMEDY)
    }
}

fn is_near(p: [f32; 3], q: [f32; 3], tolerance_m: f64) -> bool {
    p.iter().zip(q).all(|(&p, q)| (f64::from(p) - f64::from(q)).abs() <= tolerance_m)
}

/// As the scene has it, which leaves such triangles out.
fn has_no_area(corners: [[f32; 3]; 3]) -> bool {
    Triangle { corners: corners.map(Point::from) }.normal().is_none()
}

/// Triangles of each shape: they follow one another.
fn ranges(scene: &Scene) -> Vec<Range<u32>> {
    let mut next = 0;
    (0..scene.shape_names().len() as u32)
        .map(|shape| {
            let start = next;
            while next < scene.triangle_count() && scene.shape_of(next) == shape {
                next += 1;
            }
            start..next
        })
        .collect()
}
