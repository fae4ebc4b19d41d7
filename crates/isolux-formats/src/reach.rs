//! Which files a file may name, and where they lie.

use std::path::{Component, Path, PathBuf};

/// Which files a file may name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reach {
    /// Those in its folder and below.
    #[default]
    Inside,
    /// Those anywhere on this machine.
    Anywhere,
}

/// How to lift the limit, for messages of whatever is refused by it.
pub(crate) const ALLOW: &str = "give `--allow-outside` if you trust it";

/// The folder of a scene, and how far beyond it its files may lead.
#[derive(Clone, Debug)]
pub(crate) struct Root {
    folder: PathBuf,
    reach: Reach,
}

/// Why a file named in another file is not opened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unreachable {
    /// It would lie outside the directory tree of the file that names it.
    Outside,
    /// There is no such file.
    Missing,
    /// It is a directory.
    Directory,
    /// It lies on another machine.
    Remote,
}

impl Unreachable {
    /// What is wrong, and how to mend it.
    pub(crate) fn explain(self, name: &str) -> (String, String) {
        match self {
            Self::Outside => (
                format!("file `{name}` lies outside the directory of the file that names it"),
                format!(
                    "put it into that directory or below, and name it relative to it; or {ALLOW}"
                ),
            ),
            Self::Missing => {
                (format!("file `{name}` does not exist"), "check the name and its case".into())
            }
            Self::Directory => (format!("`{name}` is a directory"), "name a file in it".into()),
            Self::Remote => (
                format!("file `{name}` lies on another machine, and none is asked"),
                "copy it beside the file that names it".into(),
            ),
        }
    }
}

impl Root {
    /// The folder of a file.
    pub(crate) fn of(file: &Path, reach: Reach) -> Self {
        Self { folder: directory_of(file).to_owned(), reach }
    }

    /// The path of a file named relative to the folder.
    pub(crate) fn file(&self, name: &str) -> Result<PathBuf, Unreachable> {
        self.file_beside(&self.folder, name)
    }

    /// The path of a file named relative to `base`. Unless all may be reached, it may not leave the folder, neither by `..` nor by
    /// a symbolic link. Both separators are understood.
    pub(crate) fn file_beside(&self, base: &Path, name: &str) -> Result<PathBuf, Unreachable> {
        let name = name.replace('\\', "/");
        // Windows asks the machine that such a name begins with.
        if name.starts_with("//") {
            return Err(Unreachable::Remote);
        }
        if self.reach == Reach::Inside && !stays(&name) {
            return Err(Unreachable::Outside);
        }
        let path = base.join(&name);
        let real = path.canonicalize().map_err(|_| Unreachable::Missing)?;
        self.check(&real)?;
        if real.is_dir() { Err(Unreachable::Directory) } else { Ok(path) }
    }

    /// Refuses a path, its links followed, that may not be reached.
    pub(crate) fn check(&self, real: &Path) -> Result<(), Unreachable> {
        if self.reach == Reach::Anywhere {
            return Ok(());
        }
        let home = self.folder.canonicalize().map_err(|_| Unreachable::Missing)?;
        if real.starts_with(home) { Ok(()) } else { Err(Unreachable::Outside) }
    }

    /// The folder.
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// How far beyond it files may lead.
    pub(crate) fn reach(&self) -> Reach {
        self.reach
    }
}

/// Whether a name can only lead out of a folder by `..` and by links.
fn stays(name: &str) -> bool {
    let has_drive = name.as_bytes().get(1) == Some(&b':');
    let is_relative =
        |c: Component| matches!(c, Component::Normal(_) | Component::CurDir | Component::ParentDir);
    !has_drive && Path::new(name).components().all(is_relative)
}

/// The directory of a file.
pub(crate) fn directory_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder `scene` with a file in it, and a file beside it.
    fn made() -> (tempfile::TempDir, PathBuf) {
        let outer = tempfile::tempdir().unwrap();
        let root = outer.path().join("scene");
        std::fs::create_dir_all(root.join("sub")).unwrap();
        std::fs::write(root.join("sub/a.txt"), "a").unwrap();
        std::fs::write(outer.path().join("secret.txt"), "s").unwrap();
        (outer, root)
    }

    #[test]
    fn named_files_stay_in_the_tree() {
        let (outer, folder) = made();
        let root = Root::of(&folder.join("scene.toml"), Reach::Inside);
        let reach = |name: &str| root.file(name);
        assert!(reach("sub/a.txt").is_ok());
        assert!(reach("sub\\a.txt").is_ok());
        assert!(reach("sub/../sub/a.txt").is_ok());
        assert_eq!(reach("../secret.txt"), Err(Unreachable::Outside));
        assert_eq!(reach("/etc/hostname"), Err(Unreachable::Outside));
        assert_eq!(reach("C:\\a.txt"), Err(Unreachable::Outside));
        assert_eq!(reach("\\\\machine\\a.txt"), Err(Unreachable::Remote));
        assert_eq!(reach("sub/b.txt"), Err(Unreachable::Missing));
        assert_eq!(reach("sub"), Err(Unreachable::Directory));
        let sub = folder.join("sub");
        assert_eq!(root.file_beside(&sub, "../../secret.txt"), Err(Unreachable::Outside));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(outer.path().join("secret.txt"), folder.join("l")).unwrap();
            assert_eq!(reach("l"), Err(Unreachable::Outside));
        }
        assert!(Unreachable::Outside.explain("a").1.contains("--allow-outside"));
    }

    #[test]
    fn named_files_lie_anywhere_when_that_is_allowed() {
        let (outer, folder) = made();
        let root = Root::of(&folder.join("scene.toml"), Reach::Anywhere);
        let secret = outer.path().join("secret.txt");
        assert!(root.file("../secret.txt").is_ok());
        assert_eq!(root.file(secret.to_str().unwrap()), Ok(secret));
        assert_eq!(root.file("../none.txt"), Err(Unreachable::Missing));
        assert_eq!(root.file("//machine/a.txt"), Err(Unreachable::Remote));
    }
}
