//! The comparison of all systems, as short as it can be, and what must hold of any.

use crate::smoke::isolux;
use serde_json::Value;
use std::path::Path;

/// The error on CUBE that the study's LVS stopped at, in 1998.
const ERROR_OF_LVS: f64 = 0.028;

/// How many systems are of isolux.
const OWN: usize = 7;

/// Runs it into an empty folder and looks at its report.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    let folder = root.join("target").join("compared");
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    }
    isolux(root, &["compare", "all", "--quick", "-o", &folder.to_string_lossy()])?;
    for name in ["report.html", "report.md", "study.csv"] {
        let length = std::fs::metadata(folder.join(name)).map_or(0, |of| of.len());
        if length == 0 {
            return Err(format!("compare: {name} is not there, or empty"));
        }
    }
    let text = std::fs::read(folder.join("study.json")).map_err(|e| format!("study.json: {e}"))?;
    let study: Value = serde_json::from_slice(&text).map_err(|e| format!("study.json: {e}"))?;
    check(&study)
}

fn check(study: &Value) -> Result<String, String> {
    let cases = array(&study["cases"]);
    let names: Vec<&str> = cases.iter().filter_map(|case| case["name"].as_str()).collect();
    if names != ["cube", "sphere", "hall", "demo"] {
        return Err(format!("compare: cases {names:?}"));
    }
    for case in cases {
        let with_maps = array(&case["series"]).iter().filter(|of| !array(&of["points"]).is_empty());
        if with_maps.count() < OWN {
            return Err(format!("compare: {} has systems without maps", case["name"]));
        }
    }
    let hybrid = array(&cases[0]["series"]).iter().find(|of| of["system"] == "hybrid");
    let errors = hybrid
        .into_iter()
        .flat_map(|of| array(&of["points"]))
        .filter_map(|point| point["measured"]["error"].as_f64());
    let least = errors.fold(f64::INFINITY, f64::min);
    if least < ERROR_OF_LVS {
        Ok(format!("the least error of hybrid on CUBE is {:.3} %", 100.0 * least))
    } else {
        Err(format!("compare: the least error of hybrid on CUBE is {least}"))
    }
}

fn array(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}
