//! A scene through all systems.

use super::{errors, graphs, names, wrong};
use crate::report::document::{Block, Section};
use crate::report::quantity::{list, percent_sign, seconds, things};
use crate::study::{CaseStudy, Point, System};

/// All that is said of a scene.
pub(super) fn section(case: &CaseStudy) -> Section {
    let mut blocks = vec![Block::Text(about(case))];
    blocks.extend(best(case).map(Block::Text));
    blocks.extend(errors::last_maps(case));
    let drawn = graphs::of(case);
    if !drawn.graphs.is_empty() {
        blocks.push(Block::Graphs(drawn.graphs));
    }
    if !drawn.missing.is_empty() {
        blocks.push(Block::Text(left_out(&drawn.missing)));
    }
    blocks.extend(errors::places(case));
    blocks.extend(wrong::blocks(case));
    let folded = errors::every_map(case);
    if !folded.is_empty() {
        blocks.push(Block::Folded(format!("Every map of {}", names::name(case)), folded));
    }
    Section { id: names::id(case), title: names::title(case), blocks }
}

fn about(case: &CaseStudy) -> String {
    let what = match case.name.as_str() {
        "cube" => {
            "The inside of a cube of 10 m, reflectance 2/3, with one luminaire of 50,000 cd in the middle [1, 2.1]. Right values come from a solution of \
             its integral equation."
        }
        "sphere" => {
            "An eighth of a ball of radius 1 m, reflectance 0.7, closed by mirrors of 1.0, 0.8 and 0.6, with one luminaire of 100 cd. Right values have a \
             closed form [1, appendix A]."
        }
        _ => {
            "Right values are not known; pictures are compared, with one another and with a reference."
        }
    };
    let reference = case.reference.as_ref().map(|of| {
        let told = of.told.map_or_else(
            || "has no reported error".to_owned(),
            |told| format!("has a reported error of {}", percent_sign(told)),
        );
        format!(
            " The map of the reference, hybrid with the same seed, took {} and {told}: pictures that differ from it by less may be as good or better.",
            seconds(of.time_s)
        )
    });
    let landing = match (case.landing, case.reference.as_ref().and_then(|of| of.landing)) {
        (Some(right), _) => {
            format!(" Light is reflected and lands again: in all {right:.4} times what is emitted.")
        }
        (None, Some(found)) => {
            format!(
                " Light is reflected and lands again: by the reference in all {found:.4} times what is emitted."
            )
        }
        (None, None) => String::new(),
    };
    format!(
        "{what} {}, {}.{}{landing}",
        things(case.triangles as usize, "triangle", "triangles"),
        things(
            case.luminaires,
            "luminaire or emitting surface",
            "luminaires and emitting surfaces"
        ),
        reference.unwrap_or_default(),
    )
}

/// Which system came closest, by what is known of the case.
fn best(case: &CaseStudy) -> Option<String> {
    let measured = |point: &Point| Some(point.measured.as_ref()?.grid);
    let pictured = |point: &Point| point.from_reference.as_ref()?.rgb.mean;
    if let Some((system, point, error)) = least(case, measured) {
        return Some(format!(
            "The least error over a grid of places is {}: {} after {}. A single point, as that of the study on SPHERE, may be right by chance.",
            percent_sign(error),
            system.title(),
            seconds(point.time_s)
        ));
    }
    let (system, point, distance) = least(case, pictured)?;
    Some(format!(
        "The picture that is nearest to the reference is off by {} (relative L2 distance): {} after {}.",
        percent_sign(distance),
        system.title(),
        seconds(point.time_s)
    ))
}

/// The point where something is least.
fn least(case: &CaseStudy, of: impl Fn(&Point) -> Option<f64>) -> Option<(System, &Point, f64)> {
    let points = case
        .series
        .iter()
        .flat_map(|series| series.points.iter().map(|point| (series.system, point)));
    let known = points.filter_map(|(system, point)| Some((system, point, of(point)?)));
    known.filter(|(_, _, value)| value.is_finite()).min_by(|a, b| a.2.total_cmp(&b.2))
}

fn left_out(missing: &[&str]) -> String {
    let verb = if missing.len() == 1 { "has no graph" } else { "have no graphs" };
    let names: Vec<String> = missing.iter().map(|title| format!("“{title}”")).collect();
    format!("{} {verb}: nothing was found to draw.", list(&names))
}
