//! The samples of a scene: their positions, their known light, and the making of more.

use super::hemisphere::{Caustic, Hemisphere, Light, Surroundings, TIES_OF_RAY};
use super::layer::{Layer, Site, Tie};
use super::placing::{Place, Radii, serve, serve_all_seen, typical_radius_m};
use super::record::Sum;
use super::{CACHE_REPLICATES, CacheSample, IrradianceCache, SampleKind};
use crate::engine::gather::BrightSurfaces;
use crate::engine::light::Lighting;
use crate::engine::ray::{Deadline, Dice, NEVER, place_key};
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::Point;
use rayon::prelude::*;

/// The least radius of a sample at the vertices of a map, in typical radii of the scene. There are only so
/// many vertices, so it can be small.
pub(super) const LEAST_RADIUS_AT_VERTICES: f64 = 0.01;
/// The least radius of a sample in views, in typical radii. A smaller one would ask for a sample at every
/// pixel along an edge.
pub(super) const LEAST_RADIUS_IN_VIEWS: f64 = 0.1;
/// The least radius of a far sample, in typical radii. Rays read these from afar: on CUBE four times as many
/// samples at its edges bring little.
const LEAST_RADIUS_FAR: f64 = 0.2;

/// The largest radius, in extents of the scene.
const MOST_RADIUS: f64 = 0.5;

/// The relative change at which sweeps over the light between samples end.
const TOLERANCE: f64 = 1e-4;
/// The largest number of these sweeps.
const MAX_SWEEPS: usize = 2000;

/// The largest ratio of successive changes that the extrapolation assumes.
const MOST: f64 = 0.99;

/// The samples of a scene, and the density that they need.
pub(super) struct Store<'s> {
    scene: &'s Scene,
    pub(super) near: Family,
    pub(super) far: Family,
    /// A first guess of the light at far samples.
    guess: Vec<Light>,
}

/// The samples of one kind; the first of them are known.
pub(super) struct Family {
    kind: SampleKind,
    pub(super) layer: Layer,
    pub(super) known: Vec<CacheSample>,
    radii: Radii,
    sums: Vec<Sum>,
}

/// The light of one replicate at all samples of a kind, with its effort.
pub(super) struct Replicate {
    pub(super) lights: Vec<Light>,
    pub(super) rays: u64,
    /// The share of lost rays, mean over the samples traced.
    pub(super) lost: f64,
    /// The last change of the light between samples, root mean square, lx.
    pub(super) unsettled_lx: f64,
}

/// The settings of a replicate.
#[derive(Clone, Copy)]
pub(super) struct Making<'a> {
    /// The number of the replicate.
    pub(super) index: u64,
    /// The number of rays per sample.
    pub(super) rays: u32,
    pub(super) key: Key,
    /// The luminaires. Where they are many, rays read direct light from far samples, too; else they evaluate
    /// it.
    pub(super) lighting: &'a Lighting<'a>,
    pub(super) bright: Option<&'a BrightSurfaces>,
    pub(super) caustic: Caustic<'a>,
    pub(super) deadline: &'a Deadline,
}

impl<'s> Store<'s> {
    /// A store with the samples of a cache. Further samples lie as densely as the allowed error requires,
    /// limited by a least radius.
    pub(super) fn new(
        scene: &'s Scene,
        cache: &IrradianceCache,
        (allowed, least_radius): (f64, f64),
    ) -> Self {
        let bounds = scene.bvh().mesh().bounds();
        let extent_m = bounds.map_or(1.0, |(low, high): (Point, Point)| (high - low).length());
        let most_m = MOST_RADIUS * extent_m;
        let typical_m = typical_radius_m(scene, most_m);
        let family = |kind: SampleKind, least: f64| {
            let radii = Radii { least_m: least * typical_m, most_m };
            let mut layer = Layer::new(scene, allowed);
            let known: Vec<CacheSample> =
                cache.samples.iter().filter(|s| s.kind == kind).cloned().collect();
            known.iter().for_each(|sample| {
                layer.insert(sample.site());
            });
            Family { kind, layer, known, radii, sums: Vec::new() }
        };
        Self {
            scene,
            near: family(SampleKind::Near, least_radius),
            far: family(SampleKind::Far, LEAST_RADIUS_FAR),
            guess: Vec::new(),
        }
    }

    /// Places samples so that these places and all places seen by their rays are served. Returns the number
    /// of rays. Places that come after the deadline stay without.
    pub(super) fn serve(&mut self, places: Vec<Place>, deadline: &Deadline) -> u64 {
        let Self { scene, near, far, .. } = self;
        let (seen, rays) = serve(scene, &mut near.layer, places, (near.radii, deadline));
        rays + serve_all_seen(scene, &mut far.layer, seen, (far.radii, deadline))
    }

    /// The contributions of near samples to a place.
    pub(super) fn ties(&self, place: &Place) -> Vec<Tie> {
        let mut ties = Vec::new();
        self.near.layer.ties(self.scene, (place.origin, place.normal), usize::MAX / 2, &mut ties);
        ties
    }

    /// The contributions of far samples to a place.
    pub(super) fn far_ties(&self, place: &Place) -> Vec<Tie> {
        let mut ties = Vec::new();
        self.far.layer.ties(self.scene, (place.origin, place.normal), TIES_OF_RAY, &mut ties);
        ties
    }

    /// Sets the first guess of the light at far samples, from a replicate that is not counted. Returns the
    /// number of rays.
    pub(super) fn guess(&mut self, making: &Making) -> u64 {
        let Some(seen) = self.look_far(0, making) else { return 0 };
        let mut lights = vec![Light::default(); seen.len()];
        settle(&seen, &mut lights, 0);
        self.guess = lights;
        seen.iter().map(Hemisphere::ray_count).sum()
    }

    /// One replicate of the far samples, with all reflections: the fixed point of the light between them.
    /// `None` if the deadline passes meanwhile.
    pub(super) fn far_replicate(&mut self, making: &Making) -> Option<Replicate> {
        let (mut lights, first) = self.far.start(making.index);
        let seen = self.look_far(first, making)?;
        let guess = self.guess.get(first..).unwrap_or(&[]);
        lights.extend_from_slice(guess);
        lights.resize(first + seen.len(), Light::default());
        let unsettled_lx = settle(&seen, &mut lights, first);
        self.far.add(making.index, &lights);
        Some(Replicate { unsettled_lx, ..Replicate::of(&seen, lights) })
    }

    /// One replicate of the near samples, over one of the far samples. `None` if the deadline passes
    /// meanwhile.
    pub(super) fn near_replicate(&mut self, making: &Making, far: &[Light]) -> Option<Replicate> {
        let (mut lights, first) = self.near.start(making.index);
        let mut whole = Replicate { lights: Vec::new(), rays: 0, lost: 0.0, unsettled_lx: 0.0 };
        let sites = &self.near.layer.sites[first..];
        let mut lost = 0.0;
        for part in sites.chunks(SITES_AT_ONCE) {
            let seen = self.look(part, making)?;
            lights.par_extend(seen.par_iter().map(|s| s.light(far)));
            whole.rays += seen.iter().map(Hemisphere::ray_count).sum::<u64>();
            lost += seen.iter().map(|s| s.lost).sum::<f64>();
        }
        let lost = lost / sites.len().max(1) as f64;
        self.near.add(making.index, &lights);
        Some(Replicate { lights, lost, ..whole })
    }

    /// The next near samples in all replicates, over those of the far samples, and the number of rays. Each
    /// sample is independent of those made before it.
    pub(super) fn make_near<'a>(
        &mut self,
        making: &dyn Fn(u64) -> Making<'a>,
        far: &[Vec<Light>],
    ) -> (Vec<CacheSample>, u64) {
        let wanting = &self.near.layer.sites[self.near.known.len()..];
        let sites = &wanting[..wanting.len().min(SITES_AT_ONCE)];
        let mut sums = vec![Sum::default(); sites.len()];
        let mut rays = 0;
        for (index, far) in (0..).zip(far) {
            let seen = self.look(sites, &making(index));
            let seen = seen.expect("without a deadline nothing is given up");
            let lights: Vec<Light> = seen.par_iter().map(|s| s.light(far)).collect();
            sums.iter_mut().zip(&lights).for_each(|(sum, light)| sum.add(index, light));
            rays += seen.iter().map(Hemisphere::ray_count).sum::<u64>();
        }
        let made: Vec<CacheSample> = sites
            .iter()
            .zip(&sums)
            .filter_map(|(site, sum)| sum.sample(self.near.kind, site))
            .collect();
        self.near.known.extend_from_slice(&made);
        (made, rays)
    }

    /// The light at other places over the far samples, traced anew, and the number of rays.
    pub(super) fn fresh(
        &self,
        places: &[Place],
        making: &Making,
        far: &[Light],
    ) -> (Vec<Rgb>, u64) {
        let site = |p: &Place| Site {
            origin: p.origin,
            normal: p.normal,
            triangle: p.triangle,
            radius_m: f64::INFINITY,
            nearest_m: 0.0,
        };
        let sites: Vec<Site> = places.iter().map(site).collect();
        let never = Making { deadline: &NEVER, ..*making };
        let seen = self.look(&sites, &never).expect("without a deadline nothing is given up");
        let rays = seen.iter().map(Hemisphere::ray_count).sum();
        (seen.par_iter().map(|s| s.light(far).value()).collect(), rays)
    }

    fn look(&self, sites: &[Site], making: &Making) -> Option<Vec<Hemisphere>> {
        let Making { lighting, bright, caustic, .. } = *making;
        let lighting = (!lighting.are_read_at_ends()).then_some(lighting);
        let bright = bright.filter(|_| lighting.is_some());
        let far = &self.far.layer;
        let of = Surroundings { scene: self.scene, far, lighting, bright, caustic };
        let one = |site: &Site| {
            let key = place_key(site.origin).with(making.key.with(making.index).bits());
            let one = || Hemisphere::look(&of, site, making.rays, Sequence::new(key));
            (!making.deadline.has_passed()).then(one)
        };
        sites.par_iter().map(one).collect()
    }

    /// The hemispheres of the far samples, with direct light at the samples where rays read it there.
    fn look_far(&self, first: usize, making: &Making) -> Option<Vec<Hemisphere>> {
        let sites = &self.far.layer.sites[first..];
        let mut seen = self.look(sites, making)?;
        if making.lighting.are_read_at_ends() {
            seen.par_iter_mut().zip(sites).for_each(|(seen, site)| {
                let key = place_key(site.origin).with(making.key.with(making.index).bits());
                let mut dice = Dice::new(Sequence::new(key.with(u64::MAX)), 0);
                seen.own = making.lighting.illuminance(&site.surface(), &mut dice);
            });
        }
        Some(seen)
    }

    /// The samples made since the last call; empty unless all their replicates are complete. They become
    /// known.
    pub(super) fn make_known(&mut self) -> Vec<CacheSample> {
        let mut made = self.far.make_known();
        made.extend(self.near.make_known());
        made
    }
}

/// The number of samples whose rays are in memory at once.
const SITES_AT_ONCE: usize = 1024;

impl Family {
    /// The known light of a replicate, and the number of the first unknown sample.
    fn start(&mut self, index: u64) -> (Vec<Light>, usize) {
        let count = self.layer.sites.len() - self.known.len();
        self.sums.resize(count, Sum::default());
        if index < CACHE_REPLICATES as u64 {
            let lights: Vec<Light> = self.known.iter().map(|s| s.light(index as usize)).collect();
            (lights, self.known.len())
        } else {
            (Vec::new(), 0)
        }
    }

    fn add(&mut self, index: u64, lights: &[Light]) {
        let new = lights.iter().skip(self.known.len());
        self.sums.iter_mut().zip(new).for_each(|(sum, light)| sum.add(index, light));
    }

    /// Whether some samples are not known yet.
    pub(super) const fn is_wanting(&self) -> bool {
        self.known.len() < self.layer.sites.len()
    }

    pub(super) fn make_known(&mut self) -> Vec<CacheSample> {
        let sites = self.layer.sites[self.known.len()..].iter();
        let made: Option<Vec<CacheSample>> =
            sites.zip(&self.sums).map(|(site, sum)| sum.sample(self.kind, site)).collect();
        let made = made.unwrap_or_default();
        if !made.is_empty() {
            self.sums.clear();
            self.known.extend_from_slice(&made);
        }
        made
    }
}

impl Replicate {
    fn of(seen: &[Hemisphere], lights: Vec<Light>) -> Self {
        let rays = seen.iter().map(Hemisphere::ray_count).sum();
        let lost = seen.iter().map(|s| s.lost).sum::<f64>() / seen.len().max(1) as f64;
        Self { lights, rays, lost, unsettled_lx: 0.0 }
    }
}

/// The light of samples from `first` on, given those before: the fixed point of the light between them, from
/// a first guess. Every third sweep extrapolates to the limit of the changes as a geometric series, channel
/// by channel (Aitken 1926). Returns the last change, root mean square, lx.
fn settle(seen: &[Hemisphere], lights: &mut [Light], first: usize) -> f64 {
    let mut unsettled_lx = 0.0;
    let mut before: Option<Vec<Light>> = None;
    for sweep in 0..MAX_SWEEPS {
        let next: Vec<Light> = seen.par_iter().map(|s| s.light(lights)).collect();
        let now = &mut lights[first..];
        let changes: Vec<Light> = next.iter().zip(&*now).map(|(a, b)| minus(a, b)).collect();
        now.copy_from_slice(&next);
        let square = |lights: &[Light]| {
            let squares = lights.iter().map(|l| l.value().luminance()).map(|lx| lx * lx);
            squares.sum::<f64>()
        };
        let changed = square(&changes);
        unsettled_lx = (changed / changes.len().max(1) as f64).sqrt();
        if changed <= TOLERANCE * TOLERANCE * square(now) {
            break;
        }
        match before.take().filter(|_| sweep % 3 == 2) {
            Some(before) => extrapolate(now, &changes, &before),
            None => before = Some(changes),
        }
    }
    unsettled_lx
}

fn minus(a: &Light, b: &Light) -> Light {
    let mut difference = *a;
    for (part, other) in difference.0.iter_mut().zip(&b.0) {
        part.iter_mut().zip(other).for_each(|(c, o)| *c -= o);
    }
    difference
}

/// Adds the sum of all further changes, as a geometric series. Its ratio is that of the last change to the
/// one `before`.
fn extrapolate(lights: &mut [Light], changes: &[Light], before: &[Light]) {
    for channel in 0..3 {
        let product = |a: &[Light], b: &[Light]| -> f64 {
            a.iter().zip(b).map(|(a, b)| a.0[0][channel] * b.0[0][channel]).sum()
        };
        let factor = product(changes, before) / product(before, before);
        let factor = if factor > 0.0 { factor.min(MOST) } else { 0.0 };
        let further = factor / (1.0 - factor);
        for (light, change) in lights.iter_mut().zip(changes) {
            for (part, change) in light.0.iter_mut().zip(&change.0) {
                part[channel] += further * change[channel];
            }
        }
    }
}
