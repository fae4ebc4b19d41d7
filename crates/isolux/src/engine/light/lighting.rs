//! Direct light: what arrives from luminaires without diffuse reflection, straight or by planar
//! mirrors.
//!
//! Every luminaire is a source, and so is its image in every planar mirror that it can light, and
//! the image of that image in the next mirror: virtual luminaires, which are exact. What they do not
//! cover (curved mirrors, glass, gloss, longer chains) is left to particles, which ask
//! [`Lighting::covers`].

use super::mirrors::planar::Mirrors;
use super::mirrors::twins::Twins;
use super::openings::Openings;
use super::panes::Panes;
use super::sources::{LuminaireId, Source, SourceKind};
use super::tree::{Images, Tree};
use crate::scene::{Material, Scene};

/// Sources evaluated one and all at the end of a gathering ray; with more, one of them is drawn.
pub(super) const EXACT_SOURCES: usize = 4;

/// With more sources than this, gathering rays read direct light from the map where they end.
const MOST_EVALUATED_AT_ENDS: usize = 8;

/// Points among the sources from which on they are drawn by their tree at the ends of gathering rays,
/// and at receivers.
pub(super) const DRAWN_AT_ENDS: usize = 32;
const DRAWN_AT_RECEIVERS: usize = 512;

/// Points among the sources up to which all of them show on glossy surfaces.
const MOST_SHOWN: usize = 64;

/// Shadow rays to points in one replicate at a receiver, where they are many.
pub(super) const RAYS_TO_MANY: usize = 16;

/// Samples that all emitting surfaces together get at a receiver in one replicate, and the fewest
/// for one of them.
const AREA_SAMPLES: usize = 64;
const FEWEST_AREA_SAMPLES: usize = 4;

/// All sources of a scene.
pub(crate) struct Lighting<'s> {
    pub(super) scene: &'s Scene,
    pub(super) mirrors: Mirrors,
    pub(super) twins: Twins,
    pub(super) sources: Vec<Source>,
    /// Where those of every luminaire start.
    pub(super) starts: Vec<usize>,
    pub(super) leaves_chains: bool,
    pub(super) left_out: f64,
    /// Emitting surfaces that are not in the tree, and their images.
    pub(super) area_sources: usize,
    pub(super) panes: Panes,
    /// The sources that are points and the faces of emitting surfaces, where they are many, by luminaire and chain.
    pub(super) tree: Tree,
    pub(super) chains: Vec<Vec<u32>>,
    pub(super) images: Images,
    /// The ones that are not in the tree.
    pub(super) others: Vec<u32>,
    pub(super) points: usize,
    pub(super) openings: Openings,
}

impl Lighting<'_> {
    /// Number of sources, images included.
    pub(crate) fn source_count(&self) -> usize {
        self.sources.len()
    }

    /// Whether rays read direct light from the map where they end.
    pub(crate) fn are_read_at_ends(&self) -> bool {
        self.source_count() > MOST_EVALUATED_AT_ENDS
    }

    /// Whether direct light is measured once for all, exactly or with a known error: no emitting surface, or they are so many that
    /// they are chosen among.
    pub(crate) fn is_measured_once(&self) -> bool {
        self.area_sources == 0
    }

    /// Whether some luminaires are chosen to be looked at, among many.
    pub(crate) fn has_many(&self) -> bool {
        self.points > DRAWN_AT_RECEIVERS || self.has_faces()
    }

    /// Whether luminaires are so many that none of them matters alone.
    pub(crate) fn are_countless(&self) -> bool {
        self.sources.len() > DRAWN_AT_RECEIVERS
    }

    /// Whether emitting surfaces are among what is chosen from.
    pub(crate) fn has_faces(&self) -> bool {
        !self.tree.faces.is_empty()
    }

    /// Whether there is specular transport that the sources do not cover.
    pub(crate) fn leaves_caustics(&self) -> bool {
        self.panes.exist()
            || self.mirrors.leaves_some_out
            || self.leaves_chains
            || self.scene.materials().iter().any(Material::is_glossy)
    }

    /// Bound of the share of all light that neither sources nor, without caustics, particles bring.
    pub(crate) fn left_out(&self) -> f64 {
        if self.leaves_caustics() { 0.0 } else { self.left_out }
    }

    /// Whether the light of a luminaire that was reflected by these planar mirrors in this order
    /// is part of direct light here.
    pub(crate) fn covers(&self, luminaire: LuminaireId, chain: &[u32]) -> bool {
        let number = match luminaire {
            LuminaireId::Luminaire(k) => k as usize,
            LuminaireId::Area(k) => self.scene.luminaires().len() + k as usize,
        };
        chain.is_empty() || image(&self.sources, &self.starts, number, chain).is_some()
    }

    /// The planar mirror that a side of a triangle belongs to.
    pub(crate) fn mirror_of(&self, triangle: u32, back: bool) -> Option<u32> {
        self.mirrors.of(triangle, back)
    }

    /// Whether [`Lighting::sampled`] is free of noise: few luminaires, none of which is an emitting surface.
    pub(crate) fn samples_exactly(&self) -> bool {
        self.area_sources == 0 && !self.has_many()
    }

    /// Shadow rays that [`Lighting::sampled`] takes with so many to every emitting surface, about.
    pub(crate) fn rays_of_sampled(&self, samples: usize) -> u64 {
        let points = if self.has_many() { RAYS_TO_MANY } else { self.points };
        (points + self.area_sources * samples) as u64
    }

    /// Shadow rays that [`Lighting::estimate`] takes at most.
    pub(crate) fn rays_of_estimate(&self) -> u64 {
        let all = self.sources.len();
        if all <= EXACT_SOURCES { all as u64 } else { 1 }
    }

    pub(super) fn area_samples(&self) -> usize {
        (AREA_SAMPLES / self.area_sources.max(1)).max(FEWEST_AREA_SAMPLES)
    }

    /// Whether there are only a few luminaires without surface and nothing specular before them: all are asked wherever direct light
    /// is, and exactly what they send out arrives.
    pub(crate) fn are_few_points(&self) -> bool {
        let is_plain =
            |s: &Source| matches!(s.kind, SourceKind::Point { .. }) && s.chain.is_empty();
        self.sources.len() <= EXACT_SOURCES
            && self.sources.iter().all(is_plain)
            && !self.panes.exist()
    }

    /// Whether there are luminaires without surface, and so few, images counted, that glossy surfaces show them.
    pub(crate) fn shows_points(&self) -> bool {
        !self.sources.iter().all(Source::is_area) && self.points <= MOST_SHOWN
    }

    /// The sources that are not in the tree.
    pub(super) fn others(&self) -> impl Iterator<Item = &Source> {
        self.others.iter().map(|&k| &self.sources[k as usize])
    }
}

/// Which of some weights a place in their sum falls to; none beyond it.
pub(super) fn drawn(weights: &[f64], place: f64) -> Option<usize> {
    let mut left = place;
    weights.iter().position(|&weight| {
        left -= weight;
        left < 0.0
    })
}

/// The source that is the image of a luminaire by a chain of mirrors; emitting surfaces are counted
/// after the luminaires without.
pub(super) fn image(
    sources: &[Source],
    starts: &[usize],
    luminaire: usize,
    chain: &[u32],
) -> Option<usize> {
    let (first, end) = (starts[luminaire], starts[luminaire + 1]);
    sources[first..end].iter().position(|s| s.chain == chain).map(|k| first + k)
}
