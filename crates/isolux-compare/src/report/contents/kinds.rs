//! The closed list of graphs.

use super::foreseen;
use crate::report::graph::{Rule, Scale};
use crate::study::{CaseStudy, Distances, ERROR_OF_LVS, Point};

/// A graph that scenes may have.
pub(super) struct Kind {
    pub(super) id: &'static str,
    pub(super) title: &'static str,
    /// What it shows, in a sentence or two.
    pub(super) says: &'static str,
    pub(super) x: (&'static str, Scale),
    pub(super) y: (&'static str, Scale),
    pub(super) of: Of,
    pub(super) rules: fn(&CaseStudy) -> Vec<Rule>,
    pub(super) on: On,
}

/// What its lines are.
#[derive(Clone, Copy)]
pub(super) enum Of {
    /// One a system, through its maps.
    Map(OfMap),
    /// Finishing times over the time when they were told, of the run that made the reference.
    Foreseen,
}

/// What a map is drawn as.
#[derive(Clone, Copy)]
pub(super) enum OfMap {
    /// Something over the time that a map took.
    Time(fn(&Point) -> Option<f64>),
    /// Something over something else, of one map each.
    Pair(fn(&Point) -> Option<f64>, fn(&Point) -> Option<f64>),
    /// The same where it has an interval: value, from, to.
    Interval(fn(&Point) -> Option<f64>, fn(&Point) -> Option<[f64; 3]>),
}

/// Which scenes it belongs to.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum On {
    Every,
    Exact,
    Cube,
    Practical,
}

/// What an interval of 95 % should hold, in hundredths.
const COVERED: f64 = 95.0;

const TIME: (&str, Scale) = ("time, s", Scale::Doubling);
const TOLD: (&str, Scale) = ("reported error, %", Scale::Decades);
const L2: (&str, Scale) = ("relative L2 distance, %", Scale::Decades);
const LAB: (&str, Scale) = ("mean difference ΔE*ab (1976)", Scale::Decades);
const CIE94: (&str, Scale) = ("mean difference ΔE*94", Scale::Decades);

/// In the order of reports.
pub(super) const KINDS: [Kind; 15] = [
    Kind {
        id: "measured",
        title: "Measured error over time",
        says: "Error of the study, measured at points whose right values are known, over the time that a map took; graphs 1 and 3 of the study.",
        x: TIME,
        y: ("measured error, %", Scale::Decades),
        of: Of::Map(OfMap::Time(measured)),
        rules: of_the_paper,
        on: On::Exact,
    },
    Kind {
        id: "reported-measured",
        title: "Measured error against reported error",
        says: "Each point is a map, in the order of time along each line. On the dashed line the measured error is the reported one; above it, it is larger. The study has both over time in its graph 2.",
        x: TOLD,
        y: ("measured error, %", Scale::Decades),
        of: Of::Map(OfMap::Pair(told, measured)),
        rules: equal,
        on: On::Cube,
    },
    Kind {
        id: "progress",
        title: "Reported progress over time",
        says: "What a user sees while a system runs: of radiosity the share of light that is not yet shot, of others the reported error; graph 4 of the study.",
        x: TIME,
        y: ("reported error, or light not yet shot, %", Scale::Linear),
        of: Of::Map(OfMap::Time(progress)),
        rules: none,
        on: On::Practical,
    },
    Kind {
        id: "progress-log",
        title: "Reported progress over time, both logarithmic",
        says: "The same, as in graph 5 of the study: errors that fall as one over the root of time lie on a straight line.",
        x: TIME,
        y: ("reported error, or light not yet shot, %", Scale::Decades),
        of: Of::Map(OfMap::Time(progress)),
        rules: none,
        on: On::Practical,
    },
    Kind {
        id: "foreseen",
        title: "Finishing time as foreseen",
        says: "While the map of the reference was made, when it was expected to reach the accuracy asked for, with intervals of 90 %, over the time \
               when that was said. The dashed line is when it did.",
        x: ("time when it was said, s", Scale::Doubling),
        y: ("finishing time, s", Scale::Doubling),
        of: Of::Foreseen,
        rules: foreseen::rules,
        on: On::Practical,
    },
    picture(
        "rgb-last",
        "Pictures: L2 distance from the system’s own last",
        OWN,
        L2,
        OfMap::Time(|p| rgb(own(p))),
    ),
    picture(
        "lab-last",
        "Pictures: CIE 1976 from the system’s own last",
        OWN,
        LAB,
        OfMap::Time(|p| Some(own(p)?.cie1976.mean)),
    ),
    picture(
        "cie94-last",
        "Pictures: CIE94 from the system’s own last",
        OWN,
        CIE94,
        OfMap::Time(|p| Some(own(p)?.cie1994.mean)),
    ),
    picture(
        "rgb-reference",
        "Pictures: L2 distance from the reference",
        COMMON,
        L2,
        OfMap::Time(|p| rgb(common(p))),
    ),
    picture(
        "lab-reference",
        "Pictures: CIE 1976 from the reference",
        COMMON,
        LAB,
        OfMap::Time(|p| Some(common(p)?.cie1976.mean)),
    ),
    picture(
        "cie94-reference",
        "Pictures: CIE94 from the reference",
        COMMON,
        CIE94,
        OfMap::Time(|p| Some(common(p)?.cie1994.mean)),
    ),
    Kind {
        id: "covered",
        title: "Intervals that hold over time",
        says: "Share of places whose reported intervals of 95 % hold the right value. It should be at the dashed line.",
        x: TIME,
        y: ("intervals that hold, %", Scale::Linear),
        of: Of::Map(OfMap::Time(|p| Some(100.0 * p.measured.as_ref()?.covered?))),
        rules: |_| vec![Rule::Level(COVERED, "95 %".to_owned())],
        on: On::Exact,
    },
    Kind {
        id: "sharpness",
        title: "Reported over true error over time",
        says: "Root mean square of the standard errors reported at places, over that of their true errors. Above one a map is too careful, below one too sure.",
        x: TIME,
        y: ("reported over true error", Scale::Decades),
        of: Of::Map(OfMap::Time(|p| p.measured.as_ref()?.told_over_true)),
        rules: |_| vec![Rule::Level(1.0, "as reported".to_owned())],
        on: On::Exact,
    },
    Kind {
        id: "audited",
        title: "Audited error against reported error",
        says: "Each point is a map: what independent paths find that it errs by, with an interval of 95 %, over its reported error.",
        x: TOLD,
        y: ("audited error, %", Scale::Decades),
        of: Of::Map(OfMap::Interval(told, audited)),
        rules: equal,
        on: On::Every,
    },
    Kind {
        id: "filtered",
        title: "Filtered share over time",
        says: "Share of the surface where the filter takes most of the detail for noise. A filter that is no longer needed switches itself off.",
        x: TIME,
        y: ("filtered share of the surface, %", Scale::Linear),
        of: Of::Map(OfMap::Time(|p| Some(100.0 * p.reported.filtered?))),
        rules: none,
        on: On::Every,
    },
];

const OWN: &str = "How far a system’s picture is from its last one, as the study has it: each converges to itself, right or wrong.";
const COMMON: &str = "How far a system’s picture is from the reference, which is the same for all.";

/// A graph of the convergence of pictures.
const fn picture(
    id: &'static str,
    title: &'static str,
    says: &'static str,
    y: (&'static str, Scale),
    of: OfMap,
) -> Kind {
    Kind { id, title, says, x: TIME, y, of: Of::Map(of), rules: none, on: On::Practical }
}

fn measured(point: &Point) -> Option<f64> {
    Some(100.0 * point.measured.as_ref()?.error)
}

fn told(point: &Point) -> Option<f64> {
    Some(100.0 * point.reported.error?)
}

fn progress(point: &Point) -> Option<f64> {
    Some(100.0 * point.reported.unshot.or(point.reported.error)?)
}

fn audited(point: &Point) -> Option<[f64; 3]> {
    point.audited.map(|of| [of.error, of.low, of.high].map(|share| 100.0 * share))
}

fn own(point: &Point) -> Option<&Distances> {
    point.from_last.as_ref()
}

fn common(point: &Point) -> Option<&Distances> {
    point.from_reference.as_ref()
}

fn rgb(distances: Option<&Distances>) -> Option<f64> {
    Some(100.0 * distances?.rgb.mean?)
}

fn none(_: &CaseStudy) -> Vec<Rule> {
    Vec::new()
}

fn equal(_: &CaseStudy) -> Vec<Rule> {
    vec![Rule::Equal("as reported".to_owned())]
}

fn of_the_paper(case: &CaseStudy) -> Vec<Rule> {
    let level = || Rule::Level(100.0 * ERROR_OF_LVS, "LVS in 1998: 2.8 %".to_owned());
    if case.name == "cube" { vec![level()] } else { Vec::new() }
}
