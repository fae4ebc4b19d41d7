//! What is drawn on a sheet: letters, lines, intervals and markers.

use super::ink::{self, INK, Part, RULE};
use super::look::{self, Marker};
use super::sheet::{CAP, FONT, LIBRARY_FONT, MARKER, STROKE, THIN};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Where a graph is drawn.
pub(super) type Sheet<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// The drawing failed, which writing to memory does not.
pub(super) struct Failed;

impl<E: std::error::Error + Send + Sync> From<DrawingAreaErrorKind<E>> for Failed {
    fn from(_: DrawingAreaErrorKind<E>) -> Self {
        Self
    }
}

/// Letters about a place.
pub(super) fn text<'a>(horizontal: HPos, vertical: VPos) -> TextStyle<'a> {
    let size = f64::from(FONT) * LIBRARY_FONT;
    TextStyle::from(("sans-serif", size).into_font())
        .color(&INK)
        .pos(Pos::new(horizontal, vertical))
}

pub(super) fn draw_rule(ends: &[(i32, i32); 2], sheet: &Sheet) -> Result<(), Failed> {
    Ok(sheet.draw(&PathElement::new(ends.to_vec(), RULE.stroke_width(THIN)))?)
}

pub(super) fn stroke_line(places: &[(i32, i32)], look: usize, sheet: &Sheet) -> Result<(), Failed> {
    let style = ink::of(Part::Line, look).stroke_width(STROKE);
    Ok(sheet.draw(&PathElement::new(places.to_vec(), style))?)
}

pub(super) fn draw_interval(
    low: (i32, i32),
    high: (i32, i32),
    look: usize,
    sheet: &Sheet,
) -> Result<(), Failed> {
    let style = ink::of(Part::Outline, look).stroke_width(THIN);
    let cap = |(x, y): (i32, i32)| vec![(x - CAP, y), (x + CAP, y)];
    for path in [vec![low, high], cap(low), cap(high)] {
        sheet.draw(&PathElement::new(path, style))?;
    }
    Ok(())
}

pub(super) fn draw_marker((x, y): (i32, i32), number: usize, sheet: &Sheet) -> Result<(), Failed> {
    let look = look::of(number);
    let (filling, outline) = (
        ink::of(Part::Filling, number).filled(),
        ink::of(Part::Outline, number).stroke_width(STROKE),
    );
    match look.marker {
        Marker::Circle if look.is_filled => sheet.draw(&Circle::new((x, y), MARKER, filling))?,
        Marker::Circle => sheet.draw(&Circle::new((x, y), MARKER, outline))?,
        Marker::Corners(corners) => {
            let corner = |&(dx, dy): &(f64, f64)| {
                let units = |d: f64| (d * f64::from(MARKER)).round() as i32;
                (x + units(dx), y + units(dy))
            };
            let mut path: Vec<(i32, i32)> = corners.iter().map(corner).collect();
            if look.is_filled {
                sheet.draw(&Polygon::new(path, filling))?;
            } else {
                path.extend(path.first().copied());
                sheet.draw(&PathElement::new(path, outline))?;
            }
        }
    }
    Ok(())
}
