//! Check points: places where the interpolation error is measured.
//!
//! At random places of the surfaces each increment gathers afresh and compares with its own interpolated map.
//! The mean difference over increments is the interpolation error there. Its known variance is subtracted, so
//! the squared error of the scene is estimated without bias. Points are weighted by their inverse density,
//! which is an even mixture of four:
//!
//! * area,
//! * squared details (most of the error lies in little of the area),
//! * squared details among elements that readers trust,
//! * details, for the mean error.

use crate::engine::gather::{DirectAtEnds, Gatherer, Gathering, known_at, known_on_side};
use crate::engine::light::{Goal, Measured};
use crate::engine::mesh::{LeafError, Trust};
use crate::engine::occlusion::nearby;
use crate::engine::plan::Plan;
use crate::engine::ray::{Accumulator, Deadline, Dice, Noise, Sample, Sums, SurfacePoint};
use crate::sampling::{Key, Sequence};
use crate::units::Rgb;
use rayon::prelude::*;

/// The number of vertices that carry light per check point.
const CARRIERS_A_CHECK: usize = 8;
/// The least number of check points.
const FEWEST_CHECKS: usize = 256;
/// The largest number of check points. With 2048, six seeds of the hall at 1 % take 13.8 million rays in the mean,
/// with 1024 13.6 million (decision 25).
const MOST_CHECKS: usize = 1024;

/// The number of check points per task; some take a hundred times as long as others.
const MOST_TASK_CHECKS: usize = 8;

/// The squared interpolation error that is accepted where readers would otherwise gather, in squared errors of the
/// map. In rooms with little indirect light it is never more; among furniture it is eight times as much and more.
const ACCEPTED_ERROR_RATIO: f64 = 1.5;

/// The number of rays that measure the share of light that a reader reads close by.
const CLOSE_RAYS: u32 = 16;

/// A place where the map is checked.
pub(crate) struct Check {
    pub(crate) gatherer: Gatherer,
    /// Vertices and weights of the indirect map at the level of the mesh, known vertices only.
    read: [(u32, f64); 3],
    /// Vertices and weights of the whole map, known vertices only.
    fine: [(u32, f64); 3],
    /// Vertices and weights of the indirect map as rays read it, where these differ: on elements that
    /// something stands across, which readers ignore, and where vertices gather for the bare map.
    by_rays: Option<[(u32, f64); 3]>,
    /// The area that the point stands for, m2.
    area_m2: f64,
    /// The expected interpolation error of the element, lx.
    expected_lx: f64,
    /// Whether readers interpolate there if they trust its element: it has open vertices and the place is no
    /// gap.
    may_be_trusted: bool,
    /// Whether something stands close before the place.
    is_beset: bool,
    /// The share of a unit of light that readers who gather there still read close by.
    close: f64,
    /// Whether parts of its element are checked for caustics; these parts also give the noise of caustics.
    has_parts: bool,
}

/// All check points of a map, with the sums of increments there.
pub(crate) struct Checks {
    pub(crate) points: Vec<Check>,
    pub(crate) sums: Accumulator,
    /// The sums of caustics that the map lacks in parts of elements.
    pub(crate) lacking: Accumulator,
}

/// Direct light at the check points.
pub(crate) struct DirectThere {
    pub(crate) lx: Vec<Rgb>,
    /// The mean variance of its readings over the surface, lx2. Their noise is the same in all increments,
    /// whose spread does not show it.
    pub(crate) noise_lx2: f64,
    /// The relative accuracy of the map whose readings these are.
    accuracy: f64,
}

impl DirectThere {
    /// Direct light evaluated with other random numbers, lx.
    pub(crate) fn again(
        &self,
        plan: &Plan,
        checks: &[Check],
        key: Key,
        deadline: &Deadline,
    ) -> Vec<Rgb> {
        direct(plan, checks, self.accuracy, (key, deadline)).lx
    }
}

/// Errors beyond noise, lx: interpolation errors over the surface, as root mean squares and signed means, and
/// the light of paths given up.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct InterpolationErrors {
    /// The interpolation error of indirect light where readers interpolate it, root mean square.
    pub(crate) indirect_lx: f64,
    /// The part of it in caustics, which the vertices there report.
    pub(crate) caustics_lx: f64,
    /// The interpolation error of indirect light where readers gather instead, root mean square.
    pub(crate) untrusted_lx: f64,
    /// The share of a unit of light that readers read close by there, root mean square over all of the
    /// surface.
    pub(crate) close: f64,
    /// The interpolation error of direct and indirect light together, gaps included: that of the bare map.
    pub(crate) total_lx: f64,
    /// The mean error of indirect light, with its sign, after the correction for its standard error.
    pub(crate) indirect_mean_lx: f64,
    /// The part of that mean where readers interpolate.
    pub(crate) trusted_mean_lx: f64,
    /// The mean interpolation error of direct light, with its sign.
    pub(crate) direct_mean_lx: f64,
    /// The mean light that paths given up would bring, before reflection.
    pub(crate) given_up_lx: f64,
    /// The noise of readings over the surface, root mean square, from the spread of increments; `None` where
    /// it was not measured.
    pub(crate) noise_lx: Option<f64>,
    /// The factor by which elements err more than expected; `None` where it was not measured.
    pub(crate) over_expected: Option<f64>,
}

impl Checks {
    /// The sums at all check points and in all parts of elements.
    pub(crate) fn all(&self) -> Vec<Sums> {
        [&self.sums, &self.lacking].iter().flat_map(|of| &of.sums).copied().collect()
    }
}

/// The number of places in the sums: differences, then readings of the map, then differences as rays read, if
/// these are separate.
pub(crate) fn places(checks: &[Check], is_map_read_by_rays: bool) -> usize {
    let is_read_alike = is_map_read_by_rays && !are_cut(checks);
    if is_read_alike { 2 * checks.len() } else { 3 * checks.len() }
}

/// The illuminance of the vertices at every place in the sums, lx.
pub(crate) fn about_lx(checks: &[Check], light: &[Rgb]) -> impl Iterator<Item = f64> {
    let of = |check: &Check| {
        check.fine.iter().map(|&(v, weight)| weight * light[v as usize].luminance()).sum::<f64>()
    };
    (0..3).flat_map(move |_| checks.iter().map(of))
}

/// Whether rays read other vertices than readers at any point.
fn are_cut(checks: &[Check]) -> bool {
    checks.iter().any(|check| check.by_rays.is_some())
}

/// The number of check points for a number of vertices that carry light.
pub(crate) fn count(carriers: usize) -> usize {
    (carriers / CARRIERS_A_CHECK).clamp(FEWEST_CHECKS, MOST_CHECKS)
}

/// Draws the check points of a plan.
pub(crate) fn draw(plan: &Plan, rays: u32, key: Key) -> Vec<Check> {
    let errors = &plan.errors.of_elements;
    let count = count(plan.mesh.carriers.count(plan.mesh.indirect_vertices));
    let area: f64 = errors.iter().map(|e| e.area_m2).sum();
    let squared: f64 = errors.iter().map(|e| e.squared()).sum();
    let whole: f64 = errors.iter().map(|e| e.error * e.area_m2).sum();
    let is_trusted = |e: &LeafError| plan.trust().includes(e.error, e.is_beset);
    let trusted = errors.iter().filter(|e| is_trusted(e)).map(|e| e.squared()).sum::<f64>();
    // The density of the draw over elements is an even mixture of area, squared error, squared error where
    // the map is trusted, and error, which serves the mean best (Kahn and Marshall 1953, with unknown signs).
    let density = |k: usize| {
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        let own = errors[k].squared();
        let own_trusted = if is_trusted(&errors[k]) { own } else { 0.0 };
        share(errors[k].area_m2, area)
            + share(own, squared)
            + share(own_trusted, trusted)
            + share(errors[k].error * errors[k].area_m2, whole)
    };
    let mut sums = Vec::with_capacity(errors.len());
    let mut sum = 0.0;
    for k in 0..errors.len() {
        sum += density(k);
        sums.push(sum);
    }
    let sequence = Sequence::new(key);
    let one = |index: usize| {
        let mut dice = Dice::new(sequence, index as u32);
        let [pick, _] = dice.pair();
        // Points are stratified: one in each of `count` equal parts.
        let at = (index as f64 + pick) / count as f64 * sum;
        let k = sums.partition_point(|&s| s <= at).min(errors.len() - 1);
        let surface =
            SurfacePoint::in_node(plan.scene, &plan.mesh.subdivision, errors[k].node, dice.pair());
        let area_m2 = errors[k].area_m2 / (count as f64 * density(k) / sum);
        check(plan, Gatherer::on_surface(surface, rays), area_m2, &errors[k])
    };
    let mut checks: Vec<Check> = (0..count).into_par_iter().filter_map(one).collect();
    let is_gathered = |check: &Check| !check.is_trusted(plan.errors.trusts.least());
    let rows = checks.iter().filter(|check| is_gathered(check));
    let rows: Vec<Gatherer> = rows.map(|c| c.gatherer.with_rays(CLOSE_RAYS)).collect();
    // The operator is only asked where rays end; the light along them is not used.
    let direct = DirectAtEnds::Read { values: &plan.light.direct, level: u32::MAX };
    let gathering =
        Gathering { regathers: true, direct, ..Gathering::of(plan, &plan.light.direct) };
    let operator = gathering.operator(&rows, |k| key.with(1).with(k as u64));
    let gathered = checks.iter_mut().filter(|check| is_gathered(check));
    gathered.zip(operator.close()).for_each(|(check, close)| check.close = close);
    checks
}

/// Check points for light that no rays read from the map.
pub(crate) fn draw_for_map(plan: &Plan, rays: u32, key: Key) -> Vec<Check> {
    let as_map = |check| Check { by_rays: None, ..check };
    draw(plan, rays, key).into_iter().map(as_map).collect()
}

fn check(plan: &Plan, gatherer: Gatherer, area_m2: f64, of: &LeafError) -> Option<Check> {
    let weights =
        |level: u32| known_at(&plan.mesh.elements, level, &plan.mesh.standings, &gatherer.surface);
    // These are the weights of readers, who do not look for barriers across elements. Rays do, and err less.
    let (coarse, fine) = (weights(plan.mesh.level)?, weights(u32::MAX)?);
    let edge_m = nearby::longest_edge_m(&plan.mesh.elements, fine.map(|(vertex, _)| vertex));
    let is_beset = nearby::is_beset(plan.scene, &gatherer.surface, edge_m);
    let in_gap = is_beset && nearby::is_closed_in(plan.scene, &gatherer.surface, edge_m);
    let reads_open = coarse.iter().any(|&(vertex, weight)| weight > 0.0 && plan.is_open(vertex));
    let expected_lx = of.error;
    let is_beset = is_beset || of.is_beset_afar;
    let may_be_trusted = reads_open && !in_gap;
    let mut gatherer = gatherer.in_gap(in_gap);
    gatherer.behind =
        plan.light.backdrop.as_ref().and_then(|b| b.behind(plan.scene, &gatherer.stand()));
    let SurfacePoint { triangle, back, u, v, .. } = gatherer.surface;
    let node =
        plan.mesh.elements.place(plan.mesh.level, triangle, back, [u, v]).map(|place| place.node());
    let has_parts = node.is_some_and(|node| plan.errors.parts.has(node));
    let cut = node.and_then(|node| plan.mesh.cuts.of_node(node));
    let on_side = cut.and_then(|cut| {
        let corners = plan.mesh.elements.locate_above(plan.mesh.level, triangle, back, u, v)?;
        // Beyond a barrier with no known vertex on their side, rays read nothing.
        let none = corners.map(|(vertex, _)| (vertex, 0.0));
        Some(known_on_side(corners, &plan.mesh.standings, cut).unwrap_or(none))
    });
    // Readers read what vertices have gathered for the bare map; rays do not.
    let is_alike = plan.mesh.gathering_for_bare.is_empty();
    let (by_rays, read) =
        if is_alike { (on_side, coarse) } else { (on_side.or(Some(coarse)), fine) };
    let place = Check {
        gatherer,
        read,
        fine,
        by_rays,
        area_m2,
        expected_lx,
        may_be_trusted,
        is_beset,
        close: 0.0,
        has_parts,
    };
    Some(place)
}

impl Check {
    /// Whether readers with this trust interpolate there.
    fn is_trusted(&self, trust: Trust) -> bool {
        self.may_be_trusted && trust.includes(self.expected_lx, self.is_beset)
    }
}

/// Direct light at the check points, as readings of a map of this accuracy evaluate it. `key` matters only
/// where it has noise. After the deadline it is left out.
pub(crate) fn direct(
    plan: &Plan,
    checks: &[Check],
    accuracy: f64,
    (key, deadline): (Key, &Deadline),
) -> DirectThere {
    let sequence = |k: usize| Sequence::new(key.with(k as u64));
    let reading = Goal::reading(accuracy);
    // The error of the scene counts, so the goal is a share of its reference light even at dark places.
    let goal = Goal { lx: reading.share * plan.light.reference_lx, ..reading };
    let one = |(k, check): (usize, &Check)| {
        if deadline.has_passed() {
            return Measured { lx: Rgb::BLACK, variance: 0.0 };
        }
        plan.lighting.measured(&check.gatherer.surface, goal, sequence(k))
    };
    let measured: Vec<Measured> =
        checks.par_iter().with_max_len(MOST_TASK_CHECKS).enumerate().map(one).collect();
    let is_told = plan.lighting.is_measured_once() && !checks.is_empty();
    let noise = || {
        let of_each = checks.iter().zip(&measured).map(|(check, m)| check.area_m2 * m.variance);
        of_each.sum::<f64>() / area_m2(checks)
    };
    let noise_lx2 = if is_told { noise() } else { 0.0 };
    DirectThere { lx: measured.iter().map(|m| m.lx).collect(), noise_lx2, accuracy }
}

/// The samples that one increment adds to the sums. `fresh` is the light gathered at the points,
/// `fresh_direct` that of luminaires there; then comes the increment's map: direct light, caustics, indirect
/// light. `lookups` are the errors of rays that end there, if these do not read the map.
pub(crate) fn samples(
    checks: &[Check],
    (fresh, fresh_direct): (&[Rgb], &[Rgb]),
    [direct, caustic, indirect]: [&[Rgb]; 3],
    lookups: Option<&[Rgb]>,
) -> Vec<Sample> {
    let read = |values: &[Rgb], at: &[(u32, f64); 3]| -> Rgb {
        at.iter().map(|&(vertex, weight)| values[vertex as usize] * weight).sum()
    };
    let readings = checks.iter().zip(fresh_direct).map(|(check, &direct)| Sample {
        direct,
        caustic: read(caustic, &check.fine),
        indirect: read(indirect, &check.read),
        passed_on: 0.0,
    });
    let difference = |k: usize, of: &[(u32, f64); 3]| {
        let hidden = fresh[k].is_black() && fresh_direct[k].is_black();
        if hidden {
            return Sample::default();
        }
        Sample {
            direct: read(direct, &checks[k].fine) - fresh_direct[k],
            caustic: Rgb::BLACK,
            indirect: read(indirect, of) - fresh[k],
            passed_on: 0.0,
        }
    };
    let differences = checks.iter().enumerate().map(|(k, check)| difference(k, &check.read));
    let by_rays = |(k, check): (usize, &Check)| match lookups {
        Some(lookups) => Sample { indirect: lookups[k], ..Sample::default() },
        // Neither rays nor views reach closed-in places.
        None if check.gatherer.in_gap => Sample::default(),
        None => difference(k, check.by_rays.as_ref().unwrap_or(&check.read)),
    };
    let is_asked = lookups.is_some() || are_cut(checks);
    let by_rays = checks.iter().enumerate().filter(|_| is_asked).map(by_rays);
    differences.chain(readings).chain(by_rays).collect()
}

/// The errors measured so far, for readers with this trust.
pub(crate) fn errors(
    sums: &Accumulator,
    checks: &[Check],
    (trust, noise_is): (Trust, Noise),
) -> InterpolationErrors {
    let area = area_m2(checks);
    let (mut squared, mut mean, mut spread) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    // Sums over the places where readers interpolate, and the variance of the mean of all places.
    let [mut expected, mut trusted_mean, mut of_mean] = [0.0; 3];
    let [mut untrusted, mut close, mut share_untrusted] = [0.0; 3];
    for (k, check) in checks.iter().enumerate() {
        let estimate = sums.estimate(k);
        let (indirect, share) = (estimate.mean.indirect.luminance(), check.area_m2 / area);
        if check.is_trusted(trust) {
            expected += share * check.expected_lx * check.expected_lx;
            trusted_mean += share * indirect;
        } else {
            share_untrusted += share;
            untrusted += share * (indirect * indirect - estimate.indirect_variance);
            close += share * check.close * check.close;
        }
        let all = indirect + estimate.mean.direct.luminance();
        let both = [(indirect, estimate.indirect_variance), (all, estimate.variance)];
        for (part, (value, variance)) in both.into_iter().enumerate() {
            // Neither rays nor readers of interpolated light reach closed-in places.
            if !check.gatherer.in_gap {
                mean[part] += share * value;
                of_mean += if part == 0 { share * share * variance } else { 0.0 };
            }
            if part == 1 || check.is_trusted(trust) {
                squared[part] += share * (value * value - variance);
                // This is the variance of `value^2 - variance` for a normal value of mean zero.
                spread[part] += share * share * 2.0 * variance * variance;
            }
        }
    }
    let root = |part: usize| noise_is.of_squared(squared[part], spread[part].sqrt()).sqrt();
    let believed = |mean: f64| noise_is.of_mean(mean, of_mean.sqrt());
    if sums.sums.len() > 2 * checks.len() {
        mean = mean_by_rays(sums, checks, area);
    }
    InterpolationErrors {
        indirect_lx: root(0),
        total_lx: root(1),
        indirect_mean_lx: believed(mean[0]),
        trusted_mean_lx: believed(trusted_mean),
        direct_mean_lx: mean[1] - mean[0],
        untrusted_lx: (untrusted.max(0.0) / share_untrusted.max(f64::MIN_POSITIVE)).sqrt(),
        close: close.sqrt(),
        noise_lx: (!checks.is_empty()).then(|| (noise_of_readings(sums, checks) / area).sqrt()),
        over_expected: (expected > 0.0).then(|| root(0) / expected.sqrt()),
        ..InterpolationErrors::default()
    }
}

/// The mean errors that rays read, where these differ from those of readers: of indirect light, and of all
/// light.
fn mean_by_rays(sums: &Accumulator, checks: &[Check], area_m2: f64) -> [f64; 2] {
    let mut mean = [0.0; 2];
    for (k, check) in checks.iter().enumerate() {
        let read = sums.estimate(2 * checks.len() + k).mean;
        let indirect = read.indirect.luminance();
        mean[0] += check.area_m2 / area_m2 * indirect;
        mean[1] += check.area_m2 / area_m2 * (indirect + read.direct.luminance());
    }
    mean
}

/// The area that all points stand for, m2.
fn area_m2(checks: &[Check]) -> f64 {
    checks.iter().map(|c| c.area_m2).sum()
}

/// The variance of the map's readings, integrated over the surface, lx2 m2.
fn noise_of_readings(sums: &Accumulator, checks: &[Check]) -> f64 {
    (0..checks.len()).map(|k| checks[k].area_m2 * noise_of_reading(sums, checks, k)).sum()
}

/// The variance of the map's reading at one point, lx2; zero where parts of the element measure it for
/// caustics.
fn noise_of_reading(sums: &Accumulator, checks: &[Check], k: usize) -> f64 {
    if checks[k].has_parts { 0.0 } else { sums.estimate(checks.len() + k).variance }
}

/// Whether gathering pays anywhere but in gaps. It pays if places where readers with this trust gather would
/// have a squared error, noise and interpolation together, of more than [`ACCEPTED_ERROR_RATIO`] times that of
/// `error_lx`, the error of the map.
pub(crate) fn is_gathering_worth_while(
    sums: &Accumulator,
    checks: &[Check],
    trust: Trust,
    error_lx: f64,
) -> bool {
    let is_asked = |k: &usize| {
        let check = &checks[*k];
        check.may_be_trusted && !check.is_trusted(trust)
    };
    let (mut area_m2, mut squared, mut spread) = (0.0, 0.0, 0.0);
    for k in (0..checks.len()).filter(is_asked) {
        let (own_m2, estimate) = (checks[k].area_m2, sums.estimate(k));
        let (error, variance) = (estimate.mean.indirect.luminance(), estimate.indirect_variance);
        area_m2 += own_m2;
        squared += own_m2 * (error * error - variance + noise_of_reading(sums, checks, k));
        spread += own_m2 * own_m2 * 2.0 * variance * variance;
    }
    Noise::Counted.of_squared(squared, spread.sqrt())
        > ACCEPTED_ERROR_RATIO * error_lx * error_lx * area_m2
}
