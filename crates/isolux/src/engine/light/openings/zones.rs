//! Parts of a scene, and the openings that light comes through to each: a decision tree by place and orientation.

use crate::engine::ray::SurfacePoint;

/// Places of a part at most, and at least on either side of a border that separates what rays had better do.
const PLACES: usize = 64;
const FEWEST: usize = 2;

/// Borders tried along every coordinate, and the share of the variance that is saved by one.
const BORDERS: usize = 32;
const WORTH: f64 = 0.02;

/// Coordinates of a place and of its normal.
const FEATURES: usize = 6;
const PLACE_ALONE: usize = 3;

/// An opening that light comes through to a part of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Through {
    pub(crate) opening: u32,
    /// How many rays go there for its projected solid angle.
    pub(crate) weight: f64,
}

/// A place, and the variance of a ray from there to all of the emitter, and of one to openings.
pub(crate) struct Told {
    features: [f64; FEATURES],
    variances: [f64; 2],
}

impl Told {
    pub(crate) fn new(at: &SurfacePoint, variances: [f64; 2]) -> Self {
        Self { features: features(at), variances }
    }
}

fn features(at: &SurfacePoint) -> [f64; FEATURES] {
    let (point, normal) = (at.point.to_vector(), at.geometric.to_vector());
    [point.x, point.y, point.z, normal.x, normal.y, normal.z]
}

/// A tree of halves, and the openings of a part.
enum Node {
    Halves { feature: usize, at: f64, second: u32 },
    Part(Vec<Through>),
}

/// Parts of a scene by the places that tell of them.
pub(crate) struct Zones(Vec<Node>);

/// Makes them.
struct Maker<'a> {
    told: &'a [Told],
    through: &'a dyn Fn(&[u32]) -> Vec<Through>,
    nodes: Vec<Node>,
}

impl Zones {
    /// No openings anywhere.
    pub(crate) fn none() -> Self {
        Self(vec![Node::Part(Vec::new())])
    }

    /// Parts of a few places each, divided where rays had better do something else; `through` says what light comes through to some
    /// places.
    pub(crate) fn of(told: &[Told], through: &dyn Fn(&[u32]) -> Vec<Through>) -> Self {
        let mut maker = Maker { told, through, nodes: Vec::new() };
        maker.add((0..told.len() as u32).collect());
        Self(maker.nodes)
    }

    /// What light comes through to a place.
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

    /// Whether light comes through openings to any part.
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

    /// The border that saves most variance where every side does what is best there.
    fn border(&self, of: &[u32]) -> Option<(usize, f64)> {
        let mut best = None;
        let mut most = 0.0_f64;
        for feature in 0..FEATURES {
            let [low, high] = self.range(of, feature);
            if high <= low {
                continue;
            }
            let scale = BORDERS as f64 / (high - low);
            let mut bins = [(0, [0.0; 2]); BORDERS];
            for &k in of {
                let Told { features, variances } = &self.told[k as usize];
                let bin =
                    &mut bins[(((features[feature] - low) * scale) as usize).min(BORDERS - 1)];
                bin.0 += 1;
                (0..2).for_each(|k| bin.1[k] += variances[k]);
            }
            let sum = |bins: &[(usize, [f64; 2])]| {
                bins.iter()
                    .fold((0, [0.0; 2]), |a, b| (a.0 + b.0, [a.1[0] + b.1[0], a.1[1] + b.1[1]]))
            };
            let least = |of: [f64; 2]| of[0].min(of[1]);
            let whole = least(sum(&bins).1);
            for k in 1..BORDERS {
                let (first, second) = (sum(&bins[..k]), sum(&bins[k..]));
                let saved = whole - least(first.1) - least(second.1);
                if first.0.min(second.0) >= FEWEST && saved > most.max(WORTH * whole) {
                    most = saved;
                    best = Some((feature, low + k as f64 / scale));
                }
            }
        }
        best
    }

    /// Halves of many places.
    fn middle(&self, of: &[u32]) -> Option<(usize, f64)> {
        let ranges = [0, 1, 2].map(|feature| self.range(of, feature));
        let long = |feature: &usize| ranges[*feature][1] - ranges[*feature][0];
        let feature = (0..PLACE_ALONE).max_by(|a, b| long(a).total_cmp(&long(b)))?;
        if of.len() <= PLACES || long(&feature) <= 0.0 {
            return None;
        }
        let mut sorted: Vec<f64> =
            of.iter().map(|&k| self.told[k as usize].features[feature]).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let at = sorted[sorted.len() / 2];
        // Where many lie in one plane, the border is above it.
        let at = if at > sorted[0] { at } else { *sorted.iter().find(|&&x| x > at)? };
        Some((feature, at))
    }
}
