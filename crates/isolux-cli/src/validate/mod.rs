//! `isolux validate`: the cases with exact answers.

mod calibrate;
mod calibrated_text;
mod chosen;

use crate::audit;
use crate::console::{print, print_json, table, wrapped};
use crate::failure::{Failure, Outcome};
use crate::flags::{MethodName, ValidateFlags};
use crate::interrupt::Interrupt;
use crate::notes::{Note, note};
use crate::quantity::{show_seconds, show_share, significant};
use crate::request;
use chosen::{chosen, methods, seeds};
use isolux_compare::{
    Calibration, ValidateRow, ValidateSettings, ValidateTable, Verdict, validate_all,
};

/// Runs the subcommand.
pub(crate) fn run(flags: &ValidateFlags, json: bool) -> Result<Outcome, Failure> {
    if flags.calibrate && flags.method == Some(MethodName::Radiosity) {
        return Err(Failure::bad_input(
            "--calibrate judges the spread of replicates, which --method radiosity has none of; leave \
             one of them out",
        ));
    }
    if flags.calibrate {
        return calibrate::run(flags, json);
    }
    let cases = chosen(flags.case.as_deref())?;
    let methods = methods(flags);
    let seeds = seeds(flags.seeds.unwrap_or(1));
    let interrupt = Interrupt::install()?;
    let settings = ValidateSettings::default();
    let on_row = &mut |row: &ValidateRow| note(Note::Info, line(row));
    let is_over = || interrupt.is_requested();
    let table = validate_all(&cases, &methods, &seeds, &settings, (on_row, &is_over));
    let (done, all) = (table.rows.len(), cases.len() * methods.len() * seeds.len());
    if done < all {
        note(
            Note::Warning,
            format!("interrupted: {done} of {all} runs are done, and only they are reported"),
        );
    }
    if json {
        print_json(&table)?
    } else {
        print(&text(&table))?
    }
    let failed = table.rows.iter().any(|row| row.verdict != Verdict::Pass);
    Ok(match (done < all, failed) {
        (true, _) => Outcome::Interrupted,
        (false, true) => Outcome::CheckFailed,
        (false, false) => Outcome::Done,
    })
}

/// A row while it comes.
fn line(row: &ValidateRow) -> String {
    let method = request::method_name(row.method);
    format!("{} {method} {}: {}", row.case, row.seed, verdict(row))
}

fn verdict(row: &ValidateRow) -> String {
    match &row.verdict {
        Verdict::Pass => "pass".to_owned(),
        Verdict::Fail { reason } => format!("FAIL: {reason}"),
    }
}

fn text(table_of_cases: &ValidateTable) -> String {
    let header = [
        "case, method, seed",
        "error",
        "audited",
        "readings",
        "outliers allowed",
        "worst",
        "time",
        "verdict",
    ];
    let rows: Vec<Vec<String>> = table_of_cases.rows.iter().map(row).collect();
    let calibrations = table_of_cases.calibrations.iter().map(calibration);
    let failed = table_of_cases.rows.iter().filter(|r| r.verdict != Verdict::Pass).count();
    let passed = table_of_cases.rows.len() - failed;
    let calibrations: String = calibrations.collect();
    format!("{}\n{calibrations}{passed} passed, {failed} failed\n", table(&header, &rows))
}

fn row(row: &ValidateRow) -> Vec<String> {
    let number = |value: Option<f64>| value.map_or("-".to_owned(), |v| significant(v, 2));
    vec![
        format!("{} {} {}", row.case, request::method_name(row.method), row.seed),
        row.accuracy.map_or("-".to_owned(), |a| show_share(a.reached)),
        row.audit.as_ref().map_or("-".to_owned(), |a| audit::interval(&a.error)),
        row.readings.to_string(),
        format!("{} of {}", row.outliers, row.accepted_outliers),
        number(row.worst.as_ref().map(|worst| worst.ratio)),
        show_seconds(row.time_s),
        verdict(row),
    ]
}

fn calibration(calibration: &Calibration) -> String {
    let method = request::method_name(calibration.method);
    let Some(coverage) = calibration.coverage else {
        return format!("{method}: no reading with a statistical error\n");
    };
    wrapped(&format!(
        "{method}: intervals of 95 % hold {:.1} % of {} readings ({} outside, chance allows {})",
        100.0 * coverage,
        calibration.readings,
        calibration.outside,
        calibration.accepted_outside
    ))
}
