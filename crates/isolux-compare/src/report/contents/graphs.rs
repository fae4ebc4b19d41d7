//! Which graphs a scene has, and what they show.

use super::foreseen;
use super::kinds::{KINDS, Kind, Of, OfMap, On};
use super::{names, systems};
use crate::report::graph::{Axis, Dot, Graph, Line};
use crate::study::{CaseStudy, Point, Series};

/// The graphs of a scene.
pub(super) struct Drawn {
    pub(super) graphs: Vec<Graph>,
    /// Titles of those that belong to the scene and have nothing to show.
    pub(super) missing: Vec<&'static str>,
}

/// All graphs of a scene.
pub(super) fn of(case: &CaseStudy) -> Drawn {
    let mut drawn = Drawn { graphs: Vec::new(), missing: Vec::new() };
    for kind in &KINDS {
        let graph = graph(kind, case);
        if !graph.is_empty() {
            drawn.graphs.push(with_what_is_left_out(graph));
        } else if belongs(kind, case) {
            drawn.missing.push(kind.title);
        }
    }
    drawn
}

/// Whether a scene should have a graph of this kind.
fn belongs(kind: &Kind, case: &CaseStudy) -> bool {
    let is_exact = matches!(case.name.as_str(), "cube" | "sphere");
    match kind.on {
        On::Every => true,
        On::Exact => is_exact,
        On::Cube => case.name == "cube",
        On::Practical => !is_exact,
    }
}

fn graph(kind: &Kind, case: &CaseStudy) -> Graph {
    let name = names::name(case);
    let lines: Vec<Line> = match kind.of {
        Of::Foreseen => foreseen::line(case).into_iter().collect(),
        Of::Map(of) => case.series.iter().map(|series| line(of, series)).collect(),
    };
    Graph {
        id: format!("{}-{}", names::id(case), kind.id),
        title: format!("{}. {}", capital(&name), kind.title),
        description: kind.says.to_owned(),
        x: axis(kind.x),
        y: axis(kind.y),
        lines: lines.into_iter().filter(|line| !line.points.is_empty()).collect(),
        rules: (kind.rules)(case),
    }
}

fn axis((title, scale): (&str, crate::report::graph::Scale)) -> Axis {
    Axis { title: title.to_owned(), scale }
}

fn line(of: OfMap, series: &Series) -> Line {
    let points = match of {
        OfMap::Time(value) => dots(series, |point| at(point.time_s, value(point)?)),
        OfMap::Pair(x, y) => dots(series, |point| at(x(point)?, y(point)?)),
        OfMap::Interval(x, y) => dots(series, |point| {
            let [value, low, high] = y(point)?;
            Some(Dot { x: x(point)?, y: value, interval: Some([low, high]) })
        }),
    };
    Line { title: series.system.title().to_owned(), look: systems::number(series.system), points }
}

/// In the order of the times that maps took.
fn dots(series: &Series, dot: impl Fn(&Point) -> Option<Dot>) -> Vec<Dot> {
    let mut points: Vec<&Point> = series.points.iter().collect();
    points.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
    points.into_iter().filter_map(dot).collect()
}

fn at(x: f64, y: f64) -> Option<Dot> {
    Some(Dot { x, y, interval: None })
}

/// Says how many points have no place.
fn with_what_is_left_out(mut graph: Graph) -> Graph {
    let said = match graph.left_out() {
        0 => return graph,
        1 => " One point of zero has no place on a logarithmic axis.".to_owned(),
        many => format!(" {many} points of zero have no place on a logarithmic axis."),
    };
    graph.description.push_str(&said);
    graph
}

/// With a capital letter at its beginning.
fn capital(name: &str) -> String {
    let mut letters = name.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    format!("{first}{}", letters.as_str())
}
