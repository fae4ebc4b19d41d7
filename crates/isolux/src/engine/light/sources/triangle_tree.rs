//! A tree of clusters of the triangles of an emitting surface, each with a bounding sphere and a cone of normals.

use crate::engine::ray::SurfacePoint;
use isolux_geometry::{Normal, Point, Vector};
use std::f64::consts::{FRAC_PI_2, PI};

/// The most triangles in a leaf.
const MOST_LEAF_TRIANGLES: usize = 4;

/// The most triangles of a cluster whose weight is the sum over them, where not all of them face the receiver.
const FEW_TRIANGLES: usize = 32;

/// Radius of a cluster over its distance, up to which its weight comes from its centre alone.
const FAR_RADIUS_RATIO: f64 = 0.3;

/// Share of the area of a near cluster that counts as facing the receiver, times its radius over its distance.
const NEAR_AREA_SHARE: f64 = 0.25;

/// The smallest distance at which a cluster counts, in its radii.
const LEAST_DISTANCE_RADII: f64 = 0.05;

/// Weight of a spread of normals against a spread of places as wide as the emitter.
const NORMAL_SPREAD_WEIGHT: f64 = 0.25;

/// Rounding of an angle, rad: that of a cosine near its ends.
const ROUNDING_RAD: f64 = 1e-6;

/// A cluster of triangles.
#[derive(Clone, Debug)]
struct Cluster {
    centre: Point,
    radius_m: f64,
    low: Point,
    high: Point,
    /// Sum of the normals times the areas, m2.
    area_vector_m2: Vector,
    area_m2: f64,
    /// Components of the area vectors summed along each axis, positive and negative apart, m2.
    sides_m2: [[f64; 2]; 3],
    /// Axis of a cone of normals narrower than a quarter turn; `None` if the normals spread wider.
    axis: Option<Normal>,
    /// Sine and cosine of the largest angle between a normal and the axis.
    spread: [f64; 2],
    /// Index of the first triangle, in the order of the tree.
    first: u32,
    count: u32,
    /// Number of its second half, `None` for a leaf. The first half follows the cluster itself.
    second: Option<u32>,
}

/// Knowledge of the unoccluded light that a receiver has of a cluster.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Outlook {
    /// Surely none.
    Dark,
    /// Approximate projected solid angle, sr.
    Known(f64),
    /// Perhaps some.
    Unknown,
}

/// All clusters of an emitter.
#[derive(Clone, Debug, Default)]
pub(crate) struct Clusters {
    all: Vec<Cluster>,
    /// The triangles in the order of the tree.
    order: Vec<u32>,
    /// The position of every triangle in that order.
    ranks: Vec<u32>,
    /// The facets in the order of the tree.
    facets: Vec<Facet>,
}

/// A triangle of the emitter.
#[derive(Clone, Copy, Debug)]
struct Facet {
    middle: Point,
    corners: [Point; 3],
    normal: Option<Normal>,
    area_vector_m2: Vector,
    area_m2: f64,
}

impl Clusters {
    /// The tree of triangles that emit from their counter-clockwise side.
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

    /// Appends the cluster of a range of triangles and its descendants.
    fn build(&mut self, facets: &[Facet], extent: f64, (first, end): (usize, usize)) -> u32 {
        let index = self.all.len();
        let members = &mut self.order[first..end];
        self.all.push(cluster(facets, first, members));
        if members.len() > MOST_LEAF_TRIANGLES {
            let middle = first + halve(facets, extent, members);
            self.build(facets, extent, (first, middle));
            self.all[index].second = Some(self.build(facets, extent, (middle, end)));
        }
        index as u32
    }

    fn cluster(&self, number: u32) -> &Cluster {
        &self.all[number as usize]
    }

    /// The halves of a cluster; `None` for a leaf.
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

    /// Knowledge of the light that a receiver has of a cluster.
    pub(crate) fn outlook(&self, number: u32, at: &SurfacePoint) -> Outlook {
        self.cluster(number).outlook(at, self.facets(number))
    }

    /// Approximate projected solid angle of a cluster at a receiver, sr; zero only if the receiver sees nothing of it.
    pub(crate) fn weight(&self, number: u32, at: &SurfacePoint) -> f64 {
        match self.outlook(number, at) {
            Outlook::Dark => 0.0,
            Outlook::Known(steradians) => steradians,
            Outlook::Unknown => self.steradians(number, at),
        }
    }

    /// Approximate projected solid angle of a cluster whose outlook is unknown, sr.
    pub(crate) fn steradians(&self, number: u32, at: &SurfacePoint) -> f64 {
        self.cluster(number).steradians(at, self.facets(number))
    }

    fn facets(&self, number: u32) -> &[Facet] {
        let cluster = self.cluster(number);
        &self.facets[cluster.first as usize..][..cluster.count as usize]
    }

    /// Priority for dividing a cluster whose outlook is unknown: its area over the square of its smallest distance.
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
        let is_far = radius_m <= FAR_RADIUS_RATIO * distance;
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

    /// Sine of the largest angle between a normal and a direction to the bounding sphere, beyond that of axis and
    /// centre. `of_radius` is the sine of the angular radius of the sphere. `None` if the angle reaches a quarter turn.
    fn sine_about(&self, of_radius: f64) -> Option<f64> {
        if of_radius.is_nan() || of_radius >= 1.0 {
            return None;
        }
        let cos_of_radius = (1.0 - of_radius * of_radius).sqrt();
        let [sine, cos] = self.spread;
        let is_less = cos * cos_of_radius > sine * of_radius;
        is_less.then_some(sine * cos_of_radius + cos * of_radius)
    }

    /// Approximate projected solid angle of a cluster that is not surely dark, sr; never zero.
    fn steradians(&self, at: &SurfacePoint, facets: &[Facet]) -> f64 {
        let to = self.centre - at.point;
        let (distance, radius_m) = (to.length(), self.radius_m);
        if facets.len() <= FEW_TRIANGLES {
            let is_far = radius_m <= FAR_RADIUS_RATIO * distance;
            let each = facets.iter().map(|facet| facet.steradians(at, radius_m, is_far));
            return each.sum::<f64>().max(f64::MIN_POSITIVE);
        }
        let distance = distance.max(radius_m).max(f64::MIN_POSITIVE);
        let height = height_above(to.dot(at.shading.to_vector()), radius_m) / distance;
        // The geometric mean of the distances to its nearest place and to its centre suits a cluster along a line.
        let nearest_m = self.nearest_m(at.point).max(LEAST_DISTANCE_RADII * radius_m);
        (self.facing_m2(to) * height / (nearest_m * distance)).max(f64::MIN_POSITIVE)
    }

    /// Distance to the bounding box, m.
    fn nearest_m(&self, from: Point) -> f64 {
        let away = [self.low - from, from - self.high];
        let along = |axis: usize| away.map(|v| v.component(axis)).into_iter().fold(0.0, f64::max);
        Vector::new(along(0), along(1), along(2)).length()
    }

    /// Estimate of the area that faces a receiver in one direction, m2: exact for facets along the axes, too large for
    /// others.
    fn facing_m2(&self, to: Vector) -> f64 {
        let distance = to.length().max(self.radius_m);
        let along = |axis: usize| {
            let component = -to.component(axis) / distance;
            component.abs() * self.sides_m2[axis][usize::from(component < 0.0)]
        };
        along(0) + along(1) + along(2) + NEAR_AREA_SHARE * self.area_m2 * self.radius_m / distance
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

    /// Projected solid angle from the centroid, and for near triangles from places towards the
    /// corners too, sr. It is zero only where the triangle faces away.
    fn steradians(&self, at: &SurfacePoint, radius_m: f64, is_far: bool) -> f64 {
        let to = self.middle - at.point;
        let depth = -self.area_vector_m2.dot(to);
        // Rounding may hide a triangle that is seen edge on: it counts with the rounding error as its depth.
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

/// Mean height over a sphere, m; the part below the horizon counts as zero.
pub(crate) fn height_above(height_m: f64, radius_m: f64) -> f64 {
    if height_m >= radius_m {
        return height_m;
    }
    let above_m = (height_m + radius_m).max(0.0);
    above_m * above_m / (4.0 * radius_m)
}

/// A leaf of the triangles `members`.
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
        // Allowance for the rounding of a length and of the steps after it.
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

/// Puts the half first that is lower along the axis of the widest spread, of places or of normals. Returns its size.
fn halve(facets: &[Facet], extent: f64, members: &mut [u32]) -> usize {
    let places = spreads(members, |k| Some(facets[k].middle.to_vector())).map(|m| m / extent);
    let turns = spreads(members, |k| facets[k].normal.map(Normal::to_vector))
        .map(|t| t * NORMAL_SPREAD_WEIGHT);
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

/// Extent of vectors along each axis.
fn spreads(members: &[u32], vector: impl Fn(usize) -> Option<Vector>) -> [f64; 3] {
    let vectors = || members.iter().filter_map(|&k| vector(k as usize));
    std::array::from_fn(|axis| {
        let along = || vectors().map(|v| v.component(axis));
        let (low, high) =
            (along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max));
        (high - low).max(0.0)
    })
}
