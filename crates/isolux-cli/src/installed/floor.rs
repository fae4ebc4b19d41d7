//! The floor below luminaires: what a level plane just below them takes up of the plan, up to the walls.
//!
//! A sum of surfaces that face up would count desks and shelves, and the tops of walls. Here a plane between 10 and 20 cm below every
//! luminaire is filled from where the luminaire hangs, to walls, and to whatever else stands in it; doors are shut, as the wall above
//! them is met. Of its cells those count that something is below. Several storeys, and rooms without luminaires, are so told apart.

use isolux::geometry::{Point, Ray, Vector};
use isolux::scene::{LuminaireKind, Scene, UpAxis};
use std::collections::BTreeMap;

/// Cells along the longer side of the plan: of a room askew the area is found to about a part in a hundred.
const CELLS: f64 = 256.0;
/// Planes are at multiples of this, m, and as far or farther below luminaires.
const STEP_M: f64 = 0.1;

/// The plan as cells.
struct Cells<'a> {
    scene: &'a Scene,
    low: Point,
    /// Sides of a cell, m, along the level axes.
    sides: [Vector; 2],
    counts: [usize; 2],
    up: Vector,
}

/// The floor below all luminaires, m2; `None` where nothing is below any.
pub(super) fn floor_m2(scene: &Scene) -> Option<f64> {
    let cells = Cells::of(scene)?;
    let mut levels: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
    for luminaire in scene.luminaires() {
        let LuminaireKind::Point { position, .. } = &luminaire.kind else { continue };
        let level = (cells.height_m(*position) / STEP_M).floor() as i64 - 1;
        if let Some(cell) = cells.cell_of(*position) {
            levels.entry(level).or_default().push(cell);
        }
    }
    let mut floor = vec![false; cells.counts[0] * cells.counts[1]];
    for (level, from) in levels {
        let level_m = level as f64 * STEP_M;
        for (cell, is_reached) in cells.filled(level_m, &from).into_iter().enumerate() {
            floor[cell] |= is_reached && cells.has_floor(cell, level_m);
        }
    }
    let count = floor.into_iter().filter(|is_floor| *is_floor).count();
    let cell_m2 = cells.sides[0].length() * cells.sides[1].length();
    (count > 0).then_some(count as f64 * cell_m2)
}

impl<'a> Cells<'a> {
    fn of(scene: &'a Scene) -> Option<Self> {
        let (low, high) = scene.bvh().mesh().bounds()?;
        let size = high - low;
        let (other, other_m) = match scene.up() {
            UpAxis::Z => (Vector::new(0.0, 1.0, 0.0), size.y),
            UpAxis::Y => (Vector::new(0.0, 0.0, 1.0), size.z),
        };
        let cell_m = size.x.max(other_m) / CELLS;
        let count = |side_m: f64| (side_m / cell_m).round().max(1.0) as usize;
        let (nx, ny) = (count(size.x), count(other_m));
        let is_plan = size.x > 0.0 && other_m > 0.0;
        is_plan.then(|| Self {
            scene,
            low,
            sides: [Vector::new(size.x / nx as f64, 0.0, 0.0), other * (other_m / ny as f64)],
            counts: [nx, ny],
            up: scene.up().direction().to_vector(),
        })
    }

    fn height_m(&self, at: Point) -> f64 {
        at.to_vector().dot(self.up)
    }

    fn cell_of(&self, at: Point) -> Option<usize> {
        let index = |k: usize| {
            let side = self.sides[k];
            let place = (at - self.low).dot(side) / side.length_squared();
            (place >= 0.0 && place < self.counts[k] as f64).then_some(place as usize)
        };
        Some(index(0)? + index(1)? * self.counts[0])
    }

    /// The middle of a cell at a height.
    fn middle(&self, cell: usize, level_m: f64) -> Point {
        let [i, j] = [cell % self.counts[0], cell / self.counts[0]].map(|k| k as f64 + 0.5);
        let at = self.low + self.sides[0] * i + self.sides[1] * j;
        at + self.up * (level_m - self.height_m(at))
    }

    /// Of every cell whether it is reached from some on a level.
    fn filled(&self, level_m: f64, from: &[usize]) -> Vec<bool> {
        let mut reached = vec![false; self.counts[0] * self.counts[1]];
        let mut open = from.to_vec();
        open.iter().for_each(|&cell| reached[cell] = true);
        while let Some(cell) = open.pop() {
            for next in self.beside(cell) {
                let way = Ray::between(self.middle(cell, level_m), self.middle(next, level_m));
                if !reached[next] && !self.scene.bvh().any_hit(&way) {
                    reached[next] = true;
                    open.push(next);
                }
            }
        }
        reached
    }

    fn beside(&self, cell: usize) -> impl Iterator<Item = usize> {
        let ([nx, ny], i, j) = (self.counts, cell % self.counts[0], cell / self.counts[0]);
        let all = [
            (i > 0).then(|| cell - 1),
            (i + 1 < nx).then(|| cell + 1),
            (j > 0).then(|| cell - nx),
            (j + 1 < ny).then(|| cell + nx),
        ];
        all.into_iter().flatten()
    }

    fn has_floor(&self, cell: usize, level_m: f64) -> bool {
        let down = (-self.up).direction();
        down.is_some_and(|down| {
            self.scene.bvh().closest_hit(&Ray::new(self.middle(cell, level_m), down)).is_some()
        })
    }
}
