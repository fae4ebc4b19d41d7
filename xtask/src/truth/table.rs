//! Rows as a table, worst first.

use super::judged::{MOST_OUTSIDE, MOST_OVER_TOLD};
use serde_json::Value;
use std::cmp::Ordering;

/// Noise of the paths, in errors told, up to which they tell a true error of 1.5 times the one told: 1.96 times
/// `noise^2 sqrt(2 / 400)`, the noise of a mean of squares over 400 places, is less than `1.5^2 - 1`.
const MOST_NOISE: f64 = 3.0;

/// What a row comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Verdict {
    /// No map, or none that could be read.
    Failed,
    /// Certainly wrong beyond what is told.
    Broken,
    /// Wrong beyond what is told as far as the places tell, within their chance.
    Doubtful,
    /// Paths are too noisy to tell.
    Untold,
    /// Paths leave light out that is there: nothing follows.
    Unjudged,
    /// It says itself that it is not done.
    Unfinished,
    Right,
}

fn verdict(row: &Value) -> Verdict {
    let Some(over) = row["over_told"].as_f64() else {
        // A map that is not done may not know its error yet.
        let has_map = row["exit"] == 3 && row["failed"].is_null();
        return if has_map { Verdict::Unfinished } else { Verdict::Failed };
    };
    let over_low = row["over_told_low"].as_f64().unwrap_or(over);
    let outside = row["outside"].as_f64().unwrap_or(0.0);
    let is_negative = row["negative"].as_u64() != Some(0);
    let [noise, told] = ["paths_noise", "told"].map(|key| row[key].as_f64().unwrap_or(0.0));
    let is_untold = noise > MOST_NOISE * told;
    if row["leaves_caustics"] == true {
        Verdict::Unjudged
    } else if is_untold && outside <= MOST_OUTSIDE && !is_negative {
        Verdict::Untold
    } else if over_low > MOST_OVER_TOLD || are_outside(row, "") || is_negative {
        Verdict::Broken
    } else if over > MOST_OVER_TOLD || outside > MOST_OUTSIDE {
        Verdict::Doubtful
    } else if row["exit"] == 0 {
        Verdict::Right
    } else {
        Verdict::Unfinished
    }
}

/// Whether more readings of a stratum are outside than may be, beyond chance: one-sided 95 % of so many.
fn are_outside(row: &Value, stratum: &str) -> bool {
    let number = |key: &str| row[format!("{key}{stratum}")].as_f64();
    let (outside, places) = (number("outside").unwrap_or(0.0), number("places").unwrap_or(1.0));
    outside > MOST_OUTSIDE + 1.645 * (MOST_OUTSIDE * (1.0 - MOST_OUTSIDE) / places.max(1.0)).sqrt()
}

const fn name(verdict: Verdict, is_done: bool) -> &'static str {
    match (verdict, is_done) {
        (Verdict::Failed, _) => "failed",
        (Verdict::Broken, true) => "BROKEN",
        (Verdict::Broken, false) => "broken, not done",
        (Verdict::Doubtful, _) => "doubtful",
        (Verdict::Untold, _) => "paths too noisy",
        (Verdict::Unjudged, _) => "paths leave caustics",
        (Verdict::Unfinished, _) => "not done",
        (Verdict::Right, _) => "right",
    }
}

/// Rows that failed first, then by how far the truth is beyond what was told.
pub(super) fn worse_first(a: &Value, b: &Value) -> Ordering {
    let over = |row: &Value| row["over_told"].as_f64().unwrap_or(0.0);
    verdict(a).cmp(&verdict(b)).then(over(b).total_cmp(&over(a)))
}

const COLUMNS: [&str; 19] = [
    "scene",
    "kind",
    "half",
    "method",
    "seed",
    "limit s",
    "exit",
    "time s",
    "Mrays",
    "reported %",
    "audited %",
    "true %",
    "true / reported",
    "outside %",
    "largest z",
    "outside % beside",
    "largest z beside",
    "paths' noise %",
    "verdict",
];

/// One row as its cells.
fn cells(row: &Value) -> [String; 19] {
    let text = |key: &str| row[key].as_str().unwrap_or_default().to_owned();
    let number = |key: &str, factor: f64, digits: usize| {
        row[key].as_f64().map_or(String::new(), |n| format!("{:.digits$}", factor * n))
    };
    let percent = |key: &str| number(key, 100.0, 2);
    let range = match row["true"].as_f64() {
        Some(_) => {
            format!("{} ({} to {})", percent("true"), percent("true_low"), percent("true_high"))
        }
        None => String::new(),
    };
    let is_done = row["exit"] == 0;
    let mut says = name(verdict(row), is_done).to_owned();
    for (key, what) in [("unknown", "unknown but lit"), ("negative", "below 0 lx")] {
        let count = row[key].as_u64().unwrap_or(0);
        if count > 0 {
            says += &format!(", {count} {what}");
        }
    }
    if are_outside(row, "_beside") {
        says += ", readings beside outside";
    }
    if let Some(problem) = row["failed"].as_str() {
        says += &format!(": {}", problem.replace('|', "/"));
    }
    [
        text("scene"),
        text("kind"),
        text("half"),
        text("method"),
        number("seed", 1.0, 0),
        number("time_limit_s", 1.0, 0),
        number("exit", 1.0, 0),
        number("time_s", 1.0, 1),
        number("rays", 1e-6, 2),
        percent("told"),
        percent("audited"),
        range,
        number("over_told", 1.0, 2),
        number("outside", 100.0, 1),
        number("largest_z", 1.0, 1),
        number("outside_beside", 100.0, 1),
        number("largest_z_beside", 1.0, 1),
        percent("paths_noise"),
        says,
    ]
}

/// One row in a line.
pub(super) fn line(row: &Value) -> String {
    cells(row).join(" | ")
}

/// All of it.
pub(super) fn markdown(result: &Value) -> String {
    let machine = &result["machine"];
    let mut text = format!(
        "# Maps beside long paths\n\nMade by `cargo xtask bench truth`, {}, to {} %, on {} ({} cores, {}, load before {}). \
         What the columns mean is in [README.md](README.md).\n\n",
        result["isolux"].as_str().unwrap_or("isolux"),
        100.0 * result["accuracy"].as_f64().unwrap_or(0.0),
        machine["processor"].as_str().unwrap_or("unknown"),
        machine["cores"],
        machine["system"].as_str().unwrap_or("unknown"),
        machine["load_before"],
    );
    text += &format!("| {} |\n|{}\n", COLUMNS.join(" | "), "---|".repeat(COLUMNS.len()));
    for row in result["rows"].as_array().into_iter().flatten() {
        text += &format!("| {} |\n", line(row));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn row(over: f64, over_low: f64, outside: f64) -> Value {
        json!({ "exit": 0, "places": 400, "over_told": over, "over_told_low": over_low, "outside": outside, "negative": 0 })
    }

    #[test]
    fn worst_come_first_and_chance_is_no_verdict() {
        let mut rows = [
            row(0.9, 0.8, 0.05),
            row(4.0, 3.0, 0.05),
            row(1.6, 1.2, 0.05),
            json!({ "failed": "no map" }),
            row(1.0, 0.9, 0.2),
        ];
        rows.sort_by(worse_first);
        let verdicts = rows.each_ref().map(verdict);
        use Verdict::{Broken, Doubtful, Failed, Right};
        assert_eq!(verdicts, [Failed, Broken, Broken, Doubtful, Right]);
        let mut noisy = row(4.0, 3.0, 0.05);
        (noisy["told"], noisy["paths_noise"]) = (json!(0.01), json!(0.04));
        assert_eq!(verdict(&noisy), Verdict::Untold);
        // 8.5 % of 400 may be chance.
        assert_eq!(verdict(&row(0.9, 0.8, 0.085)), Doubtful);
    }

    #[test]
    fn a_table_has_a_line_for_every_row() {
        let text = markdown(&json!({ "rows": [row(1.0, 0.9, 0.05)], "accuracy": 0.02 }));
        assert_eq!(text.lines().filter(|l| l.starts_with('|')).count(), 3);
    }
}
