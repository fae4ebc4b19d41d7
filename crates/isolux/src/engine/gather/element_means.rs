//! Measured means of elements that something stands close to, for the rays that read them.
//!
//! Along the edges of a room light bends more sharply than any vertices tell: close to the edge its slope has no
//! bound. Readers gather there, but rays still read the elements, thousands of them on average, so the mean over an
//! element counts. An increment gathers at one random place of each element. The difference to the interpolated light
//! is, in expectation, the mean error of the element, with noise that averages out. It is added to vertices that no
//! reader reads: those along edges whose elements all have something close by or are not trusted.

use super::gatherer::Gatherer;
use crate::elements::Subdivision;
use crate::engine::mesh::{Bounded, LeafError, Range, Stencil};
use crate::engine::occlusion::nearby;
use crate::engine::ray::{Dice, SurfacePoint};
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use crate::units::Rgb;
use rayon::prelude::*;

/// The elements whose means are measured, and the vertices that are moved for them.
#[derive(Debug, Default)]
pub(crate) struct ElementMeans {
    /// The nodes of the elements.
    nodes: Vec<u32>,
    /// Each vertex that is moved, in order, with the end of its shares.
    ends: Vec<(u32, usize)>,
    /// Elements, with the share of their residual that moves the vertex.
    shares: Vec<(u32, f64)>,
    /// The first vertex that lies on the edge of an element.
    first_smoothed: usize,
    /// The two vertices that each vertex from there on lies between.
    between: Vec<[u32; 2]>,
}

/// The places where an increment measures, and the vertices interpolated there.
pub(crate) struct MeanPlaces {
    pub(crate) gatherers: Vec<Gatherer>,
    corners: Vec<Option<[(u32, f64); 3]>>,
}

impl ElementMeans {
    /// The means of elements that something stands close to, not counting walls that light is resolved towards. All
    /// vertices of these elements are open, and at least one is a vertex that no trusted element reads.
    pub(crate) fn new(
        (scene, subdivision): (&Scene, &Subdivision),
        errors: &[LeafError],
        trusted_up_to_lx: f64,
        open: &[bool],
        first_smoothed: usize,
    ) -> Self {
        let corners = |e: &LeafError| subdivision.node(e.node).0.vertices;
        let is_read = |e: &&LeafError| !e.is_beset && e.error <= trusted_up_to_lx;
        let mut is_free = open.to_vec();
        for error in errors.iter().filter(is_read) {
            corners(error).iter().for_each(|&v| is_free[v as usize] = false);
        }
        let can_be = |e: &&LeafError| {
            let corners = corners(e);
            let place = || SurfacePoint::amid_node(scene, subdivision, e.node);
            e.is_beset
                && !e.is_at_wall
                && corners.iter().all(|&v| open[v as usize])
                && corners.iter().any(|&v| is_free[v as usize])
                && !nearby::is_closed_in(scene, &place(), subdivision.longest_edge_m(e.node))
        };
        let measured: Vec<&LeafError> = errors.iter().filter(can_be).collect();
        let mut shares: Vec<(u32, u32, f64)> = Vec::new();
        let mut areas_m2 = vec![0.0; open.len()];
        for error in errors {
            corners(error).iter().for_each(|&v| areas_m2[v as usize] += error.area_m2);
        }
        for (index, error) in measured.iter().enumerate() {
            let free = corners(error).into_iter().filter(|&v| is_free[v as usize]);
            let free: Vec<u32> = free.collect();
            for &v in &free {
                let share = 3.0 / free.len() as f64 * error.area_m2 / areas_m2[v as usize];
                shares.push((v, index as u32, share));
            }
        }
        let smoothed = &subdivision.vertices()[first_smoothed..];
        let between = smoothed.iter().map(|v| v.parents.expect("made by bisection")).collect();
        shares.sort_by_key(|&(v, index, _)| (v, index));
        let nodes = measured.iter().map(|e| e.node).collect();
        let mut means = Self { nodes, first_smoothed, between, ..Self::default() };
        for of_vertex in shares.chunk_by(|a, b| a.0 == b.0) {
            means.shares.extend(of_vertex.iter().map(|&(_, index, share)| (index, share)));
            means.ends.push((of_vertex[0].0, means.shares.len()));
        }
        means
    }

    /// Whether no element is measured.
    pub(crate) const fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// One random place of each element, with `rays` rays to gather and the vertices interpolated there.
    pub(crate) fn places(
        &self,
        (scene, subdivision): (&Scene, &Subdivision),
        known_at: impl Fn(&SurfacePoint) -> Option<[(u32, f64); 3]> + Sync,
        rays: u32,
        key: Key,
    ) -> MeanPlaces {
        let one = |&node: &u32| {
            let mut dice = Dice::new(Sequence::new(key.with(u64::from(node))), 0);
            let at = SurfacePoint::in_node(scene, subdivision, node, dice.pair());
            (Gatherer::on_surface(at, rays), known_at(&at))
        };
        let (gatherers, corners) = self.nodes.par_iter().map(one).unzip();
        MeanPlaces { gatherers, corners }
    }

    /// Moves vertices so that elements have the mean that was gathered. Each value stays within the range of its own
    /// value, the light gathered on its elements, and the values at their corners.
    pub(crate) fn apply(&self, values: &mut [Rgb], places: &MeanPlaces, gathered: &[Rgb]) {
        let moves = self.moves(values, places, gathered);
        let held = |k: usize| {
            let vertex = self.ends[k].0 as usize;
            let mut range = Range::of(values[vertex]);
            self.from(k, places, |of| range.include(of.value(values, gathered)));
            range.hold(values[vertex] + moves[vertex])
        };
        let held: Vec<Rgb> = (0..self.ends.len()).map(held).collect();
        self.ends.iter().zip(held).for_each(|(&(v, _), value)| values[v as usize] = value);
        for (k, ends) in self.between.iter().enumerate() {
            let vertex = self.first_smoothed + k;
            let mut range = Range::of(values[vertex]);
            ends.iter().for_each(|&end| range.include(values[end as usize]));
            values[vertex] = range.hold(values[vertex] + moves[vertex]);
        }
    }

    /// The move as weighted means with fixed weights: of the values of all vertices, followed by the gathered light.
    pub(crate) fn held(
        &self,
        values: &[Rgb],
        places: &MeanPlaces,
        gathered: &[Rgb],
    ) -> HeldMeans<'_> {
        let mut moved = values.to_vec();
        self.apply(&mut moved, places, gathered);
        let own: Vec<Rgb> = self.ends.iter().map(|&(v, _)| moved[v as usize]).collect();
        let first_gathered = values.len() as u32;
        let from = |k: usize, some: &mut Stencil| {
            let vertex = self.ends[k].0;
            some.push((vertex, values[vertex as usize]));
            self.from(k, places, |of| {
                let number = match of {
                    Of::Vertex(v) => v,
                    Of::Place(place) => first_gathered + place,
                };
                some.push((number, of.value(values, gathered)));
            });
        };
        let own = Bounded::of(&own, from);
        let from = |k: usize, some: &mut Stencil| {
            let vertex = (self.first_smoothed + k) as u32;
            some.push((vertex, values[vertex as usize]));
            some.extend(self.between[k].map(|end| (end, moved[end as usize])));
        };
        let last = self.first_smoothed + self.between.len();
        let between = Bounded::of(&moved[self.first_smoothed..last], from);
        HeldMeans { means: self, own, between }
    }

    /// The values that bound vertex number `k` of those moved, beside its own.
    fn from(&self, k: usize, places: &MeanPlaces, mut add: impl FnMut(Of)) {
        let first = k.checked_sub(1).map_or(0, |before| self.ends[before].1);
        for &(element, _) in &self.shares[first..self.ends[k].1] {
            let Some(corners) = places.corners[element as usize] else { continue };
            add(Of::Place(element));
            corners.iter().for_each(|&(v, _)| add(Of::Vertex(v)));
        }
    }

    /// The change of each vertex with which elements have the mean that was gathered, lx.
    pub(crate) fn moves(&self, values: &[Rgb], places: &MeanPlaces, gathered: &[Rgb]) -> Vec<Rgb> {
        let lacking = |(corners, &light): (&Option<[(u32, f64); 3]>, &Rgb)| {
            corners.map_or(Rgb::BLACK, |corners| light - places.read(values, &corners))
        };
        let lacking: Vec<Rgb> = places.corners.iter().zip(gathered).map(lacking).collect();
        let starts = || std::iter::once(0).chain(self.ends.iter().map(|&(_, end)| end));
        let of_vertices = || {
            let ends = starts().zip(&self.ends);
            ends.map(|(first, &(vertex, end))| (vertex as usize, &self.shares[first..end]))
        };
        // Changes are proportional to the light: where an element reaches beyond a wall, its residual is that of the
        // bright side.
        let light = |vertex: usize| values[vertex].luminance().max(0.0);
        let mut about = vec![(0.0, 0.0); self.nodes.len()];
        for (vertex, shares) in of_vertices() {
            for &(k, _) in shares {
                let (sum, count) = &mut about[k as usize];
                *sum += light(vertex);
                *count += 1.0;
            }
        }
        let part = |vertex: usize, k: u32| match about[k as usize] {
            (sum, count) if sum > 0.0 => light(vertex) * count / sum,
            _ => 1.0,
        };
        let mut moves = vec![Rgb::BLACK; self.first_smoothed];
        for (vertex, shares) in of_vertices() {
            let of_each = shares.iter().map(|&(k, w)| lacking[k as usize] * (w * part(vertex, k)));
            moves[vertex] = of_each.sum();
        }
        for ends in &self.between {
            moves.push((moves[ends[0] as usize] + moves[ends[1] as usize]) * 0.5);
        }
        moves
    }
}

/// A value that bounds a vertex that is moved.
#[derive(Clone, Copy)]
enum Of {
    /// The light of a vertex.
    Vertex(u32),
    /// The light gathered at a place.
    Place(u32),
}

impl Of {
    fn value(self, values: &[Rgb], gathered: &[Rgb]) -> Rgb {
        match self {
            Self::Vertex(v) => values[v as usize],
            Self::Place(k) => gathered[k as usize],
        }
    }
}

/// Vertices that are moved, as means with fixed weights.
pub(crate) struct HeldMeans<'a> {
    means: &'a ElementMeans,
    own: Bounded,
    between: Bounded,
}

impl HeldMeans<'_> {
    /// Moves the vertices of any light.
    pub(crate) fn apply(&self, values: &mut Vec<Rgb>, gathered: &[Rgb]) {
        let ElementMeans { ends, first_smoothed, between, .. } = self.means;
        let vertices = values.len();
        values.extend(gathered);
        let own = self.own.apply(values);
        ends.iter().zip(own).for_each(|(&(v, _), value)| values[v as usize] = value);
        for k in 0..between.len() {
            let [value] = self.between.some(k..k + 1, values)[..] else { continue };
            values[first_smoothed + k] = value;
        }
        values.truncate(vertices);
    }
}

impl MeanPlaces {
    /// The light interpolated at the places, lx.
    pub(crate) fn interpolated<'a>(&'a self, values: &'a [Rgb]) -> impl Iterator<Item = Rgb> + 'a {
        self.corners.iter().map(|c| c.map_or(Rgb::BLACK, |corners| self.read(values, &corners)))
    }

    fn read(&self, values: &[Rgb], corners: &[(u32, f64); 3]) -> Rgb {
        corners.iter().map(|&(v, weight)| values[v as usize] * weight).sum()
    }
}
