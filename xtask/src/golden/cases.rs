//! The cases: every kind of scene by the method that does most there, exact scenes by all methods.

use crate::case::{Case, MCGUIRE, case};

const DEMO: &str = "scenes/demo/scene.toml";

/// All of them: kinds of light and of surfaces, never two that differ in nothing but their numbers.
pub(super) const CASES: [Case; 40] = [
    case("cube", "builtin:cube", "hybrid", "0.5%"),
    case("cube-forward", "builtin:cube", "forward", "5%"),
    case("cube-radiosity", "builtin:cube", "radiosity", "2%"),
    case("cube-cache", "builtin:cube", "cache", "2%"),
    case("sphere", "builtin:sphere", "hybrid", "0.5%"),
    case("sphere-forward", "builtin:sphere", "forward", "5%"),
    case("sphere-radiosity", "builtin:sphere", "radiosity", "2%"),
    case("sphere-cache", "builtin:sphere", "cache", "2%"),
    case("cornell-embree", "scenes/cornell_embree/scene.toml", "hybrid", "2%"),
    case("cornell-mcguire", MCGUIRE, "hybrid", "2%"),
    case("cornell-mitsuba", "scenes/cornell_mitsuba/scene.xml", "hybrid", "2%"),
    case("cornell-forward", MCGUIRE, "forward", "10%"),
    case("cornell-radiosity", MCGUIRE, "radiosity", "5%"),
    case("cornell-cache", MCGUIRE, "cache", "5%"),
    case("groups", "benchmarks/golden/groups.toml", "hybrid", "3%").with(&["--group"]),
    case("cornell-seed", MCGUIRE, "hybrid", "5%").with(&["--seed", "7", "--no-audit"]),
    case("demo", DEMO, "hybrid", "30%").with(&["--no-audit"]),
    case("furnished-cache", "builtin:truth-00", "cache", "10%"),
    case("hall", "builtin:hall", "hybrid", "20%"),
    case("corridor", "builtin:truth-48", "hybrid", "5%"),
    case("furnished", "builtin:truth-00", "hybrid", "5%"),
    case("blocks", "builtin:truth-02", "hybrid", "5%"),
    case("low-pendant", "builtin:truth-08", "hybrid", "5%"),
    case("recessed", "builtin:truth-12", "hybrid", "5%"),
    case("many-lamps", "builtin:truth-16", "hybrid", "5%"),
    case("shades", "builtin:truth-20", "hybrid", "10%"),
    case("uplights", "builtin:truth-22", "hybrid", "5%"),
    case("photometric-files", "builtin:truth-24", "hybrid", "5%"),
    case("luminous-panels", "builtin:truth-26", "hybrid", "5%"),
    case("luminous-globes", "builtin:truth-28", "hybrid", "5%"),
    case("opposite-mirrors", "builtin:truth-30", "hybrid", "2%"),
    case("mirror-radiosity", "builtin:truth-32", "radiosity", "5%"),
    case("panes", "builtin:truth-34", "hybrid", "2%"),
    case("caustics", "builtin:truth-36", "hybrid", "20%"),
    case("white-room", "builtin:truth-38", "hybrid", "5%"),
    case("screens", "builtin:truth-42", "hybrid", "5%"),
    case("nested-rooms", "builtin:truth-46", "hybrid", "5%"),
    case("dim-beside-bright", "builtin:truth-50", "hybrid", "5%"),
    case("slivers", "builtin:truth-52", "hybrid", "5%"),
    case("window", "builtin:truth-58", "hybrid", "5%"),
];
