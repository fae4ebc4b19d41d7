//! Maps in memory.

use crate::held::{Map, Scene};
use crate::readings::{Light, Points, places};
use crate::{arrays, work};
use isolux::map::Illuminance;
use isolux_cli::embedded::{self, Way};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;
use std::sync::Arc;

#[pymethods]
impl Map {
    /// Reads a map file.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf, tell: Bound<'_, PyAny>) -> PyResult<Self> {
        let read = move |caller| embedded::read_map(&path, caller);
        Ok(Self { held: Arc::new(work::call(py, (&tell, false), read)?) })
    }

    /// The bytes of the map file.
    fn file<'py>(
        &self,
        py: Python<'py>,
        name: PathBuf,
        tell: Bound<'_, PyAny>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let held = Arc::clone(&self.held);
        let write = move |_| embedded::map_bytes(&name, &held.0, &held.1);
        Ok(PyBytes::new(py, &work::call(py, (&tell, false), write)?))
    }

    /// The scene in it.
    fn scene(&self) -> Scene {
        Scene { held: Arc::new(self.held.0.clone()) }
    }

    #[getter]
    fn complete(&self) -> bool {
        self.held.1.provenance.complete
    }

    /// The reported error of the scene, a share; none where it is not known.
    #[getter]
    fn accuracy_reached(&self) -> Option<f64> {
        self.held.1.provenance.accuracy.map(|accuracy| accuracy.reached)
    }

    #[getter]
    fn increments(&self) -> u64 {
        self.held.1.provenance.increments
    }

    #[getter]
    fn receivers(&self) -> usize {
        self.held.1.values.len()
    }

    /// Positions of vertices, m.
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let vertices = self.held.1.elements.vertices();
        arrays::rows(py, vertices.iter().map(|vertex| vertex.position.into()).collect())
    }

    /// Normals of vertices.
    fn normals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let vertices = self.held.1.elements.vertices();
        arrays::rows(py, vertices.iter().map(|vertex| vertex.normal.to_vector().into()).collect())
    }

    /// The area that vertices stand for, m2.
    fn areas<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        let vertices = self.held.1.elements.vertices();
        arrays::list(py, vertices.iter().map(|vertex| vertex.area_m2).collect()).into_any()
    }

    /// Vertices of elements; the triangle of the scene that each is part of; whether it is on the back of that.
    fn elements<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let elements = self.held.1.elements.elements();
        let triangles = elements.iter().map(|element| element.triangle).collect();
        let backs = elements.iter().map(|element| element.back).collect();
        let vertices = elements.iter().map(|element| element.vertices).collect();
        Ok((
            arrays::rows(py, vertices)?,
            arrays::list(py, triangles).into_any(),
            arrays::list(py, backs).into_any(),
        ))
    }

    /// Light at vertices, as `isolux export` writes it.
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let value = |vertex| {
            let light = self.held.1.read_at_vertex(vertex).map(Illuminance::from);
            Light::of(light.as_ref()).row()
        };
        arrays::rows(py, (0..self.held.1.values.len() as u32).map(value).collect())
    }

    /// Readings at points; `way` is `"probe"`, `"exact"` or `"interpolated"`.
    fn readings<'py>(
        &self,
        py: Python<'py>,
        name: PathBuf,
        points: Points<'_>,
        way: &str,
        tell: Bound<'_, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let way = match way {
            "exact" => Way::Exact,
            "interpolated" => Way::Interpolated,
            _ => Way::Probe,
        };
        let (held, points) = (Arc::clone(&self.held), places(&points)?);
        let read =
            move |caller| embedded::readings((&held.0, &held.1, &name), &points, way, caller);
        let values = work::call(py, (&tell, false), read)?;
        arrays::rows(py, values.iter().map(|value| Light::of(value.as_ref()).row()).collect())
    }
}
