//! Finishing times as they were foreseen.

use super::systems;
use crate::report::graph::{Dot, Line, Rule};
use crate::report::quantity::seconds;
use crate::study::{CaseStudy, Prediction, System};

/// Between two predictions that are drawn at least so much more time has passed.
const FACTOR: f64 = std::f64::consts::SQRT_2;

/// Those of the run that made the map of the reference picture, few enough to be told apart: it alone has no time limit.
pub(super) fn line(case: &CaseStudy) -> Option<Line> {
    let mut points: Vec<Dot> = Vec::new();
    for prediction in &case.reference.as_ref()?.predictions {
        if points.last().is_none_or(|last| prediction.at_s >= FACTOR * last.x) {
            points.push(dot(prediction));
        }
    }
    let title = System::Hybrid.title().to_owned();
    Some(Line { title, look: systems::number(System::Hybrid), points })
}

/// When that run ended.
pub(super) fn rules(case: &CaseStudy) -> Vec<Rule> {
    let end = |time_s| Rule::Level(time_s, format!("finished: {}", seconds(time_s)));
    case.reference.iter().map(|of| end(of.time_s)).collect()
}

fn dot(prediction: &Prediction) -> Dot {
    let Prediction { at_s, finish_s, earliest_s, latest_s, .. } = *prediction;
    Dot { x: at_s, y: finish_s, interval: Some([earliest_s, latest_s]) }
}
