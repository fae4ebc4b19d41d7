//! All figures of a study as a table for programs: one row a map, an empty field for what is not known.

use crate::case::cube::TABLE_1;
use crate::metric::{ColourDifference, figure_of_merit};
use crate::study::{CaseStudy, Distances, Measured, Point, Prediction, Series, Study};

/// A row under construction: names of columns and their fields, so that neither is without the other.
#[derive(Default)]
struct Row {
    names: Vec<String>,
    fields: Vec<String>,
}

impl Row {
    fn text(&mut self, name: impl Into<String>, field: impl Into<String>) {
        self.names.push(name.into());
        self.fields.push(field.into());
    }

    /// A number as precise as it is; what is not known, or no number, is empty.
    fn number(&mut self, name: impl Into<String>, value: Option<f64>) {
        let known = value.filter(|value| value.is_finite());
        self.text(name, known.map(|value| value.to_string()).unwrap_or_default());
    }
}

/// The whole study.
pub(super) fn csv(study: &Study) -> String {
    let header = row(study, None).names;
    let rows = study.cases.iter().flat_map(|case| {
        case.series.iter().flat_map(move |series| {
            series.points.iter().map(move |point| row(study, Some((case, series, point))).fields)
        })
    });
    std::iter::once(header).chain(rows).map(|fields| line(&fields)).collect()
}

fn line(fields: &[String]) -> String {
    let fields: Vec<String> = fields.iter().map(|field| quoted(field)).collect();
    format!("{}\n", fields.join(","))
}

/// A field as RFC 4180 has it.
fn quoted(field: &str) -> String {
    if field.contains(['"', ',', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}

/// The row of a map, or only its names of columns.
fn row(study: &Study, of: Option<(&CaseStudy, &Series, &Point)>) -> Row {
    let (case, series, point) = (of.map(|of| of.0), of.map(|of| of.1), of.map(|of| of.2));
    let mut row = Row::default();
    add_run(&mut row, study);
    add_case(&mut row, case);
    row.text("system", series.map(|series| series.system.name()).unwrap_or_default());
    add_work(&mut row, point);
    add_told(&mut row, point);
    add_audited(&mut row, point);
    add_measured(&mut row, point.and_then(|point| point.measured.as_ref()));
    add_merit(&mut row, point);
    row.text("picture", point.and_then(|point| point.picture.clone()).unwrap_or_default());
    add_distances(&mut row, "from_last", point.and_then(|point| point.from_last.as_ref()));
    add_distances(
        &mut row,
        "from_reference",
        point.and_then(|point| point.from_reference.as_ref()),
    );
    row.text(
        "predictions(at_s error finish_s earliest_s latest_s;)",
        point.map(|point| predictions(&point.predictions)).unwrap_or_default(),
    );
    row
}

fn add_run(row: &mut Row, study: &Study) {
    let settings = &study.settings;
    row.text("isolux", &study.isolux);
    row.text("processor", &study.machine.processor);
    row.text("operating_system", &study.machine.system);
    row.text("cores", study.machine.cores.to_string());
    row.text("threads", settings.threads.to_string());
    row.text("seed", settings.seed.to_string());
    row.number("limit_s", Some(settings.limit_s));
    let [width, height] = settings.picture;
    row.text("picture_width_pixels", width.to_string());
    row.text("picture_height_pixels", height.to_string());
}

fn add_case(row: &mut Row, case: Option<&CaseStudy>) {
    let reference = case.and_then(|case| case.reference.as_ref());
    row.text("case", case.map(|case| case.name.clone()).unwrap_or_default());
    row.text("scene_hash", case.map(|case| case.scene_hash.clone()).unwrap_or_default());
    row.text("triangles", case.map(|case| case.triangles.to_string()).unwrap_or_default());
    row.text("luminaires", case.map(|case| case.luminaires.to_string()).unwrap_or_default());
    row.text("reference_picture", reference.map(|of| of.picture.clone()).unwrap_or_default());
    row.number("reference_told_relative", reference.and_then(|of| of.told));
    row.number("reference_asked_relative", reference.map(|of| of.accuracy));
    row.number("reference_landing_over_emitted", reference.and_then(|of| of.landing));
    row.number("right_landing_over_emitted", case.and_then(|case| case.landing));
    row.number("reference_time_s", reference.map(|of| of.time_s));
}

fn add_work(row: &mut Row, point: Option<&Point>) {
    row.number("asked_s", point.map(|point| point.asked_s));
    row.number("asked_relative", point.and_then(|point| point.accuracy));
    row.text("effort", point.and_then(|point| point.effort.clone()).unwrap_or_default());
    row.number("time_s", point.map(|point| point.time_s));
    let whole = |of: Option<u64>| of.map(|count| count.to_string()).unwrap_or_default();
    row.text("rays", whole(point.and_then(|point| point.rays)));
    row.text("receivers", whole(point.and_then(|point| point.receivers)));
    row.number("landing_over_emitted", point.and_then(|point| point.landing));
}

fn add_told(row: &mut Row, point: Option<&Point>) {
    let told = point.map(|point| point.reported).unwrap_or_default();
    row.number("reported_error_relative", told.error);
    row.number("reported_noise_relative", told.noise);
    row.number("reported_bare_relative", told.bare);
    row.number("unshot_share", told.unshot);
    row.number("filtered_share", told.filtered);
}

fn add_audited(row: &mut Row, point: Option<&Point>) {
    let audited = point.and_then(|point| point.audited);
    row.number("audited_error_relative", audited.map(|of| of.error));
    row.number("audited_low_relative", audited.map(|of| of.low));
    row.number("audited_high_relative", audited.map(|of| of.high));
    row.text("audit_contradicts", audited.map(|of| of.contradicts.to_string()).unwrap_or_default());
}

/// Points have columns by their letters: those of CUBE are A to F, the one of SPHERE is C.
fn add_measured(row: &mut Row, measured: Option<&Measured>) {
    row.number("measured_error_relative", measured.map(|of| of.error));
    row.number("measured_grid_relative", measured.map(|of| of.grid));
    row.number("covered_share", measured.and_then(|of| of.covered));
    row.number("told_over_true", measured.and_then(|of| of.told_over_true));
    for letter in TABLE_1.map(|point| point.name) {
        let points = measured.map(|of| of.points.as_slice()).unwrap_or_default();
        let point = points.iter().find(|point| point.name == letter);
        row.number(format!("{letter}_expected_lx"), point.map(|of| of.expected_lx));
        row.number(format!("{letter}_measured_lx"), point.map(|of| of.measured_lx));
        row.number(
            format!("{letter}_standard_error_lx"),
            point.and_then(|of| of.standard_error_lx),
        );
    }
}

fn add_merit(row: &mut Row, point: Option<&Point>) {
    let measured = point.and_then(|point| merit(point, Some(point.measured.as_ref()?.error)));
    let audited = point.and_then(|point| merit(point, Some(point.audited?.error)));
    row.number("merit_measured_per_s", measured);
    row.number("merit_audited_per_s", audited);
    row.number("merit_reported_per_s", point.and_then(|point| merit(point, point.reported.error)));
}

fn merit(point: &Point, error: Option<f64>) -> Option<f64> {
    figure_of_merit(error?, point.time_s)
}

fn add_distances(row: &mut Row, from: &str, distances: Option<&Distances>) {
    let components = distances.map(|of| of.rgb.components).unwrap_or_default();
    for (name, share) in ["red", "green", "blue"].into_iter().zip(components) {
        row.number(format!("{from}_l2_{name}_relative"), share);
    }
    row.number(format!("{from}_l2_mean_relative"), distances.and_then(|of| of.rgb.mean));
    add_colours(row, &format!("{from}_cie1976"), distances.map(|of| &of.cie1976));
    add_colours(row, &format!("{from}_cie1994"), distances.map(|of| &of.cie1994));
    add_colours(row, &format!("{from}_ciede2000"), distances.map(|of| &of.ciede2000));
}

fn add_colours(row: &mut Row, name: &str, of: Option<&ColourDifference>) {
    row.number(format!("{name}_mean"), of.map(|of| of.mean));
    row.number(format!("{name}_median"), of.map(|of| of.median));
    row.number(format!("{name}_p95"), of.map(|of| of.p95));
    row.number(format!("{name}_greatest"), of.map(|of| of.greatest));
}

/// All of them in one field: numbers of a prediction apart by spaces, predictions by semicolons; `-` is not known.
fn predictions(predictions: &[Prediction]) -> String {
    let one = |of: &Prediction| {
        let error = of.error.map_or_else(|| "-".to_owned(), |error| error.to_string());
        format!("{} {error} {} {} {}", of.at_s, of.finish_s, of.earliest_s, of.latest_s)
    };
    predictions.iter().map(one).collect::<Vec<_>>().join(";")
}
