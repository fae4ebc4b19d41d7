//! Runs that end.

use isolux::engine::{RunState, Solution, SolveError, SolveRequest, Stage, Watch, solve};
use isolux::map::{IlluminationMap, Method};
use isolux::scene::Scene;
use std::sync::mpsc::channel;
use std::time::Duration;

pub(crate) const METHODS: [Method; 4] =
    [Method::Hybrid, Method::Forward, Method::Radiosity, Method::Cache];

/// What an engine counts for a vertex, bytes: memory is how its meshes are kept small here.
const BYTES_A_VERTEX: u64 = 2400;

/// A request that refines nothing and stops as soon as it may.
pub(crate) fn coarse(method: Method, vertices: u64) -> SolveRequest {
    SolveRequest {
        method,
        accuracy: Some(1.0),
        mesh_accuracy: 1.0,
        max_memory_bytes: vertices * BYTES_A_VERTEX,
        ..SolveRequest::default()
    }
}

/// Solves, with so many increments at most.
pub(crate) fn run(
    scene: &Scene,
    request: &SolveRequest,
    increments: u64,
) -> Result<Solution, SolveError> {
    go_on(scene, request, None, increments)
}

/// Solves from a state on, with so many increments at most.
pub(crate) fn go_on(
    scene: &Scene,
    request: &SolveRequest,
    from: Option<&RunState>,
    increments: u64,
) -> Result<Solution, SolveError> {
    solve(scene, request, from, &mut |progress| {
        let enough = progress.stage == Stage::Increments && progress.increments >= increments;
        if enough { Watch::Stop } else { Watch::Continue }
    })
}

/// A valid map has numbers where it has values.
pub(crate) fn assert_valid(name: &str, map: &IlluminationMap) {
    assert_eq!(map.values.len(), map.elements.vertices().len(), "{name}");
    for value in map.values.iter().flatten() {
        let parts = [value.direct_lx, value.caustic_lx, value.indirect_lx];
        assert!(parts.iter().all(|p| p.is_finite()), "{name}: {value:?}");
        assert!(parts.iter().all(|p| p.min_channel() >= 0.0), "{name}: {value:?}");
        assert!(value.standard_error_lx >= 0.0, "{name}: {value:?}");
    }
}

/// Far longer than anything takes, on a slow machine too: what takes longer does not end.
const PATIENCE: Duration = Duration::from_secs(300);

/// The result of work that must end; a run that hangs fails its test instead of all.
pub(crate) fn ends<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Option<T> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || sender.send(work()));
    receiver.recv_timeout(PATIENCE).ok()
}
