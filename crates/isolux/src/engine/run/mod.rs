//! A run from request to map.

mod increments;
mod part;
pub(crate) mod prediction;
mod request;
mod solve;
mod state;
pub use part::{MergeError, RunPart, Segment};
pub use request::{Foreseen, Prediction, Progress, SolveError, SolveRequest, Stage, Watch};
pub use solve::{
    Elsewhere, PartMaker, SoFar, Solution, Watcher, foresee, make_pilot, solve, solve_elsewhere,
    solve_looked_at, solve_merged, with_parts,
};
pub use state::{Audited, PilotState, RunIdentity, RunState};
