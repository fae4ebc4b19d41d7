//! The isolux command: a table of contents.
//!
//! [`command`] is all of it. A program that holds scenes and maps itself has the same done in its own process by [`embedded`].

mod annual;
mod appearance;
mod arguments;
mod arriving;
mod audit;
mod bake;
mod beside;
mod budget;
mod cache_samples;
mod cached_view;
mod caller;
mod check;
mod claim;
mod clock;
mod compare;
mod console;
mod daylight;
mod demo;
mod dimming;
mod elsewhere;
pub mod embedded;
mod ending;
mod energy;
mod engine_export;
mod estimate;
mod explain;
mod export;
mod exported;
mod exposed;
mod failure;
mod flags;
mod glare;
mod glare_threshold;
mod grid;
mod grid_values;
mod groups;
mod info;
mod installed;
mod interrupt;
mod kept;
mod lamp;
mod lighting_report;
mod lightmap;
mod lightmap_export;
mod lightmap_files;
mod lint;
mod look;
mod maintained;
mod map_facts;
mod map_file;
mod memory;
mod merge;
mod meter;
mod mix;
mod new;
mod notes;
mod origin;
mod output;
mod part_files;
mod part_making;
mod parted;
mod points;
mod probe;
mod progress;
mod quantity;
mod reach;
mod reading;
mod render;
mod report;
mod repository;
mod request;
mod saved_run;
mod scene;
mod serving;
mod shell;
mod shown;
mod solve;
mod solving;
mod source;
mod stop;
mod summary;
mod traced;
mod trouble;
mod unlit;
mod validate;
mod vertex_export;
mod viewpoint;
mod walk;
mod walk_export;

use failure::{Failure, Outcome};
use flags::{Command, Flags};
use std::ffi::OsString;

/// Runs the command with these words, the first of which is its own name, to its exit code. It speaks on the streams of the process
/// and may end it: it is for programs that do nothing else.
pub fn command(words: impl Iterator<Item = OsString>) -> u8 {
    interrupt::signals::write_on_at_limits();
    match arguments::read(words) {
        Ok(flags) => {
            let ended = run(&flags);
            if ended.is_ok() {
                source::warn_of_idle_sky();
            }
            ending::tell(&ended, flags.json)
        }
        Err(code) => code,
    }
}

fn run(flags: &Flags) -> Result<Outcome, Failure> {
    memory::bound(flags.max_memory, flags.json);
    source::read_as(source::reading_of(flags)?);
    request::use_threads(flags.command.threads())?;
    if let Command::View(asked) = &flags.command {
        return serving::view(asked, flags.json);
    }
    // Among the threads that share the work: to hand it to them from outside makes each of its many small parts wait.
    rayon::scope(|_| carry_out(flags))
}

/// Clusters are reached from Python.
const NEEDS_PYTHON: &str = "clusters need the package for Python: pip install isolux[cluster], then python -m isolux cluster solve SCENE -o MAP.glb";

fn carry_out(flags: &Flags) -> Result<Outcome, Failure> {
    let json = flags.json;
    match &flags.command {
        Command::Solve(flags) => solve::run(flags, json),
        Command::Probe(flags) => probe::run(flags, json),
        Command::Grid(flags) => grid::run(flags, json),
        Command::Daylight(flags) => annual::run(flags, json),
        Command::Glare(flags) => glare::run(flags, json),
        Command::Budget(flags) => budget::run(flags, json),
        Command::Report(flags) => lighting_report::run(flags, json),
        Command::Bake(flags) => bake::run(flags, json),
        Command::Export(flags) => export::run(flags, json),
        Command::View(flags) => serving::view(flags, json),
        Command::Audit(flags) => audit::run(flags, json),
        Command::Cluster(_) => Err(Failure::bad_input(NEEDS_PYTHON)),
        Command::Check(flags) => check::run(flags, json),
        Command::Lint(flags) => lint::run(flags, json),
        Command::Render(flags) => render::run(flags, json),
        Command::Validate(flags) => validate::run(flags, json),
        Command::Compare(flags) => compare::run(flags, json),
        Command::Scene(flags) => scene::run(flags, json),
        Command::New(flags) => new::run(flags, json),
        Command::Demo(flags) => demo::run(flags, json),
        Command::Mix(flags) => mix::run(flags, json),
        Command::Merge(flags) => merge::run(flags, json),
        Command::Info(flags) => info::run(flags, json),
        Command::Completions(flags) => shell::completions(flags, json),
        Command::Man(flags) => shell::man(flags, json),
    }
}
