//! Rays a second of `isolux-geometry` beside Embree; `cargo xtask bench rays` runs it.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program whose result is a table")]

mod building;
mod clock;
mod embree;
mod kernel;
mod leaks;
mod machine;
mod random;
mod rates;
mod rays;
mod report;
mod scene;
mod statistics;
mod table;

use clap::Parser;
use embree::Embree;
use report::{Effort, Report};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Measures the ray kernel of isolux, and Embree beside it.
#[derive(Parser)]
struct Arguments {
    /// Print JSON instead of a table.
    #[arg(long)]
    json: bool,
    /// Fewer and shorter turns, for a first impression.
    #[arg(long)]
    quick: bool,
    /// Rays to aim at edges of each scene, as 1e6.
    #[arg(long, value_name = "RAYS", value_parser = count)]
    leaks: Option<u64>,
    /// Keep the JSON in crates/isolux-bench/results/.
    #[arg(long)]
    save: bool,
}

impl Arguments {
    fn effort(&self) -> Effort {
        let (rays, turns, builds, leak_rays) =
            if self.quick { (1 << 15, 5, 1, 100_000) } else { (1 << 17, 21, 3, 1_000_000) };
        Effort { rays, turns, builds, leak_rays: self.leaks.unwrap_or(leak_rays) }
    }
}

/// A number of rays, also written as 1e8.
fn count(text: &str) -> Result<u64, String> {
    let number: f64 = text.parse().map_err(|_| "write a number of rays, as 1e6".to_owned())?;
    let is_count = number.fract() == 0.0 && (0.0..=1e12).contains(&number);
    is_count.then_some(number as u64).ok_or_else(|| "a whole number up to 1e12".to_owned())
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(text) => {
            println!("{text}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<String, String> {
    let loaded = Embree::load();
    let (embree, missing) = (loaded.as_ref().ok(), loaded.as_ref().err());
    let mut report = Report::new(embree, arguments.effort());
    let results = arguments.save.then(results_folder).transpose()?;
    for make in scene::all() {
        let scene = make();
        eprintln!("{}: {} triangles ...", scene.name, scene.mesh.len());
        report.scenes.push(report::scene(&scene, embree, &report.effort)?);
    }
    let json = serde_json::to_string_pretty(&report).map_err(|e| e.to_string())?;
    if let Some(folder) = results {
        let file = folder.join(format!("rays-{}.json", report.date));
        std::fs::write(&file, format!("{json}\n")).map_err(|e| unwritable(&file, &e))?;
    }
    let table = || table::render(&report, missing.map(String::as_str));
    Ok(if arguments.json { json } else { table() })
}

/// The folder of committed results, made before anything is measured.
fn results_folder() -> Result<PathBuf, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("results");
    std::fs::create_dir_all(&folder).map_err(|e| unwritable(&folder, &e))?;
    Ok(folder)
}

fn unwritable(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}
