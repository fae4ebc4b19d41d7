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

use super::bounded::{Bounded, Range, Stencil};
use super::coarsening::{Coarsening, Link, weights_at};
use super::edge_falloff::{Beside, EdgeFalloffs};
use crate::elements::{Subdivision, Vertex};
use crate::units::Rgb;
use rayon::prelude::*;

/// Root mean square of the linear interpolation error over an element, as a share of the detail of
/// its newest vertex. For a parabola across the edge the error at the middle of the next edge is a
/// quarter of the detail and the root mean square over the edge is 0.73 of that; kinks and shadow
/// borders, which come to matter as the rest is resolved, make it up to twice as much.
pub(crate) const ERROR_OF_DETAIL: f64 = 0.3;

/// Vertices of one task.
const TOGETHER: usize = 1024;

/// Which vertices carry light.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Carriers {
    /// Of the vertices of the first mesh; those without always carry light.
    links: Vec<Option<Link>>,
    /// Whether they do; vertices beyond these carry light.
    active: Vec<bool>,
    /// Those with links, coarse to fine, and where each level ends.
    order: Vec<u32>,
    ends: Vec<usize>,
}

/// Vertices that do not carry light and what they are interpolated from, one after the other as they are read again and again.
#[derive(Clone, Debug, Default)]
pub(crate) struct Waiting {
    /// Coarse to fine, and where each level ends.
    vertices: Vec<u32>,
    levels: Vec<usize>,
    /// Of all of them what they are interpolated from, and where that of each ends.
    parents: Vec<(u32, f64)>,
    ends: Vec<usize>,
}

/// What is told of the light at a vertex that does not carry it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Told {
    /// What interpolation there errs by, root mean square, as by details of the carriers about it.
    pub(crate) error: f64,
    /// Whether something stands closer before one of them than they are apart.
    pub(crate) is_beset: bool,
}

impl Carriers {
    /// All vertices.
    pub(crate) fn all() -> Self {
        Self::default()
    }

    /// As few as possible, no farther than `spacing_m` apart, and those half as far. Vertices that are not
    /// `open` carry light in any case, and no other is interpolated from them.
    pub(crate) fn sparse(subdivision: &Subdivision, spacing_m: f64, open: &[bool]) -> Self {
        let Coarsening { levels, links } = Coarsening::of(subdivision, spacing_m, open);
        let mut order: Vec<u32> =
            (0..links.len() as u32).filter(|&v| links[v as usize].is_some()).collect();
        order.sort_by_key(|&v| (levels[v as usize], v));
        let active = (0..links.len()).map(|v| links[v].is_none() || levels[v] <= 1).collect();
        let alike = order.chunk_by(|&a, &b| levels[a as usize] == levels[b as usize]);
        let ends = alike.scan(0, |end, level| {
            *end += level.len();
            Some(*end)
        });
        let ends = ends.collect();
        Self { links, active, order, ends }
    }

    /// Makes vertices from `first` on, made by bisecting `elements`, wait: each is interpolated from the corners of the elements
    /// about it that carry light, or lies between the ends of its edge where those do not tell it. Before walls some
    /// carry light beside those. Of some vertices `keep_seen` keeps those that tell the light at another: what none of them does
    /// carries light itself.
    pub(crate) fn smooth(
        &mut self,
        subdivision: &Subdivision,
        first: usize,
        elements: &[[u32; 3]],
        open: &[bool],
        (walls, rows): (&EdgeFalloffs, &[Beside]),
        keep_seen: impl Fn(u32, &mut Vec<u32>) + Sync,
    ) {
        let vertices = subdivision.vertices();
        let rings = Rings::of(elements, first, rows, |v| open[v as usize] && self.is_active(v));
        let found = || Found::among(vertices.len());
        let wider = rings.wider(found);
        let link = |found: &mut Found, vertex: usize| {
            let ends = vertices[vertex].parents.expect("made by bisection");
            let mut between = first_ends(vertices, first, ends);
            let ends_of = || between.iter().map(|&(end, _)| end);
            let at = &vertices[vertex];
            let near_walls = walls.near(rings.about(ends_of(), found), at.position);
            if !near_walls.is_empty() {
                wider.about(ends_of(), found);
            }
            let distance_m = |v: u32| (vertices[v as usize].position - at.position).length();
            let seen = |mut some: Vec<u32>| {
                keep_seen(vertex as u32, &mut some);
                some
            };
            let near = seen(found.all.clone());
            let near = near.into_iter().map(|v| (distance_m(v), v as usize)).collect();
            let told = weights_at(at, near, |v| vertices[v].position, &near_walls);
            let told = told.filter(|_| open[vertex]);
            let told =
                told.map(|of| of.into_iter().map(|(v, weight)| (v as u32, weight)).collect());
            let ends_seen = seen(ends_of().collect());
            between.retain(|(end, _)| ends_seen.contains(end));
            // What is hidden has no light to tell.
            if between.iter().any(|&(end, _)| open[end as usize]) {
                between.retain(|&(end, _)| open[end as usize]);
            }
            let whole: f64 = between.iter().map(|(_, weight)| weight).sum();
            between.iter_mut().for_each(|(_, weight)| *weight /= whole);
            let parents = told.unwrap_or(between);
            let spacing_m = distance_m(ends[0]) + distance_m(ends[1]);
            (!parents.is_empty()).then_some(Link { parents, spacing_m })
        };
        self.links.resize(first, None);
        self.links.par_extend((first..vertices.len()).into_par_iter().map_init(found, link));
        for row in rows {
            self.links[row.vertex as usize] = None;
        }
        self.active.resize(first, true);
        self.active.extend(self.links[first..].iter().map(Option::is_none));
        // Those that lie between others, after these.
        let all = first as u32..vertices.len() as u32;
        self.order.extend(all.filter(|&v| self.links[v as usize].is_some()));
        self.ends.push(self.order.len());
    }

    /// Makes vertices from `first` on, made by bisection, wait: each lies between those ends of its edge that are open, if any.
    pub(crate) fn between(&mut self, subdivision: &Subdivision, first: usize, open: &[bool]) {
        let vertices = subdivision.vertices();
        let mut depths = vec![0_u32; vertices.len() - first];
        self.links.resize(first, None);
        for (k, vertex) in vertices[first..].iter().enumerate() {
            let ends = vertex.parents.expect("made by bisection");
            let depth =
                |end: u32| (end as usize).checked_sub(first).map_or(0, |made| depths[made] + 1);
            depths[k] = ends.map(depth).into_iter().fold(0, u32::max);
            let tells = |end: &u32| open[*end as usize] || ends.iter().all(|&e| !open[e as usize]);
            let told: Vec<u32> = ends.into_iter().filter(tells).collect();
            let parents = told.iter().map(|&end| (end, 1.0 / told.len() as f64)).collect();
            let [a, b] = ends.map(|end| vertices[end as usize].position);
            self.links.push(Some(Link { parents, spacing_m: (b - a).length() }));
        }
        self.active.resize(first, true);
        self.active.resize(vertices.len(), false);
        for depth in 0..=depths.iter().copied().max().unwrap_or(0) {
            let alike = (0..depths.len()).filter(|&k| depths[k] == depth);
            self.order.extend(alike.map(|k| (first + k) as u32));
            self.ends.push(self.order.len());
        }
    }

    /// Whether a vertex carries light.
    pub(crate) fn is_active(&self, vertex: u32) -> bool {
        self.active.get(vertex as usize).is_none_or(|&active| active)
    }

    /// How many of so many vertices do.
    pub(crate) fn count(&self, vertices: usize) -> usize {
        vertices - self.active.iter().filter(|&&active| !active).count()
    }

    /// Of each of these vertices that does not carry light, makes the coarsest that it waits for do so:
    /// one level and no more, however many ask.
    pub(crate) fn activate(&mut self, asked: &[u32]) {
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
    pub(crate) fn parents(&self) -> Vec<u32> {
        let waiting = self.order.iter().filter(|&&v| !self.active[v as usize]);
        let links = waiting.filter_map(|&v| self.links[v as usize].as_ref());
        let mut parents: Vec<u32> = links.flat_map(|link| &link.parents).map(|&(p, _)| p).collect();
        parents.retain(|&p| self.active[p as usize]);
        parents.sort_unstable();
        parents.dedup();
        parents
    }

    /// What belongs to those that do not carry light, shared among the carriers that they are interpolated from.
    pub(crate) fn hand_down(&self, of_vertices: &mut [f64]) {
        for &vertex in self.order.iter().rev().filter(|&&v| !self.active[v as usize]) {
            let Some(link) = &self.links[vertex as usize] else { continue };
            let own = std::mem::take(&mut of_vertices[vertex as usize]);
            let size: f64 = link.parents.iter().map(|(_, weight)| weight.abs()).sum();
            for &(parent, weight) in &link.parents {
                of_vertices[parent as usize] += own * weight.abs() / size;
            }
        }
    }

    /// Those that do not carry light.
    pub(crate) fn waiting(&self) -> Waiting {
        let mut waiting = Waiting::default();
        let mut start = 0;
        for &end in &self.ends {
            for &vertex in self.order[start..end].iter().filter(|&&v| !self.active[v as usize]) {
                let Some(link) = &self.links[vertex as usize] else { continue };
                waiting.vertices.push(vertex);
                waiting.parents.extend(&link.parents);
                waiting.ends.push(waiting.parents.len());
            }
            waiting.levels.push(waiting.vertices.len());
            start = end;
        }
        waiting
    }

    /// Puts the values of those that do not carry light where they belong.
    pub(crate) fn fill(&self, values: &mut [Rgb]) {
        self.waiting().fill(values);
    }

    /// Changes of those that do not carry light, by changes of the others.
    pub(crate) fn spread(&self, changes: &mut [Rgb]) {
        for &vertex in self.order.iter().filter(|&&v| !self.active[v as usize]) {
            let Some(link) = &self.links[vertex as usize] else { continue };
            let parts = link.parents.iter().map(|&(parent, w)| changes[parent as usize] * w);
            changes[vertex as usize] = parts.sum();
        }
    }

    /// The detail of a carrier: its value but what would be interpolated there, and over which spacing;
    /// `None` where it is not interpolated, or from vertices that say nothing.
    pub(crate) fn detail(&self, values: &[Option<f64>], vertex: u32) -> Option<(f64, f64)> {
        let link = self.links.get(vertex as usize)?.as_ref()?;
        let mut detail = values[vertex as usize]?;
        for &(parent, weight) in &link.parents {
            detail -= weight * values[parent as usize]?;
        }
        Some((detail, link.spacing_m))
    }

    /// What is told of the vertices of the first mesh that do not carry light; `is_beset` says of a
    /// carrier whether something stands nearer before it than so far.
    pub(crate) fn told(
        &self,
        values: &[Option<f64>],
        is_beset: impl Fn(u32, f64) -> bool + Sync,
    ) -> Vec<Option<Told>> {
        let mut told: Vec<Option<Told>> = vec![None; self.links.len()];
        let mut start = 0;
        for &end in &self.ends {
            // A level needs those before it alone.
            let level = &self.order[start..end];
            let waiting = level.par_iter().with_min_len(TOGETHER);
            let waiting = waiting.filter(|&&v| !self.active[v as usize]);
            let found: Vec<(u32, Told)> = waiting
                .filter_map(|&v| Some((v, self.told_at(v, values, &told, &is_beset)?)))
                .collect();
            found.into_iter().for_each(|(v, here)| told[v as usize] = Some(here));
            start = end;
        }
        told
    }

    fn told_at(
        &self,
        vertex: u32,
        values: &[Option<f64>],
        told: &[Option<Told>],
        is_beset: impl Fn(u32, f64) -> bool,
    ) -> Option<Told> {
        let link = self.links[vertex as usize].as_ref()?;
        let mut here = Told { error: 0.0, is_beset: false };
        let mut any = false;
        for &(parent, _) in &link.parents {
            let of = told[parent as usize];
            let error = match (&of, self.detail(values, parent)) {
                (Some(told), _) => Some(told.error),
                (None, detail) => detail.map(|(detail, _)| ERROR_OF_DETAIL * detail.abs()),
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
        Some(here)
    }
}

/// The vertices before the `first` new one between which one made on an edge lies, and how much of each it has.
fn first_ends(vertices: &[Vertex], first: usize, ends: [u32; 2]) -> Vec<(u32, f64)> {
    let mut between = ends.map(|end| (end, 0.5)).to_vec();
    while let Some(k) = between.iter().position(|&(end, _)| end as usize >= first) {
        let (made, weight) = between.swap_remove(k);
        let ends = vertices[made as usize].parents.expect("made by bisection");
        between.extend(ends.map(|end| (end, 0.5 * weight)));
    }
    between
}

/// Of vertices, those about them that carry light.
struct Rings(Vec<Vec<u32>>);

impl Rings {
    /// Of the first so many: corners of the elements about them that tell of light, and rows beside walls.
    fn of(
        elements: &[[u32; 3]],
        first: usize,
        rows: &[Beside],
        tells: impl Fn(u32) -> bool,
    ) -> Self {
        let mut rings: Vec<Vec<u32>> = vec![Vec::new(); first];
        for corners in elements {
            let telling = || corners.iter().copied().filter(|&v| tells(v));
            corners.iter().for_each(|&v| rings[v as usize].extend(telling()));
        }
        rings.iter_mut().for_each(sort_once);
        for row in rows {
            // Whoever sees the vertex on the wall sees it, too.
            let about = rings[row.of as usize].clone();
            let before = about.into_iter().filter(|&v| (v as usize) < first);
            before.for_each(|v| rings[v as usize].push(row.vertex));
        }
        Self(rings)
    }

    /// The same about all of those.
    fn wider(&self, found: impl Fn() -> Found + Sync + Send) -> Self {
        let about =
            |found: &mut Found, ring: &Vec<u32>| self.about(ring.iter().copied(), found).to_vec();
        Self(self.0.par_iter().map_init(found, about).collect())
    }

    /// Those about any of some, each once.
    fn about<'f>(&self, some: impl Iterator<Item = u32>, found: &'f mut Found) -> &'f [u32] {
        found.begin();
        for ring in some.filter_map(|v| self.0.get(v as usize)) {
            ring.iter().for_each(|&v| found.add(v));
        }
        &found.all
    }
}

/// Vertices that were found, each once.
struct Found {
    all: Vec<u32>,
    /// Of every vertex the search in which it was found last, and which search this is.
    last: Vec<u32>,
    search: u32,
}

impl Found {
    fn among(vertices: usize) -> Self {
        Self { all: Vec::new(), last: vec![0; vertices], search: 0 }
    }

    fn begin(&mut self) {
        self.all.clear();
        self.search += 1;
    }

    fn add(&mut self, vertex: u32) {
        if std::mem::replace(&mut self.last[vertex as usize], self.search) != self.search {
            self.all.push(vertex);
        }
    }
}

fn sort_once(some: &mut Vec<u32>) {
    some.sort_unstable();
    some.dedup();
}

impl Waiting {
    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.vertices.len()
    }

    /// Of so many vertices, for each the carrier that it is mostly interpolated from; carriers have themselves.
    pub(crate) fn nearest_carriers(&self, vertices: usize) -> Vec<u32> {
        let mut nearest: Vec<u32> = (0..vertices as u32).collect();
        let mut start = 0;
        for (&vertex, &end) in self.vertices.iter().zip(&self.ends) {
            let parents = &self.parents[start..end];
            if let Some((parent, _)) = parents.iter().max_by(|a, b| a.1.total_cmp(&b.1)) {
                nearest[vertex as usize] = nearest[*parent as usize];
            }
            start = end;
        }
        nearest
    }

    /// Puts their values where they belong.
    pub(crate) fn fill(&self, values: &mut [Rgb]) {
        let mut start = 0;
        for &end in &self.levels {
            // A level needs those before it alone.
            let level = (start..end).into_par_iter().with_min_len(TOGETHER);
            let found: Vec<Rgb> = level.map(|k| self.read(k, values)).collect();
            let vertices = &self.vertices[start..end];
            vertices.iter().zip(found).for_each(|(&v, value)| values[v as usize] = value);
            start = end;
        }
    }

    /// A value lies between those that it comes from: quadratic functions overshoot where light has a kink.
    fn read(&self, k: usize, values: &[Rgb]) -> Rgb {
        let parents = self.parents(k);
        let Some(&(first, _)) = parents.first() else { return Rgb::BLACK };
        let (mut sum, mut range) = (Rgb::BLACK, Range::of(values[first as usize]));
        for &(parent, weight) in parents {
            let value = values[parent as usize];
            sum += value * weight;
            range.include(value);
        }
        range.hold(sum)
    }

    fn parents(&self, k: usize) -> &[(u32, f64)] {
        let start = k.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.parents[start..self.ends[k]]
    }

    /// Their part of some values, `held` between the own one `before` and those of the carriers that they follow, which are held.
    pub(crate) fn hold(&self, values: &[Rgb], before: &[Rgb], held: &mut [Rgb]) {
        for (k, &vertex) in self.vertices.iter().enumerate() {
            let mut range = Range::of(before[vertex as usize]);
            self.parents(k).iter().for_each(|&(parent, _)| range.include(held[parent as usize]));
            held[vertex as usize] = range.hold(values[vertex as usize]);
        }
    }

    /// How they are filled from the values of some light, which are filled, with weights that stay.
    pub(crate) fn held(&self, values: &[Rgb]) -> BoundedWaiting<'_> {
        let own: Vec<Rgb> = self.vertices.iter().map(|&v| values[v as usize]).collect();
        let from = |k: usize, from: &mut Stencil| {
            from.extend(self.parents(k).iter().map(|&(v, _)| (v, values[v as usize])));
            if from.is_empty() {
                from.push((self.vertices[k], own[k]));
            }
        };
        BoundedWaiting { waiting: self, held: Bounded::of(&own, from) }
    }
}

/// Vertices that do not carry light, with the values that each lies between.
pub(crate) struct BoundedWaiting<'a> {
    waiting: &'a Waiting,
    held: Bounded,
}

impl BoundedWaiting<'_> {
    /// Puts their values where they belong.
    pub(crate) fn fill(&self, values: &mut [Rgb]) {
        let Waiting { vertices, levels, .. } = self.waiting;
        let mut start = 0;
        for &end in levels {
            let found = self.held.some(start..end, values);
            vertices[start..end]
                .iter()
                .zip(found)
                .for_each(|(&v, value)| values[v as usize] = value);
            start = end;
        }
    }
}
