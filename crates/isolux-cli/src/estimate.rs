//! What a run will need: its beginning, extrapolated.

use isolux::engine::{self, SolveError, SolveRequest, Watch};
use isolux::scene::Scene;
use serde::Serialize;
use std::time::Duration;

/// An estimate takes no longer than this, or one round of a large scene.
const PATIENCE: Duration = Duration::from_secs(5);
/// Elements, sums and gathered rays of a receiver, measured on rooms of 10^4 to 10^5 of them.
const BYTES_A_RECEIVER: u64 = 2400;
/// Mesh and hierarchy of a triangle: 3 vertices, normals, texture coordinates, and its nodes.
const BYTES_A_TRIANGLE: u64 = 400;

/// Sizes of a run.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Estimate {
    /// Vertices of the elements.
    pub receivers: u64,
    /// Memory, bytes.
    pub memory_bytes: u64,
    /// Time to the accuracy asked for, s; `None` where the beginning was not enough to tell.
    pub time_s: Option<f64>,
    /// Not before, with nine chances in ten, s.
    pub time_earliest_s: Option<f64>,
    /// Not after, s.
    pub time_latest_s: Option<f64>,
}

impl Estimate {
    /// Runs the beginning of a solution, until it knows when it will end.
    pub(crate) fn of(scene: &Scene, request: &SolveRequest) -> Result<Self, SolveError> {
        let mut receivers = 0;
        let mut prediction = None;
        let limit = request.time_limit.map_or(PATIENCE, |limit| limit.min(PATIENCE));
        let beginning = SolveRequest { time_limit: Some(limit), ..request.clone() };
        let solution = engine::solve(scene, &beginning, None, &mut |progress| {
            receivers = progress.receivers;
            prediction = progress.prediction;
            if prediction.is_some() { Watch::Stop } else { Watch::Continue }
        })?;
        let done_s = solution.map.provenance.complete.then_some(solution.time_s);
        let textures: u64 = scene.textures().iter().map(|t| t.srgb.len() as u64).sum();
        let triangles = u64::from(scene.triangle_count());
        Ok(Self {
            receivers,
            memory_bytes: receivers * BYTES_A_RECEIVER + triangles * BYTES_A_TRIANGLE + textures,
            time_s: done_s.or(prediction.map(|p| p.finish_s)),
            time_earliest_s: done_s.or(prediction.map(|p| p.earliest_s)),
            time_latest_s: done_s.or(prediction.map(|p| p.latest_s)),
        })
    }
}
