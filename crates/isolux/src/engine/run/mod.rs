//! A run from request to map.

mod increments;
pub(crate) mod prediction;
mod request;
mod solve;
mod state;
pub use request::{Foreseen, Prediction, Progress, SolveError, SolveRequest, Stage, Watch};
pub use solve::{SoFar, Solution, Watcher, foresee, solve, solve_looked_at};
pub use state::{Audited, RunIdentity, RunState};
