//! A report as PDF, by Typst.

use crate::document::Document;
use crate::typst as markup;
use std::collections::HashMap;
use typst::diag::{FileError, FileResult, SourceDiagnostic};
use typst::foundations::{Bytes, Datetime, Duration};
use typst::syntax::{FileId, RootedPath, Source, VirtualPath, VirtualRoot};
use typst::text::{Font, FontBook};
use typst::utils::LazyHash;
use typst::{Library, LibraryExt, World};
use typst_layout::PagedDocument;
use typst_pdf::{PdfOptions, PdfStandard, PdfStandards};

/// Source Sans 3 (Adobe, SIL Open Font License 1.1).
const FONTS: [&[u8]; 2] = [
    include_bytes!("../fonts/SourceSans3-Regular.ttf"),
    include_bytes!("../fonts/SourceSans3-SemiBold.ttf"),
];

/// Why there is no PDF.
#[derive(Debug, thiserror::Error)]
#[error("the report cannot be set as PDF: {0}; write .html and print that")]
pub struct PdfError(String);

/// The whole report.
pub(crate) fn written(document: &Document) -> Result<Vec<u8>, PdfError> {
    let (source, files) = markup::written(document);
    let files = files.into_iter().map(|file| (file.name, Bytes::new(file.bytes)));
    let desk = Desk::of(source, files.collect());
    let set = typst::compile::<PagedDocument>(&desk).output.map_err(|all| first(&all))?;
    let standards =
        PdfStandards::new(&[PdfStandard::Ua_1]).map_err(|e| PdfError(e.message().to_string()))?;
    let options = PdfOptions { standards, ..PdfOptions::default() };
    typst_pdf::pdf(&set, &options).map_err(|all| first(&all))
}

fn first(all: &[SourceDiagnostic]) -> PdfError {
    PdfError(all.first().map_or(String::new(), |one| one.message.to_string()))
}

/// What Typst works with: one source, its files, two fonts, and nothing of the machine.
struct Desk {
    library: LazyHash<Library>,
    book: LazyHash<FontBook>,
    fonts: Vec<Font>,
    main: Source,
    files: HashMap<FileId, Bytes>,
}

impl Desk {
    fn of(source: String, files: HashMap<String, Bytes>) -> Self {
        let fonts: Vec<Font> = FONTS.iter().flat_map(|of| Font::iter(Bytes::new(*of))).collect();
        let id = |name: &str| {
            let path = VirtualPath::new(name).expect("names of files are plain");
            FileId::new(RootedPath::new(VirtualRoot::Project, path))
        };
        Self {
            library: LazyHash::new(Library::default()),
            book: LazyHash::new(FontBook::from_fonts(&fonts)),
            fonts,
            main: Source::new(id("report.typ"), source),
            files: files.into_iter().map(|(name, bytes)| (id(&name), bytes)).collect(),
        }
    }
}

impl World for Desk {
    fn library(&self) -> &LazyHash<Library> {
        &self.library
    }

    fn book(&self) -> &LazyHash<FontBook> {
        &self.book
    }

    fn main(&self) -> FileId {
        self.main.id()
    }

    fn source(&self, id: FileId) -> FileResult<Source> {
        match id == self.main.id() {
            true => Ok(self.main.clone()),
            false => Err(FileError::NotSource),
        }
    }

    fn file(&self, id: FileId) -> FileResult<Bytes> {
        self.files.get(&id).cloned().ok_or(FileError::AccessDenied)
    }

    fn font(&self, index: usize) -> Option<Font> {
        self.fonts.get(index).cloned()
    }

    fn today(&self, _offset: Option<Duration>) -> Option<Datetime> {
        None
    }
}
