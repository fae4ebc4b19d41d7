//! isolux for Python: the command, scenes and maps in memory. What Python programs see is in `python/isolux`; its module
//! `_native` is this.

mod arrays;
mod error;
mod exact;
mod held;
mod map;
mod parts;
mod readings;
mod scene;
mod work;

use isolux_cli::embedded::{self, Caller, Given};
use pyo3::prelude::*;
use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::Arc;

/// What `isolux._native` holds.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::exact::{colours, errors, exact};
    #[pymodule_export]
    use super::held::{Map, Scene};
    #[pymodule_export]
    use super::parts::PartMaker;
    #[pymodule_export]
    use super::{command, defect, run};
}

/// Runs the command to its exit code. It speaks on the streams of the process, catches its signals and may end it.
#[pyfunction]
fn command(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| isolux_cli::command(words.into_iter()))
}

/// Carries out a subcommand, to its exit code. With `makes_increments`, `tell` is asked for the increments of runs.
#[pyfunction]
fn run(
    py: Python<'_>,
    words: Vec<OsString>,
    given: Vec<(PathBuf, Bound<'_, PyAny>)>,
    tell: Bound<'_, PyAny>,
    waits: bool,
    makes_increments: bool,
) -> PyResult<u8> {
    let given = given.into_iter().map(|(name, held)| Ok((name, handed_in(&held)?)));
    let given = given.collect::<PyResult<Vec<_>>>()?;
    work::call(py, (&tell, waits), move |caller| {
        embedded::run(&words, Caller { given, makes_increments, ..caller })
    })
}

fn handed_in(held: &Bound<'_, PyAny>) -> PyResult<Given> {
    if let Ok(map) = held.cast::<held::Map>() {
        return Ok(Given::Map(Arc::clone(&map.get().held)));
    }
    Ok(Given::Scene(Arc::clone(&held.cast::<held::Scene>()?.get().held)))
}

/// Fails by a panic, so that tests see how a defect arrives.
#[pyfunction]
fn defect(py: Python<'_>, tell: Bound<'_, PyAny>) -> PyResult<()> {
    work::call(py, (&tell, false), |_| panic!("asked for by a test"))
}
