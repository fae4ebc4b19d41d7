//! How the mean of a grid depends on what it is computed from, by paths.

use crate::failure::Failure;
use crate::meter::Meter;
use crate::shown::name;
use isolux::engine::{ExactSettings, PathTracer, ProbePoint, Sensitivity};
use isolux::map::{Figure, NORMAL_95};
use isolux::scene::{CalculationGrid, Scene};
use rayon::prelude::*;

/// Paths of all points together, about: derivatives are known to a few per cent, as nobody knows an uncertainty better.
const PATHS: u32 = 1 << 18;
/// Paths of a point at least, in each of so many replicates.
const LEAST: u32 = 16;
const REPLICATES: u32 = 16;
/// Points between two looks at how far it is.
const TOGETHER: usize = 16;

/// The mean of a grid, maintained, and what it depends on, lx.
pub(super) struct Traced {
    pub(super) mean_lx: Figure,
    /// Its part from each group of luminaires; one without a name where the scene has no groups.
    pub(super) by_group_lx: Vec<(Option<String>, f64)>,
    /// Its change for a relative change of the reflectance of each material, of the whole of it.
    pub(super) by_material_lx: Vec<(String, f64)>,
}

impl Traced {
    pub(super) fn of(scene: &Scene, grid: &CalculationGrid) -> Result<Self, Failure> {
        let materials = scene.materials().len();
        let classes: Vec<u32> =
            (0..scene.triangle_count()).map(|triangle| scene.material_index(triangle)).collect();
        let all = means(scene, grid, (&classes, materials))?;
        let by_material = scene.materials().iter().zip(&all.by_class_lx);
        let by_material = by_material.map(|(material, lx)| (material.name.clone(), mean(lx)));
        let mean_lx = mean(&all.illuminance_lx);
        let half_lx = NORMAL_95 * standard_error(&all.illuminance_lx);
        Ok(Self {
            mean_lx: Figure { value: mean_lx, low: mean_lx - half_lx, high: mean_lx + half_lx },
            by_group_lx: by_group(scene, grid, mean_lx)?,
            by_material_lx: by_material.filter(|(_, lx)| *lx > 0.0).collect(),
        })
    }
}

/// Light is linear in that of its groups.
fn by_group(
    scene: &Scene,
    grid: &CalculationGrid,
    mean_lx: f64,
) -> Result<Vec<(Option<String>, f64)>, Failure> {
    let classes = vec![0; scene.triangle_count() as usize];
    let mut found = Vec::new();
    for (number, group) in (0..).zip(scene.groups()) {
        if let Some(lit) = scene.lit_by(number) {
            let of_group = means(&lit, grid, (&classes, 1))?;
            found.push((Some(group.clone()), mean(&of_group.illuminance_lx)));
        }
    }
    if found.len() < 2 {
        return Ok(vec![(None, mean_lx)]);
    }
    Ok(found)
}

/// The means over the points of a grid, replicate by replicate.
fn means(
    scene: &Scene,
    grid: &CalculationGrid,
    (classes, count): (&[u32], usize),
) -> Result<Sensitivity, Failure> {
    let nothing = || {
        let grid = name(&grid.name);
        Failure::bad_input(format!("grid `{grid}` lies outside of the room; put it where light is"))
    };
    let normal = grid.normal().ok_or_else(nothing)?;
    let points = grid.points();
    let tracer = PathTracer::new(scene);
    let paths = PATHS / REPLICATES / u32::try_from(points.len()).unwrap_or(u32::MAX).max(1);
    let settings = ExactSettings { rays: paths.max(LEAST), replicates: REPLICATES, seed: 1 };
    let of = |&position| {
        tracer.sensitivity(ProbePoint { position, normal }, (classes, count), &settings)
    };
    let mut meter = Meter::new(format!("sensitivity of {} points", points.len()), None);
    let mut found: Vec<Sensitivity> = Vec::with_capacity(points.len());
    for together in points.chunks(TOGETHER) {
        meter.tell(found.len() as f64 / points.len() as f64);
        found.par_extend(together.par_iter().map(of));
    }
    // Points in furniture, and those outside of the room, get no light.
    found.retain(|point| mean(&point.illuminance_lx) > 0.0);
    if found.is_empty() {
        return Err(nothing());
    }
    let factor = grid.maintenance_factor;
    let over = |read: &dyn Fn(&Sensitivity) -> &Vec<f64>| -> Vec<f64> {
        let of = |replicate: usize| found.iter().map(|point| read(point)[replicate]).sum::<f64>();
        (0..REPLICATES as usize).map(|k| factor * of(k) / found.len() as f64).collect()
    };
    Ok(Sensitivity {
        illuminance_lx: over(&|point| &point.illuminance_lx),
        by_class_lx: (0..count).map(|class| over(&|point| &point.by_class_lx[class])).collect(),
    })
}

fn mean(of: &[f64]) -> f64 {
    of.iter().sum::<f64>() / of.len().max(1) as f64
}

/// Of the mean of independent replicates.
fn standard_error(of: &[f64]) -> f64 {
    let (mean, count) = (mean(of), of.len() as f64);
    let squares: f64 = of.iter().map(|value| (value - mean) * (value - mean)).sum();
    (squares / (count * (count - 1.0))).sqrt()
}
