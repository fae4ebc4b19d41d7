//! How many rays the pilot spends where, and what it tries to tell how many increments will take.

use super::Pilot;
use super::look::Look;
use crate::elements::Subdivision;
use crate::engine::gather::{Gatherer, Trial, allot, known_at, ray_trial};
use crate::engine::judge::BELIEVED_INCREMENTS;
use crate::engine::particle::CausticNoise;
use crate::engine::ray::{Dice, SurfacePoint};
use crate::sampling::Sequence;
use rayon::prelude::*;
use std::time::{Duration, Instant};

impl Pilot<'_> {
    /// Rays of the vertices in the pilot: so many where a surface has no more vertices than others for its area, fewer where it
    /// has (see [`allot`]), a quarter of them at least.
    pub(super) fn shared_rays(subdivision: &Subdivision, target: f64) -> Vec<u32> {
        let usual = pilot_rays(target);
        let surfaces = subdivision.least_connected();
        let mut of_surface = vec![(0.0, 0.0); surfaces.len()];
        for leaf in subdivision.leaves() {
            let surface = surfaces[subdivision.node(leaf).0.vertices[0] as usize];
            of_surface[surface as usize].0 += subdivision.triangle(leaf).area();
        }
        surfaces.iter().for_each(|&surface| of_surface[surface as usize].1 += 1.0);
        let area_m2 = |&surface: &u32| {
            let (area_m2, vertices) = of_surface[surface as usize];
            area_m2 / vertices
        };
        let areas_m2: Vec<f64> = surfaces.iter().map(area_m2).collect();
        let allotted = allot(&areas_m2, f64::from(usual));
        allotted
            .into_iter()
            .map(|rays| if rays == 0 { usual } else { rays.clamp(usual / 4, usual) })
            .collect()
    }

    /// Tries how noisy gathered light is.
    pub(super) fn try_some(&mut self, look: &Look, target: f64) {
        let vertices = look.elements.vertices();
        let carries = |&v: &usize| self.standings[v].is_some() && self.carriers.is_active(v as u32);
        let all: Vec<usize> = (0..vertices.len()).filter(carries).collect();
        let every = all.len().div_ceil(ray_trial::RECEIVERS).max(1);
        let gatherers = self.gatherers();
        self.look_at_walls_again(&look.elements, target);
        let some = all.into_iter().step_by(every);
        let some: Vec<(Gatherer, f64)> = some
            .map(|v| (self.before_walls(v as u32, gatherers[v]), vertices[v].area_m2))
            .collect();
        let gathering = self.gathering(&look.elements, u32::MAX, &self.standings);
        let wanted = (target, look.reference_lx, BELIEVED_INCREMENTS, self.key.with(6));
        let started = Instant::now();
        let (trial, rays) = Trial::of(&gathering, &some, &self.indirect, wanted, self.trial);
        self.costs.tried.add(started.elapsed(), rays as f64);
        if !self.lighting.is_measured_once() {
            self.costs.again.add(self.measures_again(&some), some.len() as f64);
        }
        self.trial = Some(trial);
        self.traced += rays;
        let areas_m2: Vec<f64> = vertices.iter().map(|v| v.area_m2).collect();
        let read = |at: &SurfacePoint| known_at(&look.elements, u32::MAX, &self.standings, at);
        let of = (self.scene, self.lighting);
        let (noise, aim, rays) = CausticNoise::tried(of, &areas_m2, read, self.key.with(7));
        self.caustic_noise = noise;
        self.aim = aim;
        self.traced += rays;
    }

    /// How long it takes to measure direct light of some vertices once more.
    fn measures_again(&self, some: &[(Gatherer, f64)]) -> Duration {
        let (started, sequence) = (Instant::now(), Sequence::new(self.key.with(1)));
        some.par_iter().for_each(|(of, _)| {
            std::hint::black_box(
                self.lighting.illuminance(&of.surface, &mut Dice::new(sequence, 0)),
            );
        });
        started.elapsed()
    }

    /// New vertices gather as their parents do.
    pub(super) fn complete_rays(&mut self) {
        for vertex in &self.subdivision.vertices()[self.rays.len()..] {
            let [parent, _] =
                vertex.parents.expect("vertices beyond the first are made by bisection");
            self.rays.push(self.rays[parent as usize]);
        }
    }
}

/// Rays of a receiver in the pilot: more for finer accuracies, so that their noise stays below the
/// details looked for. The power of two nearest to what was measured on CUBE: with half as many, elements are made
/// anew for 0.3 %.
fn pilot_rays(target: f64) -> u32 {
    let wanted = (0.64 / target.max(1e-6)).clamp(32.0, 1024.0);
    libm::exp2(libm::round(libm::log2(wanted))) as u32
}
