//! The survey of a round: elements with their interpolation errors, and the goals of these errors.

use crate::elements::Elements;
use crate::engine::mesh::{LeafError, TrustLevels, WorstElements, trust};
use crate::engine::ray::Deadline;

/// The allowed interpolation error of indirect light, as a share of the accuracy goal.
const DISCRETIZATION_SHARE: f64 = 0.5;
/// The share of the area whose elements may stay coarse. Readers gather afresh there.
const FRESH_AREA_SHARE: f64 = 0.1;
/// The same share where refinement makes no progress.
const MOST_FRESH_AREA_SHARE: f64 = 0.5;
/// The allowed interpolation error of all elements, in accuracy goals. Rays read all of them, but as a mean over
/// many. Measured on CUBE: at 3 the bias at its edges takes half of the accuracy; at 1 a third more elements
/// bring nothing. This is for rooms whose reflected light is no more than the direct light. In others it is divided by
/// the ratio of the two: by 2 on CUBE, which reflects two thirds.
const BARE_ERROR_GOALS: f64 = 2.0;
/// The allowed interpolation error of elements that dim places see, in accuracy goals. Rays read it as a mean
/// over many elements, but it is reflected repeatedly.
const DIM_ERROR_GOALS: f64 = 3.0;
/// The share of the interpolation error that a fit leaves, below which light counts as smooth. The share is 0.4
/// to 0.55 in empty rooms, 0.8 and more in furnished ones.
const SMOOTH_LEFT_SHARE: f64 = 0.7;
/// The request to the pilot: accuracies and limits.
#[derive(Clone, Debug)]
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
    /// Whether increments gather at every vertex that carries light, and for the stored map where that is asked for.
    pub(crate) is_hybrid: bool,
    /// Whether elements are refined for caustics. Radiosity does not: it would shoot all of them.
    pub(crate) refines_caustics: bool,
    pub(crate) max_vertices: usize,
    /// The largest number of vertices for indirect light, if set by hand.
    pub(crate) most_for_indirect_light: Option<usize>,
    /// The shortest edge that is bisected, m, if set by hand.
    pub(crate) least_edge_m: Option<f64>,
    /// The end of the time for the first survey. Where it is short, fewer rays measure the light.
    pub(crate) deadline: Deadline,
    /// The end of the time for the whole pilot. What is not measured by then is left unknown.
    pub(crate) end: Deadline,
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
    /// The elements without objects close before them, worst first.
    pub(crate) worst: WorstElements,
    /// The share of the errors that a fit leaves.
    pub(crate) left_by_fit: f64,
    pub(crate) reference_lx: f64,
    /// The area of dim surfaces, m2.
    pub(crate) dim_m2: f64,
    /// The ratio of reflected to direct light in a closed room of these surfaces.
    pub(crate) reflected_again: f64,
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

    fn excess_of(&self, what: ReadFor, request: &PilotRequest) -> Option<f64> {
        let goal_lx = match what {
            // Fits do little for steep light at edges.
            ReadFor::All if request.is_fitted => {
                // Errors that have one sign are reflected as often as light is.
                let read = BARE_ERROR_GOALS * request.target / self.reflected_again.max(1.0);
                request.mesh_target.min(read) * self.reference_lx
            }
            ReadFor::FromDim => DIM_ERROR_GOALS * request.target * self.reference_lx,
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
        let limit = self.worst.limit(self.goal_lx(request.target, request), FRESH_AREA_SHARE);
        move |e| match what {
            ReadFor::All => true,
            ReadFor::FromDim => e.seen > 0.0,
            ReadFor::Trusted => !e.is_beset && e.error <= limit,
        }
    }

    /// The error of elements up to which readers trust the map, lx.
    pub(crate) fn trusted_up_to_lx(&self, request: &PilotRequest) -> f64 {
        let limit = self.worst.limit(self.goal_lx(request.target, request), MOST_FRESH_AREA_SHARE);
        limit.min(trust::above_all(&self.errors))
    }

    /// The levels of trust: the error up to which readers trust the map, and lower ones for maps with larger errors
    /// than expected.
    pub(crate) fn trusts(&self, request: &PilotRequest) -> TrustLevels {
        TrustLevels::of(&self.worst, self.trusted_up_to_lx(request))
    }

    /// Whether light is so smooth that a coarse first mesh is fine enough.
    pub(crate) fn is_smooth(&self) -> bool {
        self.left_by_fit < SMOOTH_LEFT_SHARE
    }

    /// The allowed interpolation error before the fit, lx.
    fn goal_lx(&self, target: f64, request: &PilotRequest) -> f64 {
        DISCRETIZATION_SHARE * target * self.reference_lx / self.left(request)
    }

    /// The share of the error of elements that the fit leaves.
    const fn left(&self, request: &PilotRequest) -> f64 {
        if request.is_fitted { self.left_by_fit } else { 1.0 }
    }

    /// The expected interpolation error where readers trust the map, as a share of all light.
    pub(crate) fn interpolation(&self, request: &PilotRequest) -> f64 {
        let limit = self.trusted_up_to_lx(request);
        let is_trusted = |e: &LeafError| !e.is_beset && e.error <= limit;
        let error_lx = trust::error_of(&self.errors, is_trusted) * self.left(request);
        if self.reference_lx > 0.0 { error_lx / self.reference_lx } else { 0.0 }
    }
}
