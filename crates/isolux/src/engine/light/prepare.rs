//! Preparation of the sources of a scene: images, twins of chains, openings, and the light tree.

use super::lighting::{Lighting, MOST_POINTS_AT_ENDS, image};
use super::mirrors::planar::Mirrors;
use super::mirrors::twins::Twins;
use super::openings::Openings;
use super::panes::Panes;
use super::sources::triangle_lamps::faces;
use super::sources::{LuminaireId, Source, SourceKind, Sources};
use super::tree::{Images, Tree};
use crate::engine::ray::{Deadline, NEVER};
use crate::scene::Scene;
use std::collections::{BTreeSet, HashSet};

impl<'s> Lighting<'s> {
    /// Prepares the sources of a scene.
    pub(crate) fn new(scene: &'s Scene) -> Self {
        Self::prepared_until(scene, &NEVER)
    }

    /// Prepares the sources of a scene. Openings that are not found by the end of the time are left out: light through them is
    /// sampled with more noise.
    pub(crate) fn prepared_until(scene: &'s Scene, end: &Deadline) -> Self {
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
            are_pooled: false,
        };
        lighting.twins = lighting.find_twins();
        lighting.openings = lighting.look_out(end);
        lighting.plant();
        lighting.are_pooled = lighting.can_pool();
        lighting
    }

    /// Builds the light tree, and finds the sources that are not in it.
    fn plant(&mut self) {
        let has_points = self.points > MOST_POINTS_AT_ENDS;
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
        self.area_sources = self.others().filter(|source| source.has_extent()).count();
        self.tree = tree;
    }
}
