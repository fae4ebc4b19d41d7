//! The triangles of an emitting surface as a tree of clusters, each with a sphere around it and a cone around its normals.

use crate::engine::ray::SurfacePoint;
use isolux_geometry::{Normal, Point, Vector};
use std::f64::consts::{FRAC_PI_2, PI};

/// Triangles of a leaf at most.
const GROUP: usize = 4;

/// Clusters of at most so many are known by each of their triangles, where they do not all face the receiver.
const FEW: usize = 32;

/// Clusters whose radius is at most this share of their distance are known by their middle.
const FAR: f64 = 0.3;

/// How much of a cluster that is near counts as facing the receiver for every radius that it is away.
const NEAR: f64 = 0.25;

/// A cluster counts as no nearer than so many of its radii.
const NEAREST: f64 = 0.05;

/// How much a spread of normals counts beside a spread in place as wide as the emitter.
const TURN: f64 = 0.25;

/// What angles may be off by rounding, rad: that of a cosine near its ends.
const ROUNDING_RAD: f64 = 1e-6;

/// A cluster of triangles.
#[derive(Clone, Debug)]
struct Cluster {
    centre: Point,
    radius_m: f64,
    low: Point,
    high: Point,
    /// The normals times the areas, m2.
    area_vector_m2: Vector,
    area_m2: f64,
    /// Along each axis, to both sides: the components of the area vectors, m2.
    sides_m2: [[f64; 2]; 3],
    /// No normal is farther from it than less than a quarter turn; without one they may be any.
    axis: Option<Normal>,
    /// How far they are from it at most: the sine and the cosine.
    spread: [f64; 2],
    /// Its triangles, in the order of the tree.
    first: u32,
    count: u32,
    /// The second of its halves; the first follows it. None for a leaf.
    second: Option<u32>,
}

/// What a receiver may have of a cluster, where nothing is hidden.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Outlook {
    /// Surely nothing.
    Dark,
    /// About so much, projected sr.
    Known(f64),
    /// Perhaps some.
    Unknown,
}

/// All clusters of an emitter.
#[derive(Clone, Debug, Default)]
pub(crate) struct Clusters {
    all: Vec<Cluster>,
    /// The triangles in the order of the tree, and where each is in it.
    order: Vec<u32>,
    ranks: Vec<u32>,
    /// In the order of the tree.
    facets: Vec<Facet>,
}

/// A triangle.
#[derive(Clone, Copy, Debug)]
struct Facet {
    middle: Point,
    corners: [Point; 3],
    normal: Option<Normal>,
    area_vector_m2: Vector,
    area_m2: f64,
}

impl Clusters {
    /// Of triangles that emit from their counter-clockwise side.
    pub(crate) fn of(triangles: &[[Point; 3]]) -> Self {
        let facets: Vec<Facet> = triangles.iter().copied().map(Facet::of).collect();
        let order = (0..triangles.len() as u32).collect();
        let ranks = vec![0; triangles.len()];
        let mut tree = Self { all: Vec::new(), order, ranks, facets: Vec::new() };
        let extent = spreads(&tree.order, |k| Some(facets[k].middle.to_vector()));
        let extent = extent.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        if !triangles.is_empty() {
            tree.build(&facets, extent, (0, triangles.len()));
        }
        for (rank, &triangle) in tree.order.iter().enumerate() {
            tree.ranks[triangle as usize] = rank as u32;
        }
        tree.facets = tree.order.iter().map(|&k| facets[k as usize]).collect();
        tree
    }

    /// Appends the cluster of a range of triangles and its parts.
    fn build(&mut self, facets: &[Facet], extent: f64, (first, end): (usize, usize)) -> u32 {
        let index = self.all.len();
        let members = &mut self.order[first..end];
        self.all.push(cluster(facets, first, members));
        if members.len() > GROUP {
            let middle = first + halve(facets, extent, members);
            self.build(facets, extent, (first, middle));
            self.all[index].second = Some(self.build(facets, extent, (middle, end)));
        }
        index as u32
    }

    fn cluster(&self, number: u32) -> &Cluster {
        &self.all[number as usize]
    }

    /// The halves of a cluster; none of a leaf.
    pub(crate) fn halves(&self, number: u32) -> Option<[u32; 2]> {
        self.cluster(number).second.map(|second| [number + 1, second])
    }

    /// The triangles of a cluster.
    pub(crate) fn triangles(&self, number: u32) -> &[u32] {
        let cluster = self.cluster(number);
        &self.order[cluster.first as usize..][..cluster.count as usize]
    }

    /// Whether a triangle belongs to a cluster.
    pub(crate) fn has(&self, number: u32, triangle: usize) -> bool {
        let cluster = self.cluster(number);
        let rank = self.ranks[triangle];
        cluster.first <= rank && rank < cluster.first + cluster.count
    }

    /// What a receiver may have of a cluster.
    pub(crate) fn outlook(&self, number: u32, at: &SurfacePoint) -> Outlook {
        self.cluster(number).outlook(at, self.facets(number))
    }

    /// About how much a receiver may have of a cluster, projected sr; zero only if it has nothing.
    pub(crate) fn weight(&self, number: u32, at: &SurfacePoint) -> f64 {
        match self.outlook(number, at) {
            Outlook::Dark => 0.0,
            Outlook::Known(steradians) => steradians,
            Outlook::Unknown => self.steradians(number, at),
        }
    }

    /// The same of a cluster whose outlook is unknown.
    pub(crate) fn steradians(&self, number: u32, at: &SurfacePoint) -> f64 {
        self.cluster(number).steradians(at, self.facets(number))
    }

    fn facets(&self, number: u32) -> &[Facet] {
        let cluster = self.cluster(number);
        &self.facets[cluster.first as usize..][..cluster.count as usize]
    }

    /// Which of those in doubt is to be divided first: by how much it may give at the nearest.
    pub(crate) fn doubt(&self, number: u32, at: &SurfacePoint) -> f64 {
        let cluster = self.cluster(number);
        let nearest_m = ((cluster.centre - at.point).length() - cluster.radius_m).max(0.0);
        cluster.area_m2 / (nearest_m * nearest_m)
    }
}

impl Cluster {
    fn outlook(&self, at: &SurfacePoint, facets: &[Facet]) -> Outlook {
        let to = self.centre - at.point;
        let (distance, radius_m) = (to.length(), self.radius_m);
        let height_m = to.dot(at.shading.to_vector());
        if self.area_m2 <= 0.0 || height_m + radius_m <= 0.0 {
            return Outlook::Dark;
        }
        let is_far = radius_m <= FAR * distance;
        let distance2 = distance.max(radius_m).max(f64::MIN_POSITIVE).powi(2);
        let about = self.axis.and_then(|axis| Some((axis, self.sine_about(radius_m / distance)?)));
        if let Some((axis, sine)) = about {
            let cos = -axis.to_vector().dot(to) / distance;
            if cos <= -sine {
                return Outlook::Dark;
            }
            if is_far && cos > sine && height_m > radius_m {
                let area_m2 = -self.area_vector_m2.dot(to) / distance;
                return Outlook::Known(area_m2 * height_m / (distance * distance2));
            }
        }
        if is_far { Outlook::Known(self.steradians(at, facets)) } else { Outlook::Unknown }
    }

    /// How far normals and directions to its sphere, that is seen under an angle of such a sine, are off at most: the sine of
    /// their sum, if that is less than a quarter turn.
    fn sine_about(&self, of_radius: f64) -> Option<f64> {
        if of_radius.is_nan() || of_radius >= 1.0 {
            return None;
        }
        let cos_of_radius = (1.0 - of_radius * of_radius).sqrt();
        let [sine, cos] = self.spread;
        let is_less = cos * cos_of_radius > sine * of_radius;
        is_less.then_some(sine * cos_of_radius + cos * of_radius)
    }

    /// About how much a receiver may have that is not surely in the dark; never zero.
    fn steradians(&self, at: &SurfacePoint, facets: &[Facet]) -> f64 {
        let to = self.centre - at.point;
        let (distance, radius_m) = (to.length(), self.radius_m);
        if facets.len() <= FEW {
            let is_far = radius_m <= FAR * distance;
            let each = facets.iter().map(|facet| facet.steradians(at, radius_m, is_far));
            return each.sum::<f64>().max(f64::MIN_POSITIVE);
        }
        let distance = distance.max(radius_m).max(f64::MIN_POSITIVE);
        let height = height_above(to.dot(at.shading.to_vector()), radius_m) / distance;
        // What lies along a line gives light as from between its nearest place and its ends.
        let nearest_m = self.nearest_m(at.point).max(NEAREST * radius_m);
        (self.facing_m2(to) * height / (nearest_m * distance)).max(f64::MIN_POSITIVE)
    }

    /// How far the box around it is away, m.
    fn nearest_m(&self, from: Point) -> f64 {
        let away = [self.low - from, from - self.high];
        let along = |axis: usize| away.map(|v| v.component(axis)).into_iter().fold(0.0, f64::max);
        Vector::new(along(0), along(1), along(2)).length()
    }

    /// At least what faces a receiver of its area, from where all is in one direction; up to the square root of three times as much.
    fn facing_m2(&self, to: Vector) -> f64 {
        let distance = to.length().max(self.radius_m);
        let along = |axis: usize| {
            let component = -to.component(axis) / distance;
            component.abs() * self.sides_m2[axis][usize::from(component < 0.0)]
        };
        along(0) + along(1) + along(2) + NEAR * self.area_m2 * self.radius_m / distance
    }
}

impl Facet {
    fn of(corners: [Point; 3]) -> Self {
        let [a, b, c] = corners;
        let area_vector_m2 = (b - a).cross(c - a) * 0.5;
        let middle = a + ((b - a) + (c - a)) / 3.0;
        let (normal, area_m2) = (area_vector_m2.normal(), area_vector_m2.length());
        Self { middle, corners, normal, area_vector_m2, area_m2 }
    }

    /// Projected solid angle by its middle, or by places towards its corners too; zero only where it faces away.
    fn steradians(&self, at: &SurfacePoint, radius_m: f64, is_far: bool) -> f64 {
        let to = self.middle - at.point;
        let depth = -self.area_vector_m2.dot(to);
        // What is seen edge on may be seen after all, if rounding says so.
        let least = ROUNDING_RAD * self.area_m2 * to.length();
        if depth <= -least {
            return 0.0;
        }
        let depth = depth.max(least);
        let one = |to: Vector| {
            let distance2 = to.length_squared().max(f64::MIN_POSITIVE);
            let height = height_above(to.dot(at.shading.to_vector()), radius_m);
            (depth * height / (distance2 * distance2)).min(PI)
        };
        if is_far {
            return one(to);
        }
        let others = self.corners.map(|corner| one(to + (corner - self.middle) * 0.5));
        (one(to) + others[0] + others[1] + others[2]) / 4.0
    }
}

/// The mean over heights between the rims of a sphere, of which those below the horizon count nothing.
pub(crate) fn height_above(height_m: f64, radius_m: f64) -> f64 {
    if height_m >= radius_m {
        return height_m;
    }
    let above_m = (height_m + radius_m).max(0.0);
    above_m * above_m / (4.0 * radius_m)
}

/// A leaf of some triangles.
fn cluster(facets: &[Facet], first: usize, members: &[u32]) -> Cluster {
    let facet = |&k: &u32| &facets[k as usize];
    let start = facets[members[0] as usize].middle;
    let (mut area_m2, mut area_vector_m2, mut moment) = (0.0, Vector::ZERO, Vector::ZERO);
    let mut sides_m2 = [[0.0; 2]; 3];
    for Facet { middle, area_vector_m2: vector_m2, area_m2: m2, .. } in members.iter().map(facet) {
        area_m2 += m2;
        area_vector_m2 += *vector_m2;
        moment += (*middle - start) * *m2;
        for (axis, sides) in sides_m2.iter_mut().enumerate() {
            let component = vector_m2.component(axis);
            sides[usize::from(component < 0.0)] += component.abs();
        }
    }
    let centre = if area_m2 > 0.0 { start + moment / area_m2 } else { start };
    let corners = || members.iter().flat_map(|k| facet(k).corners);
    let low = corners().fold(start, Point::lesser);
    let high = corners().fold(start, Point::greater);
    let radius_m = corners().map(|p| (p - centre).length()).fold(0.0, f64::max);
    let axis = area_vector_m2.normal();
    let normals = || members.iter().filter_map(|k| facet(k).normal);
    let spread_rad = axis.map_or(PI, |axis| {
        let angle = |n: Normal| libm::acos(n.to_vector().dot(axis.to_vector()).clamp(-1.0, 1.0));
        normals().map(angle).fold(0.0, f64::max) + ROUNDING_RAD
    });
    Cluster {
        centre,
        // The roundings of a length and of those that follow.
        radius_m: radius_m * (1.0 + 1e-12),
        low,
        high,
        area_vector_m2,
        area_m2,
        sides_m2,
        axis: axis.filter(|_| spread_rad < FRAC_PI_2),
        spread: [libm::sin(spread_rad), libm::cos(spread_rad)],
        first: first as u32,
        count: members.len() as u32,
        second: None,
    }
}

/// Puts the half first that is lower along the axis of the widest spread, in place or of the normals; returns how many that are.
fn halve(facets: &[Facet], extent: f64, members: &mut [u32]) -> usize {
    let places = spreads(members, |k| Some(facets[k].middle.to_vector())).map(|m| m / extent);
    let turns = spreads(members, |k| facets[k].normal.map(Normal::to_vector)).map(|t| t * TURN);
    let widest = |of: [f64; 3]| (0..3).fold(0, |best, k| if of[k] > of[best] { k } else { best });
    let (place, turn) = (widest(places), widest(turns));
    let along = |&k: &u32| {
        let facet = &facets[k as usize];
        if places[place] >= turns[turn] {
            facet.middle.to_vector().component(place)
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
