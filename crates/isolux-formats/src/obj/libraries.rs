//! Where the material libraries of a file lie.

use super::lines::place;
use super::record::{Named, ObjFile};
use crate::findings::Findings;
use crate::reach::{Root, Unreachable};
use std::path::{Path, PathBuf};

/// The paths of all libraries of a file; where one that it names is missing, or it names none, that of its own name.
pub(super) fn paths(root: &Root, file: &ObjFile, findings: &mut Findings) -> Vec<PathBuf> {
    let mut paths = Vec::new();
    for library in &file.libraries {
        paths.extend(named(root, library, findings));
    }
    let first_use = file.parts.iter().find_map(|part| part.material.as_ref());
    if let (true, Some(first_use)) = (paths.is_empty(), first_use) {
        paths.extend(of_its_own_name(root, first_use, findings));
    }
    paths
}

/// `mtllib` names one file, blanks included, or several separated by blanks.
fn named(root: &Root, library: &Named, findings: &mut Findings) -> Vec<PathBuf> {
    if let Ok(path) = root.file(&library.name) {
        return vec![path];
    }
    if let Some(path) = root.in_other_case(&library.name) {
        warn_of_case(library, &path, findings);
        return vec![path];
    }
    let mut paths = Vec::new();
    for name in library.name.split_whitespace() {
        match root.file(name) {
            Ok(path) => paths.push(path),
            Err(Unreachable::Missing) if root.in_other_case(name).is_some() => {
                let path = root.in_other_case(name);
                let library = Named { name: name.to_owned(), line: library.line };
                path.iter().for_each(|path| warn_of_case(&library, path, findings));
                paths.extend(path);
            }
            Err(why) => {
                let (what, remedy) = why.explain(name);
                findings.warning(place(library.line), what, remedy);
            }
        }
    }
    paths
}

/// A name that differs from that of a file in the case of its letters.
pub(super) fn warn_of_case(named: &Named, path: &Path, findings: &mut Findings) {
    let found = path.file_name().unwrap_or_default().to_string_lossy();
    let what = format!("file `{}` does not exist; `{found}` is read", named.name);
    findings.warning(place(named.line), what, "write its name in the same case");
}

/// The library beside the file that differs from it in its extension alone.
fn of_its_own_name(root: &Root, first_use: &Named, findings: &mut Findings) -> Option<PathBuf> {
    let own = findings.file().with_extension("mtl");
    let name = own.file_name()?.to_string_lossy().into_owned();
    let found = root.file(&name);
    let path = found.ok().or_else(|| root.in_other_case(&name))?;
    let found = path.file_name().unwrap_or_default().to_string_lossy();
    let what = format!("no `mtllib` names a file that exists; `{found}` is read");
    findings.warning(place(first_use.line), what, "name the file of the materials by `mtllib`");
    Some(path)
}
