//! `radiosity`: progressive refinement with form factors.
//!
//! The patch with the most unshot flux sends it to all receivers, and so on until little is left (Cohen,
//! Chen, Wallace, Greenberg 1988), on the elements of the pilot. At its first shot a patch sends the light
//! that the pilot expects it to have in the end (overshooting: Feda, Purgathofer 1992, "Accelerating
//! radiosity by overshooting"), and later the difference. With `X` the light that vertices have shot, `D`
//! direct light and `R` received light, `R = A X` holds after every shot, and `D + R - X` is unshot. Where it
//! is zero, the map is the solution.
//!
//! There are no replicates. Two rays measure the visibility of each source; their spread is the noise of a
//! receiver. Check points measure the error of the map: light is gathered there over the map by rays
//! independent of form factors.

mod form_factor;
mod light;
mod limits;
mod receive;
mod settings;
mod sources;
mod specular;

pub use settings::{RadiosityLimits, RadiositySettings};

use super::caustics::{self, Caustics};
use crate::engine::gather::{Gatherer, Gathering, Operator};
use crate::engine::judge::{Check, InterpolationErrors, check_points};
use crate::engine::light::Chain;
use crate::engine::plan::Plan;
use crate::engine::ray::{
    Accumulator, Deadline, Dice, Effort, Estimate, Noise, Sample, SurfacePoint, mean_and_variance,
};
use crate::sampling::{Key, Sequence};
use crate::units::Rgb;
use light::Light;
use limits::Limits;
use rayon::prelude::*;
use receive::{Received, Shot};
use sources::{Face, Kind, Sources, corner_values, corner_values_in_gap};
use specular::Specular;

/// The number of independent gatherings at a check point.
const CHECKINGS: u64 = 8;
/// The number of independent measurements of noisy direct light and of caustics.
const REPLICATES: u64 = 8;
/// The number of rays of a receiver over specular surfaces in each of two halves, for an accuracy of one per
/// cent.
const SPECULAR_RAYS_AT_ONE_PERCENT: f64 = 64.0;
/// The number of shadow rays to every emitting surface from a place of an element.
const SAMPLES_OF_ELEMENT: usize = 4;
/// The places of an element for its mean direct light: a quadrature that is exact for quadratic functions.
const PLACES: [[f64; 3]; 3] = [
    [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0],
    [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
    [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
];

/// The share of absorbed light below which the amount of light has no known bound.
const LEAST_ABSORBED: f64 = 1e-6;

/// The standard error of the ambient term at a place, as a share of it. Its 95 % interval reaches from no
/// light, as in gaps and outside, to twice as much.
const DOUBT_OF_AMBIENT: f64 = 1.0 / 1.96;

/// The method, ready for shots. The results are kept in sums of its run. A vertex has the received light in
/// place of direct light, the shot light in place of caustics, the light sent over specular surfaces in place
/// of indirect light, and the variance. A patch has the number of its shots.
pub(crate) struct Radiosity<'p, 's> {
    plan: &'p Plan<'s>,
    sources: Sources,
    chains: Vec<Chain>,
    specular: Option<Specular>,
    limits: Limits,
    stop_unshot: f64,
    ambient: bool,
    light: KnownLight,
    whole: Whole,
    checks: Checks,
    /// The effort before the first shot.
    before: Effort,
    key: Key,
}

/// Properties of the scene as a whole.
struct Whole {
    /// The flux to be shot in all, lm.
    flux_lm: f64,
    area_m2: f64,
    /// The root mean square of the light, as far as it is known before the first shot, lx.
    reference_lx: f64,
    /// The mean diffuse reflectance.
    reflectance: Rgb,
}

/// Light that is known before the first shot.
struct KnownLight {
    /// Direct light at the vertices, lx, and its variance.
    direct: Vec<Rgb>,
    direct_variance: Vec<f64>,
    caustic: Vec<Rgb>,
    caustic_variance: Vec<f64>,
    /// The light that vertices are expected to have in the end, beside direct light, lx.
    expected: Vec<Rgb>,
    /// By source, the exitance from direct light less the interpolated exitance, mean, lm/m2.
    corrections: Vec<Rgb>,
}

/// The gathering at the check points.
struct Checks {
    operators: Vec<Operator>,
    direct: Vec<Rgb>,
}

/// The place of received light in the sums.
const RECEIVED: usize = 0;
/// The place of shot light in the sums.
const SHOT: usize = 3;
/// The place of light sent over specular surfaces in the sums.
const SENT: usize = 6;

impl<'p, 's> Radiosity<'p, 's> {
    /// The method with everything that shots share.
    pub(crate) fn new(
        plan: &'p Plan<'s>,
        points: &[Check],
        settings: &RadiositySettings,
        accuracy: f64,
        seed: u64,
    ) -> Self {
        let key = Key::new(seed).with(7);
        let asked = settings.limits(accuracy);
        let lighting = plan.lighting;
        let level = if lighting.are_read_at_ends() { u32::MAX } else { plan.mesh.level };
        let sources = Sources::new(plan, level);
        let (chains, leaves_some_out) = lighting.chains();
        let is_specular = leaves_some_out || lighting.leaves_caustics();
        let rays = SPECULAR_RAYS_AT_ONE_PERCENT * 0.01 / accuracy;
        let rays = (rays.clamp(16.0, 512.0) as u32).next_power_of_two();
        let specular = is_specular.then(|| Specular::new(plan, level, &chains, rays, key.with(1)));
        let (direct, direct_variance) = direct(plan, key.with(2));
        let ReplicatedCaustics { lx: caustic, variance: caustic_variance, effort } =
            caustic(plan, accuracy, key.with(3));
        let checks = Checks::new(plan, points, (asked.check_rays, accuracy), &direct, key.with(4));
        let reference_lx = plan.light.reference_lx.max(root_mean_square(plan, &direct, &caustic));
        let given_up = checks.operators.iter().map(Operator::given_up).sum::<f64>()
            / CHECKINGS as f64
            + specular.as_ref().map_or(0.0, |s| s.given_up);
        let mut engine = Self {
            limits: Limits {
                tolerance_lx: asked.form_factor_tolerance * reference_lx,
                noise_lx: asked.visibility_tolerance * reference_lx,
                most_lx: asked.largest_link * reference_lx,
            },
            stop_unshot: asked.unshot,
            ambient: settings.ambient,
            light: KnownLight {
                direct,
                direct_variance,
                caustic,
                caustic_variance,
                expected: plan.prolongate(&plan.mesh.fit.apply(&plan.light.guess)),
                corrections: Vec::new(),
            },
            whole: Whole {
                flux_lm: 0.0,
                area_m2: plan.area_m2(),
                reference_lx,
                reflectance: Rgb::BLACK,
            },
            before: Effort {
                rays: effort.rays
                    + checks.operators.iter().map(|o| o.rays).sum::<u64>()
                    + specular.as_ref().map_or(0, |s| s.rays),
                given_up_lx: effort.given_up_lx + given_up * reference_lx,
            },
            plan,
            sources,
            chains,
            specular,
            checks,
            key,
        };
        engine.light.corrections = engine.corrections();
        engine.whole.reflectance = engine.mean_reflectance();
        let nothing = Accumulator::new(engine.light.direct.len(), reference_lx);
        let none_shot = Accumulator::new(engine.sources.patches.len(), reference_lx);
        engine.whole.flux_lm = engine.fluxes(&nothing, &none_shot).iter().map(|f| f.size_lm).sum();
        engine
    }

    /// The number of patches.
    pub(crate) fn patches(&self) -> usize {
        self.sources.patches.len()
    }

    /// The illuminance that sums are relative to, lx.
    pub(crate) fn reference_lx(&self) -> f64 {
        self.whole.reference_lx
    }

    /// The mean light of rays and particles that were given up, lx.
    pub(crate) fn given_up_lx(&self) -> f64 {
        self.before.given_up_lx
    }

    /// By source, the mean exitance from direct light over the element less that of its vertices, where
    /// direct light is evaluated and not read from a finer mesh.
    fn corrections(&self) -> Vec<Rgb> {
        let Plan { scene, lighting, .. } = self.plan;
        let elements = &self.plan.mesh.elements;
        if lighting.are_read_at_ends() {
            return vec![Rgb::BLACK; self.sources.nodes.len()];
        }
        let key = self.key.with(5);
        let of = |(node, source): (usize, &sources::Source)| {
            let (Kind::Face(face), None) = (&source.kind, source.children) else {
                return Rgb::BLACK;
            };
            let Some(finish) = scene.material(face.triangle).finish(face.back) else {
                return Rgb::BLACK;
            };
            let mut dice = Dice::new(Sequence::new(key.with(node as u64)), 0);
            let mut at = |weights: [f64; 3]| {
                let place = sources::place_of(elements, face, weights);
                let [u, v] = scene.triangle(face.triangle).barycentric(place);
                let at = SurfacePoint::new(scene, face.triangle, face.back, u, v);
                let light = lighting.sampled(&at, SAMPLES_OF_ELEMENT, &mut dice);
                light * scene.diffuse_reflectance(finish, face.triangle, u, v)
            };
            let evaluated = PLACES.map(&mut at).into_iter().sum::<Rgb>() / PLACES.len() as f64;
            let value = |v: u32| self.light.direct[v as usize];
            let corners = corner_values(self.plan, face.vertices, value);
            evaluated - corners.into_iter().sum::<Rgb>() / 3.0 * face.reflectance
        };
        self.sources.nodes.par_iter().enumerate().map(of).collect()
    }

    fn mean_reflectance(&self) -> Rgb {
        let faces = self.sources.nodes.iter().filter(|s| s.children.is_none());
        let reflected = faces.map(|source| match &source.kind {
            Kind::Face(face) => face.reflectance * source.area_m2,
            Kind::Cluster => Rgb::BLACK,
        });
        reflected.sum::<Rgb>() / self.whole.area_m2
    }

    /// The light that a vertex has not shot; before its first shot, the light it is expected to have in the
    /// end.
    fn unshot(&self, sums: &Accumulator, is_first: bool, vertex: u32) -> Rgb {
        let k = vertex as usize;
        let own = self.light.direct[k] + self.light.caustic[k];
        if is_first {
            own + self.light.expected[k]
        } else {
            own + sums.part(k, RECEIVED) - sums.part(k, SHOT)
        }
    }

    /// The unshot exitance at the corners of an element.
    fn corners(
        &self,
        sums: &Accumulator,
        is_first: bool,
        (node, face): (u32, &Face),
        in_gap: bool,
    ) -> [Rgb; 3] {
        let value = |vertex: u32| self.unshot(sums, is_first, vertex);
        let correction = if is_first { self.light.corrections[node as usize] } else { Rgb::BLACK };
        let corners = if in_gap {
            corner_values_in_gap(self.plan, face.vertices, value)
        } else {
            corner_values(self.plan, face.vertices, value)
        };
        corners.map(|e| e * face.reflectance + correction)
    }

    fn light(&self, sums: &Accumulator, is_first: bool, patch: usize) -> Vec<Light> {
        self.sources.light(patch, |node, face| self.corners(sums, is_first, (node, face), false))
    }

    /// The unshot flux of every patch.
    fn fluxes(&self, sums: &Accumulator, patches: &Accumulator) -> Vec<Flux> {
        let of = |patch: usize| {
            let is_first = patches.count_at(patch) == 0;
            let root = self.light(sums, is_first, patch)[0];
            let m2 = self.sources.nodes[self.sources.patches[patch].start as usize].area_m2;
            Flux { is_first, sum_lm: root.mean * m2, size_lm: root.size * m2 }
        };
        (0..self.patches()).into_par_iter().map(of).collect()
    }

    /// The light that is left to shoot.
    pub(crate) fn left(&self, sums: &Accumulator, patches: &Accumulator) -> Left {
        let fluxes = self.fluxes(sums, patches);
        let unsent_lm = self.specular.as_ref().map_or(0.0, |s| self.unsent_lm(s, sums));
        let unshot_lm = unsent_lm + fluxes.iter().map(|f| f.size_lm).sum::<f64>();
        let whole = &self.whole;
        let share = if whole.flux_lm > 0.0 { (unshot_lm / whole.flux_lm).min(1.0) } else { 0.0 };
        let (ambient_lx, doubt_lx) = self.ambient(&fluxes);
        let all_have_shot = fluxes.iter().all(|f| !f.is_first || f.size_lm == 0.0);
        let is_shot = all_have_shot && share <= self.stop_unshot;
        let absorbed = 1.0 - whole.reflectance.luminance();
        // Expected light contains all further reflections; for other light they are a geometric series.
        let series = if all_have_shot { 1.0 / absorbed } else { 1.0 };
        let most_lm = whole.reference_lx * whole.area_m2;
        let is_bounded =
            absorbed > LEAST_ABSORBED && unshot_lm * series <= most_lm.max(whole.flux_lm);
        Left { is_bounded, fluxes, unsent_lm, share, ambient_lx, doubt_lx, all_have_shot, is_shot }
    }

    /// The expected number of increments until shooting can stop, if unshot light decreases at the same rate.
    pub(crate) fn shots_needed(&self, count: u64, left: &Left) -> Option<f64> {
        let count = count as f64;
        if left.is_shot {
            return Some(count);
        }
        (left.share < 1.0 && self.stop_unshot > 0.0)
            .then(|| count * (libm::log(self.stop_unshot) / libm::log(left.share)).max(1.0))
    }

    /// The ambient term in place of unshot light, the same everywhere, and its standard error at a place, lx.
    /// Where too much was shot the term would be negative: it is zero, and the negative part is added to the
    /// error.
    fn ambient(&self, fluxes: &[Flux]) -> (Rgb, f64) {
        if !self.ambient || self.whole.area_m2 <= 0.0 {
            return (Rgb::BLACK, 0.0);
        }
        // Expected light contains all further reflections.
        let once: Rgb = fluxes.iter().filter(|f| f.is_first).map(|f| f.sum_lm).sum();
        let again: Rgb = fluxes.iter().filter(|f| !f.is_first).map(|f| f.sum_lm).sum();
        let series = self.whole.reflectance.map(|rho| 1.0 / (1.0 - rho.min(0.99)));
        let again = if once.is_black() { again * series } else { Rgb::BLACK };
        let mean_lx = (once + again) / self.whole.area_m2;
        let ambient_lx = mean_lx.greater(Rgb::BLACK);
        let left_out_lx = (ambient_lx - mean_lx).luminance();
        (ambient_lx, libm::hypot(DOUBT_OF_AMBIENT * ambient_lx.luminance(), left_out_lx))
    }

    /// One shot and its effort; `None` if the deadline passes before it is done.
    pub(crate) fn shoot(
        &self,
        sums: &mut Accumulator,
        patches: &mut Accumulator,
        left: &Left,
        deadline: &Deadline,
    ) -> Option<Effort> {
        let index = sums.increments;
        let Left { fluxes, unsent_lm, .. } = left;
        let most = (0..fluxes.len())
            .max_by(|&a, &b| fluxes[a].size_lm.total_cmp(&fluxes[b].size_lm).then(b.cmp(&a)));
        let rays = match (most, &self.specular) {
            (most, Some(specular))
                if most.is_none_or(|patch| *unsent_lm > fluxes[patch].size_lm) =>
            {
                self.send_over_specular(specular, sums)
            }
            (Some(patch), _) => self.shoot_patch(patch, index, (sums, patches), deadline)?,
            (None, _) => 0,
        };
        sums.increments += 1;
        patches.increments += 1;
        let rays = rays + if index == 0 { self.before.rays } else { 0 };
        Some(Effort { rays, given_up_lx: self.before.given_up_lx })
    }

    fn shoot_patch(
        &self,
        patch: usize,
        index: u64,
        (sums, patches): (&mut Accumulator, &mut Accumulator),
        deadline: &Deadline,
    ) -> Option<u64> {
        let is_first = patches.count_at(patch) == 0;
        let light = self.light(sums, is_first, patch);
        let before: &Accumulator = sums;
        let shot = Shot {
            sources: &self.sources,
            lighting: self.plan.lighting,
            chains: &self.chains,
            patch,
            light: &light,
            sums_lm: &self.sources.sums_lm(patch, &light),
            corners: &|node, face, in_gap| self.corners(before, is_first, (node, face), in_gap),
            limits: self.limits,
        };
        let key = self.key.with(6).with(index);
        let receivers = &self.plan.mesh.gatherers[..self.plan.mesh.indirect_vertices];
        let receive = |(k, gatherer): (usize, &Gatherer)| {
            let carries = self.plan.mesh.carriers.is_active(k as u32);
            let of = self.plan.mesh.standings[k].filter(|_| carries);
            if deadline.has_passed() {
                return None;
            }
            Some(of.map_or_else(Received::default, |of| {
                let gatherer = gatherer.in_gap(of != crate::map::Standing::Open);
                shot.receive(&gatherer, key.with(k as u64))
            }))
        };
        let received: Option<Vec<Received>> =
            receivers.par_iter().enumerate().map(receive).collect();
        let received = received?;
        let sent: Vec<(u32, Rgb)> = self.sources.vertices[patch]
            .iter()
            .map(|&v| (v, self.unshot(sums, is_first, v)))
            .collect();
        for (vertex, light) in sent {
            sums.add_part(vertex as usize, SHOT, light);
        }
        patches.count(patch);
        let rays = received.iter().map(|r| r.rays).sum();
        self.arrive(sums, received.iter().map(|r| (r.lx, r.variance)).collect());
        Some(rays)
    }

    /// Adds the light that arrived at the receivers.
    fn arrive(&self, sums: &mut Accumulator, received: Vec<(Rgb, f64)>) {
        let mut light: Vec<Rgb> = received.iter().map(|r| r.0).collect();
        let mut variances: Vec<Rgb> = received.iter().map(|r| Rgb::grey(r.1)).collect();
        // Interpolated values get interpolated variances: they are no better than their sources.
        self.plan.mesh.waiting.fill(&mut light);
        self.plan.mesh.waiting.fill(&mut variances);
        let light = self.plan.prolongate(&self.plan.mesh.fit.apply(&light));
        for (k, light) in light.into_iter().enumerate() {
            sums.add_part(k, RECEIVED, light);
        }
        for (k, variance) in variances.into_iter().enumerate() {
            sums.add_variance(k, variance.0[0].max(0.0));
        }
    }

    /// The light that vertices have not sent over specular surfaces.
    fn unsent(&self, sums: &Accumulator) -> Vec<Rgb> {
        let is_first = (0..self.light.direct.len()).all(|k| sums.part(k, SENT).is_black());
        let one = |k: usize| {
            let own = self.light.direct[k] + self.light.caustic[k];
            let indirect = if is_first { self.light.expected[k] } else { sums.part(k, RECEIVED) };
            own + indirect - sums.part(k, SENT)
        };
        (0..self.light.direct.len()).map(one).collect()
    }

    /// The approximate flux that sending it would bring, lm.
    fn unsent_lm(&self, specular: &Specular, sums: &Accumulator) -> f64 {
        let unsent = self.unsent(sums);
        let vertices = self.plan.mesh.elements.vertices().iter().zip(&unsent).enumerate();
        let known = vertices.filter(|(k, _)| self.plan.mesh.standings[*k].is_some());
        let lumen: f64 = known.map(|(_, (v, e))| v.area_m2 * e.luminance().abs()).sum();
        specular.mean_share * lumen
    }

    fn send_over_specular(&self, specular: &Specular, sums: &mut Accumulator) -> u64 {
        let unsent = self.unsent(sums);
        let received = specular.apply(&unsent);
        for (k, light) in unsent.into_iter().enumerate() {
            sums.add_part(k, SENT, light);
        }
        self.arrive(sums, received);
        0
    }

    /// The light at a vertex and its variance.
    pub(crate) fn estimate(&self, sums: &Accumulator, vertex: usize) -> Estimate {
        // Later shots take excess light back with other rays. Where they take more than has come, the light
        // is zero and the negative part counts as error.
        let received = sums.part(vertex, RECEIVED);
        let indirect = received.greater(Rgb::BLACK);
        let left_out_lx = (indirect - received).luminance();
        let indirect_variance = sums.variance_at(vertex)
            + self.light.caustic_variance.get(vertex).copied().unwrap_or(0.0)
            + left_out_lx * left_out_lx;
        Estimate {
            mean: Sample {
                direct: self.light.direct[vertex],
                caustic: self.light.caustic[vertex],
                indirect,
                passed_on: 0.0,
            },
            variance: indirect_variance + self.light.direct_variance[vertex],
            indirect_variance,
            common_variance: 0.0,
        }
    }

    /// The errors of the map at the check points.
    pub(crate) fn errors(
        &self,
        sums: &Accumulator,
        points: &[Check],
        ambient: Rgb,
    ) -> InterpolationErrors {
        let vertices = 0..self.light.direct.len();
        let indirect: Vec<Rgb> = vertices.map(|k| sums.part(k, RECEIVED) + ambient).collect();
        let light: Vec<Rgb> =
            indirect.iter().zip(&self.light.caustic).map(|(&e, &c)| e + c).collect();
        let mut found =
            Accumulator::new(check_points::places(points, true), self.whole.reference_lx);
        for operator in &self.checks.operators {
            let fresh = operator.apply(&light);
            let map = [self.light.direct.as_slice(), &self.light.caustic, &indirect];
            found.add(check_points::samples(points, (&fresh, &self.checks.direct), map, None));
        }
        let seen = check_points::errors(&found, points, (self.plan.trust(), Noise::Counted));
        InterpolationErrors { noise_lx: None, ..seen }
    }
}

/// The light that is left to shoot.
#[derive(Clone, Debug)]
pub(crate) struct Left {
    fluxes: Vec<Flux>,
    /// The approximate flux from light not yet sent over specular surfaces, lm.
    unsent_lm: f64,
    /// The share of unshot light in all light.
    pub(crate) share: f64,
    /// The ambient term in its place, lx.
    pub(crate) ambient_lx: Rgb,
    /// The standard error of the ambient term at a place, lx.
    pub(crate) doubt_lx: f64,
    /// Whether every patch has shot.
    pub(crate) all_have_shot: bool,
    /// Whether unshot light has a known bound: no more than the light there is.
    pub(crate) is_bounded: bool,
    /// Whether so little is unshot that shooting stops.
    pub(crate) is_shot: bool,
}

/// The unshot flux of a patch.
#[derive(Clone, Copy, Debug)]
struct Flux {
    is_first: bool,
    sum_lm: Rgb,
    /// The photometric flux without its sign, lm.
    size_lm: f64,
}

impl Checks {
    fn new(
        plan: &Plan,
        points: &[Check],
        (rays, accuracy): (u32, f64),
        direct: &[Rgb],
        key: Key,
    ) -> Self {
        // Check points gather as readers do.
        let gathering = Gathering { regathers: true, ..Gathering::of(plan, direct) };
        let rows: Vec<Gatherer> = points.iter().map(|p| p.gatherer.with_rays(rays)).collect();
        let operator = |k: u64| {
            let key = key.with(1 + k);
            gathering.operator(&rows, |row| key.with(row as u64))
        };
        Self {
            operators: (0..CHECKINGS).map(operator).collect(),
            direct: check_points::direct(plan, points, accuracy, (key.with(0), &plan.end)).lx,
        }
    }
}

/// The root mean square of light before any diffuse reflection, lx.
fn root_mean_square(plan: &Plan, direct: &[Rgb], caustic: &[Rgb]) -> f64 {
    let (mut squared, mut area_m2) = (0.0, 0.0);
    for (k, vertex) in plan.mesh.elements.vertices().iter().enumerate() {
        let lx = (direct[k] + caustic[k]).luminance();
        squared += vertex.area_m2 * lx * lx;
        area_m2 += vertex.area_m2;
    }
    if area_m2 > 0.0 { (squared / area_m2).sqrt() } else { 0.0 }
}

/// Direct light at the vertices and the variance of its mean; those of the plan if it is measured once.
fn direct(plan: &Plan, key: Key) -> (Vec<Rgb>, Vec<f64>) {
    if plan.lighting.is_measured_once() {
        return (plan.light.direct.clone(), plan.light.direct_variance.clone());
    }
    let vertex = |(k, gatherer): (usize, &Gatherer)| {
        if plan.end.has_passed() {
            return (plan.light.direct[k], 0.0);
        }
        let one = |replicate: u64| {
            let sequence = Sequence::new(key.with(k as u64).with(replicate));
            plan.lighting.illuminance(&gatherer.surface, &mut Dice::new(sequence, 0))
        };
        let values: Vec<Rgb> = (0..REPLICATES).map(one).collect();
        mean_and_variance(&values)
    };
    plan.mesh.gatherers.par_iter().enumerate().map(vertex).unzip()
}

/// The mean of caustics over replicates.
struct ReplicatedCaustics {
    /// The caustics at the vertices, lx.
    lx: Vec<Rgb>,
    /// The variance of the mean at the vertices that indirect light lives on, lx2.
    variance: Vec<f64>,
    /// The effort of all replicates.
    effort: Effort,
}

/// Caustics at the vertices from particles.
fn caustic(plan: &Plan, accuracy: f64, key: Key) -> ReplicatedCaustics {
    let particles = plan.particles(accuracy, REPLICATES);
    let mut sum = Effort::default();
    let mut replicates = Vec::new();
    for replicate in 0..REPLICATES {
        let deposited = caustics::deposit(plan, particles, key.with(replicate), &plan.end);
        let Some(Caustics { light, effort, .. }) = deposited else { break };
        sum.rays += effort.rays;
        sum.given_up_lx += effort.given_up_lx / REPLICATES as f64;
        replicates.push(light);
    }
    let at = |k: usize| {
        let values: Vec<Rgb> = replicates.iter().map(|r| r[k]).collect();
        // Without them, for want of time, there is no light, and the errors of the map are not known.
        if values.len() < 2 { (Rgb::BLACK, 0.0) } else { mean_and_variance(&values) }
    };
    let (light, variance): (Vec<Rgb>, Vec<f64>) = (0..plan.mesh.indirect_vertices).map(at).unzip();
    ReplicatedCaustics { lx: plan.prolongate(&light), variance, effort: sum }
}
