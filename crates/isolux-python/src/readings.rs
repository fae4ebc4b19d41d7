//! Points that are asked for, and what is read there.

use crate::error;
use isolux::engine::ProbePoint;
use isolux::geometry::{Point, Vector};
use isolux::map::Illuminance;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

/// Rows of `x y z nx ny nz`.
pub(crate) type Points<'py> = PyReadonlyArray2<'py, f64>;

/// Places that rows tell; each has to be finite, with a normal.
pub(crate) fn places(points: &Points<'_>) -> PyResult<Vec<ProbePoint>> {
    let rows = points.as_array();
    let place = |(index, row): (usize, numpy::ndarray::ArrayView1<'_, f64>)| {
        let wrong = |what: &str| error::of_argument(points.py(), &format!("point {index}: {what}"));
        let [x, y, z, nx, ny, nz] = std::array::from_fn(|k| row[k]);
        if !row.iter().all(|number| number.is_finite()) {
            return Err(wrong("a coordinate is not finite; give six finite numbers"));
        }
        let normal = Vector::new(nx, ny, nz).normal();
        let normal = normal
            .ok_or_else(|| wrong("the normal has no direction; 0 0 1 faces up in a z-up scene"))?;
        Ok(ProbePoint { position: Point::new(x, y, z), normal })
    };
    rows.rows().into_iter().enumerate().map(place).collect()
}

/// What arrays tell of the light at a place.
pub(crate) struct Light<'a>(Option<&'a Illuminance>);

impl<'a> Light<'a> {
    pub(crate) fn of(value: Option<&'a Illuminance>) -> Self {
        Self(value)
    }

    /// In the order of `READING` in `isolux/_readings.py`; not a number where nothing is known.
    pub(crate) fn row(&self) -> [f64; 8] {
        let Some(value) = self.0 else { return [f64::NAN; 8] };
        let [red, green, blue] = value.total_lx().0;
        [
            value.illuminance_lx(),
            value.standard_error_lx,
            value.direct_lx.luminance(),
            value.caustic_lx.luminance(),
            value.indirect_lx.luminance(),
            red,
            green,
            blue,
        ]
    }
}
