//! The survey of a round: elements with their interpolation errors, and the goals of these errors.

use crate::ablation::without;
use crate::elements::{Elements, Subdivision};
use crate::engine::mesh::{EdgeFalloffs, LeafError, TrustLevels, WorstElements, trust};

/// The allowed interpolation error of indirect light, as a share of the accuracy goal.
const DISCRETIZATION_SHARE: f64 = 0.5;
/// The share of the area whose elements may stay coarse. Readers gather afresh there.
const FRESH_SHARE: f64 = 0.1;
/// The same share where refinement makes no progress.
const MOST_FRESH: f64 = 0.5;
/// The allowed interpolation error of all elements, in accuracy goals. Rays read all of them, but as a mean over
/// many. Measured on CUBE: at 3 the bias at its edges takes half of the accuracy; at 1 a third more elements
/// bring nothing.
const BARE: f64 = 2.0;
/// The same error where increments measure means of elements, or light is resolved towards walls.
const BARE_WITH_MEANS: f64 = 6.0;
/// The allowed interpolation error of elements that dim places see, in accuracy goals. Rays read it as a mean
/// over many elements, but it is reflected repeatedly.
const SEEN_FROM_DIM: f64 = 3.0;
/// The mean error of elements with objects close before them from which increments measure means of elements, in
/// accuracy goals. It is high among furniture, where the errors of shadows and hollows balance.
const MEANS_FROM: f64 = 0.5;
/// The same mean error where light is smooth, as in empty rooms.
const MEANS_FROM_IF_SMOOTH: f64 = 0.15;

/// The share of the interpolation error that a fit leaves, below which light counts as smooth. The share is 0.4
/// to 0.55 in empty rooms, 0.8 and more in furnished ones.
const SMOOTH: f64 = 0.7;
/// The error of quadratic functions on smooth light, as a share of that of linear ones.
const LEFT_BY_SMOOTHING: f64 = 0.5;
/// The largest number of vertices of such a mesh where direct light has noise. Each takes up to half a millisecond
/// then for its direct light alone.
const MOST_SMOOTHED_IF_NOISY: usize = 12_000;

/// The error of functions that fall off towards walls, as a share of that of linear ones. Measured along the edges
/// of CUBE, on top of the share left elsewhere.
const LEFT_AT_WALLS: f64 = 0.5;

/// The request to the pilot: accuracies and limits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PilotRequest {
    /// The relative accuracy that the elements are made for.
    pub(crate) target: f64,
    /// The accuracy goal of the run, even if elements have to be made for a finer one.
    pub(crate) goal: f64,
    /// The relative accuracy goal of the stored (interpolated) map.
    pub(crate) mesh_target: f64,
    pub(crate) seed: u64,
    /// Whether the map will be fitted to the light over elements.
    pub(crate) is_fitted: bool,
    /// Whether increments measure means of elements, gather for the stored map and interpolate over smooth walls.
    pub(crate) has_means: bool,
    /// Whether elements are refined for caustics. Radiosity does not: it would shoot all of them.
    pub(crate) refines_caustics: bool,
    pub(crate) max_vertices: usize,
    /// The largest number of vertices for indirect light, if set by hand.
    pub(crate) most_for_indirect_light: Option<usize>,
    /// The shortest edge that is bisected, m, if set by hand.
    pub(crate) least_edge_m: Option<f64>,
}

/// The weights of errors, by the light of their surroundings.
#[derive(Debug, Default)]
pub(crate) struct Surroundings {
    /// The weights of errors by vertex so far: at the place itself, for dim places that see it, and at the place
    /// itself if it lies in a room.
    pub(crate) weights: Vec<[f64; 3]>,
    /// The area of dim surfaces, m2.
    pub(crate) dim_m2: f64,
}

/// The survey of a round of the pilot.
pub(crate) struct Survey {
    pub(crate) elements: Elements,
    /// The number of vertices that carry indirect light.
    pub(crate) carriers: usize,
    pub(crate) errors: Vec<LeafError>,
    /// The places where surfaces end at walls, if light is smooth.
    pub(crate) walls: EdgeFalloffs,
    /// The elements without objects close before them, worst first.
    pub(crate) worst: WorstElements,
    /// The share of the errors that a fit leaves.
    pub(crate) left_by_fit: f64,
    pub(crate) reference_lx: f64,
    /// The area of dim surfaces, m2.
    pub(crate) dim_m2: f64,
    /// Whether direct light at a vertex has noise, and so costs much.
    pub(crate) is_noisy: bool,
}

/// The kind of reading that elements serve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ReadFor {
    /// Readers that interpolate.
    Trusted,
    /// Rays, and viewers of the stored map.
    All,
    /// Rays from dim places; errors are weighted by the light at these.
    FromDim,
}

impl ReadFor {
    /// All kinds for gathered maps, in the order in which elements are refined for them.
    pub(crate) const EVERY: [Self; 3] = [Self::FromDim, Self::Trusted, Self::All];
}

impl Survey {
    /// The elements for one kind of reading and the ratio of their error to its goal; `None` up to a ratio of one.
    pub(crate) fn excess(
        &self,
        what: ReadFor,
        request: &PilotRequest,
    ) -> Option<(Vec<LeafError>, f64)> {
        let excess = self.excess_of(what, request)?;
        let is_read = self.is_read(what, request);
        let counted = |e: &LeafError| if what == ReadFor::FromDim { e.seen_from_dim() } else { *e };
        Some((self.errors.iter().filter(|e| is_read(e)).map(counted).collect(), excess))
    }

    /// The largest ratio of error to goal over all kinds of reading, at least one.
    pub(crate) fn greatest_excess(&self, request: &PilotRequest) -> f64 {
        ReadFor::EVERY
            .into_iter()
            .filter_map(|what| self.excess_of(what, request))
            .fold(1.0, f64::max)
    }

    /// Finds how often elements are to be halved towards walls, and reduces their errors accordingly.
    pub(crate) fn resolve(
        &mut self,
        mut walls: EdgeFalloffs,
        subdivision: &Subdivision,
        values: &[Option<f64>],
        accuracy_lx: f64,
    ) {
        let corners = |e: &LeafError| subdivision.node(e.node).0.vertices;
        let (mut area_m2, mut squared, mut touching) = (0.0, 0.0, 0);
        for error in &self.errors {
            let corners = corners(error);
            let drop_lx = walls.drop_lx(corners, values);
            area_m2 += error.area_m2;
            squared += error.area_m2 * drop_lx * drop_lx;
            touching += usize::from(corners.iter().any(|&v| walls.is_on(v)));
        }
        walls.halve_for((squared / area_m2).sqrt(), touching, accuracy_lx);
        self.walls = walls;
        if !self.walls.are_resolved() {
            return;
        }
        for error in &mut self.errors {
            let corners = corners(error);
            let is_known = corners.iter().all(|&v| values[v as usize].is_some());
            let middle = subdivision.triangle(error.node).centroid();
            let edge_m = subdivision.longest_edge_m(error.node);
            if is_known && self.walls.stand_close(corners[0], middle, edge_m) {
                error.is_at_wall = error.is_beset;
                error.error *= LEFT_AT_WALLS;
                error.excess *= LEFT_AT_WALLS;
            }
        }
    }

    /// The number of the strip before a wall, by vertex, where light is resolved towards walls.
    pub(crate) fn strips(&self) -> Vec<u8> {
        let close = self.errors.iter().filter(|e| e.is_at_wall).map(|e| e.node);
        self.walls.strips(&self.elements, close)
    }

    fn excess_of(&self, what: ReadFor, request: &PilotRequest) -> Option<f64> {
        let goal_lx = match what {
            // Fits do little for steep light at edges.
            ReadFor::All if request.is_fitted => {
                let is_right_in_the_mean =
                    self.asks_for_means(request) || self.walls.are_resolved();
                let bare = if is_right_in_the_mean { BARE_WITH_MEANS } else { BARE };
                request.mesh_target.min(bare * request.target) * self.reference_lx
            }
            ReadFor::FromDim => SEEN_FROM_DIM * request.target * self.reference_lx,
            _ => self.goal_lx(request.target, request),
        };
        let error_lx = match what {
            ReadFor::FromDim => self.error_seen_from_dim(),
            _ => trust::error_of(&self.errors, self.is_read(what, request)),
        };
        let excess = error_lx / goal_lx;
        (excess > 1.0 && self.reference_lx > 0.0).then_some(excess)
    }

    /// The error of elements as dim places see it, root mean square over the dim surfaces, lx.
    fn error_seen_from_dim(&self) -> f64 {
        let squared: f64 = self.errors.iter().map(|e| e.seen_from_dim().squared()).sum();
        if squared > 0.0 { (squared / self.dim_m2).sqrt() } else { 0.0 }
    }

    fn is_read(
        &self,
        what: ReadFor,
        request: &PilotRequest,
    ) -> impl Fn(&LeafError) -> bool + use<> {
        let limit = self.worst.limit(self.goal_lx(request.target, request), FRESH_SHARE);
        move |e| match what {
            ReadFor::All => true,
            ReadFor::FromDim => e.seen > 0.0,
            ReadFor::Trusted => e.is_at_wall || !e.is_beset && e.error <= limit,
        }
    }

    /// The error of elements up to which readers trust the map, lx.
    pub(crate) fn trusted_up_to_lx(&self, request: &PilotRequest) -> f64 {
        let limit = self.worst.limit(self.goal_lx(request.target, request), MOST_FRESH);
        limit.min(trust::above_all(&self.errors))
    }

    /// The levels of trust: the error up to which readers trust the map, and lower ones for maps with larger errors
    /// than expected.
    pub(crate) fn trusts(&self, request: &PilotRequest) -> TrustLevels {
        TrustLevels::of(&self.worst, self.trusted_up_to_lx(request))
    }

    /// Whether the mean error of elements with objects close before them is too large, so that their means are to be
    /// measured.
    pub(crate) fn asks_for_means(&self, request: &PilotRequest) -> bool {
        if without("element-means") {
            return false;
        }
        let area_m2: f64 = self.errors.iter().map(|e| e.area_m2).sum();
        let beset = self.errors.iter().filter(|e| e.is_beset && !e.is_at_wall);
        let lacking: f64 = beset.map(|e| e.area_m2 * e.excess).sum();
        let from = if self.left_by_fit < SMOOTH { MEANS_FROM_IF_SMOOTH } else { MEANS_FROM };
        request.has_means && lacking.abs() > from * request.target * area_m2 * self.reference_lx
    }

    /// Whether light is so smooth that quadratic functions over its vertices err less than linear ones.
    pub(crate) fn is_smooth(&self, request: &PilotRequest) -> bool {
        // There are twice as many elements as vertices, and each vertex becomes four.
        let most = if self.is_noisy { MOST_SMOOTHED_IF_NOISY } else { usize::MAX };
        let has_room = 2 * self.errors.len() <= request.max_vertices.min(most);
        request.has_means && self.left_by_fit < SMOOTH && has_room && !without("smoothing")
    }

    /// The number of elements with objects close before them other than walls towards which light is resolved.
    pub(crate) fn beset(&self) -> f64 {
        self.errors.iter().filter(|e| e.is_beset && !e.is_at_wall).count() as f64
    }

    /// The growth factor of the number of vertices, if all other elements are bisected twice and those at walls as
    /// often as planned.
    pub(crate) fn smoothed(&self) -> f64 {
        let free = 1.0 - self.beset() / self.errors.len().max(1) as f64;
        // There are twice as many elements as vertices.
        1.0 + 3.0 * free + 2.0 * self.walls.more_vertices() / self.errors.len().max(1) as f64
    }

    /// The allowed interpolation error before the fit, lx.
    fn goal_lx(&self, target: f64, request: &PilotRequest) -> f64 {
        DISCRETIZATION_SHARE * target * self.reference_lx / self.left(request)
    }

    /// The share of the error of elements that the fit and quadratic functions leave.
    fn left(&self, request: &PilotRequest) -> f64 {
        let fitted = if request.is_fitted { self.left_by_fit } else { 1.0 };
        let smoothed = if self.is_smooth(request) { LEFT_BY_SMOOTHING } else { 1.0 };
        fitted * smoothed
    }

    /// The expected interpolation error where readers trust the map, as a share of all light.
    pub(crate) fn interpolation(&self, request: &PilotRequest) -> f64 {
        let limit = self.trusted_up_to_lx(request);
        let is_trusted = |e: &LeafError| e.is_at_wall || !e.is_beset && e.error <= limit;
        let error_lx = trust::error_of(&self.errors, is_trusted) * self.left(request);
        if self.reference_lx > 0.0 { error_lx / self.reference_lx } else { 0.0 }
    }
}
