//! Where a pixel is looked through: once where the picture is even, in all its cells where it is not.

use super::look::{Look, Looker, Meeting};
use crate::camera::ViewRays;
use crate::image::Size;
use isolux::sampling::Key;
use rayon::prelude::*;

/// Cells along the side of a pixel from which on some of them can stand for the others.
const FEWEST_TO_COMPARE: u32 = 3;

/// The pixels of a view, each a square of cells.
pub(super) struct Pixels<'a> {
    pub(super) looker: Looker<'a>,
    pub(super) rays: ViewRays,
    pub(super) size: Size,
    /// Columns and rows of the whole picture before the first of these.
    pub(super) before: [u32; 2],
    /// Cells along the side of a pixel.
    pub(super) per_side: u32,
}

/// One look at every pixel of some rows, where one could be enough.
pub(super) struct Glimpses {
    first_row: usize,
    looks: Vec<Option<Look>>,
}

impl Pixels<'_> {
    /// Glimpses of some rows, and of the row before and the one after them.
    pub(super) fn glimpses(&self, first_row: usize, rows: usize) -> Glimpses {
        let width = self.size.width() as usize;
        let end_row = (first_row + rows + 1).min(self.size.height() as usize);
        let first_row = first_row.saturating_sub(1);
        let pixels = (first_row * width..end_row * width).into_par_iter();
        Glimpses { first_row, looks: pixels.map(|pixel| self.glimpse(pixel)).collect() }
    }

    /// One look at a pixel whose diagonal lies on one smooth piece of surface; `None` for others.
    fn glimpse(&self, pixel: usize) -> Option<Look> {
        if self.per_side < FEWEST_TO_COMPARE {
            return None;
        }
        let middle = self.middle_cell();
        let seen = self.meet(pixel, middle);
        let mut others = self.diagonal().filter(|cell| *cell != middle);
        let is_whole = others.all(|cell| seen.continues(&self.meet(pixel, cell)));
        is_whole.then(|| self.look(pixel, middle, &[], 1))
    }

    /// A look for each cell of a pixel, rows from the top. The glimpse stands for all of them where
    /// those of the pixels around are like it; else, if these show the same surface, the cells on the
    /// diagonal for their columns, where they are alike.
    pub(super) fn looks(&self, pixel: usize, glimpses: &Glimpses) -> Vec<Look> {
        let cells = self.per_side * self.per_side;
        if self.per_side < FEWEST_TO_COMPARE {
            return (0..cells).map(|cell| self.look(pixel, cell, &[], cells)).collect();
        }
        let mut near = self.around(pixel, glimpses);
        let glimpse = self.glimpsed(pixel, glimpses);
        let is_even = |glimpse: &&Look| near.iter().all(|look| look.is_like(glimpse));
        if let Some(glimpse) = glimpse.filter(is_even) {
            return vec![*glimpse; cells as usize];
        }
        let is_inside = |glimpse: &Look| near.iter().all(|look| look.is_beside(glimpse));
        let is_inside = glimpse.is_some_and(is_inside);
        let middle = glimpse.map(|look| (self.middle_cell(), *look));
        let on_diagonal = |cell| match middle {
            Some((middle, look)) if middle == cell => look,
            _ => self.look(pixel, cell, &near, self.per_side),
        };
        let diagonal: Vec<Look> = self.diagonal().map(on_diagonal).collect();
        let alike = is_inside && diagonal.iter().all(|look| look.is_like(&diagonal[0]));
        near.extend(&diagonal);
        let look = |cell: u32| {
            let (row, column) = (cell / self.per_side, cell % self.per_side);
            if alike || row == column {
                diagonal[column as usize]
            } else {
                self.look(pixel, cell, &near, cells)
            }
        };
        (0..cells).map(look).collect()
    }

    fn glimpsed<'g>(&self, pixel: usize, glimpses: &'g Glimpses) -> Option<&'g Look> {
        glimpses.looks[pixel - glimpses.first_row * self.size.width() as usize].as_ref()
    }

    /// What was glimpsed of a pixel and of the eight around it.
    fn around(&self, pixel: usize, glimpses: &Glimpses) -> Vec<Look> {
        let (width, height) = (self.size.width() as usize, self.size.height() as usize);
        let (x, y) = (pixel % width, pixel / width);
        let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
        let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
        let pixels = rows.flat_map(|y| columns.clone().map(move |x| y * width + x));
        pixels.filter_map(|pixel| self.glimpsed(pixel, glimpses).copied()).collect()
    }

    /// The look through a cell, one of `count` that share the facets of a pixel.
    fn look(&self, pixel: usize, cell: u32, near: &[Look], count: u32) -> Look {
        let facets = self.looker.settings.gloss_samples.div_ceil(count).max(1);
        let of_pixel = (pixel, self.key(pixel, cell).with(2));
        self.looker.look(&self.meet(pixel, cell), near, facets, of_pixel)
    }

    /// What lies at the place of a cell. The places are the same in all pixels, so edges are straight, and no two of them
    /// share a row or a column (the canonical arrangement of Kensler 2013), so that edges along either are smooth.
    fn meet(&self, pixel: usize, cell: u32) -> Meeting {
        let width = self.size.width() as usize;
        let (left, top) = (pixel % width, pixel / width);
        let side = f64::from(self.per_side);
        let [column, row] = [cell % self.per_side, cell / self.per_side].map(f64::from);
        let within = |own: f64, other: f64| (own + (other + 0.5) / side) / side;
        let [before_left, above] = self.before.map(f64::from);
        let x = before_left + left as f64 + within(column, row);
        let y = above + top as f64 + within(row, column);
        let ray = self.rays.through(x, y);
        ray.map_or(Meeting::NOTHING, |(ray, direction)| self.looker.meet(&ray, direction))
    }

    fn key(&self, pixel: usize, cell: u32) -> Key {
        Key::new(self.looker.settings.round + 1).with(pixel as u64).with(u64::from(cell))
    }

    fn diagonal(&self) -> impl Iterator<Item = u32> + use<> {
        let step = self.per_side + 1;
        (0..self.per_side).map(move |k| k * step)
    }

    fn middle_cell(&self) -> u32 {
        (self.per_side / 2) * (self.per_side + 1)
    }
}
