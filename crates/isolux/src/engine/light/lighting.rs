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
use super::sources::triangle_lamps::faces;
use super::sources::{self, LuminaireId, Source, SourceKind, Sources, Target};
use super::tree::{Images, Tree};
use crate::engine::ray::{Dice, SurfacePoint};
use crate::scene::{Material, Scene};
use crate::units::Rgb;
use isolux_geometry::Direction;
use std::collections::{BTreeSet, HashSet};

/// Sources evaluated one and all at the end of a gathering ray; with more, one of them is drawn.
pub(super) const EXACT_SOURCES: usize = 4;

/// With more sources than this, gathering rays read direct light from the map where they end.
const MOST_EVALUATED_AT_ENDS: usize = 8;

/// Points among the sources from which on they are drawn by their tree at the ends of gathering rays,
/// and at receivers.
const DRAWN_AT_ENDS: usize = 32;
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

impl<'s> Lighting<'s> {
    /// Prepares the sources of a scene.
    pub(crate) fn new(scene: &'s Scene) -> Self {
        let mirrors = Mirrors::find(scene);
        let Sources { all: sources, starts, leaves_chains, left_out } =
            Sources::of(scene, &mirrors);
        let panes = Panes::find(scene);
        let is_point = |s: &&Source| matches!(s.kind, SourceKind::Point { .. });
        let points = sources.iter().filter(is_point).count();
        let mut lighting = Self {
            scene,
            mirrors,
            twins: Twins::default(),
            sources,
            starts,
            leaves_chains,
            left_out,
            area_sources: 0,
            panes,
            tree: Tree::default(),
            chains: Vec::new(),
            images: Images::default(),
            others: Vec::new(),
            points,
            openings: Openings::default(),
        };
        lighting.twins = lighting.find_twins();
        lighting.openings = lighting.look_out();
        lighting.plant();
        lighting
    }

    /// Makes the tree of what is many.
    fn plant(&mut self) {
        let has_points = self.points > DRAWN_AT_ENDS;
        let tree = Tree::of(self.scene, has_points, faces(self.scene, &self.openings));
        let (sources, starts) = (&self.sources, &self.starts);
        let surfaces: HashSet<u32> = tree.faces.iter().map(|face| face.surface).collect();
        let is_in_tree = |source: &Source| match (&source.kind, source.luminaire) {
            (SourceKind::Point { .. }, _) => has_points,
            (SourceKind::Area { .. }, LuminaireId::Area(number)) => surfaces.contains(&number),
            _ => false,
        };
        let of_tree = sources.iter().filter(|s| is_in_tree(s)).map(|s| &s.chain);
        let chains: BTreeSet<&Vec<u32>> = of_tree.collect();
        self.chains = chains.into_iter().cloned().collect();
        self.images = Images::of(&tree, self.chains.len(), |lamp, chain| {
            let before = self.scene.luminaires().len();
            let number = match tree.face(lamp) {
                Some(face) => before + face.surface as usize,
                None => lamp.luminaire as usize,
            };
            image(sources, starts, number, &self.chains[chain]).is_some()
        });
        let is_other = |&k: &u32| !is_in_tree(&sources[k as usize]);
        self.others = (0..sources.len() as u32).filter(is_other).collect();
        self.area_sources = self.others().filter(|source| source.is_area()).count();
        self.tree = tree;
    }

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

    /// Direct illuminance from all sources: exact for parallel light, and for points where they are
    /// few; sampled for emitting surfaces.
    pub(crate) fn illuminance(&self, at: &SurfacePoint, dice: &mut Dice) -> Rgb {
        self.sampled(at, self.area_samples(), dice)
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

    /// The same with `samples` shadow rays for every emitting surface.
    pub(crate) fn sampled(&self, at: &SurfacePoint, samples: usize, dice: &mut Dice) -> Rgb {
        self.sampled_again(at, samples)(dice)
    }

    /// [`Lighting::sampled`] again and again at one place.
    pub(crate) fn sampled_again<'d>(
        &'d self,
        at: &'d SurfacePoint,
        samples: usize,
    ) -> impl Fn(&mut Dice) -> Rgb + 'd {
        let cut = self.has_many().then(|| self.fine_cut(at));
        move |dice| match &cut {
            Some(cut) => self.lit_by_cut(cut, at, (RAYS_TO_MANY, samples), dice),
            None => self.by_all(at, samples, dice),
        }
    }

    /// [`Lighting::sampled`] with a look at every source.
    pub(crate) fn by_all(&self, at: &SurfacePoint, samples: usize, dice: &mut Dice) -> Rgb {
        self.sources.iter().map(|s| self.lit_by(s, at, samples, dice)).sum()
    }

    /// An unbiased estimate of the direct illuminance by few shadow rays, for the ends of
    /// gathering rays.
    pub(crate) fn estimate(&self, at: &SurfacePoint, dice: &mut Dice) -> Rgb {
        if self.sources.len() <= EXACT_SOURCES {
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

    /// The same of the sources that are not in the tree.
    pub(super) fn estimate_of_others(&self, at: &SurfacePoint, dice: &mut Dice) -> Rgb {
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

    /// What all give by the one of the others at a place among their weights.
    fn lit_by_drawn(
        &self,
        weights: &[f64],
        (place, total): (f64, f64),
        at: &SurfacePoint,
        dice: &mut Dice,
    ) -> Rgb {
        let drawn = drawn(weights, place);
        // Rounding may leave a sliver past the last weight.
        let drawn = drawn.or_else(|| weights.iter().rposition(|&w| w > 0.0));
        drawn.zip(self.others().nth(drawn.unwrap_or(0))).map_or(Rgb::BLACK, |(k, source)| {
            self.lit_by(source, at, 1, dice) * (total / weights[k])
        })
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

    /// What comes to a place from luminaires without surface and their images: where from, and the illuminance of what faces them.
    pub(crate) fn points_at(&self, at: &SurfacePoint, mut found: impl FnMut(Direction, Rgb)) {
        for source in self.sources.iter().filter(|source| !source.is_area()) {
            let in_view = |target| self.chain_is_in_view(&source.chain, at, target);
            let arriving = sources::unoccluded_if(self.scene, source, at, in_view);
            let Some(arriving) = arriving else { continue };
            let towards = match arriving.target {
                Target::Point(place) => (place - at.point).direction(),
                Target::Infinity(direction) => Some(direction),
            };
            let Some(towards) = towards else { continue };
            let share = self.visibility_in_view(&source.chain, at, arriving.target, None);
            if !share.is_black() {
                found(towards, arriving.illuminance_lx * share / towards.cos(at.shading));
            }
        }
    }

    /// The sources that are not in the tree.
    pub(super) fn others(&self) -> impl Iterator<Item = &Source> {
        self.others.iter().map(|&k| &self.sources[k as usize])
    }

    pub(super) fn lit_by(
        &self,
        source: &Source,
        at: &SurfacePoint,
        samples: usize,
        dice: &mut Dice,
    ) -> Rgb {
        match &source.kind {
            SourceKind::Area { emitter, triangles } => {
                self.lit_by_area(source, emitter, triangles, at, samples, dice)
            }
            _ => self.lit_by_point(source, at),
        }
    }

    /// Illuminance from those of some sources that have no surface, one by one.
    pub(super) fn lit_by_points<'a>(
        &self,
        some: impl Iterator<Item = &'a Source>,
        at: &SurfacePoint,
    ) -> Rgb {
        let points = some.filter(|source| !source.is_area());
        points.map(|source| self.lit_by_point(source, at)).sum()
    }

    fn lit_by_point(&self, source: &Source, at: &SurfacePoint) -> Rgb {
        let in_view = |target| self.chain_is_in_view(&source.chain, at, target);
        let Some(arriving) = sources::unoccluded_if(self.scene, source, at, in_view) else {
            return Rgb::BLACK;
        };
        let share = self.visibility_in_view(&source.chain, at, arriving.target, None);
        arriving.illuminance_lx * share
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
fn image(sources: &[Source], starts: &[usize], luminaire: usize, chain: &[u32]) -> Option<usize> {
    let (first, end) = (starts[luminaire], starts[luminaire + 1]);
    sources[first..end].iter().position(|s| s.chain == chain).map(|k| first + k)
}
