//! `isolux audit`: an independent test of what a map claims.

use crate::console::{facts, print, print_json, table};
use crate::energy;
use crate::failure::{Failure, Outcome};
use crate::flags::AuditFlags;
use crate::map_file;
use crate::meter::Meter;
use crate::quantity::{show_count, show_share, significant};
use crate::shown::name;
use isolux::engine::{self, AuditSettings};
use isolux::map::{
    Audit, AuditTrust, AuditedError, AuditedPlace, AuditedReadings, AuditedSurface, EnergyBalance,
};
use isolux::units::with_error;
use serde::Serialize;

/// An audit that would not have found an error as large as all the light tells nothing.
const BLIND: f64 = 1.0;

/// Runs the subcommand.
pub(crate) fn run(flags: &AuditFlags, json: bool) -> Result<Outcome, Failure> {
    let (scene, map) = map_file::read(&flags.map)?;
    let default = AuditSettings::default();
    let settings = AuditSettings {
        places: flags.places.unwrap_or(default.places),
        paths: flags.paths.unwrap_or(default.paths),
        seed: flags.seed.unwrap_or(map.provenance.seed),
        // The audits of the run itself have other places.
        number: u32::MAX,
        ..default
    };
    let mut meter = Meter::new("audit", None);
    let watch = &mut |share| meter.tell(share);
    let audit = engine::audit_watched(&scene, &map, &settings, watch);
    drop(meter);
    let audit = audit.ok_or_else(|| {
        let path = flags.map.display();
        Failure::bad_input(format!(
            "{path}: there is nothing to audit: the map has no reported error, knows next to none of its surfaces, or has no light; solve it with more time"
        ))
    })?;
    let energy = energy::of_audit(&scene, &map, settings.seed);
    let holds = energy.as_ref().is_none_or(EnergyBalance::holds) && !audit.contradicts;
    let outcome = if holds { Outcome::Done } else { Outcome::CheckFailed };
    if json {
        let map = flags.map.display().to_string();
        print_json(&Report { map, audit: &audit, energy: energy.as_ref() })?;
    } else {
        print(&(text(&audit) + &energy.as_ref().map_or(String::new(), energy::text)))?;
    }
    Ok(outcome)
}

/// What `audit --json` prints.
#[derive(Serialize)]
struct Report<'a> {
    map: String,
    #[serde(flatten)]
    audit: &'a Audit,
    #[serde(skip_serializing_if = "Option::is_none")]
    energy: Option<&'a EnergyBalance>,
}

/// An audit for people: the verdict, the table of checks, where readings and paths differ most.
pub(crate) fn text(audit: &Audit) -> String {
    let mut all = vec![
        ("reported error", show_share(audit.told)),
        ("audited error", interval(&audit.error)),
        ("  of the interpolated map", interval(&audit.interpolated)),
        (
            "  in the mean",
            format!(
                "({}) %",
                with_error(100.0 * audit.mean_error, 100.0 * audit.mean_error_standard_error)
            ),
        ),
        ("would have found", would_find(audit)),
        ("places", places(audit)),
        ("paths", show_count(audit.paths as f64)),
        ("verdict", verdict(audit).to_owned()),
    ];
    if audit.untested > 0.0 {
        all.push((
            "not tested",
            format!(
                "caustics of luminaires without surface, {} of all light",
                show_share(audit.untested)
            ),
        ));
    }
    let findings =
        if audit.worst.is_empty() { String::new() } else { format!("\n{}", findings(audit)) };
    format!("{}\n{}{findings}", facts(&all), checks(audit))
}

/// One line for the report of a run.
pub(crate) fn line(audit: &Audit) -> String {
    let found = interval(&audit.error);
    let places = audit.places;
    match audit.contradicts {
        false if audit.would_find > BLIND => format!(
            "could not be judged: paths to {places} places are too noisy to find an error below {}",
            show_share(audit.would_find)
        ),
        false => format!(
            "{found}, by {places} places; {} would have been found",
            show_share(audit.would_find)
        ),
        true => {
            format!("{found}, by {places} places, where {} was reported", show_share(audit.told))
        }
    }
}

fn would_find(audit: &Audit) -> String {
    let [any, alike] = [audit.would_find, audit.would_find_alike].map(show_share);
    format!("errors from {any} on, {alike} where they are alike everywhere")
}

/// An error with its interval.
pub(crate) fn interval(error: &AuditedError) -> String {
    let AuditedError { value, low, high } = *error;
    format!("{} ({} to {})", show_share(value), show_share(low), show_share(high))
}

fn places(audit: &Audit) -> String {
    let hard = audit.hard_readings.places;
    let unknown = match audit.unknown_places {
        0 => String::new(),
        some => format!("; {some} of which the map knows nothing left out"),
    };
    format!("{} by area, {hard} where trouble is likely{unknown}", audit.places)
}

fn verdict(audit: &Audit) -> &'static str {
    match audit.contradicts {
        true => "contradicted: the error is larger than reported",
        false if audit.would_find > BLIND => "could not be judged: its paths are too noisy",
        false => "not contradicted",
    }
}

/// What may be believed and why, one line each.
pub(crate) fn checks(audit: &Audit) -> String {
    let AuditTrust { variance_of_variance, tail_index, trend } = audit.trust;
    let row = |what: &str, (value, asked): (String, String), passes: Result<bool, &str>| {
        let result = match passes {
            Ok(true) => "passed".to_owned(),
            Ok(false) => "not passed".to_owned(),
            Err(why) => format!("not judged: {why}"),
        };
        vec![what.to_owned(), value, asked, result]
    };
    let figure = |of: Option<f64>| of.map_or("-".to_owned(), |value| significant(value, 2));
    let is_told = |of: &AuditedReadings| match of.true_over_told {
        Some(_) => Ok(of.at_least <= Audit::MOST_UNTOLD),
        None => Err("no error is reported there"),
    };
    let rows = [
        row(
            "error of the scene, beyond doubt",
            (show_share(audit.at_least), format!("at most {}", show_share(audit.told))),
            Ok(!audit.contradicts),
        ),
        row(
            "true over reported error",
            (figure(audit.readings.true_over_told), "not surely > 1.5".to_owned()),
            is_told(&audit.readings),
        ),
        row(
            "the same where trouble is likely",
            (figure(audit.hard_readings.true_over_told), "not surely > 1.5".to_owned()),
            is_told(&audit.hard_readings),
        ),
        row(
            "variance of the variance",
            (
                significant(variance_of_variance, 2),
                format!("at most {}", AuditTrust::MOST_VARIANCE),
            ),
            Ok(variance_of_variance <= AuditTrust::MOST_VARIANCE),
        ),
        row(
            "tail of the brightest paths",
            (figure(tail_index), format!("at least {}", AuditTrust::LEAST_INDEX)),
            tail_index.map(|index| index >= AuditTrust::LEAST_INDEX).ok_or("too few, or all alike"),
        ),
        row(
            "power that noise falls with",
            (figure(trend), format!("at most {}", AuditTrust::MOST_TREND)),
            trend.map(|power| power <= AuditTrust::MOST_TREND).ok_or("too few increments"),
        ),
    ];
    table(&["check", "value", "asked", "result"], &rows)
}

/// Where the map is wrong, as far as that is beyond doubt.
fn findings(audit: &Audit) -> String {
    let mut found = String::new();
    if !audit.surfaces.is_empty() {
        let row = |of: &AuditedSurface| {
            let [read, traced] = [of.read_lx, of.traced_lx].map(|lx| significant(lx, 4));
            let apart = with_error(of.read_lx - of.traced_lx, of.standard_error_lx);
            vec![name(&of.shape), of.places.to_string(), read, traced, apart]
        };
        let rows: Vec<_> = audit.surfaces.iter().map(row).collect();
        let header = ["wrong in the mean", "places", "map, lx", "paths, lx", "apart, lx"];
        found += &format!("\n{}", table(&header, &rows));
    }
    if !audit.worst.is_empty() {
        let row = |of: &AuditedPlace| {
            let [x, y, z] = of.position.map(|c| significant(c, 4));
            vec![
                name(&of.shape),
                format!("{x} {y} {z}"),
                with_error(of.read_lx, of.standard_error_lx),
                with_error(of.traced_lx, of.traced_standard_error_lx),
            ]
        };
        let rows: Vec<_> = audit.worst.iter().map(row).collect();
        found += &format!("\n{}", table(&["wrong places", "at", "map, lx", "paths, lx"], &rows));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_judged_is_not_passed() {
        let audit = Audit {
            number: 0,
            places: 100,
            unknown_places: 0,
            paths: 1000,
            rays: 5000,
            told: 0.01,
            error: AuditedError::default(),
            interpolated: AuditedError::default(),
            at_least: 0.0,
            would_find: 0.02,
            would_find_alike: 0.01,
            mean_error: 0.0,
            mean_error_standard_error: 0.001,
            readings: AuditedReadings::default(),
            hard_readings: AuditedReadings::default(),
            untested: 0.0,
            trust: AuditTrust::default(),
            contradicts: false,
            surfaces: Vec::new(),
            worst: Vec::new(),
        };
        let words = checks(&audit).split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(words.matches("not judged").count(), 4, "{words}");
        assert_eq!(words.matches("passed").count(), 2, "{words}");
        assert!(words.contains("increments"), "{words}");
    }
}
