//! The table of validation on the terminal: `cargo run --release -p isolux-compare --example table -- 0.01 1 3 [case prefix]`.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "an example for the terminal")]

use isolux::engine::Watch;
use isolux::map::Method;
use isolux_compare::case::cases;
use isolux_compare::{Case, ValidateRow, ValidateSettings, validate_all};
use std::time::Duration;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let settings = ValidateSettings {
        accuracy: words[0].parse().unwrap(),
        time_limit: Duration::from_secs(words.get(4).map_or(10, |w| w.parse().unwrap())),
        ..ValidateSettings::default()
    };
    let seeds: Vec<u64> = (words[1].parse().unwrap()..=words[2].parse().unwrap()).collect();
    let prefix = words.get(3).cloned().unwrap_or_default();
    let chosen: Vec<Case> = cases().into_iter().filter(|c| c.name.starts_with(&prefix)).collect();
    let methods = [Method::Hybrid, Method::Forward];
    let table = validate_all(&chosen, &methods, &seeds, &settings, &mut |row| {
        print(row);
        Watch::Continue
    });
    for calibration in table.calibrations {
        println!("{calibration:?}");
    }
}

fn print(row: &ValidateRow) {
    println!(
        "{:28} {:?} {} {:.2}s inc {} acc {:.5} readings {} stat {} out {}/{} outside {} {:?}",
        row.case,
        row.method,
        row.seed,
        row.time_s,
        row.increments,
        row.accuracy.map_or(f64::NAN, |a| a.reached),
        row.readings,
        row.statistical,
        row.outliers,
        row.accepted_outliers,
        row.outside_interval,
        row.verdict
    );
    if let Some(w) = row.worst {
        println!(
            "    worst {:.2} {:?} at {:.3?}: {:.4} not {:.4}, se {:.4}, bound {:.4}",
            w.ratio,
            w.quantity,
            w.position,
            w.measured_lx,
            w.expected_lx,
            w.standard_error_lx,
            w.bound_lx
        );
    }
}
