//! The walk-through: what the page in the browser is given, from a map or from a run.

mod fineness;
mod grids;
mod hello;
mod opened;
mod page;
mod told;

#[cfg(feature = "serve")]
pub(crate) use fineness::fineness;
pub(crate) use fineness::finer;
pub(crate) use opened::Opened;
pub(crate) use page::file;
#[cfg(feature = "serve")]
pub(crate) use {
    grids::grids_of_map,
    hello::Hello,
    told::{ALL_LIGHT, told},
};

/// The page: built from `web/` by `npm run build` there.
pub(crate) const PAGE: &str = include_str!("../../../../web/dist/walk.html");
