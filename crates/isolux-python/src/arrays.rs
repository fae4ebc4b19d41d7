//! Values to arrays of numpy, which take the memory over.

use numpy::{Element, IntoPyArray, PyArray1, PyArrayMethods};
use pyo3::prelude::*;

/// Rows of equal length.
pub(crate) fn rows<'py, T: Element, const N: usize>(
    py: Python<'py>,
    rows: Vec<[T; N]>,
) -> PyResult<Bound<'py, PyAny>> {
    let count = rows.len();
    Ok(rows.into_flattened().into_pyarray(py).reshape([count, N])?.into_any())
}

/// A colour a pixel, rows from the top.
pub(crate) fn image<'py, T: Element>(
    py: Python<'py>,
    [height, width]: [u32; 2],
    pixels: Vec<[T; 3]>,
) -> PyResult<Bound<'py, PyAny>> {
    let shape = [height as usize, width as usize, 3];
    Ok(pixels.into_flattened().into_pyarray(py).reshape(shape)?.into_any())
}

/// Numbers.
pub(crate) fn list<T: Element>(py: Python<'_>, values: Vec<T>) -> Bound<'_, PyArray1<T>> {
    values.into_pyarray(py)
}
