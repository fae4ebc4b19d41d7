//! Direct light by a fixed number of shadow rays, to all sources or to one that is drawn.

use super::super::lighting::{Lighting, MOST_EXACT_SOURCES, RAYS_TO_MANY_POINTS, drawn};
use super::super::sources;
use super::super::sources::{Arriving, Source};
use super::super::visibility::shadows::Shadows;
use super::super::visibility::straight::segment;
use crate::engine::ray::{Dice, SurfacePoint};
use crate::units::Rgb;

impl Lighting<'_> {
    /// Direct illuminance from all sources: exact for parallel light, and for points where they are
    /// few; sampled for emitting surfaces.
    pub(crate) fn illuminance(&self, at: &SurfacePoint, dice: &mut Dice) -> Rgb {
        self.sampled(at, self.area_samples(), dice)
    }

    /// Direct illuminance from all sources, with `samples` shadow rays for every emitting surface.
    pub(crate) fn sampled(&self, at: &SurfacePoint, samples: usize, dice: &mut Dice) -> Rgb {
        self.sampled_again(at, samples)(dice)
    }

    /// [`Lighting::sampled`] for repeated estimates at one place.
    pub(crate) fn sampled_again<'d>(
        &'d self,
        at: &'d SurfacePoint,
        samples: usize,
    ) -> impl Fn(&mut Dice) -> Rgb + 'd {
        let cut = self.has_many().then(|| self.fine_cut(at));
        move |dice| match &cut {
            Some(cut) => self.lit_by_cut(cut, at, (RAYS_TO_MANY_POINTS, samples), dice),
            None => self.by_all(at, samples, dice),
        }
    }

    /// An unbiased estimate of the direct illuminance by few shadow rays, for the ends of gathering rays.
    pub(crate) fn estimate(&self, at: &SurfacePoint, dice: &mut Dice) -> Rgb {
        if self.sources.len() <= MOST_EXACT_SOURCES {
            return self.sources.iter().map(|s| self.lit_by(s, at, 1, dice)).sum();
        }
        let cut = (!self.tree.lamps.is_empty()).then(|| self.rough_cut(at));
        let of_tree = cut.as_ref().map_or(0.0, |cut| cut.parts.total);
        let weights = self.weights_of_others(at);
        let total: f64 = of_tree + weights.iter().sum::<f64>();
        if total <= 0.0 {
            return Rgb::BLACK;
        }
        let [pick, _] = dice.pair();
        let left = pick * total - of_tree;
        if let Some(cut) = cut.filter(|_| left < 0.0) {
            return self.lit_by_many(&cut, at, 1, dice) * (total / of_tree);
        }
        self.lit_by_drawn(&weights, (left, total), at, dice)
    }

    /// An unbiased estimate of the direct illuminance from the sources that are not in the light tree.
    pub(crate) fn estimate_of_others(&self, at: &SurfacePoint, dice: &mut Dice) -> Rgb {
        let weights = self.weights_of_others(at);
        let total: f64 = weights.iter().sum();
        if total <= 0.0 {
            return Rgb::BLACK;
        }
        let [pick, _] = dice.pair();
        self.lit_by_drawn(&weights, (pick * total, total), at, dice)
    }

    fn weights_of_others(&self, at: &SurfacePoint) -> Vec<f64> {
        let weight = |source: &Source| {
            let is_in_view = |target| self.chain_is_in_view(&source.chain, at, target);
            sources::importance(self.scene, source, at, is_in_view)
        };
        self.others().map(weight).collect()
    }

    /// An estimate of all light of the sources outside the light tree, from the one at `place` on
    /// the sum of their weights.
    fn lit_by_drawn(
        &self,
        weights: &[f64],
        (place, total): (f64, f64),
        at: &SurfacePoint,
        dice: &mut Dice,
    ) -> Rgb {
        let drawn = drawn(weights, place);
        // Rounding may leave a remainder past the last weight.
        let drawn = drawn.or_else(|| weights.iter().rposition(|&w| w > 0.0));
        drawn.zip(self.others().nth(drawn.unwrap_or(0))).map_or(Rgb::BLACK, |(k, source)| {
            self.lit_by(source, at, 1, dice) * (total / weights[k])
        })
    }

    /// The estimate times `share`, without the light whose shadow rays are added to `shadows` and traced later.
    pub(crate) fn estimate_later(
        &self,
        at: &SurfacePoint,
        share: Rgb,
        dice: &mut Dice,
        shadows: &mut Shadows,
    ) -> Rgb {
        if self.sources.len() > MOST_EXACT_SOURCES {
            return share * self.estimate(at, dice);
        }
        let mut sum = Rgb::BLACK;
        for source in &self.sources {
            if !source.chain.is_empty() || source.has_extent() {
                sum += share * self.lit_by(source, at, 1, dice);
            } else if let Some(arriving) = sources::unoccluded_if(self.scene, source, at, |_| true)
            {
                let Arriving { target, illuminance_lx } = arriving;
                shadows.ask(segment(at, target), target, share * illuminance_lx);
            }
        }
        sum
    }

    /// The light of all rays in `shadows` that arrives.
    pub(crate) fn answer(&self, shadows: &mut Shadows) -> Rgb {
        let free = shadows.free(self.scene.bvh());
        free.map(|free| free.light * self.through_glass(free.ray, free.target)).sum()
    }
}
