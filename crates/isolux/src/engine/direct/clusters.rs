//! The triangles of an emitting surface as a tree of clusters, each with a sphere around it and a cone around its normals.

use crate::engine::surface::SurfacePoint;
use isolux_geometry::{Normal, Point, Vector};
use std::f64::consts::{FRAC_PI_2, PI};

/// Triangles of a leaf at most.
const GROUP: usize = 4;

/// Clusters whose radius is at most this share of their distance are known by their middle, if all of their triangles face
/// the receiver and are above its horizon.
const FAR: f64 = 0.3;

/// How much a spread of normals counts beside a spread in place as wide as the emitter.
const TURN: f64 = 0.25;

/// What angles may be off by rounding, rad: that of an arc cosine near its ends.
const ROUNDING_RAD: f64 = 1e-6;

/// A cluster of triangles.
#[derive(Clone, Debug)]
struct Cluster {
    centre: Point,
    radius_m: f64,
    /// The normals times the areas, m2.
    area_vector_m2: Vector,
    area_m2: f64,
    /// All normals are within `spread_rad` of it; without one they may be any.
    axis: Option<Normal>,
    spread_rad: f64,
    /// Its triangles, in the order of the tree.
    first: u32,
    count: u32,
    /// The second of its halves; the first follows it. None for a leaf.
    second: Option<u32>,
}

/// What a receiver may have of a cluster, where nothing is hidden.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outlook {
    /// Surely nothing.
    Dark,
    /// About so much, projected sr.
    Known(f64),
    /// Perhaps so much; never zero.
    Unknown(f64),
}

impl Outlook {
    pub(super) fn weight(self) -> f64 {
        match self {
            Self::Dark => 0.0,
            Self::Known(steradians) | Self::Unknown(steradians) => steradians,
        }
    }
}

/// All clusters of an emitter.
#[derive(Clone, Debug, Default)]
pub(super) struct Clusters {
    all: Vec<Cluster>,
    /// The triangles in the order of the tree, and where each is in it.
    order: Vec<u32>,
    ranks: Vec<u32>,
}

/// What the tree is built by.
struct Facet {
    middle: Vector,
    normal: Option<Normal>,
}

impl Clusters {
    /// Of triangles that emit from their counter-clockwise side.
    pub(super) fn of(triangles: &[[Point; 3]]) -> Self {
        let facet = |&[a, b, c]: &[Point; 3]| Facet {
            middle: (a.to_vector() + b.to_vector() + c.to_vector()) / 3.0,
            normal: (b - a).cross(c - a).normal(),
        };
        let facets: Vec<Facet> = triangles.iter().map(facet).collect();
        let order = (0..triangles.len() as u32).collect();
        let mut tree = Self { all: Vec::new(), order, ranks: vec![0; triangles.len()] };
        let extent = spreads(&tree.order, |k| Some(facets[k].middle));
        let extent = extent.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        if !triangles.is_empty() {
            tree.build(triangles, &facets, extent, (0, triangles.len()));
        }
        for (rank, &triangle) in tree.order.iter().enumerate() {
            tree.ranks[triangle as usize] = rank as u32;
        }
        tree
    }

    /// Appends the cluster of a range of triangles and its parts.
    fn build(
        &mut self,
        triangles: &[[Point; 3]],
        facets: &[Facet],
        extent: f64,
        (first, end): (usize, usize),
    ) -> u32 {
        let index = self.all.len();
        let members = &mut self.order[first..end];
        self.all.push(cluster(triangles, facets, first, members));
        if members.len() > GROUP {
            let middle = first + halve(facets, extent, members);
            self.build(triangles, facets, extent, (first, middle));
            self.all[index].second = Some(self.build(triangles, facets, extent, (middle, end)));
        }
        index as u32
    }

    fn cluster(&self, number: u32) -> &Cluster {
        &self.all[number as usize]
    }

    /// The halves of a cluster; none of a leaf.
    pub(super) fn halves(&self, number: u32) -> Option<[u32; 2]> {
        self.cluster(number).second.map(|second| [number + 1, second])
    }

    /// The triangles of a cluster.
    pub(super) fn triangles(&self, number: u32) -> &[u32] {
        let cluster = self.cluster(number);
        &self.order[cluster.first as usize..][..cluster.count as usize]
    }

    /// Whether a triangle belongs to a cluster.
    pub(super) fn has(&self, number: u32, triangle: usize) -> bool {
        let cluster = self.cluster(number);
        let rank = self.ranks[triangle];
        cluster.first <= rank && rank < cluster.first + cluster.count
    }

    /// What a receiver may have of a cluster.
    pub(super) fn outlook(&self, number: u32, at: &SurfacePoint) -> Outlook {
        self.cluster(number).outlook(at)
    }

    /// Which of those in doubt is to be divided first: by how much it may give at the nearest.
    pub(super) fn doubt(&self, number: u32, at: &SurfacePoint) -> f64 {
        let cluster = self.cluster(number);
        let nearest_m = ((cluster.centre - at.point).length() - cluster.radius_m).max(0.0);
        cluster.area_m2 / (nearest_m * nearest_m)
    }
}

impl Cluster {
    fn outlook(&self, at: &SurfacePoint) -> Outlook {
        let to = self.centre - at.point;
        let (distance, radius_m) = (to.length(), self.radius_m);
        let height_m = to.dot(at.shading.to_vector());
        if self.area_m2 <= 0.0 || height_m + radius_m <= 0.0 {
            return Outlook::Dark;
        }
        let distance2 = distance.max(radius_m).max(f64::MIN_POSITIVE).powi(2);
        let height = height_above(height_m, radius_m) / distance2.sqrt();
        let most = self.area_m2 * height / distance2;
        let Some(axis) = self.axis.filter(|_| distance > radius_m) else {
            return unknown(most);
        };
        let off_axis = libm::acos((-axis.to_vector().dot(to) / distance).clamp(-1.0, 1.0));
        let about = self.spread_rad + libm::asin(radius_m / distance) + ROUNDING_RAD;
        let nearest = off_axis - about;
        if nearest >= FRAC_PI_2 {
            return Outlook::Dark;
        }
        if radius_m <= FAR * distance && off_axis + about < FRAC_PI_2 && height_m > radius_m {
            let area_m2 = -self.area_vector_m2.dot(to) / distance;
            return Outlook::Known(area_m2 * height_m / (distance * distance2));
        }
        unknown(most * libm::cos(nearest.max(0.0)))
    }
}

fn unknown(steradians: f64) -> Outlook {
    Outlook::Unknown(steradians.max(f64::MIN_POSITIVE))
}

/// The mean over heights between the rims of a sphere, of which those below the horizon count nothing.
fn height_above(height_m: f64, radius_m: f64) -> f64 {
    if height_m >= radius_m {
        return height_m;
    }
    let above_m = height_m + radius_m;
    above_m * above_m / (4.0 * radius_m)
}

/// A leaf of some triangles.
fn cluster(triangles: &[[Point; 3]], facets: &[Facet], first: usize, members: &[u32]) -> Cluster {
    let (mut area_m2, mut area_vector_m2, mut moment) = (0.0, Vector::ZERO, Vector::ZERO);
    for &k in members {
        let [a, b, c] = triangles[k as usize];
        let vector_m2 = (b - a).cross(c - a) * 0.5;
        let m2 = vector_m2.length();
        area_m2 += m2;
        area_vector_m2 += vector_m2;
        moment += (facets[k as usize].middle - facets[members[0] as usize].middle) * m2;
    }
    let centre = Point::ORIGIN + facets[members[0] as usize].middle;
    let centre = if area_m2 > 0.0 { centre + moment / area_m2 } else { centre };
    let corners = members.iter().flat_map(|&k| triangles[k as usize]);
    let radius_m = corners.map(|p| (p - centre).length()).fold(0.0, f64::max);
    let axis = area_vector_m2.normal();
    let normals = || members.iter().filter_map(|&k| facets[k as usize].normal);
    let spread_rad = axis.map_or(PI, |axis| {
        let angle = |n: Normal| libm::acos(n.to_vector().dot(axis.to_vector()).clamp(-1.0, 1.0));
        normals().map(angle).fold(0.0, f64::max)
    });
    Cluster {
        centre,
        // The roundings of a length and of those that follow.
        radius_m: radius_m * (1.0 + 1e-12),
        area_vector_m2,
        area_m2,
        axis,
        spread_rad,
        first: first as u32,
        count: members.len() as u32,
        second: None,
    }
}

/// Puts the half first that is lower along the axis of the widest spread, in place or of the normals; returns how many that are.
fn halve(facets: &[Facet], extent: f64, members: &mut [u32]) -> usize {
    let places = spreads(members, |k| Some(facets[k].middle)).map(|m| m / extent);
    let turns = spreads(members, |k| facets[k].normal.map(Normal::to_vector)).map(|t| t * TURN);
    let widest = |of: [f64; 3]| (0..3).fold(0, |best, k| if of[k] > of[best] { k } else { best });
    let (place, turn) = (widest(places), widest(turns));
    let along = |&k: &u32| {
        let facet = &facets[k as usize];
        if places[place] >= turns[turn] {
            facet.middle.component(place)
        } else {
            facet.normal.map_or(0.0, |n| n.to_vector().component(turn))
        }
    };
    members.sort_unstable_by(|a, b| along(a).total_cmp(&along(b)).then(a.cmp(b)));
    members.len() / 2
}

/// How far vectors spread along each axis.
fn spreads(members: &[u32], vector: impl Fn(usize) -> Option<Vector>) -> [f64; 3] {
    let vectors = || members.iter().filter_map(|&k| vector(k as usize));
    std::array::from_fn(|axis| {
        let along = || vectors().map(|v| v.component(axis));
        let (low, high) =
            (along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max));
        (high - low).max(0.0)
    })
}
