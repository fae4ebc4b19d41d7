//! What was measured, as a value.

use crate::building::{self, Build};
use crate::embree::Embree;
use crate::leaks::{self, Leaks};
use crate::machine::{Machine, date, revision};
use crate::random::Random;
use crate::rates::{Query, Rates, measure};
use crate::rays::Surfaces;
use crate::scene::Scene;
use serde::Serialize;

/// How much is measured.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Effort {
    pub(crate) rays: usize,
    pub(crate) turns: usize,
    pub(crate) builds: usize,
    pub(crate) leak_rays: u64,
}

/// One run of the bench.
#[derive(Debug, Serialize)]
pub(crate) struct Report {
    pub(crate) date: String,
    pub(crate) revision: Option<String>,
    pub(crate) machine: Machine,
    /// `None` where there is none.
    pub(crate) embree_version: Option<String>,
    pub(crate) effort: Effort,
    pub(crate) scenes: Vec<SceneReport>,
}

/// Of one scene.
#[derive(Debug, Serialize)]
pub(crate) struct SceneReport {
    pub(crate) name: &'static str,
    pub(crate) triangles: usize,
    pub(crate) rates: Vec<Rates>,
    pub(crate) isolux_build: Build,
    pub(crate) embree_build: Option<Build>,
    pub(crate) leaks: Leaks,
}

impl Report {
    /// Without any scene yet.
    pub(crate) fn new(embree: Option<&Embree>, effort: Effort) -> Self {
        let version = |e: &Embree| e.version().map(|part| part.to_string()).join(".");
        Self {
            date: date(),
            revision: revision(),
            machine: Machine::this(),
            embree_version: embree.map(version),
            effort,
            scenes: Vec::new(),
        }
    }
}

/// Measures one scene.
pub(crate) fn scene(
    scene: &Scene,
    embree: Option<&Embree>,
    effort: &Effort,
) -> Result<SceneReport, String> {
    let mesh = &scene.mesh;
    let (isolux, isolux_build) = building::isolux(mesh, effort.builds);
    let built = embree.map(|e| building::embree(e, mesh, effort.builds)).transpose()?;
    let (embree, embree_build) = built.unzip();
    let surfaces = Surfaces::new(&isolux);
    let mut random = Random::new(2);
    let reflected = surfaces.reflected(effort.rays, &mut random);
    let segments = surfaces.segments(effort.rays, &mut random);
    let rates = [(Query::ClosestHit, &reflected), (Query::AnyHit, &segments)];
    let rates = rates
        .into_iter()
        .flat_map(|(query, rays)| measure(&isolux, embree.as_ref(), query, rays, effort.turns));
    Ok(SceneReport {
        name: scene.name,
        triangles: mesh.len(),
        rates: rates.collect(),
        isolux_build,
        embree_build,
        leaks: leaks::count(&isolux, embree.as_ref(), effort.leak_rays),
    })
}
