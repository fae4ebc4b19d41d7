//! Which cases, engines and seeds.

use crate::failure::Failure;
use crate::flags::ValidateFlags;
use crate::request;
use isolux::map::Method;
use isolux_compare::Case;
use isolux_compare::case::{cases, find};

pub(super) fn methods(flags: &ValidateFlags) -> Vec<Method> {
    let mut all = vec![Method::Hybrid, Method::Forward, Method::Cache];
    if !flags.calibrate {
        all.push(Method::Radiosity);
    }
    flags.method.map_or(all, |name| vec![request::method(name)])
}

pub(super) fn seeds(count: u32) -> Vec<u64> {
    (1..=u64::from(count)).collect()
}

pub(super) fn chosen(name: Option<&str>) -> Result<Vec<Case>, Failure> {
    let Some(name) = name else { return Ok(cases()) };
    find(name).map(|case| vec![case]).ok_or_else(|| {
        let names: Vec<&str> = cases().iter().map(|case| case.name).collect();
        let names = names.join(", ");
        Failure::bad_input(format!("there is no case `{name}`; choose one of {names}"))
    })
}
