//! Colours as the library knows them, and the classes of CSS that they become.

use super::look::LOOKS;
use plotters::style::RGBColor;

/// Text and axes.
pub(super) const INK: RGBColor = RGBColor(0, 0, 0);
/// Lines of the grid.
pub(super) const GRID: RGBColor = RGBColor(0, 0, 1);
/// Lines that are no data.
pub(super) const RULE: RGBColor = RGBColor(0, 0, 2);

/// What is drawn in the colour of a line.
#[derive(Clone, Copy)]
pub(super) enum Part {
    Line,
    Outline,
    Filling,
}

/// A colour that stands for a part in the colour of a line.
pub(super) fn of(part: Part, look: usize) -> RGBColor {
    RGBColor(1, part as u8, (look % LOOKS.len()) as u8)
}

/// The drawing with classes instead of those colours, and without what CSS decides.
pub(super) fn classed(svg: &str) -> String {
    let mut svg = svg
        .replace(" opacity=\"1\"", "")
        .replace(" font-family=\"sans-serif\"", "")
        .replace(&stroke(GRID), "class=\"grid\"")
        .replace(&stroke(RULE), "class=\"rule\"")
        .replace(&stroke(INK), "stroke=\"currentColor\"")
        .replace(&fill(INK), "fill=\"currentColor\"");
    for look in 0..LOOKS.len() {
        svg = svg
            .replace(&stroke(of(Part::Line, look)), &format!("class=\"l{look}\""))
            .replace(&stroke(of(Part::Outline, look)), &format!("class=\"m{look}\""))
            .replace(&fill(of(Part::Filling, look)), &format!("class=\"f{look}\""));
    }
    svg
}

fn stroke(colour: RGBColor) -> String {
    format!("stroke=\"{}\"", code(colour))
}

fn fill(colour: RGBColor) -> String {
    format!("fill=\"{}\"", code(colour))
}

fn code(RGBColor(red, green, blue): RGBColor) -> String {
    format!("#{red:02X}{green:02X}{blue:02X}")
}
