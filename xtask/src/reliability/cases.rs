//! What is solved: every method, a white room, and a map for every group.

/// A scene, and how it is solved.
pub(super) struct Case {
    pub(super) name: &'static str,
    /// As `isolux solve` takes it, from the root of the workspace.
    pub(super) scene: &'static str,
    pub(super) method: &'static str,
    pub(super) accuracy: &'static str,
    pub(super) flags: &'static [&'static str],
}

const fn case(
    name: &'static str,
    scene: &'static str,
    method: &'static str,
    accuracy: &'static str,
) -> Case {
    Case { name, scene, method, accuracy, flags: &[] }
}

const MCGUIRE: &str = "scenes/cornell_mcguire/scene.toml";

/// Runs of seconds, which are disturbed. As many as there are faults have no factor in common with it.
pub(super) const CASES: [Case; 6] = [
    case("hybrid", "builtin:cube", "hybrid", "0.3%"),
    case("forward", "builtin:cube", "forward", "4%"),
    case("radiosity", MCGUIRE, "radiosity", "3%"),
    case("cache", MCGUIRE, "cache", "4%"),
    case("white room", "benchmarks/reliability/white_room.toml", "hybrid", "1.5%"),
    Case { flags: &["--group"], ..case("groups", "benchmarks/golden/groups.toml", "hybrid", "2%") },
];

/// A run that is long enough to be watched.
pub(super) const LONG: Case = case("long", "builtin:cube", "hybrid", "0.15%");

/// Runs of a part of a second, for processors that are played by a program.
pub(super) const SMALL: [Case; 4] = [
    case("hybrid", "builtin:cube", "hybrid", "5%"),
    case("forward", "builtin:cube", "forward", "20%"),
    case("radiosity", "builtin:cube", "radiosity", "5%"),
    case("cache", "builtin:cube", "cache", "10%"),
];
