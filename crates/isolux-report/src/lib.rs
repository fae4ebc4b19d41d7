//! The lighting report that an engineer hands over: values in, a document out, as HTML or PDF, in English or German. Pictures and
//! plans are handed in. Every figure stands beside its interval of 95 %.

mod contents;
mod document;
mod html;
#[cfg(feature = "pdf")]
mod pdf;
mod report;
mod typst;
mod words;

pub use report::{
    Area, Attachment, Budget, BudgetLine, Daylight, DaylightArea, Emergency, EmergencyCriterion,
    EmergencyRequirement, Finding, Glare, Image, Luminaire, LuminousBody, Maintenance, Observer,
    Project, Report, Requirement, Scene, Severity, Surface, UncertainInput, View,
};
pub use words::Language;

/// One file of HTML that needs nothing beside it; printed, it has pages.
pub fn html(report: &Report, language: Language) -> String {
    html::written(&contents::document(report, language))
}

/// The report in the markup of Typst, and the files that it names.
pub fn typst(report: &Report, language: Language) -> (String, Vec<Attachment>) {
    typst::written(&contents::document(report, language))
}

/// A tagged PDF whose text can be searched (PDF/UA-1).
#[cfg(feature = "pdf")]
pub fn pdf(report: &Report, language: Language) -> Result<Vec<u8>, PdfError> {
    pdf::written(&contents::document(report, language))
}

#[cfg(feature = "pdf")]
pub use pdf::PdfError;
