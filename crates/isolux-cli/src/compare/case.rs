//! One scene through all systems.

use super::folder::Folder;
use super::kept::{self, Made};
use super::pace::Pace;
use super::peers::{AskedOf, PATIENCE, Peers};
use super::pictures::Viewer;
use super::plan::{Case, Plan};
use super::point::{Asked, solve};
use super::wrong::{self, Wrong};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::source;
use isolux::engine::SolveRequest;
use isolux::scene::Scene;
use isolux_compare::Readings;
use isolux_compare::metric::landed_over_emitted;
use isolux_compare::peers::OF_THE_STUDY;
use isolux_compare::study::{
    CaseStudy, Errors, Measured, Point, Reference, Series, System, accuracy_for, right_landing,
};
use std::collections::BTreeMap;
use std::time::Instant;

/// A scene and what is known of it.
struct Subject<'a> {
    scene: &'a Scene,
    /// The same without mirrors, gloss and glass, where that is asked for.
    diffuse: Option<Scene>,
    hash: String,
    /// Who makes pictures, where there are any.
    viewer: Option<Viewer>,
}

impl Subject<'_> {
    fn scene(&self, system: System) -> &Scene {
        match (&self.diffuse, system) {
            (Some(diffuse), System::RadiosityDiffuse) => diffuse,
            _ => self.scene,
        }
    }
}

/// All points of a case, system by system; `None` if the user stops it before there is any. Times come one after the other and systems in turn
/// within each, so that whatever else the machine does meets all of them.
pub(crate) fn compare(
    case: &Case,
    (plan, peers, folder): (&Plan, &Peers, &Folder),
    interrupt: &Interrupt,
    pace: &mut Pace,
) -> Result<Option<CaseStudy>, Failure> {
    let Some((subject, reference)) = begin(case, (plan, folder), interrupt)? else {
        return Ok(None);
    };
    let others = if case.is_exact { peers.systems(&case.name) } else { Vec::new() };
    let begun = |system: System| Series { system, points: Vec::new(), error_picture: None };
    let mut series: Vec<Series> = plan.systems.iter().copied().chain(others).map(begun).collect();
    let mut wrong = BTreeMap::new();
    'all: for (number, asked_s) in plan.times_s(case).into_iter().enumerate() {
        for Series { system, points, .. } in &mut series {
            if system.method().is_none() {
                // Each effort takes some times as long as the one before.
                let last_s = points.last().map_or(0.0, |last: &Point| last.time_s);
                if PATIENCE * last_s > plan.limit_s {
                    continue;
                }
                let beside = (*system, number, asked_s);
                let made = Made::of(&subject.hash, plan);
                let made = by_peer(case, peers, beside, &made, (plan, folder), interrupt)?;
                if let Some((point, errors, was_made)) = made {
                    let effort = point.effort.clone().unwrap_or_default();
                    let what = format!("{}, {}, {effort}", case.name, system.title());
                    pace.tell(&what, 0.0, was_made);
                    points.push(point);
                    wrong.insert(*system, Wrong::Known(errors));
                }
                continue;
            }
            let accuracy = accuracy_for(*system, points, asked_s);
            let asked = Asked { case, system: *system, asked_s, accuracy };
            let Some((point, is_wrong)) = point(&asked, &subject, (plan, folder), interrupt, pace)?
            else {
                break 'all;
            };
            points.push(point);
            wrong.insert(*system, is_wrong);
        }
    }
    let scene = subject.scene;
    let mut done = CaseStudy {
        name: case.name.clone(),
        scene_hash: subject.hash.clone(),
        triangles: scene.triangle_count(),
        luminaires: scene.luminaires().len() + scene.area_luminaires().len(),
        reference,
        landing: right_landing(&case.name, scene).filter(|_| case.is_exact),
        error_limit: None,
        series,
    };
    if let Some(viewer) = &subject.viewer {
        tell_distances(&mut done, viewer, folder);
    }
    wrong::tell(&mut done, &wrong, (case, subject.viewer.as_ref()), folder)?;
    Ok(Some(done))
}

/// Makes the map of the reference picture, if there is to be one and it is not there already.
fn begin<'a>(
    case: &'a Case,
    (plan, folder): (&Plan, &Folder),
    interrupt: &Interrupt,
) -> Result<Option<(Subject<'a>, Option<Reference>)>, Failure> {
    let scene = &case.scene;
    let hash = scene.hash();
    let has_diffuse = plan.systems.contains(&System::RadiosityDiffuse);
    let diffuse = has_diffuse.then(|| source::diffuse(&case.source, scene)).transpose()?;
    let subject = Subject { scene, diffuse, hash, viewer: None };
    if case.is_exact {
        return Ok(Some((subject, None)));
    }
    let made = Made::of(&subject.hash, plan).for_accuracy(plan.reference);
    let stem = format!("{}-reference", case.stem());
    let reference = match made.found::<Reference>(folder, &stem) {
        Some(reference) => reference,
        None => {
            let Some(reference) = reference(case, (plan, folder), (&stem, &made), interrupt)?
            else {
                return Ok(None);
            };
            reference
        }
    };
    let (scene_of_map, map) = kept::map(folder, &stem)?;
    let viewer = Viewer::of(&scene_of_map, &map, plan)?;
    viewer.keep((&scene_of_map, &map), (folder, &reference.picture))?;
    Ok(Some((Subject { viewer: Some(viewer), ..subject }, Some(reference))))
}

/// The map that others are compared with; `None` if the user stops it.
fn reference(
    case: &Case,
    (plan, folder): (&Plan, &Folder),
    (stem, made): (&str, &Made),
    interrupt: &Interrupt,
) -> Result<Option<Reference>, Failure> {
    let request = SolveRequest {
        accuracy: Some(plan.reference),
        audit: false,
        seed: plan.seed,
        ..SolveRequest::default()
    };
    let begun = Instant::now();
    let Some((map, predictions)) = solve(&case.scene, &request, interrupt)? else {
        return Ok(None);
    };
    let reference = Reference {
        picture: format!("pictures/{stem}.png"),
        told: map.provenance.accuracy.map(|accuracy| accuracy.reached),
        time_s: begun.elapsed().as_secs_f64(),
        accuracy: plan.reference,
        predictions,
        landing: landed_over_emitted(&case.scene, &map),
    };
    kept::keep_map(folder, stem, (&case.scene, &map))?;
    made.keep(folder, stem, &reference)?;
    Ok(Some(reference))
}

/// A point that is there already, or made now, and where its map errs; `None` if the user stops it.
fn point(
    asked: &Asked,
    subject: &Subject,
    (plan, folder): (&Plan, &Folder),
    interrupt: &Interrupt,
    pace: &mut Pace,
) -> Result<Option<(Point, Wrong)>, Failure> {
    let Asked { case, system, asked_s, .. } = *asked;
    let (made, stem) = (Made::of(&subject.hash, plan), asked.stem());
    let what = format!("{}, {}, {asked_s} s", case.name, system.title());
    if let Some(point) = made.found::<Point>(folder, &stem) {
        pace.tell(&what, asked_s, false);
        return Ok(Some((point, Wrong::Kept(stem))));
    }
    let scene = subject.scene(system);
    let Some((map, mut point, errors)) = asked.make(scene, plan, interrupt)? else {
        return Ok(None);
    };
    let wrong = match &subject.viewer {
        Some(viewer) => {
            let name = format!("pictures/{stem}.png");
            let wrong = viewer.keep((scene, &map), (folder, &name))?;
            point.picture = Some(name);
            Some(wrong)
        }
        None => errors,
    };
    kept::keep_map(folder, &stem, (scene, &map))?;
    made.keep(folder, &stem, &point)?;
    pace.tell(&what, asked_s, true);
    Ok(Some((point, Wrong::Known(wrong))))
}

/// What another renderer finds with the effort that stands beside a time; `None` if it has none, or fails.
fn by_peer(
    case: &Case,
    peers: &Peers,
    (system, number, asked_s): (System, usize, f64),
    made: &Made,
    (plan, folder): (&Plan, &Folder),
    interrupt: &Interrupt,
) -> Result<Option<(Point, Option<Errors>, bool)>, Failure> {
    let Some(effort) = peers.effort(&case.name, system, number) else { return Ok(None) };
    let stem = case.point_stem(system, asked_s);
    let (scene, effort) = (&case.name, effort.to_owned());
    let asked = AskedOf { scene, points: OF_THE_STUDY, system, effort, stem };
    let Some((found, was_made)) = peers.ask(&asked, made, (plan, folder), interrupt)? else {
        return Ok(None);
    };
    let values_lx: Option<Vec<f64>> = found.values_lx.into_iter().collect();
    let readings = values_lx.and_then(|values_lx| Readings::of_values(scene, &values_lx));
    let Some(readings) = readings else { return Ok(None) };
    let point = Point {
        asked_s,
        effort: Some(asked.effort),
        time_s: found.whole_s,
        measured: Measured::of(&readings),
        ..Point::default()
    };
    Ok(Some((point, Errors::of(scene, &readings), was_made)))
}

/// How far all pictures are from the last one of their system, and from the reference.
fn tell_distances(case: &mut CaseStudy, viewer: &Viewer, folder: &Folder) {
    let reference = case.reference.as_ref().map(|reference| reference.picture.clone());
    for series in &mut case.series {
        let last = series.points.last().and_then(|point| point.picture.clone());
        for point in &mut series.points {
            let from = |other: &Option<String>| {
                viewer.distances(folder, [other.as_deref()?, point.picture.as_deref()?])
            };
            let (from_last, from_reference) = (from(&last), from(&reference));
            (point.from_last, point.from_reference) = (from_last, from_reference);
        }
    }
}
