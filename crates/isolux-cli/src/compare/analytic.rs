//! The analytic cases of CIE 171:2006.

use super::folder::Folder;
use super::kept::Made;
use super::pace::Pace;
use super::peers::{AskedOf, Peers};
use super::plan::{ANALYTIC_ABOUT_S, ANALYTIC_ACCURACY, ANALYTIC_SYSTEMS, Plan};
use super::point::solve;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use isolux_compare::peers::WHOLE;
use isolux_compare::study::{Analytic, AnalyticCase, Found, System, analytic_cases, found_in_map};
use std::time::{Duration, Instant};

/// What all systems find in all cases, as far as the user lets them.
pub(crate) fn measure(
    peers: &Peers,
    (plan, folder): (&Plan, &Folder),
    interrupt: &Interrupt,
    pace: &mut Pace,
) -> Result<Vec<Analytic>, Failure> {
    let mut done = Vec::new();
    for AnalyticCase { mut analytic, scene, places } in
        analytic_cases().map_err(Failure::bad_input)?
    {
        let made = Made::of(&scene.hash(), plan).for_accuracy(ANALYTIC_ACCURACY);
        for &system in plan.systems.iter().filter(|system| ANALYTIC_SYSTEMS.contains(system)) {
            let stem = format!("{}-{}", analytic.name, system.name());
            let what = format!("{}, {}", analytic.name, system.title());
            if let Some(found) = made.found::<Found>(folder, &stem) {
                pace.tell(&what, ANALYTIC_ABOUT_S, false);
                analytic.found.push(found);
                continue;
            }
            let about = Duration::from_secs_f64(ANALYTIC_ABOUT_S);
            let Some(request) = system.request(ANALYTIC_ACCURACY, about, plan.seed) else {
                continue;
            };
            let begun = Instant::now();
            let Some((map, _)) = solve(&scene, &request, interrupt)? else { return Ok(done) };
            let time_s = begun.elapsed().as_secs_f64();
            let found = found_in_map(system, time_s, (&scene, &map), &places);
            made.keep(folder, &stem, &found)?;
            pace.tell(&what, ANALYTIC_ABOUT_S, true);
            analytic.found.push(found);
        }
        for system in peers.systems(&analytic.name) {
            let found = by_peer(&analytic.name, system, peers, &made, (plan, folder), interrupt)?;
            analytic.found.extend(found);
        }
        if interrupt.is_requested() {
            return Ok(done);
        }
        done.push(analytic);
    }
    Ok(done)
}

fn by_peer(
    name: &str,
    system: System,
    peers: &Peers,
    made: &Made,
    (plan, folder): (&Plan, &Folder),
    interrupt: &Interrupt,
) -> Result<Option<Found>, Failure> {
    let Some(effort) = peers.effort(name, system, 0) else { return Ok(None) };
    let stem = format!("{name}-{}", system.name());
    let asked = AskedOf { scene: name, points: WHOLE, system, effort: effort.to_owned(), stem };
    let found = peers.ask(&asked, made, (plan, folder), interrupt)?;
    Ok(found.map(|(found, _)| Found {
        system,
        time_s: found.whole_s,
        standard_errors_lx: vec![None; found.values_lx.len()],
        values_lx: found.values_lx,
    }))
}
