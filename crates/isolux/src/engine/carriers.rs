//! Vertices that carry indirect light, and those that it is interpolated to.
//!
//! Where the surfaces of a scene come in triangles far smaller than light varies over, not every
//! vertex has to gather. Vertices are numbered in levels, each so dense that no two of it are nearer
//! than half the spacing of the one before; the coarsest gather first, the next where details ask
//! for them, as elements are bisected elsewhere. What the others are is a linear combination of the
//! carriers of the level before about them: the value at the vertex of the quadratic function over
//! the tangent plane that fits those best (moving least squares: Lancaster, Salkauskas 1981), or the
//! linear one where they do not tell a quadratic one. A vertex that neither can be had for carries
//! light itself. So do those that stand for gaps and rims, and all that bisection makes.

use crate::elements::{Subdivision, Vertex};
use crate::units::Rgb;
use isolux_geometry::{Point, Vector};
use rayon::prelude::*;
use std::collections::HashMap;

/// Root mean square of the linear interpolation error over an element, as a share of the detail of
/// its newest vertex. For a parabola across the edge the error at the middle of the next edge is a
/// quarter of the detail and the root mean square over the edge is 0.73 of that; kinks and shadow
/// borders, which come to matter as the rest is resolved, make it up to twice as much.
pub(super) const ERROR_OF_DETAIL: f64 = 0.3;

/// Levels at most: spacings a factor of two apart.
const MOST_LEVELS: u8 = 12;

/// Surfaces with fewer vertices are left as they are.
const FEWEST_VERTICES: usize = 32;

/// Neighbours face ways no farther apart than this, 45 degrees: over more, a tangent plane is none.
const LEAST_COS: f64 = 0.7;

/// Neighbours that a value is interpolated from, and how far from it they are at most, in spacings.
const NEIGHBOURS: usize = 12;
const REACH: f64 = 2.5;

/// Weights whose magnitudes add up to more extrapolate.
const MOST_WEIGHT: f64 = 1.6;

/// Columns of least squares of which less than this is left by those before depend on them.
const LEAST_PIVOT: f64 = 1e-3;

/// A value is bounded to the range of those it comes from, and this share of it beyond: quadratic
/// functions overshoot where light has a kink.
const BEYOND: f64 = 0.25;

/// What a vertex that need not carry light is interpolated from.
#[derive(Clone, Debug, PartialEq)]
struct Link {
    parents: Vec<(u32, f64)>,
    /// How far carriers of the level before are from each other, m.
    spacing_m: f64,
}

/// Which vertices carry light.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Carriers {
    /// Of the vertices of the first mesh; those without always carry light.
    links: Vec<Option<Link>>,
    /// Whether they do; vertices beyond these carry light.
    active: Vec<bool>,
    /// Those with links, coarse to fine.
    order: Vec<u32>,
}

/// What is told of the light at a vertex that does not carry it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Told {
    /// What interpolation there errs by, root mean square, as by details of the carriers about it.
    pub(super) error: f64,
    /// Whether something stands closer before one of them than they are apart.
    pub(super) is_beset: bool,
}

impl Carriers {
    /// All vertices.
    pub(super) fn all() -> Self {
        Self::default()
    }

    /// As few as possible, no farther than `spacing_m` apart, and those half as far. Vertices that are not
    /// `open` carry light in any case, and no other is interpolated from them.
    pub(super) fn sparse(subdivision: &Subdivision, spacing_m: f64, open: &[bool]) -> Self {
        let surfaces = Surfaces::of(subdivision, open);
        let mut levels = surfaces.levels(spacing_m);
        let links = surfaces.links(spacing_m, &mut levels);
        let mut order: Vec<u32> =
            (0..links.len() as u32).filter(|&v| links[v as usize].is_some()).collect();
        order.sort_by_key(|&v| (levels[v as usize], v));
        let active = (0..links.len()).map(|v| links[v].is_none() || levels[v] <= 1).collect();
        Self { links, active, order }
    }

    /// Whether a vertex carries light.
    pub(super) fn is_active(&self, vertex: u32) -> bool {
        self.active.get(vertex as usize).is_none_or(|&active| active)
    }

    /// How many of so many vertices do.
    pub(super) fn count(&self, vertices: usize) -> usize {
        vertices - self.active.iter().filter(|&&active| !active).count()
    }

    /// Of each of these vertices that does not carry light, makes the coarsest that it waits for do so:
    /// one level and no more, however many ask.
    pub(super) fn activate(&mut self, asked: &[u32]) {
        let mut next: Vec<u32> = Vec::new();
        let mut asking: Vec<u32> = asked.iter().copied().filter(|&v| !self.is_active(v)).collect();
        let mut seen = vec![false; self.active.len()];
        while let Some(vertex) = asking.pop() {
            if std::mem::replace(&mut seen[vertex as usize], true) {
                continue;
            }
            let parents = self.links[vertex as usize].iter().flat_map(|link| &link.parents);
            let waiting = parents.map(|&(p, _)| p).filter(|&p| !self.is_active(p));
            let before = asking.len();
            asking.extend(waiting);
            if asking.len() == before {
                next.push(vertex);
            }
        }
        next.into_iter().for_each(|vertex| self.active[vertex as usize] = true);
    }

    /// The carriers that some other vertex is interpolated from.
    pub(super) fn parents(&self) -> Vec<u32> {
        let waiting = self.order.iter().filter(|&&v| !self.active[v as usize]);
        let links = waiting.filter_map(|&v| self.links[v as usize].as_ref());
        let mut parents: Vec<u32> = links.flat_map(|link| &link.parents).map(|&(p, _)| p).collect();
        parents.retain(|&p| self.active[p as usize]);
        parents.sort_unstable();
        parents.dedup();
        parents
    }

    /// What belongs to those that do not carry light, shared among the carriers that they are interpolated from.
    pub(super) fn hand_down(&self, of_vertices: &mut [f64]) {
        for &vertex in self.order.iter().rev().filter(|&&v| !self.active[v as usize]) {
            let Some(link) = &self.links[vertex as usize] else { continue };
            let own = std::mem::take(&mut of_vertices[vertex as usize]);
            let size: f64 = link.parents.iter().map(|(_, weight)| weight.abs()).sum();
            for &(parent, weight) in &link.parents {
                of_vertices[parent as usize] += own * weight.abs() / size;
            }
        }
    }

    /// Puts the values of those that do not carry light where they belong.
    pub(super) fn fill(&self, values: &mut [Rgb]) {
        for &vertex in self.order.iter().filter(|&&v| !self.active[v as usize]) {
            let Some(link) = &self.links[vertex as usize] else { continue };
            values[vertex as usize] = link.read(values);
        }
    }

    /// The detail of a carrier: its value but what would be interpolated there, and over which spacing;
    /// `None` where it is not interpolated, or from vertices that say nothing.
    pub(super) fn detail(&self, values: &[Option<f64>], vertex: u32) -> Option<(f64, f64)> {
        let link = self.links.get(vertex as usize)?.as_ref()?;
        let mut detail = values[vertex as usize]?;
        for &(parent, weight) in &link.parents {
            detail -= weight * values[parent as usize]?;
        }
        Some((detail.abs(), link.spacing_m))
    }

    /// What is told of the vertices of the first mesh that do not carry light; `is_beset` says of a
    /// carrier whether something stands nearer before it than so far.
    pub(super) fn told(
        &self,
        values: &[Option<f64>],
        is_beset: impl Fn(u32, f64) -> bool,
    ) -> Vec<Option<Told>> {
        let mut told: Vec<Option<Told>> = vec![None; self.links.len()];
        for &vertex in self.order.iter().filter(|&&v| !self.active[v as usize]) {
            let Some(link) = &self.links[vertex as usize] else { continue };
            let mut here = Told { error: 0.0, is_beset: false };
            let mut any = false;
            for &(parent, _) in &link.parents {
                let of = told[parent as usize];
                let error = match (&of, self.detail(values, parent)) {
                    (Some(told), _) => Some(told.error),
                    (None, detail) => detail.map(|(detail, _)| ERROR_OF_DETAIL * detail),
                };
                any |= error.is_some();
                here.error = here.error.max(error.unwrap_or(0.0));
                here.is_beset |=
                    of.map_or_else(|| is_beset(parent, link.spacing_m), |told| told.is_beset);
            }
            if !any {
                let known = link.parents.iter().filter_map(|&(p, _)| values[p as usize]);
                let (low, high) = known.fold((f64::INFINITY, 0.0_f64), |(low, high), value| {
                    (low.min(value), high.max(value))
                });
                here.error = 0.5 * ERROR_OF_DETAIL * (high - low.min(high));
            }
            told[vertex as usize] = Some(here);
        }
        told
    }
}

impl Link {
    fn read(&self, values: &[Rgb]) -> Rgb {
        let mut sum = Rgb::BLACK;
        let (mut low, mut high) = (Rgb::grey(f64::INFINITY), Rgb::grey(f64::NEG_INFINITY));
        for &(parent, weight) in &self.parents {
            let value = values[parent as usize];
            sum += value * weight;
            for c in 0..3 {
                low.0[c] = low.0[c].min(value.0[c]);
                high.0[c] = high.0[c].max(value.0[c]);
            }
        }
        let beyond = (high - low) * BEYOND;
        Rgb([0, 1, 2].map(|c| {
            sum.0[c].clamp((low.0[c] - beyond.0[c]).max(0.0), (high.0[c] + beyond.0[c]).max(0.0))
        }))
    }
}

/// The smooth surfaces that vertices are part of.
struct Surfaces<'a> {
    vertices: &'a [Vertex],
    /// By the least vertex of each; `None` for those that say nothing of others.
    of: Vec<Option<u32>>,
    /// Whether a vertex may be interpolated.
    can_wait: Vec<bool>,
}

impl<'a> Surfaces<'a> {
    fn of(subdivision: &'a Subdivision, open: &[bool]) -> Self {
        let vertices = subdivision.vertices();
        let of = least_connected(subdivision);
        let mut sizes = vec![0_usize; of.len()];
        of.iter().for_each(|&surface| sizes[surface as usize] += 1);
        let of = of.into_iter().zip(open);
        let of: Vec<Option<u32>> = of
            .map(|(of, &open)| (open && sizes[of as usize] >= FEWEST_VERTICES).then_some(of))
            .collect();
        let mut can_wait: Vec<bool> = of.iter().map(Option::is_some).collect();
        for (v, vertex) in vertices.iter().enumerate() {
            for end in vertex.parents.into_iter().flatten() {
                (can_wait[v], can_wait[end as usize]) = (false, false);
            }
        }
        Self { vertices, of, can_wait }
    }

    /// A grid of some of the vertices, to be asked for those within reach of a place.
    fn grid(&self, reach_m: f64, some: impl Fn(usize) -> bool) -> Grid {
        let mut grid = Grid { reach_m, cells: HashMap::new() };
        for (v, of) in self.of.iter().enumerate() {
            if let Some(surface) = of.filter(|_| some(v)) {
                grid.insert(surface, v as u32, self.vertices[v].position);
            }
        }
        grid
    }

    /// The level of every vertex, zero for the coarsest: on every level, no vertex that is added is
    /// nearer to another one that faces its way than the spacing.
    fn levels(&self, coarsest_m: f64) -> Vec<u8> {
        let mut levels: Vec<u8> =
            self.can_wait.iter().map(|&waits| if waits { MOST_LEVELS } else { 0 }).collect();
        for level in 0..MOST_LEVELS {
            let spacing_m = spacing_of(coarsest_m, level);
            let mut grid = self.grid(spacing_m, |v| levels[v] < MOST_LEVELS);
            let mut any_left = false;
            for v in (0..levels.len()).filter(|&v| self.can_wait[v]) {
                let (Some(surface), MOST_LEVELS) = (self.of[v], levels[v]) else { continue };
                let Vertex { position, normal, .. } = self.vertices[v];
                let mut is_free = true;
                grid.visit(surface, position, |other| {
                    let other = &self.vertices[other as usize];
                    let near = (other.position - position).length() < spacing_m;
                    is_free = !(near && other.normal.dot(normal) >= LEAST_COS);
                    is_free
                });
                if is_free {
                    levels[v] = level;
                    grid.insert(surface, v as u32, position);
                }
                any_left |= !is_free;
            }
            if !any_left {
                break;
            }
        }
        levels
    }

    /// What vertices are interpolated from. A vertex that comes to have no link is as coarse as any.
    fn links(&self, coarsest_m: f64, levels: &mut [u8]) -> Vec<Option<Link>> {
        let mut links: Vec<Option<Link>> = vec![None; levels.len()];
        let finest = levels.iter().copied().max().unwrap_or(0);
        for level in 1..=finest {
            let spacing_m = spacing_of(coarsest_m, level - 1);
            let grid = self.grid(REACH * spacing_m, |v| levels[v] < level);
            let own: Vec<usize> = (0..levels.len()).filter(|&v| levels[v] == level).collect();
            let link = |&v: &usize| self.link(v, &grid, spacing_m);
            let found: Vec<Option<Link>> = own.par_iter().map(link).collect();
            for (v, link) in own.into_iter().zip(found) {
                if link.is_none() {
                    levels[v] = 0;
                }
                links[v] = link;
            }
        }
        links
    }

    fn link(&self, vertex: usize, grid: &Grid, spacing_m: f64) -> Option<Link> {
        let Vertex { position, normal, .. } = self.vertices[vertex];
        let mut near: Vec<(f64, u32)> = Vec::new();
        grid.visit(self.of[vertex]?, position, |other| {
            let of = &self.vertices[other as usize];
            let distance_m = (of.position - position).length();
            if distance_m < grid.reach_m && of.normal.dot(normal) >= LEAST_COS {
                near.push((distance_m, other));
            }
            true
        });
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        near.truncate(NEIGHBOURS);
        let axis = normal.to_direction();
        let [x, y] = [[1.0, 0.0], [0.0, 1.0]]
            .map(|[x, y]| axis.from_local(Vector::new(x, y, 0.0)).to_vector());
        let width_m = (1.0 + 1e-3) * near.last()?.0;
        let sample = |&(distance_m, other): &(f64, u32)| {
            let to = self.vertices[other as usize].position - position;
            let share = distance_m / width_m;
            let bump = 1.0 - share * share;
            Sample { at: [to.dot(x) / width_m, to.dot(y) / width_m], weight: bump * bump }
        };
        let samples: Vec<Sample> = near.iter().map(sample).collect();
        let weights = [6, 3].into_iter().find_map(|terms| weights_at_origin(&samples, terms))?;
        let parents = near.iter().zip(weights).map(|(&(_, other), weight)| (other, weight));
        Some(Link { parents: parents.collect(), spacing_m })
    }
}

/// Of every vertex, the least that edges connect it to.
pub(super) fn least_connected(subdivision: &Subdivision) -> Vec<u32> {
    fn root(of: &mut [u32], mut v: u32) -> u32 {
        while of[v as usize] != v {
            of[v as usize] = of[of[v as usize] as usize];
            v = of[v as usize];
        }
        v
    }
    let mut of: Vec<u32> = (0..subdivision.vertex_count() as u32).collect();
    for leaf in subdivision.leaves() {
        let roots = subdivision.node(leaf).0.vertices.map(|v| root(&mut of, v));
        let least = roots.into_iter().min().unwrap_or(0);
        roots.iter().for_each(|&v| of[v as usize] = least);
    }
    (0..of.len() as u32).map(|v| root(&mut of, v)).collect()
}

fn spacing_of(coarsest_m: f64, level: u8) -> f64 {
    coarsest_m / f64::from(1_u32 << level)
}

/// Vertices by the cells of a grid, surface by surface.
struct Grid {
    reach_m: f64,
    cells: HashMap<(u32, [i64; 3]), Vec<u32>>,
}

impl Grid {
    /// Cells are twice as long as the reach: what is within reach of a place lies in two of them each way.
    fn cell(&self, c: f64) -> i64 {
        libm::floor(0.5 * c / self.reach_m) as i64
    }

    fn insert(&mut self, surface: u32, vertex: u32, at: Point) {
        let cell = [at.x, at.y, at.z].map(|c| self.cell(c));
        self.cells.entry((surface, cell)).or_default().push(vertex);
    }

    /// Visits all within reach of a place and some beyond, until told to stop.
    fn visit(&self, surface: u32, at: Point, mut go_on: impl FnMut(u32) -> bool) {
        let [x, y, z] =
            [at.x, at.y, at.z].map(|c| self.cell(c - self.reach_m)..=self.cell(c + self.reach_m));
        for x in x {
            for y in y.clone() {
                for z in z.clone() {
                    for &vertex in self.cells.get(&(surface, [x, y, z])).into_iter().flatten() {
                        if !go_on(vertex) {
                            return;
                        }
                    }
                }
            }
        }
    }
}

/// A place in the tangent plane, and how much it counts.
#[derive(Clone, Copy, Debug)]
struct Sample {
    at: [f64; 2],
    weight: f64,
}

/// Weights of the values at some places that give the value at the origin of the polynomial of best
/// fit with so many terms of `1, x, y, x2, xy, y2`; `None` where they do not tell it, or
/// extrapolate. By orthogonal columns (modified Gram-Schmidt).
fn weights_at_origin(samples: &[Sample], terms: usize) -> Option<Vec<f64>> {
    if samples.len() < terms {
        return None;
    }
    let roots: Vec<f64> = samples.iter().map(|s| s.weight.sqrt()).collect();
    let column = |term: usize| -> Vec<f64> {
        let value = |s: &Sample| {
            let [x, y] = s.at;
            [1.0, x, y, x * x, x * y, y * y][term]
        };
        samples.iter().zip(&roots).map(|(s, root)| value(s) * root).collect()
    };
    // The constant column comes last: what the others leave of it is what tells the value.
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for term in (1..terms).chain([0]) {
        let mut own = column(term);
        let before = dot(&own, &own);
        for other in &columns {
            let share = dot(&own, other) / dot(other, other);
            own.iter_mut().zip(other).for_each(|(a, b)| *a -= share * b);
        }
        if dot(&own, &own) <= LEAST_PIVOT * before {
            return None;
        }
        columns.push(own);
    }
    let last = columns.pop()?;
    let length = dot(&last, &last);
    let weights: Vec<f64> = last.iter().zip(&roots).map(|(c, root)| c * root / length).collect();
    let size: f64 = weights.iter().map(|w| w.abs()).sum();
    (size <= MOST_WEIGHT).then_some(weights)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
