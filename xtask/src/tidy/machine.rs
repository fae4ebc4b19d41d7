//! No paths of one machine and no hosts of package mirrors.

use super::finding::Finding;
use super::tree::{File, Tree};

/// Folders that mean something on one machine only, without their slashes.
const FOLDERS: [&str; 5] = ["work", "root", "home", "tmp/wt", "Users"];

/// Registries, name and domain apart.
const REGISTRIES: [(&str, &str); 7] = [
    ("index.crates", "io"),
    ("static.crates", "io"),
    ("registry.npmjs", "org"),
    ("registry.yarnpkg", "com"),
    ("files.pythonhosted", "org"),
    ("deb.debian", "org"),
    ("proxy.golang", "org"),
];

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    tree.files.iter().flat_map(check_file).collect()
}

fn check_file(file: &File) -> Vec<Finding> {
    let is_lock = file.path.ends_with("package-lock.json");
    file.text
        .lines()
        .enumerate()
        .filter_map(|(at, line)| {
            let (what, remedy) = problem(line, is_lock)?;
            Some(Finding { file: file.path.clone(), line: at + 1, what, remedy })
        })
        .collect()
}

fn problem(line: &str, is_lock: bool) -> Option<(String, &'static str)> {
    if let Some(folder) = FOLDERS.iter().find(|folder| names_folder(line, folder)) {
        let what = format!("names `/{folder}/`, a folder of one machine");
        return Some((what, "write a path from the root of the repository"));
    }
    let hosts = REGISTRIES.iter().map(|(name, domain)| format!("{name}.{domain}"));
    if let Some(host) = hosts.into_iter().find(|host| line.contains(host)) {
        return Some((format!("names the registry `{host}`"), "name the package only"));
    }
    // npm writes the mirror it happened to use into its lock file.
    (is_lock && line.contains("\"resolved\": \"http")).then(|| {
        let what = "names where a package was downloaded".to_owned();
        (what, "run `npm install --omit-lockfile-registry-resolved`")
    })
}

/// Whether a line holds the absolute path of a folder (`a/work/b` and `host.org/home/` are none).
fn names_folder(line: &str, folder: &str) -> bool {
    let path = format!("/{folder}/");
    line.match_indices(&path).any(|(at, _)| {
        !line[..at].ends_with(|c: char| c.is_alphanumeric() || "._-}/*)>".contains(c))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(path: &str, text: &str) -> usize {
        check(&Tree::of(&[(path, text)])).len()
    }

    #[test]
    fn folders_of_a_machine_are_found() {
        for folder in FOLDERS {
            assert_eq!(found("a.md", &format!("x\nsee /{folder}/a\n")), 1, "{folder}");
            assert_eq!(found("a.md", &format!("see src/{folder}/a")), 0, "{folder}");
            assert_eq!(found("a.md", &format!("https://example.org/{folder}/a")), 0, "{folder}");
        }
    }

    #[test]
    fn registries_are_found() {
        for (name, domain) in REGISTRIES {
            assert_eq!(found("a.yml", &format!("url: https://{name}.{domain}/x")), 1, "{name}");
        }
        let resolved = "\"resolved\": \"https://example.org/a.tgz\"";
        assert_eq!(found("checks/package-lock.json", resolved), 1);
        assert_eq!(found("a.json", resolved), 0);
    }
}
