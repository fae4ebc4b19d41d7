//! The tables of `docs/book/reliability.md`, made of `benchmarks/reliability/table.json`.

use serde_json::Value;
use std::path::Path;

pub(super) const TABLE: &str = "benchmarks/reliability/table.json";
const PAGE: &str = "docs/book/reliability.md";
/// What stands between these two is made of the table.
const BEGIN: &str = "<!-- cargo xtask reliability --save writes from here -->\n";
const END: &str = "<!-- to here -->\n";

/// A part of the table: its heading, and its columns by key and title.
struct Part {
    key: &'static str,
    heading: &'static str,
    /// Whether the last line has sums.
    is_summed: bool,
    columns: &'static [(&'static str, &'static str)],
}

const PARTS: [Part; 7] = [
    Part {
        key: "kills",
        heading: "Runs stopped and resumed",
        is_summed: true,
        columns: &[
            ("fault", "fault"),
            ("runs", "runs"),
            ("stopped", "stopped before their end (some twice)"),
            ("maps_read", "maps found, all whole"),
            ("from_state", "resumed from a checkpoint"),
            ("unfinished_left", "unfinished files left"),
            ("in_time", "complete within their limit"),
            ("same_bytes", "ended with the same bytes"),
        ],
    },
    Part {
        key: "disk",
        heading: "Full disks",
        is_summed: true,
        columns: &[
            ("fault", "fault"),
            ("runs", "runs"),
            ("kept", "said so, exit code 4, earlier file kept"),
        ],
    },
    Part {
        key: "foreign",
        heading: "Damaged and foreign checkpoints",
        is_summed: true,
        columns: &[
            ("state", "checkpoint"),
            ("tried", "tried"),
            ("refused", "refused by name, nothing overwritten"),
            ("same_bytes", "gone on with to the same bytes"),
            ("no_panic", "ended in order"),
        ],
    },
    Part {
        key: "twice",
        heading: "Two runs with one output",
        is_summed: true,
        columns: &[
            ("fault", "runs"),
            ("runs", "tried"),
            ("one_refused_same_bytes", "one refused, the other with the right bytes"),
        ],
    },
    Part {
        key: "same",
        heading: "The same bytes",
        is_summed: true,
        columns: &[("what", "compared"), ("runs", "runs"), ("same_bytes", "same bytes")],
    },
    Part {
        key: "sizes",
        heading: "Small files with much in them",
        is_summed: false,
        columns: &[
            ("what", "a file with many"),
            ("count", "how many"),
            ("kilobytes", "kB"),
            ("seconds", "`check`, s"),
            ("peak_mb", "memory, MB"),
            ("ended", "ended"),
        ],
    },
    Part {
        key: "hostile",
        heading: "Hostile files",
        is_summed: true,
        columns: &[("reader", "reader"), ("tried", "files tried"), ("read", "of them still valid")],
    },
];

/// Puts the tables into the page.
pub(super) fn write(root: &Path, table: &Value) -> Result<(), String> {
    let path = root.join(PAGE);
    let text = std::fs::read_to_string(&path).map_err(|e| format!("{PAGE}: {e}"))?;
    std::fs::write(&path, with_tables(&text, table)?).map_err(|e| format!("{PAGE}: {e}"))
}

/// A page with these tables in place of those it has.
fn with_tables(page: &str, table: &Value) -> Result<String, String> {
    let missing = || format!("{PAGE}: has no lines `{}` and `{}`", BEGIN.trim(), END.trim());
    let (before, rest) = page.split_once(BEGIN).ok_or_else(missing)?;
    let (_, after) = rest.split_once(END).ok_or_else(missing)?;
    Ok(format!("{before}{BEGIN}\n{}\n{END}{after}", tables(table)))
}

/// All tables there are.
pub(super) fn tables(table: &Value) -> String {
    let texts = PARTS.iter().filter_map(|part| text(part, &table[part.key]));
    texts.collect::<Vec<_>>().join("\n")
}

fn text(part: &Part, of: &Value) -> Option<String> {
    let rows = of["rows"].as_array()?;
    // Columns that no row knows are left out, as those of an optional comparison.
    let columns: Vec<&(&str, &str)> =
        part.columns.iter().filter(|(key, _)| rows.iter().any(|row| !row[key].is_null())).collect();
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let mut text = format!("### {}\n\n", part.heading);
    text += &line(columns.iter().map(|(_, title)| (*title).to_owned()).collect());
    text += &line(columns.iter().map(|_| "---".to_owned()).collect());
    for row in rows {
        text += &line(columns.iter().map(|(key, _)| cell(&row[key])).collect());
    }
    if part.is_summed && rows.len() > 1 {
        text += &line(columns.iter().enumerate().map(|(k, (key, _))| sum(rows, k, key)).collect());
    }
    let known = |key: &str| of[key].as_str().unwrap_or_default();
    let machine = &of["machine"];
    let processor = machine["processor"].as_str().unwrap_or_default();
    let (command, isolux) = (known("command"), known("isolux"));
    text += &format!(
        "\n`{command}`: {isolux}, {processor}, {} cores, {} s.\n",
        machine["cores"],
        cell(&of["seconds"])
    );
    Some(text)
}

fn cell(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Number(number) => number.as_f64().unwrap_or(f64::NAN).to_string(),
        _ => String::new(),
    }
}

/// The last line of a table.
fn sum(rows: &[Value], column: usize, key: &str) -> String {
    let all: u64 = rows.iter().filter_map(|row| row[key].as_u64()).sum();
    if column == 0 { "**all**".to_owned() } else { format!("**{all}**") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_page_is_made_of_the_table() {
        let root = crate::workspace_root();
        let read = |path: &str| std::fs::read_to_string(root.join(path)).unwrap();
        let table = serde_json::from_str(&read(TABLE)).unwrap();
        assert!(
            with_tables(&read(PAGE), &table).unwrap() == read(PAGE),
            "run cargo xtask reliability --save"
        );
    }

    #[test]
    fn the_page_is_reached_by_its_links() {
        let page = std::fs::read_to_string(crate::workspace_root().join(PAGE)).unwrap();
        assert!(page.contains("\n## What is not bounded well\n"));
    }

    #[test]
    fn a_table_has_the_columns_that_are_known_and_a_sum() {
        let rows = json!([{ "state": "a", "tried": 2, "refused": 2 }, { "state": "b", "tried": 1, "refused": 0 }]);
        let table =
            json!({ "foreign": { "command": "c", "isolux": "i", "machine": {}, "rows": rows } });
        let text = tables(&table);
        assert!(
            text.contains("| a | 2 | 2 |\n| b | 1 | 0 |\n| **all** | **3** | **2** |\n"),
            "{text}"
        );
        assert!(!text.contains("ended in order"), "{text}");
    }
}
