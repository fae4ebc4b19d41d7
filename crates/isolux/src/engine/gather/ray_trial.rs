//! How many rays an increment needs: a few receivers are tried.

use super::control_variate::Stand;
use super::gatherer::{Gatherer, Gathering};
use crate::engine::ray::{Accumulator, Sample};
use crate::sampling::Key;
use crate::units::Rgb;
use rayon::prelude::*;

/// Receivers, increments and rays of a trial.
pub(crate) const RECEIVERS: usize = 128;
pub(crate) const INCREMENTS: u64 = 4;
const RAYS: u32 = 16;

/// Where more rays than that times this are wanted, the trial is made again with so many: what is left is a step of
/// no more than this.
const NEARER: u32 = 4;

/// The part of the accuracy asked for that noise may take in any case, and where interpolation errs by nothing: what is left is
/// for what noise may hide of other errors.
pub(crate) const NOISE_SHARE: f64 = 0.45;
const MOST_NOISE_SHARE: f64 = 0.8;
/// The part of it that interpolation errs by where it leaves nothing for noise, as rays read wrongly in the mean, too; and where that
/// is measured. Between these ends an ellipse: measured on the hall, CUBE and SPHERE to reach the accuracy in as many
/// increments as are believed, or a few more.
const ALONE: f64 = 0.6;
const ALONE_WITH_MEANS: f64 = 0.75;

/// Variance of what is interpolated between three vertices, in the mean over an element, as a share of
/// theirs: the integral of the sum of the squares of the hat functions over the area.
pub(crate) const OF_INTERPOLATED: f64 = 0.5;

/// Nets of n rays err like this power of 1/n: measured between 0.8 and 1.1 on CUBE and SPHERE from 8
/// to 128 rays (independent rays err like 0.5).
pub(crate) const NET_ORDER: f64 = 0.85;

/// Rays of a receiver and increment, whatever is asked for, where walls take most of the noise off; and where they do not.
const FEWEST_WANTED: f64 = 4.0;
pub(crate) const FEWEST_UNJUDGED: u32 = 8;

/// And at most: a run can soon be stopped after that many.
const MOST_WANTED: f64 = 1024.0;

/// The noise that a map may have that is to reach a target and that interpolation is expected to add so much to, relative;
/// where means of elements are measured, more of it.
pub(crate) fn noise_for(target: f64, interpolation: f64, has_means: bool) -> f64 {
    let others = interpolation / target / if has_means { ALONE_WITH_MEANS } else { ALONE };
    let share = MOST_NOISE_SHARE * (1.0 - others * others).max(0.0).sqrt();
    target * share.max(NOISE_SHARE)
}

/// Where receivers stand, each with its surface, m2.
pub(crate) fn stands(some: &[(Gatherer, f64)]) -> impl Iterator<Item = (Stand, f64)> + '_ {
    some.iter().map(|(of, m2)| (of.stand(), *m2))
}

/// Variance of nets of receivers, each with its rays, lx2; also returns the rays traced.
pub(crate) fn variances_lx2(
    gathering: &Gathering,
    rows: &[Gatherer],
    light: &[Rgb],
    (reference_lx, key): (f64, Key),
) -> (Vec<f64>, u64) {
    let mut sums = Accumulator::new(rows.len(), reference_lx);
    let mut traced = 0;
    for index in 0..INCREMENTS {
        let key = key.with(index);
        let operator = gathering.operator(rows, |row| key.with(row as u64));
        traced += operator.rays;
        let gathered = operator.apply(light).into_iter();
        sums.add(gathered.map(|indirect| Sample { indirect, ..Sample::default() }));
    }
    let of_one = |row| INCREMENTS as f64 * sums.estimate(row).variance;
    ((0..rows.len()).map(of_one).collect(), traced)
}

/// What a trial has found: the noise of one net of so many rays, root mean square over the surface, lx.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayTrial {
    noise_lx: f64,
    rays: u32,
    /// What errors were relative to then, lx.
    pub(crate) reference_lx: f64,
}

impl RayTrial {
    /// What is mostly found, as long as nothing is tried: 1.5 to 3.2 % of the light in CUBE, SPHERE and the hall.
    pub(crate) fn usual(reference_lx: f64) -> Self {
        Self { noise_lx: 0.02 * reference_lx, rays: RAYS, reference_lx }
    }

    /// Tries some receivers, each with the surface it stands for, m2, for a run of so many increments that
    /// is to reach a target; also returns the rays traced. What [`RayTrial::of_walls`] has found already is not tried again.
    pub(crate) fn of(
        gathering: &Gathering,
        some: &[(Gatherer, f64)],
        light: &[Rgb],
        (target, reference_lx, increments, key): (f64, f64, u64, Key),
        known: Option<Self>,
    ) -> (Self, u64) {
        let with = |rays: u32| Self::with(rays, gathering, some, light, (reference_lx, key));
        let (first, traced) = known.map_or_else(|| with(RAYS), |known| (known, 0));
        let nearer = first.rays_for(NOISE_SHARE * target, reference_lx, increments) / NEARER;
        if nearer <= RAYS {
            return (first, traced);
        }
        let (trial, more) = with(nearer);
        (trial, traced + more)
    }

    /// With few rays that are judged by walls; and their noise as a share of what it is if they are not, if that is any, and the rays
    /// traced.
    pub(crate) fn of_walls(
        gathering: &Gathering,
        some: &[(Gatherer, f64)],
        light: &[Rgb],
        of: (f64, Key),
    ) -> (Self, Option<f64>, u64) {
        let behind = |of: &Gatherer| gathering.backdrop?.behind(gathering.scene, &of.stand());
        let judged = |&(of, m2): &(Gatherer, f64)| (Gatherer { behind: behind(&of), ..of }, m2);
        let judged: Vec<(Gatherer, f64)> = some.par_iter().map(judged).collect();
        let (trial, rays) = Self::with(RAYS, gathering, &judged, light, of);
        let (other, others) = Self::with(RAYS, gathering, some, light, of);
        let left = (other.noise_lx > 0.0).then(|| trial.noise_lx / other.noise_lx);
        (trial, left, rays + others)
    }

    fn with(
        rays: u32,
        gathering: &Gathering,
        some: &[(Gatherer, f64)],
        light: &[Rgb],
        (reference_lx, key): (f64, Key),
    ) -> (Self, u64) {
        let rows: Vec<Gatherer> = some.iter().map(|(g, _)| g.with_rays(rays)).collect();
        let (variances_lx2, traced) = variances_lx2(gathering, &rows, light, (reference_lx, key));
        let (mut area_m2, mut of_all) = (0.0, 0.0);
        for (variance_lx2, (_, own_m2)) in variances_lx2.iter().zip(some) {
            area_m2 += own_m2;
            of_all += own_m2 * variance_lx2;
        }
        let variance = if area_m2 > 0.0 { of_all / area_m2 } else { 0.0 };
        (Self { noise_lx: variance.sqrt(), rays, reference_lx }, traced)
    }

    /// The noise of one net of so many rays, lx.
    pub(crate) fn noise_lx(self, rays: f64) -> f64 {
        self.noise_lx * libm::pow(f64::from(self.rays) / rays, NET_ORDER)
    }

    /// Gathering rays of a receiver with which so many increments leave no more than some noise, a power of two.
    pub(crate) fn rays_for(self, noise: f64, reference_lx: f64, increments: u64) -> u32 {
        libm::exp2(libm::round(libm::log2(self.wanted(noise, reference_lx, increments)))) as u32
    }

    /// The same of receivers that may lie where walls take no noise off.
    pub(crate) fn rays_anywhere(self, noise: f64, reference_lx: f64, increments: u64) -> u32 {
        self.rays_for(noise, reference_lx, increments).max(FEWEST_UNJUDGED)
    }

    /// The same as [`RayTrial::rays_for`], any number: what receivers that share rays as best they can should have in the mean.
    pub(crate) fn wanted(self, noise: f64, reference_lx: f64, increments: u64) -> f64 {
        let noise_lx = self.noise_lx * (OF_INTERPOLATED / increments as f64).sqrt();
        let allowed_lx = noise * reference_lx;
        if !(noise_lx > 0.0 && allowed_lx > 0.0) {
            return FEWEST_WANTED;
        }
        let wanted = f64::from(self.rays) * libm::pow(noise_lx / allowed_lx, 1.0 / NET_ORDER);
        wanted.clamp(FEWEST_WANTED, MOST_WANTED)
    }
}
