//! An independent, unbiased test of a map's error.
//!
//! The error estimates made during a run share elements, rays and rules with the map. The audit shares none
//! of them: places are drawn on the surfaces, the map is read there as users read it, and the illuminance is
//! estimated anew by complete paths ([`super::PathTracer`]). With R independent replicates p_r of the paths
//! at a place, the reading m has the squared error (sum over r != s of (m - p_r)(m - p_s)) / (R (R - 1)).
//! This estimate is unbiased, however noisy the paths are. Its mean over places drawn by area estimates the
//! squared error of the scene, and its spread over the places gives the standard error.
//!
//! The mean square of an error is at least the square of its mean, and at least the mean of the squares of
//! its means over parts of the surface. Noise averages out in these means, so they reveal lost light with far
//! fewer paths than the mean square needs. The three bounds share the allowed probability of a false alarm.
//!
//! A claim is contradicted where the reported error lies below one of these one-sided bounds. A run that goes
//! on after a contradiction may be audited again, [`MOST_AUDITS`] times in all, each time with new places and
//! paths. The allowed probability of a false alarm is divided evenly among these audits, so repeating them
//! does not raise it.

mod compared;
mod energy;
mod figures;
mod places;

use crate::engine::gather::BrightSurfaces;
use crate::engine::light::Lighting;
use crate::engine::method::PathTracer;
use crate::engine::ray::NEVER;
use crate::engine::read::{MapReader, reference_lx};
use crate::map::{Audit, AuditTrust, AuditedPlace, AuditedSurface, IlluminationMap};
use crate::sampling::Key;
use crate::scene::Scene;
use compared::{Compared, Comparison, compare};
pub use energy::energy_balance;
use figures::{Figures, readings, share, tail_index};
pub(super) use figures::{MOST_AUDITS, trend};
use places::{Places, Where};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The number of places compared in parallel, before their rays are counted.
const BATCH: u64 = 64;
/// The relative excess over the reported error that is no contradiction: maps store light in single
/// precision.
const ROUNDING: f64 = f32::EPSILON as f64;
/// The number of worst surfaces and worst places that an audit lists.
const FINDINGS: usize = 8;

/// The extent of an audit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AuditSettings {
    /// The largest number of places; a quarter of them are hard places.
    pub places: u64,
    /// The number of paths at a place, in [`AuditSettings::REPLICATES`] independent replicates.
    pub paths: u32,
    /// The number of rays after which no further places are compared.
    pub most_rays: u64,
    /// The seed of the random numbers.
    pub seed: u64,
    /// The number of this audit in its run, from one.
    pub number: u32,
}

impl AuditSettings {
    /// The number of independent replicates of the paths at a place.
    pub const REPLICATES: u32 = 16;
}

impl Default for AuditSettings {
    /// A thousand places with 64 paths distinguish 2 % from 1 % in a room.
    fn default() -> Self {
        Self { places: 1024, paths: 64, most_rays: u64::MAX, seed: 1, number: 1 }
    }
}

/// Audits a map of a scene. `None` where the map reports no error, where almost nothing of it is known, and
/// where neither map nor paths have light.
pub fn audit(scene: &Scene, map: &IlluminationMap, settings: &AuditSettings) -> Option<Audit> {
    audit_watched(scene, map, settings, &mut |_| {})
}

/// The same; `watch` is told the share of the places that are compared.
pub fn audit_watched(
    scene: &Scene,
    map: &IlluminationMap,
    settings: &AuditSettings,
    watch: &mut dyn FnMut(f64),
) -> Option<Audit> {
    let lighting = Arc::new(Lighting::new(scene));
    let (bright, _) = BrightSurfaces::of(scene, &lighting, map.provenance.seed, &NEVER);
    audit_with((scene, map), (lighting, bright), (settings, watch))
}

/// An audit with prepared luminaires, and with bright surfaces prepared for the seed of the map.
pub(super) fn audit_with<'a>(
    (scene, map): (&'a Scene, &'a IlluminationMap),
    (lighting, bright): (Arc<Lighting<'a>>, Option<Arc<BrightSurfaces>>),
    (settings, watch): (&AuditSettings, &mut dyn FnMut(f64)),
) -> Option<Audit> {
    let told = map.provenance.accuracy?.reached;
    let reader = MapReader::prepared((scene, map), Arc::clone(&lighting), bright);
    let tracer = PathTracer::with_lighting(scene, lighting);
    let key = Key::new(settings.seed).with(u64::from(settings.number)).with(0x0a0d);
    let places = Places::new(scene, map, key)?;
    let (mut all, mut unknown, mut rays) = (Vec::new(), 0, 0);
    let paths_of_place = (AuditSettings::REPLICATES, settings.paths);
    let mut next = 0;
    while next < settings.places && (next == 0 || rays + reader.rays() < settings.most_rays) {
        watch(next as f64 / settings.places as f64);
        let batch = next..settings.places.min(next + BATCH);
        next = batch.end;
        let one = |number: u64| {
            compare(map, (&reader, &tracer), &places.draw(number), paths_of_place, key.with(number))
        };
        let compared: Vec<_> = batch.into_par_iter().map(one).collect();
        for Comparison { compared, by_area, rays: traced_rays } in compared {
            rays += traced_rays;
            unknown += u64::from(compared.is_none() && by_area);
            all.extend(compared);
        }
    }
    let rays = rays + reader.rays();
    let found = Found { scene, map, told, all, unknown, rays, settings: *settings };
    found.audit(tracer.leaves_caustics())
}

/// All comparisons of an audit.
struct Found<'a> {
    scene: &'a Scene,
    map: &'a IlluminationMap,
    told: f64,
    all: Vec<Compared>,
    unknown: u64,
    rays: u64,
    settings: AuditSettings,
}

impl Found<'_> {
    fn of(&self, which: Where) -> impl Iterator<Item = &Compared> {
        self.all.iter().filter(move |c| c.drawn == which)
    }

    /// The illuminance that errors are relative to, lx: that of the map, or of the paths where the map is
    /// dark. `None` where both are dark, or places are few.
    fn reference_lx(&self) -> Option<f64> {
        let traced: Vec<f64> = self.of(Where::ByArea).map(|c| c.traced_lx * c.traced_lx).collect();
        let by_paths = (traced.iter().sum::<f64>() / traced.len().max(1) as f64).sqrt();
        let of_map = reference_lx(self.map);
        let lx = if of_map > 0.0 { of_map } else { by_paths };
        (traced.len() >= figures::FEWEST_OF_PART && lx > 0.0).then_some(lx)
    }

    fn audit(self, leaves_caustics: bool) -> Option<Audit> {
        let reference_lx = self.reference_lx()?;
        let values =
            |of: fn(&Compared) -> f64| -> Vec<f64> { self.of(Where::ByArea).map(of).collect() };
        let errors = Figures::of(&values(|c| c.squared_lx2));
        let interpolated = Figures::of(&values(|c| c.interpolated_lx2));
        let common = Figures::of(&values(Compared::apart_lx));
        let bounds = [
            errors.at_least(),
            common.square_at_least(),
            figures::parts_at_least(self.by_shape().iter().map(|(_, places)| places.as_slice())),
        ];
        let at_least_lx2 = bounds.into_iter().fold(0.0, f64::max);
        let at_least = share(at_least_lx2.sqrt(), reference_lx);
        let paths = self.all.len() as u64 * u64::from(self.settings.paths);
        Some(Audit {
            number: self.settings.number,
            places: self.of(Where::ByArea).count() as u64,
            unknown_places: self.unknown,
            paths,
            rays: self.rays,
            told: self.told,
            error: errors.relative(reference_lx),
            interpolated: interpolated.relative(reference_lx),
            at_least,
            would_find: errors.would_find(self.told, reference_lx),
            would_find_alike: common.would_find_alike(self.told, reference_lx),
            mean_error: share(common.mean, reference_lx),
            mean_error_standard_error: share(common.error, reference_lx),
            readings: readings(self.of(Where::ByArea)),
            hard_readings: readings(self.of(Where::Hard)),
            untested: if leaves_caustics { self.map.caustic_share() } else { 0.0 },
            trust: AuditTrust {
                variance_of_variance: errors.variance_of_variance,
                tail_index: tail_index(self.all.iter().flat_map(|c| c.brightest.iter().copied())),
                // The trend of noise is known of the run alone, so it is taken over from there.
                trend: self.map.provenance.audit.as_ref().and_then(|audit| audit.trust.trend),
            },
            contradicts: at_least > self.told + ROUNDING,
            surfaces: self.surfaces(),
            worst: self.worst(),
        })
    }

    /// The places drawn by area, by shape.
    fn by_shape(&self) -> Vec<(u32, Vec<&Compared>)> {
        let mut shapes: BTreeMap<u32, Vec<&Compared>> = BTreeMap::new();
        for compared in self.of(Where::ByArea) {
            shapes.entry(self.scene.shape_of(compared.at.triangle)).or_default().push(compared);
        }
        shapes.into_iter().collect()
    }

    /// The shapes whose mean error is significant, worst first.
    fn surfaces(&self) -> Vec<AuditedSurface> {
        let mean = |places: &[&Compared], of: fn(&Compared) -> f64| {
            Figures::of(&places.iter().map(|c| of(c)).collect::<Vec<_>>())
        };
        let surface = |(shape, places): (u32, Vec<&Compared>)| {
            let apart = mean(&places, Compared::apart_lx);
            let surface = AuditedSurface {
                shape: self.scene.shape_names()[shape as usize].clone(),
                places: places.len() as u64,
                read_lx: mean(&places, |c| c.read_lx).mean,
                traced_lx: mean(&places, |c| c.traced_lx).mean,
                standard_error_lx: apart.error,
            };
            (apart.is_beyond_doubt() && places.len() >= figures::FEWEST_OF_PART)
                .then_some((places.len() as f64 * apart.mean * apart.mean, surface))
        };
        let mut wrong: Vec<_> = self.by_shape().into_iter().filter_map(surface).collect();
        wrong.sort_by(|a, b| b.0.total_cmp(&a.0));
        wrong.truncate(FINDINGS);
        wrong.into_iter().map(|(_, surface)| surface).collect()
    }

    /// The places where reading and paths differ by most standard errors.
    fn worst(&self) -> Vec<AuditedPlace> {
        let is_far = |c: &&Compared| c.in_errors().abs() > Audit::FAR;
        let mut far: Vec<&Compared> = self.all.iter().filter(is_far).collect();
        far.sort_by(|a, b| b.in_errors().abs().total_cmp(&a.in_errors().abs()));
        far.truncate(FINDINGS);
        far.into_iter().map(|c| self.place(c)).collect()
    }

    fn place(&self, of: &Compared) -> AuditedPlace {
        let shape = self.scene.shape_of(of.at.triangle);
        AuditedPlace {
            shape: self.scene.shape_names()[shape as usize].clone(),
            position: of.at.point.into(),
            read_lx: of.read_lx,
            standard_error_lx: of.standard_error_lx,
            traced_lx: of.traced_lx,
            traced_standard_error_lx: of.traced_variance.sqrt(),
        }
    }
}
