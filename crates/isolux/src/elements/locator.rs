//! Where places lie among elements, looked up rather than searched for.
//!
//! To go down a tree of bisections takes a dozen steps, each of which waits for the one before and goes either way.
//! A grid over the barycentric weights of each triangle knows for every cell the smallest node that holds all of it:
//! mostly two or three steps are left.

use super::{Elements, Node, Split};
use rayon::prelude::*;

/// Triangles of fewer elements have no grid.
const FEWEST_ELEMENTS: usize = 8;

/// Cells along a side are two to this power at most.
const MOST_HALVINGS: u32 = 9;

/// A node that a place lies in, and the weights of its vertices there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(super) node: u32,
    pub(super) weights: [f64; 3],
}

/// Grids for elements as if the nodes from some number on did not exist.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Locator {
    level: u32,
    /// Of the front and the back of every triangle.
    grids: Vec<[Option<Grid>; 2]>,
    cells: Vec<Cell>,
}

/// The cells of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Grid {
    first: u32,
    /// Cells along a side.
    size: u32,
}

/// What holds all of a cell: a node, and the weights of its first two vertices as linear functions of the second and
/// third weights of the triangle. Their coefficients are whole numbers, kept exactly up to 2^24.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cell {
    node: u32,
    of: [[f32; 3]; 2],
}

impl Locator {
    /// For all elements on a level.
    pub(crate) fn new(elements: &Elements, level: u32) -> Self {
        let sides: Vec<Option<(u32, Vec<Cell>)>> = elements
            .roots
            .par_iter()
            .flatten_iter()
            .map(|root| root.and_then(|root| grid_of(elements, root, level)))
            .collect();
        let mut locator = Self { level, grids: Vec::with_capacity(sides.len() / 2), cells: vec![] };
        for pair in sides.chunks(2) {
            let mut place = |side: &Option<(u32, Vec<Cell>)>| {
                let (size, cells) = side.as_ref()?;
                let first = u32::try_from(locator.cells.len()).ok()?;
                locator.cells.extend_from_slice(cells);
                Some(Grid { first, size: *size })
            };
            let grids = [place(&pair[0]), place(&pair[1])];
            locator.grids.push(grids);
        }
        locator
    }

    /// Where barycentric weights `(1 - u - v, u, v)` of a triangle are; `None` where the side carries no map.
    pub(crate) fn locate(
        &self,
        elements: &Elements,
        (triangle, back): (u32, bool),
        [u, v]: [f64; 2],
    ) -> Option<Place> {
        let grid = self.grids.get(triangle as usize).and_then(|sides| sides[usize::from(back)]);
        let Some(Grid { first, size }) = grid else {
            return elements.place_above(self.level, (triangle, back), [u, v]);
        };
        // What lies outside goes into the cells at the rim: they hold nodes that reach there.
        let cell = |c: f64| ((c * f64::from(size)) as u32).min(size - 1);
        let Cell { node, of } = self.cells[(first + cell(u) * size + cell(v)) as usize];
        let [a, b] = of.map(|of| {
            let [constant, by_u, by_v] = of.map(f64::from);
            constant + by_u * u + by_v * v
        });
        Some(elements.below(Place { node, weights: [a, b, 1.0 - a - b] }, self.level))
    }
}

/// How many cells are along a side, and all of them; `None` for few elements.
fn grid_of(elements: &Elements, root: u32, level: u32) -> Option<(u32, Vec<Cell>)> {
    let mut leaves = 0_usize;
    let mut waiting = vec![root];
    while let Some(node) = waiting.pop() {
        match elements.split_above(node, level) {
            Some(Split { first_child, .. }) => waiting.extend([first_child, first_child + 1]),
            None => leaves += 1,
        }
    }
    if leaves < FEWEST_ELEMENTS {
        return None;
    }
    // Half of a square: as many cells in the triangle as elements, or up to four times as many.
    let halvings = ((2 * leaves).next_power_of_two().ilog2().div_ceil(2)).min(MOST_HALVINGS);
    let size = 1_u32 << halvings;
    let cell = |k: u32| cell_of(elements, (root, level), size, [k / size, k % size]);
    Some((size, (0..size * size).map(cell).collect()))
}

/// The smallest node that holds all of a cell, as far as that lies in the triangle.
fn cell_of(elements: &Elements, (root, level): (u32, u32), size: u32, [i, j]: [u32; 2]) -> Cell {
    let at = |k: u32| f64::from(k) / f64::from(size);
    let corners = [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]];
    // Weights of all corners, those of the triangle as functions of `(1, u, v)`.
    let mut weights = corners.map(|[i, j]| [1.0 - at(i) - at(j), at(i), at(j)]);
    let mut of = [[1.0, -1.0, -1.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut node = root;
    while let Some(Split { edge, first_child }) = elements.split_above(node, level) {
        let (a, b) = (usize::from(edge), (usize::from(edge) + 1) % 3);
        let (heavier, lighter) = if weights.iter().all(|w| w[a] >= w[b]) {
            (a, b)
        } else if weights.iter().all(|w| w[a] < w[b]) {
            (b, a)
        } else {
            break;
        };
        if of.iter().flatten().any(|c: &f64| c.abs() > MOST_COEFFICIENT) {
            break;
        }
        for w in &mut weights {
            w[heavier] -= w[lighter];
            w[lighter] *= 2.0;
        }
        let (more, less) = (of[heavier], of[lighter]);
        of[heavier] = [0, 1, 2].map(|k| more[k] - less[k]);
        of[lighter] = less.map(|c| 2.0 * c);
        node = first_child + u32::from(heavier == b);
    }
    Cell { node, of: [of[0], of[1]].map(|of| of.map(|c| c as f32)) }
}

/// What may still be doubled and stay below 2^24.
const MOST_COEFFICIENT: f64 = (1u32 << 22) as f64;

impl Elements {
    /// How a node is bisected, as if the nodes from number `level` on did not exist.
    fn split_above(&self, node: u32, level: u32) -> Option<Split> {
        self.nodes[node as usize].split.filter(|split| split.first_child < level)
    }

    /// The smallest node on a level that a place lies in.
    pub(crate) fn below(&self, place: Place, level: u32) -> Place {
        let Place { mut node, mut weights } = place;
        while let Some(Split { edge, first_child }) = self.split_above(node, level) {
            let (a, b) = (usize::from(edge), (usize::from(edge) + 1) % 3);
            // On the edge from a to b the middle has twice the smaller weight.
            if weights[a] >= weights[b] {
                weights[a] -= weights[b];
                weights[b] *= 2.0;
                node = first_child;
            } else {
                weights[b] -= weights[a];
                weights[a] *= 2.0;
                node = first_child + 1;
            }
        }
        Place { node, weights }
    }

    /// Where barycentric weights `(1 - u - v, u, v)` of a triangle are on a level; `None` where the side carries no
    /// map.
    pub(crate) fn place_above(
        &self,
        level: u32,
        (triangle, back): (u32, bool),
        [u, v]: [f64; 2],
    ) -> Option<Place> {
        let node = self.roots.get(triangle as usize)?[usize::from(back)]?;
        Some(self.below(Place { node, weights: [1.0 - u - v, u, v] }, level))
    }

    /// The vertices about a place and their weights.
    pub(crate) fn corners(&self, place: Place) -> [(u32, f64); 3] {
        let Node { vertices, .. } = self.nodes[place.node as usize];
        [0, 1, 2].map(|k| (vertices[k], place.weights[k]))
    }
}
