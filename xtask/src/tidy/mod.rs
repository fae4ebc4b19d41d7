//! What the compiler does not check: who knows whom, how large, where, and how safe.

mod code;
mod cycles;
mod drawers;
mod finding;
mod layers;
mod lints;
mod machine;
mod methods;
mod module_order;
mod modules;
mod paths;
mod rooms;
mod root;
mod safety;
mod sizes;
mod tree;

use finding::Finding;
use std::path::Path;
use tree::Tree;

/// One check: all it finds in the files of the repository.
type Check = fn(&Tree) -> Vec<Finding>;

const CHECKS: [(&str, Check); 10] = [
    ("layers", layers::check),
    ("module order", module_order::check),
    ("rooms of the engine", rooms::check),
    ("module cycles", cycles::check),
    ("lints", lints::check),
    ("machine paths", machine::check),
    ("sizes", sizes::check),
    ("drawers", drawers::check),
    ("root", root::check),
    ("unsafe", safety::check),
];

/// Runs every check; the error is the list of findings.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    let tree = Tree::read(root)?;
    let findings: Vec<String> =
        CHECKS.iter().flat_map(|(_, check)| check(&tree)).map(|f| f.to_string()).collect();
    if findings.is_empty() {
        let names: Vec<&str> = CHECKS.iter().map(|(name, _)| *name).collect();
        return Ok(format!("tidy: {} files, {} fine", tree.files.len(), names.join(", ")));
    }
    Err(format!("{}\ntidy: {} to mend", findings.join("\n"), findings.len()))
}
