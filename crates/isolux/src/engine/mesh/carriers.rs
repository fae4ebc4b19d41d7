//! Vertices that carry indirect light, and vertices that it is interpolated to.
//!
//! Where triangles are far smaller than the distance over which light varies, not every vertex has to gather.
//! Vertices are divided into levels. On each, no two are nearer than half the spacing of the level before. The
//! coarsest level gathers first, the next where details require it, as elements are bisected elsewhere. The value at
//! any other vertex is a linear combination of carriers of the level before: the quadratic function over the tangent
//! plane that fits these best (moving least squares: Lancaster, Salkauskas 1981), or a linear one where they do not
//! determine a quadratic one. A vertex with neither carries light itself. So do vertices that stand for gaps and
//! rims, and all that bisection makes.

use super::MIN_TASK_LENGTH;
use super::bounded::{Bounded, Range, Stencil};
use super::coarsening::{Coarsening, Link};
use crate::elements::Subdivision;
use crate::units::Rgb;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// The root mean square of the linear interpolation error over an element, as a share of the detail of its newest
/// vertex. For a parabola across the edge the error at the middle of the next edge is a quarter of the detail, and
/// the root mean square over the edge is 0.73 of that. Kinks and shadow borders, which dominate once the rest is
/// resolved, make it up to twice as much.
pub(crate) const ERROR_OF_DETAIL: f64 = 0.3;

/// The vertices that carry light.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Carriers {
    /// The link of each vertex of the first mesh; vertices without a link always carry light.
    links: Vec<Option<Link>>,
    /// Whether each vertex carries light; vertices beyond these do.
    active: Vec<bool>,
    /// The vertices with links, coarse to fine.
    order: Vec<u32>,
    /// The end of each level in `order`.
    ends: Vec<usize>,
}

/// Vertices that wait, that is, do not carry light, and their parents in one array, since these are read again and
/// again.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Waiting {
    /// The vertices, coarse to fine.
    vertices: Vec<u32>,
    /// The end of each level in `vertices`.
    levels: Vec<usize>,
    /// The vertices that each is interpolated from, with weights.
    parents: Vec<(u32, f64)>,
    /// The end of the parents of each vertex.
    ends: Vec<usize>,
}

/// Whether these are the ends of `count` successive ranges of a list.
pub(super) fn are_ends(ends: &[usize], count: usize, length: usize) -> bool {
    ends.len() == count && ends.is_sorted() && ends.last().is_none_or(|&last| last == length)
}

/// The estimate of the error at a vertex that does not carry light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Told {
    /// The interpolation error, root mean square, from details of the carriers about it.
    pub(crate) error: f64,
    /// Whether something stands closer to one of these carriers than they are apart.
    pub(crate) is_beset: bool,
}

impl Carriers {
    /// Carriers where all vertices carry light.
    pub(crate) fn all() -> Self {
        Self::default()
    }

    /// As few carriers as possible: one level at most `spacing_m` apart, and one at half of that. Vertices that are
    /// not `open` carry light in any case, and no other vertex is interpolated from them.
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

    /// Lets vertices from `first` on, made by bisection, wait. Each lies between those ends of its edge that are
    /// open, if any.
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

    /// The number of carriers among the first `vertices` vertices.
    pub(crate) fn count(&self, vertices: usize) -> usize {
        vertices - self.active.iter().filter(|&&active| !active).count()
    }

    /// Makes carriers of the coarsest vertices that the `asked` ones wait for. Each call adds one level, however many
    /// ask.
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

    /// Distributes the quantities of vertices that wait among the carriers that they are interpolated from.
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

    /// The vertices that wait.
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

    /// Whether the carriers are some of so many vertices.
    pub(crate) fn are_of(&self, vertices: usize) -> bool {
        let first = self.links.len();
        let is_parent = |&(v, weight): &(u32, f64)| (v as usize) < first && weight.is_finite();
        first <= vertices
            && self.active.len() == first
            && are_ends(&self.ends, self.ends.len(), self.order.len())
            && self.order.iter().all(|&v| (v as usize) < first)
            && self.links.iter().flatten().flat_map(|link| &link.parents).all(is_parent)
    }

    /// Interpolates the values of vertices that wait.
    pub(crate) fn fill(&self, values: &mut [Rgb]) {
        self.waiting().fill(values);
    }

    /// The detail of a carrier, that is, its value minus its interpolation, and the spacing of that; `None` where it
    /// is not interpolated, or from vertices that say nothing.
    pub(crate) fn detail(&self, values: &[Option<f64>], vertex: u32) -> Option<(f64, f64)> {
        let link = self.links.get(vertex as usize)?.as_ref()?;
        let mut detail = values[vertex as usize]?;
        for &(parent, weight) in &link.parents {
            detail -= weight * values[parent as usize]?;
        }
        Some((detail, link.spacing_m))
    }

    /// The estimates at the vertices of the first mesh that wait; `is_beset` tells whether something stands nearer to
    /// a carrier than a distance.
    pub(crate) fn told(
        &self,
        values: &[Option<f64>],
        is_beset: impl Fn(u32, f64) -> bool + Sync,
    ) -> Vec<Option<Told>> {
        let mut told: Vec<Option<Told>> = vec![None; self.links.len()];
        let mut start = 0;
        for &end in &self.ends {
            // A level needs only those before it.
            let level = &self.order[start..end];
            let waiting = level.par_iter().with_min_len(MIN_TASK_LENGTH);
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

impl Waiting {
    /// The number of vertices that wait.
    pub(crate) fn count(&self) -> usize {
        self.vertices.len()
    }

    /// The carrier with the largest weight for each of the first `vertices` vertices; for a carrier, itself.
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

    /// Interpolates the values of vertices that wait.
    pub(crate) fn fill(&self, values: &mut [Rgb]) {
        let mut start = 0;
        for &end in &self.levels {
            // A level needs only those before it.
            let level = (start..end).into_par_iter().with_min_len(MIN_TASK_LENGTH);
            let found: Vec<Rgb> = level.map(|k| self.read(k, values)).collect();
            let vertices = &self.vertices[start..end];
            vertices.iter().zip(found).for_each(|(&v, value)| values[v as usize] = value);
            start = end;
        }
    }

    /// The interpolated value, bounded by those that it comes from: quadratic functions overshoot where light has a
    /// kink.
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

    /// The interpolation with fixed weights, from values of light that are already interpolated.
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

/// Vertices that wait, as means with fixed weights.
pub(crate) struct BoundedWaiting<'a> {
    waiting: &'a Waiting,
    held: Bounded,
}

impl BoundedWaiting<'_> {
    /// Interpolates the values of vertices that wait.
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
