//! How the light at a place depends on reflectances.
//!
//! A path that brings the light `L` after `n` reflections at surfaces of a class has `L` proportional to the `n`-th power of their
//! reflectance. So the derivative of the light with respect to the logarithm of that reflectance is the sum of `n L` over all paths:
//! one estimate tells it for all classes, without differences of noisy results (the score function of Rubinstein 1986, as in
//! perturbation theory of Monte Carlo transport).

use super::PathTracer;
use super::paths::{Brought, Trail};
use crate::engine::ray::{Dice, ProbePoint, place_key};
use crate::engine::read::ExactSettings;
use crate::sampling::Sequence;

/// The light at a place, and how it depends on the reflectance of classes of surfaces, photometric, lx; each replicate apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    /// All light.
    pub illuminance_lx: Vec<f64>,
    /// For each class the change for a relative change of its reflectance, of the whole of it.
    pub by_class_lx: Vec<Vec<f64>>,
}

/// How often each class has reflected the light of a path.
#[derive(Clone)]
struct Reflections<'a> {
    /// The class of every triangle.
    classes: &'a [u32],
    counts: Vec<u16>,
}

impl Trail for Reflections<'_> {
    fn reflected(&self, triangle: u32) -> Self {
        let mut next = self.clone();
        let class = self.classes[triangle as usize] as usize;
        next.counts[class] = next.counts[class].saturating_add(1);
        next
    }
}

impl PathTracer<'_> {
    /// The sensitivity of the light at a point to the diffuse reflectances of `count` classes; `classes` has one for every triangle
    /// of the scene. Caustics of luminaires without surface are left out, as in [`PathTracer::estimate`].
    pub fn sensitivity(
        &self,
        at: ProbePoint,
        (classes, count): (&[u32], usize),
        settings: &ExactSettings,
    ) -> Sensitivity {
        let start = self.start(at);
        let key = place_key(at.position).with(settings.seed);
        let direct_lx = self.direct(&start.surface, settings).lx.luminance();
        let replicates = settings.replicates.max(2);
        let mut found = Sensitivity {
            illuminance_lx: Vec::with_capacity(replicates as usize),
            by_class_lx: vec![Vec::with_capacity(replicates as usize); count],
        };
        for number in 0..replicates {
            let sequence = Sequence::new(key.with(u64::from(number)));
            let (mut all, mut by_class) = (0.0, vec![0.0; count]);
            for index in 0..settings.rays {
                let trail = Reflections { classes, counts: vec![0; count] };
                let mut dice = Dice::new(sequence, index);
                self.path((start, trail), &mut dice, &mut |part: Brought, trail| {
                    let lx = (part.caustic + part.indirect).luminance();
                    all += lx;
                    for (sum, &times) in by_class.iter_mut().zip(&trail.counts) {
                        *sum += f64::from(times) * lx;
                    }
                });
            }
            let share = 1.0 / f64::from(settings.rays.max(1));
            found.illuminance_lx.push(direct_lx + share * all);
            for (sums, sum) in found.by_class_lx.iter_mut().zip(by_class) {
                sums.push(share * sum);
            }
        }
        found
    }
}
