//! The one mapping of failures to exceptions, which are defined in `isolux/_errors.py`.

use isolux_cli::embedded::{Failure, Trouble};
use pyo3::prelude::*;

/// The exception of a failure, with the words of the command.
pub(crate) fn of_failure(py: Python<'_>, failure: &Failure) -> PyErr {
    let name = match failure {
        Failure::BadInput(_) => "InputError",
        _ => "RefusedError",
    };
    let tell = |of: Trouble| (of.message, of.file, of.place, of.remedy);
    let problems: Vec<_> = failure.troubles().into_iter().map(tell).collect();
    made(py, name, problems)
}

/// The exception of an argument that is wrong, in words as `wrong` of `isolux/_errors.py` has them.
pub(crate) fn of_argument(py: Python<'_>, text: &str) -> PyErr {
    let make = || py.import("isolux._errors")?.getattr("wrong")?.call1((text,));
    make().map_or_else(|error| error, PyErr::from_value)
}

/// The exception of a panic.
pub(crate) fn of_panic(py: Python<'_>, panic: &(dyn std::any::Any + Send)) -> PyErr {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no words");
    made(py, "Defect", text.to_owned())
}

fn made<'py>(py: Python<'py>, name: &str, from: impl IntoPyObject<'py>) -> PyErr {
    let make = || py.import("isolux._errors")?.getattr(name)?.call_method1("_of", (from,));
    make().map_or_else(|error| error, PyErr::from_value)
}
