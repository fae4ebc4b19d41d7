//! What is solved: every method, a white room, and a map for every group.

use crate::case::{Case, MCGUIRE, case};

/// Runs of seconds, which are disturbed. As many as there are faults have no factor in common with it.
pub(super) const CASES: [Case; 6] = [
    case("hybrid", "builtin:cube", "hybrid", "0.3%"),
    case("forward", "builtin:cube", "forward", "4%"),
    case("radiosity", MCGUIRE, "radiosity", "3%"),
    case("cache", MCGUIRE, "cache", "4%"),
    case("white room", "benchmarks/reliability/white_room.toml", "hybrid", "1.5%"),
    case("groups", "benchmarks/golden/groups.toml", "hybrid", "2%").with(&["--group"]),
];

/// A run that is long enough to be watched: it keeps states on the way.
pub(super) const LONG: Case = case("long", "builtin:cube", "hybrid", "0.03%");

/// A run that lasts longer than another one waits for its output.
pub(super) const MEDIUM: Case = case("medium", "builtin:cube", "hybrid", "0.1%");

/// Runs of a part of a second, for processors that are played by a program.
pub(super) const SMALL: [Case; 4] = [
    case("hybrid", "builtin:cube", "hybrid", "5%"),
    case("forward", "builtin:cube", "forward", "20%"),
    case("radiosity", "builtin:cube", "radiosity", "5%"),
    case("cache", "builtin:cube", "cache", "10%"),
];
