//! Trials on a few receivers that tell the number of rays of an increment.

use super::gatherer::{Gatherer, Gathering};
use crate::engine::ray::{Accumulator, Sample, Stand};
use crate::sampling::Key;
use crate::units::Rgb;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// The number of receivers of a trial. With 256 to 511, trials took 9 ms in CUBE and 14 ms in SPHERE at 1 %
/// (decision 25).
pub(crate) const RECEIVERS: usize = 128;
/// The number of increments of a trial.
pub(crate) const INCREMENTS: u64 = 4;
/// The number of rays of a receiver in a trial.
const RAYS: u32 = 16;

/// The ratio of wanted to tried rays above which the trial is repeated, with the wanted rays divided by this. The
/// extrapolation then spans no more than this factor.
const MOST_EXTRAPOLATION_FACTOR: u32 = 4;

/// The share of the accuracy goal that noise may always take. With 0.5, CUBE at 0.3 % misses its goal on the
/// first elements in 7 of 24 runs, with 0.45 in 5 (decision 22).
pub(crate) const NOISE_SHARE: f64 = 0.45;
/// The share that noise may take where interpolation has no error. The rest is for errors that noise may hide.
const MOST_NOISE_SHARE: f64 = 0.8;
/// The share of the accuracy goal at which interpolation leaves nothing for noise, since rays read its mean error,
/// too. Between these ends the noise follows an ellipse. On the hall, CUBE and SPHERE, runs were measured to reach
/// the accuracy in as many increments as are believed, or a few more.
const NOISELESS_SHARE: f64 = 0.6;

/// The ratio of the variance interpolated between three vertices, in the mean over an element, to that of the
/// vertices: the integral of the summed squares of the hat functions over the area.
pub(crate) const OF_INTERPOLATED: f64 = 0.5;

/// Order of convergence of nets: their error falls like this power of 1/n for n rays. Measured between 0.8 and 1.1 on
/// CUBE and SPHERE from 8 to 128 rays (independent rays: 0.5).
pub(crate) const NET_ORDER: f64 = 0.85;

/// The fewest rays of a receiver and increment where the control variate of walls removes most of the noise.
const FEWEST_RAYS: f64 = 4.0;
/// The fewest rays of a receiver and increment elsewhere.
pub(crate) const FEWEST_UNJUDGED: u32 = 8;

/// The most rays of a receiver and increment, so that a run can soon be stopped.
const MOST_RAYS: f64 = 1024.0;

/// The relative noise allowed in a map for a relative accuracy `target`, given the relative error expected of
/// interpolation.
pub(crate) fn noise_for(target: f64, interpolation: f64) -> f64 {
    let others = interpolation / target / NOISELESS_SHARE;
    let share = MOST_NOISE_SHARE * (1.0 - others * others).max(0.0).sqrt();
    target * share.max(NOISE_SHARE)
}

/// The stands of receivers, each with its surface, m2.
pub(crate) fn stands(some: &[(Gatherer, f64)]) -> impl Iterator<Item = (Stand, f64)> + '_ {
    some.iter().map(|(of, m2)| (of.stand(), *m2))
}

/// The variances of the nets of receivers, each with its own number of rays, lx2, and the number of rays traced.
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

/// The result of a trial: the noise of one net of `rays` rays, root mean square over the surface, lx.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct RayTrial {
    noise_lx: f64,
    rays: u32,
    /// The reference illuminance of relative errors at the time of the trial, lx.
    pub(crate) reference_lx: f64,
}

/// The goal of a run whose number of rays a trial tells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RunGoal {
    /// The relative accuracy.
    pub(crate) target: f64,
    /// The reference illuminance of relative errors, lx.
    pub(crate) reference_lx: f64,
    /// The number of increments in which it is to be reached.
    pub(crate) increments: u64,
}

/// The result of a trial with rays corrected by the control variate of walls.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WallTrial {
    pub(crate) trial: RayTrial,
    /// The ratio of the noise to that without walls; `None` if there is no noise without walls.
    pub(crate) left: Option<f64>,
    /// The number of rays traced.
    pub(crate) rays: u64,
}

impl RayTrial {
    /// The result assumed before any trial: 2 % of the reference. Measured: 1.5 to 3.2 % of the light in CUBE, SPHERE
    /// and the hall.
    pub(crate) fn usual(reference_lx: f64) -> Self {
        Self { noise_lx: 0.02 * reference_lx, rays: RAYS, reference_lx }
    }

    /// A trial on some receivers, each with the surface it stands for, m2, for a run with a goal. Also returns the
    /// number of rays traced. A result of [`RayTrial::of_walls`] replaces the first trial.
    pub(crate) fn of(
        gathering: &Gathering,
        some: &[(Gatherer, f64)],
        light: &[Rgb],
        (goal, key): (RunGoal, Key),
        known: Option<Self>,
    ) -> (Self, u64) {
        let RunGoal { target, reference_lx, increments } = goal;
        let with = |rays: u32| Self::with(rays, gathering, some, light, (reference_lx, key));
        let (first, traced) = known.map_or_else(|| with(RAYS), |known| (known, 0));
        let nearer = first.rays_for(NOISE_SHARE * target, reference_lx, increments)
            / MOST_EXTRAPOLATION_FACTOR;
        if nearer <= RAYS {
            return (first, traced);
        }
        let (trial, more) = with(nearer);
        (trial, traced + more)
    }

    /// A trial with few rays corrected by the control variate of walls.
    pub(crate) fn of_walls(
        gathering: &Gathering,
        some: &[(Gatherer, f64)],
        light: &[Rgb],
        of: (f64, Key),
    ) -> WallTrial {
        let behind = |of: &Gatherer| gathering.backdrop?.behind(gathering.scene, &of.stand());
        let judged = |&(of, m2): &(Gatherer, f64)| (Gatherer { behind: behind(&of), ..of }, m2);
        let judged: Vec<(Gatherer, f64)> = some.par_iter().map(judged).collect();
        let (trial, rays) = Self::with(RAYS, gathering, &judged, light, of);
        let (other, others) = Self::with(RAYS, gathering, some, light, of);
        let left = (other.noise_lx > 0.0).then(|| trial.noise_lx / other.noise_lx);
        WallTrial { trial, left, rays: rays + others }
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

    /// The noise of one net of `rays` rays, lx.
    pub(crate) fn noise_lx(self, rays: f64) -> f64 {
        self.noise_lx * libm::pow(f64::from(self.rays) / rays, NET_ORDER)
    }

    /// The rays of a receiver, a power of two, for which `increments` increments leave this relative noise.
    pub(crate) fn rays_for(self, noise: f64, reference_lx: f64, increments: u64) -> u32 {
        libm::exp2(libm::round(libm::log2(self.wanted(noise, reference_lx, increments)))) as u32
    }

    /// The rays of a receiver as from [`RayTrial::rays_for`], for receivers where walls may remove no noise.
    pub(crate) fn rays_anywhere(self, noise: f64, reference_lx: f64, increments: u64) -> u32 {
        self.rays_for(noise, reference_lx, increments).max(FEWEST_UNJUDGED)
    }

    /// The mean number of rays of receivers for which `increments` increments leave this relative noise, not rounded
    /// to a power of two.
    pub(crate) fn wanted(self, noise: f64, reference_lx: f64, increments: u64) -> f64 {
        let noise_lx = self.noise_lx * (OF_INTERPOLATED / increments as f64).sqrt();
        let allowed_lx = noise * reference_lx;
        if !(noise_lx > 0.0 && allowed_lx > 0.0) {
            return FEWEST_RAYS;
        }
        let wanted = f64::from(self.rays) * libm::pow(noise_lx / allowed_lx, 1.0 / NET_ORDER);
        wanted.clamp(FEWEST_RAYS, MOST_RAYS)
    }
}
