//! `[sky]`: the sky and the sun, by the place, by the weather, by a picture or by numbers.

mod asked;
mod entry;
mod kind;
mod luminances;
mod resolve;
mod sun;

pub use asked::{SkyAsked, put_sky};
pub(super) use entry::kind as kind_of_entry;
pub(super) use resolve::luminaires;
