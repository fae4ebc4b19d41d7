//! What larger scenes cost.

use super::folder::Folder;
use super::kept::Made;
use super::pace::Pace;
use super::plan::{Larger, Plan};
use super::point::solve;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::source;
use isolux::engine::SolveRequest;
use isolux_compare::study::Cost;
use std::path::PathBuf;
use std::time::Instant;

/// Maps of all larger halls, as far as the user lets them be made.
pub(crate) fn measure(
    (plan, folder): (&Plan, &Folder),
    interrupt: &Interrupt,
    pace: &mut Pace,
) -> Result<Vec<Cost>, Failure> {
    let mut costs = Vec::new();
    for larger in &plan.larger {
        match cost(larger, (plan, folder), interrupt, pace)? {
            Some(cost) => costs.push(cost),
            None => break,
        }
    }
    Ok(costs)
}

fn cost(
    larger: &Larger,
    (plan, folder): (&Plan, &Folder),
    interrupt: &Interrupt,
    pace: &mut Pace,
) -> Result<Option<Cost>, Failure> {
    let scene = source::read_scene(&PathBuf::from(format!("builtin:{}", larger.variant)))?;
    let made = Made::of(&scene.hash(), plan).for_accuracy(plan.accuracy_of_larger);
    let stem = format!("cost-{}", larger.variant.to_string().replace([',', '='], "-"));
    let (what, about_s) = (larger.variant.to_string(), larger.about_s);
    if let Some(cost) = made.found::<Cost>(folder, &stem) {
        pace.tell(&what, about_s, false);
        return Ok(Some(Cost { varied: larger.varied, ..cost }));
    }
    let request = SolveRequest {
        accuracy: Some(plan.accuracy_of_larger),
        audit: false,
        seed: plan.seed,
        ..SolveRequest::default()
    };
    let begun = Instant::now();
    let Some((map, _)) = solve(&scene, &request, interrupt)? else { return Ok(None) };
    let cost = Cost {
        varied: larger.varied,
        triangles: scene.triangle_count(),
        luminaires: scene.luminaires().len() + scene.area_luminaires().len(),
        accuracy: plan.accuracy_of_larger,
        told: map.provenance.accuracy.map(|accuracy| accuracy.reached),
        time_s: begun.elapsed().as_secs_f64(),
    };
    made.keep(folder, &stem, &cost)?;
    pace.tell(&what, about_s, true);
    Ok(Some(cost))
}
