//! The engines from outside: from a scene to a map.

mod balance;
mod calibration;
mod corners;
mod degenerate;
mod hidden;
mod radiosity;
mod refusals;
mod repeat;
mod rooms;
mod rugs;
mod runs;
mod trusting;
