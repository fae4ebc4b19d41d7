//! What a round of the pilot sees, and whether that is good enough.

use crate::ablation::without;
use crate::elements::{Elements, Subdivision};
use crate::engine::mesh::{EdgeFalloffs, LeafError, TrustLevels, WorstElements, trust};

/// The part of the accuracy asked for that interpolating indirect light may take.
const DISCRETIZATION_SHARE: f64 = 0.5;
/// The part of the area whose elements may stay coarse, as readers gather afresh there; and what it
/// may be where refinement comes to nothing.
const FRESH_SHARE: f64 = 0.1;
const MOST_FRESH: f64 = 0.5;
/// What all elements may err by, in accuracies asked for: rays read them all, but in the mean over many. Measured
/// on CUBE: at 3 the bias at its edges takes half of the accuracy, at 1 a third more elements bring nothing.
const BARE: f64 = 2.0;
/// The same where their means are measured, or light is resolved towards walls.
const BARE_WITH_MEANS: f64 = 6.0;
/// What elements may err by that dim places see, in accuracies asked for: it is read in the mean over many, but reflected again and again.
const SEEN_FROM_DIM: f64 = 3.0;
/// Means are measured where what beset elements lack in the mean over the surface is more than this, in accuracies
/// asked for: soon in empty rooms, late among furniture, whose shadows and hollows balance.
const MEANS_FROM: f64 = 0.5;
const MEANS_FROM_IF_SMOOTH: f64 = 0.15;

/// Light of which a fit leaves less than this is smooth: empty rooms leave 0.4 to 0.55 of the error of interpolation, furnished
/// ones 0.8 and more.
const SMOOTH: f64 = 0.7;
/// What quadratic functions leave of the error of linear ones there.
const LEFT_BY_SMOOTHING: f64 = 0.5;
/// Vertices made so at most where direct light has noise: each then takes up to half a millisecond for its direct light alone.
const MOST_SMOOTHED_IF_NOISY: usize = 12_000;

/// What functions that fall off towards walls leave of the error of linear ones, along the edges of CUBE, beside what is left elsewhere.
const LEFT_AT_WALLS: f64 = 0.5;

/// What is asked of the pilot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PilotRequest {
    pub(crate) target: f64,
    /// Accuracy asked for, however much finer elements have to become.
    pub(crate) goal: f64,
    pub(crate) mesh_target: f64,
    pub(crate) seed: u64,
    /// Whether the map will be fitted to the light over elements.
    pub(crate) is_fitted: bool,
    /// Whether increments measure means of elements and gather for the bare map, and smooth walls are interpolated for them.
    pub(crate) has_means: bool,
    /// Whether elements become finer for caustics: radiosity would shoot all of them.
    pub(crate) refines_caustics: bool,
    pub(crate) max_vertices: usize,
    /// Set by hand: vertices for indirect light at most, and the shortest edge, m.
    pub(crate) most_for_indirect_light: Option<usize>,
    pub(crate) least_edge_m: Option<f64>,
}

/// What errors count by.
#[derive(Debug, Default)]
pub(crate) struct Surroundings {
    /// How much they count at the vertices so far: there, for who sees them from where it is dim, and there if that is a room.
    pub(crate) weights: Vec<[f64; 3]>,
    /// Surface where it is dim, m2.
    pub(crate) dim_m2: f64,
}

/// What a round of the pilot sees.
pub(crate) struct Survey {
    pub(crate) elements: Elements,
    /// That carry indirect light.
    pub(crate) carriers: usize,
    pub(crate) errors: Vec<LeafError>,
    /// Where surfaces end before walls, if light is smooth.
    pub(crate) walls: EdgeFalloffs,
    /// Those that are not beset, worst first.
    pub(crate) worst: WorstElements,
    /// Share of them that a fit leaves.
    pub(crate) left_by_fit: f64,
    pub(crate) reference_lx: f64,
    /// Surface where it is dim, m2.
    pub(crate) dim_m2: f64,
    /// Whether direct light at a vertex has noise, and so costs much.
    pub(crate) is_noisy: bool,
}

/// What elements are read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ReadFor {
    /// By readers that interpolate.
    Trusted,
    /// By rays, and with the bare map.
    All,
    /// By rays from dim places, for which errors count by the light there.
    FromDim,
}

impl ReadFor {
    /// By whom gathered maps are read, in the order in which elements are refined for them.
    pub(crate) const EVERY: [Self; 3] = [Self::FromDim, Self::Trusted, Self::All];
}

impl Survey {
    /// The elements that are read so, if their error is more than it should be, and how many times it is.
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

    /// The most by which errors exceed what they should be, if they do, for whatever elements are read.
    pub(crate) fn greatest_excess(&self, request: &PilotRequest) -> f64 {
        ReadFor::EVERY
            .into_iter()
            .filter_map(|what| self.excess_of(what, request))
            .fold(1.0, f64::max)
    }

    /// Finds how often elements are to be halved towards walls, and what that leaves of their errors.
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

    /// In which strip before a wall vertices lie, where light is resolved towards them.
    pub(crate) fn strips(&self) -> Vec<u8> {
        let close = self.errors.iter().filter(|e| e.is_at_wall).map(|e| e.node);
        self.walls.strips(&self.elements, close)
    }

    fn excess_of(&self, what: ReadFor, request: &PilotRequest) -> Option<f64> {
        let goal_lx = match what {
            // Fits do little for what is steep at edges.
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

    /// What elements err by as dim places see them, root mean square over the surface of these, lx.
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

    /// The error of elements up to which readers trust the map.
    pub(crate) fn trusted_up_to_lx(&self, request: &PilotRequest) -> f64 {
        let limit = self.worst.limit(self.goal_lx(request.target, request), MOST_FRESH);
        limit.min(trust::above_all(&self.errors))
    }

    /// The same, and less, for where more than expected is found.
    pub(crate) fn trusts(&self, request: &PilotRequest) -> TrustLevels {
        TrustLevels::of(&self.worst, self.trusted_up_to_lx(request))
    }

    /// Whether rays read too much wrongly in the mean of beset elements, unless that is measured.
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

    /// Whether light is so smooth that quadratic functions over its vertices are nearer than linear ones.
    pub(crate) fn is_smooth(&self, request: &PilotRequest) -> bool {
        // Twice as many elements as vertices, four of each.
        let most = if self.is_noisy { MOST_SMOOTHED_IF_NOISY } else { usize::MAX };
        let has_room = 2 * self.errors.len() <= request.max_vertices.min(most);
        request.has_means && self.left_by_fit < SMOOTH && has_room && !without("smoothing")
    }

    /// How many elements are beset by something else than walls that light is resolved towards.
    pub(crate) fn beset(&self) -> f64 {
        self.errors.iter().filter(|e| e.is_beset && !e.is_at_wall).count() as f64
    }

    /// Into how many vertices each is made by bisecting the others twice, and those at walls as often as they are to be.
    pub(crate) fn smoothed(&self) -> f64 {
        let free = 1.0 - self.beset() / self.errors.len().max(1) as f64;
        // Twice as many elements as vertices.
        1.0 + 3.0 * free + 2.0 * self.walls.more_vertices() / self.errors.len().max(1) as f64
    }

    /// What interpolation may err by, before it is fitted, lx.
    fn goal_lx(&self, target: f64, request: &PilotRequest) -> f64 {
        DISCRETIZATION_SHARE * target * self.reference_lx / self.left(request)
    }

    /// What fit and quadratic functions leave of the error of elements.
    fn left(&self, request: &PilotRequest) -> f64 {
        let fitted = if request.is_fitted { self.left_by_fit } else { 1.0 };
        let smoothed = if self.is_smooth(request) { LEFT_BY_SMOOTHING } else { 1.0 };
        fitted * smoothed
    }

    /// What interpolation is expected to err by where readers trust it, of all light.
    pub(crate) fn interpolation(&self, request: &PilotRequest) -> f64 {
        let limit = self.trusted_up_to_lx(request);
        let is_trusted = |e: &LeafError| e.is_at_wall || !e.is_beset && e.error <= limit;
        let error_lx = trust::error_of(&self.errors, is_trusted) * self.left(request);
        if self.reference_lx > 0.0 { error_lx / self.reference_lx } else { 0.0 }
    }
}
