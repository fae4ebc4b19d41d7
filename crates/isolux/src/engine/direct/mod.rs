//! Direct light: what arrives from luminaires without diffuse reflection, straight or by planar
//! mirrors.
//!
//! Every luminaire is a source, and so is its image in every planar mirror that it can light, and
//! the image of that image in the next mirror: virtual luminaires, which are exact. What they do not
//! cover (curved mirrors, glass, gloss, longer chains) is left to particles, which ask
//! [`Lighting::covers`].

mod area;
mod mirrors;
mod panes;
mod source;
mod visibility;

use super::path::Dice;
use super::surface::SurfacePoint;
use crate::scene::Scene;
use crate::units::Rgb;
use mirrors::Mirrors;
use panes::Panes;
pub(super) use source::LuminaireId;
use source::{Source, SourceKind, Sources};

/// Sources evaluated one and all at the end of a gathering ray; with more, one of them is drawn.
const EXACT_SOURCES: usize = 4;

/// Samples that all emitting surfaces together get at a receiver in one replicate, and the fewest
/// for one of them.
const AREA_SAMPLES: usize = 64;
const FEWEST_AREA_SAMPLES: usize = 4;

/// All sources of a scene.
pub(super) struct Lighting<'s> {
    scene: &'s Scene,
    mirrors: Mirrors,
    sources: Vec<Source>,
    leaves_chains: bool,
    left_out: f64,
    area_sources: usize,
    panes: Panes,
}

impl<'s> Lighting<'s> {
    /// Prepares the sources of a scene.
    pub(super) fn new(scene: &'s Scene) -> Self {
        let mirrors = Mirrors::find(scene);
        let Sources { all: sources, leaves_chains, left_out } = Sources::of(scene, &mirrors);
        let panes = Panes::find(scene);
        let is_area = |s: &&Source| matches!(s.kind, SourceKind::Area { .. });
        let area_sources = sources.iter().filter(is_area).count();
        Self { scene, mirrors, sources, leaves_chains, left_out, area_sources, panes }
    }

    /// Number of sources, images included.
    pub(super) fn source_count(&self) -> usize {
        self.sources.len()
    }

    /// Whether direct light has an exact value at every point: no emitting surface.
    pub(super) fn is_exact(&self) -> bool {
        self.area_sources == 0
    }

    /// Whether there is specular transport that the sources do not cover.
    pub(super) fn leaves_caustics(&self) -> bool {
        self.panes.exist()
            || self.mirrors.leaves_some_out
            || self.leaves_chains
            || self.scene.materials().iter().any(has_gloss)
    }

    /// Bound of the share of all light that neither sources nor, without caustics, particles bring.
    pub(super) fn left_out(&self) -> f64 {
        if self.leaves_caustics() { 0.0 } else { self.left_out }
    }

    /// Whether the light of a luminaire that was reflected by these planar mirrors in this order
    /// is part of direct light here.
    pub(super) fn covers(&self, luminaire: LuminaireId, chain: &[u32]) -> bool {
        chain.is_empty()
            || self.sources.iter().any(|s| s.luminaire == luminaire && s.chain == chain)
    }

    /// The planar mirror that a side of a triangle belongs to.
    pub(super) fn mirror_of(&self, triangle: u32, back: bool) -> Option<u32> {
        self.mirrors.of(triangle, back)
    }

    /// Direct illuminance from all sources: exact for points and parallel light, sampled for
    /// emitting surfaces.
    pub(super) fn illuminance(&self, at: &SurfacePoint, dice: &mut Dice) -> Rgb {
        let samples = (AREA_SAMPLES / self.area_sources.max(1)).max(FEWEST_AREA_SAMPLES);
        self.sampled(at, samples, dice)
    }

    /// The same with `samples` shadow rays for every emitting surface.
    pub(super) fn sampled(&self, at: &SurfacePoint, samples: usize, dice: &mut Dice) -> Rgb {
        self.sources.iter().map(|source| self.lit_by(source, at, samples, dice)).sum()
    }

    /// An unbiased estimate of the direct illuminance by few shadow rays, for the ends of
    /// gathering rays.
    pub(super) fn estimate(&self, at: &SurfacePoint, dice: &mut Dice) -> Rgb {
        if self.sources.len() <= EXACT_SOURCES {
            return self.sources.iter().map(|s| self.lit_by(s, at, 1, dice)).sum();
        }
        let weight = |source: &Source| {
            let is_in_view = |target| self.chain_is_in_view(source, at, target);
            source::importance(self.scene, source, at, is_in_view)
        };
        let weights: Vec<f64> = self.sources.iter().map(weight).collect();
        let total: f64 = weights.iter().sum();
        if total <= 0.0 {
            return Rgb::BLACK;
        }
        let [pick, _] = dice.pair();
        let mut left = pick * total;
        let drawn = weights.iter().position(|&w| {
            left -= w;
            left < 0.0
        });
        // Rounding may leave a sliver past the last weight.
        let drawn = drawn.or_else(|| weights.iter().rposition(|&w| w > 0.0));
        drawn.map_or(Rgb::BLACK, |k| {
            self.lit_by(&self.sources[k], at, 1, dice) * (total / weights[k])
        })
    }

    fn lit_by(&self, source: &Source, at: &SurfacePoint, samples: usize, dice: &mut Dice) -> Rgb {
        match &source.kind {
            SourceKind::Area { emitter, triangles } => {
                self.lit_by_area(source, emitter, triangles, at, samples, dice)
            }
            _ => self.lit_by_point(source, at),
        }
    }

    fn lit_by_point(&self, source: &Source, at: &SurfacePoint) -> Rgb {
        let Some(arriving) = source::unoccluded(self.scene, source, at) else { return Rgb::BLACK };
        arriving.illuminance_lx * self.visibility(source, at, arriving.target, None)
    }
}

fn has_gloss(material: &crate::scene::Material) -> bool {
    [false, true].iter().any(|&back| material.finish(back).is_some_and(|f| f.gloss.is_some()))
}
