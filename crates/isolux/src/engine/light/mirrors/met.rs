//! The planar mirrors that a path has met.

use super::super::lighting::Lighting;
use super::super::sources::LuminaireId;
use crate::engine::ray::{Scattered, SurfacePoint};
use crate::scene::Body;
use isolux_geometry::Direction;

/// The planar mirrors that a path has met so far, in order; `None` once it has met another specular
/// surface. Passing straight through a pane does not change it.
#[derive(Clone, Debug)]
pub(crate) struct MirrorChain(Option<Vec<u32>>);

impl Default for MirrorChain {
    /// The chain of a path that has met no mirror yet.
    fn default() -> Self {
        Self(Some(Vec::new()))
    }
}

impl MirrorChain {
    /// Updates the chain as the path goes on over a specular surface.
    pub(crate) fn pass(
        &mut self,
        (at, incoming): (&SurfacePoint, Direction),
        body: &Body,
        lighting: &Lighting,
        next: &Scattered,
    ) {
        let straight =
            next.direction == incoming && matches!(body, Body::Dielectric(glass) if glass.thin);
        if straight {
            return;
        }
        let plane = if next.mirrored { lighting.mirror_of(at.triangle, at.back) } else { None };
        self.0 = match (self.0.take(), plane) {
            (Some(mut chain), Some(plane)) => {
                chain.push(plane);
                Some(chain)
            }
            _ => None,
        };
    }

    /// Whether the light of a luminaire by this path is part of direct light as evaluated at points.
    pub(crate) fn is_covered(&self, lighting: &Lighting, luminaire: LuminaireId) -> bool {
        self.0.as_ref().is_some_and(|chain| lighting.covers(luminaire, chain))
    }

    /// [`MirrorChain::is_covered`] for a path that was followed from the place towards the luminaire.
    pub(crate) fn is_covered_backwards(&self, lighting: &Lighting, luminaire: LuminaireId) -> bool {
        let covers = |chain: &Vec<u32>| {
            let from_luminaire: Vec<u32> = chain.iter().rev().copied().collect();
            lighting.covers(luminaire, &from_luminaire)
        };
        self.0.as_ref().is_some_and(covers)
    }
}
