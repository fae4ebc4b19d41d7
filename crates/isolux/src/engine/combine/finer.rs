//! A map with more vertices where direct light varies, for viewers that draw the bare map.
//!
//! Elements are made for readings, which evaluate direct light anew. A viewer that draws the bare map shows
//! shadows as coarse as the elements. Here elements are bisected where direct light at the midpoint of an
//! edge differs visibly from the mean of its ends. Indirect light stays that of the map. The longest edges
//! come first, so the process may stop at any time.

use super::trees::{bisected_like, own_vertices};
use crate::elements::{PlaceOnSide, Subdivision, edge_key};
use crate::engine::light::ShadowRays;
use crate::engine::read::{MapReader, PictureLight, reference_lx};
use crate::map::{Illuminance, IlluminationMap, VertexLight};
use crate::scene::Scene;
use crate::units::Rgb;
use rayon::prelude::*;
use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashMap};

/// The least relative difference of luminance that is visible in a picture (Weber's fraction, 1 to 2 % in
/// good light).
const VISIBLE: f64 = 0.02;
/// The share of the reference illuminance that is added to the light of a place for its visible difference.
/// Eyes adapted to a scene see no finer differences in darker places.
const DIM: f64 = 0.05;
/// The shadow rays of a reading.
const RAYS: ShadowRays = ShadowRays { fewest: 8, most: 32 };
/// The number of readings of a place where a difference may be visible. Readings of luminaires with a surface
/// are noisy.
const READINGS: u64 = 4;
/// The variances that a squared difference must exceed: two standard errors.
const DOUBT: f64 = 4.0;
/// The number of elements between two calls of `wanted`.
const TOGETHER: usize = 2048;

/// The limits of refinement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FinerSettings {
    /// The least edge, m; shorter ones are not bisected.
    pub least_edge_m: f64,
    /// The largest number of vertices.
    pub most_vertices: usize,
}

/// A map under refinement.
pub struct Finer<'a> {
    scene: &'a Scene,
    map: &'a IlluminationMap,
    reader: MapReader<'a>,
    subdivision: Subdivision,
    values: Vec<Option<VertexLight>>,
    /// The values at the midpoints of edges that are not bisected.
    middles: HashMap<[u32; 2], Option<VertexLight>>,
    waiting: BinaryHeap<Waiting>,
    /// The constant illuminance in the visible difference, lx.
    dim_lx: f64,
}

/// An element that has not been examined.
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
    /// A refinement that starts with the elements of a map.
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

    /// The number of vertices.
    pub fn vertices(&self) -> usize {
        self.values.len()
    }

    /// Refines while `wanted` returns true. Returns false once nothing is left to do.
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

    /// The next elements to examine: those with the longest edges.
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

    /// Reads the midpoints of the edges of elements.
    fn look(&mut self, nodes: &[u32]) {
        let mut asked: HashMap<[u32; 2], PlaceOnSide> = HashMap::new();
        for &node in nodes {
            let (of, origin) = self.subdivision.node(node);
            for k in 0..3 {
                let edge = edge_key(of.vertices[k], of.vertices[(k + 1) % 3]);
                if !self.middles.contains_key(&edge) {
                    asked.insert(edge, self.middle_on((origin.triangle, origin.back), edge));
                }
            }
        }
        // Edges are sorted, whatever the order of the table.
        let mut asked: Vec<([u32; 2], PlaceOnSide)> = asked.into_iter().collect();
        asked.sort_unstable_by_key(|(edge, _)| *edge);
        let read = |(edge, place): &([u32; 2], PlaceOnSide)| (*edge, self.read(*edge, *place));
        let found: Vec<([u32; 2], Option<VertexLight>)> = asked.par_iter().map(read).collect();
        self.middles.extend(found);
    }

    /// The place of the midpoint of an edge on a side of a triangle.
    fn middle_on(&self, (triangle, back): (u32, bool), edge: [u32; 2]) -> PlaceOnSide {
        let [p, q] = edge.map(|v| self.subdivision.vertices()[v as usize].position);
        let [u, v] = self.scene.triangle(triangle).barycentric(p.lerp(q, 0.5));
        let (u, v) = (u.clamp(0.0, 1.0), v.clamp(0.0, 1.0));
        PlaceOnSide { triangle, back, uv: [u, v.min(1.0 - u)] }
    }

    /// The value at the midpoint of an edge. Direct light is evaluated, by several readings where it may
    /// differ from the ends of the edge.
    fn read(&self, edge: [u32; 2], place: PlaceOnSide) -> Option<VertexLight> {
        let reading = |number| {
            let glance = self.reader.glance(place, (number, RAYS), PictureLight::default());
            glance.map(Illuminance::at_vertex)
        };
        let first = reading(0)?;
        let expected_lx = self.expected_lx(edge);
        if expected_lx.is_some_and(|lx| (first.illuminance_lx() - lx).abs() < self.visible_lx(lx)) {
            return Some(first);
        }
        let others: Vec<VertexLight> = (1..READINGS).filter_map(reading).collect();
        let all = || std::iter::once(&first).chain(&others);
        let count = all().count() as f64;
        let direct_lx = all().map(|value| value.direct_lx).sum::<Rgb>() / count;
        let mean_lx = direct_lx.luminance();
        let squares = all().map(|value| (value.direct_lx.luminance() - mean_lx).powi(2));
        let variance = squares.sum::<f64>() / (count * (count - 1.0).max(1.0));
        // The uncertainty of the mean of few readings is part of the standard error.
        let standard_error_lx = (first.standard_error_lx.powi(2) + variance).sqrt();
        Some(VertexLight { direct_lx, standard_error_lx, ..first })
    }

    /// The mean illuminance of the ends of an edge, lx.
    fn expected_lx(&self, edge: [u32; 2]) -> Option<f64> {
        let ends = edge.map(|v| (self.values[v as usize], 0.5));
        VertexLight::mix(ends).map(|value| value.illuminance_lx())
    }

    /// The least visible difference at a given illuminance, lx.
    fn visible_lx(&self, about_lx: f64) -> f64 {
        VISIBLE * (about_lx + self.dim_lx)
    }

    /// Whether direct light differs visibly at the midpoint of an edge.
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
        // Bisection propagates to neighbours, which may belong to other triangles.
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

    /// The value of the next vertex, at the midpoint of an edge on a side of a triangle.
    fn add_vertex(&mut self, side: Option<(u32, bool)>) {
        let parents = self.subdivision.vertices()[self.values.len()].parents;
        let value = parents.zip(side).and_then(|([a, b], side)| {
            let edge = edge_key(a, b);
            let known = self.middles.remove(&edge);
            known.unwrap_or_else(|| self.read(edge, self.middle_on(side, edge)))
        });
        self.values.push(value);
    }

    /// The current map. Its accuracy is still that of the original map.
    pub fn map(&self) -> IlluminationMap {
        IlluminationMap {
            elements: self.subdivision.elements(),
            values: self.values.clone(),
            provenance: self.map.provenance.clone(),
        }
    }
}
