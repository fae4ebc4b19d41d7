//! Arguments as resolved.

use crate::failure::Failure;
use crate::flags::{LayoutName, MethodName, Quality, RadiosityFlags, SolveFlags};
use crate::memory;
use crate::output::OutputPath;
use isolux::engine::{IrradianceCache, RadiositySettings, RunIdentity, SolveRequest, StopFlag};
use isolux::map::Method;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::path::Path;

/// Stack of a thread: as much as the first one of a process has.
const STACK_BYTES: usize = 8 << 20;

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
    let output = flags.output.as_deref();
    if let Some(part) = output.filter(|path| flags.increments.is_none() && is_part(path)) {
        return Err(Failure::bad_input(format!(
            "{}: which part of the run? Add --increments A..B, or end the name in .glb for a map",
            part.display()
        )));
    }
    if let (Some(asked), None) = (flags.increments, output) {
        return Err(Failure::bad_input(format!(
            "--increments {asked}: where does this part go? Add -o x.part"
        )));
    }
    if let Some(path) = output.filter(|path| is_part(path) || is_pilot(path)) {
        refuse_beside_map(flags, path)?;
    }
    let output = output.map(|path| OutputPath::check_any(path, written(flags))).transpose()?;
    if let Some(output) = &output {
        output.differs_from(&flags.scene)?;
    }
    if flags.cache.is_some() && flags.method != MethodName::Cache {
        return Err(Failure::bad_input(
            "--cache FILE: samples are made by --method cache alone; add it, or leave --cache out",
        ));
    }
    if flags.method != MethodName::Radiosity {
        refuse_radiosity(&flags.radiosity)?;
    }
    Ok(Solution { request: request(flags), output })
}

fn is_part(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("part"))
}

fn is_pilot(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("pilot"))
}

/// Flags about a map are mistakes where none is written.
fn refuse_beside_map(flags: &SolveFlags, path: &Path) -> Result<(), Failure> {
    let is_baked =
        flags.layout.layout == LayoutName::Texels || flags.layout.texels_per_meter.is_some();
    let given = [
        ("--layout texels", is_baked, "texels are baked of a map: merge its parts, and use export"),
        ("--group", flags.group, "every group has a run of its own, and so a pilot of its own"),
        ("--resume", flags.resume, "only the run of a map is kept to go on from"),
        ("--live", flags.live, "what is shown is a map"),
        ("--cache", flags.cache.is_some(), "a run that starts from samples has no parts"),
    ];
    match given.iter().find(|(_, is_given, _)| *is_given) {
        Some((flag, _, why)) => Err(Failure::bad_input(format!(
            "{flag}: {} is no map, and {why}; leave it out, or end the name in .glb",
            path.display()
        ))),
        None => Ok(()),
    }
}

/// What a run writes.
const fn written(flags: &SolveFlags) -> &'static [&'static str] {
    match flags.increments {
        Some(_) => &["part"],
        None => &["glb", "pilot"],
    }
}

/// Flags that another method has no use for are mistakes.
fn refuse_radiosity(flags: &RadiosityFlags) -> Result<(), Failure> {
    let given = [
        ("--form-factor-tolerance", flags.form_factor_tolerance.is_some()),
        ("--unshot", flags.unshot.is_some()),
        ("--max-receivers", flags.max_receivers.is_some()),
        ("--min-element", flags.min_element.is_some()),
        ("--no-ambient", flags.no_ambient),
        ("--diffuse-only", flags.diffuse_only),
    ];
    match given.iter().find(|(_, is_given)| *is_given) {
        Some((flag, _)) => Err(Failure::bad_input(format!(
            "{flag} is only for --method radiosity; leave it out or choose that method"
        ))),
        None => Ok(()),
    }
}

fn radiosity(flags: &RadiosityFlags) -> RadiositySettings {
    RadiositySettings {
        form_factor_tolerance: flags.form_factor_tolerance,
        unshot: flags.unshot,
        max_receivers: flags.max_receivers,
        min_element_m: flags.min_element,
        ambient: !flags.no_ambient,
        diffuse_only: flags.diffuse_only,
    }
}

fn request(flags: &SolveFlags) -> SolveRequest {
    SolveRequest {
        method: method(flags.method),
        accuracy: Some(flags.quality.map_or(flags.accuracy, accuracy)),
        mesh_accuracy: flags.mesh_accuracy,
        time_limit: flags.time_limit,
        stop: StopFlag::default(),
        seed: flags.seed,
        filter: !flags.no_filter,
        audit: !flags.no_audit,
        max_memory_bytes: memory::of_map(),
        cache: IrradianceCache::default(),
        radiosity: radiosity(&flags.radiosity),
    }
}

/// What was asked of a run.
pub(crate) fn of_run(of: &RunIdentity, filter: bool) -> SolveRequest {
    SolveRequest {
        method: of.method,
        accuracy: of.accuracy,
        mesh_accuracy: of.mesh_accuracy,
        time_limit: None,
        stop: StopFlag::default(),
        seed: of.seed,
        filter,
        audit: of.audit,
        max_memory_bytes: of.max_memory_bytes,
        cache: IrradianceCache::default(),
        radiosity: of.radiosity,
    }
}

/// The engine by its name.
pub(crate) fn method(name: MethodName) -> Method {
    match name {
        MethodName::Hybrid => Method::Hybrid,
        MethodName::Forward => Method::Forward,
        MethodName::Cache => Method::Cache,
        MethodName::Radiosity => Method::Radiosity,
    }
}

/// The name of an engine.
pub(crate) fn method_name(method: Method) -> &'static str {
    match method {
        Method::Hybrid => "hybrid",
        Method::Forward => "forward",
        Method::Cache => "cache",
        Method::Radiosity => "radiosity",
    }
}

fn accuracy(quality: Quality) -> f64 {
    match quality {
        Quality::Draft => 0.05,
        Quality::Medium => 0.01,
        Quality::High => 0.003,
        Quality::Production => 0.001,
    }
}

/// From now on computations use this many threads.
pub(crate) fn use_threads(threads: Option<u16>) -> Result<(), Failure> {
    builder(threads).build_global().map_err(cannot_start)
}

/// This many threads for one call: they end with it, so that a process may be forked between two.
pub(crate) fn threads_of_call(threads: Option<u16>) -> Result<ThreadPool, Failure> {
    builder(threads).build().map_err(cannot_start)
}

fn builder(threads: Option<u16>) -> ThreadPoolBuilder {
    // None: as many as there are processors, or as the environment says.
    ThreadPoolBuilder::new().num_threads(threads.map_or(0, usize::from)).stack_size(STACK_BYTES)
}

fn cannot_start(error: rayon::ThreadPoolBuildError) -> Failure {
    Failure::Refused(format!("cannot start threads: {error}"))
}
