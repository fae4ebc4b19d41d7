//! The state of a reader, and the parts that its readings consist of.

use super::effort::{FRESH_FEWEST_RAYS, FRESH_MOST_RAYS, FRESH_REPLICATES, Needed};
use super::shared_noise::SharedNoise;
use super::told::Allowance;
use crate::elements::Element;
use crate::engine::gather::{BrightSurfaces, ControlVariate, DirectAtEnds, Gatherer, Gathering};
use crate::engine::judge::Light;
use crate::engine::light::{Goal, Lighting, Measured, Patches};
use crate::engine::occlusion::{Barriers, nearby};
use crate::engine::ray::{Places, ProbePoint, SurfacePoint, mean_and_variance, place_key};
use crate::map::{Accuracy, Fresh, Illuminance, IlluminationMap, Standing};
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use crate::units::Rgb;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// The smallest illuminance that the noise goal of direct light is relative to, as a share of the local
/// part of the reference illuminance.
const DIMMEST: f64 = 0.05;

/// The noise of gathered light in readings, in errors of the map. It adds about half of the squared error,
/// and only where the map is not trusted.
pub(super) const FRESH_NOISE: f64 = 0.7;

/// The order of convergence of low-discrepancy rays from a few on, where something is close: noise falls like
/// this power of 1/n. With the 0.85 of places in the open, readings of SPHERE had a quarter more error than
/// with a trial of twice the rays.
const ORDER_CLOSE_BY: f64 = 0.75;

/// A reader of a map, with the map's scene.
pub struct MapReader<'a> {
    pub(super) scene: &'a Scene,
    pub(super) map: &'a IlluminationMap,
    pub(super) lighting: Arc<Lighting<'a>>,
    pub(super) standings: Vec<Option<Standing>>,
    pub(super) light: Vec<Rgb>,
    pub(super) at_ends: StoredDirect,
    pub(super) bright: Option<Arc<BrightSurfaces>>,
    /// Elements that something stands across.
    pub(super) cuts: Barriers,
    pub(super) places: Places<'a>,
    /// The control variate for gathering rays.
    pub(crate) backdrop: Option<ControlVariate>,
    pub(super) patches: Patches,
    pub(super) unseen: Unseen,
    pub(super) local: LocalFactors,
    pub(super) shared_noise: SharedNoise,
    /// The number of rays that readings have used.
    pub(super) rays: AtomicU64,
}

/// Direct light of the map as rays read it where they end.
pub(super) struct StoredDirect {
    /// Direct light at the vertices where sources are many; rays read it there.
    pub(super) values: Option<Vec<Rgb>>,
    /// Elements on which direct light varies between vertices, by node.
    pub(super) varying: Option<Vec<bool>>,
}

/// Factors on errors of the scene that make them errors of a place.
pub(super) struct LocalFactors {
    /// The local factor on errors of the scene, at every vertex.
    pub(super) of_vertices: Vec<Rgb>,
    /// The root mean square of that factor in arriving light.
    pub(super) arriving: f64,
}

/// Light gathered by replicates.
pub(super) struct Gathered {
    pub(super) lx: Rgb,
    /// The variance of the mean, lx2.
    pub(super) variance: f64,
    /// The share of a unit of light that was still read close by.
    pub(super) close: f64,
    /// The standard error that it shares with light gathered nearby, lx.
    pub(super) common_lx: f64,
}

/// Errors of light read from vertices that replicates do not show, lx.
pub(super) struct Unseen {
    /// The illuminance that errors of the map are relative to ([`reference_lx`]).
    pub(super) reference_lx: f64,
    /// The interpolation error, root mean square over the scene.
    pub(super) discretization_lx: f64,
    /// The bias that all of the map shares.
    pub(super) bias_lx: f64,
    /// The error of the whole map; infinite where it is not known. The fewest rays are then enough, as nothing is told of
    /// their noise.
    pub(super) reached_lx: f64,
    /// The accuracy goal for direct light in readings.
    pub(super) of_direct: Goal,
}

impl<'a> MapReader<'a> {
    /// A reading, with infinite errors if the error of the map is unknown.
    pub(super) fn told(&self, reading: Illuminance) -> Illuminance {
        match self.map.provenance.accuracy {
            Some(_) => reading,
            None => Illuminance {
                standard_error_lx: f64::INFINITY,
                indirect_standard_error_lx: f64::INFINITY,
                ..reading
            },
        }
    }

    /// Whether the map's value is trusted at a place on an element with these edges.
    pub(super) fn is_trusted(
        &self,
        (fresh, allowance): (Fresh, Allowance),
        stored: &Illuminance,
        (at, edge_m): (&SurfacePoint, f64),
    ) -> bool {
        if stored.standing != Standing::Open
            || stored.interpolation_error_lx > allowance.trusted_lx(fresh, stored)
        {
            return false;
        }
        match fresh.in_gaps_alone {
            true => !nearby::is_closed_in(self.scene, at, edge_m),
            false => !nearby::is_beset(self.scene, at, edge_m),
        }
    }

    /// A value of the map with its expected interpolation error. Half of the squared error of the scene is
    /// taken to be spread evenly, half as the elements expect.
    pub(super) fn with_interpolation_error(&self, stored: Illuminance, part: f64) -> Illuminance {
        let (even, own) = (part * self.unseen.discretization_lx, stored.interpolation_error_lx);
        let interpolation_error_lx = (0.5 * (even * even + own * own)).sqrt();
        Illuminance { interpolation_error_lx, ..stored }
    }

    /// The number of rays of preparation and of readings so far. Each is counted with as many shadow rays at
    /// its end as there may be.
    pub(crate) fn rays(&self) -> u64 {
        self.rays.load(Ordering::Relaxed)
    }

    pub(super) fn count(&self, rays: u64) {
        self.rays.fetch_add(rays, Ordering::Relaxed);
    }

    /// The key of the random numbers for a place. Each seed of the map has its own, so readings of several
    /// maps have independent errors.
    pub(super) fn gathering_key(&self, at: &Gatherer) -> Key {
        place_key(at.surface.point).with(7).with(self.map.provenance.seed)
    }

    pub(super) fn direct_at_ends(&self) -> DirectAtEnds<'_> {
        match &self.at_ends.values {
            Some(values) => {
                DirectAtEnds::ReadFarOff { values, varying: self.at_ends.varying.as_deref() }
            }
            None => DirectAtEnds::Evaluated,
        }
    }

    /// The number of rays per replicate that reaches the noise goal in lux, from a trial that is then discarded.
    pub(super) fn rays_needed(&self, trial: Gatherer, goal: f64, key: Key) -> Needed {
        let of_trial = (FRESH_REPLICATES, key.with(0));
        let Gathered { variance, .. } = self.gather(trial, self.direct_at_ends(), of_trial);
        let tried = f64::from(trial.rays);
        let rays = tried * times_rays(variance, goal);
        let rays = libm::log2(rays.clamp(FRESH_FEWEST_RAYS.max(tried), FRESH_MOST_RAYS));
        let rays: u32 = 1 << libm::round(rays) as u32;
        let finer = tried / f64::from(rays);
        Needed { rays, variance: variance * libm::pow(finer, 2.0 * ORDER_CLOSE_BY) }
    }

    /// The noise goal of indirect light in readings, lx: a share of the error of the map times a local factor.
    pub(super) fn noise_goal_lx(&self, part: f64) -> f64 {
        match self.unseen.reached_lx {
            f64::INFINITY => f64::INFINITY,
            reached_lx => FRESH_NOISE * part * reached_lx,
        }
    }

    /// The gatherer with the control variate of its place.
    pub(super) fn before_walls(&self, gatherer: Gatherer) -> Gatherer {
        let behind = self.backdrop.as_ref().and_then(|b| b.behind(self.scene, &gatherer.stand()));
        Gatherer { behind, ..gatherer }
    }

    pub(super) fn gathering<'b>(&'b self, direct: DirectAtEnds<'b>) -> Gathering<'b> {
        Gathering {
            scene: self.scene,
            lighting: &self.lighting,
            elements: &self.map.elements,
            level: u32::MAX,
            standings: &self.standings,
            direct,
            regathers: true,
            bright: self.bright.as_deref(),
            cuts: Some(&self.cuts),
            backdrop: self.backdrop.as_ref(),
        }
    }

    /// Light gathered by this number of replicates.
    pub(super) fn gather(
        &self,
        gatherer: Gatherer,
        direct: DirectAtEnds<'_>,
        (replicates, key): (u32, Key),
    ) -> Gathered {
        let shadow_rays = match direct {
            DirectAtEnds::Read { .. } => 0,
            _ => self.lighting.rays_of_estimate(),
        };
        let gathering = self.gathering(direct);
        let rows = vec![gatherer; replicates as usize];
        let operator = gathering.operator(&rows, |k| key.with(k as u64));
        self.count(operator.rays * (1 + shadow_rays));
        let (lx, variance) = mean_and_variance(&operator.apply(&self.light));
        let close = operator.close().sum::<f64>() / f64::from(replicates);
        let common_lx = self.shared_noise.lx(self.map, &gatherer.surface, &operator);
        Gathered { lx, variance, close, common_lx }
    }

    /// The surface at a point that carries the map.
    pub(super) fn find_surface(&self, at: ProbePoint) -> Option<SurfacePoint> {
        self.places.surface_at(at, |surface| {
            let SurfacePoint { triangle, back, u, v, .. } = *surface;
            self.map.elements.locate(triangle, back, u, v).is_some()
        })
    }

    /// The error of indirect light, lx, from replicates, interpolation and bias.
    pub(super) fn indirect_error_lx(read: &Illuminance) -> f64 {
        let unseen = libm::hypot(read.interpolation_error_lx, read.bias_lx);
        libm::hypot(read.indirect_standard_error_lx, unseen)
    }

    pub(super) fn with_fresh_direct(
        &self,
        stored: Illuminance,
        (at, part): (&SurfacePoint, f64),
    ) -> Illuminance {
        let direct = self.direct(at, (stored.illuminance_lx(), part));
        let indirect = Self::indirect_error_lx(&stored);
        Illuminance {
            direct_lx: direct.lx + stored.caustic_lx,
            standard_error_lx: (indirect * indirect + direct.variance).sqrt(),
            indirect_standard_error_lx: indirect,
            ..stored
        }
    }

    /// Direct light with the variance of its mean, at a place with about `about_lx` of light in all and the
    /// local factor `part`.
    pub(super) fn direct(&self, at: &SurfacePoint, (about_lx, part): (f64, f64)) -> Measured {
        let of_direct = self.unseen.of_direct;
        // With many luminaires, the goal is relative to their own light alone.
        let least_lx = match self.lighting.has_many() {
            true => 0.0,
            false => about_lx.max(DIMMEST * part * self.unseen.reference_lx),
        };
        let goal = Goal { lx: of_direct.share * least_lx, ..of_direct };
        let sequence = Sequence::new(place_key(at.point).with(0).with(self.map.provenance.seed));
        self.lighting.read(at, goal, sequence)
    }

    /// The centroid of an element as a gatherer, and the area of the element, m2.
    pub(super) fn amid(&self, element: &Element) -> (Gatherer, f64) {
        let [a, b, c] = element.vertices.map(|v| self.map.elements.vertices()[v as usize].position);
        let middle = a + ((b - a) + (c - a)) * (1.0 / 3.0);
        let [u, v] = self.scene.triangle(element.triangle).barycentric(middle);
        let at = SurfacePoint::new(self.scene, element.triangle, element.back, u, v);
        (Gatherer::on_surface(at, 0), 0.5 * (b - a).cross(c - a).length())
    }
}

/// The factor on the number of rays that brings a variance to the square of a noise goal.
pub(super) fn times_rays(variance: f64, goal: f64) -> f64 {
    libm::pow(variance / (goal * goal).max(f64::MIN_POSITIVE), 0.5 / ORDER_CLOSE_BY)
}

impl Unseen {
    /// The errors that the map reports, as shares of the reference illuminance; each place takes its local
    /// factor of them. (In proportion to the local indirect light fewer intervals hold the truth, since dark
    /// edges err most.)
    pub(super) fn of(map: &IlluminationMap) -> Self {
        let reference_lx = reference_lx(map);
        let accuracy = map.provenance.accuracy.as_ref();
        let share = |part: fn(&Accuracy) -> f64| accuracy.map_or(0.0, |a| part(a) * reference_lx);
        Self {
            reference_lx,
            discretization_lx: share(Accuracy::discretization_beside_caustics),
            bias_lx: share(|a| a.bias),
            reached_lx: accuracy.map_or(f64::INFINITY, |a| a.reached * reference_lx),
            of_direct: Goal::reading(map.provenance.accuracy_target.unwrap_or(f64::INFINITY)),
        }
    }
}

/// The illuminance that errors of a map are relative to, lx: the root mean square of its light over the
/// surface, but at most twice the mean over the lit area. A small bright surface is part of both.
pub fn reference_lx(map: &IlluminationMap) -> f64 {
    let mut light = Light::default();
    let ambient_lx = map.ambient_lx().luminance();
    for (vertex, value) in map.elements.vertices().iter().zip(&map.values) {
        let Some(value) = value else { continue };
        light.add(vertex.area_m2, value.illuminance_lx() + ambient_lx);
    }
    light.reference_lx()
}
