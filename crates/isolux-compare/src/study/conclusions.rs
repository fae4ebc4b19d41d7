//! The four conclusions of the study, tested again.

use super::convergence::time_to_error_s;
use super::record::{CaseStudy, Point, Study};
use super::system::System;
use serde::Serialize;

/// The error on CUBE that the study's LVS stopped at, and reached ten times sooner than its Inspirer (2.1).
pub const ERROR_OF_LVS: f64 = 0.028;

/// How many times sooner that was.
const TIMES_SOONER: f64 = 10.0;

/// A system is right about mirrors if it errs by less than this share of what leaving them out costs.
const OF_LEFT_OUT: f64 = 0.1;

/// What was found of a conclusion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Answer {
    /// It holds of these systems, too.
    Yes,
    /// It does not.
    No,
    /// What was run does not tell.
    Unknown,
}

/// A conclusion of the study and what became of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Conclusion {
    /// What the study concludes.
    pub statement: &'static str,
    /// Whether it holds of these systems.
    pub answer: Answer,
    /// The figures behind that, in a sentence or two.
    pub figures: String,
}

/// All four, from what was measured.
pub fn conclusions(study: &Study) -> [Conclusion; 4] {
    [sooner(study), stops(study), reverses(study), mirrors(study)]
}

const NOT_RUN: &str = "What this takes was not run.";

fn sooner(study: &Study) -> Conclusion {
    let statement =
        "On CUBE radiosity reaches an error of 2.8 % ten times sooner than forward Monte Carlo.";
    let time_s = |system| {
        let points = points(study.case("cube")?, system)?;
        let time_s =
            time_to_error_s(points, |point| Some(point.measured.as_ref()?.error), ERROR_OF_LVS);
        Some((time_s, points.last()?))
    };
    let [Some((radiosity_s, _)), Some((forward_s, last))] =
        [System::Radiosity, System::Forward].map(time_s)
    else {
        return unknown(statement);
    };
    match (radiosity_s, forward_s) {
        (Some(radiosity_s), Some(forward_s)) => {
            let times = forward_s / radiosity_s;
            Conclusion {
                statement,
                answer: if times >= TIMES_SOONER { Answer::Yes } else { Answer::No },
                figures: format!(
                    "Radiosity stays below it from {radiosity_s:.2} s on, forward from {forward_s:.2} s on: {times:.1} times as long."
                ),
            }
        }
        (Some(radiosity_s), None) => {
            let times = last.time_s / radiosity_s;
            Conclusion {
                statement,
                answer: if times >= TIMES_SOONER { Answer::Yes } else { Answer::Unknown },
                figures: format!(
                    "Radiosity stays below it from {radiosity_s:.2} s on, forward is above it after {:.1} s: more than {times:.1} times as long.",
                    last.time_s
                ),
            }
        }
        (None, _) => Conclusion {
            statement,
            answer: Answer::No,
            figures: "Radiosity does not stay below it.".to_owned(),
        },
    }
}

fn stops(study: &Study) -> Conclusion {
    let statement =
        "On CUBE radiosity does not become better over the last three quarters of its time.";
    let of = || {
        let points = points(study.case("cube")?, System::Radiosity)?;
        let by_time = |a: &&Point, b: &&Point| a.time_s.total_cmp(&b.time_s);
        let last = points.iter().max_by(by_time)?;
        let early = points.iter().filter(|point| point.time_s <= 0.25 * last.time_s);
        let quarter = early.max_by(by_time)?;
        Some((quarter, last, [quarter, last].map(|p| p.measured.as_ref().map(|m| m.error))))
    };
    let Some((quarter, last, [Some(then), Some(now)])) = of() else { return unknown(statement) };
    Conclusion {
        statement,
        answer: if now < then { Answer::No } else { Answer::Yes },
        figures: format!(
            "Its error is {} after {:.2} s and {} after {:.2} s.",
            percent(then),
            quarter.time_s,
            percent(now),
            last.time_s
        ),
    }
}

fn reverses(study: &Study) -> Conclusion {
    let statement = "On the practical scene the relation is reversed: forward Monte Carlo is ahead of radiosity.";
    let practical = study.cases.iter().filter(|case| case.reference.is_some());
    let compared: Vec<(&str, Ahead)> =
        practical.filter_map(|case| Some((case.name.as_str(), Ahead::of(case)?))).collect();
    let Some((_, hall)) = compared.iter().find(|(name, _)| *name == "hall") else {
        return unknown(statement);
    };
    let figures = compared.iter().map(|(name, of)| {
        format!(
            "{name}: the picture of forward differs from the reference by {:.2} (CIE94, mean) after {:.1} s, that of radiosity by {:.2} after {:.1} s.",
            of.forward.1, of.forward.0, of.radiosity.1, of.radiosity.0
        )
    });
    Conclusion {
        statement,
        answer: if hall.forward.1 < hall.radiosity.1 { Answer::Yes } else { Answer::No },
        figures: figures.collect::<Vec<_>>().join(" "),
    }
}

/// Times, s, and differences of pictures of two systems that had the same time.
struct Ahead {
    forward: (f64, f64),
    radiosity: (f64, f64),
}

impl Ahead {
    /// The last pictures that took no longer than the shorter of the longest runs.
    fn of(case: &CaseStudy) -> Option<Self> {
        let all = [System::Forward, System::Radiosity].map(|system| points(case, system));
        let [forward, radiosity] = all;
        let longest = |of: &[Point]| of.iter().map(|point| point.time_s).reduce(f64::max);
        let within_s = longest(forward?)?.min(longest(radiosity?)?);
        let last = |of: &[Point]| {
            let within = of.iter().filter(|point| point.time_s <= within_s);
            let last = within.max_by(|a, b| a.time_s.total_cmp(&b.time_s))?;
            Some((last.time_s, last.from_reference.as_ref()?.cie1994.mean))
        };
        Some(Self { forward: last(forward?)?, radiosity: last(radiosity?)? })
    }
}

fn mirrors(study: &Study) -> Conclusion {
    let statement = "Light that goes from diffuse surfaces over mirrors to others is right in forward Monte Carlo alone.";
    let errors = |case: &CaseStudy| -> Vec<(System, f64)> {
        let error =
            |system: System| Some((system, points(case, system)?.last()?.measured.as_ref()?.grid));
        System::ALL.into_iter().filter(|of| of.method().is_some()).filter_map(error).collect()
    };
    let errors = study.case("sphere").map(errors).unwrap_or_default();
    let left_out = errors.iter().find(|(system, _)| *system == System::RadiosityDiffuse);
    let Some(&(_, left_out)) = left_out else { return unknown(statement) };
    let with_mirrors = || errors.iter().filter(|(system, _)| *system != System::RadiosityDiffuse);
    let is_right = |error: f64| error < OF_LEFT_OUT * left_out;
    let others =
        || with_mirrors().filter(|(system, _)| system.method() != System::Forward.method());
    let list: Vec<String> = with_mirrors()
        .map(|(system, error)| format!("{} {}", system.title(), percent(*error)))
        .collect();
    Conclusion {
        statement,
        answer: match (others().count(), others().any(|&(_, error)| is_right(error))) {
            (0, _) => Answer::Unknown,
            (_, true) => Answer::No,
            (_, false) => Answer::Yes,
        },
        figures: format!(
            "Errors over a grid on SPHERE: {}. Without specular exchange it is {}.",
            list.join("; "),
            percent(left_out)
        ),
    }
}

fn unknown(statement: &'static str) -> Conclusion {
    Conclusion { statement, answer: Answer::Unknown, figures: NOT_RUN.to_owned() }
}

fn points(case: &CaseStudy, system: System) -> Option<&[Point]> {
    case.series.iter().find(|series| series.system == system).map(|series| series.points.as_slice())
}

fn percent(share: f64) -> String {
    format!("{:.3} %", 100.0 * share)
}

impl Study {
    /// The case of a name.
    pub fn case(&self, name: &str) -> Option<&CaseStudy> {
        self.cases.iter().find(|case| case.name == name)
    }
}
