//! The table of validation on the terminal:
//! `cargo run --release -p isolux-compare --example table -- ACCURACY SEEDS [PART OF CASE] [METHOD] [SECONDS]`.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "an example for the terminal")]

use isolux::map::Method;
use isolux_compare::case::cases;
use isolux_compare::{Case, ValidateRow, ValidateSettings, validate_all};
use std::time::Duration;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let word = |k: usize| words.get(k).cloned().unwrap_or_default();
    let settings = ValidateSettings {
        accuracy: words[0].parse().unwrap(),
        time_limit: Duration::from_secs(words.get(4).map_or(30, |w| w.parse().unwrap())),
        ..ValidateSettings::default()
    };
    let seeds: Vec<u64> = (1..=words[1].parse().unwrap()).collect();
    let chosen: Vec<Case> = cases().into_iter().filter(|c| c.name.contains(&word(2))).collect();
    let mut methods = vec![Method::Hybrid, Method::Forward];
    methods.retain(|m| format!("{m:?}").to_lowercase().contains(&word(3)));
    let table = validate_all(&chosen, &methods, &seeds, &settings, (&mut print, &|| false));
    for calibration in table.calibrations {
        println!("{calibration:?}");
    }
}

fn print(row: &ValidateRow) {
    println!(
        "{:28} {:?} {} {:.2}s inc {} acc {:?} readings {} stat {} out {}/{} outside {} {:?}",
        row.case,
        row.method,
        row.seed,
        row.time_s,
        row.increments,
        row.accuracy.map(|a| (a.reached, a.statistical, a.discretization, a.bias)),
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
