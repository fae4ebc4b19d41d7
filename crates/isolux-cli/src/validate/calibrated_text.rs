//! A calibration for reading.

use crate::console::table;
use crate::quantity::{show_seconds, show_share, significant};
use crate::request;
use isolux_compare::calibrate::{
    Calibrated, CalibratedCase, CalibratedStage, Coverage, Decile, Judgement, PredictionTable,
    Stage,
};
use isolux_formats::counted;

/// Tables, remarks and the verdict.
pub(super) fn text(calibrated: &Calibrated) -> String {
    let mut text = String::new();
    if !calibrated.cases.is_empty() {
        text += &coverage_table(&calibrated.cases);
        text += "\nCoverage of intervals by all errors reported; last, of 95 % by standard errors alone.\n\n";
        text += &scene_table(&calibrated.cases);
        text += "\nThe error of the scene: true over reported.\n\n";
        calibrated.cases.iter().for_each(|case| text += &remarks(case));
    }
    if !calibrated.predictions.is_empty() {
        text += "\n";
        text += &prediction_table(&calibrated.predictions);
        text += "\nRuns that ended within 20 % of the time predicted, by share of that time; -: less than 0.25 s of it.\n";
    }
    let verdict = if calibrated.is_kept() { "no promise is broken" } else { "a promise is broken" };
    format!("{text}\n{verdict}\n")
}

fn coverage_table(cases: &[CalibratedCase]) -> String {
    let header = [
        "case",
        "method",
        "stage",
        "increments",
        "runs",
        "68 %",
        "95 %",
        "interval of it",
        "99.7 %",
        "verdict",
        "noise 95 %",
    ];
    let rows = cases.iter().flat_map(|case| {
        case.stages.iter().map(|stage| {
            let mut row = first_columns(case, stage);
            let share = |k: usize| stage.coverage.get(k).map_or("-".to_owned(), percent);
            let interval = stage.coverage.get(1).map_or("-".to_owned(), |c| {
                format!("{:.1} to {:.1}", 100.0 * c.low, 100.0 * c.high)
            });
            let noise = stage.coverage_by_noise.get(1).map_or("-".to_owned(), percent);
            row.extend([share(0), share(1), interval, share(2), verdict(stage), noise]);
            row
        })
    });
    table(&header, &rows.collect::<Vec<_>>())
}

fn first_columns(case: &CalibratedCase, stage: &CalibratedStage) -> Vec<String> {
    let [fewest, middle, most] = stage.increments;
    let increments =
        if fewest == most { middle.to_string() } else { format!("{middle} ({fewest} to {most})") };
    vec![
        case.case.to_owned(),
        request::method_name(case.method).to_owned(),
        stage_name(stage.stage).to_owned(),
        increments,
        stage.runs.to_string(),
    ]
}

fn stage_name(stage: Stage) -> &'static str {
    match stage {
        Stage::FirstBelieved => "first",
        Stage::FourTimes => "4 times",
        Stage::AtStop => "stop",
        Stage::FixedWork => "fixed",
    }
}

fn percent(coverage: &Coverage) -> String {
    format!("{:.1}", 100.0 * coverage.share)
}

fn verdict(stage: &CalibratedStage) -> String {
    match stage.judgement {
        Some(Judgement::Calibrated) => "calibrated".into(),
        Some(Judgement::Short) => "SHORT".into(),
        Some(Judgement::Wide) => "wide".into(),
        None if stage.exact_wrong > 0 => format!("WRONG: {}", stage.exact_wrong),
        None if stage.exact > 0 => "exact".into(),
        None => "-".into(),
    }
}

fn scene_table(cases: &[CalibratedCase]) -> String {
    let header = [
        "case",
        "method",
        "stage",
        "increments",
        "runs",
        "reported",
        "true",
        "median ratio",
        "9 in 10 below",
        "covered %",
        "mean error",
        "audited",
        "contradicted %",
    ];
    let rows = cases.iter().flat_map(|case| {
        let stages = case.stages.iter();
        stages.filter_map(|stage| stage.scene.map(|scene| (stage, scene))).map(|(stage, scene)| {
            let mut row = first_columns(case, stage);
            let sign = if scene.mean_error < 0.0 { "-" } else { "+" };
            row.extend([
                show_share(scene.reported),
                show_share(scene.measured),
                significant(scene.median_ratio, 2),
                significant(scene.ninth_decile_ratio, 2),
                format!("{:.0}", 100.0 * scene.covered),
                format!("{sign}{}", show_share(scene.mean_error.abs())),
                scene.audited.map_or("-".to_owned(), show_share),
                scene.contradicted.map_or("-".to_owned(), |s| format!("{:.1}", 100.0 * s)),
            ]);
            row
        })
    });
    table(&header, &rows.collect::<Vec<_>>())
}

/// What one case says beyond its rows.
fn remarks(case: &CalibratedCase) -> String {
    let mut lines = Vec::new();
    if case.reached < case.runs {
        lines.push(format!("{} of {} runs reached the accuracy", case.reached, case.runs));
    }
    let unknown: u64 = case.stages.iter().map(|stage| stage.unknown).sum();
    if unknown > 0 {
        lines.push(counted(unknown, "reading has no value", "readings have no value"));
    }
    let judged = || case.receivers.iter().filter_map(|r| Some((r, r.coverage?)));
    let short = judged().filter(|(_, c)| c.judge() == Judgement::Short).count();
    let worst = judged().min_by(|a, b| a.1.share.total_cmp(&b.1.share));
    if let Some((receiver, coverage)) = worst {
        let [x, y, z] = receiver.position.map(|c| significant(c, 3));
        lines.push(format!(
            "at the stop {short} of {} places are short; the worst, ({x}, {y}, {z}) m, holds {} %",
            judged().count(),
            percent(&coverage)
        ));
    }
    if let Some(bias) = case.stopping {
        lines.push(format!(
            "stopping changes coverage by {:+.1} \u{b1} {:.1} points{}",
            100.0 * bias.difference,
            100.0 * bias.standard_error,
            if bias.is_found() { ": BIASED" } else { "" }
        ));
    }
    let name = format!("{} {}", case.case, request::method_name(case.method));
    lines.into_iter().map(|line| format!("{name}: {line}\n")).collect()
}

fn prediction_table(predictions: &[PredictionTable]) -> String {
    let header = [
        "scene",
        "method",
        "runs",
        "unreached",
        "increments",
        "time",
        "10 %",
        "20 %",
        "30 %",
        "40 %",
        "50 %",
        "60 %",
        "70 %",
        "80 %",
        "90 %",
        "in interval",
    ];
    let row = |table: &PredictionTable| {
        let middle = |values: Option<[f64; 3]>| values.map(|[_, middle, _]| middle);
        let mut row = vec![
            table.scene.clone(),
            request::method_name(table.method).to_owned(),
            table.runs.to_string(),
            table.unreached.to_string(),
            middle(table.increments).map_or("-".to_owned(), |n| significant(n, 2)),
            middle(table.finish_s).map_or("-".to_owned(), show_seconds),
        ];
        let share = |d: &Decile| match d.runs {
            0 => "-".to_owned(),
            _ => format!("{:.0}", 100.0 * d.share),
        };
        row.extend(table.deciles.iter().map(share));
        row.resize(15, "-".to_owned());
        let [inside, said] = table
            .deciles
            .iter()
            .fold([0, 0], |[inside, said], d| [inside + d.in_interval, said + d.said]);
        let share = (100 * inside).checked_div(said);
        row.push(share.map_or("-".to_owned(), |percent| format!("{percent} %")));
        row
    };
    table(&header, &predictions.iter().map(row).collect::<Vec<_>>())
}
