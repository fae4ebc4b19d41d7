//! What long paths find at the places of a scene, kept for all methods and seeds.

use super::bounded::Isolux;
use super::exported::TruthScene;
use super::flags::Flags;
use serde_json::{Value, json};
use std::path::Path;
use std::time::{Duration, Instant};

/// Paths from every place in one batch, and fewest and most batches of them: the fewest hold replicates enough for a
/// standard error to be believed, which a batch has sixteen of.
const PATHS: u32 = 1024;
const BATCHES: std::ops::RangeInclusive<u64> = 4..=64;

/// Noise of the paths, in accuracies, at which there are enough. Its square is taken off; what is left of it is less by
/// the fourth root of half the number of places, 3.8.
const ENOUGH: f64 = 0.2;

/// Time after which no more batches are traced, and in which one must be done.
const LONGEST: [Duration; 2] = [Duration::from_secs(45), Duration::from_secs(240)];

/// What is right at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Truth {
    pub(super) lx: f64,
    pub(super) variance: f64,
}

/// At every place of a scene, in their order.
pub(super) fn truth(
    folder: &Path,
    isolux: &Isolux,
    scene: &TruthScene,
    file: &Path,
    flags: &Flags,
) -> Result<Vec<Truth>, String> {
    let points = scene.points();
    let points_file = folder.join("points.pts");
    std::fs::write(&points_file, &points).map_err(|e| format!("{}: {e}", points_file.display()))?;
    let start = Instant::now();
    let mut sums = vec![Truth { lx: 0.0, variance: 0.0 }; scene.places.len()];
    for batch in 1..=*BATCHES.end() {
        let asked = format!("{} {points} {PATHS} {batch}", scene.hash);
        let name = format!("{}.json", &blake3::hash(asked.as_bytes()).to_hex()[..16]);
        let kept = folder.join("paths").join(name);
        let found = match read(&kept).filter(|_| !flags.fresh) {
            Some(found) => found,
            None => trace(isolux, file, &points_file, batch, &kept)?,
        };
        if found.len() != sums.len() {
            return Err("paths were not traced at every place".into());
        }
        for (sum, one) in sums.iter_mut().zip(found) {
            sum.lx += one.lx;
            sum.variance += one.variance;
        }
        let means = mean(&sums, batch as f64);
        let is_area = |k: usize| scene.places[k].stratum == "area";
        let by_area: Vec<Truth> =
            (0..means.len()).filter(|&k| is_area(k)).map(|k| means[k]).collect();
        let is_enough = BATCHES.contains(&batch) && noise(&by_area) <= ENOUGH * flags.accuracy;
        if is_enough || start.elapsed() > LONGEST[0] {
            return Ok(means);
        }
    }
    Ok(mean(&sums, *BATCHES.end() as f64))
}

fn mean(sums: &[Truth], batches: f64) -> Vec<Truth> {
    let of =
        |sum: &Truth| Truth { lx: sum.lx / batches, variance: sum.variance / (batches * batches) };
    sums.iter().map(of).collect()
}

/// Root mean square of the standard error over that of the light.
fn noise(found: &[Truth]) -> f64 {
    let sum = |f: fn(&Truth) -> f64| found.iter().map(f).sum::<f64>();
    let light = sum(|t| t.lx * t.lx);
    if light > 0.0 { (sum(|t| t.variance) / light).sqrt() } else { 0.0 }
}

fn trace(
    isolux: &Isolux,
    scene: &Path,
    points: &Path,
    seed: u64,
    kept: &Path,
) -> Result<Vec<Truth>, String> {
    let text = |path: &Path| path.display().to_string();
    let words = ["probe", &text(scene), "--points", &text(points), "--json", "--paths"];
    let mut words: Vec<String> = words.map(String::from).into();
    words.extend([PATHS.to_string(), "--seed".into(), seed.to_string()]);
    let ended = isolux.run(&words, LONGEST[1])?;
    let json = ended.json().map_err(|problem| format!("paths: {problem}"))?;
    let values = json["points"].as_array().ok_or("paths gave no points")?;
    let found: Option<Vec<Truth>> = values.iter().map(one).collect();
    let found = found.ok_or("paths left a place out")?;
    let pairs: Vec<[f64; 2]> = found.iter().map(|t| [t.lx, t.variance]).collect();
    if let Some(folder) = kept.parent() {
        std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    }
    std::fs::write(kept, json!(pairs).to_string())
        .map_err(|e| format!("{}: {e}", kept.display()))?;
    Ok(found)
}

/// A place that no path finds light at is dark: it is behind things, or inside of them.
fn one(value: &Value) -> Option<Truth> {
    if value["illuminance_lx"].is_null() {
        return Some(Truth { lx: 0.0, variance: 0.0 });
    }
    let error_lx = value["standard_error_lx"].as_f64()?;
    let lx = value["illuminance_lx"].as_f64()? - value["caustic_lx"].as_f64()?;
    Some(Truth { lx, variance: error_lx * error_lx })
}

fn read(kept: &Path) -> Option<Vec<Truth>> {
    let pairs: Vec<[f64; 2]> = serde_json::from_slice(&std::fs::read(kept).ok()?).ok()?;
    Some(pairs.into_iter().map(|[lx, variance]| Truth { lx, variance }).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two batches of 3 and 5 lx, each known to 1 lx: 4 lx, known to 1 / sqrt(2) lx.
    #[test]
    fn batches_are_averaged() {
        let sums = [Truth { lx: 3.0 + 5.0, variance: 1.0 + 1.0 }];
        let found = mean(&sums, 2.0);
        assert_eq!(found, [Truth { lx: 4.0, variance: 0.5 }]);
        assert!((noise(&found) - 0.5_f64.sqrt() / 4.0).abs() < 1e-15);
    }
}
