//! What a table of an ICC file does, step by step.

use super::curve::Curve;
use super::error::ProfileError;
use super::grid::Grid;
use crate::matrix::Matrix3;
use moxcms::{
    LutDataType, LutMultidimensionalType, LutStore, LutWarehouse, Matrix3d, ToneReprCurve,
};

/// From three numbers of 0 to 1 to three others.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pipeline(Vec<Step>);

#[derive(Clone, Debug, PartialEq)]
enum Step {
    Curves([Curve; 3]),
    Affine(Matrix3, [f64; 3]),
    Grid(Grid),
}

/// Which way a table goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// From codes to the connection space.
    ToPcs,
    /// From the connection space, XYZ or not, to codes.
    FromPcs { is_xyz: bool },
}

impl Pipeline {
    /// The steps of a table.
    pub(super) fn of(table: &LutWarehouse, way: Way) -> Result<Self, ProfileError> {
        let (channels, steps) = match table {
            LutWarehouse::Lut(table) => {
                ([table.num_input_channels, table.num_output_channels], sampled(table, way))
            }
            LutWarehouse::Multidimensional(table) => {
                ([table.num_input_channels, table.num_output_channels], shaped(table, way))
            }
        };
        if channels != [3, 3] {
            return Err(ProfileError::Tables(format!(
                "{} to {} channels",
                channels[0], channels[1]
            )));
        }
        steps.map(Self)
    }

    /// What becomes of three numbers.
    pub(super) fn run(&self, numbers: [f64; 3]) -> [f64; 3] {
        self.0.iter().fold(numbers, |numbers, step| step.run(numbers))
    }
}

impl Step {
    fn run(&self, numbers: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Curves(curves) => [0, 1, 2].map(|k| curves[k].at(numbers[k])),
            Self::Affine(matrix, offset) => {
                let turned = matrix.apply(numbers);
                [0, 1, 2].map(|k| turned[k] + offset[k])
            }
            Self::Grid(grid) => grid.at(numbers),
        }
    }
}

/// Tables of 8 and 16 bits (ICC.1:2022, sections 10.10 and 10.11): a matrix, from XYZ only, curves, a grid, curves.
fn sampled(table: &LutDataType, way: Way) -> Result<Vec<Step>, ProfileError> {
    let curves = |store: &LutStore, entries: u16| {
        let values = wide(store);
        let mut each = values.chunks_exact(usize::from(entries).max(2)).map(Curve::sampled);
        let curves = [each.next(), each.next(), each.next()];
        three(curves.into_iter().flatten().collect())
    };
    let grid = Grid::new([table.num_clut_grid_points; 3], &wide(&table.clut_table))?;
    let mut steps = Vec::new();
    if way == (Way::FromPcs { is_xyz: true }) {
        steps.push(Step::Affine(matrix(&table.matrix)?, [0.0; 3]));
    }
    steps.push(Step::Curves(curves(&table.input_table, table.num_input_table_entries)?));
    steps.push(Step::Grid(grid));
    steps.push(Step::Curves(curves(&table.output_table, table.num_output_table_entries)?));
    Ok(steps)
}

/// Tables with a matrix among their curves (ICC.1:2022, sections 10.12 and 10.13): to the connection space A curves, grid, M curves,
/// matrix, B curves, all but the last of which may be missing; from it the same in reverse.
fn shaped(table: &LutMultidimensionalType, way: Way) -> Result<Vec<Step>, ProfileError> {
    let mut steps = Vec::new();
    if let Some(clut) = &table.clut {
        steps.extend(curves(&table.a_curves)?);
        let [a, b, c, ..] = table.grid_points;
        steps.push(Step::Grid(Grid::new([a, b, c], &wide(clut))?));
    }
    steps.extend(curves(&table.m_curves)?);
    steps.push(Step::Affine(matrix(&table.matrix)?, table.bias.v));
    steps.extend(curves(&table.b_curves)?);
    if way != Way::ToPcs {
        steps.reverse();
    }
    Ok(steps)
}

/// Curves that may be missing.
fn curves(curves: &[ToneReprCurve]) -> Result<Option<Step>, ProfileError> {
    if curves.is_empty() {
        return Ok(None);
    }
    let curves: Result<Vec<Curve>, _> = curves.iter().map(Curve::of).collect();
    three(curves?).map(Step::Curves).map(Some)
}

fn three(curves: Vec<Curve>) -> Result<[Curve; 3], ProfileError> {
    <[Curve; 3]>::try_from(curves).map_err(|_| ProfileError::Tables("number of curves".to_owned()))
}

fn matrix(matrix: &Matrix3d) -> Result<Matrix3, ProfileError> {
    let matrix = Matrix3(matrix.v);
    matrix.is_finite().then_some(matrix).ok_or_else(|| ProfileError::Tables("matrix".to_owned()))
}

/// Numbers in parts of 65535.
fn wide(store: &LutStore) -> Vec<u16> {
    match store {
        LutStore::Store8(bytes) => bytes.iter().map(|v| 257 * u16::from(*v)).collect(),
        LutStore::Store16(words) => words.clone(),
    }
}
