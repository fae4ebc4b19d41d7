//! Direct light with its own standard error, by as many shadow rays as that requires.

use super::super::lighting::Lighting;
use super::super::tree::cut::Cut;
use super::measured::{Goal, Measured, REPLICATES, STUDENT_FACTOR};
use crate::engine::ray::{Dice, SurfacePoint, mean_and_variance};
use crate::sampling::Sequence;
use crate::units::Rgb;

/// The fewest teeth of a replicate.
const FEWEST_TEETH: f64 = 4.0;
/// The most teeth of a replicate in the first measurement.
const MOST_TEETH: f64 = 512.0;
/// The most teeth of a replicate in a second measurement.
const MOST_FURTHER_TEETH: f64 = 2048.0;

/// Order of convergence of combs: their error falls like this power of 1/n for n teeth where part of the
/// light is hidden. Measured on an interior of 2626 luminaires from 8 to 512 teeth (independent rays: 0.5).
const COMB_ORDER: f64 = 0.7;

/// Imaginary rays added to those of the first look, half of them dark and half fully lit. A first
/// look whose rays agree may still be wrong.
const IMAGINARY_RAYS: f64 = 0.5;

/// Ratio of the measured to the wanted standard error above which another measurement follows.
const MISSED_ERROR_RATIO: f64 = 1.25;

/// The most shadow rays of a reading to emitting surfaces, in multiples of the usual number.
const MOST_RAYS_FACTOR: f64 = 64.0;
/// The largest factor on that for finer readings.
const MOST_FINER_FACTOR: f64 = 10.0;

impl Lighting<'_> {
    /// Direct illuminance with the variance of its noise. Where luminaires are few it is evaluated
    /// once, and the variance leaves out the noise of emitting surfaces.
    ///
    /// Best effort: the noise is about as asked for. The first look is not part of the result, so
    /// the result is unbiased.
    pub(crate) fn measured(&self, at: &SurfacePoint, goal: Goal, sequence: Sequence) -> Measured {
        if !self.has_many() {
            let lx = self.illuminance(at, &mut Dice::new(sequence, 0));
            return Measured { lx, variance: 0.0 };
        }
        let others = self.of_others(at, sequence.fork(REPLICATES, 1));
        let (tree, _) = self.of_tree(at, (goal, others.lx), sequence);
        Measured { lx: tree.lx + others.lx, variance: tree.variance + others.variance }
    }

    /// Direct illuminance by `looks` estimates of few shadow rays. The variance is that of their mean; of a single estimate
    /// it is its square, which is larger in the mean.
    pub(crate) fn measured_in_a_hurry(
        &self,
        at: &SurfacePoint,
        looks: u32,
        sequence: Sequence,
    ) -> Measured {
        let one = |look: u32| self.estimate(at, &mut Dice::new(sequence, look));
        let values: Vec<Rgb> = (0..looks).map(one).collect();
        let (lx, variance) = match values[..] {
            [] => (Rgb::BLACK, 0.0),
            [lx] => (lx, lx.luminance().powi(2)),
            _ => mean_and_variance(&values),
        };
        Measured { lx, variance }
    }

    /// Light from the lamps of the light tree, given the illuminance `beside` from all others. The
    /// second value is the illuminance that one further ray may bring if no ray has met light, lx.
    fn of_tree(
        &self,
        at: &SurfacePoint,
        (goal, beside): (Goal, Rgb),
        sequence: Sequence,
    ) -> (Measured, f64) {
        let goal_lx = |lx: f64| goal.of(lx + beside.luminance());
        let cut = if goal.is_rough { self.rough_cut(at) } else { self.fine_cut(at) };
        let look = &mut Dice::new(sequence, REPLICATES);
        let teeth = self.teeth(&cut, at, (goal.first_look, goal_lx), look);
        let values = self.replicates(&cut, at, teeth, sequence);
        let is_exact = |teeth: usize| self.asks_all(&cut, teeth) && !self.tree.has_extents();
        let rays = teeth as f64 * f64::from(REPLICATES);
        let unseen_lx = if is_exact(teeth) { 0.0 } else { cut.parts.total / rays };
        let (lx, variance) = mean_and_variance(&values);
        let over = variance.sqrt() / goal_lx(lx.luminance());
        if !goal.insists || variance == 0.0 || over <= MISSED_ERROR_RATIO {
            return (Measured { lx, variance }, unseen_lx);
        }
        // The first look underestimated the spread; these replicates tell more.
        let wanted = teeth as f64 * libm::pow(over, 1.0 / COMB_ORDER);
        let more = wanted.min(MOST_FURTHER_TEETH) as usize;
        let others = self.replicates(&cut, at, more, sequence.fork(REPLICATES, 0));
        // The weights are inverse to the expected variances; evaluating all luminaires has variance zero.
        let weight = libm::pow(over, 2.0);
        let of_first = if is_exact(more) { 0.0 } else { 1.0 / (1.0 + weight) };
        let of_others = 1.0 - of_first;
        let mut both = values;
        both.iter_mut().zip(others).for_each(|(v, other)| *v = *v * of_first + other * of_others);
        let (lx, variance) = mean_and_variance(&both);
        (Measured { lx, variance }, unseen_lx)
    }

    /// Light from all sources outside the light tree. Emitting surfaces among them get the usual
    /// shadow rays in each replicate.
    fn of_others(&self, at: &SurfacePoint, sequence: Sequence) -> Measured {
        let samples = self.area_samples();
        let all = |mut dice: Dice| -> Rgb {
            self.others().map(|s| self.lit_by(s, at, samples, &mut dice)).sum()
        };
        if self.area_sources == 0 {
            return Measured { lx: all(Dice::new(sequence, 0)), variance: 0.0 };
        }
        let of_each: [Rgb; REPLICATES as usize] =
            std::array::from_fn(|replicate| all(Dice::new(sequence, replicate as u32)));
        let (lx, variance) = mean_and_variance(&of_each);
        Measured { lx, variance }
    }

    /// Direct illuminance for a reading, with a safe variance. Errors from few replicates are enlarged by
    /// [`STUDENT_FACTOR`]. If no ray meets light, the variance assumes that the next one would. Emitting surfaces
    /// get as many rays as needed, since few rays meet light that enters through a small opening.
    pub(crate) fn read(&self, at: &SurfacePoint, goal: Goal, sequence: Sequence) -> Measured {
        let (points, tree) = if self.has_many() {
            let points = self.lit_by_points(self.others(), at);
            (points, self.read_tree(at, (goal, points), sequence))
        } else {
            (
                self.lit_by_points(self.sources.iter(), at),
                Measured { lx: Rgb::BLACK, variance: 0.0 },
            )
        };
        let known = points + tree.lx;
        let usual = self.area_samples();
        let finer = (Goal::reading(f64::INFINITY).share / goal.share).clamp(1.0, MOST_FINER_FACTOR);
        let most = (MOST_RAYS_FACTOR * finer) as usize * usual;
        let goal_lx = |of_surfaces: Rgb| goal.of((known + of_surfaces).luminance());
        let which = self.others.iter().copied();
        let surfaces = self.of_surfaces(which, at, goal_lx, [usual, most], sequence);
        Measured { lx: known + surfaces.lx, variance: tree.variance + surfaces.variance }
    }

    fn read_tree(
        &self,
        at: &SurfacePoint,
        (goal, beside): (Goal, Rgb),
        sequence: Sequence,
    ) -> Measured {
        let (Measured { lx, variance }, unseen_lx) = self.of_tree(at, (goal, beside), sequence);
        let variance = if lx.is_black() {
            unseen_lx * unseen_lx
        } else {
            STUDENT_FACTOR * STUDENT_FACTOR * variance
        };
        Measured { lx, variance }
    }

    /// A safe measurement with `shadow_rays` to every emitting surface in total; all other luminaires are evaluated.
    pub(crate) fn read_by_all(
        &self,
        at: &SurfacePoint,
        shadow_rays: u64,
        sequence: Sequence,
    ) -> Measured {
        let each = (shadow_rays / u64::from(REPLICATES)) as usize;
        let samples = each.max(self.area_samples());
        let which = 0..self.sources.len() as u32;
        let surfaces = self.of_surfaces(which, at, |_| f64::INFINITY, [samples; 2], sequence);
        Measured { lx: self.lit_by_points(self.sources.iter(), at) + surfaces.lx, ..surfaces }
    }

    /// Whether evaluating all luminaires takes no more rays than `teeth` in every replicate.
    /// Without faces one evaluation serves all replicates; with faces, which one sample does not
    /// determine, every replicate needs its own.
    fn asks_all(&self, cut: &Cut, teeth: usize) -> bool {
        let looks = if self.tree.has_extents() { 1 } else { REPLICATES as usize };
        looks * teeth >= self.count(cut)
    }

    /// Replicates by combs of `teeth` teeth.
    fn replicates(
        &self,
        cut: &Cut,
        at: &SurfacePoint,
        teeth: usize,
        sequence: Sequence,
    ) -> [Rgb; REPLICATES as usize] {
        let asks_all = self.asks_all(cut, teeth);
        let asks_once = asks_all && !self.tree.has_extents();
        let each = |dice: &mut Dice| self.lit_by_each(cut, at, teeth, dice);
        let of_each = asks_once.then(|| each(&mut Dice::new(sequence, 0)));
        let values = [const { Rgb::BLACK }; REPLICATES as usize];
        let mut replicate = 0;
        values.map(|_| {
            let mut dice = Dice::new(sequence, replicate);
            replicate += 1;
            match of_each {
                Some(of_each) => of_each,
                None if asks_all => each(&mut dice),
                None => self.lit_by_many(cut, at, teeth, &mut dice),
            }
        })
    }

    /// Number of teeth of a replicate that the goal requires, from the spread of a first look.
    fn teeth(
        &self,
        cut: &Cut,
        at: &SurfacePoint,
        (first_look, goal_lx): (usize, impl Fn(f64) -> f64),
        dice: &mut Dice,
    ) -> usize {
        if first_look == 0 || cut.parts.total <= 0.0 {
            return FEWEST_TEETH as usize;
        }
        let total = cut.parts.total;
        // Half of the imaginary rays are dark, half as lit as possible.
        let (mut sum, mut squares) =
            (0.5 * IMAGINARY_RAYS * total, 0.5 * IMAGINARY_RAYS * total * total);
        self.look(cut, at, first_look, dice, |found| {
            let lx = found.luminance();
            sum += lx;
            squares += lx * lx;
        });
        let looks = first_look as f64 + IMAGINARY_RAYS;
        let (lx, square) = (sum / looks, squares / looks);
        let spread_lx = (square - lx * lx).max(0.0).sqrt();
        let error_lx = spread_lx / f64::from(REPLICATES).sqrt();
        libm::pow(error_lx / goal_lx(lx), 1.0 / COMB_ORDER).clamp(FEWEST_TEETH, MOST_TEETH) as usize
    }
}
