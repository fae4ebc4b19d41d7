//! Particles for caustics: their flights, their aim, and the parts of elements where they land.

mod aim;
pub(crate) mod element_parts;
pub(crate) mod flights;

pub(crate) use aim::Aim;
#[cfg(test)]
pub(crate) use element_parts::samples;
pub(crate) use element_parts::{
    ElementParts, PARTS, Squared, part_of, read_in_parts, squared_error,
};
#[cfg(test)]
pub(crate) use flights::particles;
pub(crate) use flights::{CausticNoise, DOUBT_SHARE, Flights, LEAST_SHARE, ParticleTrial};
