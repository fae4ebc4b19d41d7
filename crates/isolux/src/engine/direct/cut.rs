//! Clusters of luminaires as seen from a receiver, straight or in mirrors.

use super::Lighting;
use super::lobe::turned;
use super::mirrors::Plane;
use super::tree::{Lamp, Node, Tree};
use crate::engine::surface::SurfacePoint;
use isolux_geometry::{Direction, Point, Vector};

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

/// A receiver as reflected by a chain of mirrors, back to where the luminaires are.
pub(super) struct View<'a> {
    tree: &'a Tree,
    /// Which chain.
    pub(super) chain: usize,
    point: Point,
    shading: Vector,
    geometric: Vector,
    /// Luminance that the mirrors leave.
    reflectance: f64,
    /// The mirror that light meets first: nothing is seen but through it.
    window: Option<Window<'a>>,
}

/// A mirror seen from behind.
struct Window<'a> {
    plane: &'a Plane,
    depth_m: f64,
    tolerance_m: f64,
}

/// A cluster or a single lamp of the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Node(u32),
    Lamp(u32),
}

/// A part of the tree as seen in a view, with an estimate of the illuminance it would give without
/// obstacles, lx; zero only if that is zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    pub(super) view: usize,
    pub(super) part: Part,
    pub(super) weight: f64,
}

/// The views of a receiver and a partition of all that it sees in them.
pub(super) struct Cut<'a> {
    pub(super) views: Vec<View<'a>>,
    pub(super) seen: Vec<Seen>,
    pub(super) total: f64,
}

impl Lighting<'_> {
    /// What a receiver sees of the luminaires without surface and their images, to know their light.
    pub(super) fn fine_cut(&self, at: &SurfacePoint) -> Cut<'_> {
        self.cut(at, Tightness::FINE)
    }

    /// The same, to draw one of them.
    pub(super) fn rough_cut(&self, at: &SurfacePoint) -> Cut<'_> {
        self.cut(at, Tightness::ROUGH)
    }

    fn cut(&self, at: &SurfacePoint, tight: Tightness) -> Cut<'_> {
        let views: Vec<View> =
            (0..self.chains.len()).filter_map(|chain| self.view(chain, at)).collect();
        let mut seen = Vec::with_capacity(256);
        for (index, view) in views.iter().enumerate() {
            view.cut(index, tight, &mut seen);
        }
        let total = seen.iter().map(|s| s.weight).sum();
        Cut { views, seen, total }
    }

    /// The view along a chain; `None` from behind its last mirror.
    pub(super) fn view(&self, chain: usize, at: &SurfacePoint) -> Option<View<'_>> {
        let (mut point, mut reflectance) = (at.point, 1.0);
        let mut normals = [at.shading.to_vector(), at.geometric.to_vector()];
        let planes = self.chains[chain].iter().map(|&p| &self.mirrors.planes[p as usize]);
        for (rank, plane) in planes.rev().enumerate() {
            if rank == 0 && plane.height(point) < -self.mirrors.tolerance_m {
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
        Some(View { tree: &self.tree, chain, point, shading, geometric, reflectance, window })
    }
}

impl View<'_> {
    /// Appends the tight clusters, and the lamps of leaves that are near.
    fn cut(&self, index: usize, tight: Tightness, seen: &mut Vec<Seen>) {
        let mut take = |part: Part, weight: f64| {
            if weight > 0.0 {
                seen.push(Seen { view: index, part, weight });
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
        let radius_m = node.radius_m;
        self.shading.dot(to) + radius_m <= 0.0
            || self.geometric.dot(to) + radius_m <= 0.0
            || self.window.as_ref().is_some_and(|w| !w.shows(self.point, node.centre, radius_m))
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
        let radius_m = node.radius_m;
        // A cluster around the receiver: as if it were at the distance of its rim.
        let distance2 = to.length_squared().max(radius_m * radius_m).max(f64::MIN_POSITIVE);
        let distance = distance2.sqrt();
        let height = self.shading.dot(to);
        let cos = if height >= radius_m {
            height / distance
        } else {
            // Mean over heights between the rims, of which those below the horizon give nothing.
            let above = height + radius_m;
            above * above / (4.0 * radius_m * distance)
        };
        let local = match node.kind {
            Some(kind) => turned(&self.tree.kinds[kind as usize].frame, -to),
            None => -to,
        };
        let shape = self.tree.lobes.towards(node.lobe, radius_m / distance, local);
        self.reflectance * node.peak_cd * shape * cos / distance2
    }

    /// How light of a lamp reaches the receiver, if that faces it.
    pub(super) fn reaching(&self, position: Point, frame: &[Vector; 3]) -> Option<Reaching> {
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
    pub(super) fn lamp_weight(&self, lamp: &Lamp) -> f64 {
        let to = lamp.position - self.point;
        let height = self.shading.dot(to);
        if height <= 0.0
            || self.geometric.dot(to) <= 0.0
            || self.window.as_ref().is_some_and(|w| !w.shows(self.point, lamp.position, 0.0))
        {
            return 0.0;
        }
        let distance2 = to.length_squared();
        let kind = &self.tree.kinds[lamp.kind as usize];
        let shape = self.tree.lobes.plain(kind.lobe, turned(&kind.frame, -to));
        self.reflectance * lamp.peak_cd * shape * height / (distance2 * distance2.sqrt())
    }
}

/// Light of a lamp on its way to a receiver.
pub(super) struct Reaching {
    /// Where it leaves, in the frame of the lamp.
    pub(super) local: Direction,
    /// Illuminance for every candela, without mirrors and obstacles, lx.
    pub(super) per_cd: f64,
}

impl Window<'_> {
    /// Whether something of a sphere may be seen through the box around the mirror from a point
    /// behind it.
    fn shows(&self, from: Point, centre: Point, radius_m: f64) -> bool {
        let (depth, height) = (self.depth_m, self.plane.height(centre));
        if height + radius_m <= -self.tolerance_m {
            return false;
        }
        let nearest = height - radius_m;
        if nearest <= self.tolerance_m || depth <= self.tolerance_m {
            return true;
        }
        // The crossing moves by the sphere's radius, foreshortened, and by the change of its height.
        let to = centre - from;
        let crossing = from + to * (depth / (depth + height));
        let margin_m = depth / (depth + nearest) * radius_m
            + to.length() * depth * radius_m / ((depth + height) * (depth + nearest));
        self.plane.is_near(crossing, margin_m + self.tolerance_m * (2.0 + to.length() / nearest))
    }
}
