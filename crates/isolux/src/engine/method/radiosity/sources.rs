//! Sources of radiosity: elements, the nodes of their bisection trees, and clusters of whole trees.
//!
//! A patch is shot at once. It consists of surfaces that share no vertex with others, joined with their
//! neighbours until patches are few. Each patch has a binary tree, from clusters of many triangles to single
//! ones, down to the elements of the map. A receiver uses the nodes that are fine enough for it (Hanrahan,
//! Salzman, Aupperle 1991, "A rapid hierarchical radiosity algorithm"; Smits, Arvo, Greenberg 1994, "A
//! clustering algorithm for radiosity").

use super::light::Light;
use crate::elements::{Elements, Origin, Split};
use crate::engine::plan::Plan;
use crate::engine::ray::reflectance;
use crate::map::Standing;
use crate::scene::{Body, Finish};
use crate::units::Rgb;
use isolux_geometry::{Point, Triangle, Vector};
use std::ops::Range;

/// The share of the total area up to which surfaces are joined into one patch.
const SHARE_OF_PATCH: f64 = 1.0 / 48.0;

/// A node of the trees.
#[derive(Clone, Debug)]
pub(super) struct Source {
    pub(super) centre: Point,
    /// The radius of a sphere around the centre that contains the node, m.
    pub(super) radius_m: f64,
    pub(super) area_m2: f64,
    pub(super) kind: Kind,
    /// The two child nodes, by number; `None` for an element.
    pub(super) children: Option<[u32; 2]>,
    /// The number after the last node of its subtree.
    pub(super) end: u32,
}

/// The kind of a node.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kind {
    /// Surfaces of any kind.
    Cluster,
    /// A triangle.
    Face(Face),
}

/// A part of one side of a triangle of the scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub(super) corners: [Point; 3],
    /// The vertices of the map at the corners.
    pub(super) vertices: [u32; 3],
    pub(super) normal: Vector,
    pub(super) triangle: u32,
    pub(super) back: bool,
    /// The edge where it is bisected, by the corner it starts from; zero if it is not.
    split_at: usize,
    /// The mean reflectance of its side.
    pub(super) reflectance: Rgb,
}

/// All sources of a plan.
pub(super) struct Sources {
    pub(super) nodes: Vec<Source>,
    /// The nodes of every patch: its root first, children after their parents.
    pub(super) patches: Vec<Range<u32>>,
    /// The vertices of every patch.
    pub(super) vertices: Vec<Vec<u32>>,
}

/// A bisection tree that reflects.
#[derive(Clone, Copy, Debug)]
struct Tree {
    root: u32,
    origin: Origin,
    centre: Point,
    normal: Vector,
    area_m2: f64,
}

/// Trees that share vertices.
struct Surface {
    trees: Vec<Tree>,
    centre: Point,
    area_m2: f64,
}

impl Sources {
    /// The sources of a plan, down to nodes with numbers below `level`.
    pub(super) fn new(plan: &Plan, level: u32) -> Self {
        let mut surfaces = surfaces(plan);
        let area_m2: f64 = surfaces.iter().map(|s| s.area_m2).sum();
        let mut build = Build { plan, level, found: Self::none() };
        build.patches(&mut surfaces, SHARE_OF_PATCH * area_m2);
        build.found
    }

    const fn none() -> Self {
        Self { nodes: Vec::new(), patches: Vec::new(), vertices: Vec::new() }
    }

    /// The light of the nodes of a patch, from that at the corners of its elements.
    pub(super) fn light(
        &self,
        patch: usize,
        corners_of: impl Fn(u32, &Face) -> [Rgb; 3],
    ) -> Vec<Light> {
        let nodes = self.patches[patch].clone();
        let mut light = vec![Light::default(); nodes.len()];
        for node in nodes.clone().rev() {
            let source = &self.nodes[node as usize];
            let own = match (source.children, &source.kind) {
                (Some(children), kind) => {
                    let of = |child: u32| light[(child - nodes.start) as usize];
                    match kind {
                        Kind::Face(face) => Light::of_halves(face.split_at, children.map(of)),
                        Kind::Cluster => Light::of_both(
                            children.map(|child| (self.nodes[child as usize].area_m2, of(child))),
                        ),
                    }
                }
                (None, Kind::Face(face)) => Light::of_corners(corners_of(node, face)),
                (None, Kind::Cluster) => Light::default(),
            };
            light[(node - nodes.start) as usize] = own;
        }
        light
    }

    /// The absolute flux of the elements of a patch before each of its nodes, and before its end, lm.
    pub(super) fn sums_lm(&self, patch: usize, light: &[Light]) -> Vec<f64> {
        let mut sum_lm = 0.0;
        let nodes = self.patches[patch].clone().zip(light);
        let after = nodes.map(|(node, light)| {
            let source = &self.nodes[node as usize];
            if source.children.is_none() {
                sum_lm += source.area_m2 * light.size;
            }
            sum_lm
        });
        std::iter::once(0.0).chain(after).collect()
    }
}

struct Build<'a, 's> {
    plan: &'a Plan<'s>,
    level: u32,
    found: Sources,
}

impl Build<'_, '_> {
    /// Splits surfaces by place into halves of about equal area, down to patches.
    fn patches(&mut self, surfaces: &mut [Surface], least_m2: f64) {
        let area_m2: f64 = surfaces.iter().map(|s| s.area_m2).sum();
        if surfaces.len() > 1 && area_m2 > least_m2 {
            let centres = surfaces.iter().map(|s| s.centre);
            let axis = longest_axis(centres);
            surfaces.sort_by(|a, b| along(a.centre, axis).total_cmp(&along(b.centre, axis)));
            let middle = half_way(surfaces.iter().map(|s| s.area_m2), area_m2);
            let (low, high) = surfaces.split_at_mut(middle);
            self.patches(low, least_m2);
            self.patches(high, least_m2);
            return;
        }
        let mut trees: Vec<Tree> = surfaces.iter().flat_map(|s| s.trees.iter().copied()).collect();
        if trees.is_empty() {
            return;
        }
        let first = self.found.nodes.len() as u32;
        self.cluster(&mut trees);
        let nodes = first..self.found.nodes.len() as u32;
        let of = |node: u32| match &self.found.nodes[node as usize] {
            Source { kind: Kind::Face(face), children: None, .. } => face.vertices.to_vec(),
            _ => Vec::new(),
        };
        let mut vertices: Vec<u32> = nodes.clone().flat_map(of).collect();
        vertices.sort_unstable();
        vertices.dedup();
        self.found.vertices.push(vertices);
        self.found.patches.push(nodes);
    }

    /// Builds the cluster over some trees; returns its number.
    fn cluster(&mut self, trees: &mut [Tree]) -> u32 {
        if let [tree] = trees {
            return self.face(tree.root, &tree.origin, self.reflectance(tree));
        }
        let extent_m = extent_m(trees);
        // Surfaces that face other ways are treated as if they were elsewhere.
        let key = |tree: &Tree| tree.centre.to_vector() + tree.normal * (0.5 * extent_m);
        let axis = longest_axis(trees.iter().map(|t| Point::ORIGIN + key(t)));
        trees.sort_by(|a, b| key(a).component(axis).total_cmp(&key(b).component(axis)));
        let own = self.push(Kind::Cluster, Point::ORIGIN, 0.0);
        let (low, high) = trees.split_at_mut(trees.len() / 2);
        let children = [self.cluster(low), self.cluster(high)];
        let [a, b] = children.map(|child| &self.found.nodes[child as usize]);
        let area_m2 = a.area_m2 + b.area_m2;
        let centre = a.centre.lerp(b.centre, b.area_m2 / area_m2);
        let reach = |s: &Source| (s.centre - centre).length() + s.radius_m;
        let radius_m = reach(a).max(reach(b));
        let end = self.found.nodes.len() as u32;
        let node = &mut self.found.nodes[own as usize];
        *node = Source { centre, radius_m, area_m2, children: Some(children), end, ..node.clone() };
        own
    }

    fn face(&mut self, node: u32, origin: &Origin, known: Option<Rgb>) -> u32 {
        let elements = &self.plan.mesh.elements;
        let of = elements.node(node);
        let corners = of.vertices.map(|v| elements.vertices()[v as usize].position);
        let normal = self.plan.scene.geometric_normal(origin.triangle);
        let normal = if origin.back { -normal } else { normal }.to_vector();
        let triangle = Triangle { corners };
        let split = of.split.filter(|s| s.first_child < self.level);
        let reflectance = match (known, split) {
            (Some(known), _) => known,
            (None, None) => reflectance::of_part(self.plan.scene, origin, &triangle, node),
            (None, Some(_)) => Rgb::BLACK,
        };
        let face = Face {
            corners,
            vertices: of.vertices,
            normal,
            triangle: origin.triangle,
            back: origin.back,
            split_at: split.map_or(0, |s| usize::from(s.edge)),
            reflectance,
        };
        let centre = triangle.centroid();
        let own = self.push(Kind::Face(face), centre, triangle.area());
        let radius_m = corners.map(|c| (c - centre).length()).into_iter().fold(0.0, f64::max);
        let children = split.map(|Split { first_child, .. }| {
            [0, 1].map(|k| self.face(first_child + k, origin, known))
        });
        let end = self.found.nodes.len() as u32;
        let stored = &mut self.found.nodes[own as usize];
        (stored.radius_m, stored.children, stored.end) = (radius_m, children, end);
        own
    }

    fn push(&mut self, kind: Kind, centre: Point, area_m2: f64) -> u32 {
        let end = self.found.nodes.len() as u32 + 1;
        let node = Source { centre, radius_m: 0.0, area_m2, kind, children: None, end };
        self.found.nodes.push(node);
        end - 1
    }

    /// The reflectance of a side without texture.
    fn reflectance(&self, tree: &Tree) -> Option<Rgb> {
        let finish = self.finish(&tree.origin)?;
        finish.diffuse.texture.is_none().then_some(finish.diffuse.colour)
    }

    fn finish(&self, origin: &Origin) -> Option<&Finish> {
        self.plan.scene.material(origin.triangle).finish(origin.back)
    }
}

/// The surfaces that reflect diffusely; trees that share vertices are one surface.
fn surfaces(plan: &Plan) -> Vec<Surface> {
    let trees = trees(plan);
    let elements = &plan.mesh.elements;
    let mut leader: Vec<u32> = (0..elements.vertices().len() as u32).collect();
    for tree in &trees {
        let [a, b, c] = elements.node(tree.root).vertices.map(|v| found(&mut leader, v));
        let least = a.min(b).min(c);
        [a, b, c].iter().for_each(|&v| leader[v as usize] = least);
    }
    let mut by_leader: std::collections::BTreeMap<u32, Vec<Tree>> = Default::default();
    for tree in trees {
        let first = elements.node(tree.root).vertices[0];
        by_leader.entry(found(&mut leader, first)).or_default().push(tree);
    }
    let surface = |trees: Vec<Tree>| {
        let area_m2: f64 = trees.iter().map(|t| t.area_m2).sum();
        let moment: Vector =
            trees.iter().fold(Vector::ZERO, |sum, t| sum + t.centre.to_vector() * t.area_m2);
        Surface { centre: Point::ORIGIN + moment / area_m2, area_m2, trees }
    };
    by_leader.into_values().map(surface).collect()
}

/// The first known vertex of the surface that a vertex belongs to.
fn found(leader: &mut [u32], mut vertex: u32) -> u32 {
    while leader[vertex as usize] != vertex {
        let above = leader[leader[vertex as usize] as usize];
        leader[vertex as usize] = above;
        vertex = above;
    }
    vertex
}

fn trees(plan: &Plan) -> Vec<Tree> {
    let mut trees = Vec::new();
    for (triangle, sides) in (0..).zip(plan.mesh.elements.roots()) {
        for (root, back) in sides.iter().zip([false, true]) {
            let Some(root) = *root else { continue };
            let Body::Opaque { front, back: rear } = &plan.scene.material(triangle).body else {
                continue;
            };
            let finish = if back { rear } else { front };
            if finish.diffuse.colour.is_black() {
                continue;
            }
            let corners = plan.scene.triangle(triangle);
            let normal = plan.scene.geometric_normal(triangle).to_vector();
            trees.push(Tree {
                root,
                origin: Origin { triangle, back, depth: 0 },
                centre: corners.centroid(),
                normal: if back { -normal } else { normal },
                area_m2: corners.area(),
            });
        }
    }
    trees
}

fn along(point: Point, axis: usize) -> f64 {
    point.to_vector().component(axis)
}

fn longest_axis(points: impl Iterator<Item = Point> + Clone) -> usize {
    let extent = |axis: usize| {
        let all = points.clone().map(|p| along(p, axis));
        let high = all.clone().fold(f64::NEG_INFINITY, f64::max);
        high - all.fold(f64::INFINITY, f64::min)
    };
    (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b)).then(b.cmp(&a))).unwrap_or(0)
}

fn extent_m(trees: &[Tree]) -> f64 {
    let axis = longest_axis(trees.iter().map(|t| t.centre));
    let all = trees.iter().map(|t| along(t.centre, axis));
    all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
}

/// The number of leading parts that make up half of the whole, at least one and not all.
fn half_way(parts: impl ExactSizeIterator<Item = f64>, whole: f64) -> usize {
    let count = parts.len();
    let mut sum = 0.0;
    let first = parts
        .take_while(|part| {
            sum += part;
            sum <= 0.5 * whole
        })
        .count();
    first.clamp(1, count - 1)
}

/// The values at the corners of an element. Corners below the highest standing there take the mean of the
/// others; all are black where nothing is known.
pub(super) fn corner_values(
    plan: &Plan,
    vertices: [u32; 3],
    value: impl Fn(u32) -> Rgb,
) -> [Rgb; 3] {
    over_known(vertices, &plan.mesh.standings, value)
}

/// The values at the corners of an element for a receiver in a gap that the element is part of.
pub(super) fn corner_values_in_gap(
    plan: &Plan,
    vertices: [u32; 3],
    value: impl Fn(u32) -> Rgb,
) -> [Rgb; 3] {
    let in_gap = |v: u32| plan.mesh.standings[v as usize].filter(|of| *of != Standing::Open);
    let of = vertices.map(in_gap);
    mixed(vertices, Standing::highest(of), of, value)
}

fn over_known(
    vertices: [u32; 3],
    standings: &[Option<Standing>],
    value: impl Fn(u32) -> Rgb,
) -> [Rgb; 3] {
    let of = vertices.map(|v| standings[v as usize]);
    mixed(vertices, Standing::highest(of), of, value)
}

fn mixed(
    vertices: [u32; 3],
    highest: Option<Standing>,
    of: [Option<Standing>; 3],
    value: impl Fn(u32) -> Rgb,
) -> [Rgb; 3] {
    if highest.is_none() {
        return [Rgb::BLACK; 3];
    }
    let known = || (0..3).filter(|&k| of[k] == highest).map(|k| value(vertices[k]));
    let mean = known().sum::<Rgb>() / known().count() as f64;
    [0, 1, 2].map(|k| if of[k] == highest { value(vertices[k]) } else { mean })
}

/// A place of an element, for quadrature.
pub(super) fn place_of(elements: &Elements, face: &Face, weights: [f64; 3]) -> Point {
    let [a, b, c] = face.vertices.map(|v| elements.vertices()[v as usize].position);
    a + (b - a) * weights[1] + (c - a) * weights[2]
}
