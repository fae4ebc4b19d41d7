//! One scene through all systems.

use super::folder::Folder;
use super::pace::Pace;
use super::pictures::Viewer;
use super::plan::{Case, Plan};
use super::point::{Asked, solve};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::source;
use isolux::engine::SolveRequest;
use isolux::scene::Scene;
use isolux_compare::study::{CaseStudy, Point, Reference, Series, System};
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
    (plan, folder): (&Plan, &Folder),
    interrupt: &Interrupt,
    pace: &mut Pace,
) -> Result<Option<CaseStudy>, Failure> {
    let Some((subject, reference)) = begin(case, (plan, folder), interrupt)? else {
        return Ok(None);
    };
    let mut series: Vec<Series> =
        plan.systems.iter().map(|&system| Series { system, points: Vec::new() }).collect();
    'all: for asked_s in plan.times_s(case) {
        for Series { system, points } in &mut series {
            let asked = Asked { case, system: *system, asked_s };
            let Some(point) = point(&asked, &subject, (plan, folder), interrupt, pace)? else {
                break 'all;
            };
            points.push(point);
        }
    }
    let mut done = CaseStudy {
        name: case.name.clone(),
        scene_hash: subject.hash.clone(),
        triangles: subject.scene.triangle_count(),
        luminaires: subject.scene.luminaires().len() + subject.scene.area_luminaires().len(),
        reference,
        series,
    };
    if let Some(viewer) = &subject.viewer {
        tell_distances(&mut done, viewer, folder);
    }
    Ok(Some(done))
}

/// Makes the map of the reference picture, if there is to be one.
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
    let request = SolveRequest {
        accuracy: Some(plan.reference),
        audit: false,
        seed: plan.seed,
        ..SolveRequest::default()
    };
    let begun = Instant::now();
    let Some((map, _)) = solve(scene, &request, interrupt)? else { return Ok(None) };
    let picture = format!("pictures/{}-reference.png", case.stem());
    let viewer = Viewer::of(scene, &map, plan)?;
    viewer.keep((scene, &map), (folder, &picture))?;
    let reference = Reference {
        picture,
        told: map.provenance.accuracy.map(|accuracy| accuracy.reached),
        time_s: begun.elapsed().as_secs_f64(),
    };
    Ok(Some((Subject { viewer: Some(viewer), ..subject }, Some(reference))))
}

/// A point that is there already, or made now; `None` if the user stops it.
fn point(
    asked: &Asked,
    subject: &Subject,
    (plan, folder): (&Plan, &Folder),
    interrupt: &Interrupt,
    pace: &mut Pace,
) -> Result<Option<Point>, Failure> {
    let Asked { case, system, asked_s } = *asked;
    let mut tell = |was_made: bool| {
        let verb = if was_made { "made" } else { "found" };
        pace.tell(case, &format!("{}, {asked_s} s: {verb}", system.title()), asked_s, was_made);
    };
    if let Some(point) = asked.found(&subject.hash, plan, folder) {
        tell(false);
        return Ok(Some(point));
    }
    let scene = subject.scene(system);
    let Some((map, mut point)) = asked.make(scene, plan, interrupt)? else { return Ok(None) };
    if let Some(viewer) = &subject.viewer {
        let name = format!("pictures/{}.png", asked.stem());
        viewer.keep((scene, &map), (folder, &name))?;
        point.picture = Some(name);
    }
    asked.keep((&subject.hash, plan, folder), (scene, &map), &point)?;
    tell(true);
    Ok(Some(point))
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
