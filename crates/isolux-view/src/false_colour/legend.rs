//! The legend: title, colour bar, numbers.

use super::colour_map::{ColourMap, STEPS};
use super::field::{Marks, Quantity};
use super::scale::{Axis, Overflow};
use crate::error::ViewError;
use crate::image::Size;
use crate::picture::{Picture, UNKNOWN};
use crate::text::{Font, wrapped};

/// Letters across the legend, without its margins: "Illuminance, lx" and a blank.
const LETTERS: i64 = 16;
/// Lines of title at most.
const TITLE_LINES: usize = 4;
const PAPER: [u8; 3] = [250; 3];
const INK: [u8; 3] = [20; 3];

/// What a legend says.
pub(super) struct Legend<'a> {
    pub(super) title: &'a str,
    pub(super) quantity: Quantity,
    pub(super) colours: ColourMap,
    pub(super) axis: &'a Axis,
    pub(super) marks: Marks,
}

/// Width of a legend beside a view of some height, pixels.
pub(super) fn width(height: u32) -> u32 {
    let font = Font::for_picture(height);
    (LETTERS * font.width("0") + 2 * margin(font)) as u32
}

fn margin(font: Font) -> i64 {
    font.height() * 3 / 4
}

/// The colour bar, pixels.
#[derive(Clone, Copy)]
struct Bar {
    left: i64,
    top: i64,
    width: i64,
    height: i64,
}

impl Legend<'_> {
    /// A picture as high as the view.
    pub(super) fn draw(&self, height: u32, overflow: Overflow) -> Result<Picture, ViewError> {
        let font = Font::for_picture(height);
        let mut strip = Picture::filled(Size::new(width(height), height)?, PAPER);
        let below_heading = self.draw_heading(&mut strip, font);
        let above_marks = self.draw_marks(&mut strip, font);
        // Half a line for the outermost numbers, and the tips of the bar.
        let tip = font.height() * 3 / 4;
        let top = below_heading + tip;
        let bar = Bar {
            left: margin(font),
            top,
            width: font.height() * 3 / 2,
            height: (above_marks - tip - top).max(1),
        };
        self.draw_bar(&mut strip, bar);
        self.draw_tips(&mut strip, bar, tip, overflow);
        self.draw_numbers(&mut strip, bar, font);
        Ok(strip)
    }

    /// Returns the first row below.
    fn draw_heading(&self, strip: &mut Picture, font: Font) -> i64 {
        let mut y = margin(font);
        let mut lines = wrapped(self.title, LETTERS as usize, TITLE_LINES);
        if !lines.is_empty() {
            lines.push(String::new());
        }
        lines.push(self.quantity.heading().to_owned());
        for line in lines {
            font.write(strip, (margin(font), y), &line, INK);
            y += if line.is_empty() { font.height() / 2 } else { font.height() };
        }
        y + font.height() / 2
    }

    /// Returns the first row above which nothing is drawn yet.
    fn draw_marks(&self, strip: &mut Picture, font: Font) -> i64 {
        let mut y = i64::from(strip.height) - margin(font) / 2;
        let marks = [
            (self.marks.unknown, UNKNOWN, "no value"),
            (self.marks.emitters, [255; 3], "luminaire"),
        ];
        for (_, colour, text) in marks.iter().filter(|(shown, ..)| *shown) {
            y -= font.height() * 5 / 4;
            let (left, side) = (margin(font), font.height());
            strip.fill(left - 1, y - 1, side + 2, side + 2, INK);
            strip.fill(left, y, side, side, *colour);
            font.write(strip, (left + side + font.width(" "), y), text, INK);
        }
        y - font.height() / 2
    }

    fn draw_bar(&self, strip: &mut Picture, bar: Bar) {
        let table = self.colours.table();
        strip.fill(bar.left - 1, bar.top - 1, bar.width + 2, bar.height + 2, INK);
        for row in 0..bar.height {
            let step = (bar.height - 1 - row) * STEPS as i64 / bar.height;
            strip.fill(bar.left, bar.top + row, bar.width, 1, table[step as usize]);
        }
    }

    /// Triangles in the outermost colours where values lie beyond the limits.
    fn draw_tips(&self, strip: &mut Picture, bar: Bar, tip: i64, overflow: Overflow) {
        let table = self.colours.table();
        let height = tip - 2;
        for row in 0..height {
            let inset = row * bar.width / (2 * height);
            let (left, width) = (bar.left + inset, bar.width - 2 * inset);
            let rows = [
                (overflow.above, bar.top - 2 - row, table[STEPS - 1]),
                (overflow.below, bar.top + bar.height + 1 + row, table[0]),
            ];
            for (_, y, colour) in rows.into_iter().filter(|(shown, ..)| *shown) {
                strip.fill(left - 1, y, width + 2, 1, INK);
                strip.fill(left, y, width, 1, colour);
            }
        }
    }

    /// Numbers from the bottom up, as many as have room.
    fn draw_numbers(&self, strip: &mut Picture, bar: Bar, font: Font) {
        let right = bar.left + bar.width + 1;
        let mut free_below = i64::MAX;
        for tick in self.axis.ticks() {
            let share = self.axis.position(tick);
            let y = bar.top + ((1.0 - share) * (bar.height - 1) as f64).round() as i64;
            let fits = y.saturating_add(font.height()) <= free_below;
            if fits {
                strip.fill(right, y, font.height() / 3, 1, INK);
                let place = (right + font.height() / 2, y - font.height() / 2);
                font.write(strip, place, &number(tick), INK);
                free_below = y;
            }
        }
    }
}

/// A value with at most four significant digits, thousands set apart by a blank (ISO 80000-1, 7.3.1).
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e7).contains(&size) {
        return format!("{value:e}");
    }
    let digits = if size > 0.0 { libm::log10(size).floor() as i32 } else { 0 };
    let decimals = (3 - digits).clamp(0, 6) as usize;
    let plain = format!("{value:.decimals$}");
    let plain = match plain.contains('.') {
        true => plain.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => plain,
    };
    match plain.len() {
        // Four digits stay together.
        length if length > 4 && !plain.contains('.') => {
            format!("{} {}", number_head(&plain[..length - 3]), &plain[length - 3..])
        }
        _ => plain,
    }
}

/// The digits above the last three, set apart likewise.
fn number_head(digits: &str) -> String {
    match digits.len() {
        length if length > 3 => format!("{} {}", &digits[..length - 3], &digits[length - 3..]),
        _ => digits.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::false_colour::Scale;

    #[test]
    fn numbers_are_short() {
        for (value, expected) in [
            (0.0, "0"),
            (0.05, "0.05"),
            (0.30000000000000004, "0.3"),
            (2.5, "2.5"),
            (150.0, "150"),
            (1000.0, "1000"),
            (12500.0, "12 500"),
            (2_000_000.0, "2 000 000"),
            (1e9, "1e9"),
            (1e-4, "1e-4"),
            (-20.0, "-20"),
        ] {
            assert_eq!(number(value), expected);
        }
    }

    #[test]
    fn the_bar_runs_through_all_colours_upwards() {
        let axis = Axis::new(Scale::Linear, Some((0.0, 500.0)), &[]).unwrap();
        let legend = Legend {
            title: "Office",
            quantity: Quantity::Illuminance,
            colours: ColourMap::Viridis,
            axis: &axis,
            marks: Marks { unknown: true, emitters: true },
        };
        let strip = legend.draw(900, Overflow { below: false, above: true }).unwrap();
        assert_eq!((strip.width, strip.height), (width(900), 900));
        let x = width(900) / 8;
        let mut column: Vec<[u8; 3]> = (0..900).filter_map(|y| strip.pixel(x, y)).collect();
        column.retain(|c| ColourMap::Viridis.table().contains(c));
        column.reverse();
        column.dedup();
        // Some neighbours of the map and of the rows are the same colour.
        let mut expected = ColourMap::Viridis.table().to_vec();
        expected.dedup();
        assert_eq!(column, expected);
    }

    #[test]
    fn a_strip_too_low_for_a_legend_is_still_a_strip() {
        let axis = Axis::new(Scale::Logarithmic, Some((1.0, 1e5)), &[]).unwrap();
        let legend = Legend {
            title: "a title of many words that needs more than one line",
            quantity: Quantity::Luminance,
            colours: ColourMap::Turbo,
            axis: &axis,
            marks: Marks { unknown: true, emitters: true },
        };
        for height in [1, 2, 17, 60] {
            let strip = legend.draw(height, Overflow { below: true, above: true }).unwrap();
            assert_eq!((strip.width, strip.height), (width(height), height));
        }
    }
}
