//! Scenes in memory.

use crate::held::Scene;
use crate::readings::{Light, Points, places};
use crate::{arrays, error, work};
use isolux_cli::embedded;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::Arc;

#[pymethods]
impl Scene {
    /// Reads a scene by the words of `isolux check`.
    #[staticmethod]
    fn read(py: Python<'_>, words: Vec<OsString>, tell: Bound<'_, PyAny>) -> PyResult<Self> {
        let read = move |caller| embedded::read_scene(&words, caller);
        Ok(Self { held: Arc::new(work::call(py, (&tell, false), read)?) })
    }

    /// Its bytes, for another process of the same build.
    fn packed<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = py.detach(|| embedded::scene_bytes(&self.held));
        bytes
            .map(|bytes| PyBytes::new(py, &bytes))
            .map_err(|failure| error::of_failure(py, &failure))
    }

    /// The scene of such bytes.
    #[staticmethod]
    fn unpacked(py: Python<'_>, bytes: &[u8]) -> PyResult<Self> {
        match py.detach(|| embedded::scene_of_bytes(bytes)) {
            Ok(scene) => Ok(Self { held: Arc::new(scene) }),
            Err(failure) => Err(error::of_failure(py, &failure)),
        }
    }

    #[getter]
    fn name(&self) -> &str {
        self.held.name()
    }

    /// `"y"` or `"z"`.
    #[getter]
    fn up(&self) -> &'static str {
        match self.held.up() {
            isolux::scene::UpAxis::Y => "y",
            isolux::scene::UpAxis::Z => "z",
        }
    }

    #[getter]
    fn hash(&self) -> String {
        self.held.hash()
    }

    #[getter]
    fn triangle_count(&self) -> u32 {
        self.held.triangle_count()
    }

    #[getter]
    fn area_m2(&self) -> f64 {
        (0..self.held.triangle_count()).map(|index| self.held.triangle(index).area()).sum()
    }

    #[getter]
    fn luminous_flux_lm(&self) -> f64 {
        self.held.luminous_flux_lm()
    }

    /// Lowest and highest coordinates, m; none without surfaces.
    #[getter]
    fn bounds_m(&self) -> Option<[[f64; 3]; 2]> {
        let (low, high) = self.held.bvh().mesh().bounds()?;
        Some([low.into(), high.into()])
    }

    #[getter]
    fn shapes(&self) -> Vec<String> {
        self.held.shape_names().to_vec()
    }

    #[getter]
    fn materials(&self) -> Vec<String> {
        self.held.materials().iter().map(|material| material.name.clone()).collect()
    }

    #[getter]
    fn luminaires(&self) -> Vec<String> {
        self.held.luminaires().iter().map(|luminaire| luminaire.name.clone()).collect()
    }

    #[getter]
    fn groups(&self) -> Vec<String> {
        self.held.groups().to_vec()
    }

    #[getter]
    fn cameras(&self) -> Vec<String> {
        self.held.cameras().iter().map(|camera| camera.name.clone()).collect()
    }

    #[getter]
    fn grids(&self) -> Vec<String> {
        self.held.grids().iter().map(|grid| grid.name.clone()).collect()
    }

    /// The corners of all triangles, m: rows of nine.
    fn corners<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let corners = |index| self.held.triangle(index).corners.map(<[f64; 3]>::from);
        arrays::rows(py, (0..self.held.triangle_count()).flat_map(corners).collect())
    }

    /// The shape of every triangle.
    fn shape_of<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        let all = 0..self.held.triangle_count();
        arrays::list(py, all.map(|index| self.held.shape_of(index)).collect()).into_any()
    }

    /// The material of every triangle.
    fn material_of<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        let all = 0..self.held.triangle_count();
        arrays::list(py, all.map(|index| self.held.material_index(index)).collect()).into_any()
    }

    /// Readings by paths, as `isolux probe SCENE` has them, of so many paths and this seed: rows as of `Map.readings`.
    fn readings<'py>(
        &self,
        py: Python<'py>,
        name: PathBuf,
        points: Points<'_>,
        drawn: (Option<u32>, Option<u64>),
        tell: Bound<'_, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (scene, points) = (Arc::clone(&self.held), places(&points)?);
        let read = move |caller| embedded::traced((&scene, &name), &points, drawn, caller);
        let values = work::call(py, (&tell, false), read)?;
        arrays::rows(py, values.iter().map(|value| Light::of(value.as_ref()).row()).collect())
    }
}
