//! No cycles between the modules of a crate.
//!
//! A module knows another if a path in its code leads there. Names that a module only passes on
//! (`pub use child::Name`) lead to where they are defined, so a `mod.rs` may be the front of its
//! children while they use what it defines itself.

mod graph;

use super::finding::Finding;
use super::modules::{Edge, Modules};
use super::tree::Tree;
use graph::cycle_of_each_knot;

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    let folders = tree.crates().into_iter().map(|name| format!("crates/{name}/src/"));
    folders.chain(["xtask/src/".to_owned()]).flat_map(|folder| check_crate(tree, &folder)).collect()
}

fn check_crate(tree: &Tree, folder: &str) -> Vec<Finding> {
    let modules = Modules::read(tree.rust_under(folder), folder);
    let edges: Vec<Edge> = modules.edges().into_iter().chain(modules.calls()).collect();
    let pairs: Vec<(usize, usize)> = edges.iter().map(|e| (e.from, e.to)).collect();
    let finding = |cycle: Vec<usize>| {
        let names: Vec<&str> =
            cycle.iter().chain(cycle.first()).map(|&m| modules.name(m)).collect();
        let first =
            edges.iter().find(|e| Some((&e.from, &e.to)) == cycle.first().zip(cycle.get(1)));
        let (file, line) = first.map_or((folder.to_owned(), 1), |e| (modules.file(e.from), e.line));
        let what = format!("modules know each other: {}", names.join(" -> "));
        Finding { file, line, what, remedy: "move what both need into a module that knows neither" }
    };
    cycle_of_each_knot(modules.len(), &pairs).into_iter().map(finding).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(files: &[(&str, &str)]) -> Vec<String> {
        let manifest = ("crates/a/Cargo.toml", "");
        let files: Vec<_> = files.iter().copied().chain([manifest]).collect();
        check(&Tree::of(&files)).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn siblings_that_know_each_other_are_found() {
        let found = found(&[
            ("crates/a/src/lib.rs", "mod b; mod c;"),
            ("crates/a/src/b.rs", "\nuse crate::c::C;"),
            ("crates/a/src/c.rs", "fn f() { crate::b::g() }"),
        ]);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].starts_with("crates/a/src/b.rs:2: modules know each other: b -> c -> b"));
    }

    #[test]
    fn a_front_is_no_cycle() {
        let files = [
            ("crates/a/src/lib.rs", "pub mod m;"),
            ("crates/a/src/m/mod.rs", "mod x; mod y; pub use x::X; pub use y::Y; pub struct M;"),
            ("crates/a/src/m/x.rs", "use super::{M, Y};"),
            ("crates/a/src/m/y.rs", "use super::M; mod inner { use super::M; }"),
        ];
        assert_eq!(found(&files), Vec::<String>::new());
    }

    #[test]
    fn a_front_may_pass_on_a_function_named_as_its_module() {
        let front = "mod read; pub use read::read; pub struct M; impl M { fn f() { a.read() } }";
        let files = [("crates/a/src/m/mod.rs", front), ("crates/a/src/m/read.rs", "use super::M;")];
        assert_eq!(found(&files), Vec::<String>::new());
    }

    #[test]
    fn a_cycle_through_a_front_is_found() {
        let found = found(&[
            ("crates/a/src/m/mod.rs", "mod x; mod y; pub use x::X; pub use y::Y;"),
            ("crates/a/src/m/x.rs", "use super::Y;"),
            ("crates/a/src/m/y.rs", "use crate::m::X;"),
        ]);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].contains("m::x -> m::y -> m::x"), "{found:?}");
    }

    #[test]
    fn a_front_that_works_with_children_that_know_it_is_found() {
        for body in ["fn f() { x::g() }", "use x::g;", "pub use x::G; fn f() -> G {}"] {
            let front = format!("mod x; pub struct M; {body}");
            let found = found(&[
                ("crates/a/src/m/mod.rs", &front),
                ("crates/a/src/m/x.rs", "use super::M;"),
            ]);
            assert_eq!(found.len(), 1, "{body}: {found:?}");
        }
    }

    #[test]
    fn tests_may_know_anything() {
        let files = [
            ("crates/a/src/b.rs", "use crate::c::C;"),
            ("crates/a/src/c.rs", "#[cfg(test)] mod tests { use crate::b::B; }"),
        ];
        assert_eq!(found(&files), Vec::<String>::new());
    }
}
