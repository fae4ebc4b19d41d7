//! Coarsening of finely tessellated surfaces: levels of vertices, and the interpolation of the others.
//!
//! Surfaces are independent, so each is coarsened by itself.

use super::NO_INDEX;
use crate::elements::{FewNumbers, Subdivision, Vertex};
use isolux_geometry::{Point, Vector};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// The largest number of levels, whose spacings differ by factors of two.
const MOST_LEVELS: u8 = 12;

/// The number of vertices below which a surface is left as it is.
const FEWEST_VERTICES: usize = 32;

/// The least cosine between the normals of neighbours, 45 degrees. A tangent plane does not fit wider angles.
const LEAST_NORMALS_COS: f64 = 0.7;

/// The number of neighbours that a value is interpolated from.
const NEIGHBOURS: usize = 12;
/// The largest distance of neighbours, in spacings.
const REACH_SPACINGS: f64 = 2.5;

/// The largest sum of the magnitudes of weights; larger ones extrapolate.
const MOST_WEIGHTS_SUM: f64 = 1.6;

/// The least share of the squared length of a least-squares column that earlier columns leave; with less it depends
/// on them.
const LEAST_PIVOT_SHARE: f64 = 1e-3;

/// The largest distance of samples from a line that they lie on, as a share of their reach: the rounding of
/// coordinates.
const OFF_LINE_SHARE: f64 = 1e-4;
/// The number of nearest samples that are tried as directions of a line.
const TRIED_LINES: usize = 4;

/// The cosine at which a border has a corner: it turns by more than some 25 degrees.
const CORNER_COS: f64 = -0.9;

/// The interpolation of a vertex that need not carry light.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Link {
    /// The vertices that it is interpolated from, with weights.
    pub(crate) parents: Vec<(u32, f64)>,
    /// The spacing of carriers of the level before, m.
    pub(crate) spacing_m: f64,
}

/// A vertex with its level and its link.
struct Placed {
    vertex: u32,
    level: u8,
    link: Option<Link>,
}

/// The levels of vertices, and their interpolation.
pub(crate) struct Coarsening {
    /// The level of each vertex, zero for the coarsest.
    pub(crate) levels: Vec<u8>,
    /// The link of each vertex; `None` for those that are not interpolated.
    pub(crate) links: Vec<Option<Link>>,
}

impl Coarsening {
    /// The levels and links of vertices. Vertices of level zero lie at most `spacing_m` apart, those of each next
    /// level half as far. Vertices that are not `open` are not interpolated, nor is anything from them.
    pub(crate) fn of(subdivision: &Subdivision, spacing_m: f64, open: &[bool]) -> Self {
        let vertices = subdivision.vertices();
        let found: Vec<Vec<Placed>> = surfaces(subdivision, open)
            .into_par_iter()
            .map(|surface| surface.thinned_out(vertices, spacing_m))
            .collect();
        let mut levels = vec![0; vertices.len()];
        let mut links = vec![None; vertices.len()];
        for Placed { vertex, level, link } in found.into_iter().flatten() {
            levels[vertex as usize] = level;
            links[vertex as usize] = link;
        }
        Self { levels, links }
    }
}

/// A smooth surface: vertices connected by edges.
struct Surface {
    /// The open vertices: first corners of borders, then the rest of borders, then those between, which interpolate
    /// best.
    members: Vec<u32>,
    /// Whether each may be interpolated.
    can_wait: Vec<bool>,
}

/// The surfaces that have enough vertices.
fn surfaces(subdivision: &Subdivision, open: &[bool]) -> Vec<Surface> {
    let of = subdivision.least_connected();
    let rank = ranks(subdivision);
    let mut waits = vec![true; of.len()];
    for (v, vertex) in subdivision.vertices().iter().enumerate() {
        for end in vertex.parents.into_iter().flatten() {
            (waits[v], waits[end as usize]) = (false, false);
        }
    }
    let mut order: Vec<u32> = (0..of.len() as u32).collect();
    order.par_sort_unstable_by_key(|&v| (of[v as usize], rank[v as usize], v));
    let alike = order.chunk_by(|&a, &b| of[a as usize] == of[b as usize]);
    let surface = |all: &[u32]| {
        let members: Vec<u32> = all.iter().copied().filter(|&v| open[v as usize]).collect();
        let can_wait = members.iter().map(|&v| waits[v as usize]).collect();
        Surface { members, can_wait }
    };
    alike.filter(|all| all.len() >= FEWEST_VERTICES).map(surface).collect()
}

/// The rank of each vertex: at a corner of a border (0), on a border (1), or within (2).
fn ranks(subdivision: &Subdivision) -> Vec<u8> {
    let vertices = subdivision.vertices();
    let mut beside: Vec<[u32; 2]> = vec![[NO_INDEX; 2]; vertices.len()];
    let mut ranks = vec![2; vertices.len()];
    for [a, b] in subdivision.border_edges() {
        for (own, other) in [(a, b), (b, a)] {
            match beside[own as usize].iter_mut().find(|of| **of == NO_INDEX) {
                Some(free) => *free = other,
                // Borders meet here.
                None => ranks[own as usize] = 0,
            }
        }
    }
    for (v, &[a, b]) in beside.iter().enumerate() {
        if a == NO_INDEX || ranks[v] == 0 {
            continue;
        }
        let to = |other: u32| {
            let to = vertices[other as usize].position - vertices[v].position;
            to * (1.0 / to.length())
        };
        ranks[v] = u8::from(b != NO_INDEX && to(a).dot(to(b)) < CORNER_COS);
    }
    ranks
}

impl Surface {
    /// The levels and links of its vertices.
    fn thinned_out(&self, vertices: &[Vertex], spacing_m: f64) -> Vec<Placed> {
        let own: Vec<Vertex> = self.members.iter().map(|&v| vertices[v as usize]).collect();
        let mut levels = self.levels(&own, spacing_m);
        let links = self.links(&own, spacing_m, &mut levels);
        let of = self.members.iter().zip(levels).zip(links);
        of.map(|((&vertex, level), link)| Placed { vertex, level, link }).collect()
    }

    /// The level of each vertex, zero for the coarsest. No vertex added on a level is nearer than the spacing to
    /// another one that faces its way.
    fn levels(&self, own: &[Vertex], coarsest_m: f64) -> Vec<u8> {
        let mut levels: Vec<u8> =
            self.can_wait.iter().map(|&waits| if waits { MOST_LEVELS } else { 0 }).collect();
        let mut left: Vec<usize> = (0..own.len()).filter(|&v| self.can_wait[v]).collect();
        for level in 0..MOST_LEVELS {
            let spacing_m = spacing_of(coarsest_m, level);
            let mut grid = Grid::of(own, spacing_m, |v| levels[v] < MOST_LEVELS);
            left.retain(|&v| {
                let Vertex { position, normal, .. } = own[v];
                let mut is_free = true;
                grid.visit(position, |other| {
                    let near = (own[other].position - position).length() < spacing_m;
                    is_free = !(near && own[other].normal.dot(normal) >= LEAST_NORMALS_COS);
                    is_free
                });
                if is_free {
                    levels[v] = level;
                    grid.insert(v, position);
                }
                !is_free
            });
            if left.is_empty() {
                break;
            }
        }
        levels
    }

    /// The links of vertices. A vertex that gets no link joins the coarsest level.
    fn links(&self, own: &[Vertex], coarsest_m: f64, levels: &mut [u8]) -> Vec<Option<Link>> {
        let mut links: Vec<Option<Link>> = vec![None; levels.len()];
        let finest = levels.iter().copied().max().unwrap_or(0);
        for level in 1..=finest {
            let spacing_m = spacing_of(coarsest_m, level - 1);
            let grid = Grid::of(own, REACH_SPACINGS * spacing_m, |v| levels[v] < level);
            let added: Vec<usize> = (0..levels.len()).filter(|&v| levels[v] == level).collect();
            let link = |&v: &usize| self.link(own, v, &grid, spacing_m);
            let found: Vec<Option<Link>> = added.par_iter().map(link).collect();
            for (v, link) in added.into_iter().zip(found) {
                if link.is_none() {
                    levels[v] = 0;
                }
                links[v] = link;
            }
        }
        links
    }

    fn link(&self, own: &[Vertex], vertex: usize, grid: &Grid, spacing_m: f64) -> Option<Link> {
        let Vertex { position, normal, .. } = own[vertex];
        let mut near: Vec<(f64, usize)> = Vec::new();
        grid.visit(position, |other| {
            let distance_m = (own[other].position - position).length();
            if distance_m < grid.reach_m && own[other].normal.dot(normal) >= LEAST_NORMALS_COS {
                near.push((distance_m, other));
            }
            true
        });
        let of = weights_at(&own[vertex], near, |other| own[other].position)?;
        let parents = of.into_iter().map(|(other, weight)| (self.members[other], weight)).collect();
        Some(Link { parents, spacing_m })
    }
}

/// Neighbours and weights that give the value at a place by moving least squares, from neighbours with their
/// distances, m.
fn weights_at(
    at: &Vertex,
    mut near: Vec<(f64, usize)>,
    position: impl Fn(usize) -> Point,
) -> Option<Vec<(usize, f64)>> {
    let order = |a: &(f64, usize), b: &(f64, usize)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
    if near.len() > NEIGHBOURS {
        near.select_nth_unstable_by(NEIGHBOURS, order);
        near.truncate(NEIGHBOURS);
    }
    near.sort_unstable_by(order);
    let axis = at.normal.to_direction();
    let [x, y] =
        [[1.0, 0.0], [0.0, 1.0]].map(|[x, y]| axis.from_local(Vector::new(x, y, 0.0)).to_vector());
    let width_m = (1.0 + 1e-3) * near.last()?.0;
    let sample = |&(distance_m, other): &(f64, usize)| {
        let to = position(other) - at.position;
        let share = distance_m / width_m;
        let bump = 1.0 - share * share;
        Sample { at: [to.dot(x) / width_m, to.dot(y) / width_m], weight: bump * bump }
    };
    let mut samples = [Sample::default(); NEIGHBOURS];
    samples.iter_mut().zip(&near).for_each(|(own, near)| *own = sample(near));
    let samples = &samples[..near.len()];
    let over_plane = PLANE_TERMS.into_iter().find_map(|beside| weights(samples, beside));
    let weights = over_plane.or_else(|| weights_along_line(samples))?;
    let of = near.iter().zip(weights).filter(|(_, weight)| *weight != 0.0);
    let mut told = Vec::with_capacity(near.len());
    told.extend(of.map(|(&(_, other), weight)| (other, weight)));
    Some(told)
}

fn spacing_of(coarsest_m: f64, level: u8) -> f64 {
    coarsest_m / f64::from(1_u32 << level)
}

/// Vertices in the cells of a grid.
struct Grid {
    reach_m: f64,
    cells: HashMap<[i64; 3], Vec<usize>, FewNumbers>,
}

impl Grid {
    /// A grid of some of the vertices, to be asked for those within reach of a place.
    fn of(vertices: &[Vertex], reach_m: f64, some: impl Fn(usize) -> bool) -> Self {
        let mut grid = Self { reach_m, cells: HashMap::default() };
        for (v, vertex) in vertices.iter().enumerate().filter(|&(v, _)| some(v)) {
            grid.insert(v, vertex.position);
        }
        grid
    }

    /// The cell of a coordinate. Cells are twice as long as the reach, so vertices within reach of a place lie in at
    /// most two of them along each axis.
    fn cell(&self, c: f64) -> i64 {
        libm::floor(0.5 * c / self.reach_m) as i64
    }

    fn insert(&mut self, vertex: usize, at: Point) {
        let cell = [at.x, at.y, at.z].map(|c| self.cell(c));
        self.cells.entry(cell).or_default().push(vertex);
    }

    /// Visits all vertices within reach of a place and some beyond, until `go_on` returns false.
    fn visit(&self, at: Point, mut go_on: impl FnMut(usize) -> bool) {
        let [x, y, z] =
            [at.x, at.y, at.z].map(|c| self.cell(c - self.reach_m)..=self.cell(c + self.reach_m));
        for x in x {
            for y in y.clone() {
                for z in z.clone() {
                    for &vertex in self.cells.get(&[x, y, z]).into_iter().flatten() {
                        if !go_on(vertex) {
                            return;
                        }
                    }
                }
            }
        }
    }
}

/// A place in the tangent plane, and its weight.
#[derive(Clone, Copy, Debug, Default)]
struct Sample {
    at: [f64; 2],
    weight: f64,
}

/// A number for each sample, with zeros after the last.
type Column = [f64; NEIGHBOURS];

/// The largest number of terms: those of a quadratic function.
const MOST_TERMS: usize = 1 + PLANE_TERMS[0].len();

/// The sets of terms over a plane beside the constant, in the order in which they are tried.
const PLANE_TERMS: [&[usize]; 2] = [&[1, 2, 3, 4, 5], &[1, 2]];

/// The weights of the values at some places that give the value at the origin of the function of best fit. The
/// function is a constant and the terms `beside` it, of `1, x, y, x2, xy, y2`. `None` where the places do not determine
/// it or extrapolate. Columns are made orthogonal by modified Gram-Schmidt.
fn weights(samples: &[Sample], beside: &[usize]) -> Option<Column> {
    if samples.len() <= beside.len() {
        return None;
    }
    let mut roots: Column = [0.0; NEIGHBOURS];
    roots.iter_mut().zip(samples).for_each(|(root, s)| *root = s.weight.sqrt());
    let column = |term: usize| -> Column {
        let value = |s: &Sample| {
            let [x, y] = s.at;
            [1.0, x, y, x * x, x * y, y * y][term]
        };
        let mut column = [0.0; NEIGHBOURS];
        let of = samples.iter().zip(&roots).map(|(s, root)| value(s) * root);
        column.iter_mut().zip(of).for_each(|(own, value)| *own = value);
        column
    };
    // The constant column comes last: its part that the others leave determines the value.
    let mut columns = [[0.0; NEIGHBOURS]; MOST_TERMS];
    let mut squares = [0.0; MOST_TERMS];
    for (k, &term) in beside.iter().chain(&[0]).enumerate() {
        let mut own = column(term);
        let before = dot(&own, &own);
        for (other, square) in columns[..k].iter().zip(squares) {
            let share = dot(&own, other) / square;
            own.iter_mut().zip(other).for_each(|(a, b)| *a -= share * b);
        }
        (columns[k], squares[k]) = (own, dot(&own, &own));
        if squares[k] <= LEAST_PIVOT_SHARE * before {
            return None;
        }
    }
    let (mut weights, length) = (columns[beside.len()], squares[beside.len()]);
    weights.iter_mut().zip(roots).for_each(|(weight, root)| *weight *= root / length);
    let size: f64 = weights.iter().map(|w| w.abs()).sum();
    (size <= MOST_WEIGHTS_SUM).then_some(weights)
}

/// The weights for a polynomial along a line through the origin that some of the samples lie on, such as vertices of
/// one border. One of the nearest samples gives its direction.
fn weights_along_line(samples: &[Sample]) -> Option<Column> {
    samples.iter().take(TRIED_LINES).find_map(|towards| {
        let [x, y] = towards.at;
        let length = libm::hypot(x, y);
        let (cos, sin) = (x / length, y / length);
        let along = |s: &Sample| Sample { at: [s.at[0] * cos + s.at[1] * sin, 0.0], ..*s };
        let is_on = |s: &Sample| (s.at[1] * cos - s.at[0] * sin).abs() < OFF_LINE_SHARE;
        let on: Vec<usize> = (0..samples.len()).filter(|&k| is_on(&samples[k])).collect();
        let line: Vec<Sample> = on.iter().map(|&k| along(&samples[k])).collect();
        let found = [&[1, 3][..], &[1]].into_iter().find_map(|beside| weights(&line, beside))?;
        let mut all = [0.0; NEIGHBOURS];
        on.into_iter().zip(found).for_each(|(k, weight)| all[k] = weight);
        Some(all)
    })
}

/// The scalar product, as four sums side by side for vector instructions.
fn dot(a: &Column, b: &Column) -> f64 {
    let mut sums = [0.0; 4];
    for (a, b) in a.chunks_exact(4).zip(b.chunks_exact(4)) {
        (0..4).for_each(|k| sums[k] += a[k] * b[k]);
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}
