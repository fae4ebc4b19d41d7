//! Collections of luminaires that scenes refer to by name.

use super::chromaticity;
use super::context::Context;
use super::parse::{LibraryEntries, parse_library};
use super::photometry::{self, Emission, Files};
use super::record::LibraryRecord;
use super::spans::At;
use super::text;
use isolux::units::Rgb;
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// A luminaire of a library.
#[derive(Clone, Debug)]
pub(super) struct LibraryLight {
    pub(super) emission: Emission,
    pub(super) colour: Option<Rgb>,
    pub(super) maintenance_factor: Option<f64>,
}

/// All libraries that a scene names.
#[derive(Default)]
pub(super) struct Libraries(Vec<Library>);

/// One file. Photometric files are read when a luminaire is asked for.
struct Library {
    context: Context,
    entries: LibraryEntries,
    known: HashMap<String, Option<LibraryLight>>,
    files: Files,
}

impl Libraries {
    /// Reads them; what is wrong with a name of a file goes to the scene's findings.
    pub(super) fn read(names: &[At<String>], context: &mut Context) -> Self {
        let mut taken = HashSet::new();
        let mut libraries = Vec::new();
        for name in names {
            let Some(path) = context.path_of(&name.span(), name.get_ref()) else { continue };
            match Library::read(&path) {
                Ok(library) => libraries.push(library),
                Err(problem) => {
                    let what = format!("library {}: {}", name.get_ref(), problem.what);
                    context.problem(&name.span(), what, problem.remedy);
                }
            }
        }
        for library in &mut libraries {
            library.refuse_taken(&mut taken);
        }
        Self(libraries)
    }

    /// A luminaire by its name; `None` after a problem.
    pub(super) fn find(
        &mut self,
        name: &At<String>,
        context: &mut Context,
    ) -> Option<LibraryLight> {
        let found = self.0.iter_mut().find(|library| library.has(name.get_ref()));
        if let Some(library) = found {
            return library.light(name.get_ref());
        }
        let names = self.0.iter().flat_map(|library| &library.entries);
        let mut names: Vec<&str> = names.map(|(name, _)| name.get_ref().as_str()).collect();
        names.truncate(20);
        let remedy = match names[..] {
            [] => "name a file with `[luminaires.NAME]` in `libraries`".to_owned(),
            _ => format!("the libraries have `{}`", names.join("`, `")),
        };
        context.problem(&name.span(), format!("no luminaire `{}`", name.get_ref()), remedy);
        None
    }

    /// Passes on what was found in them.
    pub(super) fn finish(self, context: &mut Context) {
        for library in self.0 {
            context.findings.absorb(library.context.finish(()));
        }
    }
}

impl Library {
    fn read(path: &Path) -> Result<Self, crate::Problem> {
        let text = text::of(path)?;
        let mut context = Context::new(path, &text);
        let entries = parse_library(&text, &mut context);
        Ok(Self { context, entries, known: HashMap::new(), files: Files::default() })
    }

    fn has(&self, name: &str) -> bool {
        self.entries.iter().any(|(known, _)| known.get_ref() == name)
    }

    /// Names that another library has already.
    fn refuse_taken(&mut self, taken: &mut HashSet<String>) {
        for (name, _) in &self.entries {
            if !taken.insert(name.get_ref().clone()) {
                let what = format!("another library has a luminaire `{}`, too", name.get_ref());
                self.context.problem(&name.span(), what, "rename one of them");
            }
        }
    }

    fn light(&mut self, name: &str) -> Option<LibraryLight> {
        if let Some(known) = self.known.get(name) {
            return known.clone();
        }
        let (_, record) = self.entries.iter().find(|(known, _)| known.get_ref() == name)?;
        let light = record
            .as_ref()
            .and_then(|record| resolve(name, record, &mut self.files, &mut self.context));
        self.known.insert(name.to_owned(), light.clone());
        light
    }
}

fn resolve(
    name: &str,
    entry: &At<LibraryRecord>,
    files: &mut Files,
    context: &mut Context,
) -> Option<LibraryLight> {
    let record = entry.get_ref();
    let choices = [
        ("isotropic", record.isotropic.is_some()),
        ("cosine", record.cosine.is_some()),
        ("spot", record.spot.is_some()),
        ("ies", record.ies.is_some()),
        ("ldt", record.ldt.is_some()),
    ];
    context.one_of(&entry.span(), &format!("luminaire `{name}`"), &choices)?;
    let light = record.light();
    let colour = chromaticity::given(&light, context);
    let emission = photometry::emission(&light, files, context)?;
    let power_w = record.power_w.map(|power| power.0).or(emission.power_w);
    Some(LibraryLight {
        emission: Emission { power_w, ..emission },
        colour: colour?,
        maintenance_factor: record.maintenance_factor.map(|m| m.0),
    })
}
