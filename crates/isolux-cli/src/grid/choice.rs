//! Which calculation grids are asked for.

use crate::failure::Failure;
use crate::flags::GridChoice;
use crate::quantity::significant;
use crate::shown::{name, names};
use isolux::geometry::{Point, Vector};
use isolux::scene::{CalculationGrid, Scene, UpAxis};
use std::path::Path;

/// The grids asked for: a working plane, a grid by its sides, or those of the scene. Areas of emergency lighting have to be named.
pub(crate) fn chosen(
    choice: &GridChoice,
    source: &Path,
    scene: &Scene,
) -> Result<Vec<CalculationGrid>, Failure> {
    if choice.is_empty() && !scene.grids().is_empty() && !has_ordinary(scene) {
        return Err(Failure::bad_input(format!(
            "{}: all grids are areas of emergency lighting; judge them by `isolux grid --emergency as-marked`, or name one",
            source.display()
        )));
    }
    chosen_of(choice, (source, scene), |grid| grid.emergency.is_none())
}

/// Whether some grid of a scene is no area of emergency lighting.
pub(crate) fn has_ordinary(scene: &Scene) -> bool {
    scene.grids().iter().any(|grid| grid.emergency.is_none())
}

/// The same; of grids of the scene that are not named, those that are meant.
pub(crate) fn chosen_of(
    choice: &GridChoice,
    (source, scene): (&Path, &Scene),
    is_meant: fn(&CalculationGrid) -> bool,
) -> Result<Vec<CalculationGrid>, Failure> {
    let mut grids = match (choice.height, choice.corner.zip(choice.u.zip(choice.v))) {
        (Some(height_m), _) => vec![working_plane(source, scene, height_m)?],
        (None, Some((corner, (u, v)))) => vec![CalculationGrid {
            name: "grid".into(),
            corner: Point::from(corner),
            u: Vector::from(u),
            v: Vector::from(v),
            spacing_m: None,
            border_m: 0.0,
            maintenance_factor: 1.0,
            requirements: Vec::new(),
            emergency: None,
        }],
        (None, None) => named(choice, (source, scene), is_meant)?,
    };
    for grid in &mut grids {
        grid.spacing_m = choice.spacing.or(grid.spacing_m);
        grid.border_m = choice.border.unwrap_or(grid.border_m);
        if let Some((what, remedy)) = grid.problem() {
            return Err(Failure::bad_input(format!(
                "grid `{}` {what}; {remedy}",
                name(&grid.name)
            )));
        }
    }
    Ok(grids)
}

fn named(
    choice: &GridChoice,
    (source, scene): (&Path, &Scene),
    is_meant: fn(&CalculationGrid) -> bool,
) -> Result<Vec<CalculationGrid>, Failure> {
    let all = scene.grids();
    let source = source.display();
    if all.is_empty() {
        return Err(Failure::bad_input(format!(
            "{source}: has no calculation grids; give one with --height or --corner, --u and --v, or add \
             [[grid]] to its scene.toml"
        )));
    }
    let Some(name) = &choice.name else {
        return Ok(all.iter().filter(|grid| is_meant(grid)).cloned().collect());
    };
    let found: Vec<CalculationGrid> = all.iter().filter(|g| g.name == *name).cloned().collect();
    if found.is_empty() {
        return Err(Failure::bad_input(format!(
            "{source}: has no grid `{name}`; choose one of {}",
            names(all.iter().map(|g| g.name.as_str()))
        )));
    }
    Ok(found)
}

/// A horizontal grid over all of the floor plan, facing up.
fn working_plane(source: &Path, scene: &Scene, height_m: f64) -> Result<CalculationGrid, Failure> {
    let mut low = Vector::new(f64::INFINITY, f64::INFINITY, f64::INFINITY);
    let mut high = -low;
    for corner in (0..scene.triangle_count()).flat_map(|t| scene.triangle(t).corners) {
        low = Vector::new(low.x.min(corner.x), low.y.min(corner.y), low.z.min(corner.z));
        high = Vector::new(high.x.max(corner.x), high.y.max(corner.y), high.z.max(corner.z));
    }
    let size = high - low;
    let (lowest_m, highest_m) = match scene.up() {
        UpAxis::Z => (low.z, high.z),
        UpAxis::Y => (low.y, high.y),
    };
    if !(lowest_m..=highest_m).contains(&height_m) {
        return Err(Failure::bad_input(format!(
            "{}: --height {height_m} lies outside of the scene, which goes from {} to {} m; give one between",
            source.display(),
            significant(lowest_m, 3),
            significant(highest_m, 3)
        )));
    }
    let (corner, u, v) = match scene.up() {
        UpAxis::Z => (
            Point::new(low.x, low.y, height_m),
            Vector::new(size.x, 0.0, 0.0),
            Vector::new(0.0, size.y, 0.0),
        ),
        UpAxis::Y => (
            Point::new(low.x, height_m, high.z),
            Vector::new(size.x, 0.0, 0.0),
            Vector::new(0.0, 0.0, -size.z),
        ),
    };
    Ok(CalculationGrid {
        name: format!("working plane at {height_m} m"),
        corner,
        u,
        v,
        spacing_m: None,
        border_m: CalculationGrid::usual_border_m([u.length(), v.length()]),
        maintenance_factor: 1.0,
        requirements: Vec::new(),
        emergency: None,
    })
}
