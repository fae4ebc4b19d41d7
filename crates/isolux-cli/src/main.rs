//! The isolux command: a table of contents.

mod appearance;
mod arguments;
mod arriving;
mod audit;
mod bake;
mod beside;
mod cache_samples;
mod cached_view;
mod check;
mod claim;
mod clock;
mod compare;
mod console;
mod demo;
mod dimming;
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
mod grid;
mod grid_values;
mod groups;
mod info;
mod interrupt;
mod kept;
mod lamp;
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
mod parted;
mod points;
mod probe;
mod progress;
mod quantity;
mod reach;
mod render;
mod report;
mod repository;
mod request;
mod rounded;
mod saved_run;
mod scene;
mod serving;
mod shell;
mod shown;
mod solve;
mod solving;
mod source;
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
use flags::{Command, Flags, MaterialsName};
use std::process::ExitCode;

fn main() -> ExitCode {
    let flags = match arguments::read(std::env::args_os()) {
        Ok(flags) => flags,
        Err(code) => return code,
    };
    ExitCode::from(ending::tell(&run(&flags), flags.json))
}

fn run(flags: &Flags) -> Result<Outcome, Failure> {
    let json = flags.json;
    memory::bound(flags.max_memory, json);
    if flags.materials == MaterialsName::AsWritten {
        source::read_materials_as_written();
    }
    if flags.allow_outside {
        source::allow_outside();
    }
    if let Some((first, further)) = flags.command.read_together() {
        source::read_together(first, further)?;
    }
    let threads = match &flags.command {
        Command::Solve(flags) => flags.threads,
        Command::Export(flags) => flags.threads,
        Command::Bake(flags) => flags.threads,
        Command::Merge(flags) => flags.threads,
        Command::Compare(flags) => flags.threads,
        _ => None,
    };
    request::use_threads(threads)?;
    if let Command::View(flags) = &flags.command {
        return serving::view(flags, json);
    }
    // Among the threads that share the work: to hand it to them from outside makes each of its many small parts wait.
    rayon::scope(|_| match &flags.command {
        Command::Solve(flags) => solve::run(flags, json),
        Command::Probe(flags) => probe::run(flags, json),
        Command::Grid(flags) => grid::run(flags, json),
        Command::Bake(flags) => bake::run(flags, json),
        Command::Export(flags) => export::run(flags, json),
        Command::View(flags) => serving::view(flags, json),
        Command::Audit(flags) => audit::run(flags, json),
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
    })
}
