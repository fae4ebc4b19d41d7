//! Calculation grids as the page shows them.

use crate::grid_values::GridValues;
use isolux::engine::MapReader;
use isolux::map::{Figure, Illuminance, IlluminationMap};
use isolux::scene::Scene;
use serde::Serialize;

/// A grid as `web/src/wire.ts` has it.
#[derive(Serialize)]
struct GridTable {
    name: String,
    corner: [f64; 3],
    u: [f64; 3],
    v: [f64; 3],
    columns: u32,
    rows: u32,
    maintenance_factor: f64,
    points: Vec<[f64; 3]>,
    illuminance_lx: Vec<Option<f64>>,
    standard_error_lx: Vec<Option<f64>>,
    figures: Vec<FigureRecord>,
}

#[derive(Serialize)]
struct FigureRecord {
    name: &'static str,
    unit: &'static str,
    value: f64,
    low: f64,
    high: f64,
}

/// The calculation grids as JSON, read as `grid` reads them.
pub(crate) fn grids_of_map(scene: &Scene, map: &IlluminationMap) -> Vec<u8> {
    if scene.grids().is_empty() {
        return b"[]".to_vec();
    }
    let reader = MapReader::new(scene, map);
    serde_json::to_vec(&tables(scene, &reader)).unwrap_or_default()
}

/// The grids of a scene with the values of its map; those that have problems are left out.
fn tables(scene: &Scene, reader: &MapReader<'_>) -> Vec<GridTable> {
    let sound = scene.grids().iter().filter(|grid| grid.problem().is_none());
    let read = sound.filter_map(|grid| GridValues::of(grid.clone(), (scene, reader)));
    read.map(|read| table(&read)).collect()
}

fn table(read: &GridValues) -> GridTable {
    let grid = &read.grid;
    let [columns, rows] = grid.counts();
    let values: Vec<Option<Illuminance>> = read.maintained().collect();
    let figures = read.figures.iter().flat_map(|figures| {
        [
            ("Em", "lx", figures.mean_lx),
            ("Emin", "lx", figures.least_lx),
            ("Emax", "lx", figures.greatest_lx),
            ("U0", "", figures.uniformity),
            ("Ud", "", figures.diversity),
        ]
    });
    let figure =
        |(name, unit, Figure { value, low, high })| FigureRecord { name, unit, value, low, high };
    GridTable {
        name: grid.name.clone(),
        corner: grid.corner.into(),
        u: grid.u.into(),
        v: grid.v.into(),
        columns,
        rows,
        maintenance_factor: grid.maintenance_factor,
        points: read.points.iter().map(|&point| point.into()).collect(),
        illuminance_lx: values.iter().map(|v| v.map(|v| v.illuminance_lx())).collect(),
        standard_error_lx: values.iter().map(|v| v.map(|v| v.standard_error_lx)).collect(),
        figures: figures.map(figure).collect(),
    }
}
