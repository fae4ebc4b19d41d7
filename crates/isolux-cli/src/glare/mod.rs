//! `isolux glare`: the unified glare rating of observers.

mod dgp;
mod floor_plan;
mod observer;
mod position;
mod sources;

use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::{GlareFlags, GlareMetric};
use crate::map_file;
use crate::output::OutputPath;
use crate::shown::name;
pub(crate) use floor_plan::worst;
use isolux::engine::MapReader;
use isolux::map::{Figure, IlluminationMap};
use isolux::scene::{Camera, Scene};
use observer::Observed;

/// Runs the subcommand.
pub(crate) fn run(flags: &GlareFlags, json: bool) -> Result<Outcome, Failure> {
    let csv = flags.csv.as_deref().map(|path| OutputPath::check(path, "csv")).transpose()?;
    let (scene, map) = map_file::read(&flags.map)?;
    let on_grids = flags.all_grids || !flags.grid.is_empty();
    if flags.threshold.is_some() && flags.metric != GlareMetric::Dgp {
        return Err(Failure::bad_input(
            "--threshold says what glares in daylight; leave it out or add --metric dgp",
        ));
    }
    if on_grids && flags.metric == GlareMetric::Dgp {
        return Err(Failure::bad_input(
            "--metric dgp takes one view at a time, not grids; give --camera, or --eye and --target",
        ));
    }
    if on_grids {
        let request = floor_plan::Request::of(flags, &scene)?;
        map_file::warn_of_unknown_error(&flags.map, &map);
        let rated = floor_plan::rated(&request, &scene, &MapReader::new(&scene, &map));
        rated.iter().for_each(floor_plan::Rated::warn);
        if let Some(csv) = csv {
            csv.write(floor_plan::rows(&rated).as_bytes())?;
        }
        if json {
            print_json(&serde_json::json!({ "grids": rated }))?;
        } else {
            print(&floor_plan::text(&rated))?;
        }
        return Ok(Outcome::Done);
    }
    let eyes = observer::eyes(flags, &scene)?;
    map_file::warn_of_unknown_error(&flags.map, &map);
    if flags.metric == GlareMetric::Dgp {
        let observed = dgp::observed(flags, (&scene, &map), &eyes)?;
        if json {
            print_json(&serde_json::json!({ "observers": observed }))?;
        } else {
            print(&dgp::text(&observed))?;
        }
        return Ok(Outcome::Done);
    }
    let observed = all_observed(&scene, &map, &eyes)?;
    observed.iter().for_each(observer::warn);
    if json {
        print_json(&serde_json::json!({ "observers": observed }))?;
    } else {
        print(&observer::text(&observed))?;
    }
    Ok(Outcome::Done)
}

/// The rating of an observer, and the luminance of the background, cd/m2; `None` of one who is inside of something.
pub(crate) fn rated(
    scene: &Scene,
    reader: &MapReader<'_>,
    eye: &Camera,
) -> Option<(Option<Figure>, f64)> {
    observer::observed(scene, reader, eye).map(|of| (of.ugr, of.background_cd_m2))
}

fn all_observed(
    scene: &Scene,
    map: &IlluminationMap,
    eyes: &[Camera],
) -> Result<Vec<Observed>, Failure> {
    let reader = MapReader::new(scene, map);
    let of = |eye: &Camera| {
        observer::observed(scene, &reader, eye).ok_or_else(|| {
            Failure::bad_input(format!(
                "observer `{}` is inside of something; move it into the room",
                name(&eye.name)
            ))
        })
    };
    eyes.iter().map(of).collect()
}
