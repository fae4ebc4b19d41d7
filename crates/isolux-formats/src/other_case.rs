//! Files whose names differ from those asked for in the case of their letters, as they may on a disk of Windows.

use crate::reach::Root;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// What folders hold, each read once: a file can ask for a hundred thousand names.
#[derive(Default)]
pub(crate) struct Listings(HashMap<PathBuf, Names>);

/// Names of files by the same in small letters; of several that are alike the first.
type Names = HashMap<String, String>;

impl Listings {
    /// A file named relative to `base` that is there under a name in other letters.
    pub(crate) fn find(&mut self, root: &Root, base: &Path, name: &str) -> Option<PathBuf> {
        let name = name.replace('\\', "/");
        let relative = Path::new(&name);
        let wanted = relative.file_name()?.to_str()?.to_ascii_lowercase();
        let folder = relative.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = base.join(folder.unwrap_or(Path::new(".")));
        let names = self.0.entry(folder).or_insert_with_key(|folder| names(folder));
        let found = relative.with_file_name(names.get(&wanted)?);
        root.file_beside(base, found.to_str()?).ok()
    }
}

fn names(folder: &Path) -> Names {
    let mut names = Names::new();
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    for own in entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()) {
        let first = names.entry(own.to_ascii_lowercase()).or_insert_with(|| own.clone());
        if own < *first {
            *first = own;
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Reach;

    #[test]
    fn names_in_other_letters_are_found_where_files_may_lie() {
        let outer = tempfile::tempdir().unwrap();
        let folder = outer.path().join("scene");
        std::fs::create_dir_all(folder.join("sub")).unwrap();
        for file in ["scene/sub/a.txt", "scene/b.txt", "scene/B.txt", "secret.txt"] {
            std::fs::write(outer.path().join(file), "").unwrap();
        }
        let find = |reach, name: &str| {
            let root = Root::of(&folder.join("scene.obj"), reach);
            Listings::default().find(&root, &folder, name)
        };
        assert_eq!(find(Reach::Inside, "sub\\A.TXT"), Some(folder.join("sub/a.txt")));
        assert_eq!(find(Reach::Inside, "b.TXT"), Some(folder.join("B.txt")));
        assert_eq!(find(Reach::Inside, "none.txt"), None);
        assert_eq!(find(Reach::Inside, "../SECRET.txt"), None);
        assert!(find(Reach::Anywhere, "../SECRET.txt").is_some());
    }
}
