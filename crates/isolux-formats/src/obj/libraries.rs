//! Where the material libraries of a file lie.

use super::lines::place;
use super::record::{Named, ObjFile};
use crate::findings::Findings;
use crate::other_case::Listings;
use crate::reach::{Root, Unreachable};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// Where files lie, and under which names.
type Place<'a> = (&'a Root, &'a mut Listings);

/// The paths of all libraries of a file, each once, in the order in which they were last named: what comes later counts. Where one
/// that it names is missing, or it names none, it is that of its own name.
pub(super) fn paths(
    (root, listings): Place<'_>,
    file: &ObjFile,
    findings: &mut Findings,
) -> Vec<PathBuf> {
    let mut paths = Vec::new();
    for library in &file.libraries {
        paths.extend(named((root, listings), library, findings));
    }
    let first_use = file.parts.iter().find_map(|part| part.material.as_ref());
    if let (true, Some(first_use)) = (paths.is_empty(), first_use) {
        paths.extend(of_its_own_name((root, listings), first_use, findings));
    }
    each_once(paths)
}

/// Without those that come again.
fn each_once(mut paths: Vec<PathBuf>) -> Vec<PathBuf> {
    let mut seen = HashSet::new();
    paths.reverse();
    paths.retain(|path| seen.insert(path.clone()));
    paths.reverse();
    paths
}

/// `mtllib` names one file, blanks included, or several separated by blanks.
fn named((root, listings): Place<'_>, library: &Named, findings: &mut Findings) -> Vec<PathBuf> {
    if let Ok(path) = one((root, listings), library, findings) {
        return vec![path];
    }
    let mut paths = Vec::new();
    for name in library.name.split_whitespace() {
        let library = Named { name: name.to_owned(), line: library.line };
        match one((root, listings), &library, findings) {
            Ok(path) => paths.push(path),
            Err(why) => {
                let (what, remedy) = why.explain(name);
                findings.warning(place(library.line), what, remedy);
            }
        }
    }
    paths
}

/// The file of a name; with a warning one whose letters are of another case.
fn one(
    (root, listings): Place<'_>,
    library: &Named,
    findings: &mut Findings,
) -> Result<PathBuf, Unreachable> {
    root.file(&library.name).or_else(|why| {
        let path = listings.find(root, root.folder(), &library.name).ok_or(why)?;
        warn_of_case(library, &path, findings);
        Ok(path)
    })
}

/// A name that differs from that of a file in the case of its letters.
pub(super) fn warn_of_case(named: &Named, path: &Path, findings: &mut Findings) {
    let found = path.file_name().unwrap_or_default().to_string_lossy();
    let what = format!("file `{}` does not exist; `{found}` is read", named.name);
    findings.warning(place(named.line), what, "write its name in the same case");
}

/// The library beside the file that differs from it in its extension alone.
fn of_its_own_name(
    (root, listings): Place<'_>,
    first_use: &Named,
    findings: &mut Findings,
) -> Option<PathBuf> {
    let own = findings.file().with_extension("mtl");
    let name = own.file_name()?.to_string_lossy().into_owned();
    let found = root.file(&name);
    let path = found.ok().or_else(|| listings.find(root, root.folder(), &name))?;
    let found = path.file_name().unwrap_or_default().to_string_lossy();
    let what = format!("no `mtllib` names a file that exists; `{found}` is read");
    findings.warning(place(first_use.line), what, "name the file of the materials by `mtllib`");
    Some(path)
}
