//! Parts of a scene with the openings that light them: a decision tree by position and orientation.

use crate::engine::ray::SurfacePoint;

/// The most places of a part.
const MOST_PLACES: usize = 64;
/// The fewest places on either side of a border.
const FEWEST_PLACES: usize = 2;

/// Number of borders tried along every coordinate.
const TRIED_BORDERS: usize = 32;
/// The smallest share of the variance that a border must save.
const LEAST_SAVED_SHARE: f64 = 0.02;

/// Number of coordinates: three of a place and three of its normal.
const COORDINATES: usize = 6;

/// An opening through which light reaches a part of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Through {
    pub(crate) opening: u32,
    /// Number of rays for every projected solid angle of the opening, relative to the other openings.
    pub(crate) weight: f64,
}

/// A place with two variances: of a ray to all of the emitter, and of a ray to openings.
pub(crate) struct Told {
    features: [f64; COORDINATES],
    variances: [f64; 2],
}

impl Told {
    pub(crate) fn new(at: &SurfacePoint, variances: [f64; 2]) -> Self {
        Self { features: features(at), variances }
    }
}

fn features(at: &SurfacePoint) -> [f64; COORDINATES] {
    let (point, normal) = (at.point.to_vector(), at.geometric.to_vector());
    [point.x, point.y, point.z, normal.x, normal.y, normal.z]
}

/// A node of the decision tree: two halves, or a part with its openings.
enum Node {
    Halves { feature: usize, at: f64, second: u32 },
    Part(Vec<Through>),
}

/// Parts of a scene, as a decision tree.
pub(crate) struct Zones(Vec<Node>);

/// The state while the tree is built.
struct Maker<'a> {
    told: &'a [Told],
    through: &'a dyn Fn(&[u32]) -> Vec<Through>,
    nodes: Vec<Node>,
}

impl Zones {
    /// One part without openings.
    pub(crate) fn none() -> Self {
        Self(vec![Node::Part(Vec::new())])
    }

    /// Parts of a few places each, divided where different rays are better. `through` gives the
    /// openings that light some places.
    pub(crate) fn of(told: &[Told], through: &dyn Fn(&[u32]) -> Vec<Through>) -> Self {
        let mut maker = Maker { told, through, nodes: Vec::new() };
        maker.add((0..told.len() as u32).collect());
        Self(maker.nodes)
    }

    /// The openings that light a place.
    pub(crate) fn through(&self, at: &SurfacePoint) -> &[Through] {
        let features = features(at);
        let mut number = 0;
        loop {
            match &self.0[number] {
                Node::Part(through) => return through,
                Node::Halves { feature, at, second } => {
                    let is_first = features[*feature] < *at;
                    number = if is_first { number + 1 } else { *second as usize };
                }
            }
        }
    }

    /// Whether any part has openings.
    pub(crate) fn are_some(&self) -> bool {
        self.0.iter().any(|node| matches!(node, Node::Part(through) if !through.is_empty()))
    }
}

impl Maker<'_> {
    fn add(&mut self, of: Vec<u32>) {
        let Some((feature, at)) = self.border(&of).or_else(|| self.middle(&of)) else {
            let part = Node::Part((self.through)(&of));
            self.nodes.push(part);
            return;
        };
        let is_first = |k: &u32| self.told[*k as usize].features[feature] < at;
        let (first, second) = of.into_iter().partition(is_first);
        let own = self.nodes.len();
        self.nodes.push(Node::Part(Vec::new()));
        self.add(first);
        self.nodes[own] = Node::Halves { feature, at, second: self.nodes.len() as u32 };
        self.add(second);
    }

    fn range(&self, of: &[u32], feature: usize) -> [f64; 2] {
        let all = of.iter().map(|&k| self.told[k as usize].features[feature]);
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    }

    /// The border that saves the most variance if both sides use the better kind of rays.
    fn border(&self, of: &[u32]) -> Option<(usize, f64)> {
        let mut best = None;
        let mut most = 0.0_f64;
        for feature in 0..COORDINATES {
            let [low, high] = self.range(of, feature);
            if high <= low {
                continue;
            }
            let scale = TRIED_BORDERS as f64 / (high - low);
            let mut bins = [(0, [0.0; 2]); TRIED_BORDERS];
            for &k in of {
                let Told { features, variances } = &self.told[k as usize];
                let bin = &mut bins
                    [(((features[feature] - low) * scale) as usize).min(TRIED_BORDERS - 1)];
                bin.0 += 1;
                (0..2).for_each(|k| bin.1[k] += variances[k]);
            }
            let sum = |bins: &[(usize, [f64; 2])]| {
                bins.iter()
                    .fold((0, [0.0; 2]), |a, b| (a.0 + b.0, [a.1[0] + b.1[0], a.1[1] + b.1[1]]))
            };
            let least = |of: [f64; 2]| of[0].min(of[1]);
            let whole = least(sum(&bins).1);
            for k in 1..TRIED_BORDERS {
                let (first, second) = (sum(&bins[..k]), sum(&bins[k..]));
                let saved = whole - least(first.1) - least(second.1);
                if first.0.min(second.0) >= FEWEST_PLACES
                    && saved > most.max(LEAST_SAVED_SHARE * whole)
                {
                    most = saved;
                    best = Some((feature, low + k as f64 / scale));
                }
            }
        }
        best
    }

    /// The border at the median along the longest axis, if there are too many places.
    fn middle(&self, of: &[u32]) -> Option<(usize, f64)> {
        let ranges = [0, 1, 2].map(|feature| self.range(of, feature));
        let long = |feature: &usize| ranges[*feature][1] - ranges[*feature][0];
        let feature = (0..ranges.len()).max_by(|a, b| long(a).total_cmp(&long(b)))?;
        if of.len() <= MOST_PLACES || long(&feature) <= 0.0 {
            return None;
        }
        let mut sorted: Vec<f64> =
            of.iter().map(|&k| self.told[k as usize].features[feature]).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let at = sorted[sorted.len() / 2];
        // Where many places lie in one plane, the border is above it.
        let at = if at > sorted[0] { at } else { *sorted.iter().find(|&&x| x > at)? };
        Some((feature, at))
    }
}
