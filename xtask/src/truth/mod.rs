//! The bench of maps against long paths, on scenes that nothing is known of: is what a map tells of itself true?

pub(crate) mod ablation;
mod bounded;
mod exported;
mod flags;
mod judged;
mod paths;
mod solved;
mod table;

use crate::peers;
use bounded::Isolux;
use exported::TruthScene;
use flags::Flags;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Solves every scene by every method and says by how much each is wrong.
pub(crate) fn run(root: &Path, arguments: &[&str]) -> Result<String, String> {
    let flags = Flags::parse(arguments)?;
    let folder = root.join("target").join("truth");
    let isolux = Isolux::new(root, flags.isolux.as_deref(), &folder)?;
    let scenes = exported::scenes(root, flags.isolux.is_some())?;
    let chosen: Vec<TruthScene> = scenes.into_iter().filter(|s| flags.has(s)).collect();
    if chosen.is_empty() {
        return Err("bench truth: no scene is called so; there are truth-00 to truth-59".into());
    }
    let mut result = json!({
        "machine": machine(),
        "isolux": isolux.version()?,
        "accuracy": flags.accuracy,
        "rows": [],
    });
    let kept =
        if flags.save { root.join("benchmarks").join("truth") } else { folder.join("results") };
    let mut rows = earlier(&kept, &chosen, &flags);
    for scene in &chosen {
        rows.extend(of_scene(root, &folder, &isolux, scene, &flags));
        // A run that is stopped leaves what it has.
        rows.sort_by(table::worse_first);
        result["rows"] = Value::Array(rows.clone());
        write(&kept, &result)?;
    }
    Ok(if flags.json { format!("{result:#}") } else { table::markdown(&result) })
}

/// Rows of an earlier run, of what is not asked for now.
fn earlier(kept: &Path, chosen: &[TruthScene], flags: &Flags) -> Vec<Value> {
    let text = std::fs::read(kept.join("table.json")).unwrap_or_default();
    let table: Value = serde_json::from_slice(&text).unwrap_or_default();
    let is_asked = |row: &Value| {
        chosen.iter().any(|scene| row["scene"] == scene.name)
            && flags.methods.iter().any(|method| row["method"] == *method)
            && flags.seeds.iter().any(|&seed| row["seed"] == seed)
    };
    let rows = table["rows"].as_array().cloned().unwrap_or_default();
    rows.into_iter().filter(|row| !is_asked(row)).collect()
}

/// Rows of one scene: what goes wrong is a row, too.
fn of_scene(
    root: &Path,
    folder: &Path,
    isolux: &Isolux,
    scene: &TruthScene,
    flags: &Flags,
) -> Vec<Value> {
    eprintln!("{}: {}", scene.name, scene.kind);
    let truth = exported::files(folder, isolux, scene)
        .and_then(|file| Ok((paths::truth(folder, isolux, scene, &file, flags)?, file)));
    let mut rows = Vec::new();
    for method in &flags.methods {
        for &seed in &flags.seeds {
            let judged = truth.clone().and_then(|(truth, file)| {
                let (solved, readings) =
                    solved::solve(folder, isolux, scene, &file, (method, seed), flags)?;
                Ok(judged::row(scene, &truth, solved, &readings))
            });
            let mut row = judged.unwrap_or_else(|problem| json!({ "failed": problem }));
            row["scene"] = json!(scene.name);
            row["kind"] = json!(scene.kind);
            row["half"] = json!(scene.half);
            row["leaves_caustics"] = json!(scene.leaves_caustics);
            row["method"] = json!(method);
            row["seed"] = json!(seed);
            row["time_limit_s"] = json!(flags.time_limit_s);
            row["revision"] = json!(peers::revision(root));
            eprintln!("  {}", table::line(&row));
            rows.push(row);
        }
    }
    rows
}

fn write(folder: &Path, result: &Value) -> Result<(), String> {
    let fail = |path: &Path, e: std::io::Error| format!("{}: {e}", path.display());
    std::fs::create_dir_all(folder).map_err(|e| fail(folder, e))?;
    for (name, text) in
        [("table.json", format!("{result:#}\n")), ("table.md", table::markdown(result))]
    {
        let path: PathBuf = folder.join(name);
        std::fs::write(&path, text).map_err(|e| fail(&path, e))?;
    }
    Ok(())
}

/// Processor, cores and load, as other benches tell them.
pub(crate) fn machine() -> Value {
    let read = |path: &str| std::fs::read_to_string(path).unwrap_or_default();
    let cpu = read("/proc/cpuinfo");
    let model =
        cpu.lines().find_map(|l| l.strip_prefix("model name")).and_then(|l| l.split_once(':'));
    json!({
        "processor": model.map_or(std::env::consts::ARCH, |(_, name)| name.trim()),
        "cores": std::thread::available_parallelism().map_or(0, usize::from),
        "system": std::env::consts::OS,
        "load_before": read("/proc/loadavg").split(' ').next().and_then(|l| l.parse::<f64>().ok()),
    })
}
