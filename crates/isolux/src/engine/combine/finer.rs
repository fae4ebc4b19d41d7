//! A map with more vertices where direct light changes between them: what viewers see of it is the bare map.
//!
//! Elements are made for readings, which evaluate direct light afresh; whoever draws the bare map sees shadows as coarse as the
//! elements. Here they are bisected where direct light in the middle of an edge differs visibly from what the ends tell. Indirect
//! light stays that of the map. The longest edges come first, so that it may end at any time.

use super::trees::{SidePlace, bisected_like, own_vertices};
use crate::elements::{PlaceOnSide, Subdivision, edge_key};
use crate::engine::read::{MapReader, reference_lx};
use crate::map::{Illuminance, IlluminationMap};
use crate::scene::Scene;
use crate::units::Rgb;
use rayon::prelude::*;
use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashMap};

/// The least relative difference of luminance that eyes tell apart in a picture (Weber's fraction, 1 to 2 % in good light).
const VISIBLE: f64 = 0.02;
/// Eyes that are adapted to the light of a scene see as much less in places this share as bright, and darker.
const DIM: f64 = 0.05;
/// Readings of a place that may be seen to differ: of luminaires with a surface they are noisy.
const READINGS: u64 = 4;
/// Variances of the mean that a difference is to exceed: two standard errors.
const DOUBT: f64 = 4.0;
/// Elements that are looked at between two words to whoever watches.
const TOGETHER: usize = 2048;

/// Where to end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FinerSettings {
    /// No edge shorter than this is bisected, m.
    pub least_edge_m: f64,
    /// Vertices at most.
    pub most_vertices: usize,
}

/// A map that becomes finer.
pub struct Finer<'a> {
    scene: &'a Scene,
    map: &'a IlluminationMap,
    reader: MapReader<'a>,
    subdivision: Subdivision,
    values: Vec<Option<Illuminance>>,
    /// Values in the middles of edges that are not bisected.
    middles: HashMap<[u32; 2], Option<Illuminance>>,
    waiting: BinaryHeap<Waiting>,
    /// What counts as some light, lx.
    dim_lx: f64,
}

/// An element that has not been looked at.
#[derive(Clone, Copy, PartialEq)]
struct Waiting {
    longest_m: f64,
    node: u32,
}

impl Eq for Waiting {}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        self.longest_m.total_cmp(&other.longest_m).then(other.node.cmp(&self.node))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<'a> Finer<'a> {
    /// Begins with the elements of a map.
    pub fn new(scene: &'a Scene, map: &'a IlluminationMap) -> Self {
        let all = vec![true; map.elements.node_count()];
        let subdivision = bisected_like(scene, &[(&map.elements, all)]);
        let elements = subdivision.elements();
        let own = own_vertices(&elements, &map.elements);
        let values = own.into_iter().map(|own| own.and_then(|v| map.values[v as usize])).collect();
        let mut finer = Self {
            scene,
            map,
            reader: MapReader::new(scene, map),
            values,
            middles: HashMap::new(),
            waiting: BinaryHeap::new(),
            dim_lx: DIM * reference_lx(map),
            subdivision,
        };
        let leaves: Vec<u32> = finer.subdivision.leaves().collect();
        finer.waiting = leaves.into_iter().map(|node| finer.waiting(node)).collect();
        finer
    }

    fn waiting(&self, node: u32) -> Waiting {
        Waiting { longest_m: self.subdivision.longest_edge_m(node), node }
    }

    /// How many vertices there are.
    pub fn vertices(&self) -> usize {
        self.values.len()
    }

    /// Goes on as long as `wanted` says so; false once nothing is left to do.
    pub fn refine(&mut self, how: &FinerSettings, wanted: &mut dyn FnMut() -> bool) -> bool {
        while wanted() {
            let nodes = self.next_elements(how);
            if nodes.is_empty() {
                return false;
            }
            self.look(&nodes);
            for node in nodes {
                if self.values.len() >= how.most_vertices {
                    return false;
                }
                if self.subdivision.node(node).0.split.is_none() && self.differs(node) {
                    self.bisect(node);
                }
            }
        }
        true
    }

    /// The next elements to look at: those with the longest edges.
    fn next_elements(&mut self, how: &FinerSettings) -> Vec<u32> {
        let mut nodes = Vec::new();
        while nodes.len() < TOGETHER {
            let Some(next) = self.waiting.pop() else { break };
            if next.longest_m < how.least_edge_m {
                self.waiting.clear();
            } else if self.subdivision.node(next.node).0.split.is_none() {
                nodes.push(next.node);
            }
        }
        nodes
    }

    /// Reads the middles of the edges of elements.
    fn look(&mut self, nodes: &[u32]) {
        let mut asked: HashMap<[u32; 2], SidePlace> = HashMap::new();
        for &node in nodes {
            let (of, origin) = self.subdivision.node(node);
            for k in 0..3 {
                let edge = edge_key(of.vertices[k], of.vertices[(k + 1) % 3]);
                if !self.middles.contains_key(&edge) {
                    asked.insert(edge, self.middle_on((origin.triangle, origin.back), edge));
                }
            }
        }
        // In the order of edges, whatever order the table has.
        let mut asked: Vec<([u32; 2], SidePlace)> = asked.into_iter().collect();
        asked.sort_unstable_by_key(|(edge, _)| *edge);
        let read = |(edge, place): &([u32; 2], SidePlace)| (*edge, self.read(*edge, *place));
        let found: Vec<([u32; 2], Option<Illuminance>)> = asked.par_iter().map(read).collect();
        self.middles.extend(found);
    }

    /// Where the middle of an edge lies on a side of a triangle.
    fn middle_on(&self, (triangle, back): (u32, bool), edge: [u32; 2]) -> SidePlace {
        let [p, q] = edge.map(|v| self.subdivision.vertices()[v as usize].position);
        let [u, v] = self.scene.triangle(triangle).barycentric(p.lerp(q, 0.5));
        let (u, v) = (u.clamp(0.0, 1.0), v.clamp(0.0, 1.0));
        (triangle, back, u, v.min(1.0 - u))
    }

    /// Direct light afresh, by as many readings as it takes to see whether it differs from what the ends of the edge tell.
    fn read(&self, edge: [u32; 2], (triangle, back, u, v): SidePlace) -> Option<Illuminance> {
        let reading =
            |number| self.reader.glance(PlaceOnSide { triangle, back, uv: [u, v] }, number, None);
        let first = reading(0)?;
        let expected_lx = self.expected_lx(edge);
        if expected_lx.is_some_and(|lx| (first.illuminance_lx() - lx).abs() < self.visible_lx(lx)) {
            return Some(first);
        }
        let others: Vec<Illuminance> = (1..READINGS).filter_map(reading).collect();
        let all = || std::iter::once(&first).chain(&others);
        let count = all().count() as f64;
        let direct_lx = all().map(|value| value.direct_lx).sum::<Rgb>() / count;
        let mean_lx = direct_lx.luminance();
        let squares = all().map(|value| (value.direct_lx.luminance() - mean_lx).powi(2));
        let variance = squares.sum::<f64>() / (count * (count - 1.0).max(1.0));
        // What a few readings leave in doubt is an error of this one.
        let standard_error_lx = (first.standard_error_lx.powi(2) + variance).sqrt();
        Some(Illuminance { direct_lx, standard_error_lx, ..first })
    }

    /// What the ends of an edge tell of its middle, lx.
    fn expected_lx(&self, edge: [u32; 2]) -> Option<f64> {
        let ends = edge.map(|v| (self.values[v as usize], 0.5));
        Illuminance::mix(ends).map(|value| value.illuminance_lx())
    }

    /// The least difference that is seen where there is so much light, lx.
    fn visible_lx(&self, about_lx: f64) -> f64 {
        VISIBLE * (about_lx + self.dim_lx)
    }

    /// Whether direct light differs visibly in the middle of an edge.
    fn differs(&self, node: u32) -> bool {
        let vertices = self.subdivision.node(node).0.vertices;
        (0..3).any(|k| {
            let edge = edge_key(vertices[k], vertices[(k + 1) % 3]);
            let found = self.middles.get(&edge).copied().flatten();
            let Some((found, expected_lx)) = found.zip(self.expected_lx(edge)) else {
                return false;
            };
            let off_lx = found.illuminance_lx() - expected_lx;
            let noise = found.standard_error_lx.powi(2)
                - found.indirect_standard_error_lx.powi(2).min(found.standard_error_lx.powi(2));
            off_lx.powi(2) > self.visible_lx(expected_lx).powi(2) + DOUBT * noise
        })
    }

    fn bisect(&mut self, node: u32) {
        let (nodes, vertices) = (self.subdivision.node_count(), self.values.len());
        self.subdivision.bisect(node);
        // Bisection goes on over neighbours, which may be parts of other triangles.
        let mut sides = vec![None; self.subdivision.vertex_count() - vertices];
        for node in nodes as u32..self.subdivision.node_count() as u32 {
            let (of, origin) = self.subdivision.node(node);
            for vertex in of.vertices.into_iter().filter(|&v| v as usize >= vertices) {
                sides[vertex as usize - vertices].get_or_insert((origin.triangle, origin.back));
            }
            if of.split.is_none() {
                self.waiting.push(self.waiting(node));
            }
        }
        sides.into_iter().for_each(|side| self.add_vertex(side));
    }

    /// The value of the next vertex, in the middle of an edge on a side of a triangle.
    fn add_vertex(&mut self, side: Option<(u32, bool)>) {
        let parents = self.subdivision.vertices()[self.values.len()].parents;
        let value = parents.zip(side).and_then(|([a, b], side)| {
            let edge = edge_key(a, b);
            let known = self.middles.remove(&edge);
            known.unwrap_or_else(|| self.read(edge, self.middle_on(side, edge)))
        });
        self.values.push(value);
    }

    /// The map as it is now: a map like any other, whose accuracy is still told of the one that it began with.
    pub fn map(&self) -> IlluminationMap {
        IlluminationMap {
            elements: self.subdivision.elements(),
            values: self.values.clone(),
            provenance: self.map.provenance.clone(),
        }
    }
}
