//! Clusters of luminaires as seen from a receiver, straight or in mirrors.

use super::super::lighting::Lighting;
use super::super::mirrors::planar::Plane;
use super::super::polygon::steradians_from;
use super::super::sources::triangle_lamps::Face;
use super::lobe::turned;
use super::{Lamp, Node, Tree};
use crate::engine::ray::SurfacePoint;
use crate::scene::Scene;
use isolux_geometry::{Direction, Point, Vector};
use std::sync::Arc;

/// Clusters are taken as one if their radius is at most this share of their distance.
#[derive(Clone, Copy, Debug)]
struct Tightness {
    /// Clusters of few luminaires.
    leaf: f64,
    /// Clusters of clusters.
    inner: f64,
}

impl Tightness {
    /// Where one luminaire is to be drawn.
    const ROUGH: Self = Self { leaf: 0.4, inner: 0.4 };
    /// Where light is to be known.
    const FINE: Self = Self { leaf: 0.3, inner: 0.15 };
}

/// Where a member of a cluster gives less than this share of what another gives, the cluster is
/// expected to give no less than this share of what its table says.
const UNEVEN: f64 = 0.25;

/// Faces that reach no further than this share of their distance are expected to give what they would by their middle.
const FAR: f64 = 0.3;

/// A receiver as reflected by a chain of mirrors, back to where the luminaires are.
pub(crate) struct View<'a> {
    scene: &'a Scene,
    tree: &'a Tree,
    /// Which chain.
    pub(crate) chain: usize,
    point: Point,
    shading: Vector,
    geometric: Vector,
    /// Luminance that the mirrors leave.
    reflectance: f64,
    /// The mirror that light meets first: nothing is seen but through it.
    window: Option<Window<'a>>,
    /// What is seen from anywhere as near to the point as this counts as seen.
    reach_m: f64,
}

/// A mirror seen from behind.
struct Window<'a> {
    plane: &'a Plane,
    depth_m: f64,
    tolerance_m: f64,
}

/// A cluster or a single lamp of the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Node(u32),
    Lamp(u32),
}

/// A part of the tree as seen in a view, with an estimate of the illuminance it would give without
/// obstacles, lx; zero only if that is zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub(crate) chain: usize,
    pub(crate) part: Part,
    pub(crate) weight: f64,
}

/// A partition of all that is seen from a receiver, or from a patch of a surface.
#[derive(Debug, Default)]
pub(crate) struct Parts {
    pub(crate) seen: Vec<Seen>,
    pub(crate) total: f64,
}

/// The views of a receiver along all chains, none from behind a mirror, and a partition of what it sees in them.
pub(crate) struct Cut<'a> {
    pub(crate) views: Vec<Option<View<'a>>>,
    pub(crate) parts: Arc<Parts>,
}

impl Lighting<'_> {
    /// What a receiver sees of the luminaires without surface and their images, to know their light.
    pub(crate) fn fine_cut(&self, at: &SurfacePoint) -> Cut<'_> {
        self.cut(at, Tightness::FINE)
    }

    /// The same, to draw one of them.
    pub(crate) fn rough_cut(&self, at: &SurfacePoint) -> Cut<'_> {
        self.cut(at, Tightness::ROUGH)
    }

    /// What is seen from as far about a place as `reach_m`.
    pub(crate) fn parts_about(&self, middle: &SurfacePoint, reach_m: f64) -> Parts {
        parts(&self.views(middle, reach_m), Tightness::FINE)
    }

    fn cut(&self, at: &SurfacePoint, tight: Tightness) -> Cut<'_> {
        let views = self.views(at, 0.0);
        let parts = Arc::new(parts(&views, tight));
        Cut { views, parts }
    }

    /// The views along all chains, and from as far about as `reach_m`.
    pub(crate) fn views(&self, at: &SurfacePoint, reach_m: f64) -> Vec<Option<View<'_>>> {
        (0..self.chains.len()).map(|chain| self.view(chain, at, reach_m)).collect()
    }

    /// The view along a chain, and from as far about as `reach_m`; `None` from behind its last mirror.
    pub(crate) fn view(&self, chain: usize, at: &SurfacePoint, reach_m: f64) -> Option<View<'_>> {
        let (mut point, mut reflectance) = (at.point, 1.0);
        let mut normals = [at.shading.to_vector(), at.geometric.to_vector()];
        let planes = self.chains[chain].iter().map(|&p| &self.mirrors.planes[p as usize]);
        for (rank, plane) in planes.rev().enumerate() {
            if rank == 0 && plane.height(point) + reach_m < -self.mirrors.tolerance_m {
                return None;
            }
            point = plane.image(point);
            normals = normals.map(|n| plane.image_vector(n));
            reflectance *= plane.reflectance.max_channel();
        }
        let window = self.chains[chain].first().map(|&p| {
            let plane = &self.mirrors.planes[p as usize];
            let tolerance_m = self.mirrors.tolerance_m;
            Window { plane, depth_m: (-plane.height(point)).max(0.0), tolerance_m }
        });
        let [shading, geometric] = normals;
        let (scene, tree) = (self.scene, &self.tree);
        Some(View { scene, tree, chain, point, shading, geometric, reflectance, window, reach_m })
    }
}

fn parts(views: &[Option<View>], tight: Tightness) -> Parts {
    let mut seen = Vec::with_capacity(256);
    views.iter().flatten().for_each(|view| view.cut(tight, &mut seen));
    let total = seen.iter().map(|s| s.weight).sum();
    Parts { seen, total }
}

impl View<'_> {
    /// Appends the tight clusters, and the lamps of leaves that are near.
    fn cut(&self, tight: Tightness, seen: &mut Vec<Seen>) {
        let mut take = |part: Part, weight: f64| {
            if weight > 0.0 {
                seen.push(Seen { chain: self.chain, part, weight });
            }
        };
        let mut waiting = Vec::with_capacity(64);
        waiting.extend((!self.tree.nodes.is_empty()).then_some(0));
        while let Some(number) = waiting.pop() {
            let node = &self.tree.nodes[number as usize];
            let to = node.centre - self.point;
            let share = if node.second.is_some() { tight.inner } else { tight.leaf };
            if node.radius_m * node.radius_m <= share * share * to.length_squared() {
                take(Part::Node(number), self.node_weight(node));
                continue;
            }
            if self.is_out_of_view(to, node) {
                continue;
            }
            if let Some(second) = node.second {
                waiting.extend([second, number + 1]);
            } else {
                for lamp in node.first..node.first + node.count {
                    take(Part::Lamp(lamp), self.lamp_weight(&self.tree.lamps[lamp as usize]));
                }
            }
        }
    }

    /// Whether nothing of a sphere is above the horizon and seen by way of the mirror.
    fn is_out_of_view(&self, to: Vector, node: &Node) -> bool {
        let radius_m = node.radius_m + self.reach_m;
        self.shading.dot(to) + radius_m <= 0.0
            || self.geometric.dot(to) + radius_m <= 0.0
            || self.window.as_ref().is_some_and(|w| !w.shows(self, node.centre, node.radius_m))
    }

    /// What a cluster is expected to give: as its members do in the mean, unless these differ so much
    /// that others may give light where they give none.
    fn node_weight(&self, node: &Node) -> f64 {
        let to = node.centre - self.point;
        if self.is_out_of_view(to, node) {
            return 0.0;
        }
        let shares = node.members.map(|member| {
            let lamp = &self.tree.lamps[member as usize];
            self.lamp_weight(lamp) / lamp.peak_cd
        });
        let mean = node.peak_cd * shares.iter().sum::<f64>() / shares.len() as f64;
        let highest = shares.into_iter().fold(0.0, f64::max);
        if shares.iter().all(|&share| share > UNEVEN * highest) {
            return mean;
        }
        mean.max(UNEVEN * self.weight_by_table(to, node))
    }

    /// What a cluster that may be in view may give, by its own table.
    fn weight_by_table(&self, to: Vector, node: &Node) -> f64 {
        let radius_m = node.radius_m + self.reach_m;
        // A cluster around the receiver: as if it were at the distance of its rim.
        let distance2 = to.length_squared().max(radius_m * radius_m).max(f64::MIN_POSITIVE);
        let distance = distance2.sqrt();
        let cos = height_above(self.shading.dot(to), radius_m) / distance;
        let local = match node.kind {
            Some(kind) => turned(&self.tree.kinds[kind as usize].frame, -to),
            None => -to,
        };
        let shape = self.tree.lobes.towards(node.lobe, radius_m / distance, local);
        self.reflectance * node.peak_cd * shape * cos / distance2
    }

    /// How light of a lamp reaches the receiver, if that faces it.
    pub(crate) fn reaching(&self, position: Point, frame: &[Vector; 3]) -> Option<Reaching> {
        let to = position - self.point;
        let towards = to.direction()?.to_vector();
        let cos = self.shading.dot(towards);
        if !(cos > 0.0 && self.geometric.dot(towards) > 0.0) {
            return None;
        }
        let local = turned(frame, -towards).direction()?;
        Some(Reaching { local, per_cd: cos / to.length_squared() })
    }

    /// What a lamp is expected to give.
    pub(crate) fn lamp_weight(&self, lamp: &Lamp) -> f64 {
        if let Some(face) = self.tree.face(lamp) {
            return self.reflectance * self.face_weight(lamp, face);
        }
        let to = lamp.position - self.point;
        let (height, reach_m) = (self.shading.dot(to), self.reach_m);
        if height + reach_m <= 0.0
            || self.geometric.dot(to) + reach_m <= 0.0
            || self.window.as_ref().is_some_and(|w| !w.shows(self, lamp.position, 0.0))
        {
            return 0.0;
        }
        let distance2 = to.length_squared();
        let kind = &self.tree.kinds[lamp.kind as usize];
        let (lobes, local) = (&self.tree.lobes, turned(&kind.frame, -to));
        let shape = lobes.plain(kind.lobe, local);
        let shape = match shape > 0.0 || reach_m == 0.0 {
            true => shape,
            false => lobes.towards(kind.lobe, reach_m / distance2.sqrt(), local),
        };
        let height = height_above(height, reach_m);
        self.reflectance * lamp.peak_cd * shape * height / (distance2 * distance2.sqrt())
    }

    /// What a face is expected to give where mirrors take nothing off.
    fn face_weight(&self, lamp: &Lamp, face: &Face) -> f64 {
        let to = lamp.position - self.point;
        let radius_m = face.radius_m + self.reach_m;
        let height_m = self.shading.dot(to);
        // Frames shine along -z.
        let depth_m = self.tree.kinds[lamp.kind as usize].frame[2].dot(to);
        if depth_m + self.reach_m <= 0.0
            || height_m + radius_m <= 0.0
            || self.geometric.dot(to) + radius_m <= 0.0
            || self.window.as_ref().is_some_and(|w| !w.shows(self, lamp.position, face.radius_m))
        {
            return 0.0;
        }
        let distance2 = to.length_squared();
        let is_near = radius_m * radius_m > FAR * FAR * distance2;
        if is_near && self.reach_m == 0.0 {
            let corners = face.corners(self.scene);
            return lamp.colour.luminance() * steradians_from((self.point, self.shading), corners);
        }
        let distance2 = distance2.max(radius_m * radius_m);
        let depth_m = height_above(depth_m, self.reach_m);
        lamp.peak_cd * depth_m * height_above(height_m, radius_m) / (distance2 * distance2)
    }
}

/// The mean over heights between the rims of a sphere, of which those below the horizon count nothing.
fn height_above(height_m: f64, radius_m: f64) -> f64 {
    if height_m >= radius_m {
        return height_m;
    }
    let above_m = height_m + radius_m;
    above_m * above_m / (4.0 * radius_m)
}

/// Light of a lamp on its way to a receiver.
pub(crate) struct Reaching {
    /// Where it leaves, in the frame of the lamp.
    pub(crate) local: Direction,
    /// Illuminance for every candela, without mirrors and obstacles, lx.
    pub(crate) per_cd: f64,
}

impl Window<'_> {
    /// Whether something of a sphere may be seen through the box around the mirror from a place
    /// behind it.
    fn shows(&self, view: &View, centre: Point, radius_m: f64) -> bool {
        let (from, reach_m) = (view.point, view.reach_m);
        let (depth, height) = (self.depth_m, self.plane.height(centre));
        if height + radius_m <= -self.tolerance_m {
            return false;
        }
        let nearest = height - radius_m;
        if nearest <= self.tolerance_m || depth <= self.tolerance_m + reach_m {
            return true;
        }
        // The crossing moves by the sphere's radius, foreshortened, and by the change of its height.
        let to = centre - from;
        let crossing = from + to * (depth / (depth + height));
        let margin_m = depth / (depth + nearest) * radius_m
            + to.length() * depth * radius_m / ((depth + height) * (depth + nearest));
        // The same the other way about: the place moves, and its depth changes.
        let away = depth + nearest;
        let margin_m = margin_m
            + reach_m * nearest / away
            + (to.length() + reach_m) * reach_m * (nearest + 2.0 * radius_m)
                / (away * (away - reach_m));
        self.plane.is_near(crossing, margin_m + self.tolerance_m * (2.0 + to.length() / nearest))
    }
}
