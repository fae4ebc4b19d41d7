//! Direct light: the light that arrives from luminaires without diffuse reflection, straight or by planar mirrors.
//!
//! Every luminaire is a source. So is its image in every planar mirror that it can light, and the image
//! of that image in the next mirror. These virtual luminaires are exact. Particles carry the rest
//! (curved mirrors, glass, gloss, longer chains); they ask [`Lighting::covers`] which light is theirs.

use super::mirrors::planar::Mirrors;
use super::mirrors::twins::Twins;
use super::openings::Openings;
use super::panes::Panes;
use super::sources::{AREA_SAMPLES, FEWEST_AREA_SAMPLES, LuminaireId, Source, SourceKind};
use super::tree::{Images, Tree};
use crate::scene::{Material, Scene};

/// The most sources that are all evaluated at the end of a gathering ray; of more, one is drawn.
pub(super) const MOST_EXACT_SOURCES: usize = 4;

/// The most sources with which gathering rays evaluate direct light at their ends; with more, they read it from the
/// map. In an interior of 14 luminaires and as many images, evaluating them took 68 s of processor time, reading 45
/// s (decision 6).
const MOST_SOURCES_AT_ENDS: usize = 8;

/// The most point sources among which the ends of gathering rays choose without the light tree. With eight, a
/// sports hall takes a fourth less time, but a car park makes its elements anew more often (decision 52).
pub(super) const MOST_POINTS_AT_ENDS: usize = 32;
/// The most point sources that are all evaluated at receivers; of more, the light tree draws some.
const MOST_POINTS_AT_RECEIVERS: usize = 512;

/// The most point sources with which all of them show on glossy surfaces.
const MOST_SHOWN_POINTS: usize = 64;

/// Shadow rays to point sources in one replicate at a receiver, where the light tree draws them.
pub(super) const RAYS_TO_MANY_POINTS: usize = 16;

/// The sources of a scene, prepared for sampling.
pub(crate) struct Lighting<'s> {
    pub(super) scene: &'s Scene,
    pub(super) mirrors: Mirrors,
    pub(super) twins: Twins,
    pub(super) sources: Vec<Source>,
    /// Index of the first source of every luminaire.
    pub(super) starts: Vec<usize>,
    pub(super) leaves_chains: bool,
    pub(super) left_out: f64,
    /// Number of sources with an extent that are not in the light tree, images included.
    pub(super) area_sources: usize,
    pub(super) panes: Panes,
    /// The light tree of point sources and of the faces of emitting surfaces, where they are many.
    pub(super) tree: Tree,
    /// The chains of mirrors by which sources of the light tree have images.
    pub(super) chains: Vec<Vec<u32>>,
    pub(super) images: Images,
    /// Indices of the sources that are not in the light tree.
    pub(super) others: Vec<u32>,
    pub(super) points: usize,
    pub(super) openings: Openings,
    /// Whether all sources are evaluated for a place of a picture.
    pub(super) are_pooled: bool,
}

impl Lighting<'_> {
    /// Number of sources, images included.
    pub(crate) fn source_count(&self) -> usize {
        self.sources.len()
    }

    /// Whether gathering rays read direct light from the map where they end.
    pub(crate) fn are_read_at_ends(&self) -> bool {
        self.source_count() > MOST_SOURCES_AT_ENDS
    }

    /// Whether direct light is measured once for the whole run, exactly or with a known error. It
    /// is if no source with an extent is outside the light tree.
    pub(crate) fn is_measured_once(&self) -> bool {
        self.area_sources == 0
    }

    /// Whether receivers draw from the light tree, because there are many point sources, or lamps with an extent in it.
    pub(crate) fn has_many(&self) -> bool {
        self.points > MOST_POINTS_AT_RECEIVERS || self.tree.has_extents()
    }

    /// Whether there are so many sources that none of them matters alone.
    pub(crate) fn are_countless(&self) -> bool {
        self.sources.len() > MOST_POINTS_AT_RECEIVERS
    }

    /// Whether there is specular transport that the sources do not cover.
    pub(crate) fn leaves_caustics(&self) -> bool {
        self.panes.exist()
            || self.mirrors.leaves_some_out
            || self.leaves_chains
            || self.scene.materials().iter().any(Material::is_glossy)
    }

    /// Bound of the share of all light that neither the sources nor particles bring; zero if there are caustics.
    pub(crate) fn left_out(&self) -> f64 {
        if self.leaves_caustics() { 0.0 } else { self.left_out }
    }

    /// Whether the light of a luminaire after reflection by these planar mirrors in this order is
    /// part of direct light here.
    pub(crate) fn covers(&self, luminaire: LuminaireId, chain: &[u32]) -> bool {
        let number = match luminaire {
            LuminaireId::Luminaire(k) => k as usize,
            LuminaireId::Area(k) => self.scene.luminaires().len() + k as usize,
        };
        chain.is_empty() || image(&self.sources, &self.starts, number, chain).is_some()
    }

    /// Index of the planar mirror that a side of a triangle belongs to.
    pub(crate) fn mirror_of(&self, triangle: u32, back: bool) -> Option<u32> {
        self.mirrors.of(triangle, back)
    }

    /// Whether [`Lighting::sampled`] is free of noise: there are few luminaires, and all are points.
    pub(crate) fn samples_exactly(&self) -> bool {
        self.area_sources == 0 && !self.has_many()
    }

    /// Approximate number of shadow rays of [`Lighting::sampled`] with `samples` to every emitting surface.
    pub(crate) fn rays_of_sampled(&self, samples: usize) -> u64 {
        let points = if self.has_many() { RAYS_TO_MANY_POINTS } else { self.points };
        (points + self.area_sources * samples) as u64
    }

    /// The most shadow rays that [`Lighting::estimate`] takes.
    pub(crate) fn rays_of_estimate(&self) -> u64 {
        let all = self.sources.len();
        if all <= MOST_EXACT_SOURCES { all as u64 } else { 1 }
    }

    pub(super) fn area_samples(&self) -> usize {
        (AREA_SAMPLES / self.area_sources.max(1)).max(FEWEST_AREA_SAMPLES)
    }

    /// Whether there are only a few luminaires, all points, and nothing specular before them. Direct light
    /// then evaluates all of them everywhere, without error.
    pub(crate) fn are_few_points(&self) -> bool {
        let is_plain = |s: &Source| {
            matches!(s.kind, SourceKind::Point { area: None, .. }) && s.chain.is_empty()
        };
        self.sources.len() <= MOST_EXACT_SOURCES
            && self.sources.iter().all(is_plain)
            && !self.panes.exist()
    }

    /// Whether glossy surfaces show point luminaires: there are some, but few, images included.
    pub(crate) fn shows_points(&self) -> bool {
        !self.sources.iter().all(Source::is_area) && self.points <= MOST_SHOWN_POINTS
    }

    /// The sources that are not in the light tree.
    pub(super) fn others(&self) -> impl Iterator<Item = &Source> {
        self.others.iter().map(|&k| &self.sources[k as usize])
    }
}

/// Index of the weight into which a place on the running sum falls; `None` beyond the total.
pub(super) fn drawn(weights: &[f64], place: f64) -> Option<usize> {
    let mut left = place;
    weights.iter().position(|&weight| {
        left -= weight;
        left < 0.0
    })
}

/// Index of the source that is the image of a luminaire by a chain of mirrors. Emitting surfaces
/// have the numbers after those of the other luminaires.
pub(super) fn image(
    sources: &[Source],
    starts: &[usize],
    luminaire: usize,
    chain: &[u32],
) -> Option<usize> {
    let (first, end) = (starts[luminaire], starts[luminaire + 1]);
    sources[first..end].iter().position(|s| s.chain == chain).map(|k| first + k)
}
