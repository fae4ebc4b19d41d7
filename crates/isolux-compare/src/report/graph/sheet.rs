//! Sizes on the sheet of a graph, in tenths of pixels as its drawing is 440 wide: the library places in whole numbers.

/// Units in a pixel.
pub(super) const UNITS: i32 = 10;
/// Width of the sheet.
pub(super) const WIDTH: i32 = 4400;
/// Height of the axes and what lies between them, without legend.
pub(super) const HEIGHT: i32 = 2960;
/// Free at all sides.
pub(super) const MARGIN: i32 = 60;

/// Height of letters.
pub(super) const FONT: i32 = 130;
/// Width of letters and digits on the mean, of their height: not less than in common faces, so that nothing is cut off.
const LETTER: f64 = 0.6;
/// What the library divides the size of letters by.
pub(super) const LIBRARY_FONT: f64 = 1.24;

/// Above the axes, where the title of y stands.
pub(super) const TOP: i32 = 260;
/// Beneath the axis of x: marks and its title.
pub(super) const BOTTOM: i32 = 480;
/// From the axis to the title of x.
pub(super) const TO_TITLE: i32 = 285;
/// From marks to their labels, and what sticks out.
pub(super) const MARK: i32 = 50;

/// Legend: height of a row, length of a swatch, and what is free behind it and between entries.
pub(super) const ROW: i32 = 200;
pub(super) const SWATCH: i32 = 340;
pub(super) const SWATCH_GAP: i32 = 70;
pub(super) const ENTRY_GAP: i32 = 200;

/// Width of lines, of axes and of intervals.
pub(super) const STROKE: u32 = 20;
pub(super) const THIN: u32 = 10;
/// Half the size of markers, and half the width of the ends of intervals.
pub(super) const MARKER: i32 = 38;
pub(super) const CAP: i32 = 30;

/// The width of a text, estimated.
pub(super) fn text_width(text: &str, font: i32) -> i32 {
    (LETTER * f64::from(font) * text.chars().count() as f64).ceil() as i32
}
