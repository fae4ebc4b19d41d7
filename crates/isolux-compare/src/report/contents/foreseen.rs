//! Finishing times as they were foreseen.

use crate::report::graph::Dot;
use crate::study::{Prediction, Series};

/// Between two predictions that are drawn at least so much more time has passed.
const FACTOR: f64 = std::f64::consts::SQRT_2;

/// Those of the longest run that told any, few enough to be told apart.
pub(super) fn dots(series: &Series) -> Vec<Dot> {
    let told = series.points.iter().rev().map(|point| &point.predictions).find(|p| !p.is_empty());
    let mut dots: Vec<Dot> = Vec::new();
    for prediction in told.into_iter().flatten() {
        if dots.last().is_none_or(|last| prediction.at_s >= FACTOR * last.x) {
            dots.push(dot(prediction));
        }
    }
    dots
}

fn dot(prediction: &Prediction) -> Dot {
    let Prediction { at_s, finish_s, earliest_s, latest_s, .. } = *prediction;
    Dot { x: at_s, y: finish_s, interval: Some([earliest_s, latest_s]) }
}
