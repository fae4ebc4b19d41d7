//! From paths of code to the modules they lead to.

use super::code::{line_at, without_tests, words};
use super::methods::{self, Block};
use super::paths::{Path, Use, expressions, uses};
use super::tree::File;
use std::collections::HashMap;

/// The modules of one crate, one a file.
pub(super) struct Modules {
    list: Vec<Module>,
    by_path: HashMap<Vec<String>, usize>,
}

/// One module knows another.
pub(super) struct Edge {
    pub from: usize,
    pub to: usize,
    /// Line in the file of `from`.
    pub line: usize,
}

struct Module {
    file: String,
    path: Vec<String>,
    name: String,
    code: String,
    uses: Vec<Use>,
    blocks: Vec<Block>,
}

/// Longest chain of names passed on from module to module.
const MAX_HOPS: usize = 16;

impl Modules {
    /// Modules of the files of a crate; files compiled only for tests are left out.
    pub(super) fn read<'a>(files: impl Iterator<Item = &'a File>, folder: &str) -> Self {
        let list: Vec<Module> = files
            .filter(|f| !f.path.ends_with("/tests.rs"))
            .map(|f| Module::read(f, &f.path[folder.len()..]))
            .collect();
        let by_path = list.iter().enumerate().map(|(k, m)| (m.path.clone(), k)).collect();
        Self { list, by_path }
    }

    pub(super) fn len(&self) -> usize {
        self.list.len()
    }

    pub(super) fn name(&self, module: usize) -> &str {
        &self.list[module].name
    }

    pub(super) fn file(&self, module: usize) -> String {
        self.list[module].file.clone()
    }

    /// Which module calls methods of which by `self`, where a type has them in several.
    pub(super) fn calls(&self) -> Vec<Edge> {
        let mut homes = HashMap::new();
        for (module, kind, block) in self.blocks() {
            for name in &block.defines {
                homes.insert((kind.clone(), name.clone()), module);
            }
        }
        let edges = self.blocks().flat_map(|(from, kind, block)| {
            let called = block.calls.iter().filter_map(|(name, line)| {
                let to = *homes.get(&(kind.clone(), name.clone()))?;
                (to != from).then_some(Edge { from, to, line: *line })
            });
            called.collect::<Vec<_>>()
        });
        edges.collect()
    }

    /// All blocks of methods: the module, the type by where it is defined and its name, the block.
    fn blocks(&self) -> impl Iterator<Item = (usize, (usize, String), &Block)> {
        self.list.iter().enumerate().flat_map(move |(from, module)| {
            module.blocks.iter().map(move |block| {
                let named = module.uses.iter().flat_map(|u| &u.paths);
                let declared = named.into_iter().find(|p| p.name == block.type_name);
                let home = declared.and_then(|path| self.target(from, path, MAX_HOPS));
                (from, (home.unwrap_or(from), block.type_name.clone()), block)
            })
        })
    }

    /// Which module knows which by paths, itself left out.
    pub(super) fn edges(&self) -> Vec<Edge> {
        (0..self.len()).flat_map(|from| self.edges_from(from)).collect()
    }

    fn edges_from(&self, from: usize) -> Vec<Edge> {
        let module = &self.list[from];
        let declared = module.uses.iter().flat_map(|u| {
            u.paths.iter().filter(|p| !u.is_public || module.works_with(&p.name)).cloned()
        });
        declared
            .chain(expressions(&module.code, &module.uses))
            .filter_map(|path| {
                let to = self.target(from, &path, MAX_HOPS)?;
                (to != from).then(|| Edge { from, to, line: line_at(&module.code, path.at) })
            })
            .collect()
    }

    /// The module that defines what a path names; `None` if that is in another crate.
    fn target(&self, from: usize, path: &Path, hops: usize) -> Option<usize> {
        let (base, rest) = self.anchor(from, path)?;
        // As far as there are modules; what follows is an item of the last of them.
        let mut steps = 0;
        let mut full = base;
        while let Some(next) = rest.get(steps) {
            full.push(next.clone());
            if !self.by_path.contains_key(&full) {
                full.pop();
                break;
            }
            steps += 1;
        }
        let module = *self.by_path.get(&full)?;
        let Some(item) = rest.get(steps).filter(|_| hops > 0 && module != from) else {
            return Some(module);
        };
        match self.list[module].uses.iter().flat_map(|u| &u.paths).find(|p| p.name == *item) {
            Some(passed_on) => self.target(module, passed_on, hops - 1),
            None => Some(module),
        }
    }

    /// Where a path starts, and its remaining segments.
    fn anchor<'p>(&self, from: usize, path: &'p Path) -> Option<(Vec<String>, &'p [String])> {
        let module = &self.list[from];
        let mut here = module.path.clone();
        here.extend(module.inline_modules(path.at));
        let (first, rest) = path.segments.split_first()?;
        match first.as_str() {
            "crate" => Some((Vec::new(), rest)),
            "self" => Some((self.enclosing(here), rest)),
            "super" => {
                let ups = path.segments.iter().take_while(|s| *s == "super").count();
                here.truncate(here.len().checked_sub(ups)?);
                Some((self.enclosing(here), &path.segments[ups..]))
            }
            _ => {
                let child: Vec<String> = module.path.iter().chain([first]).cloned().collect();
                self.by_path.contains_key(&child).then(|| (module.path.clone(), &path.segments[..]))
            }
        }
    }

    /// The module of the file that holds a module.
    fn enclosing(&self, mut path: Vec<String>) -> Vec<String> {
        while !self.by_path.contains_key(&path) && path.pop().is_some() {}
        path
    }
}

impl Module {
    fn read(file: &File, inside: &str) -> Self {
        let stem = inside.trim_end_matches(".rs");
        let stem = stem.strip_suffix("/mod").unwrap_or(stem);
        let path: Vec<String> = match stem {
            "lib" | "main" => Vec::new(),
            _ => stem.split('/').map(str::to_owned).collect(),
        };
        let name = if path.is_empty() { "crate".to_owned() } else { path.join("::") };
        let code = without_tests(&file.code);
        let blocks = methods::blocks(&file.text);
        Self { file: file.path.clone(), path, name, uses: uses(&code), blocks, code }
    }

    /// Whether a name is used, not only passed on: neither in a `use`, nor as the name of a module
    /// or of a method.
    fn works_with(&self, name: &str) -> bool {
        let declared = |at: usize| self.uses.iter().any(|u| u.span.contains(&at));
        let is_other = |at: usize| {
            let before = self.code[..at].trim_end();
            before.ends_with('.') || before.ends_with("mod")
        };
        name != "*" && words(&self.code, name).any(|at| !declared(at) && !is_other(at))
    }

    /// Names of the modules written inside the file around a byte of it.
    fn inline_modules(&self, at: usize) -> Vec<String> {
        let mut names: Vec<(usize, String)> = words(&self.code, "mod")
            .take_while(|&start| start < at)
            .filter_map(|start| {
                let after = self.code[start + 3..].trim_start();
                let name = after.split(|c: char| !(c.is_alphanumeric() || c == '_')).next()?;
                let open = self.code.len() - after[name.len()..].trim_start().len();
                let is_inline = self.code[open..].starts_with('{');
                let holds = is_inline && at < super::code::closing(&self.code, open);
                holds.then(|| (start, name.to_owned()))
            })
            .collect();
        names.sort();
        names.into_iter().map(|(_, name)| name).collect()
    }
}
