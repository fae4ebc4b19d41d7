//! Edges at which surfaces end before walls, and the falloff of light towards them.
//!
//! Two walls that meet light each other across their edge. At a distance `d` from the edge, the light from the other
//! wall, whose own light is `a + b s` at a distance `s` from it, is a smooth function of `d` plus a multiple of `d ln
//! d`, whose slope has no bound. No polynomial and no few elements come near it; a polynomial with that function
//! beside it does.

use crate::elements::{Elements, FewNumbers, Subdivision, carries_map, edge_key};
use crate::scene::Scene;
use isolux_geometry::{Direction, Point, Ray, Vector};
use std::collections::{HashMap, HashSet};

/// The distance from an edge of the start of the ray that looks for a wall, in lengths of the edge.
const ASIDE: f64 = 0.05;
/// The rise of that ray relative to its advance.
const RISE: f64 = 0.5;
/// The length of that ray, in distances of its start from the edge. It meets an upright wall at 1.1, one that leans
/// outwards by 45 degrees at 2.2.
const REACH: f64 = 3.0;

/// The largest distance of the ends of edges from a line that they lie on, as a share of their lengths: the rounding
/// of coordinates.
const BESIDE: f64 = 1e-4;

/// The number of lines above which a surface is curved.
const MOST_LINES: usize = 64;

/// The distance of the middle of an element from a wall, in its longest edges, up to which the wall stands close.
const FROM_WALL: f64 = 1.5;

/// The root mean square error of linear interpolation in the elements that touch a wall, as a share of the falloff of
/// light over them: `d ln d` has an error of 0.27 of the width of a strip, and falls by 1.3 to 2 of it.
const OF_DROP: f64 = 0.18;
/// The share of the accuracy goal that this error may take. Halving elements leaves the root of an eighth of the
/// error.
const SHARE: f64 = 0.2;
/// The largest number of halvings.
const MOST_HALVINGS: u32 = 6;
/// The least number of halvings, since the first may take the second row.
const FEWEST_HALVINGS: u32 = 2;

/// The number of vertices made by halving an element that touches a wall, with those that keep elements together. In
/// CUBE one to four were found.
const MORE_VERTICES: f64 = 2.4;

/// The largest mean number of vertices made by halving an element.
const MOST_OF_ONE: usize = 4;

/// The distance of rows of vertices from walls, as a share of the width of their elements.
const ROW: f64 = 0.25;

/// The largest number of walls of a surface that count at a place.
pub(crate) const MOST_NEAR: usize = 2;

/// A straight line at which a surface ends before a wall.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wall {
    from: Point,
    /// The unit vector along the line.
    along: Vector,
    /// The unit vector into the surface.
    inward: Vector,
    /// The begin and end of the wall along the line, m.
    reach_m: [f64; 2],
}

/// All lines at which surfaces end before walls.
#[derive(Debug, Default)]
pub(crate) struct EdgeFalloffs {
    lines: Vec<Wall>,
    /// The lines of each piece of surface.
    of_piece: HashMap<u32, Vec<u32>, FewNumbers>,
    /// The piece of each vertex.
    pieces: Vec<u32>,
    /// The lines that each vertex lies on.
    at: Vec<Vec<u32>>,
    /// The edges of elements on lines, by their ends, the lower first.
    edges: HashSet<[u32; 2], FewNumbers>,
    /// The number of times that elements are to be halved there.
    halvings: u32,
    /// The number of elements that touch a line.
    touching: usize,
}

/// The number of strips by distance from walls that light is resolved towards. The strip of an element is that of its
/// farthest vertex; strip 0 is elsewhere.
pub(crate) const STRIPS: usize = 3;
/// The strip of elements close to a wall.
const CLOSE: u8 = 1;
/// The strip of elements that touch a wall.
const TOUCHING: u8 = 2;

/// A vertex that carries light beside a wall.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beside {
    /// The vertex beside the wall.
    pub(crate) vertex: u32,
    /// The vertex on the wall that it stands beside.
    pub(crate) of: u32,
}

impl Wall {
    /// The distance of a place of the surface from the wall, m; beyond the ends of the wall, the distance from these.
    pub(crate) fn distance_m(&self, at: Point) -> f64 {
        let to = at - self.from;
        let [begin_m, end_m] = self.reach_m;
        (to - self.along * to.dot(self.along).clamp(begin_m, end_m)).length()
    }

    /// Whether an edge lies on the same straight line.
    fn continues(&self, ends: [Point; 2]) -> bool {
        let [from, to] = ends.map(|end| end - self.from);
        let beside_m = from.cross(self.along).length().max(to.cross(self.along).length());
        beside_m < BESIDE * (to - from).length()
    }

    fn extend(&mut self, ends: [Point; 2]) {
        for end in ends {
            let along_m = (end - self.from).dot(self.along);
            let [begin_m, end_m] = self.reach_m;
            self.reach_m = [begin_m.min(along_m), end_m.max(along_m)];
        }
    }
}

impl EdgeFalloffs {
    /// The lines of surfaces where their vertices are `open`.
    pub(crate) fn of(scene: &Scene, subdivision: &Subdivision, open: &[bool]) -> Self {
        let pieces = subdivision.least_connected();
        let mut walls =
            Self { at: vec![Vec::new(); subdivision.vertex_count()], pieces, ..Self::default() };
        let borders: HashSet<[u32; 2], FewNumbers> =
            subdivision.border_edges().into_iter().collect();
        for leaf in subdivision.leaves() {
            let corners = subdivision.node(leaf).0.vertices;
            for k in 0..3 {
                let [a, b, c] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
                let ends = edge_key(a, b);
                if borders.contains(&ends) && open[a as usize] && open[b as usize] {
                    walls.look(scene, (subdivision, leaf), [a, b, c]);
                }
            }
        }
        walls.of_piece.retain(|_, lines| lines.len() <= MOST_LINES);
        let of_piece = &walls.of_piece;
        for (at, piece) in walls.at.iter_mut().zip(&walls.pieces) {
            if !of_piece.contains_key(piece) {
                at.clear();
            }
        }
        walls
    }

    /// Adds the edge between the first two corners of an element if a wall stands there.
    fn look(&mut self, scene: &Scene, (subdivision, leaf): (&Subdivision, u32), corners: [u32; 3]) {
        let vertices = subdivision.vertices();
        let [from, to, far] = corners.map(|v| vertices[v as usize].position);
        let up = vertices[corners[0] as usize].normal.to_vector();
        let length = (to - from).length();
        let Some(along) = (to - from).direction().map(Direction::to_vector) else { return };
        let beside = (far - from) - along * (far - from).dot(along);
        let Some(inward) = beside.direction().map(Direction::to_vector) else { return };
        let Some(outward) = (up * RISE - inward).direction() else { return };
        let aside_m = ASIDE * length;
        let start = from.lerp(to, 0.5) + inward * aside_m;
        let ray = Ray::new(start, outward)
            .skipping(subdivision.node(leaf).1.triangle)
            .up_to((REACH * aside_m) as f32);
        let hit = scene.bvh().closest_hit(&ray);
        // Mirrors do not end a room.
        if !hit.is_some_and(|hit| carries_map(scene, hit.triangle, hit.back)) {
            return;
        }
        let lines = self.of_piece.entry(self.pieces[corners[0] as usize]).or_default();
        if lines.len() > MOST_LINES {
            return;
        }
        let known = lines.iter().copied().find(|&k| self.lines[k as usize].continues([from, to]));
        let line = known.unwrap_or_else(|| {
            let line = self.lines.len() as u32;
            self.lines.push(Wall { from, along, inward, reach_m: [0.0, length] });
            lines.push(line);
            line
        });
        self.lines[line as usize].extend([from, to]);
        self.edges.insert(edge_key(corners[0], corners[1]));
        for end in &corners[..2] {
            let at = &mut self.at[*end as usize];
            if !at.contains(&line) {
                at.push(line);
            }
        }
    }

    /// Sets the number of halvings towards walls so that interpolation takes a share of the accuracy goal. `drop_lx`
    /// is the falloff of light over the elements that touch walls, root mean square over all surface; `touching` is
    /// their number.
    pub(crate) fn halve_for(&mut self, drop_lx: f64, touching: usize, accuracy_lx: f64) {
        self.touching = touching;
        let excess = OF_DROP * drop_lx / (SHARE * accuracy_lx);
        // Halved elements have half of the error on half of the area.
        self.halvings = match (libm::log2(excess) / 1.5).ceil() {
            halvings if halvings > 0.0 => (halvings as u32).clamp(FEWEST_HALVINGS, MOST_HALVINGS),
            _ => 0,
        };
    }

    /// Whether a wall stands close to a place of the surface of a vertex, in an element with edges of this length.
    pub(crate) fn stand_close(&self, vertex: u32, place: Point, longest_edge_m: f64) -> bool {
        let lines = self.of_piece.get(&self.pieces[vertex as usize]);
        let mut lines = lines.into_iter().flatten().map(|&line| &self.lines[line as usize]);
        lines.any(|line| line.distance_m(place) < FROM_WALL * longest_edge_m)
    }

    /// The falloff of light over an element that touches a wall, lx.
    pub(crate) fn drop_lx(&self, corners: [u32; 3], values: &[Option<f64>]) -> f64 {
        let [mut on, mut off] = [(0.0, 0.0); 2];
        for v in corners {
            let Some(value) = values[v as usize] else { return 0.0 };
            let side = if self.is_on(v) { &mut on } else { &mut off };
            *side = (side.0 + value, side.1 + 1.0);
        }
        if on.1 > 0.0 && off.1 > 0.0 { off.0 / off.1 - on.0 / on.1 } else { 0.0 }
    }

    /// Whether elements are to be finer at walls.
    pub(crate) const fn are_resolved(&self) -> bool {
        self.halvings > 0
    }

    /// The approximate number of vertices for this, beyond halving all elements once.
    pub(crate) fn more_vertices(&self) -> f64 {
        let doublings = libm::exp2(f64::from(self.halvings)) - 2.0;
        MORE_VERTICES * self.touching as f64 * doublings.max(0.0)
    }

    /// Whether a vertex lies on a wall.
    pub(crate) fn is_on(&self, vertex: u32) -> bool {
        !self.at[vertex as usize].is_empty()
    }

    /// Halves elements towards walls after their first halving, as often as [`EdgeFalloffs::halve_for`] has set,
    /// unless vertices become too many. Returns further vertices that are to carry light: one beside each vertex on a
    /// wall.
    pub(crate) fn refine(
        &mut self,
        subdivision: &mut Subdivision,
        max_vertices: usize,
    ) -> Vec<Beside> {
        let mut rows = Vec::new();
        if !self.are_resolved() {
            return rows;
        }
        let first = self.at.len() as u32;
        let edges_m = subdivision.longest_edges_m();
        self.extend(subdivision);
        for halving in 1..self.halvings {
            let touches =
                |&node: &u32| subdivision.node(node).0.vertices.iter().any(|&v| self.is_on(v));
            let touching: Vec<u32> = subdivision.leaves().filter(touches).collect();
            // Each halved element makes this many vertices, with those that keep elements together.
            if subdivision.vertex_count() + MOST_OF_ONE * touching.len() > max_vertices {
                break;
            }
            touching.into_iter().for_each(|node| subdivision.bisect_twice(node));
            self.extend(subdivision);
            if halving == 1 {
                rows = self.rows(subdivision, first, &edges_m);
            }
        }
        rows
    }

    /// The strip of each vertex: at elements that touch a wall, at those below nodes that were `close` to one, or
    /// elsewhere. It is empty where light is not resolved.
    pub(crate) fn strips(&self, elements: &Elements, close: impl Iterator<Item = u32>) -> Vec<u8> {
        if !self.are_resolved() {
            return Vec::new();
        }
        let mut strips = vec![0; elements.vertices().len()];
        for node in close {
            elements.visit_below(node, &mut |corners| {
                let is_on = |&v: &u32| self.at.get(v as usize).is_some_and(|at| !at.is_empty());
                let strip = if corners.iter().any(is_on) { TOUCHING } else { CLOSE };
                for v in corners {
                    strips[v as usize] = strip.max(strips[v as usize]);
                }
            });
        }
        strips
    }

    /// Adds the vertices that bisection has made since.
    fn extend(&mut self, subdivision: &Subdivision) {
        for v in self.at.len() as u32..subdivision.vertex_count() as u32 {
            let [a, b] = subdivision.vertices()[v as usize].parents.expect("made by bisection");
            self.pieces.push(self.pieces[a as usize]);
            let mut on_both = Vec::new();
            if self.edges.contains(&edge_key(a, b)) {
                on_both.clone_from(&self.at[a as usize]);
                on_both.retain(|line| self.at[b as usize].contains(line));
                self.edges.extend([a, b].map(|end| edge_key(end, v)));
            }
            self.at.push(on_both);
        }
    }

    /// The row beside each vertex on a wall before `first`: its new neighbour nearest to the distance of the row.
    fn rows(&self, subdivision: &Subdivision, first: u32, edges_m: &[f64]) -> Vec<Beside> {
        let vertices = subdivision.vertices();
        let mut nearest: Vec<Option<(f64, u32)>> = vec![None; first as usize];
        for leaf in subdivision.leaves() {
            let corners = subdivision.node(leaf).0.vertices;
            for of in corners.into_iter().filter(|&v| v < first && self.is_on(v)) {
                let inward = self.at[of as usize].iter().map(|&l| self.lines[l as usize].inward);
                let width_m = edges_m[of as usize] / std::f64::consts::SQRT_2;
                let place = inward.fold(vertices[of as usize].position, |at, inward| {
                    at + inward * (ROW * width_m)
                });
                for vertex in corners.into_iter().filter(|&v| v >= first && !self.is_on(v)) {
                    let here = ((vertices[vertex as usize].position - place).length(), vertex);
                    let best = &mut nearest[of as usize];
                    if best.is_none_or(|best| here < best) {
                        *best = Some(here);
                    }
                }
            }
        }
        let mut rows: Vec<Beside> = (0..first)
            .filter_map(|of| nearest[of as usize].map(|(_, vertex)| Beside { vertex, of }))
            .collect();
        rows.sort_by_key(|row| (row.vertex, row.of));
        rows.dedup_by_key(|row| row.vertex);
        rows
    }

    /// The lines that at least two of these vertices lie on, the nearest to a place first.
    pub(crate) fn near(&self, about: &[u32], at: Point) -> Vec<Wall> {
        let on = |&v: &u32| self.at.get(v as usize);
        let mut found: Vec<u32> = about.iter().filter_map(on).flatten().copied().collect();
        found.sort_unstable();
        let twice = found.chunk_by(|a, b| a == b).filter(|alike| alike.len() > 1);
        let line = |alike: &[u32]| (self.lines[alike[0] as usize].distance_m(at), alike[0]);
        let mut near: Vec<(f64, u32)> = twice.map(line).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        near.truncate(MOST_NEAR);
        near.into_iter().map(|(_, line)| self.lines[line as usize]).collect()
    }
}
