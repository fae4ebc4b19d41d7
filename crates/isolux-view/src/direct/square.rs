//! Squares of pixels.

use crate::middles::Middles;

/// Pixels across the widest squares: a power of two.
pub(super) const WIDEST: usize = 8;

/// A square of pixels that are seen by one way over mirrors and panes, with the pixels right and below of it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Square {
    pub(super) path: u32,
    /// Pixels across.
    pub(super) size: usize,
    /// Row and column among the squares of its size.
    pub(super) at: [usize; 2],
}

impl Square {
    /// The four squares half as wide within.
    pub(super) fn parts(&self) -> impl Iterator<Item = Self> + use<> {
        self.parts_of(self.size / 2)
    }

    /// The squares of a size within.
    pub(super) fn parts_of(&self, size: usize) -> impl Iterator<Item = Self> + use<> {
        let Self { path, at, .. } = *self;
        let across = self.size / size;
        let within = (0..across).flat_map(move |row| (0..across).map(move |column| [row, column]));
        within.map(move |[row, column]| Self {
            path,
            size,
            at: [at[0] * across + row, at[1] * across + column],
        })
    }

    /// The square and those around it.
    pub(super) fn about(&self) -> impl Iterator<Item = Self> + use<> {
        let Self { path, size, at: [row, column] } = *self;
        let near = |at: usize| at.saturating_sub(1)..at + 2;
        let all = near(row).flat_map(move |row| near(column).map(move |column| [row, column]));
        all.map(move |at| Self { path, size, at })
    }

    /// The squares twice as wide, four times and so on that it lies in.
    pub(super) fn wider(&self) -> impl Iterator<Item = Self> + use<> {
        let wider = |s: &Self| {
            (s.size < WIDEST).then(|| Self { size: 2 * s.size, at: s.at.map(|at| at / 2), ..*s })
        };
        std::iter::successors(wider(self), wider)
    }

    /// First and last row and column of its pixels and those right and below of it; `None` outside of the view.
    pub(super) fn ends(&self, middles: &Middles) -> Option<[[usize; 2]; 2]> {
        let first = self.at.map(|at| at * self.size);
        let size = [middles.height(), middles.width()];
        let is_inside = (0..2).all(|k| first[k] < size[k]);
        is_inside.then(|| [first, [0, 1].map(|k| (first[k] + self.size).min(size[k] - 1))])
    }

    /// The pixels between its ends, as rows and columns.
    pub(super) fn pixels(
        [first, last]: [[usize; 2]; 2],
    ) -> impl Iterator<Item = [usize; 2]> + Clone {
        (first[0]..=last[0]).flat_map(move |y| (first[1]..=last[1]).map(move |x| [y, x]))
    }
}
