//! Skies: their record, and their pictures in one array.

use super::Fault;
use super::arrays::{self, Arrays, Table};
use super::bytes::Bytes;
use super::record::SkyRecord;
use isolux::photometry::{Sky, SkyPicture};
use std::sync::Arc;

/// Only where a sky is a picture.
const PICTURES: &str = "sky_pictures";

/// Pixels of all pictures, one picture after the other.
#[derive(Default)]
pub(super) struct Pictures(Vec<f64>);

impl Pictures {
    /// The record of a sky, whose picture is kept.
    pub(super) fn record(&mut self, sky: Sky) -> SkyRecord {
        match sky {
            Sky::General { sky, ground_cd_m2 } => SkyRecord::General { sky, ground_cd_m2 },
            Sky::Picture(picture) => {
                self.0.extend(picture.rgb_cd_m2.as_flattened().iter().map(|&c| f64::from(c)));
                SkyRecord::Picture { width: picture.width, height: picture.height }
            }
        }
    }

    /// Writes what was kept, if anything.
    pub(super) fn write(&self, bytes: &mut Bytes, table: &mut Table) {
        if !self.0.is_empty() {
            arrays::write_floats((bytes, table), PICTURES, 3, &self.0);
        }
    }
}

/// Pixels that skies of a file take their share of.
pub(super) struct Rows(std::vec::IntoIter<[f64; 3]>);

impl Rows {
    /// Those of a file; none where no sky asks for any.
    pub(super) fn of(arrays: &Arrays<'_>, are_asked_for: bool) -> Result<Self, Fault> {
        let rows = if are_asked_for { arrays.float_rows(PICTURES)? } else { Vec::new() };
        Ok(Self(rows.into_iter()))
    }

    /// The sky of a record.
    pub(super) fn sky(&mut self, record: SkyRecord, luminaire: &str) -> Result<Sky, Fault> {
        let (width, height) = match record {
            SkyRecord::General { sky, ground_cd_m2 } => {
                return Ok(Sky::General { sky, ground_cd_m2 });
            }
            SkyRecord::Picture { width, height } => (width, height),
        };
        let count = width as usize * height as usize;
        if count > self.0.len() {
            let what = "lacks pixels of its picture";
            return Err(Fault::new(format!("luminaire `{luminaire}`"), what));
        }
        let single = |rgb: [f64; 3]| rgb.map(|c| c as f32);
        let rgb_cd_m2 = self.0.by_ref().take(count).map(single).collect();
        Ok(Sky::Picture(Arc::new(SkyPicture { width, height, rgb_cd_m2 })))
    }
}
