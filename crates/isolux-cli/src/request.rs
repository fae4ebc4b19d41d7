//! Arguments as resolved.

use crate::failure::Failure;
use crate::flags::{MethodName, Quality, SolveFlags};
use crate::output::OutputPath;
use isolux::engine::{IrradianceCache, SolveRequest};
use isolux::map::Method;

/// A solution to compute.
#[derive(Clone, Debug)]
pub(crate) struct Solution {
    /// What is asked of the engine.
    pub request: SolveRequest,
    /// Where the map goes; `None` for a prediction only.
    pub output: Option<OutputPath>,
}

/// Checks everything that can be checked before a scene is read.
pub(crate) fn solution(flags: &SolveFlags) -> Result<Solution, Failure> {
    let output = flags.output.as_deref().map(|path| OutputPath::check(path, "glb")).transpose()?;
    if let Some(output) = &output {
        output.differs_from(&flags.scene)?;
    }
    if flags.cache.is_some() && flags.method != MethodName::Cache {
        return Err(Failure::bad_input(
            "--cache FILE: samples are made by --method cache alone; add it, or leave --cache out",
        ));
    }
    Ok(Solution { request: request(flags), output })
}

fn request(flags: &SolveFlags) -> SolveRequest {
    SolveRequest {
        method: method(flags.method),
        accuracy: Some(flags.quality.map_or(flags.accuracy, accuracy)),
        mesh_accuracy: flags.mesh_accuracy,
        time_limit: flags.time_limit,
        seed: flags.seed,
        filter: !flags.no_filter,
        max_memory_bytes: flags.max_memory,
        cache: IrradianceCache::default(),
    }
}

/// The engine by its name.
pub(crate) fn method(name: MethodName) -> Method {
    match name {
        MethodName::Hybrid => Method::Hybrid,
        MethodName::Forward => Method::Forward,
        MethodName::Cache => Method::Cache,
    }
}

/// The name of an engine.
pub(crate) fn method_name(method: Method) -> &'static str {
    match method {
        Method::Hybrid => "hybrid",
        Method::Forward => "forward",
        Method::Cache => "cache",
    }
}

fn accuracy(quality: Quality) -> f64 {
    match quality {
        Quality::Draft => 0.05,
        Quality::Medium => 0.01,
        Quality::High => 0.003,
    }
}

/// From now on computations use this many threads.
pub(crate) fn use_threads(threads: Option<u16>) -> Result<(), Failure> {
    let Some(threads) = threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new()
        .num_threads(usize::from(threads))
        .build_global()
        .map_err(|e| Failure::Refused(format!("cannot start {threads} threads: {e}")))
}
