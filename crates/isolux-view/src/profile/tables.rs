//! Displays described by tables.

use super::curve::within;
use super::error::ProfileError;
use super::pcs::Pcs;
use super::pipeline::{Pipeline, Way};
use crate::colorimetry::{D50_XYZ, D65_XYZ, adaptation};
use crate::matrix::Matrix3;
use moxcms::{DataColorSpace, LutType, LutWarehouse};

/// A table from codes to colours and one back.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tables {
    to_pcs: (Pipeline, Pcs),
    from_pcs: (Pcs, Pipeline),
    d65_from_d50: Matrix3,
    d50_from_d65: Matrix3,
}

impl Tables {
    pub(super) fn new(
        pcs: DataColorSpace,
        to_pcs: &LutWarehouse,
        from_pcs: &LutWarehouse,
    ) -> Result<Self, ProfileError> {
        let space = |table: &LutWarehouse| {
            let none = || ProfileError::Tables("connection space".to_owned());
            Pcs::of(pcs, kind(table)).ok_or_else(none)
        };
        let (to, from) = (space(to_pcs)?, space(from_pcs)?);
        let way = Way::FromPcs { is_xyz: from == Pcs::Xyz };
        Ok(Self {
            to_pcs: (Pipeline::of(to_pcs, Way::ToPcs)?, to),
            from_pcs: (from, Pipeline::of(from_pcs, way)?),
            d65_from_d50: adaptation(D50_XYZ, D65_XYZ),
            d50_from_d65: adaptation(D65_XYZ, D50_XYZ),
        })
    }

    /// XYZ under D65 of a code.
    pub(super) fn xyz_from_code(&self, code: [u8; 3]) -> [f64; 3] {
        let (pipeline, pcs) = &self.to_pcs;
        let signals = code.map(|channel| f64::from(channel) / 255.0);
        self.d65_from_d50.apply(pcs.xyz(pipeline.run(signals)))
    }

    /// The code for XYZ under D65.
    pub(super) fn code_from_xyz(&self, xyz: [f64; 3]) -> [u8; 3] {
        let (pcs, pipeline) = &self.from_pcs;
        let signals = pipeline.run(pcs.numbers(self.d50_from_d65.apply(xyz)));
        signals.map(|channel| (255.0 * within(channel) + 0.5) as u8)
    }
}

/// The type by which a table writes its numbers: those with a matrix do so alike both ways.
fn kind(table: &LutWarehouse) -> LutType {
    match table {
        LutWarehouse::Lut(table) => table.lut_type,
        LutWarehouse::Multidimensional(_) => LutType::LutMab,
    }
}
