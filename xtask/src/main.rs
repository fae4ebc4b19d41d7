//! Chores of the workspace, run as `cargo xtask COMMAND`.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command line speaks")]

mod bench;
mod built;
mod case;
mod colours;
mod compared;
mod consumers;
mod golden;
mod grids;
mod hall;
mod judge;
mod lamps;
mod loaders;
mod page;
mod peers;
mod python;
mod reliability;
mod sanitize;
mod sbom;
mod smoke;
mod test;
mod tidy;
mod truth;
mod walk;
mod worlds;

use std::path::Path;
use std::process::ExitCode;

const USAGE: &str = "\
cargo xtask test    everything that must hold before a change lands; with --all also what must hold before a release:
                    comparison of all systems, more judges of pictures, golden maps, validation
cargo xtask tidy    of it, layers, module cycles, sizes, paths and unsafe code
cargo xtask smoke   of it, the command line from scene to values, and the outside judges
cargo xtask page    of it, the tests of the walk-through's page, and whether its built file is that of its sources
cargo xtask walk    of --all, the walk-through in Chromium, beside what the command says of the same maps
cargo xtask loader three  of --all, the loader of three.js in Chromium, beside what the command says of the same map
cargo xtask lamps   of --all, photometric files beside Radiance's ies2rad and photompy
cargo xtask colours of --all, differences of colours beside colour-science
cargo xtask python  of it, the wheel of the package for Python, its tests and its types
cargo xtask python --notebooks  of --all, the example notebooks, and exchange with other packages
cargo xtask cluster of --all, the package for Python on clusters of Ray that lose workers and nodes
cargo xtask compared      of --all, all systems by error against time, as short as it can be
cargo xtask golden        forty small maps beside their hashes: has a change of the code changed any result?
                          [--only PART] [--isolux PATH] [--save]
cargo xtask loader bevy      of --all, the loader of Bevy, built of its crates, beside probe and mix
cargo xtask loader blender   of --all, the add-on of Blender in Blender (a download of 400 MB), beside closed forms, probe and Cycles
cargo xtask sanitize      of --all, the ray kernel under the address sanitizer
cargo xtask reliability   faults injected into runs of the command: kills, full disks, damaged states; are the bytes the same?
                          [--only kills|disk|foreign|twice|same|sizes|hostile] [--seed 1] [--count 70]
                          [--isolux PATH] [--other PATH] [--arm PATH] [--save]
cargo xtask sbom          what is linked into the command, as CycloneDX
cargo xtask consumers     light in Blender, Godot and Bevy, by hand
cargo xtask bench setup   download Embree 4.4 into target/embree, and Radiance, Mitsuba and LuxCore into target/peers
cargo xtask bench rays    rays a second beside Embree [--json] [--quick] [--leaks 1e8] [--save]
cargo xtask bench hall    time to an accuracy against triangles and luminaires, and true errors
                          [--json] [--quick | --standard] [--accuracy 1%] [--time-limit 600s] [--threads 2]
cargo xtask bench hall --reference   make the reference of true errors anew
cargo xtask bench peers   error against time beside Radiance, Mitsuba and LuxCore
                          [--json] [--quick] [--only NAME ...] [--scene NAME ...] [--save]
cargo xtask bench truth   maps of sixty unknown scenes beside long paths [--only NAME ...] [--half tuning|judging]
                          [--seeds 1,2,3] [--methods hybrid,cache,forward,radiosity] [--accuracy 2%]
                          [--time-limit 60s] [--isolux PATH] [--fresh] [--json] [--save]
cargo xtask bench ablation  the same scenes without each mechanism of the engines in turn: what is it worth?
                          [--without NAME ...] and the flags of bench truth";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let root = workspace_root();
    let outcome = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["test"] => test::run(root, false),
        ["test", "--all"] => test::run(root, true),
        ["tidy"] => tidy::run(root),
        ["smoke"] => test::smoke_and_judge(root),
        ["page"] => page::run(root),
        ["walk"] => walk::run(root),
        ["loader", "three"] => loaders::three(root),
        ["loader", "bevy"] => loaders::bevy(root),
        ["loader", "blender"] => loaders::blender(root),
        ["lamps"] => lamps::run(root),
        ["python"] => python::run(root),
        ["python", "--notebooks"] => python::notebooks(root),
        ["cluster"] => python::cluster(root),
        ["golden", ref arguments @ ..] => golden::run(root, arguments),
        ["reliability", ref arguments @ ..] => reliability::run(root, arguments),
        ["colours"] => colours::run(root),
        ["compared"] => compared::run(root),
        ["sanitize"] => sanitize::run(root),
        ["sbom"] => sbom::run(root),
        ["consumers"] => consumers::run(root),
        ["bench", "setup"] => bench::setup(root).and_then(|embree| peers::setup(root, &embree)),
        ["bench", "hall", ref arguments @ ..] => hall::run(root, arguments),
        ["bench", "rays", ref arguments @ ..] => bench::rays(root, arguments),
        ["bench", "peers", ref arguments @ ..] => peers::run(root, arguments),
        ["bench", "ablation", ref arguments @ ..] => truth::ablation::run(root, arguments),
        ["bench", "truth", ref arguments @ ..] => truth::run(root, arguments),
        _ => Err(USAGE.to_owned()),
    };
    match outcome {
        Ok(summary) => {
            if !summary.is_empty() {
                println!("{summary}");
            }
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// The folder above this crate.
fn workspace_root() -> &'static Path {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here)
}
