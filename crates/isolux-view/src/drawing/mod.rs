//! Drawings: a sheet of lines, areas and lettering, which becomes pixels or SVG.

mod mark;
mod raster;
mod svg;

pub(crate) use mark::{Anchor, At, Ink, Lettering, Letters, Line, Mark, Pixels, extent};

use crate::error::ViewError;
use crate::image::Size;
use crate::picture::Picture;

/// Colour of the sheet.
pub(crate) const PAPER: Ink = [255; 3];

/// A sheet with what is drawn on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    size: Size,
    marks: Vec<Mark>,
}

impl Drawing {
    /// An empty sheet, pixels.
    pub(crate) fn new(width: u32, height: u32) -> Result<Self, ViewError> {
        Ok(Self { size: Size::new(width, height)?, marks: Vec::new() })
    }

    pub(crate) fn add(&mut self, mark: Mark) {
        self.marks.push(mark);
    }

    pub(crate) fn line(&mut self, line: Line) {
        self.add(Mark::Line(line));
    }

    pub(crate) fn text(&mut self, lettering: Lettering) {
        self.add(Mark::Text(lettering));
    }

    /// As pixels.
    pub fn picture(&self) -> Picture {
        let mut picture = Picture::filled(self.size, PAPER);
        self.marks.iter().for_each(|mark| raster::draw(&mut picture, mark));
        picture
    }

    /// As SVG. Letters beyond Latin-1 are drawn, too.
    pub fn svg(&self) -> String {
        svg::written([self.size.width(), self.size.height()], &self.marks)
    }
}
