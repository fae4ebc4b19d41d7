//! What the middles of pixels show: places of surfaces, straight or by mirrors and panes.

use crate::image::{Size, Surface};
use crate::trace::SurfacePoint;
use isolux::elements::PlaceOnSide;
use isolux::scene::Scene;
use rayon::prelude::*;

/// The places that the middles of pixels show, in the order of pixels.
pub(crate) struct Middles {
    size: Size,
    places: Vec<SurfacePoint>,
    surfaces: Vec<Surface>,
    /// First place of each pixel, and their number.
    firsts: Vec<usize>,
}

impl Middles {
    /// Places in the order of their pixels.
    pub(crate) fn of(scene: &Scene, size: Size, places: Vec<SurfacePoint>) -> Self {
        let surfaces = places.par_iter().map(|at| surface(scene, at)).collect();
        let mut firsts = vec![0; size.pixels() + 1];
        places.iter().for_each(|at| firsts[at.pixel + 1] += 1);
        for pixel in 0..size.pixels() {
            firsts[pixel + 1] += firsts[pixel];
        }
        Self { size, places, surfaces, firsts }
    }

    /// Number of places.
    pub(crate) fn count(&self) -> usize {
        self.places.len()
    }

    /// Pixels across.
    pub(crate) fn width(&self) -> usize {
        self.size.width() as usize
    }

    /// Pixels down.
    pub(crate) fn height(&self) -> usize {
        self.size.height() as usize
    }

    pub(crate) fn place(&self, number: usize) -> &SurfacePoint {
        &self.places[number]
    }

    /// Numbers of the places of a pixel.
    pub(crate) fn of_pixel(&self, pixel: usize) -> std::ops::Range<usize> {
        self.firsts[pixel]..self.firsts[pixel + 1]
    }

    /// The place that a pixel shows by some way over mirrors and panes.
    fn by_path(&self, pixel: usize, path: u32) -> Option<usize> {
        self.of_pixel(pixel).find(|&number| self.places[number].path == path)
    }

    /// Row and column of a pixel.
    pub(crate) fn row_and_column(&self, pixel: usize) -> [usize; 2] {
        [pixel / self.width(), pixel % self.width()]
    }

    /// The place that the pixel in a row and column shows by some way; `None` outside of the view, too.
    pub(crate) fn at(&self, [row, column]: [usize; 2], path: u32) -> Option<usize> {
        let is_inside = row < self.height() && column < self.width();
        is_inside.then(|| self.by_path(row * self.width() + column, path)).flatten()
    }

    /// The places that the pixels of a square about one show by some way.
    pub(crate) fn within(
        &self,
        pixel: usize,
        reach: usize,
        path: u32,
    ) -> impl Iterator<Item = usize> + '_ {
        let [rows, columns] =
            self.row_and_column(pixel).map(|at| at.saturating_sub(reach)..at + reach + 1);
        let pixels = rows.flat_map(move |y| columns.clone().map(move |x| [y, x]));
        pixels.filter_map(move |at| self.at(at, path))
    }

    /// Whether two places belong to one smooth piece of surface, seen by one way.
    pub(crate) fn are_one_piece(&self, one: usize, other: usize) -> bool {
        self.places[one].path == self.places[other].path
            && self.surfaces[one].continues(&self.surfaces[other])
    }

    /// The places of the pixels to the right of one and below it.
    pub(crate) fn right_and_below(&self, number: usize) -> impl Iterator<Item = usize> + '_ {
        let (pixel, width) = (self.places[number].pixel, self.width());
        let right = (pixel % width + 1 < width).then_some(pixel + 1);
        let below = (pixel + width < self.size.pixels()).then_some(pixel + width);
        right.into_iter().chain(below).flat_map(|pixel| self.of_pixel(pixel))
    }

    /// The places to the four sides of one on the same piece of surface.
    pub(crate) fn beside(&self, number: usize) -> impl Iterator<Item = usize> + '_ {
        let (pixel, width) = (self.places[number].pixel, self.width());
        let sides = [
            (pixel % width > 0).then(|| pixel - 1),
            (pixel % width + 1 < width).then_some(pixel + 1),
            pixel.checked_sub(width),
            (pixel + width < self.size.pixels()).then_some(pixel + width),
        ];
        let near = sides.into_iter().flatten().flat_map(|pixel| self.of_pixel(pixel));
        near.filter(move |&other| self.are_one_piece(number, other))
    }

    /// The place that stands for another in its pixel: that of the middle, or, if that shows another surface, the
    /// nearest of the same surface that the middle of one of the pixels around shows.
    pub(crate) fn standing(&self, at: &SurfacePoint, surface: &Surface) -> Option<usize> {
        let own = self.by_path(at.pixel, at.path);
        let own = own.filter(|&number| self.shows(number, at, surface));
        own.or_else(|| self.nearest(self.around(at, surface), surface))
    }

    /// The places of the same surface in the pixels around.
    pub(crate) fn around<'a>(
        &'a self,
        at: &'a SurfacePoint,
        surface: &'a Surface,
    ) -> impl Iterator<Item = usize> + 'a {
        self.within(at.pixel, 1, at.path).filter(move |&number| self.shows(number, at, surface))
    }

    /// The nearest of some places.
    pub(crate) fn nearest(
        &self,
        some: impl Iterator<Item = usize>,
        surface: &Surface,
    ) -> Option<usize> {
        let away = |&k: &usize| (self.surfaces[k].position - surface.position).length_squared();
        some.min_by(|a, b| away(a).total_cmp(&away(b)))
    }

    fn shows(&self, number: usize, at: &SurfacePoint, surface: &Surface) -> bool {
        self.places[number].path == at.path && self.surfaces[number].continues(surface)
    }
}

/// A place as maps and their readers know it.
pub(crate) fn on_side(at: &SurfacePoint) -> PlaceOnSide {
    PlaceOnSide { triangle: at.triangle, back: at.back, uv: [at.u, at.v] }
}

/// The surface at a place.
pub(crate) fn surface(scene: &Scene, at: &SurfacePoint) -> Surface {
    let SurfacePoint { triangle, back, u, v, path, .. } = *at;
    let front = scene.shading_normal(triangle, u, v);
    Surface {
        shape: scene.shape_of(triangle),
        back,
        path,
        position: scene.triangle(triangle).point(u, v),
        normal: if back { (-front.to_direction()).to_normal() } else { front },
    }
}
