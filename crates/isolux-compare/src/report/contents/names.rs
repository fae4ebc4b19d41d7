//! What scenes are called.

use crate::study::CaseStudy;

/// How a scene is called in sentences.
pub(super) fn name(case: &CaseStudy) -> String {
    match case.name.as_str() {
        "cube" => "CUBE".to_owned(),
        "sphere" => "SPHERE".to_owned(),
        "hall" => "HALL".to_owned(),
        "demo" => "the demo scene".to_owned(),
        other => other.to_owned(),
    }
}

/// Its heading.
pub(super) fn title(case: &CaseStudy) -> String {
    match case.name.as_str() {
        "cube" => "CUBE: light between diffuse walls".to_owned(),
        "sphere" => "SPHERE: light from diffuse walls over mirrors to diffuse walls".to_owned(),
        "hall" => "HALL: the practical scene".to_owned(),
        "demo" => "The demo scene".to_owned(),
        other => format!("Scene {other}"),
    }
}

/// The name of a case as a part of names of files and of links.
pub(super) fn id(case: &CaseStudy) -> String {
    let kept = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    let id: String = case.name.chars().map(kept).collect();
    format!("case-{}", id.trim_matches('-'))
}
