//! Inside the engine, rooms know only those before them.

use super::finding::Finding;
use super::modules::Modules;
use super::tree::Tree;

const CORE: &str = "crates/isolux/src/";
const ENGINE: &str = "engine";
/// From the ground up.
const ORDER: [&str; 14] = [
    "ray",
    "mesh",
    "light",
    "occlusion",
    "gather",
    "particle",
    "plan",
    "judge",
    "read",
    "method",
    "combine",
    "audit",
    "pilot",
    "run",
];

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    // Tests may use what comes later.
    let files = tree.rust_under(CORE).filter(|f| !f.path.contains("/tests/"));
    let modules = Modules::read(files, CORE);
    let homeless = (0..modules.len()).filter(|&m| room(modules.name(m)).is_some_and(is_unknown));
    let mut found: Vec<Finding> = homeless
        .map(|m| Finding {
            file: modules.file(m),
            line: 1,
            what: format!("`{}` lies in no room of the engine", modules.name(m)),
            remedy: "put it into a room, or a new room into ORDER of rooms.rs",
        })
        .collect();
    found.extend(modules.edges().iter().filter_map(|edge| {
        let (from, to) = (room(modules.name(edge.from))?, room(modules.name(edge.to))?);
        (place(to)? > place(from)?).then(|| Finding {
            file: modules.file(edge.from),
            line: edge.line,
            what: format!("room `{from}` must not know `{to}`, which comes after it"),
            remedy: "move what both need into the earlier room",
        })
    }));
    found
}

/// The room of a module; none of the engine's front, its tests, and all that lies elsewhere.
fn room(module: &str) -> Option<&str> {
    let mut parts = module.split("::");
    let is_inside = parts.next() == Some(ENGINE);
    parts.next().filter(|&room| is_inside && room != "tests")
}

fn place(room: &str) -> Option<usize> {
    ORDER.iter().position(|r| *r == room)
}

fn is_unknown(room: &str) -> bool {
    place(room).is_none()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(path: &str, text: &str) -> Vec<String> {
        let front = "mod judge; mod ray; pub use judge::Check;";
        let files = [
            ("crates/isolux/src/lib.rs", "pub mod engine;"),
            ("crates/isolux/src/engine/mod.rs", front),
            ("crates/isolux/src/engine/judge/mod.rs", "pub struct Check;"),
            (path, text),
        ];
        check(&Tree::of(&files)).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_room_knows_those_before_it() {
        let path = "crates/isolux/src/engine/run/mod.rs";
        assert!(found(path, "use super::judge::Check;").is_empty());
        for text in ["use crate::engine::judge::Check;", "fn f() { super::super::judge::g() }"] {
            let found = found("crates/isolux/src/engine/ray/path.rs", text);
            assert_eq!(found.len(), 1, "{text}: {found:?}");
            assert!(found[0].contains("room `ray` must not know `judge`"), "{found:?}");
        }
    }

    #[test]
    fn the_front_of_the_engine_hides_no_room() {
        let found = found("crates/isolux/src/engine/ray/path.rs", "use crate::engine::Check;");
        assert_eq!(found.len(), 1, "{found:?}");
    }

    #[test]
    fn a_file_without_a_room_is_found() {
        let found = found("crates/isolux/src/engine/extra.rs", "");
        assert_eq!(found.len(), 1, "{found:?}");
    }
}
