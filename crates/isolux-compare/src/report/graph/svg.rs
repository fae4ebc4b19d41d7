//! Drawings as elements of a page, and as files of their own.

use super::draw::draw;
use super::look;
use super::plan::Graph;
use super::sheet::{UNITS, WIDTH};
use isolux::units::escape_markup as escape;

/// Rules of CSS that all drawings share.
const SHARED: &str = include_str!("graph.css");

/// The element of a page; `None` of a graph without points.
pub(crate) fn element(graph: &Graph) -> Option<String> {
    written(graph, "")
}

/// A file of its own, which needs no page; `None` of a graph without points.
pub(crate) fn file(graph: &Graph) -> Option<String> {
    written(graph, &format!("<style>{}</style>\n", css()))
}

/// Rules of CSS for pages that hold drawings.
pub(crate) fn css() -> String {
    format!("{SHARED}{}", look::css())
}

fn written(graph: &Graph, style: &str) -> Option<String> {
    let (drawing, height) = draw(graph)?;
    let [id, title, description] = [&graph.id, &graph.title, &graph.description].map(|t| escape(t));
    Some(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"graph\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{}\" height=\"{}\" role=\"img\" \
         aria-labelledby=\"{id}-title {id}-description\">\n<title id=\"{id}-title\">{title}</title>\n\
         <desc id=\"{id}-description\">{description}</desc>\n{style}{drawing}</svg>",
        WIDTH / UNITS,
        height / UNITS,
    ))
}
