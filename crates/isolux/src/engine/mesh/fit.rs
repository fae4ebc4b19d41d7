//! Values of vertices for which the piecewise linear function fits best.
//!
//! A function interpolated from its values at the vertices lies on one side of its chords. Where indirect light is
//! concave, the map would be too dark everywhere between vertices, and so would light that is reflected again and
//! again. The piecewise linear function nearest in the mean square has values a little off at the vertices and no
//! error in the mean; for a parabola it is 2.4 times as near.
//!
//! It is found from second differences. Over an element with vertices `m`, `n` and edges `e` a quadratic function of
//! Hessian `H` exceeds its interpolation by `-1/2 sum l_m l_n (e_mn H e_mn)`, with `l` the barycentric coordinates,
//! and by `-1/24 sum e_mn H e_mn` in the mean. The same three products give the values at the far vertices of the
//! three neighbours. A vertex is moved by the mean over its elements (the projection onto piecewise linear functions
//! with a lumped mass matrix: Zienkiewicz, Taylor, "The Finite Element Method", on projection and mass lumping).
//!
//! Vertices on borders and creases keep their values. A place at the edge of a room sees the other wall from nearby,
//! half of its light comes from the edge itself, and an error there is at once in both walls. Their part is left to
//! the other vertices of their elements, so that the map is right in the mean.

use super::MIN_TASK_LENGTH;
use super::bounded::{Bounded, Range};
use super::carriers::Carriers;
use super::carriers::are_ends;
use crate::ablation::without;
use crate::elements::{Element, Elements};
use crate::units::Rgb;
use isolux_geometry::{Point, Vector};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// The largest sum of the magnitudes of weights of second differences. Beyond it elements are slivers.
const MOST_WEIGHTS_SUM: f64 = 4.0;

/// The largest shift of a value, as a share of the range of the values about it; that of a parabola at its top is a
/// sixth. Across kinks and jumps second differences are no curvature. The value never leaves that range: see
/// [`Range`].
const MOST_SHIFT_SHARE: f64 = 0.25;

/// The number of vertices of one task.
const TASK_VERTICES: usize = 256;

/// A linear combination of values of vertices.
type Form = Vec<(u32, f64)>;

/// The shifts of vertices, as linear combinations of all values.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct Fit {
    entries: Form,
    /// The end of the entries of each vertex.
    ends: Vec<usize>,
}

impl Fit {
    /// The fit of the first `vertices` vertices. Elements count whose corners `tells` accepts. Elements with no
    /// carrier among their vertices stay unchanged, since moving least squares has already fitted them.
    pub(crate) fn new(
        elements: &Elements,
        vertices: usize,
        tells: impl Fn([u32; 3]) -> bool + Sync,
        carriers: &Carriers,
    ) -> Self {
        let all = elements.elements();
        let is_known = |e: &Element| tells(e.vertices);
        let carries = |e: &Element| e.vertices.iter().any(|&v| carriers.is_active(v));
        let about = about(&all, vertices);
        let neighbours = neighbours(&all, &about);
        let place = |v: u32| elements.vertices()[v as usize].position;
        let inner: Vec<Option<Hessian>> = (0..all.len())
            .into_par_iter()
            .map(|k| {
                let beside = [neighbours[k][0]?, neighbours[k][1]?, neighbours[k][2]?];
                let around = beside.iter().chain([&k]).all(|&n| is_known(&all[n]));
                (carries(&all[k]) && around).then(|| Hessian::of(&all, k, beside, &place)).flatten()
            })
            .collect();
        let on_border = borders(&all, &neighbours, vertices);
        let within = |vertex: u32| !on_border[vertex as usize];
        let mean = |k: usize| mean_excess(&all, &inner, &neighbours[k], k, &place);
        let is_moved =
            |e: &Element| is_known(e) && carries(e) && e.vertices.iter().any(|&v| within(v));
        let means: Vec<Form> = (0..all.len())
            .into_par_iter()
            .map(|k| if is_moved(&all[k]) { mean(k) } else { Form::new() })
            .collect();
        let one = |fit: &mut Self, form: &mut Form, vertex: usize| {
            let known = about.of(vertex).iter().map(|&k| (&all[k as usize], &means[k as usize]));
            let known = known.filter(|(element, _)| is_known(element));
            form.clear();
            let area_m2 = shifts(known, vertex as u32, (&within, &place), form);
            form.sort_unstable_by_key(|&(v, _)| v);
            form.iter_mut().for_each(|(_, weight)| *weight /= area_m2);
            let size: f64 = form.iter().map(|(_, weight)| weight.abs()).sum();
            if size <= MOST_WEIGHTS_SUM {
                fit.entries.extend(&*form);
            }
            fit.ends.push(fit.entries.len());
        };
        let some = |first: usize| {
            let (mut fit, mut form) = (Self::default(), Form::new());
            (first..vertices.min(first + TASK_VERTICES)).for_each(|v| one(&mut fit, &mut form, v));
            fit
        };
        let parts: Vec<Self> =
            (0..vertices).into_par_iter().step_by(TASK_VERTICES).map(some).collect();
        let mut fit = Self::default();
        for part in parts {
            let before = fit.entries.len();
            fit.entries.extend(part.entries);
            fit.ends.extend(part.ends.into_iter().map(|end| before + end));
        }
        fit
    }

    /// Whether the fit is one of so many vertices.
    pub(crate) fn is_of(&self, vertices: usize) -> bool {
        are_ends(&self.ends, vertices, self.entries.len())
            && self.entries.iter().all(|&(v, weight)| (v as usize) < vertices && weight.is_finite())
    }

    /// The values of best fit from those at the vertices, each within the range of the values that it is fitted to.
    pub(crate) fn apply(&self, values: &[Rgb]) -> Vec<Rgb> {
        let one = |k: usize| {
            let (mut range, mut shift) = (Range::of(values[k]), Rgb::BLACK);
            for &(v, weight) in self.form(k) {
                let value = values[v as usize];
                shift += value * weight;
                range.include(value);
            }
            let most = range.width() * MOST_SHIFT_SHARE;
            range.hold(values[k] + shift.lesser(most).greater(most * -1.0))
        };
        (0..self.ends.len()).into_par_iter().with_min_len(MIN_TASK_LENGTH).map(one).collect()
    }

    /// The fit as means with fixed weights, from the values of some light.
    pub(crate) fn held(&self, values: &[Rgb]) -> Bounded {
        Bounded::of(&self.apply(values), |k, from| {
            from.push((k as u32, values[k]));
            from.extend(self.form(k).iter().map(|&(v, _)| (v, values[v as usize])));
        })
    }

    /// The shift of a vertex as a linear combination.
    fn form(&self, vertex: usize) -> &[(u32, f64)] {
        if without("fit") {
            return &[];
        }
        let start = vertex.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.entries[start..self.ends[vertex]]
    }
}

/// The area of the elements about a vertex, m2. Adds to `form` the shift of the vertex times that area, with each
/// other vertex once.
fn shifts<'a>(
    about: impl Iterator<Item = (&'a Element, &'a Form)>,
    vertex: u32,
    (within, place): (&impl Fn(u32) -> bool, &impl Fn(u32) -> Point),
    form: &mut Form,
) -> f64 {
    let mut area = 0.0;
    for (element, mean) in about {
        let corners = element.vertices.map(place);
        let area_m2 = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
        area += area_m2;
        if within(vertex) {
            // Vertices that stay leave their part to the others.
            let moved = element.vertices.iter().filter(|&&v| within(v)).count();
            let share_m2 = area_m2 * 3.0 / moved as f64;
            for &(v, weight) in mean {
                let weight = weight * share_m2;
                // A linear search is enough, since few vertices are about one.
                match form.iter_mut().find(|(known, _)| *known == v) {
                    Some((_, sum)) => *sum += weight,
                    None => form.push((v, weight)),
                }
            }
        }
    }
    area
}

/// The elements about each vertex, in their order.
struct About {
    elements: Vec<u32>,
    /// The start of the elements of each vertex, and the end of the last.
    starts: Vec<usize>,
}

impl About {
    fn of(&self, vertex: usize) -> &[u32] {
        &self.elements[self.starts[vertex]..self.starts[vertex + 1]]
    }
}

fn about(all: &[Element], vertices: usize) -> About {
    let mut starts = vec![0; vertices + 1];
    let corners = || all.iter().enumerate().flat_map(|(k, e)| e.vertices.map(|v| (k, v as usize)));
    corners().for_each(|(_, vertex)| starts[vertex + 1] += 1);
    for vertex in 0..vertices {
        starts[vertex + 1] += starts[vertex];
    }
    let mut free = starts.clone();
    let mut elements = vec![0; 3 * all.len()];
    for (k, vertex) in corners() {
        elements[free[vertex]] = k as u32;
        free[vertex] += 1;
    }
    About { elements, starts }
}

/// The neighbours of each element: edge `k` is opposite vertex `k`. `None` where an edge is a border or a crease.
fn neighbours(all: &[Element], about: &About) -> Vec<[Option<usize>; 3]> {
    let across = |index: usize, k: usize| {
        let [a, b] = [1, 2].map(|next| all[index].vertices[(k + next) % 3]);
        let around = about.of(a as usize).iter().map(|&other| other as usize);
        let mut across = around.filter(|&other| other != index && all[other].vertices.contains(&b));
        across.next().filter(|_| across.next().is_none())
    };
    let beside = |index: usize| [0, 1, 2].map(|k| across(index, k));
    (0..all.len()).into_par_iter().with_min_len(MIN_TASK_LENGTH).map(beside).collect()
}

/// Whether each vertex lies on a border or a crease.
fn borders(all: &[Element], beside: &[[Option<usize>; 3]], vertices: usize) -> Vec<bool> {
    let mut found = vec![false; vertices];
    for (element, beside) in all.iter().zip(beside) {
        for k in (0..3).filter(|&k| beside[k].is_none()) {
            found[element.vertices[(k + 1) % 3] as usize] = true;
            found[element.vertices[(k + 2) % 3] as usize] = true;
        }
    }
    found
}

/// The Hessian in a basis of the plane of an element, as linear combinations of the values at its vertices and at the
/// far vertices of its neighbours.
struct Hessian {
    vertices: [u32; 6],
    /// The weights of the components xx, xy and yy.
    weights: [[f64; 6]; 3],
}

impl Hessian {
    fn of(
        all: &[Element],
        index: usize,
        beside: [usize; 3],
        place: &impl Fn(u32) -> Point,
    ) -> Option<Self> {
        let own = all[index].vertices;
        let corners = own.map(place);
        let [x, y] = basis(corners)?;
        let flat = |v: Vector| [v.dot(x), v.dot(y)];
        let [a, b, c] = corners;
        let (ab, ac) = (flat(b - a), flat(c - a));
        let twice_area = ab[0] * ac[1] - ab[1] * ac[0];
        let edges = [(0, 1), (1, 2), (2, 0)].map(|(m, n)| (m, n, flat(corners[n] - corners[m])));
        let mut rows = [[0.0; 3]; 3];
        let mut barycentric = [[0.0; 3]; 3];
        let mut vertices = [own[0], own[1], own[2], 0, 0, 0];
        for (row, &neighbour) in beside.iter().enumerate() {
            let far = *all[neighbour].vertices.iter().find(|v| !own.contains(v))?;
            let ap = flat(place(far) - a);
            let l1 = (ap[0] * ac[1] - ap[1] * ac[0]) / twice_area;
            let l2 = (ab[0] * ap[1] - ab[1] * ap[0]) / twice_area;
            let l = [1.0 - l1 - l2, l1, l2];
            for (m, n, e) in edges {
                let half = -0.5 * l[m] * l[n];
                add(&mut rows[row], products(e), half);
            }
            vertices[3 + row] = far;
            barycentric[row] = l;
        }
        let weights = inverse(rows)?.map(|of_far| {
            let mut weights = [0.0, 0.0, 0.0, of_far[0], of_far[1], of_far[2]];
            for (weight, l) in of_far.into_iter().zip(barycentric) {
                (0..3).for_each(|k| weights[k] -= weight * l[k]);
            }
            weights
        });
        Some(Self { vertices, weights })
    }
}

/// The factors of the components of a Hessian for a vector on both sides.
fn products([x, y]: [f64; 2]) -> [f64; 3] {
    [x * x, 2.0 * x * y, y * y]
}

fn add(sum: &mut [f64; 3], products: [f64; 3], factor: f64) {
    sum.iter_mut().zip(products).for_each(|(sum, product)| *sum += factor * product);
}

/// The mean excess of a function over its interpolation on an element, as a linear combination of values. An element
/// on a border takes the Hessian of its neighbours.
fn mean_excess(
    all: &[Element],
    inner: &[Option<Hessian>],
    beside: &[Option<usize>; 3],
    index: usize,
    place: &impl Fn(u32) -> Point,
) -> Form {
    let is_inner = |&from: &usize| inner[from].is_some();
    let beside = beside.iter().flatten().copied();
    let own = Some(index).filter(is_inner);
    let instead = beside.filter(|_| own.is_none()).filter(is_inner);
    let from = || own.into_iter().chain(instead.clone());
    let count = from().count();
    let corners = all[index].vertices.map(place);
    let edges = [(0, 1), (1, 2), (2, 0)].map(|(m, n)| corners[n] - corners[m]);
    let mut form = Form::with_capacity(6 * count);
    for source in from() {
        let Some(Hessian { vertices, weights }) = &inner[source] else { continue };
        let Some([x, y]) = basis(all[source].vertices.map(place)) else { continue };
        let mut sum = [0.0; 3];
        for e in edges {
            add(&mut sum, products([e.dot(x), e.dot(y)]), 1.0);
        }
        let share = -1.0 / (24.0 * count as f64);
        let of_vertex = |k: usize| (0..3).map(|c| weights[c][k] * sum[c]).sum::<f64>() * share;
        form.extend((0..6).map(|k| (vertices[k], of_vertex(k))));
    }
    form
}

/// Two orthogonal unit vectors in the plane of an element.
fn basis([a, b, c]: [Point; 3]) -> Option<[Vector; 2]> {
    let normal = (b - a).cross(c - a).direction()?.to_vector();
    let smallest =
        if normal.x.abs() < 0.6 { Vector::new(1.0, 0.0, 0.0) } else { Vector::new(0.0, 1.0, 0.0) };
    let x = (smallest - normal * smallest.dot(normal)).direction()?.to_vector();
    Some([x, normal.cross(x)])
}

fn inverse(m: [[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let minor = |r: usize, c: usize| {
        let at = |i: usize, j: usize| m[(r + i) % 3][(c + j) % 3];
        at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)
    };
    let determinant = (0..3).map(|c| m[0][c] * minor(0, c)).sum::<f64>();
    let size = m.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    // Six points close to a conic section do not determine second derivatives.
    (determinant.abs() > 1e-3 * size * size * size)
        .then(|| [0, 1, 2].map(|r| [0, 1, 2].map(|c| minor(c, r) / determinant)))
}
